//! Triangles by their corners.

use glam::{DVec3, Vec3};

use super::{Aabb, Vector, kernel};

/// A triangle by its corners, in single precision, or with [`DVec3`] in double.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Triangle<V = Vec3>(pub [V; 3]);

impl<V: Vector> Triangle<V> {
    /// Corners in double precision; exact.
    #[inline]
    pub fn widen(&self) -> [DVec3; 3] {
        self.0.map(Vector::widen)
    }
}

impl Triangle {
    /// The smallest box of the corners.
    #[inline]
    pub fn aabb(&self) -> Aabb {
        Aabb::of(&self.0)
    }

    /// Whether the corners lie on a line: then no ray meets the triangle.
    pub fn is_degenerate(&self) -> bool {
        kernel::is_degenerate(&self.widen())
    }
}

impl Triangle<DVec3> {
    /// The smallest box in single precision that holds the corners; infinite beyond the range of single precision.
    pub fn aabb(&self) -> Aabb {
        let [a, b, c] = self.0;
        let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
        let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
        Aabb {
            lo: Vec3::from(lo.to_array().map(down)),
            // -down(-x) is x rounded up.
            hi: Vec3::from(hi.to_array().map(|x| -down(-x))),
        }
    }
}
