//! What the tests of a ray need to know of the scene as a whole.

use super::Aabb;

/// Extents of the part of space that holds all boxes and triangles which a ray is tested against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    reach: f64,
    size: f64,
}

impl Region {
    /// The region within a box.
    pub fn of(aabb: &Aabb) -> Self {
        let size = aabb.hi.as_dvec3() - aabb.lo.as_dvec3();
        Self { reach: aabb.lo.abs().max(aabb.hi.abs()).max_element().into(), size: size.max_element() }
    }

    /// The greatest magnitude of a coordinate.
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The length of the longest edge of the box, rounded.
    #[inline]
    pub fn size(&self) -> f64 {
        self.size
    }
}
