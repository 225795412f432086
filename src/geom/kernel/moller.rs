//! Möller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", without culling.

use glam::{DVec3, Vec3};

use super::Kernel;
use crate::geom::{Ray, Region, Triangle, Vector};

/// Möller and Trumbore's test in single precision: a ray within rounding of an edge may miss both of its triangles.
#[derive(Clone, Copy, Debug)]
pub struct Moller32(Ray);

/// Möller and Trumbore's test in double precision on single-precision data. It errs rarely, on exact edges.
#[derive(Clone, Copy, Debug)]
pub struct Moller64 {
    origin: DVec3,
    direction: DVec3,
    tmin: f64,
    tmax: f64,
}

/// The two precisions differ only in their types.
macro_rules! moller {
    ($corners:expr, $origin:expr, $direction:expr) => {{
        let [v0, v1, v2] = $corners;
        let (e1, e2) = (v1 - v0, v2 - v0);
        let p = $direction.cross(e2);
        let det = e1.dot(p);
        let s = $origin - v0;
        let q = s.cross(e1);
        (det, s.dot(p), $direction.dot(q), e2.dot(q))
    }};
}

impl Kernel for Moller32 {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray, _: &Region) -> Self {
        Self(*ray)
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, _: f32) -> Option<f32> {
        let (det, u, v, t) = moller!(shape.0, self.0.origin(), self.0.direction());
        // Compared before the division, with signs as if the ray came from the front.
        let front = |x: f32| f32::from_bits(x.to_bits() ^ det.to_bits() & SIGN32);
        let (u, v, size) = (front(u), front(v), det.abs());
        // False for a NaN. A determinant of 0 may pass, but then t is not finite.
        if !(u >= 0.0 && v >= 0.0 && u + v <= size) {
            return None;
        }
        let t = t / det;
        (self.0.tmin() <= t && t <= self.0.tmax() && t.is_finite()).then_some(t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        let (det, u, v, _) = moller!(shape.0, self.0.origin(), self.0.direction());
        [u / det, v / det]
    }
}

impl Kernel for Moller64 {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray, _: &Region) -> Self {
        Self {
            origin: ray.origin().widen(),
            direction: ray.direction().widen(),
            tmin: ray.tmin().into(),
            tmax: ray.tmax().into(),
        }
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, _: f32) -> Option<f32> {
        let (det, u, v, t) = moller!(shape.widen(), self.origin, self.direction);
        let front = |x: f64| f64::from_bits(x.to_bits() ^ det.to_bits() & SIGN64);
        let (u, v, size) = (front(u), front(v), det.abs());
        if !(u >= 0.0 && v >= 0.0 && u + v <= size) {
            return None;
        }
        let t = t / det;
        (self.tmin <= t && t <= self.tmax && t.is_finite()).then_some(t as f32)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        let (det, u, v, _) = moller!(shape.widen(), self.origin, self.direction);
        [(u / det) as f32, (v / det) as f32]
    }
}

const SIGN32: u32 = 1 << 31;
const SIGN64: u64 = 1 << 63;
