//! The distances of all boxes of a node from a point.

use fearless_simd::{Select, Simd, SimdMask};
use glam::Vec3;

use super::Lanes;
use super::boxes::{lane_numbers, splat};
use crate::geom::frame::power_of_two;

/// A point, prepared for the distances of `A` boxes at once: 4 or 8. `[NEAR-4]`
#[derive(Clone, Copy, Debug)]
pub struct BoxPoint<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    /// The greatest and the least position.
    most: [V; 3],
    least: [V; 3],
    /// The numbers of the lanes, as bits.
    lanes: V,
}

/// Below this, underflow may make a sum of squares wrong.
const TINY: f32 = power_of_two(-100) as f32;

/// Below this, no square is representable in any unit.
const LEAST: f32 = power_of_two(-120) as f32;

/// Units in which squares do not over- or underflow, and their reciprocals.
const UNITS: [[f32; 2]; 2] =
    [[power_of_two(-70) as f32, power_of_two(70) as f32], [power_of_two(100) as f32, power_of_two(-100) as f32]];

/// The factor 1 - 8u of a distance, which makes it a lower bound.
const LESS: f32 = 1.0 - 4.0 * f32::EPSILON;

impl<S: Simd, V: Lanes<S, A>, const A: usize> BoxPoint<S, V, A> {
    /// Prepares a point that is between two, which must be finite.
    #[inline(always)]
    pub fn new(simd: S, [least, most]: [Vec3; 2]) -> Self {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        Self { simd, most: splat(simd, most), least: splat(simd, least), lanes: V::load_array(simd, lane_numbers()) }
    }

    /// Returns the ranks of all boxes, and the set of those that may be at most `limit` away, in single precision.
    ///
    /// `planes` are those of [`BoxRay::enter`](super::BoxRay::enter). A rank is at most the distance of the box,
    /// rounded down to a multiple of `A` units in the last place, with the number of the lane in the free bits. Ranks
    /// do not depend on the limit. A box of the set of some other limit is in that of this one if its rank, with the
    /// lane cleared, is not above it.
    #[inline(always)]
    pub fn within(&self, planes: &[[[f32; A]; 2]; 3], limit: f32) -> (V, u32) {
        let all = |x: f32| V::splat(self.simd, x);
        let (zero, most) = (all(0.0), all(f32::MAX));
        let [x, y, z] = [0, 1, 2].map(
            #[inline(always)]
            |axis: usize| {
                let [lo, hi] = &planes[axis];
                let (lo, hi) = (V::load_array_ref(self.simd, lo), V::load_array_ref(self.simd, hi));
                (lo - self.most[axis]).max(self.least[axis] - hi).max(zero)
            },
        );
        let squared = |x: V, y: V, z: V| (x * x + y * y) + z * z;
        let (sum, greatest) = (squared(x, y, z), x.max(y).max(z));
        let (is_huge, is_tiny) = (sum.simd_gt(most) & greatest.simd_le(most), sum.simd_lt(all(TINY)));
        // The distance is not less than the greatest component.
        let mut distance = is_tiny.select(greatest, sum.sqrt());
        for (is_such, [unit, back]) in [is_huge, is_tiny & greatest.simd_ge(all(LEAST))].into_iter().zip(UNITS) {
            if is_such.any_true() {
                let [x, y, z] = [x, y, z].map(|x| x * all(unit));
                distance = is_such.select(squared(x, y, z).sqrt() * all(back), distance);
            }
        }
        let distance = distance.min(most) * all(LESS);
        let bits = distance.to_bits() & ((1 << 31) - A as u32);
        // The box of an empty lane is from plus to minus infinity.
        let [lo, hi] = &planes[0];
        let is_box = V::load_array_ref(self.simd, lo).simd_le(V::load_array_ref(self.simd, hi));
        let set = V::from_bits(bits).simd_le(all(limit)) & is_box;
        (V::from_bits(bits | self.lanes.to_bits()), set.to_bitmask() as u32)
    }
}

#[cfg(test)]
mod tests;
