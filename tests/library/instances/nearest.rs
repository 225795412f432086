//! The nearest point of instances, against all images in rational arithmetic. `[INST-9]`

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::Builder;
use stackless_bvh::generate::{Rng, Source};
use stackless_bvh::geom::{Ball, Real, Vector};
use stackless_bvh::trace::InstanceTracer;
use stackless_bvh::traverse::Method;
use stackless_bvh::wide;
use stackless_check::InstanceOracle;

use super::scenes::{self, Kind, narrow, vector};
use super::{assembly, hierarchies, wide as wide_hierarchies};

fn points_are_those_of_rational_arithmetic<V: Kind>() {
    let (mut asked, mut found, mut on_it) = (0, 0, 0);
    for (seed, scene) in scenes::all::<V>().iter().enumerate() {
        let (flat, mut rng) = (InstanceOracle::new(&scene.shapes), Rng::new(7000 + seed as u64));
        let builder = [Builder::Standard, Builder::Median, Builder::Spatial][seed % 3];
        let (binary, wide) = (hierarchies(scene, builder, 2), wide_hierarchies(scene, builder, 3));
        let (binary, root) = assembly(&binary, scene);
        let (wide, of_wide) = assembly(&wide, scene);
        let methods = Method::ALL.into_iter().cycle().skip(seed).take(Method::ALL.len());
        let tracers: Vec<_> = methods
            .filter_map(|method| InstanceTracer::new(&binary, root, method).ok())
            .take(3)
            .chain([InstanceTracer::new(&wide, of_wide, Method::Stack)
                .and_then(|tracer| tracer.with_wide(wide::Method::ALL[seed % wide::Method::ALL.len()]))
                .expect("any tree")])
            .collect();
        let balls: Vec<Ball<V>> = balls(&flat, &mut rng);
        for ball in &balls {
            let expected = flat.nearest(ball);
            asked += 1;
            found += usize::from(expected.is_some());
            on_it += usize::from(expected.as_ref().is_some_and(|near| near.distance == V::Real::ZERO));
            for tracer in &tracers {
                assert_eq!(tracer.nearest(ball), expected, "{}, {ball:?}", scene.name);
            }
        }
        let each = balls.iter().map(|ball| tracers[0].nearest(ball)).collect();
        assert_eq!(tracers[0].nearest_parallel(&balls), Ok(each));
    }
    assert!(asked > 300 && found < asked && found > asked / 2 && on_it > 10, "{found} of {asked}, {on_it}");
}

/// Draws balls around points near the corners, at corners, at middles of corners and far away; some radii end at the
/// nearest point, or before it.
fn balls<V: Kind>(flat: &InstanceOracle<V>, rng: &mut Rng) -> Vec<Ball<V>> {
    let corners: Vec<_> = flat.corners().map(|corners| corners.map(Vector::widen)).collect();
    let all = corners.iter().flatten();
    let (lo, hi) = all.fold((DVec3::MAX, DVec3::MIN), |(lo, hi), corner| (lo.min(*corner), hi.max(*corner)));
    let mut balls = Vec::new();
    for i in 0..8 {
        let [a, b, c] = corners[rng.below(corners.len() as u64) as usize];
        let center = match i % 4 {
            0 => a,
            1 => lo * 0.5 + hi * 0.5,
            2 => a * 0.25 + b * 0.25 + c * 0.5 + vector(rng) * (b - a).abs().max_element(),
            _ => hi * 0.5 + lo * 0.5 + vector(rng) * (hi - lo) * 4.0,
        };
        let Ok(ball) = Ball::around(narrow::<V>(center)) else { continue };
        balls.push(ball);
        if let Some(near) = flat.nearest(&ball).filter(|_| i % 2 == 1) {
            let ends = [near.distance, near.distance.next_down()];
            balls.extend(ends.into_iter().filter_map(|radius| Ball::new(ball.center(), radius).ok()));
        }
    }
    balls
}

#[test]
fn points_are_those_of_rational_arithmetic_in_single() {
    points_are_those_of_rational_arithmetic::<Vec3>();
}

#[test]
fn points_are_those_of_rational_arithmetic_in_double() {
    points_are_those_of_rational_arithmetic::<DVec3>();
}
