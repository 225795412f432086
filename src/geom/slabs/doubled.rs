//! The slab test in double precision.

use glam::DVec3;

use super::{Intervals, STRICT_STEPS};

/// [`Directed`](super::Directed) in double precision, for a ray whose origin may be known within bounds. `[BOX-6]`
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubled {
    /// For lo and for hi: the greatest and the least origin.
    pub(super) origin: [DVec3; 2],
    /// Reciprocals for lo and for hi.
    pub(super) inverse: [DVec3; 2],
}

impl Doubled {
    /// Prepares a ray, by its greatest and least origin.
    pub(super) fn new(origin: [DVec3; 2], direction: DVec3) -> Self {
        let steps = u64::from(STRICT_STEPS);
        // Without -0, a component of 0 has the reciprocal +inf.
        let inverse = (direction + 0.0).recip();
        let near = inverse.map(|i| f64::from_bits(i.to_bits() - steps));
        let far = inverse.map(|i| if i.is_finite() { f64::from_bits(i.to_bits() + steps) } else { i });
        let backward = direction.cmplt(DVec3::ZERO);
        let inverse = [DVec3::select(backward, far, near), DVec3::select(backward, near, far)];
        Self { origin, inverse }
    }

    /// Two boxes at once, from distance 0 on, as [`Slabs::pair`](super::Slabs::pair).
    pub(super) fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        let (mut near, mut far) = ([0.0; 2], [tmax; 2]);
        for axis in 0..3 {
            let [lo, hi] = self.inverse.map(|inverse| inverse[axis]);
            let [most, least] = self.origin.map(|origin| origin[axis]);
            for side in 0..2 {
                let t1 = (f64::from(planes[axis][2 * side]) - most) * lo;
                let t2 = (f64::from(planes[axis][2 * side + 1]) - least) * hi;
                // A NaN is dropped, as in the other forms.
                let (first, last) = (if t2 < t1 { t2 } else { t1 }, if t1 > t2 { t1 } else { t2 });
                near[side] = if first > near[side] { first } else { near[side] };
                far[side] = if last < far[side] { last } else { far[side] };
            }
        }
        Intervals { hit: [0, 1].map(|side| near[side] <= far[side]), near, far }
    }
}
