//! The distance from a point to a triangle, correctly rounded.
//!
//! A point `q` of the triangle that double precision thinks nearest gives two bounds, whatever it is worth. All of the
//! triangle is at least as far away as the plane across `q` that touches it: seen from the query point, no `x` in the
//! triangle has less than `min(q . corner) / |q|`. And `q` itself is in the triangle. If both bounds round to the same
//! float, that is the answer; else rational arithmetic gives it. `[NEAR-1]` Where the nearest point is is asked only of
//! what is found: intervals tell it, or rational arithmetic. `[NEAR-3]`
//!
//! # Rounding
//!
//! With u = 2^-53, corners relative to the query point are off by u of their components, of which M is the greatest. A
//! dot product with `q` is then off by at most 7 u |q| M (4 roundings, |corner| <= sqrt(3) M), which moves the lower
//! bound by 7 u M. `q = a + v (b - a) + w (c - a)` has components off by at most 13 u M, and `v + w` may exceed 1 by 3
//! u, which moves `q` by no more than 6 sqrt(3) u M: 34 u M together. [`MARGIN`] is nearly twice the greater one, for
//! the roundings of the bounds themselves. Nothing over- or underflows: components of single precision, to the fourth
//! power, stay in range.

mod point;

use glam::{DVec3, Vec3};

use super::{Aabb, Triangle, truth};

/// Greatest error of the bounds, in units of 2^-53 of the greatest component of a corner relative to the point.
const MARGIN: f64 = 64.0 * UNIT;
const UNIT: f64 = 1.0 / (1u64 << 53) as f64;

/// A point that triangles and boxes are measured from.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    point: Vec3,
    radius: f32,
}

impl Measure {
    /// Measures from a point, which must be finite, up to a radius, included, which must not be negative or NaN.
    pub const fn new(point: Vec3, radius: f32) -> Self {
        Self { point, radius }
    }

    /// The point.
    pub const fn point(&self) -> Vec3 {
        self.point
    }

    /// The float nearest to the exact distance of the triangle, if that is at most the radius.
    ///
    /// A distance that rounds to more than `limit` may be left out.
    #[inline]
    pub fn distance(&self, triangle: &Triangle, limit: f32) -> Option<f32> {
        let corners = self.relative(triangle);
        let [near, far] = bounds(&corners);
        let (outside, near, far) = (near > f64::from(self.radius), near as f32, far as f32);
        if outside || near > limit {
            return None;
        }
        if self.is_certain([near, far]) { Some(near) } else { self.exact_distance(triangle) }
    }

    /// The point of the triangle that is nearest, exact but for its coordinates: each is rounded once, to the nearest
    /// float, of two the even one. A zero is positive. `[NEAR-3]`
    ///
    /// NaN if a coordinate of the triangle is not finite.
    pub fn nearest(&self, triangle: &Triangle) -> Vec3 {
        match point::enclose(triangle, self.point).map(|ends| ends.map(one_float)) {
            Some([Some(x), Some(y), Some(z)]) => Vec3::new(x, y, z),
            _ => self.exact_nearest(triangle),
        }
    }

    /// At most the distance of the box.
    #[inline]
    pub fn to_box(&self, aabb: &Aabb) -> f64 {
        let point = self.point.as_dvec3();
        let beside = (aabb.lo.as_dvec3() - point).max(point - aabb.hi.as_dvec3()).max(DVec3::ZERO);
        // Six roundings, each of a unit at most.
        beside.length() * (1.0 - 8.0 * UNIT)
    }

    /// Whether bounds that are rounded to these floats settle a distance: it is that float, and within the radius.
    #[inline]
    fn is_certain(&self, [near, far]: [f32; 2]) -> bool {
        near == far && far < self.radius
    }

    #[cold]
    #[inline(never)]
    fn exact_distance(&self, triangle: &Triangle) -> Option<f32> {
        let square = truth::square_distance(triangle.0.map(|corner| corner.to_array()), self.point.to_array())?;
        // An infinite radius is no rational number.
        let is_within = truth::RBig::try_from(self.radius).is_ok_and(|radius| square <= &radius * &radius);
        (is_within || self.radius.is_infinite()).then(|| truth::round_root_f32(&square))
    }

    #[cold]
    #[inline(never)]
    fn exact_nearest(&self, triangle: &Triangle) -> Vec3 {
        let nearest = truth::nearest_point(triangle.0.map(|corner| corner.to_array()), self.point.to_array());
        nearest.map_or(Vec3::NAN, |point| Vec3::from_array(point.each_ref().map(truth::round_f32)) + 0.0)
    }

    fn relative(&self, triangle: &Triangle) -> [DVec3; 3] {
        triangle.0.map(|corner| corner.as_dvec3() - self.point.as_dvec3())
    }
}

/// The float that all numbers from `lo` to `hi` round to, if it is one.
#[inline]
fn one_float([lo, hi]: [f64; 2]) -> Option<f32> {
    // Of zeros the positive one.
    let (lo, hi) = (lo as f32 + 0.0, hi as f32 + 0.0);
    (lo == hi).then_some(lo)
}

/// Bounds of the distance of the triangle from zero.
#[inline]
fn bounds(corners: &[DVec3; 3]) -> [f64; 2] {
    let q = nearest(corners);
    let [x, y, z] = corners.map(|corner| corner.abs().max_element());
    let margin = MARGIN * x.max(y).max(z);
    let length = q.length();
    let [a, b, c] = corners.map(|corner| q.dot(corner));
    // A NaN, where `q` is zero, is dropped.
    let near = (a.min(b).min(c) / length * (1.0 - 8.0 * UNIT) - margin).max(0.0);
    [near, length * (1.0 + 8.0 * UNIT) + margin]
}

/// The point of a triangle that is nearest to zero, rounded (Ericson 2005, "Real-time collision detection", 5.1.5: by
/// the Voronoi regions of corners and edges). NaN where rounding leaves open where it is.
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
    // Rounded weights of a needle may have any sign: then this is no point of it, and there is no guess.
    if !(of_a > 0.0 && of_b > 0.0 && of_c > 0.0) {
        return DVec3::NAN;
    }
    let all = of_a + of_b + of_c;
    a + ab * (of_b / all) + ac * (of_c / all)
}

#[cfg(test)]
mod tests;
