//! The exact test with a first stage in single precision.

use std::cmp::Ordering;

use glam::Vec3;

use super::super::EDGE;
use super::{Exact, Kernel, greatest};
use crate::geom::{Ray, Region, Triangle};

/// [`Exact`] with a first stage in single precision. The answers are the same; the stage is for hardware with slow
/// double precision.
///
/// On a processor whose scalar units are equally fast in double precision, it costs a second evaluation for each
/// candidate: benches/README.md has the figures.
#[derive(Clone, Copy, Debug)]
pub struct ExactFromSingle {
    exact: Exact,
    origin: Vec3,
    /// The direction, scaled by a power of two to a greatest component of 1 to 2.
    direction: Vec3,
    /// Error bound of an edge function over E (2 C + E). Infinite if single precision might overflow.
    bound: f32,
}

/// Greatest coordinate for which nothing overflows in single precision. `[EXACT-5]`
pub const MAX_COORDINATE: f32 = f32::from_bits((127 + 40) << 23);

/// Minimum edge length in the error bound of single precision; it covers all errors of underflow too. `[EXACT-5]`
pub const MIN_EDGE: f32 = f32::from_bits((127 - 60) << 23);

/// Half of the distance from 1 to the next float.
const UNIT: f32 = f32::EPSILON / 2.0;

impl Kernel for ExactFromSingle {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray, region: &Region) -> Self {
        let greatest = ray.direction().abs().max_element();
        let power = f32::from_bits(greatest.to_bits() & 0x7f80_0000);
        // A subnormal direction has a power of 0 here; the reciprocal of other directions below 2^126 is not subnormal.
        let usual = power > 0.0
            && power < f32::from_bits(253 << 23)
            && ray.origin().abs().max_element() <= MAX_COORDINATE
            && region.reach() <= f64::from(MAX_COORDINATE);
        let (scale, size) = if usual { (power.recip(), greatest * power.recip()) } else { (0.0, f32::INFINITY) };
        Self {
            exact: Exact::new(ray, region),
            origin: ray.origin(),
            direction: ray.direction() * scale,
            bound: EDGE as f32 * UNIT * size,
        }
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        if self.misses(shape) { None } else { self.exact.distance(shape, limit) }
    }

    #[inline(always)]
    fn blocks(&self, shape: &Triangle) -> bool {
        !self.misses(shape) && self.exact.blocks(shape)
    }

    fn compare(&self, shape: &Triangle, other: &Triangle) -> Ordering {
        self.exact.compare(shape, other)
    }

    fn compare_with(&self, shape: &Triangle, t: f32) -> Ordering {
        self.exact.compare_with(shape, t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        self.exact.weights(shape)
    }
}

impl ExactFromSingle {
    /// Returns whether single precision proves that the triangle is missed: two edge functions certainly have opposite
    /// signs.
    #[inline(always)]
    fn misses(&self, shape: &Triangle) -> bool {
        let [v0, v1, v2] = shape.0;
        let (e1, e2, s) = (v1 - v0, v2 - v0, self.origin - v0);
        let p = self.direction.cross(e2);
        let (u, v) = (s.dot(p), self.direction.dot(s.cross(e1)));
        let w = (e1.dot(p) - u) - v;
        let edge = greatest(e1.abs().max(e2.abs())).max(MIN_EDGE);
        let bound = self.bound * edge * (2.0 * greatest(s.abs()) + edge);
        // False if the bound is infinite or a NaN.
        u.min(v).min(w) < -bound && u.max(v).max(w) > bound
    }
}

#[cfg(test)]
mod tests;
