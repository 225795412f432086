//! The slab test of rays in double precision.

use glam::{DVec3, Vec4};

use super::directed::MAX_COORDINATE;
use super::{Doubled, Intervals, Slabs, near_and_far};
use crate::geom::frame::{exponent_of, power_of_two};
use crate::geom::{Interval, Ray, Region};

/// Floats by which a reciprocal is moved: one more than for rays in single precision, so that a near distance is below
/// the exact one, and not only below the nearest float of it. `[BOX-4]`
pub const STRICT_STEPS: u32 = 3;

/// A slab test in single precision, for rays in double precision, that skips no box which the ray touches. `[BOX-8]`
///
/// The ray is taken into the [frame](crate::geom::Frame) of the boxes, and there to where it enters the region of all
/// boxes. So single precision is as fine as the boxes are, wherever the ray begins. What rounding moves is enclosed: for
/// lower planes the ray begins at the greatest origin that it may have, and for upper planes at the least, as in
/// [`EnclosedSlabs`](super::EnclosedSlabs); so it takes the same instructions for a box as rays in single precision do.
///
/// Where the direction leaves 2^-1000 to 2^1000, or the unit of distance in the frame leaves 2^-800 to 2^800, no box is
/// skipped.
#[derive(Clone, Copy, Debug)]
pub struct Wide {
    /// Greatest and least origin, in the lanes of lo and hi, twice.
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Where the ray enters the region, in the units of distance of the lanes.
    start: f64,
    /// Those units of distance, and their reciprocal.
    unit: [f64; 2],
    is_slow: bool,
    ray: Ray<DVec3>,
    region: Region,
}

/// The greatest component of a direction is within 2^-1000 to 2^1000.
const MAX_LENGTH: i32 = 1000;

/// Units are within 2^-800 to 2^800: then distances that are the least of single precision in the one are normal
/// doubles in the other, and those that are not normal in the other are nothing in the one.
const MAX_UNIT: i32 = 800;

/// What an end is moved by, in parts of itself: at least to the next double.
const BEYOND: f64 = 1.0 + f64::EPSILON;

/// The least number of single precision, 2^-149.
const LEAST: f64 = f64::from_bits((1023 - 149) << 52);

impl Slabs for Wide {
    type Vector = DVec3;

    fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        let slow = Self {
            origin: [Vec4::ZERO; 3],
            inverse: [Vec4::ZERO; 3],
            start: 0.0,
            unit: [1.0; 2],
            is_slow: true,
            ray: *ray,
            region: *region,
        };
        slow.in_lanes().unwrap_or(slow)
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        if self.is_slow {
            return self.pair_slow(planes, tmax);
        }
        let Intervals { hit, near, far } =
            Intervals::of_lanes(near_and_far(planes, &self.origin, &self.inverse, 0.0, self.end(tmax)));
        // Where a product underflows, it is off by less than the least number.
        let near = near.map(|near| self.distance(f64::from(near) - LEAST).max(self.ray.tmin()));
        let far = far.map(|far| self.distance(f64::from(far) + LEAST).min(tmax));
        Intervals { hit, near, far }
    }
}

impl Wide {
    /// The ray in the frame, where it enters the region; `None` where that leaves the range.
    fn in_lanes(self) -> Option<Self> {
        let Self { ray, region, .. } = self;
        let (frame, direction) = (region.frame(), ray.direction());
        let length = exponent_of(direction.abs().max_element());
        let exponent = length - frame.exponent();
        if length.abs() > MAX_LENGTH || exponent.abs() > MAX_UNIT || region.reach_in_frame() > MAX_COORDINATE {
            return None;
        }
        let origin = [0, 1, 2].map(|axis| frame.coordinate(axis, ray.origin()[axis]));
        let direction = direction.to_array().map(|d| Interval::exact(d).scaled(-length));
        // Nothing is rounded here unless it underflows, and then it is above.
        let tmin = ray.tmin() * power_of_two(exponent);
        let tmin = if tmin < f64::MIN_POSITIVE { 0.0 } else { tmin };
        let Some(start) = entry(&region, &origin, &direction, tmin) else {
            // Every plane is behind.
            return Some(Self { origin: [Vec4::INFINITY; 3], inverse: [Vec4::ONE; 3], is_slow: false, ..self });
        };
        let origin = [0, 1, 2].map(|axis| origin[axis] + Interval::exact(start) * direction[axis]);
        let lanes = [0, 1, 2].map(|axis| lanes(origin[axis], direction[axis], ray.direction()[axis] < 0.0));
        let is_near = |o: &f32| o.abs() <= MAX_COORDINATE;
        if !(start.is_finite() && lanes.iter().all(|[origin, _]| origin.iter().all(is_near))) {
            return None;
        }
        let twice = |[lo, hi]: [f32; 2]| Vec4::new(lo, hi, lo, hi);
        Some(Self {
            origin: lanes.map(|[origin, _]| twice(origin)),
            inverse: lanes.map(|[_, inverse]| twice(inverse)),
            start,
            unit: [power_of_two(-exponent), power_of_two(exponent)],
            is_slow: false,
            ..self
        })
    }

