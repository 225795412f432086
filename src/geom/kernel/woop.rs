//! Woop, Benthin & Wald 2013, "Watertight ray/triangle intersection".

use glam::{DVec2, Vec3};

use super::Kernel;
use crate::geom::{Ray, Region, Triangle};

/// The watertight test: corners are sheared into a space where the ray runs along an axis, and the signs of the three
/// edges are those of differences of two products. A shared edge gives both triangles the same numbers, so no ray slips
/// between them. The choice of the hit triangle and its distance are not exact.
#[derive(Clone, Copy, Debug)]
pub struct Woop {
    ray: Ray,
    /// Permuted axes: the last is that of the greatest component of the direction.
    axes: [usize; 3],
    shear: Vec3,
}

impl Woop {
    /// Returns the corners in the space of the ray, and the three edge functions.
    #[inline(always)]
    fn edges(&self, corners: &[Vec3; 3]) -> ([f32; 3], [f32; 3]) {
        let [x, y, z] = self.axes;
        let [a, b, c] = corners.map(|corner| {
            let p = corner - self.ray.origin();
            [p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z], self.shear.z * p[z]]
        });
        let edge = |p: [f32; 3], q: [f32; 3]| p[0] * q[1] - p[1] * q[0];
        let mut edges = [edge(c, b), edge(a, c), edge(b, a)];
        if edges.contains(&0.0) {
            // Products of two floats are exact in double precision, and the sign of their difference is.
            let wide = |p: [f32; 3], q: [f32; 3]| {
                let [p, q] = [p, q].map(|p| DVec2::new(p[0].into(), p[1].into()));
                (p.x * q.y - p.y * q.x) as f32
            };
            edges = [wide(c, b), wide(a, c), wide(b, a)];
        }
        (edges, [a[2], b[2], c[2]])
    }
}

impl Kernel for Woop {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    #[inline]
    fn new(ray: &Ray, _: &Region) -> Self {
        let d = ray.direction();
        let z = d.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        // Winding does not change.
        let [x, y] = if d[z] < 0.0 { [y, x] } else { [x, y] };
        Self { ray: *ray, axes: [x, y, z], shear: Vec3::new(d[x] / d[z], d[y] / d[z], 1.0 / d[z]) }
    }

    #[inline(always)]
    fn distance(&self, shape: &Triangle, _: f32) -> Option<f32> {
        let ([u, v, w], [az, bz, cz]) = self.edges(&shape.0);
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let det = u + v + w;
        if det == 0.0 {
            return None;
        }
        let t = (u * az + v * bz + w * cz) / det;
        (self.ray.tmin() <= t && t <= self.ray.tmax() && t.is_finite()).then_some(t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        let ([u, v, w], _) = self.edges(&shape.0);
        [v, w].map(|x| x / (u + v + w))
    }
}
