//! Comparison of slab tests with rational arithmetic: boxes that the ray touches must not be skipped.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::random::Progress;
use stackless_bvh::generate::draw::Draw;
use stackless_bvh::geom::{Aabb, Ray, Region};
use stackless_bvh::internals::geom::slabs::{Directed, Plain, TwoSided};
use stackless_bvh::internals::geom::{Slabs, truth};
use stackless_bvh::internals::trace::SlabsName;

/// Counts of touched boxes that were skipped, for each of [`SlabsName::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct BoxTally {
    /// Rays, each with one box.
    pub rays: u64,
    /// Boxes that the ray's exact, closed interval touches.
    pub touched: u64,
    /// Touched boxes that were skipped.
    pub skipped: [u64; 3],
    /// Boxes that were entered although the ray does not touch them: the cost of conservative tests.
    pub in_vain: [u64; 3],
}

/// Number of kinds of rays and boxes. They are interleaved.
const KINDS: u64 = 10;

/// Rays per chunk, the unit of work of a thread.
const CHUNK: u64 = 4096;

/// Tests numbered random and adversarial rays with one box each, on all cores. Equal seeds give equal rays.
///
/// The rays and boxes are:
/// - random points, and grids of small integers
/// - corners that are hit exactly, or nearly within rounding
/// - intervals that begin or end at the box
/// - origins on planes, flat boxes and points
/// - components of 0, -0 and of all magnitudes down to the least float
/// - coordinates of all magnitudes
pub fn check_boxes(seed: u64, numbers: Range<u64>, progress: Progress<'_>) -> BoxTally {
    let chunk = |start: u64| {
        let mut draw = Draw::new(seed ^ start.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let mut tally = BoxTally::default();
        // Every chunk is drawn from its beginning, even where the range begins inside it.
        let end = numbers.end.min(start.saturating_add(CHUNK));
        for i in start..end {
            let drawn = draw_kind(&mut draw, i % KINDS);
            if let Some((ray, aabb)) = drawn.filter(|_| i >= numbers.start) {
                tally.add(&ray, &aabb);
            }
        }
        progress(end - start.max(numbers.start));
        tally
    };
    (numbers.start / CHUNK..numbers.end.div_ceil(CHUNK))
        .into_par_iter()
        .map(|i| chunk(i * CHUNK))
        .reduce(BoxTally::default, BoxTally::merge)
}

impl BoxTally {
    fn add(&mut self, ray: &Ray, aabb: &Aabb) {
        let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
        let touched = truth::touches(o, d, [ray.tmin(), ray.tmax()], lo, hi);
        self.rays += 1;
        self.touched += u64::from(touched);
        for (i, form) in SlabsName::ALL.into_iter().enumerate() {
            let entered = match form {
                SlabsName::Plain => enters::<Plain>(ray, aabb),
                SlabsName::TwoSided => enters::<TwoSided>(ray, aabb),
                SlabsName::Directed => enters::<Directed>(ray, aabb),
            };
            self.skipped[i] += u64::from(touched && !entered);
            self.in_vain[i] += u64::from(!touched && entered);
        }
    }

    /// Adds the counts of another tally.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        let sum = |a: [u64; 3], b: [u64; 3]| [0, 1, 2].map(|i| a[i].saturating_add(b[i]));
        Self {
            rays: self.rays.saturating_add(other.rays),
            touched: self.touched.saturating_add(other.touched),
            skipped: sum(self.skipped, other.skipped),
            in_vain: sum(self.in_vain, other.in_vain),
        }
    }
}

fn enters<B: Slabs<Vector = Vec3>>(ray: &Ray, aabb: &Aabb) -> bool {
    B::new(ray, &Region::of(aabb)).one(aabb, ray.tmax()).is_some()
}

/// Draws a ray and a box of one kind. Returns `None` if the numbers are not a valid ray.
fn draw_kind(draw: &mut Draw, kind: u64) -> Option<(Ray, Aabb)> {
    let (mut o, mut d) = (draw.cube() * 4.0 - 1.5, draw.cube() - 0.5);
    let mut aabb = Aabb::of(&[draw.cube(), draw.cube()]);
    let mut interval = [0.0, f32::INFINITY];
    match kind {
        0 => d = aabb.lo + aabb.extent() * draw.cube() - o,
        // Integers: the ray hits a corner exactly, at a distance of s directions.
        1 => {
            let corner = draw.ints(2048);
            d = draw.ints(2048);
            o = corner - d * draw.int(2048).abs();
            aabb = Aabb::of(&[corner, draw.ints(2048)]);
        }
        2 => {
            (o, d) = (draw.ints(3), draw.ints(3));
            aabb = Aabb::of(&[draw.ints(3), draw.ints(3)]);
        }
        // A corner or an edge, hit as closely as rounding allows.
        3 | 4 => {
            d = corner_of(draw, &aabb) - o;
            if kind == 4 {
                d[draw.below(3)] *= 1.0 + draw.unit() * f32::EPSILON;
            }
        }
        // Rays along axes and on planes.
        5 => {
            let axis = draw.below(3);
            let corner = corner_of(draw, &aabb);
            d[axis] = [0.0, -0.0][draw.below(2)];
            o[axis] = corner[axis];
            if draw.below(2) == 0 {
                d[(axis + 1) % 3] = 0.0;
                o[(axis + 1) % 3] = corner[(axis + 1) % 3];
            }
        }
        // One component of any magnitude, down to the least, toward a close plane.
        6 => {
            let axis = draw.below(3);
            d[axis] = draw.float(-149, 127);
            o[axis] = corner_of(draw, &aabb)[axis] - [d[axis], d[axis] * 0.5, draw.float(-149, -60)][draw.below(3)];
        }
        // Intervals that begin or end at the box.
        7 => {
            let corner = corner_of(draw, &aabb);
            o = corner - draw.ints(64);
            d = corner - o;
            interval = [[0.0, 1.0], [1.0, 1.0], [1.0, f32::INFINITY], [0.0, 1.0f32.next_down()]][draw.below(4)];
        }
        // Boxes without extent on one or two axes, and points.
        8 => {
            let first = draw.below(3);
            for i in 0..=draw.below(3) {
                let axis = (first + i) % 3;
                aabb.hi[axis] = aabb.lo[axis];
            }
            d = corner_of(draw, &aabb) - o;
        }
        // Coordinates of all magnitudes.
        _ => {
            o = draw.floats(-149, 127);
            let corner = draw.floats(-149, 127);
            d = if draw.below(2) == 0 { corner - o } else { draw.floats(-149, 127) };
            aabb = Aabb::of(&[corner, draw.floats(-149, 127)]);
        }
    }
    Some((Ray::within(o, d, interval[0], interval[1]).ok()?, aabb))
}

fn corner_of(draw: &mut Draw, aabb: &Aabb) -> Vec3 {
    Vec3::from([0, 1, 2].map(|axis| [aabb.lo, aabb.hi][draw.below(2)][axis]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks boxes without extent on one axis, on two axes, and on all.
    #[test]
    fn boxes_are_flat_in_every_way() {
        let (mut draw, mut flat) = (Draw::new(1), [0; 8]);
        for _ in 0..400 {
            let Some((_, aabb)) = draw_kind(&mut draw, 8) else { continue };
            let extent = aabb.extent().to_array();
            flat[(0..3).map(|axis| usize::from(extent[axis] == 0.0) << axis).sum::<usize>()] += 1;
        }
        assert_eq!(flat[0], 0, "a box that is not flat");
        assert!(flat[1..].iter().all(|&count| count > 10), "{flat:?}");
    }
}
