//! Triangles by their corners.

use glam::{DVec3, Vec3};

use super::{Aabb, Frame, Vector};

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

    /// The smallest box in single precision that holds the corners; infinite beyond the range of single precision.
    #[inline]
    pub fn aabb(&self) -> Aabb {
        Frame::IDENTITY.aabb(self)
    }

    /// Whether the corners lie on a line, exactly: then no ray meets the triangle.
    pub fn is_degenerate(&self) -> bool {
        V::are_collinear(&self.0)
    }
}
