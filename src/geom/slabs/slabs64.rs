//! The slab test of rays in double precision.

use glam::{DVec3, Vec4};

use super::entered::{Approach, Entered, Entry};
use super::{Intervals, Slabs, near_and_far};
use crate::geom::frame::power_of_two;
use crate::geom::{Ray, Region};

/// Floats by which a reciprocal is moved: one more than for rays in single precision, so that a near distance is below
/// the exact distance, and not only below its nearest float. `[BOX-4]`
pub const STRICT_STEPS: u32 = 3;

/// A slab test in single precision, for rays in double precision, that skips no box that the ray touches. `[BOX-8]`
///
/// The ray is transformed into the [frame](crate::geom::Frame) of the boxes, and moved there to its entry into the
/// region of all boxes. So single precision is as fine as the boxes, for any start of the ray. Rounding errors are
/// enclosed: for lower planes the ray starts at its greatest possible origin, and for upper planes at the least, as in
/// [`EnclosedSlabs`](super::EnclosedSlabs). So a box takes the same instructions as for rays in single precision.
///
/// Boxes are tested in double precision, which is slow, if doubles do not determine the entry. This also applies if the
/// direction leaves 2^-1000 to 2^1000, or the unit of distance in the frame leaves 2^-800 to 2^800. `[BOX-9]`
#[derive(Clone, Copy, Debug)]
pub struct Slabs64 {
    /// Greatest and least origin, in the lanes of lo and hi, twice.
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Distance of the entry into the region, in the units of distance of the lanes.
    start: f64,
    /// Those units of distance, and their reciprocal.
    unit: [f64; 2],
    tmin: f64,
    /// The slow test.
    entered: Option<Entered>,
}

/// The factor that moves an end: at least to the next double.
pub(super) const BEYOND: f64 = 1.0 + f64::EPSILON;

/// The least number of single precision, 2^-149.
pub(super) const LEAST: f64 = f64::from_bits((1023 - 149) << 52);

impl Slabs for Slabs64 {
    type Vector = DVec3;

    fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        let (origin, inverse, tmin) = ([Vec4::INFINITY; 3], [Vec4::ONE; 3], ray.tmin());
        // Every plane is behind.
        let missing = Self { origin, inverse, start: 0.0, unit: [1.0; 2], tmin, entered: None };
        match Approach::of(ray, region) {
            Approach::Misses => missing,
            Approach::Enters(Entry { origin, direction, start, exponent }) => {
                let [origin, inverse] = lanes(|axis| {
                    let is_backward = ray.direction()[axis] < 0.0;
                    let speed = if is_backward { -direction[axis] } else { direction[axis] };
                    (origin[axis].ends_in_single(), speed.ends_in_single(), is_backward)
                });
                let unit = [exponent, -exponent].map(power_of_two);
                Self { origin, inverse, start, unit, tmin, entered: None }
            }
            Approach::Unknown => Self { entered: Some(Entered::slowly(ray, region)), ..missing },
        }
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        if let Some(entered) = self.entered {
            return pair_slow(entered, planes, tmax);
        }
        let Intervals { hit, near, far } =
            Intervals::of_lanes(near_and_far(planes, &self.origin, &self.inverse, 0.0, self.end(tmax)));
        // If a product underflows, its error is less than the least number.
        let near = near.map(|near| self.distance(f64::from(near) - LEAST).max(self.tmin));
        let far = far.map(|far| self.distance(f64::from(far) + LEAST).min(tmax));
        Intervals { hit, near, far }
    }
}

impl Slabs64 {
    /// Converts a distance from units of the lanes, from the start on.
    #[inline(always)]
    fn distance(&self, from_start: f64) -> f64 {
        (from_start + self.start) * self.unit[0]
    }

    /// Returns an upper bound of the reported distance of any box with a hit whose distance rounds to at most `tmax`.
    #[inline(always)]
    fn end(&self, tmax: f64) -> f32 {
        let end = tmax * (self.unit[1] * BEYOND) - self.start + LEAST;
        // Rounded up: the reported end of a box is here, and a hit in it may be at `tmax`.
        let rounded = end as f32;
        let end = if f64::from(rounded) < end { rounded.next_up() } else { rounded };
        // No distance in the region is beyond the greatest float.
        end.min(f32::MAX)
    }
}

/// It receives the ray by value, so nothing points into a [`Slabs64`], which then can be in registers.
#[cold]
#[inline(never)]
fn pair_slow(entered: Entered, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
    entered.pair(planes, tmax)
}

/// Returns starts and reciprocals of directions: for each axis in the lanes of lo and hi, twice. `axis` gives bounds of
/// the origin and of the speed, and whether the ray runs backward.
#[inline]
pub(super) fn lanes(axis: impl Fn(usize) -> ([f32; 2], [f32; 2], bool)) -> [[Vec4; 3]; 2] {
    let planes = [0, 1, 2].map(|k| for_planes(axis(k)));
    let twice = |[lo, hi]: [f32; 2]| Vec4::new(lo, hi, lo, hi);
    [0, 1].map(|i| planes.map(|of_planes| twice(of_planes[i])))
}

/// Returns for the lower and the upper plane of an axis the start of the ray and the reciprocal of its direction.
fn for_planes(([least, mut most], [slowest, fastest], is_backward): ([f32; 2], [f32; 2], bool)) -> [[f32; 2]; 2] {
    let steps = STRICT_STEPS;
    let near = f32::from_bits(fastest.max(f32::MIN_POSITIVE).recip().to_bits() - steps);
    let mut far = f32::INFINITY;
    if slowest >= f32::MIN_POSITIVE {
        far = f32::from_bits(slowest.recip().to_bits() + steps);
    } else if is_backward {
        // The far plane is the lower one, where 0 times infinity would apply to the near plane.
        most = most.next_up();
    }
    [[most, least], if is_backward { [-far, -near] } else { [near, far] }]
}

#[cfg(test)]
mod tests;