    /// A distance, given in units of the lanes from the start on.
    #[inline(always)]
    fn distance(&self, from_start: f64) -> f64 {
        (from_start + self.start) * self.unit[0]
    }

    /// At least what is told of any box that a hit whose distance rounds to at most `tmax` is in.
    #[inline(always)]
    fn end(&self, tmax: f64) -> f32 {
        let end = tmax * (self.unit[1] * BEYOND) - self.start;
        // Nothing in the region is beyond the greatest float.
        ((end + LEAST) as f32).min(f32::MAX)
    }

    /// Boxes and rays that are so rare that a ray is prepared anew each time.
    #[cold]
    #[inline(never)]
    fn pair_slow(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        let Self { ray, region, .. } = self;
        let is_usual = |x: f64| x == 0.0 || (2f64.powi(-400)..=2f64.powi(400)).contains(&x.abs());
        let numbers = [ray.origin(), ray.direction(), region.frame().origin()].map(|v| v.to_array());
        if region.frame().is_identity() && numbers.iter().flatten().chain([&ray.tmin()]).all(|&x| is_usual(x)) {
            return Doubled::new(ray.origin(), ray.direction(), ray.tmin()).pair(planes, tmax);
        }
        Intervals { hit: [true; 2], near: [ray.tmin(); 2], far: [tmax; 2] }
    }
}

/// Where a ray enters the region, or before that; not before `tmin`. `None` if it surely misses the region.
fn entry(region: &Region, origin: &[Interval; 3], direction: &[Interval; 3], tmin: f64) -> Option<f64> {
    let aabb = region.bounds();
    let (mut start, mut end) = (tmin, f64::INFINITY);
    for axis in 0..3 {
        let ([least, most], [slowest, fastest]) = (origin[axis].ends(), direction[axis].ends());
        let (lo, hi) = (f64::from(aabb.lo[axis]), f64::from(aabb.hi[axis]));
        // least + t fastest >= lo where it comes from below, and the same with all signs changed.
        for (way, speed) in [(lo - most, fastest), (least - hi, -slowest)] {
            if way > 0.0 && speed > 0.0 {
                start = start.max((way.next_down() / speed).next_down());
            } else if way.next_down() > 0.0 {
                return None;
            }
        }
        // least + t slowest <= hi where it leaves there, and likewise.
        for (way, speed) in [(hi - least, slowest), (most - lo, -fastest)] {
            if speed > 0.0 {
                end = end.min((way.next_up() / speed).next_up());
            }
        }
    }
    (start <= end).then_some(start)
}

/// For the lower and the upper plane of an axis: where the ray starts, and the reciprocal of its direction.
fn lanes(origin: Interval, direction: Interval, is_backward: bool) -> [[f32; 2]; 2] {
    let [o_least, mut o_most] = origin.ends_in_single();
    let speed = if is_backward { -direction } else { direction };
    let [slowest, fastest] = speed.ends_in_single();
    let steps = STRICT_STEPS;
    let near = f32::from_bits(fastest.max(f32::MIN_POSITIVE).recip().to_bits() - steps);
    let mut far = f32::INFINITY;
    if slowest >= f32::MIN_POSITIVE {
        far = f32::from_bits(slowest.recip().to_bits() + steps);
    } else if is_backward {
        // The far plane is the lower one, where 0 times infinity would count for the near one.
        o_most = o_most.next_up();
    }
    [[o_most, o_least], if is_backward { [-far, -near] } else { [near, far] }]
}

#[cfg(test)]
mod tests;
