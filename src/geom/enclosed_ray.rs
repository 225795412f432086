//! A ray that is known within bounds only.

use glam::DVec3;

use super::{Interval, Ray, Vector};

/// Bounds of the origin and of the direction of a ray: what is known of it in the space of an object that is placed by
/// maps whose inverses are no floats.
///
/// Nothing is said about how the true components depend on each other. `[INST-3]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnclosedRay {
    /// Where `t` is 0.
    pub origin: [Interval; 3],
    /// What `t` is measured in.
    pub direction: [Interval; 3],
}

impl EnclosedRay {
    /// Exactly this ray.
    pub fn exact<V: Vector>(ray: &Ray<V>) -> Self {
        let exact = |v: V| v.components().map(|x| Interval::exact(x.into()));
        Self { origin: exact(ray.origin()), direction: exact(ray.direction()) }
    }

    /// As [`Ray::octant`], of some ray within the bounds.
    pub fn octant(&self) -> u8 {
        let (middles, _) = Interval::middles(&self.direction);
        middles.cmplt(DVec3::ZERO).bitmask() as u8
    }
}
