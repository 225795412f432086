//! What the tests of a ray need to know of the scene as a whole.

use super::Aabb;
use super::kernel::REGION;

/// Extents of the part of space that holds all boxes and triangles which a ray is tested against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    reach: f32,
    reach_and_size: f64,
    bound: f64,
}

impl Region {
    /// The region within a box.
    pub fn of(aabb: &Aabb) -> Self {
        let reach = aabb.lo.abs().max(aabb.hi.abs()).max_element();
        let size = (aabb.hi.as_dvec3() - aabb.lo.as_dvec3()).max_element();
        Self { reach, reach_and_size: f64::from(reach) + size, bound: f64::from(REGION) * (f64::EPSILON / 2.0) * size }
    }

    /// The greatest magnitude of a coordinate.
    #[inline]
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// The same and the longest edge of the box.
    #[inline]
    pub(super) fn reach_and_size(&self) -> f64 {
        self.reach_and_size
    }

    /// The error bound [`REGION`] times the longest edge: to be multiplied with the greatest component of a direction,
    /// and with the greatest distance from an origin to a corner plus the longest edge.
    #[inline]
    pub(super) fn bound(&self) -> f64 {
        self.bound
    }
}
