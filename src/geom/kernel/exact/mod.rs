//! The answer of rational arithmetic, in stages.
//!
//! 1. Double precision with one error bound for all triangles of the scene: an edge function that certainly has another
//!    sign than the determinant means a miss. Nearly all misses end here. ([`ExactFromSingle`] asks single precision
//!    first, with a bound for each triangle.)
//! 2. Bounds for this triangle: signs that are certain are taken, and the distance, if both ends of its error interval
//!    round to the same number.
//! 3. Exact sums of floats ([`Sum`]), for what is left.
//!
//! The stages and their bounds: spec/exactness.md, `[EXACT-2]` to `[EXACT-6]`. After Shewchuk 1997, "Adaptive precision
//! floating-point arithmetic and fast robust geometric predicates", and Bartels et al. 2022, arXiv:2208.00497.

mod filter;
mod predicates;
mod quotient;
mod single;
mod sum;

pub(in crate::geom) use predicates::is_degenerate;
pub use single::ExactFromSingle;
pub use sum::Sum;

use glam::{DVec3, Vec3};

use super::Kernel;
use crate::geom::{Ray, Region, Triangle, Vector};
use filter::{Determinants, Distance};

/// The exact test of single-precision triangles: closed triangles, `t` the nearest float to the exact distance (ties to
/// even), for every ray and triangle of finite floats. `[EXACT-1]`
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    origin: DVec3,
    direction: DVec3,
    interval: [f32; 2],
    /// Greatest component of the direction.
    greatest: f64,
    /// Beyond this, an edge function whose sign differs from the determinant's means a miss.
    bound: f64,
}

impl Kernel for Exact {
    type Vector = Vec3;
    type Shape = Triangle;

    #[inline]
    fn new(ray: &Ray, region: &Region) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|v| f64::from(greatest(v.abs())));
        Self {
            interval: [ray.tmin(), ray.tmax()],
            origin: ray.origin().widen(),
            direction: ray.direction().widen(),
            greatest: direction,
            bound: region.bound() * direction * (origin + region.reach_and_size()),
        }
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        let determinants = Determinants::of(&shape.widen(), self.origin, self.direction);
        if determinants.differ_in_sign(self.bound) {
            return None;
        }
        let errors = determinants.errors(self.greatest);
        match determinants.is_inside(&errors) {
            Some(true) => match determinants.distance(&errors, self.interval, limit) {
                Distance::Nearest(t) => Some(t),
                Distance::Outside => None,
                Distance::Unknown => place(self.numbers(), shape),
            },
            Some(false) => None,
            None => settle(self.numbers(), shape),
        }
    }

    #[inline(always)]
    fn blocks(&self, shape: &Triangle) -> bool {
        let determinants = Determinants::of(&shape.widen(), self.origin, self.direction);
        if determinants.differ_in_sign(self.bound) {
            return false;
        }
        let errors = determinants.errors(self.greatest);
        match determinants.is_inside(&errors) {
            Some(true) => {
                determinants.is_within(&errors, self.interval).unwrap_or_else(|| place(self.numbers(), shape).is_some())
            }
            Some(false) => false,
            None => settle(self.numbers(), shape).is_some(),
        }
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        quotient::weights(shape.widen(), self.origin, self.direction)
    }
}

impl Exact {
    #[inline(always)]
    fn numbers(&self) -> Numbers {
        // They were single before.
        let (o, d, [tmin, tmax]) = (self.origin.as_vec3(), self.direction.as_vec3(), self.interval);
        [o.x, o.y, o.z, d.x, d.y, d.z, tmin, tmax]
    }
}

/// What stays of a ray on the way to [`place`] and [`settle`]: numbers, so that the rays that do not go there need not be in
/// memory as a whole.
type Numbers = [f32; 8];

/// The distance by exact sums, of a ray whose line meets the triangle.
#[cold]
#[inline(never)]
fn place([ox, oy, oz, dx, dy, dz, tmin, tmax]: Numbers, shape: &Triangle) -> Option<f32> {
    let [o, d] = [Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz)].map(Vector::widen);
    quotient::distance(&shape.widen(), o, d, [tmin, tmax])
}

/// All by exact sums.
#[cold]
#[inline(never)]
fn settle(ray: Numbers, shape: &Triangle) -> Option<f32> {
    let [ox, oy, oz, dx, dy, dz, ..] = ray;
    let [o, d] = [Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz)].map(Vector::widen);
    if predicates::is_inside(&shape.widen(), o, d) { place(ray, shape) } else { None }
}

#[inline(always)]
fn greatest(v: Vec3) -> f32 {
    greater(greater(v.x, v.y), v.z)
}

/// The greater of two numbers, in one instruction: none is a NaN here.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;
