//! The answer of rational arithmetic, in stages.
//!
//! 1. Double precision with error bounds for all triangles of the scene at once. It decides if signs are certain, and
//!    the distance if both ends of its error interval round to the same number. Nearly all tests end here.
//!    ([`ExactFromSingle`] first tries single precision, with a bound for each triangle; a search first uses a
//!    [`TriangleFilter`], for four triangles at once.)
//! 2. Double precision with error bounds for this triangle, or without bounds if nothing is rounded. `[EXACT-11]`
//! 3. Twice the digits of a double, with bounds. `[EXACT-10]` In double precision, before that, a quotient that is
//!    corrected by its residual. `[EXACT-14]`
//! 4. Exact sums ([`Accumulator`]), for the remaining cases.
//!
//! The stages and their bounds: spec/exactness.md, `[EXACT-2]` to `[EXACT-6]`. After Shewchuk 1997, "Adaptive precision
//! floating-point arithmetic and fast robust geometric predicates", and Bartels et al. 2022, arXiv:2208.00497.

mod accumulator;
mod corrected;
mod double;
mod enclosed;
mod filter;
mod fine;
mod order;
mod parity;
mod predicates;
mod quotient;
mod single;
mod sum;

pub use accumulator::Accumulator;
pub(in crate::geom) use corrected::Corrected;
pub use double::Exact64;
use enclosed::decide;
pub use enclosed::{Certainty, EnclosedTest};
pub(in crate::geom) use filter::USUAL;
pub(in crate::geom) use fine::FineDeterminants;
pub use parity::Parity;
pub(in crate::geom) use predicates::is_degenerate;
pub(crate) use predicates::order_of_lines;
pub use single::{ExactFromSingle, MAX_COORDINATE, MIN_EDGE};
pub(in crate::geom) use sum::{two_product, two_sum};

use std::cell::Cell;
use std::cmp::Ordering;

use glam::{DVec3, Vec3};

use super::{Kernel, Stage};
use crate::geom::lanes::TriangleFilter;
use crate::geom::{Once, Ray, Region, Triangle, Vector};
use filter::{Determinants, Errors};
use order::Crossing;

/// The exact test of single-precision triangles: closed triangles, `t` the nearest float to the exact distance (ties to
/// even), for every ray and triangle of finite floats. `[EXACT-1]`
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    origin: DVec3,
    direction: DVec3,
    interval: [f32; 2],
    /// Bounds for all triangles of the scene.
    errors: Errors,
}

impl Kernel for Exact {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = TriangleFilter;

    #[inline]
    fn new(ray: &Ray, region: &Region) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|v| f64::from(greatest(v.abs())));
        Self {
            origin: ray.origin().widen(),
            direction: ray.direction().widen(),
            interval: [ray.tmin(), ray.tmax()],
            errors: Errors::of_scene(origin, direction, region),
        }
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        self.distance_or(shape, limit, || self.settle(shape, None)).map(|met| met.t)
    }

    #[inline(always)]
    fn blocks(&self, shape: &Triangle) -> bool {
        let found = Determinants::of(&shape.widen(), self.origin, self.direction);
        if found.is_miss(&self.errors) {
            return false;
        }
        if found.is_hit(&self.errors) {
            let ends = found.distance(&self.errors).map(|t| t as f32);
            if let Some(is_within) = is_within(ends, self.interval) {
                return is_within;
            }
        }
        self.settle(shape, None).is_some()
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        let corners = shape.widen();
        let found = Determinants::of(&corners, self.origin, self.direction);
        let errors = Errors::of_triangle(&corners, self.origin, self.direction);
        let certain = if found.is_hit(&errors) { certain_weights(&found, &errors) } else { None };
        certain.unwrap_or_else(|| self.settle_weights(&corners))
    }

    fn compare(&self, shape: &Triangle, other: &Triangle) -> Ordering {
        let [corners, others] = [shape.widen(), other.widen()];
        self.crossing(&corners).compare(&self.crossing(&others))
    }

    fn compare_with(&self, shape: &Triangle, t: f32) -> Ordering {
        self.crossing(&shape.widen()).compare_with(t.into())
    }

    fn stage(&self, shape: &Triangle) -> Stage {
        let corners = shape.widen();
        let found = Determinants::of(&corners, self.origin, self.direction);
        let place = |errors| found.distance(errors).map(|t| t as f32);
        let is_placed = |ends| is_certain(ends, self.interval);
        let is_outside = |ends| is_within(ends, self.interval) == Some(false);
        let by_scene = || Some(place(&self.errors)).filter(|_| found.is_hit(&self.errors));
        if found.is_miss(&self.errors) || by_scene().is_some_and(|t| is_placed(t) || is_outside(t)) {
            return Stage::Scene;
        }
        let errors = Errors::of_triangle(&corners, self.origin, self.direction);
        let is_decided = found.is_miss(&errors) || found.is_hit(&errors) && is_placed(place(&errors));
        if is_decided { Stage::Triangle } else { Stage::Sums }
    }
}

