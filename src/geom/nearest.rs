//! The distance from a point to a triangle, correctly rounded, in single and in double precision.
//!
//! Double precision computes a point `q` that is probably the nearest point of the triangle. Any `q` gives two bounds.
//! The whole triangle is at least as far away as the supporting plane across `q`: relative to the query point, each `x`
//! in the triangle satisfies `|x| >= min(q . corner) / |q|`. And `q` itself is in the triangle. If both bounds round to
//! the same float of single precision, that is the answer. `[NEAR-1]` Otherwise bounds of twice the digits decide,
//! which double precision always needs, `[NEAR-5]` or rational arithmetic. The nearest point itself is computed only
//! for the result: by doubles with bounds, twice the digits or rational arithmetic. `[NEAR-3]`
//!
//! # Rounding
//!
//! With u = 2^-53, corners relative to the query point have a relative error of u in their components; M is the
//! greatest component. The error of a dot product with `q` is then at most 7 u |q| M (4 roundings, |corner| <= sqrt(3)
//! M), which moves the lower bound by 7 u M. The components of `q = a + v (b - a) + w (c - a)` have an error of at most
//! 13 u M, and `v + w` may exceed 1 by 3 u, which moves `q` by at most 6 sqrt(3) u M: 34 u M together. [`MARGIN`] is
//! nearly twice the greater one, for the roundings of the bounds themselves. Nothing overflows if M is in [`RANGE`], as
//! it is in single precision, and underflow is far less than `u M` if |q| is above [`SHORT`].

mod afar;
mod cone;
mod enclosure;
mod foot;
mod point;
mod rough;

pub use foot::Foot;
pub(super) use foot::unit_normal;

use std::ops::RangeInclusive;

use glam::{DVec3, Vec3};

use self::enclosure::Enclosure;
use self::point::Parts;
use self::rough::Rough;
use super::fine::Fine;
use super::frame::{exponent_of, power_of_two};
use super::truth::{self, Number, RBig};
use super::{Aabb, Frame, Interval, Real, Triangle, Vector};

/// Greatest error of the bounds, in units of 2^-53 of the greatest component of a corner relative to the point.
const MARGIN: f64 = 64.0 * UNIT;
const UNIT: f64 = 1.0 / (1u64 << 53) as f64;

/// The greatest component, for valid bounds: 2^-200 to 2^200.
const RANGE: RangeInclusive<f64> = f64::from_bits((1023 - 200) << 52)..=f64::from_bits((1023 + 200) << 52);

/// A vector of at most this length, 2^-300, has no direction.
const SHORT: f64 = f64::from_bits((1023 - 300) << 52);

/// Squares of distances that neither over- nor underflow: 2^-900 to the greatest number.
const SQUARES: RangeInclusive<f64> = f64::from_bits((1023 - 900) << 52)..=f64::MAX;

/// A point and a radius, to measure distances of triangles and boxes. It is in single precision, or with [`DVec3`] in
/// double precision.
#[derive(Clone, Copy, Debug)]
pub struct Measure<V: Vector = Vec3> {
    point: V,
    radius: V::Real,
    /// The frame of boxes; bounds of the point there, and the unit of length.
    frame: Frame,
    in_frame: [DVec3; 2],
    /// Bounds in single precision.
    ends_in_frame: [Vec3; 2],
    unit: f64,
}

impl<V: Vector> Measure<V> {
    /// Creates a measure from a point, which must be finite. The radius is included, and must not be negative or NaN.
    pub fn new(point: V, radius: V::Real) -> Self {
        Self::within(&Frame::IDENTITY, point, radius)
    }

    /// Creates a measure for boxes in a frame. `[FRAME-1]`
    pub fn within(frame: &Frame, point: V, radius: V::Real) -> Self {
        let in_frame @ [least, most] = frame.ends(point.widen());
        let ends = [0, 1, 2].map(|k| Interval::between([least[k], most[k]]).ends_in_single());
        let ends_in_frame = [0, 1].map(|end| Vec3::from(ends.map(|ends| ends[end])));
        Self { point, radius, frame: *frame, in_frame, ends_in_frame, unit: power_of_two(frame.exponent()) }
    }

