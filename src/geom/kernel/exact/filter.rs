//! The stages of double precision.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::super::{DETERMINANT, DISTANCE, OFF, OFF_SIGN, QUOTIENT, QUOTIENT_FACTOR, SIGN};
use crate::geom::Region;
use crate::geom::frame::power_of_two;

/// Half of the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Numbers that never over- or underflow here.
pub(in crate::geom) const USUAL: RangeInclusive<f64> = power_of_two(-200)..=power_of_two(200);

/// The determinants of a ray and a triangle. `[EXACT-1]`
///
/// For inputs that are floats of single precision, nothing over- or underflows: every product that is not 0 lies
/// between 2^-447 and 2^390. `[EXACT-6]`
#[derive(Clone, Copy, Debug)]
pub(super) struct Determinants {
    det: f64,
    edges: [f64; 3],
    t: f64,
}

/// Bounds of the errors of [`Determinants`]. `[EXACT-4]`
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    /// Bound of an edge function and the determinant together.
    sign: f64,
    /// Bound of the determinant, times [`QUOTIENT_FACTOR`].
    det: f64,
    /// Bound of the distance times the determinant, times [`QUOTIENT_FACTOR`].
    t: f64,
}

impl Determinants {
    #[inline(always)]
    pub(super) fn of(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
        let (p, q) = (d.cross(e2), s.cross(e1));
        let (det, u, v) = (e1.dot(p), s.dot(p), d.dot(q));
        Self { det, edges: [u, v, (det - u) - v], t: e2.dot(q) }
    }

    /// Returns whether nothing in [`of`](Self::of) is rounded for these numbers, none of which may be subnormal.
    /// `[EXACT-11]`
    pub(super) fn are_exact(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> bool {
        let &[v0, v1, v2] = corners;
        let (Some(unit), Some(unit_of_d)) = (unit([v0, v1, v2, o]), unit([d])) else { return false };
        let [d, off, edges] = greatest(corners, o, d).map(|x| exponent(x) + 1);
        let (direction, off, edges) = ((d - unit_of_d).max(0), (off - unit).max(0), (edges - unit).max(0));
        direction + edges + edges.max(off) + 5 <= DIGITS && 2 * edges + off + 3 <= DIGITS
    }

    /// Returns whether nothing in the determinant is rounded, for any origin of the line. No number may be subnormal.
    pub(super) fn has_exact_det(corners: &[DVec3; 3], d: DVec3) -> bool {
        let &[v0, v1, v2] = corners;
        let (Some(unit), Some(unit_of_d)) = (unit([v0, v1, v2]), unit([d])) else { return false };
        let [d, _, edges] = greatest(corners, v0, d).map(|x| exponent(x) + 1);
        (d - unit_of_d).max(0) + 2 * (edges - unit).max(0) + 3 <= DIGITS
    }

    /// Returns whether the line and the plane of the triangle are parallel, if nothing is rounded.
    pub(super) const fn are_parallel(&self) -> bool {
        self.det == 0.0
    }

    /// Returns whether the line and the plane may be parallel.
    pub(super) const fn may_be_parallel(&self, errors: &Errors) -> bool {
        self.det.abs() <= errors.det
    }

    /// Returns whether the line certainly misses the closed triangle: the sign of an edge function differs from that of
    /// the determinant.
    ///
    /// If the sign of the determinant is right, the certain sign of the edge function decides. If it is wrong, the
    /// determinant is smaller than its error, and in a hit no edge function is greater than the determinant.
    #[inline(always)]
    pub(super) fn is_miss(&self, errors: &Errors) -> bool {
        let [u, v, w] = self.edges.map(|edge| self.front(edge));
        !(u >= -errors.sign && v >= -errors.sign && w >= -errors.sign)
    }

    /// Returns whether the line certainly meets the interior of the triangle.
    #[inline(always)]
    pub(super) fn is_hit(&self, errors: &Errors) -> bool {
        let [u, v, w] = self.edges.map(|edge| self.front(edge));
        u > errors.sign && v > errors.sign && w > errors.sign
    }

    /// Returns a number with its sign changed if the determinant is negative.
    #[inline(always)]
    fn front(&self, x: f64) -> f64 {
        f64::from_bits(x.to_bits() ^ self.det.to_bits() & 1 << 63)
    }

    /// Returns bounds of the distance of a line that certainly meets the interior. `[EXACT-9]`
    #[inline(always)]
    pub(super) fn distance(&self, errors: &Errors) -> [f64; 2] {
        self.over_determinant(self.t, errors.t, errors)
    }

    /// Returns bounds of the weights of the second and of the third corner, for such a line.
    #[inline(always)]
    pub(super) fn weights(&self, errors: &Errors) -> [[f64; 2]; 2] {
        let [u, v, _] = self.edges;
        [u, v].map(|edge| self.over_determinant(edge, errors.sign * QUOTIENT_FACTOR, errors))
    }

    /// Returns bounds of a quotient, given the error of its numerator, times [`QUOTIENT_FACTOR`].
    #[inline(always)]
    fn over_determinant(&self, numerator: f64, error: f64, errors: &Errors) -> [f64; 2] {
        errors.over(numerator, error, self.det)
    }
}

impl Errors {
    /// Bounds of determinants without rounding.
    pub(super) const NONE: Self = Self { sign: 0.0, det: 0.0, t: 0.0 };

