//! A ray in double precision in the frame of the boxes, for tests of many at once.

use std::ops::RangeInclusive;

use glam::{BVec4A, DVec3, Vec4};

use super::entered::{Approach, Entered, Entry, MAX_LENGTH, MAX_UNIT};
use super::slabs64::{BEYOND, LEAST};
use crate::geom::frame::power_of_two;
use crate::geom::region::NEAR;
use crate::geom::{Ray, Region};

/// Bounds of a ray in the frame of the boxes, from its start or from its entry into their region. `[BOX-8]`
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Framed {
    /// For near planes and for far planes: the start of the bounding ray on each axis, and the reciprocals of its
    /// direction, which are negative where it runs backward.
    pub(in crate::geom) near: [Vec4; 2],
    pub(in crate::geom) far: [Vec4; 2],
    /// The axes on which it runs backward, one bit each.
    pub(in crate::geom) backward: u32,
    /// Its start, in the units of the frame from `start` on.
    pub(in crate::geom) tmin: f32,
    /// The units in a distance of 1, at least; and the start in them.
    pub(in crate::geom) unit: f64,
    pub(in crate::geom) start: f64,
}

/// An upper bound of the distance to the next float, relative to a number.
const STEP: f32 = f32::EPSILON;

/// Greater than all underflow, and negligible against a region.
const TINY: f32 = f32::from_bits((127 - 120) << 23);

/// Factors of a reciprocal: near planes are met no later, and far planes no sooner. `[BOX-2]`
const PARTS: [f32; 2] = [1.0 - 2.0 * f32::EPSILON, 1.0 + 4.0 * f32::EPSILON];

impl Framed {
    /// Every plane is behind this ray.
    pub(in crate::geom) const MISSING: Self = Self {
        near: [Vec4::ZERO, Vec4::ONE],
        far: [Vec4::INFINITY, Vec4::ONE],
        backward: 0,
        tmin: 0.0,
        unit: 1.0,
        start: 0.0,
    };

    /// Returns whether rays that start near a region need not be moved.
    #[inline(always)]
    pub(in crate::geom) fn has_near_rays(region: &Region) -> bool {
        USUAL.contains(&region.reach_in_frame())
    }

    /// Transforms a ray into the frame. If doubles do not suffice, [`Entered`] tests box by box.
    #[inline(always)]
    pub(in crate::geom) fn new(ray: &Ray<DVec3>, region: &Region) -> Result<Self, Box<Entered>> {
        let (origin, reach) = (region.frame().rounded(ray.origin()), region.reach_in_frame());
        // For a subnormal direction this is too small to be in the range.
        let length = (ray.direction().abs().max_element().to_bits() >> 52) as i32 - 1023;
        let exponent = region.frame().exponent() - length;
        let is_near = origin.abs().max_element() <= NEAR * f64::from(reach);
        let is_within = length.abs() <= MAX_LENGTH && exponent.abs() <= MAX_UNIT;
        if !(is_near && is_within && Self::has_near_rays(region)) {
            return Self::afar(ray, region);
        }
        let direction = ray.direction() * power_of_two(-length);
        let unit = power_of_two(-exponent);
        // Less than the exact number, by a factor and by the underflow.
        let tmin = (ray.tmin() * unit * LESS - LEAST) as f32;
        Ok(Self { tmin: tmin.clamp(0.0, f32::MAX), unit: unit * BEYOND, ..Self::near_region(origin, direction) })
    }

    /// Creates bounds from the rounded coordinates of a near origin, and a direction.
    #[inline(always)]
    fn near_region(origin: DVec3, direction: DVec3) -> Self {
        let (o, d) = (single(origin), single(direction));
        // An origin takes one rounding in the frame, and half a float here. The ends are also rounded, so they are at
        // least a float away.
        let off = o.abs() * STEP + TINY;
        let is_zero = BVec4A::new(direction.x == 0.0, direction.y == 0.0, direction.z == 0.0, true);
        let (speed, turned) = (d.abs(), Vec4::select(is_zero, Vec4::ZERO, d.abs() * STEP + TINY));
        Self::within([o - off, o + off], d, [(speed - turned).max(Vec4::ZERO), speed + turned])
    }

    /// Creates bounds from those of the origin, the signs of a direction, and bounds of its magnitudes.
    #[inline(always)]
    fn within([least, most]: [Vec4; 2], direction: Vec4, [slowest, fastest]: [Vec4; 2]) -> Self {
        let normal = Vec4::splat(f32::MIN_POSITIVE);
        let near = (Vec4::ONE / fastest.max(normal)) * PARTS[0];
        let far = (Vec4::ONE / slowest.max(normal)) * PARTS[1];
        let far = Vec4::select(slowest.cmplt(normal), Vec4::INFINITY, far);
        let backward = Vec4::ONE.copysign(direction).cmplt(Vec4::ZERO);
        Self {
            near: [Vec4::select(backward, least, most), near.copysign(direction)],
            far: [Vec4::select(backward, most, least), far.copysign(direction)],
            backward: backward.bitmask(),
            ..Self::MISSING
        }
    }

    #[cold]
    #[inline(never)]
    fn afar(ray: &Ray<DVec3>, region: &Region) -> Result<Self, Box<Entered>> {
        match Approach::of(ray, region) {
            Approach::Misses => Ok(Self::MISSING),
            Approach::Enters(Entry { origin, direction, start, exponent }) => {
                let backward = ray.direction().cmplt(DVec3::ZERO);
                let speed = [0, 1, 2].map(|k| if backward.test(k) { -direction[k] } else { direction[k] });
                // A component that underflows keeps its sign.
                let signs = DVec3::select(backward, DVec3::NEG_ONE, DVec3::ONE);
                let [origin, speed] = [origin, speed].map(|bounds| {
                    let ends = bounds.map(|x| x.ends_in_single());
                    [0, 1].map(|end| Vec4::new(ends[0][end], ends[1][end], ends[2][end], 0.0))
                });
                let unit = power_of_two(-exponent) * BEYOND;
                Ok(Self { unit, start, ..Self::within(origin, single(signs), speed) })
            }
            Approach::Unknown => Err(Box::new(Entered::slowly(ray, region))),
        }
    }

    /// Returns an upper bound of the reported distance of any box with a hit whose distance rounds to at most `t`.
    #[inline(always)]
    pub(in crate::geom) fn end(unit: f64, start: f64, t: f64) -> f32 {
        let end = t * unit - start;
        // No distance in the region is beyond the greatest float.
        ((end + LEAST) as f32).clamp(0.0, f32::MAX)
    }
}

/// Coordinates of a region that are neither huge nor tiny.
const USUAL: RangeInclusive<f32> = power_of_two(-60) as f32..=power_of_two(60) as f32;

/// A number times this, rounded to single precision, is below the number.
const LESS: f64 = 1.0 - f32::EPSILON as f64;

#[inline(always)]
fn single(v: DVec3) -> Vec4 {
    Vec4::new(v.x as f32, v.y as f32, v.z as f32, 0.0)
}
