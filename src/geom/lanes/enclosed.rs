//! The slab test of all boxes of a node, for a ray that is known within bounds.

use fearless_simd::Simd;

use super::Lanes;
use super::boxes::{BoxRay, lane_numbers, ranked_by_pairs};
use crate::geom::slabs::{EnclosedSlabs, Slabs};

/// A ray that is known within bounds, prepared for `A` boxes at once: 4 or 8. `[INST-4]`
///
/// The test is that of [`EnclosedSlabs`], with the near planes picked by the signs of the direction, so that nothing is
/// sorted. What it tests in double precision is tested so, box by box.
#[derive(Clone, Copy, Debug)]
pub struct EnclosedBoxes<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    /// For near planes and for far planes: where the ray that bounds it starts, and the reciprocal of its direction.
    near: [[V; 2]; 3],
    far: [[V; 2]; 3],
    /// Of each axis, where the near planes begin: at 0, those of lo, or at `A`, those of hi.
    side: [usize; 3],
    tmin: V,
    /// The numbers of the lanes, as bits.
    lanes: V,
    slabs: EnclosedSlabs,
}

impl<S: Simd, V: Lanes<S, A>, const A: usize> EnclosedBoxes<S, V, A> {
    /// Prepares a ray.
    #[inline(always)]
    pub fn new(simd: S, slabs: EnclosedSlabs) -> Self {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        let [x, y, z] = slabs.axes();
        let ((near_x, far_x, side_x), (near_y, far_y, side_y), (near_z, far_z, side_z)) =
            (sides(simd, x), sides(simd, y), sides(simd, z));
        Self {
            simd,
            near: [near_x, near_y, near_z],
            far: [far_x, far_y, far_z],
            side: [side_x, side_y, side_z],
            tmin: V::splat(simd, slabs.tmin()),
            lanes: V::load_array(simd, lane_numbers()),
            slabs,
        }
    }

    /// What [`BoxRay::enter`](super::BoxRay::enter) gives: the ranks of all boxes, and the set of those that any ray
    /// within the bounds meets up to `end`.
    #[inline(always)]
    pub fn enter(&self, planes: &[[[f32; A]; 2]; 3], end: f32) -> (V, u32) {
        if self.slabs.is_wide() {
            let (ranks, set) = enter_wide(&self.slabs, planes, end);
            return (V::load_array(self.simd, ranks), set);
        }
        let (side, near, far) = (&self.side, &self.near, &self.far);
        let near_x = self.distance(planes, 0, side[0], near);
        let near_y = self.distance(planes, 1, side[1], near);
        let near_z = self.distance(planes, 2, side[2], near);
        let far_x = self.distance(planes, 0, side[0] ^ A, far);
        let far_y = self.distance(planes, 1, side[1] ^ A, far);
        let far_z = self.distance(planes, 2, side[2] ^ A, far);
        let (near, far) = ([near_x, near_y, near_z, self.tmin], [far_x, far_y, far_z]);
        BoxRay::ranked(self.simd, near, far, end, self.lanes)
    }

    #[inline(always)]
    fn distance(&self, planes: &[[[f32; A]; 2]; 3], axis: usize, side: usize, lines: &[[V; 2]; 3]) -> V {
        let [origin, inverse] = lines[axis];
        (BoxRay::<S, V, A>::pick(self.simd, &planes[axis], side) - origin) * inverse
    }
}

/// What near and far planes of an axis need, and where the near ones begin.
#[inline(always)]
fn sides<S: Simd, V: Lanes<S, A>, const A: usize>(simd: S, [lo, hi]: [[f32; 2]; 2]) -> ([V; 2], [V; 2], usize) {
    let [_, inverse] = lo;
    // Where the ray runs backward, it meets the upper planes first.
    let (near, far, side) = if inverse < 0.0 { (hi, lo, A) } else { (lo, hi, 0) };
    let splat = |[origin, inverse]: [f32; 2]| [V::splat(simd, origin), V::splat(simd, inverse)];
    (splat(near), splat(far), side)
}

/// The test in double precision, two boxes at a time.
#[cold]
#[inline(never)]
fn enter_wide<const A: usize>(slabs: &EnclosedSlabs, planes: &[[[f32; A]; 2]; 3], end: f32) -> ([f32; A], u32) {
    ranked_by_pairs(planes, end, |pair| {
        let met = slabs.pair(pair, f32::INFINITY);
        [0, 1].map(|i| met.hit[i].then_some(met.near[i]))
    })
}

#[cfg(test)]
mod tests;