    /// Returns bounds of a quotient, given the error of its numerator, times [`QUOTIENT_FACTOR`], and the determinant.
    /// `[EXACT-9]`
    #[inline(always)]
    pub(super) fn over(&self, numerator: f64, error: f64, det: f64) -> [f64; 2] {
        let reciprocal = det.recip();
        let x = numerator * reciprocal;
        let error = (error + x.abs() * self.det) * reciprocal.abs() + x.abs() * (f64::from(QUOTIENT) * UNIT);
        [x - error, x + error]
    }

    /// Returns bounds for all triangles of a scene, given the greatest components of origin and direction.
    #[inline(always)]
    pub(super) fn of_scene(origin: f64, direction: f64, region: &Region) -> Self {
        Self::new([direction, region.reach() + origin, region.size()])
    }

    /// Returns bounds for one triangle.
    #[inline(always)]
    pub(super) fn of_triangle(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        Self::new(greatest(corners, o, d))
    }

    /// Computes [`of_triangle`](Self::of_triangle) for a ray with an error of at most `off` in each component of origin
    /// and direction.
    pub(super) fn of_triangle_within(off: [f64; 2], corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        Self::within(off, greatest(corners, o, d))
    }

    /// Returns bounds from the errors of the ray, and the greatest components of d, s, and e1 and e2. `[INST-5]`
    pub(super) fn within([origin, direction]: [f64; 2], [d, c, e]: [f64; 3]) -> Self {
        let (exact, square) = (Self::new([d, c, e]), e * e);
        Self {
            sign: exact.sign + OFF_SIGN * e * (direction * (c + e) + origin * (d + direction)),
            det: exact.det + OFF * direction * square,
            t: exact.t + OFF * origin * square,
        }
    }

    /// Returns bounds from the greatest components of d, s, and e1 and e2.
    #[inline(always)]
    pub(super) fn new([d, c, e]: [f64; 3]) -> Self {
        let square = e * e;
        Self {
            sign: (f64::from(SIGN) * UNIT) * (d * e) * (c + e),
            det: (f64::from(DETERMINANT) * UNIT * QUOTIENT_FACTOR) * (d * square),
            t: (f64::from(DISTANCE) * UNIT * QUOTIENT_FACTOR) * (c * square),
        }
    }
}

/// Binary digits of a double.
const DIGITS: i32 = f64::MANTISSA_DIGITS as i32;

/// Returns the [`exponent`] of the greatest power of two that divides all components, if they have at most 51 digits
/// down to it.
#[inline(always)]
fn unit<const N: usize>(vectors: [DVec3; N]) -> Option<i32> {
    let greatest = vectors.iter().fold(DVec3::ZERO, |greatest, v| greatest.max(v.abs())).max_element();
    // A sum with this number is rounded to 51 digits, which are then the last digits of the sum.
    let shift = f64::from_bits((exponent(greatest) as u64 + 2) << 52 | 1 << 51);
    let (mut digits, mut is_rounded) = (0, false);
    for v in vectors {
        let sum = v + shift;
        digits |= sum.x.to_bits() | sum.y.to_bits() | sum.z.to_bits();
        is_rounded |= sum - shift != v;
    }
    (!is_rounded).then(|| exponent(greatest) - 50 + digits.trailing_zeros() as i32)
}

/// Returns the stored exponent of a number that is not negative.
const fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32
}

/// Returns the greatest components of d, s, and e1 and e2.
#[inline(always)]
fn greatest(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> [f64; 3] {
    let greatest = |v: DVec3| v.abs().max_element();
    [greatest(d), greatest(o - v0), greatest(v1 - v0).max(greatest(v2 - v0))]
}

/// Returns whether the longest edge of a triangle neither over- nor underflows.
pub(super) fn has_usual_edges([a, b, c]: &[DVec3; 3]) -> bool {
    USUAL.contains(&(b - a).abs().max((c - a).abs()).max_element())
}

#[cfg(test)]
mod tests;
