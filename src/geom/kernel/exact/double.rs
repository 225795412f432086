//! The exact test of triangles and rays in double precision.
//!
//! Numbers of single precision never over- or underflow in double precision; numbers of double precision may. The
//! stages, with their ranges and proofs (`[EXACT-7]`):
//!
//! 1. Bounds for all triangles of the scene, if the greatest component of the direction, the greatest distance of a
//!    corner from the origin, on an axis, and the extent of the scene are within 2^-200 to 2^200. Other components may
//!    be arbitrarily small. Nothing overflows. The bound is above 2^-646, while underflow adds at most 2^-1074 to a
//!    component of a cross product, and less than 2^-868 to an edge function and the determinant together.
//! 2. Bounds for the triangle, if its longest edge is also within 2^-200 to 2^200: the same holds.
//! 3. Distance and weights of a certain hit by quotients that are corrected by their residual
//!    ([`corrected`](super::corrected)), if the distance of the hit is also within 2^-200 to 2^200. `[EXACT-14]` If
//!    these leave a number undecided, twice the precision of doubles ([`fine`]), with bounds, which nearly always round
//!    to one number. The distance of a certain hit is below 2^450. If the distance as computed underflows, its bounds
//!    are above 2^-502 apart, because the error of the numerator is above 2^-50 C E E and the determinant at most 4 D E
//!    E.
//! 4. Exact sums ([`accumulator`](super::accumulator)), for numbers of any size.

use std::cmp::Ordering;

use glam::DVec3;

use super::corrected::Corrected;
use super::filter::{Determinants, Errors, USUAL, has_usual_edges};
use super::fine;
use super::order::Crossing;
use super::{Certainty, is_within, parity, predicates, quotient};
use crate::geom::kernel::Kernel;
use crate::geom::{Ray, Region, Triangle};

/// The exact test of triangles and rays in double precision: closed triangles, `t` and weights the nearest doubles to
/// the exact ones (ties to even), for every ray and triangle of finite doubles. `[EXACT-7]`
///
/// It is fastest if direction, extent of the scene and edges are within 2^-200 to 2^200 (about 1e-60 to 1e60) in
/// magnitude. Beyond that range, exact sums decide each triangle whose box is met, in about a microsecond.
///
/// ```
/// use stackless_bvh::glam::DVec3;
/// use stackless_bvh::internals::geom::kernel::{Exact64, Kernel};
/// use stackless_bvh::geom::{Ray, Region, Triangle};
///
/// let triangle = Triangle([DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + 1e12));
/// let ray = Ray::new(DVec3::new(1e12, 1e12, 0.0), DVec3::new(0.0, 0.0, 3.0))?;
/// let exact = Exact64::new(&ray, &Region::of(&triangle.aabb()));
/// assert_eq!(exact.distance(&triangle, f64::INFINITY), Some(1e12 / 3.0));
/// # Ok::<(), stackless_bvh::geom::RayError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Exact64 {
    ray: Ray<DVec3>,
    /// Bounds for all triangles of the scene, if it is within the range.
    errors: Errors,
    /// Whether the greatest components of the ray and of the scene are [`USUAL`].
    is_usual: bool,
}

impl Kernel for Exact64 {
    type Vector = DVec3;
    type Shape = Triangle<DVec3>;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        let sizes = [ray.direction().abs().max_element(), region.distance(ray.origin()), region.size()];
        Self { ray: *ray, errors: Errors::new(sizes), is_usual: sizes.iter().all(|size| USUAL.contains(size)) }
    }

    #[inline]
    fn distance(&self, shape: &Triangle<DVec3>, limit: f64) -> Option<f64> {
        if self.is_usual && self.determinants(shape).is_miss(&self.errors) {
            return None;
        }
        self.place(shape, limit)
    }

    #[inline]
    fn blocks(&self, shape: &Triangle<DVec3>) -> bool {
        !(self.is_usual && self.determinants(shape).is_miss(&self.errors)) && self.settle(shape)
    }

    fn compare(&self, shape: &Triangle<DVec3>, other: &Triangle<DVec3>) -> Ordering {
        self.crossing(shape).compare(&self.crossing(other))
    }

    fn compare_with(&self, shape: &Triangle<DVec3>, t: f64) -> Ordering {
        self.crossing(shape).compare_with(t)
    }

    fn weights(&self, shape: &Triangle<DVec3>) -> [f64; 2] {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let known = self.corrected(shape).and_then(|hit| hit.weights.or_else(|| fine::weights(&shape.0, o, d)));
        known.unwrap_or_else(|| quotient::weights(&shape.0, o, d))
    }
}

