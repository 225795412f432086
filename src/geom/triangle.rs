//! The triangle test, in single precision.

use glam::Vec3;

use super::{Aabb, Ray, RaySlabs};

/// A triangle by its corners, whose hits do not depend on the tree that it is found in.
///
/// The closest hit is the least (t, primitive) of all hits, with `t` in single precision. Every tree, order and
/// traversal finds the same one, bit for bit, because
///
/// 1. a hit's `t` depends on the ray and the triangle alone, not on what was found before,
/// 2. it is not below `near` of the triangle's own box ([`RaySlabs::one`] with the ray's whole interval), and that
///    box is hit; where rounding says otherwise, `t` is moved or the hit is rejected,
/// 3. `near` is monotone under nesting, so it is not below `near` of any box around the triangle, and
/// 4. boxes are skipped only if `near` is above the best `t`, and hits accepted only if (t, primitive) is less.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Triangle(pub [Vec3; 3]);

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction; finite and within its interval.
    pub t: f32,
    /// Weight of the second corner, 0 to 1.
    pub u: f32,
    /// Weight of the third corner, 0 to 1. The sum with `u` may exceed 1 by rounding.
    pub v: f32,
}

impl Triangle {
    /// The smallest box of the corners.
    #[inline]
    pub fn aabb(&self) -> Aabb {
        Aabb::of(&self.0)
    }

    /// The hit of a ray, from either side, edges and corners and both ends of the ray's interval included.
    ///
    /// `slabs` must be those of `ray`. Triangles that the ray sees edge-on, and degenerate ones, are missed.
    ///
    /// Möller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", without culling, in single
    /// precision: a ray within rounding of an edge may miss both of its triangles.
    #[inline]
    pub fn intersect(&self, ray: &Ray, slabs: &RaySlabs) -> Option<Hit> {
        let Self([v0, v1, v2]) = *self;
        let (e1, e2) = (v1 - v0, v2 - v0);
        let p = ray.direction().cross(e2);
        let det = e1.dot(p);
        let s = ray.origin() - v0;
        let q = s.cross(e1);
        // Compared before the division, with signs as if the ray came from the front.
        let front = |x: f32| f32::from_bits(x.to_bits() ^ det.to_bits() & SIGN);
        let (u, v, size) = (front(s.dot(p)), front(ray.direction().dot(q)), det.abs());
        // False for a NaN. A determinant of 0 may pass, but then t is not finite.
        let inside = u >= 0.0 && v >= 0.0 && u + v <= size;
        if !inside {
            return None;
        }
        self.place(e2.dot(q) / det, ray, slabs).map(|t| Hit { t, u: u / size, v: v / size })
    }

    /// Moves `t` into the interval of the triangle's own box. `None` if that box is missed or `t` is not on the ray.
    fn place(&self, t: f32, ray: &Ray, slabs: &RaySlabs) -> Option<f32> {
        let on_ray = |t: &f32| ray.tmin() <= *t && *t <= ray.tmax() && t.is_finite();
        let t = Some(t).filter(on_ray)?;
        let [near, far] = slabs.one(&self.aabb(), ray.tmax())?;
        Some(t.max(near).min(far)).filter(on_ray)
    }
}

const SIGN: u32 = 1 << 31;

#[cfg(test)]
mod tests;
