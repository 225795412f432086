//! A ray that is known only within bounds.

use glam::DVec3;

use super::slabs::{Approach, entry};
use super::truth::{Relaxed, touch};
use super::{Interval, Ray, Region, Vector};

/// Bounds of the origin and of the direction of a ray, in the space of an object whose inverse maps are not exact in
/// floats.
///
/// They are independent: they state no relation between the true components. `[INST-3]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnclosedRay {
    /// The point at which `t` is [`start`](Self::start).
    pub origin: [Interval; 3],
    /// The unit of `t`.
    pub direction: [Interval; 3],
    /// The distance of the origin: 0, or the entry of a distant ray into a region that contains all further tests.
    /// `[INST-7]`
    pub start: Interval,
}

impl EnclosedRay {
    /// Creates the bounds of a ray with `start` 0.
    pub const fn new(origin: [Interval; 3], direction: [Interval; 3]) -> Self {
        Self { origin, direction, start: Interval::exact(0.0) }
    }

    /// Creates bounds that contain exactly this ray.
    pub fn exact<V: Vector>(ray: &Ray<V>) -> Self {
        let exact = |v: V| v.components().map(|x| Interval::exact(x.into()));
        Self::new(exact(ray.origin()), exact(ray.direction()))
    }

    /// Returns [`Ray::octant`] of some ray within the bounds.
    pub fn octant(&self) -> u8 {
        let (middles, _) = Interval::middles(&self.direction);
        middles.cmplt(DVec3::ZERO).bitmask() as u8
    }

    /// Returns whether single precision, or the bounds of the origin, are coarser than the boxes of a region.
    #[inline]
    pub(crate) fn is_far(&self, region: &Region) -> bool {
        let (origin, off) = Interval::middles(&self.origin);
        region.is_far(origin, off)
    }

    /// Moves the ray to its entry into a region, in doubles. `[INST-7]`
    pub(crate) fn approach(&self, region: &Region) -> Approach<Self> {
        let Self { origin, direction, .. } = region.frame().ray(self);
        let Some(by) = entry(region, &origin, &direction, 0.0) else { return Approach::Misses };
        let by = Interval::exact(by);
        let origin = [0, 1, 2].map(|k| self.origin[k] + by * self.direction[k]);
        let moved = Self { origin, start: self.start + by, ..*self };
        if moved.is_far(region) { Approach::Unknown } else { Approach::Enters(moved) }
    }

    /// Returns the ray from its entry into a region, for a line that is known exactly, as numbers over a common
    /// denominator.
    pub(super) fn of_line(line: &[[Relaxed; 3]; 2], region: &Region) -> Option<Self> {
        let [o, d] = line;
        let start = touch(o, d, region.sides())?;
        let origin = [0, 1, 2].map(|k| Interval::around(&(&o[k] + &start * &d[k])));
        Some(Self { origin, direction: d.each_ref().map(Interval::around), start: Interval::around(&start) })
    }
}

#[cfg(test)]
mod tests;