    /// Returns the point.
    pub const fn point(&self) -> V {
        self.point
    }

    /// Returns bounds of the point in the frame of boxes.
    pub(crate) const fn ends_in_frame(&self) -> [Vec3; 2] {
        self.ends_in_frame
    }

    /// Converts a distance to the units of the frame, rounded up.
    pub(crate) fn in_frame(&self, distance: V::Real) -> f32 {
        let [_, up] = if self.frame.is_identity() {
            distance.ends_in_single()
        } else {
            Interval::exact(distance.into()).scaled(-self.frame.exponent()).ends_in_single()
        };
        up
    }

    /// Converts a distance from the units of the frame.
    pub(crate) fn out_of_frame(&self, distance: f32) -> V::Real {
        V::Real::rounded(f64::from(distance) * self.unit)
    }

    /// Returns the float nearest to the exact distance of the triangle, if that is at most the radius.
    ///
    /// It may omit a distance that rounds to more than `limit`.
    #[inline]
    pub fn distance(&self, triangle: &Triangle<V>, limit: V::Real) -> Option<V::Real> {
        if triangle.may_be_near(self.point, limit) { self.near_distance(triangle, limit) } else { None }
    }

    /// Returns the [`distance`](Self::distance) of a triangle that [may be near](Triangle::may_be_near).
    #[inline]
    pub(crate) fn near_distance(&self, triangle: &Triangle<V>, limit: V::Real) -> Option<V::Real> {
        let bounds = self.bounds(triangle, limit)?;
        self.certain(bounds.map(|bound| [bound, 0.0])).or_else(|| self.settle(triangle, bounds[1], limit))
    }

    /// Returns bounds of the distance, if it may be at most the radius and round to at most `limit`. If double
    /// precision gives no bounds, the second is a NaN.
    #[inline]
    pub(crate) fn bounds(&self, triangle: &Triangle<V>, limit: V::Real) -> Option<[f64; 2]> {
        let point = self.point.widen();
        let [near, far] = bounds(&triangle.widen().map(|corner| corner - point));
        let is_beyond = near > self.radius.into() || V::Real::rounded(near) > limit;
        (!is_beyond).then_some([near, far])
    }

    /// Returns the distance that these bounds leave undecided. It is at most `far`, if that is a number.
    #[inline(never)]
    pub(crate) fn settle(&self, triangle: &Triangle<V>, far: f64, limit: V::Real) -> Option<V::Real> {
        let near = cone::least_distance(&triangle.widen(), self.point.widen());
        if near > self.radius.into() || V::Real::rounded(near) > limit {
            return None;
        }
        let is_nearer = far < limit.into();
        if !is_nearer
            && let Some(near) = afar::to_triangle(&triangle.widen(), self.point.widen())
            && V::Real::between([near; 2]).is_some_and(|near| near > limit)
        {
            return None;
        }
        self.fine(triangle).or_else(|| self.exact_distance(triangle))
    }

    /// Returns the [`distance`](Self::distance), which must be below the radius, and the [`nearest`](Self::nearest)
    /// point.
    pub(crate) fn distance_and_nearest(&self, triangle: &Triangle<V>) -> (V::Real, V) {
        let (corners, point) = (triangle.widen(), self.point.widen());
        let parts = Parts::decided(&corners, point);
        let foot = parts.and_then(|parts| parts.foot::<Fine>(&corners, point));
        let distance = parts.zip(foot).and_then(|(parts, foot)| self.distance_of(parts, &corners, foot));
        let distance = distance.or_else(|| self.exact_distance(triangle));
        let nearest = foot.and_then(rounded).map_or_else(|| self.exact_nearest(triangle), V::from_components);
        // Callers pass no triangle beyond the radius.
        (distance.unwrap_or(self.radius), nearest)
    }

