//! The exact test of triangles and rays in double precision.
//!
//! The numbers of single precision never over- or underflow in double; those of double precision do. What is done
//! where, and why it holds (`[EXACT-7]`):
//!
//! 1. Bounds for all triangles of the scene, if the greatest component of the direction, the greatest distance of a
//!    corner from the origin, on an axis, and the extent of the scene are within 2^-200 to 2^200. Other components may be
//!    of any smallness. Nothing overflows. The bound is above 2^-646, while underflow adds at most 2^-1074 to a
//!    component of a cross product, and less than 2^-868 to an edge function and the determinant together.
//! 2. Bounds for the triangle, if its longest edge too is within 2^-200 to 2^200: the same holds.
//! 3. Distance and weights in twice the precision of doubles ([`fine`]), with bounds: nearly always they round alike.
//! 4. Exact sums, if no number is above 2^200 and products of three are multiples of 2^-756: then they are below 2^607,
//!    and there is room for the low halves of products too. With a quotient within 2^-250 to 2^250, which is a multiple of
//!    2^-303 together with its half unit, products of four are multiples of 2^-1059. A line that certainly meets the
//!    triangle does so at a distance below 2^450; where the distance as computed underflows, its bounds are above 2^-502
//!    apart, because the error of the numerator is above 2^-50 C E E and the determinant at most 4 D E E.
//! 5. What is left is asked again in other units of length and of distance, powers of two in which its greatest numbers
//!    are about 2^128, if no digit is lost by that. `[EXACT-12]`
//! 6. All others are left to rational arithmetic, which is slower.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::filter::{Determinants, Errors};
use super::fine;
use super::{Certainty, is_within, parity, predicates, quotient};
use crate::geom::frame::{exponent_of, power_of_two};
use crate::geom::kernel::Kernel;
use crate::geom::truth::{self, Meeting, Point};
use crate::geom::{Ray, Region, Triangle};

/// The exact test of triangles and rays in double precision: closed triangles, `t` and weights the nearest doubles to
/// the exact ones (ties to even), for every ray and triangle of finite doubles. `[EXACT-7]`
///
/// It is fastest where direction, extent of the scene and edges are within 2^-200 to 2^200 (about 1e-60 to 1e60) in
/// magnitude. Beyond that, what is met is tested in other units. Rational arithmetic, some hundred times as slow as the
/// filter, decides only where the numbers of one triangle and its ray differ by factors above about 2^300.
///
/// ```
/// use glam::DVec3;
/// use stackless_bvh::geom::kernel::{Exact64, Kernel};
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
    /// For all triangles of the scene, if that is usual.
    errors: Errors,
    /// Whether the greatest components of the ray and of the scene are [`USUAL`].
    is_usual: bool,
}

/// Numbers that never over- or underflow here.
pub(super) const USUAL: RangeInclusive<f64> = power_of_two(-200)..=power_of_two(200);

impl Kernel for Exact64 {
    type Vector = DVec3;
    type Shape = Triangle<DVec3>;

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

    fn weights(&self, shape: &Triangle<DVec3>) -> [f64; 2] {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        if self.can_filter(shape)
            && self.determinants(shape).is_hit(&self.errors_of(shape))
            && let Some(weights) = fine::FineDeterminants::new(&shape.0, o, d).weights()
        {
            return weights;
        }
        if self.can_sum(shape)
            && let Some(weights) = quotient::weights_of_doubles(&shape.0, o, d)
        {
            return weights;
        }
        if let Some(Scaled { exact, shape, .. }) = self.scaled(shape) {
            return exact.weights(&shape);
        }
        self.meet(shape).map_or([0.0; 2], |Point { u, v, .. }| [&u, &v].map(truth::round_f64))
    }
}

/// A ray and a triangle in other units. `[EXACT-12]`
struct Scaled {
    /// For the line from 0 to infinity.
    exact: Exact64,
    shape: Triangle<DVec3>,
    /// Distances are to be multiplied with 2 to the power of this.
    exponent: i32,
}

/// What the greatest numbers are about, in other units: as much as leaves room above, for the most room below.
const SCALED: i32 = 128;

/// Units are powers of two that are doubles, as are their reciprocals.
const MAX_UNIT: i32 = 1000;

impl Exact64 {
    /// As [`Exact::crosses`](super::Exact::crosses), for doubles of any size. `[PARITY-1]`
    pub fn crosses(&self, shape: &Triangle<DVec3>) -> bool {
        self.blocks(shape) && self.is_crossed_by_line(shape)
    }

    fn is_crossed_by_line(&self, shape: &Triangle<DVec3>) -> bool {
        let (corners, o, d) = (&shape.0, self.ray.origin(), self.ray.direction());
        if self.can_filter(shape) && self.determinants(shape).is_hit(&self.errors_of(shape)) {
            true
        } else if self.can_sum(shape) {
            parity::is_crossed_by_line(corners, o, d)
        } else if let Some(Scaled { exact, shape, .. }) = self.scaled(shape) {
            exact.is_crossed_by_line(&shape)
        } else {
            parity::is_crossed_in_rationals(corners, o, d)
        }
    }