/// The exact test for many triangles: of coincident triangles that need the last stages, it tests one. There may be
/// many, and each would take as long as the first.
#[derive(Clone, Debug)]
pub(in crate::geom) struct ExactOnce {
    pub(in crate::geom) exact: Exact,
    last: Cell<Last>,
}

/// A hit of a triangle.
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Met {
    /// Its distance.
    pub(in crate::geom) t: f32,
    /// Its determinants, if the first stage has found it.
    by: Option<Determinants>,
}

/// The result of the last stages for a triangle: its distance.
type Last = Once<Triangle, Option<f32>>;

impl ExactOnce {
    #[inline(always)]
    pub(in crate::geom) fn new(ray: &Ray, region: &Region) -> Self {
        Self { exact: Exact::new(ray, region), last: Cell::new(Last::NEVER) }
    }

    #[inline(always)]
    pub(in crate::geom) fn distance(&self, shape: &Triangle, limit: f32) -> Option<Met> {
        self.exact.distance_or(shape, limit, || self.settle(shape))
    }

    /// Returns the [`weights`](Kernel::weights) of a hit. In the usual case its determinants give them without being
    /// computed again.
    #[inline(always)]
    pub(in crate::geom) fn weights(&self, met: &Met, shape: &Triangle) -> [f32; 2] {
        let certain = met.by.and_then(|found| certain_weights(&found, &self.exact.errors));
        certain.unwrap_or_else(|| self.exact.weights(shape))
    }

    #[inline(never)]
    fn settle(&self, shape: &Triangle) -> Option<f32> {
        self.exact.settle(shape, Some(&self.last))
    }
}

impl Exact {
    /// Finds the hit of a triangle at the [`distance`](Kernel::distance); `rest` decides the cases that the first stage
    /// leaves open.
    #[inline(always)]
    fn distance_or(&self, shape: &Triangle, limit: f32, rest: impl FnOnce() -> Option<f32>) -> Option<Met> {
        let ([tmin, _], found) = (self.interval, Determinants::of(&shape.widen(), self.origin, self.direction));
        if found.is_miss(&self.errors) {
            return None;
        }
        if found.is_hit(&self.errors) {
            let [near, far] = found.distance(&self.errors).map(|t| t as f32);
            if is_certain([near, far], self.interval) {
                return Some(Met { t: near, by: Some(found) });
            }
            if far < tmin || limit < near {
                return None;
            }
        }
        rest().map(|t| Met { t, by: None })
    }

