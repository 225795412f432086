//! The slab test of all boxes of a node.

use fearless_simd::{Simd, SimdMask};
use glam::{Vec3, Vec4};

use super::Lanes;
use crate::geom::slabs::directed::{is_beyond_single, reciprocals};
use crate::geom::slabs::{FromEntrance, entered_if};
use crate::geom::{Ray, Region};

/// A ray, prepared for `A` boxes at once: 4 or 8. `[LANES-1]`
///
/// The test is that of [`Directed`](crate::geom::slabs::Directed), with the near planes selected by the signs of the
/// direction, so nothing is sorted. Rays for which single precision does not suffice are tested from their entry into
/// the region, which is slower. `[BOX-9]`
#[derive(Clone, Debug)]
pub struct BoxRay<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    origin: [V; 3],
    /// Reciprocals for near planes, too small, and for far planes, too great.
    near: [V; 3],
    far: [V; 3],
    /// For each axis, the start of the near planes: at 0, those of lo, or at `A`, those of hi.
    side: [usize; 3],
    tmin: V,
    /// The numbers of the lanes, as bits.
    lanes: V,
    is_wide: bool,
    /// For wide rays. They are rare, so other rays do not store it.
    entered: Option<Box<FromEntrance>>,
}

impl<S: Simd, V: Lanes<S, A>, const A: usize> BoxRay<S, V, A> {
    /// The bits of the distance in a rank. The sign is not among them, so -0 is 0.
    const DISTANCE: u32 = (1 << 31) - A as u32;

    /// Prepares a ray. `region` must contain all boxes of the tests.
    #[inline(always)]
    pub fn new(simd: S, ray: &Ray, region: &Region) -> Self {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        // Without -0, a component of 0 has the reciprocal +inf.
        let direction = ray.direction().extend(1.0) + 0.0;
        let origin = ray.origin().extend(0.0);
        let [inverse, near, far] = reciprocals(direction);
        let is_wide = is_beyond_single(origin, direction, inverse, region);
        let backward = direction.cmplt(Vec4::ZERO);
        let side = |axis: usize| if backward.test(axis) { A } else { 0 };
        Self {
            simd,
            origin: splat(simd, ray.origin()),
            near: splat(simd, near.truncate()),
            far: splat(simd, far.truncate()),
            side: [side(0), side(1), side(2)],
            tmin: V::splat(simd, ray.tmin()),
            lanes: V::load_array(simd, lane_numbers()),
            is_wide,
            entered: entered_if(is_wide, ray, region),
        }
    }

    /// Returns the ranks of all boxes, and the set of those that are met up to `end`, which must not be negative.
    ///
    /// `planes` has for each axis the lower planes of all boxes, then the upper planes; the box of an empty lane is
    /// from plus to minus infinity. A rank is the distance at which the box is entered, rounded down to a multiple of
    /// `A` units in the last place, with the number of the lane in the free bits. `[LANES-2]`
    ///
    /// The ranks of boxes that are not met are meaningless. Ranks do not depend on `end`. A box that was met up to some
    /// other end is met up to this one if its rank, with the lane cleared, is not above it.
    #[inline(always)]
    pub fn enter(&self, planes: &[[[f32; A]; 2]; 3], end: f32) -> (V, u32) {
        if self.is_wide {
            let (ranks, set) = enter_wide(self.entered.as_deref(), planes, end);
            return (V::load_array(self.simd, ranks), set);
        }
        let [x, y, z] = self.side;
        let [near_x, near_y, near_z] = Self::distances(self.simd, planes, [x, y, z], &self.origin, &self.near);
        let opposite = [x ^ A, y ^ A, z ^ A];
        let [far_x, far_y, far_z] = Self::distances(self.simd, planes, opposite, &self.origin, &self.far);
        Self::ranked(self.simd, [near_x, near_y, near_z], self.tmin, [far_x, far_y, far_z], end, self.lanes)
    }