    #[inline]
    fn determinants(&self, Triangle(corners): &Triangle<DVec3>) -> Determinants {
        Determinants::of(corners, self.ray.origin(), self.ray.direction())
    }

    /// The distance of what may be a hit.
    #[inline(never)]
    fn place(&self, shape: &Triangle<DVec3>, limit: f64) -> Option<f64> {
        if self.can_filter(shape) {
            let (found, errors) = (self.determinants(shape), self.errors_of(shape));
            if found.is_miss(&errors) {
                return None;
            }
            if found.is_hit(&errors) {
                let [tmin, tmax] = self.interval();
                let is_outside = is_within(found.distance(&errors), [tmin, tmax.min(limit)]) == Some(false);
                return if is_outside { None } else { self.rounded(shape) };
            }
        }
        match self.is_inside(shape) {
            Some(true) => self.rounded(shape),
            Some(false) => None,
            None => self.far_off(shape),
        }
    }

    /// Whether what may be a hit is one.
    #[inline(never)]
    fn settle(&self, shape: &Triangle<DVec3>) -> bool {
        if self.can_filter(shape) {
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
        match self.is_inside(shape) {
            Some(is_inside) => is_inside && self.rounded(shape).is_some(),
            None => self.far_off(shape).is_some(),
        }
    }

    fn errors_of(&self, Triangle(corners): &Triangle<DVec3>) -> Errors {
        Errors::of_triangle(corners, self.ray.origin(), self.ray.direction())
    }

    fn interval(&self) -> [f64; 2] {
        [self.ray.tmin(), self.ray.tmax()]
    }

    /// Whether the bounds for the triangle hold.
    fn can_filter(&self, shape: &Triangle<DVec3>) -> bool {
        self.is_usual && has_usual_edges(&shape.0)
    }

    /// Whether sums of products of the ray's and the triangle's numbers are exact.
    fn can_sum(&self, Triangle([a, b, c]): &Triangle<DVec3>) -> bool {
        can_sum(&[*a, *b, *c, self.ray.origin()], self.ray.direction())
    }

    /// Whether the line meets the triangle; `None` where neither twice the digits nor exact sums tell.
    fn is_inside(&self, shape: &Triangle<DVec3>) -> Option<bool> {
        let (corners, o, d) = (&shape.0, self.ray.origin(), self.ray.direction());
        if predicates::is_along_axes(corners, d) {
            return Some(false);
        }
        if self.can_sum(shape) {
            return Some(predicates::is_inside(corners, o, d));
        }
        let has_room = corners.iter().chain([&o, &d]).all(|v| v.abs().max_element() <= *USUAL.end());
        if has_room { predicates::is_inside_by_fine(corners, o, d) } else { None }
    }

    /// The distance within the interval, of a line that meets the triangle; no number may be above 2^200. `[EXACT-3]`
    #[inline]
    fn rounded(&self, shape: &Triangle<DVec3>) -> Option<f64> {
        let t = fine::FineDeterminants::new(&shape.0, self.ray.origin(), self.ray.direction());
        t.distance_within(self.interval()).or_else(|| self.rounded_by_sums(shape))
    }

    /// The same by exact sums.
    #[cold]
    #[inline(never)]
    fn rounded_by_sums(&self, shape: &Triangle<DVec3>) -> Option<f64> {
        if self.can_sum(shape) {
            let (o, d) = (self.ray.origin(), self.ray.direction());
            match quotient::distance_of_doubles(&shape.0, o, d, self.interval()) {
                Certainty::Hit(t) => return Some(t),
                Certainty::Miss => return None,
                Certainty::Open => {}
            }
        }
        self.far_off(shape)
    }

    /// The distance where neither bounds nor sums hold for the numbers as they are.
    #[cold]
    #[inline(never)]
    fn far_off(&self, shape: &Triangle<DVec3>) -> Option<f64> {
        if let Some(Scaled { exact, shape, exponent }) = self.scaled(shape) {
            let ([tmin, tmax], half) = (self.interval(), exponent / 2);
            // Without an end before infinity: what is missed is behind, or not on the line at all.
            let scaled = exact.place(&shape, f64::INFINITY)?;
            let t = scaled * power_of_two(half) * power_of_two(exponent - half);
            if scaled.is_normal() && t.is_infinite() {
                // It rounds to that: what overflows has as many digits as else.
                return tmax.is_infinite().then_some(t);
            }
            // Else one of them was rounded to fewer digits, or an end leaves a question.
            if scaled.is_normal() && t.is_normal() && t != tmin && t != tmax {
                return (tmin < t && t < tmax).then_some(t);
            }
        }
        self.rational(shape).map(|point| truth::round_f64(&point.t))
    }

    /// The same in other units; `None` where that changes nothing, or loses a digit. `[EXACT-12]`
    #[cold]
    #[inline(never)]
    fn scaled(&self, Triangle(corners): &Triangle<DVec3>) -> Option<Scaled> {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let [a, b, c] = *corners;
        let [place, way] = [unit_for(&[a, b, c, o]), unit_for(&[d])];
        if [place, way] == [0; 2] {
            return None;
        }
        let ray = Ray::new(scale(o, -place)?, scale(d, -way)?).ok()?;
        let [a, b, c] = corners.map(|corner| scale(corner, -place));
        let exact = Self { ray, errors: Errors::NONE, is_usual: true };
        Some(Scaled { exact, shape: Triangle([a?, b?, c?]), exponent: place - way })
    }

    /// The hit by rational arithmetic.
    #[cold]
    #[inline(never)]
    fn rational(&self, shape: &Triangle<DVec3>) -> Option<Point> {
        self.meet(shape).filter(|point| truth::holds(self.interval(), &point.t))
    }

    fn meet(&self, Triangle(corners): &Triangle<DVec3>) -> Option<Point> {
        let [o, d] = [self.ray.origin(), self.ray.direction()].map(|v| v.to_array());
        match truth::meet(corners.map(|corner| corner.to_array()), o, d) {
            Meeting::Hit(point) => Some(point),
            Meeting::Miss | Meeting::Coplanar => None,
        }
    }
}

/// Whether corners that are doubles lie on a line, exactly.
pub(in crate::geom) fn is_degenerate_64(corners: &[DVec3; 3]) -> bool {
    let unit = unit_for(corners);
    if let [Some(a), Some(b), Some(c)] = corners.map(|corner| scale(corner, -unit))
        && can_sum(&[a, b, c], DVec3::ONE)
    {
        return predicates::is_degenerate(&[a, b, c]);
    }
    // The determinants with the axes are the components of the cross product of two edges.
    let [a, b, c] = corners.map(|corner| corner.to_array());
    let is_parallel = |axis: DVec3| truth::meet([a, b, c], a, axis.to_array()) == Meeting::Coplanar;
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().all(is_parallel)
}

/// Whether all sums of products of three of these numbers are exact, among them one of the direction or none.
/// `[EXACT-8]`
pub(super) fn can_sum(points: &[DVec3], d: DVec3) -> bool {
    const LEAST: i32 = -756;
    let all = |is: fn(DVec3) -> bool| points.iter().chain([&d]).all(|&v| is(v));
    // Numbers that are not usual may have few digits.
    let has_room = || {
        let [place, way] = [points, &[d]].map(unit_of);
        3 * place >= LEAST && 2 * place + way >= LEAST && all(|v| v.abs().max_element() <= *USUAL.end())
    };
    all(is_usual) || has_room()
}

/// Whether components are 0 or neither tiny nor huge. `[EXACT-7]`
fn is_usual(v: DVec3) -> bool {
    v.to_array().into_iter().all(|x| x == 0.0 || USUAL.contains(&x.abs()))
}

/// All components are multiples of 2 to the power of this, which is at most 0.
fn unit_of(vectors: &[DVec3]) -> i32 {
    let unit = |x: f64| {
        let (exponent, fraction) = ((x.to_bits() >> 52 & 0x7ff) as i32, x.to_bits() & ((1 << 52) - 1));
        // Subnormal numbers have the exponent of the least normal ones, and no leading one.
        let digits = fraction | u64::from(exponent > 0) << 52;
        if digits == 0 { 0 } else { exponent.max(1) - 1075 + digits.trailing_zeros() as i32 }
    };
    vectors.iter().flat_map(DVec3::to_array).map(unit).fold(0, i32::min)
}

/// The exponent of the unit in which the greatest of these numbers is about 2^128; 0 if all are 0, for which all units
/// are alike.
fn unit_for(vectors: &[DVec3]) -> i32 {
    let greatest = vectors.iter().fold(DVec3::ZERO, |greatest, v| greatest.max(v.abs())).max_element();
    if greatest == 0.0 { 0 } else { (exponent_of(greatest) - SCALED).clamp(-MAX_UNIT, MAX_UNIT) }
}

/// A vector times a power of two, if no digit is lost.
fn scale(v: DVec3, exponent: i32) -> Option<DVec3> {
    let scaled = v * power_of_two(exponent);
    (scaled * power_of_two(-exponent) == v).then_some(scaled)
}

/// Whether the longest edge of a triangle neither over- nor underflows.
pub(super) fn has_usual_edges([a, b, c]: &[DVec3; 3]) -> bool {
    USUAL.contains(&(b - a).abs().max((c - a).abs()).max_element())
}

#[cfg(test)]
mod tests;
