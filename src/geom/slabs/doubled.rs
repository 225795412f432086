//! The slab test in double precision, for rays and boxes that single precision cannot take.

use glam::DVec3;

use super::{Intervals, STRICT_STEPS};

/// As [`Directed`](super::Directed), in double precision: for rays in single precision that it cannot take, and for
/// boxes beyond 2^126. Nothing over- or underflows where numbers are 0 or within 2^-400 to 2^400. `[BOX-6]`
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Doubled {
    origin: DVec3,
    /// Reciprocals for lo and for hi.
    inverse: [DVec3; 2],
    tmin: f64,
}

impl Doubled {
    /// Prepares a ray.
    pub(in crate::geom) fn new(origin: DVec3, direction: DVec3, tmin: f64) -> Self {
        let steps = u64::from(STRICT_STEPS);
        // Without -0, a component of 0 has the reciprocal +inf.
        let inverse = (direction + 0.0).recip();
        let near = inverse.map(|i| f64::from_bits(i.to_bits() - steps));
        let far = inverse.map(|i| if i.is_finite() { f64::from_bits(i.to_bits() + steps) } else { i });
        let backward = direction.cmplt(DVec3::ZERO);
        let inverse = [DVec3::select(backward, far, near), DVec3::select(backward, near, far)];
        Self { origin, inverse, tmin }
    }

    /// Two boxes at once, as [`Slabs::pair`](super::Slabs::pair).
    pub(in crate::geom) fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
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
        Intervals { hit: [0, 1].map(|side| near[side] <= far[side]), near, far }
    }
}
