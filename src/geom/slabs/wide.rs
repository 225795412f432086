//! The slab test in double precision.

use glam::DVec3;

use super::{Intervals, Slabs};
use crate::geom::{Ray, Region};

/// Floats by which a reciprocal is moved: one more than in single precision, so that a near distance is below the exact
/// one, and not only below the nearest double of it. `[BOX-6]`
pub const STRICT_STEPS: u32 = 3;

/// As [`Directed`](super::Directed), in double precision: for rays in double precision, and for those in single
/// precision that [`Directed`](super::Directed) cannot take. `[BOX-6]`
///
/// With rays in single precision nothing over- or underflows, so that every ray is served. For rays in double
/// precision whose coordinates or direction leave 2^-400 to 2^400, no box is skipped.
#[derive(Clone, Copy, Debug)]
pub struct Wide {
    origin: DVec3,
    /// Reciprocals for lo and for hi.
    inverse: [DVec3; 2],
    tmin: f64,
    skips: bool,
}

impl Wide {
    /// Prepares a ray whose numbers are within the range for which the test skips boxes.
    pub(in crate::geom) fn of(origin: DVec3, direction: DVec3, tmin: f64) -> Self {
        // Without -0, a component of 0 has the reciprocal +inf.
        let inverse = (direction + 0.0).recip();
        let near = inverse.map(|i| f64::from_bits(i.to_bits() - u64::from(STRICT_STEPS)));
        let far =
            inverse.map(|i| if i.is_finite() { f64::from_bits(i.to_bits() + u64::from(STRICT_STEPS)) } else { i });
        let backward = direction.cmplt(DVec3::ZERO);
        let inverse = [DVec3::select(backward, far, near), DVec3::select(backward, near, far)];
        Self { origin, inverse, tmin, skips: true }
    }
}

impl Slabs for Wide {
    type Vector = DVec3;

    fn new(ray: &Ray<DVec3>, _: &Region) -> Self {
        let usual = |x: f64| x == 0.0 || (2f64.powi(-400)..=2f64.powi(400)).contains(&x.abs());
        let (origin, direction) = (ray.origin().to_array(), ray.direction().to_array());
        let skips = origin.into_iter().chain(direction).chain([ray.tmin()]).all(usual);
        Self { skips, ..Self::of(ray.origin(), ray.direction(), ray.tmin()) }
    }

    #[inline]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        let (mut near, mut far) = ([self.tmin; 2], [tmax; 2]);
        for axis in 0..3 {
            let [lo, hi] = self.inverse.map(|inverse| inverse[axis]);
            for side in 0..2 {
                let t1 = (f64::from(planes[axis][2 * side]) - self.origin[axis]) * lo;
                let t2 = (f64::from(planes[axis][2 * side + 1]) - self.origin[axis]) * hi;
                // A NaN is dropped, as in the other forms.
                let (first, last) = (if t2 < t1 { t2 } else { t1 }, if t1 > t2 { t1 } else { t2 });
                near[side] = if first > near[side] { first } else { near[side] };
                far[side] = if last < far[side] { last } else { far[side] };
            }
        }
        if self.skips {
            Intervals { hit: [0, 1].map(|side| near[side] <= far[side]), near, far }
        } else {
            Intervals { hit: [true; 2], near: [self.tmin; 2], far: [tmax; 2] }
        }
    }
}
