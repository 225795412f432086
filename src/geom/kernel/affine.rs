//! Havel & Herout 2010, "Yet faster ray-triangle intersection (using SSE4)", in scalar form.

use glam::Vec3;

use super::Kernel;
use crate::geom::{Ray, Region, Triangle};

/// The test of precomputed planes, in single precision: the fastest here, and the least exact.
#[derive(Clone, Copy, Debug)]
pub struct Affine(Ray);

/// A triangle as its plane and two planes through its edges, which give the weights of two corners.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AffineTriangle {
    plane: Plane,
    weights: [Plane; 2],
}

/// Points p with `normal . p + offset` = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Plane {
    normal: Vec3,
    offset: f32,
}

impl From<Triangle> for AffineTriangle {
    /// Computed in double precision. A degenerate triangle becomes planes that no ray meets.
    fn from(triangle: Triangle) -> Self {
        let [v0, v1, v2] = triangle.widen();
        let (e1, e2) = (v1 - v0, v2 - v0);
        let n = e1.cross(e2);
        let plane = |normal: glam::DVec3| {
            let normal = if normal.is_finite() { normal } else { glam::DVec3::ZERO };
            Plane { normal: normal.as_vec3(), offset: -normal.dot(v0) as f32 }
        };
        let size = n.length_squared();
        Self { plane: plane(n), weights: [plane(e2.cross(n) / size), plane(n.cross(e1) / size)] }
    }
}

impl AffineTriangle {
    /// Returns the determinant, and distance and weights times it.
    #[inline(always)]
    fn meet(&self, ray: &Ray) -> [f32; 4] {
        let det = self.plane.normal.dot(ray.direction());
        let t = -(self.plane.offset + ray.origin().dot(self.plane.normal));
        let point = ray.origin() * det + ray.direction() * t;
        let [u, v] = self.weights.map(|plane| point.dot(plane.normal) + det * plane.offset);
        [det, t, u, v]
    }
}

impl Kernel for Affine {
    type Vector = Vec3;
    type Shape = AffineTriangle;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray, _: &Region) -> Self {
        Self(*ray)
    }

    #[inline(always)]
    fn distance(&self, shape: &AffineTriangle, _: f32) -> Option<f32> {
        let [det, t, u, v] = shape.meet(&self.0);
        let front = |x: f32| f32::from_bits(x.to_bits() ^ det.to_bits() & 1 << 31);
        let (u, v, size) = (front(u), front(v), det.abs());
        if !(u >= 0.0 && v >= 0.0 && u + v <= size) {
            return None;
        }
        let t = t / det;
        (self.0.tmin() <= t && t <= self.0.tmax() && t.is_finite()).then_some(t)
    }

    fn weights(&self, shape: &AffineTriangle) -> [f32; 2] {
        let [det, _, u, v] = shape.meet(&self.0);
        [u / det, v / det]
    }
}
