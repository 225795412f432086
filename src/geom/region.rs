//! What the tests of a ray need to know of the scene as a whole.

use glam::DVec3;

use super::frame::power_of_two;
use super::{Aabb, Frame};

/// Extents of the part of space that holds all boxes and triangles which a ray is tested against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    reach: f64,
    size: f64,
    bounds: Aabb,
    frame: Frame,
}

impl Region {
    /// The region within a box.
    pub fn of(aabb: &Aabb) -> Self {
        Self::within(Frame::IDENTITY, aabb)
    }

    /// The region within a box that is in a frame, as are all others.
    pub fn within(frame: Frame, aabb: &Aabb) -> Self {
        let size = aabb.hi.as_dvec3() - aabb.lo.as_dvec3();
        let unit = power_of_two(frame.exponent());
        let reach = f64::from(aabb.lo.abs().max(aabb.hi.abs()).max_element());
        Self { reach: reach * unit, size: size.max_element() * unit, bounds: *aabb, frame }
    }

    /// The greatest magnitude of a coordinate, as seen from the origin of the [frame](Self::frame).
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The length of the longest edge of the box, rounded.
    #[inline]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The greatest magnitude of a coordinate in the frame.
    #[inline]
    pub(super) fn reach_in_frame(&self) -> f32 {
        self.bounds.lo.abs().max(self.bounds.hi.abs()).max_element()
    }

    /// The box, in the frame.
    #[inline]
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// In which boxes are.
    #[inline]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// No coordinate of the region is farther from that of this point.
    #[inline]
    pub fn distance(&self, point: DVec3) -> f64 {
        // Three roundings, each of a unit of 2^-53 at most.
        ((point - self.frame.origin()).abs().max_element() + self.reach) * (1.0 + 2.0 * f64::EPSILON)
    }
}
