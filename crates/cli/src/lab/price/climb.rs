//! Hill climbing to the most expensive query, by small changes.

use std::fmt::Debug;
use std::time::{Duration, Instant};

use stackless_bvh::generate::draw::Draw;
use stackless_bvh::geom::{Ball, Ray, Real, Vector};

use super::nanoseconds;

/// Number of consecutive changes without success, after which the climb restarts.
const PATIENCE: u32 = 300;

/// The minimum ratio of an improvement, because clocks are inexact.
const DEARER: f64 = 1.02;

/// A query that can be changed slightly.
pub(super) trait Change: Clone + Debug {
    /// A query near to this query, or with a part of `other`. `None` for an invalid query.
    fn change(&self, other: &Self, draw: &mut Draw) -> Option<Self>;
}

/// The most expensive query found in this time, starting from known queries, and its nanoseconds. `known` has the costs
/// of the queries. `None` without queries.
pub(super) fn climb<Q: Change>(
    queries: &[Q],
    known: &[f64],
    ask: impl Fn(&Q) -> usize,
    time: Duration,
) -> Option<(Q, f64)> {
    let mut order: Vec<_> = (0..queries.len()).collect();
    order.sort_by(|&a, &b| known[b].total_cmp(&known[a]));
    let &first = order.first()?;
    let (mut draw, start, mut dearest) = (Draw::new(1), Instant::now(), (queries[first].clone(), known[first]));
    // Start with the most expensive query.
    for &first in order.iter().cycle().take_while(|_| start.elapsed() < time) {
        let (mut current, mut height, mut stale): (Option<Q>, _, _) = (None, known[first], 0);
        while stale < PATIENCE && start.elapsed() < time {
            stale += 1;
            let from = current.as_ref().unwrap_or(&queries[first]);
            let Some(next) = from.change(&queries[draw.below(queries.len())], &mut draw) else { continue };
            // Most changes are cheaper, which a single run shows.
            let Some(cost) = nanoseconds(|| ask(&next), height * DEARER) else { continue };
            if cost > dearest.1 {
                dearest = (next.clone(), cost);
            }
            (current, height, stale) = (Some(next), cost, 0);
        }
    }
    Some(dearest)
}

impl<V: Vector> Change for Ray<V> {
    fn change(&self, other: &Self, draw: &mut Draw) -> Option<Self> {
        let [mut o, mut d] = [self.origin(), self.direction()].map(V::components);
        match draw.below(4) {
            // Aims at the target of the other ray, or starts at its origin.
            0 => d = between(o, sum(other.origin().components(), other.direction().components())),
            1 => {
                let target = sum(o, d);
                o = other.origin().components();
                d = between(o, target);
            }
            2 => change(&mut o, draw),
            _ => change(&mut d, draw),
        }
        Self::within(V::from_components(o), V::from_components(d), self.tmin(), self.tmax()).ok()
    }
}

impl<V: Vector> Change for Ball<V> {
    fn change(&self, other: &Self, draw: &mut Draw) -> Option<Self> {
        let mut center = self.center().components();
        if draw.one_in(3) {
            let axis = draw.below(3);
            center[axis] = other.center().components()[axis];
        } else {
            change(&mut center, draw);
        }
        Self::new(V::from_components(center), self.radius()).ok()
    }
}

/// Changes a component: by some floats, to an integer, to another component, or by a power of two.
fn change<R: Real>(components: &mut [R; 3], draw: &mut Draw) {
    let (axis, from) = (draw.below(3), draw.below(3));
    let old: f64 = components[axis].into();
    components[axis] = match draw.below(4) {
        0 => {
            let up = draw.one_in(2);
            (0..=draw.below(8)).fold(components[axis], |x, _| if up { x.next_up() } else { x.next_down() })
        }
        1 => R::rounded(draw.int(4).into()),
        2 => components[from],
        _ => R::rounded(old * 2f64.powi(draw.int(3) as i32)),
    };
}

fn sum<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [0, 1, 2].map(|axis| R::rounded(a[axis].into() + b[axis].into()))
}

fn between<R: Real>(from: [R; 3], to: [R; 3]) -> [R; 3] {
    [0, 1, 2].map(|axis| R::rounded(to[axis].into() - from[axis].into()))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// If the cost is the distance of the origin from 0, the climb improves on the given queries.
    #[test]
    fn the_climb_climbs() {
        let rays: Vec<_> = (1..4u8).filter_map(|i| Ray::new(Vec3::X * f32::from(i), Vec3::Y).ok()).collect();
        let work = |ray: &Ray| {
            let n = (ray.origin().length() * 100.0).min(1e5) as u64;
            std::hint::black_box((0..n).fold(0u64, |sum, i| std::hint::black_box(sum ^ i)));
            1
        };
        let known: Vec<_> = rays.iter().filter_map(|ray| nanoseconds(|| work(ray), 0.0)).collect();
        let most = known.iter().copied().fold(0.0, f64::max);
        let (ray, dearest) = climb(&rays, &known, work, Duration::from_millis(300)).expect("a query");
        assert!(dearest > 1.5 * most, "{dearest} {known:?}");
        assert!(ray.origin().length() > 3.5, "the returned query is the most expensive: {ray:?}");
        let (ray, none) = climb(&rays, &known, work, Duration::ZERO).expect("a query");
        assert_eq!((none, known.contains(&none)), (most, true), "without time there is no climb");
        assert!(rays.contains(&ray));
    }

    #[test]
    fn changes_are_near_and_are_queries() {
        let (a, b) = (Ray::new(Vec3::ZERO, Vec3::ONE).unwrap(), Ray::new(Vec3::X, Vec3::Z).unwrap());
        let mut draw = Draw::new(2);
        let changed: Vec<_> = (0..200).filter_map(|_| a.change(&b, &mut draw)).collect();
        assert!(changed.len() > 100 && changed.iter().any(|ray| ray.direction() == Vec3::new(1.0, 0.0, 1.0)));
        let (a, b) = (Ball::around(Vec3::ONE).unwrap(), Ball::around(Vec3::X * 9.0).unwrap());
        assert!((0..200).filter_map(|_| a.change(&b, &mut draw)).any(|ball| ball.center().x == 9.0));
    }
}
