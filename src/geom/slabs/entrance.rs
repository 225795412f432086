//! Rays in single precision that must be tested from their entry into the region.

use glam::{Vec3, Vec4};

use super::entered::Entered;
use super::slabs64::lanes;
use super::{Doubled, Intervals, MAX_COORDINATE, near_and_far};
use crate::geom::frame::{exponent_of, power_of_two};
use crate::geom::{Interval, Ray, Region};

/// The entry of a ray into the region of all boxes, rounded outwards for tests in single precision. `[BOX-9]`
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Entrance {
    /// The greatest origin, and the least distance.
    most: Vec4,
    /// The least origin, and the greatest distance.
    least: Vec4,
    /// Whether single precision suffices from here on: no difference of coordinates overflows, not all distances
    /// overflow, and no reciprocal overflows.
    is_single: bool,
}

/// Returns the entrance of a ray, if single precision does not support the ray.
#[inline(always)]
pub(in crate::geom) fn enter_if(is_wide: bool, ray: &Ray, region: &Region) -> Entrance {
    if is_wide { Entrance::of(ray, region) } else { Entrance { most: Vec4::ZERO, least: Vec4::ZERO, is_single: false } }
}

/// Returns a ray from its entrance, if single precision does not support the ray.
#[inline(always)]
pub(in crate::geom) fn entered_if(is_wide: bool, ray: &Ray, region: &Region) -> Option<Box<FromEntrance>> {
    if is_wide { Some(entered(ray, region)) } else { None }
}

#[cold]
#[inline(never)]
fn entered(ray: &Ray, region: &Region) -> Box<FromEntrance> {
    Box::new(Entrance::of(ray, region).ray(ray.direction(), ray.tmin()))
}

impl Entrance {
    #[cold]
    #[inline(never)]
    fn of(ray: &Ray, region: &Region) -> Self {
        let Entered { slabs, start, .. } = Entered::new(&ray.widen(), region);
        let [most, least] = slabs.origin;
        let bounds = [0, 1, 2].map(|k| Interval::between([least[k], most[k]]).ends_in_single());
        let [start, latest] = start.ends_in_single();
        let [most, least] = [1, 0].map(|end| Vec3::from(bounds.map(|ends| ends[end])));
        let (direction, [.., short]) = (ray.direction(), region.near());
        let greatest = most.abs().max(least.abs()).max_element().max(region.reach_in_frame());
        let is_short = direction.extend(0.0).abs().cmplt(short).all();
        let is_slow = direction.cmpne(Vec3::ZERO) & direction.recip().abs().cmpge(Vec3::MAX);
        let is_single = greatest <= MAX_COORDINATE && !is_short && !is_slow.any();
        Self { most: most.extend(start), least: least.extend(latest), is_single }
    }

    /// Returns the ray from there.
    pub(in crate::geom) fn ray(self, direction: Vec3, tmin: f32) -> FromEntrance {
        let Self { most, least, is_single } = self;
        if least.x == f32::INFINITY {
            return FromEntrance::Double(Entered::MISSING);
        }
        if is_single {
            let d = direction;
            let [origin, inverse] = lanes(|k| ([least[k], most[k]], [d[k].abs(); 2], d[k] < 0.0));
            return FromEntrance::Single { origin, inverse, start: [most.w, least.w], tmin };
        }
        let (direction, start) = (direction.as_dvec3(), Interval::between([most.w, least.w].map(f64::from)));
        let length = exponent_of(direction.abs().max_element());
        let origin = [most, least].map(|o| o.truncate().as_dvec3());
        let slabs = Doubled::new(origin, direction * power_of_two(-length));
        FromEntrance::Double(Entered { slabs, start, exponent: -length, tmin: tmin.into() })
    }
}

/// A ray from its entry into the region of all boxes.
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) enum FromEntrance {
    /// In single precision.
    Single {
        /// Greatest and least origin, in the lanes of lo and hi, twice.
        origin: [Vec4; 3],
        inverse: [Vec4; 3],
        /// Bounds of the distance of the entrance.
        start: [f32; 2],
        tmin: f32,
    },
    /// In double precision.
    Double(Entered),
}

impl FromEntrance {
    /// Returns the entries and exits of the ray for two boxes, if it enters, for hits whose distances are rounded to
    /// single precision.
    ///
    /// Such a distance may be below the entry into the box. Rounding keeps the order, so entries are rounded before the
    /// comparison.
    pub(in crate::geom) fn pair(&self, planes: &[[f32; 4]; 3]) -> [Option<[f32; 2]>; 2] {
        match self {
            Self::Single { origin, inverse, start: [start, latest], tmin } => {
                let Intervals { hit, near, far } =
                    Intervals::of_lanes(near_and_far(planes, origin, inverse, 0.0, f32::INFINITY));
                // From the entrance on, distances are rounded.
                [0, 1].map(|i| {
                    let [near, far] = [start + near[i].next_down(), latest + far[i].next_up()];
                    (hit[i] && *tmin <= far).then_some([near.max(*tmin), far])
                })
            }
            Self::Double(entered) => entered.met(planes).map(|met| met.map(|ends| ends.map(|t| t as f32))),
        }
    }
}

#[cfg(test)]
mod tests;