    /// Returns the nearest point of the triangle, exact except for the rounding of its coordinates: each is rounded
    /// once to the nearest float, ties to even. A zero is positive. `[NEAR-3]`
    ///
    /// NaN if a coordinate of the triangle is not finite.
    pub fn nearest(&self, triangle: &Triangle<V>) -> V {
        let (corners, point) = (triangle.widen(), self.point.widen());
        let parts = Parts::decided(&corners, point);
        let by_doubles = || rounded(parts?.foot::<Rough>(&corners, point)?);
        let by_more_digits = || rounded(parts?.foot::<Fine>(&corners, point)?);
        let coordinates = by_doubles().or_else(by_more_digits);
        coordinates.map_or_else(|| self.exact_nearest(triangle), V::from_components)
    }

    /// Returns a lower bound of the distance of the box, which is in the frame.
    #[inline]
    pub fn to_box(&self, aabb: &Aabb) -> f64 {
        let [least, most] = self.in_frame;
        let distance = length_of(aabb.lo.as_dvec3() - most, least - aabb.hi.as_dvec3()) * self.unit;
        // The bound is below the exact distance by more than this rounding, unless it underflows.
        if distance < f64::MIN_POSITIVE { 0.0 } else { distance.min(f64::MAX) }
    }

    /// Returns a lower bound of the rounded distance of points in the box: by twice the digits if fewer leave it
    /// undecided. `[NEAR-8]`
    pub fn to_box_by_digits(&self, aabb: &Aabb) -> V::Real {
        let least = self.to_box(aabb);
        let [near, far] = [least, least * (1.0 + 32.0 * UNIT)].map(V::Real::rounded);
        if near == far {
            return near;
        }
        let [lo, hi] = [aabb.lo, aabb.hi].map(Vec3::as_dvec3);
        let [below, above] = [lo - self.in_frame[1], self.in_frame[0] - hi];
        let fine = afar::to_box(self.point.widen(), &self.frame, [lo, hi], [below, above], least);
        fine.and_then(|least| V::Real::between([least; 2])).filter(|&fine| fine > near).unwrap_or(near)
    }

    /// Returns the distance that bounds decide: all numbers between them round to it, and it is within the radius.
    #[inline]
    pub(crate) fn certain(&self, bounds: [[f64; 2]; 2]) -> Option<V::Real> {
        V::Real::between(bounds).filter(|&distance| distance < self.radius)
    }

    /// Decides by twice the digits.
    #[inline(never)]
    fn fine(&self, triangle: &Triangle<V>) -> Option<V::Real> {
        let (corners, point) = (triangle.widen(), self.point.widen());
        if corners.contains(&point) {
            // Bounds with a positive radius cannot prove that it is 0.
            return Some(V::Real::default());
        }
        let parts = Parts::decided(&corners, point)?;
        self.distance_of(parts, &corners, parts.foot(&corners, point)?)
    }

    /// Returns the distance of a foot.
    fn distance_of(&self, parts: Parts, corners: &[DVec3; 3], foot: [Fine; 3]) -> Option<V::Real> {
        let point = self.point.widen();
        let height = || parts.only()?.height(corners, point);
        self.certain(height().or_else(|| point::square(foot, point)?.root())?.bounds())
    }

    #[cold]
    #[inline(never)]
    fn exact_distance(&self, triangle: &Triangle<V>) -> Option<V::Real> {
        let square = truth::square_distance(triangle.0.map(V::components), self.point.components())?;
        let radius: f64 = self.radius.into();
        // An infinite radius is not a rational number.
        let is_within = RBig::try_from(radius).map_or(true, |radius| square <= &radius * &radius);
        is_within.then(|| truth::round_root(&square))
    }

