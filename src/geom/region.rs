//! What the tests of a ray need to know of the scene as a whole.

use glam::{DVec3, Vec3, Vec4};

use super::frame::power_of_two;
use super::{Aabb, Frame};

/// Extents of the part of space that holds all boxes and triangles which a ray is tested against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    reach: f64,
    size: f64,
    bounds: Aabb,
    /// Its greatest magnitude of a coordinate, in the frame.
    reach_in_frame: f32,
    near: Near,
    frame: Frame,
}

/// Of which rays single precision tells enough, in the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Near {
    /// Of the box, and 0.
    middle: Vec4,
    /// What is farther from there on some axis is far.
    far: f32,
    /// Of shorter directions, distances to what is in the box from what is not far may overflow, or a component of 0 may be
    /// taken for one that counts. Infinity in the last lane.
    short: Vec4,
}

/// A direction is short, too, if all its components are below this: slab tests in single precision take a component of 0
/// for one of 2^-128 or 2^-126, so the others would not be so many times greater that it does not matter.
pub(super) const SHORT: f64 = power_of_two(-102);

/// A point is far if it is so many times the longest edge of the box away from its middle.
const FAR: f64 = 8192.0;

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
        let size = size.max_element();
        Self {
            reach: reach * unit,
            size: size * unit,
            bounds: *aabb,
            reach_in_frame: reach as f32,
            near: near_of(aabb, size),
            frame,
        }
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
        self.reach_in_frame
    }

    /// The middle of the box, in the frame; how far from there, on each axis, single precision tells enough of what is
    /// in the box; and what a component of a direction must be at least.
    #[inline(always)]
    pub(super) fn near(&self) -> [Vec4; 3] {
        let Near { middle, far, short } = self.near;
        [middle, Vec4::splat(far), short]
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

    /// Whether a point is so far away on some axis that single precision tells little of the boxes, or by so much off.
    #[inline]
    pub(super) fn is_far(&self, point: DVec3, off: f64) -> bool {
        let unit = power_of_two(self.frame.exponent());
        let middle = (self.bounds.lo.as_dvec3() + self.bounds.hi.as_dvec3()) * (0.5 * unit) + self.frame.origin();
        let is_far = (point - middle).abs().max_element() > FAR * self.size || off > self.size / FAR;
        // From what has no size all is far, and nothing can be done about it.
        is_far && self.size > 0.0 && self.size < f64::INFINITY
    }

    /// The lower and the upper side of the box on each axis, out of the frame: all in it is between. Finite.
    pub(super) fn sides(&self) -> [[f64; 3]; 2] {
        let sides = self.frame.leave(&self.bounds).map(|x| x.ends());
        // Nothing in the region is beyond the greatest double.
        [sides.map(|[lo, _]| lo.max(f64::MIN)), sides.map(|[_, hi]| hi.min(f64::MAX))]
    }

    /// No coordinate of the region is farther from that of this point.
    #[inline]
    pub fn distance(&self, point: DVec3) -> f64 {
        // Three roundings, each of a unit of 2^-53 at most.
        ((point - self.frame.origin()).abs().max_element() + self.reach) * (1.0 + 2.0 * f64::EPSILON)
    }
}

fn near_of(aabb: &Aabb, size: f64) -> Near {
    if aabb.lo.cmpgt(aabb.hi).any() {
        // From an empty box nothing is far.
        return Near { middle: Vec4::ZERO, far: f32::INFINITY, short: Vec4::ZERO };
    }
    let far = (FAR * size).min(f64::from(f32::MAX));
    // Coordinates are at most 2^126.
    let longest = (far + size).min(power_of_two(127));
    let short = Vec3::splat(((longest / f64::from(f32::MAX)) as f32).max(SHORT as f32)).extend(f32::INFINITY);
    Near { middle: (aabb.lo * 0.5 + aabb.hi * 0.5).extend(0.0), far: far as f32, short }
}
