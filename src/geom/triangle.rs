//! Triangles by their corners.

use glam::{DVec3, Vec3};

use super::nearest::unit_normal;
use super::{Aabb, Frame, Vector, truth};

/// A triangle by its corners, in single precision, or with [`DVec3`] in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Triangle<V = Vec3>(pub [V; 3]);

impl<V: Vector> Triangle<V> {
    /// Converts the corners to double precision, exactly.
    #[inline]
    pub fn widen(&self) -> [DVec3; 3] {
        self.0.map(Vector::widen)
    }

    /// Returns the smallest box in single precision that contains the corners; infinite beyond the range of single
    /// precision.
    #[inline]
    pub fn aabb(&self) -> Aabb {
        Frame::IDENTITY.aabb(self)
    }

    /// Returns the unit normal, each component the float nearest to the exact value; a zero is positive. Seen from its
    /// tip, the corners run counterclockwise. Returns `None` without an area, or if a coordinate is not finite.
    ///
    /// ```
    /// use stackless_bvh::geom::Triangle;
    /// use stackless_bvh::glam::Vec3;
    ///
    /// assert_eq!(Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]).normal(), Some(Vec3::Z));
    /// assert_eq!(Triangle([Vec3::ZERO, Vec3::X, -Vec3::X]).normal(), None);
    /// ```
    pub fn normal(&self) -> Option<V> {
        let by_digits = unit_normal(&self.widen()).map(V::from_components);
        by_digits.or_else(|| truth::unit_normal(self.0.map(V::components)).map(V::from_components))
    }

    /// Returns whether the corners lie on a line, exactly: then no ray meets the triangle.
    pub fn is_degenerate(&self) -> bool {
        V::are_collinear(&self.0)
    }
}