    /// Returns the ranks and the set, from the distances of near planes and tmin, and those of far planes. `[LANES-2]`
    #[inline(always)]
    pub(super) fn ranked(
        simd: S,
        [near_x, near_y, near_z]: [V; 3],
        tmin: V,
        [far_x, far_y, far_z]: [V; 3],
        end: f32,
        lanes: V,
    ) -> (V, u32) {
        // A near distance is never a NaN.
        let enter = near_x.max(near_y).max(near_z.max(tmin));
        let leave = lesser(far_x, lesser(far_y, lesser(far_z, V::splat(simd, end))));
        let bits = enter.min(V::splat(simd, f32::MAX)).to_bits() & Self::DISTANCE;
        let set = V::from_bits(bits).simd_le(leave).to_bitmask() as u32;
        (V::from_bits(bits | lanes.to_bits()), set)
    }

    /// Returns the distances of the planes that start at `side` on each axis, for a ray from `origin`.
    #[inline(always)]
    pub(super) fn distances(
        simd: S,
        [x, y, z]: &[[[f32; A]; 2]; 3],
        side: [usize; 3],
        origin: &[V; 3],
        inverse: &[V; 3],
    ) -> [V; 3] {
        [
            (Self::pick(simd, x, side[0]) - origin[0]) * inverse[0],
            (Self::pick(simd, y, side[1]) - origin[1]) * inverse[1],
            (Self::pick(simd, z, side[2]) - origin[2]) * inverse[2],
        ]
    }

    /// Returns the planes of an axis that start at 0, those of lo, or at `A`, those of hi.
    #[inline(always)]
    fn pick(simd: S, planes: &[[f32; A]; 2], side: usize) -> V {
        let (planes, from) = (planes.as_flattened(), side & A);
        V::from_slice(simd, &planes[from..from + A])
    }
}

/// Returns the ranks and the set of boxes that are tested two by two, from their entries.
pub(super) fn ranked_by_pairs<const A: usize>(
    planes: &[[[f32; A]; 2]; 3],
    end: f32,
    enter: impl Fn(&[[f32; 4]; 3]) -> [Option<f32>; 2],
) -> ([f32; A], u32) {
    let (mut ranks, mut set) = (lane_numbers(), 0);
    for first in (0..A).step_by(2) {
        let pair = planes.map(|[lo, hi]| [lo[first], hi[first], lo[first + 1], hi[first + 1]]);
        for (lane, near) in (first..).zip(enter(&pair)) {
            // Tests of two boxes sort the planes, so they meet empty boxes.
            let is_empty = planes.iter().any(|[lo, hi]| lo[lane] > hi[lane]);
            let Some(near) = near.filter(|_| !is_empty) else { continue };
            let bits = near.min(f32::MAX).to_bits() & !(A as u32 - 1) & !(1 << 31);
            set |= u32::from(f32::from_bits(bits) <= end) << lane;
            ranks[lane] = f32::from_bits(bits | lane as u32);
        }
    }
    (ranks, set)
}

/// Broadcasts each component to all lanes.
#[inline(always)]
pub(super) fn splat<S: Simd, V: Lanes<S, A>, const A: usize>(simd: S, v: Vec3) -> [V; 3] {
    [V::splat(simd, v.x), V::splat(simd, v.y), V::splat(simd, v.z)]
}

/// Returns the lesser number in each lane; that of `b`, which is not a NaN, if `a` is one.
///
/// On x86, the level's `min` is the instruction that gives `b` for any NaN. On other targets `min` may give the NaN,
/// and `min_precise` is one instruction.
#[inline(always)]
fn lesser<S: Simd, V: Lanes<S, A>, const A: usize>(a: V, b: V) -> V {
    if cfg!(any(target_arch = "x86", target_arch = "x86_64")) { a.min(b) } else { a.min_precise(b) }
}

/// Returns the numbers of the lanes, as bits.
pub(super) const fn lane_numbers<const A: usize>() -> [f32; A] {
    let mut lanes = [0.0; A];
    let mut i = 0;
    while i < A {
        lanes[i] = f32::from_bits(i as u32);
        i += 1;
    }
    lanes
}

/// Tests from the entry of a ray into the region. Nothing points into a [`BoxRay`], so it can be in registers.
/// `[BOX-9]`
#[cold]
#[inline(never)]
fn enter_wide<const A: usize>(
    entered: Option<&FromEntrance>,
    planes: &[[[f32; A]; 2]; 3],
    end: f32,
) -> ([f32; A], u32) {
    ranked_by_pairs(planes, end, |pair| {
        entered.map_or([None; 2], |entered| entered.pair(pair)).map(|met| met.map(|[near, _]| near))
    })
}

#[cfg(test)]
mod tests;