impl Exact64 {
    /// Computes the corrected hit, if twice the digits have room, and the hit is certain.
    fn corrected(&self, shape: &Triangle<DVec3>) -> Option<Corrected> {
        let is_certain = self.can_filter(shape) && self.determinants(shape).is_hit(&self.errors_of(shape));
        is_certain.then(|| Corrected::of::<false>(&shape.0, self.ray.origin(), self.ray.direction()))
    }

    fn crossing<'a>(&self, shape: &'a Triangle<DVec3>) -> Crossing<'a> {
        let Triangle(corners) = shape;
        Crossing { corners, o: self.ray.origin(), d: self.ray.direction(), has_room: self.can_filter(shape) }
    }

    /// Computes [`Exact::crosses`](super::Exact::crosses) for doubles of any size. `[PARITY-1]`
    pub fn crosses(&self, shape: &Triangle<DVec3>) -> bool {
        self.blocks(shape) && self.is_crossed_by_line(shape)
    }

    /// Computes [`Parity::sense`](super::Parity::sense).
    pub(super) fn sense(&self, shape: &Triangle<DVec3>) -> i32 {
        parity::sense(&shape.0, self.ray.direction(), self.can_filter(shape))
    }

    fn is_crossed_by_line(&self, shape: &Triangle<DVec3>) -> bool {
        let has_room = self.can_filter(shape);
        has_room && self.determinants(shape).is_hit(&self.errors_of(shape))
            || parity::is_crossed_by_line(&shape.0, self.ray.origin(), self.ray.direction(), has_room)
    }

    #[inline]
    fn determinants(&self, Triangle(corners): &Triangle<DVec3>) -> Determinants {
        Determinants::of(corners, self.ray.origin(), self.ray.direction())
    }

    /// Returns the distance of a possible hit.
    #[inline(never)]
    fn place(&self, shape: &Triangle<DVec3>, limit: f64) -> Option<f64> {
        let has_room = self.can_filter(shape);
        if has_room {
            let (found, errors) = (self.determinants(shape), self.errors_of(shape));
            if found.is_miss(&errors) {
                return None;
            }
            if found.is_hit(&errors) {
                let [tmin, tmax] = self.interval();
                let is_outside = is_within(found.distance(&errors), [tmin, tmax.min(limit)]) == Some(false);
                return if is_outside { None } else { self.rounded_hit(shape) };
            }
        }
        if self.is_inside(shape, has_room) { self.rounded(shape, has_room) } else { None }
    }

    /// Returns whether a possible hit is a hit.
    #[inline(never)]
    fn settle(&self, shape: &Triangle<DVec3>) -> bool {
        let has_room = self.can_filter(shape);
        if has_room {
            let (found, errors) = (self.determinants(shape), self.errors_of(shape));
            if found.is_miss(&errors) {
                return false;
            }
            if found.is_hit(&errors)
                && let Some(is_within) = is_within(found.distance(&errors), self.interval())
            {
                return is_within;
            }
        }
        self.is_inside(shape, has_room) && self.rounded(shape, has_room).is_some()
    }

    fn errors_of(&self, Triangle(corners): &Triangle<DVec3>) -> Errors {
        Errors::of_triangle(corners, self.ray.origin(), self.ray.direction())
    }

    fn interval(&self) -> [f64; 2] {
        [self.ray.tmin(), self.ray.tmax()]
    }

    /// Returns whether the bounds for the triangle hold, and twice the digits have room.
    fn can_filter(&self, shape: &Triangle<DVec3>) -> bool {
        self.is_usual && has_usual_edges(&shape.0)
    }

    /// Returns whether the line meets the triangle. It uses twice the digits if they have room.
    fn is_inside(&self, Triangle(corners): &Triangle<DVec3>, has_room: bool) -> bool {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        !predicates::is_flat_at_sight(corners, d) && predicates::is_inside(corners, o, d, has_room)
    }

    /// Returns the distance of a certain hit, within the interval. `[EXACT-14]`
    #[inline]
    fn rounded_hit(&self, shape: &Triangle<DVec3>) -> Option<f64> {
        let [tmin, tmax] = self.interval();
        match Corrected::of::<false>(&shape.0, self.ray.origin(), self.ray.direction()).t {
            Some(t) if tmin < t && (t < tmax || tmax == f64::INFINITY) => Some(t),
            Some(t) if t < tmin || tmax < t => None,
            _ => self.rounded(shape, true),
        }
    }

    /// Returns the distance of a line that meets the triangle, within the interval. `[EXACT-3]`
    #[inline]
    fn rounded(&self, Triangle(corners): &Triangle<DVec3>, has_room: bool) -> Option<f64> {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let placed =
            if has_room { fine::FineDeterminants::new(corners, o, d).placed(self.interval()) } else { Certainty::Open };
        placed.or_else(|| quotient::distance(corners, o, d, self.interval()))
    }
}

#[cfg(test)]
mod tests;