    #[cold]
    #[inline(never)]
    fn exact_nearest(&self, triangle: &Triangle<V>) -> V {
        let nearest = truth::nearest_point(triangle.0.map(V::components), self.point.components());
        let coordinate = |x: &RBig| V::Real::rounded(V::Real::nearest(x).into() + 0.0);
        let nearest = nearest.map(|point| point.each_ref().map(coordinate));
        V::from_components(nearest.unwrap_or([V::Real::rounded(f64::NAN); 3]))
    }
}

impl<V: Vector> Triangle<V> {
    /// Returns whether the triangle is not certainly beyond the limit: its box is not. This takes less time than its
    /// distance. `[NEAR-1]`
    #[inline]
    pub(crate) fn may_be_near(&self, point: V, limit: V::Real) -> bool {
        let ([a, b, c], point) = (self.widen(), point.widen());
        let [lo, hi] = [a.min(b).min(c), a.max(b).max(c)];
        // Corners may be infinitely far apart.
        V::Real::rounded(length_of(lo - point, point - hi)) <= limit
    }
}

/// Returns a lower bound of the length of the vector whose components are the maxima of these two and 0.
#[inline]
pub(super) fn length_of(below: DVec3, above: DVec3) -> f64 {
    let beside = below.max(above).max(DVec3::ZERO);
    let square = beside.length_squared();
    let length = if SQUARES.contains(&square) { square.sqrt() } else { rare_length(beside) };
    // Six roundings, each of a unit at most.
    length * (1.0 - 8.0 * UNIT)
}

/// Returns the length of a vector whose square over- or underflows. Below 2^-900 it is the greatest component, which is
/// a lower bound.
#[cold]
fn rare_length(vector: DVec3) -> f64 {
    let greatest = vector.max_element().min(f64::MAX);
    let exponent = exponent_of(greatest).min(1000);
    if exponent < -900 {
        return greatest;
    }
    ((vector * power_of_two(-exponent)).length() * power_of_two(exponent)).min(f64::MAX)
}

/// Returns the floats to which the coordinates of all points of a box round, if each is unique.
fn rounded<E: Enclosure, R: Real>([x, y, z]: [E; 3]) -> Option<[R; 3]> {
    Some([R::between(x.bounds())?, R::between(y.bounds())?, R::between(z.bounds())?])
}

/// Returns bounds of the distance of the triangle from zero.
#[inline]
pub(super) fn bounds(corners: &[DVec3; 3]) -> [f64; 2] {
    let q = nearest(corners);
    let [x, y, z] = corners.map(|corner| corner.abs().max_element());
    let greatest = x.max(y).max(z);
    if !RANGE.contains(&greatest) {
        return [0.0, f64::NAN];
    }
    let (margin, length) = (MARGIN * greatest, q.length());
    let [a, b, c] = corners.map(|corner| q.dot(corner));
    // A NaN, if there is no guess, is dropped.
    let near = (a.min(b).min(c) / length * (1.0 - 8.0 * UNIT) - margin).max(0.0);
    [if length > SHORT { near } else { 0.0 }, length * (1.0 + 8.0 * UNIT) + margin]
}

/// Returns the point of a triangle that is nearest to zero, rounded (Ericson 2005, "Real-time collision detection",
/// 5.1.5: by the Voronoi regions of corners and edges). NaN if rounding leaves its region undecided.
#[inline]
fn nearest(&[a, b, c]: &[DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let [d1, d2] = [-ab.dot(a), -ac.dot(a)];
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let [d3, d4] = [-ab.dot(b), -ac.dot(b)];
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let of_c = d1 * d4 - d3 * d2;
    if of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let [d5, d6] = [-ab.dot(c), -ac.dot(c)];
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let of_b = d5 * d2 - d1 * d6;
    if of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let of_a = d3 * d6 - d5 * d4;
    if of_a <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    // Rounded weights of a needle may have any sign: then they give no point of the needle, and there is no guess.
    if !(of_a > 0.0 && of_b > 0.0 && of_c > 0.0) {
        return DVec3::NAN;
    }
    let all = of_a + of_b + of_c;
    a + ab * (of_b / all) + ac * (of_c / all)
}

#[cfg(test)]
mod tests;