    /// For single precision, twice the digits always have room.
    const fn crossing<'a>(&self, corners: &'a [DVec3; 3]) -> Crossing<'a> {
        Crossing { corners, o: self.origin, d: self.direction, has_room: true }
    }

    /// Returns the weights that the first two stages leave open.
    #[cold]
    #[inline(never)]
    fn settle_weights(&self, corners: &[DVec3; 3]) -> [f32; 2] {
        let (o, d) = (self.origin, self.direction);
        fine::weights(corners, o, d).unwrap_or_else(|| quotient::weights(corners, o, d))
    }

    /// Runs the stages after the first. In a scene of many small triangles the errors of the first stage are too great
    /// for a third of all hits, and nearly all of these end with the errors of the second.
    #[inline(never)]
    fn settle(&self, shape: &Triangle, last: Option<&Cell<Last>>) -> Option<f32> {
        let (corners, o, d) = (shape.widen(), self.origin, self.direction);
        let (found, errors) = (Determinants::of(&corners, o, d), Errors::of_triangle(&corners, o, d));
        let placed = decide(&found, &errors, &|ends| placed(ends.map(|t| t as f32), self.interval, self.interval[1]));
        let ask = || self.settle_rest(&corners, &found, &errors);
        let ask_once = |last: &Cell<Last>| {
            let mut once = last.get();
            let answer = once.answer(shape, |_| ask());
            last.set(once);
            answer
        };
        placed.or_else(|| last.map_or_else(ask, ask_once))
    }

    /// Decides the cases that the errors of a triangle leave open.
    #[cold]
    #[inline(never)]
    fn settle_rest(&self, corners: &[DVec3; 3], found: &Determinants, errors: &Errors) -> Option<f32> {
        let (o, d) = (self.origin, self.direction);
        let by_digits = || {
            let placed = fine::FineDeterminants::new(corners, o, d).placed(self.interval);
            placed.or_else(|| quotient::distance(corners, o, d, self.interval))
        };
        if predicates::is_flat_at_sight(corners, d) {
            return None;
        }
        if Determinants::are_exact(corners, o, d) {
            // On a coarse grid, such as a lattice, the result at an edge is certain.
            if found.is_miss(&Errors::NONE) || found.are_parallel() {
                return None;
            }
            let ends = found.distance(&Errors::NONE).map(|t| t as f32);
            return placed(ends, self.interval, self.interval[1]).or_else(by_digits);
        }
        let is_met = found.is_hit(errors)
            || !(found.may_be_parallel(errors) && is_parallel(found, corners, d))
                && predicates::is_inside(corners, o, d, true);
        if is_met { by_digits() } else { None }
    }
}

/// Returns whether a line is known to be parallel to a triangle: on a coarse grid from its determinant, for any origin.
fn is_parallel(found: &Determinants, corners: &[DVec3; 3], d: DVec3) -> bool {
    if Determinants::has_exact_det(corners, d) { found.are_parallel() } else { predicates::is_parallel(corners, d) }
}

/// Returns the weights of a line that certainly meets the interior, if their bounds round to one float each.
#[inline(always)]
fn certain_weights(found: &Determinants, errors: &Errors) -> Option<[f32; 2]> {
    let [[u, u_end], [v, v_end]] = found.weights(errors).map(|ends| ends.map(|x| x as f32));
    (u == u_end && v == v_end).then_some([u, v])
}

/// Returns whether bounds of a distance that are rounded to these floats decide it: it is that float, and within the
/// interval.
#[inline(always)]
fn is_certain<R: PartialOrd>([near, far]: [R; 2], [tmin, tmax]: [R; 2]) -> bool {
    near == far && tmin < near && near < tmax
}

/// Returns the distance of a line that certainly meets the triangle, from bounds that are rounded to these floats: a
/// miss if it is outside the interval, or beyond the limit.
#[inline(always)]
fn placed<R: PartialOrd + Copy>(ends @ [near, far]: [R; 2], interval @ [tmin, _]: [R; 2], limit: R) -> Certainty<R> {
    if is_certain(ends, interval) {
        Certainty::Hit(near)
    } else if far < tmin || limit < near {
        Certainty::Miss
    } else {
        Certainty::Open
    }
}

/// Returns whether a distance within bounds is within an interval; `None` if bounds and ends of the interval leave that
/// open.
#[inline(always)]
fn is_within<R: PartialOrd>([near, far]: [R; 2], [tmin, tmax]: [R; 2]) -> Option<bool> {
    if tmin < near && far < tmax {
        Some(true)
    } else if far < tmin || tmax < near {
        Some(false)
    } else {
        None
    }
}

#[inline(always)]
fn greatest(v: Vec3) -> f32 {
    greater(greater(v.x, v.y), v.z)
}

/// Returns the greater of two numbers, in one instruction: none is a NaN here.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;
