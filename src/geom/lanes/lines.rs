//! The slab test of all boxes of a node by lines that bound a ray.

use fearless_simd::Simd;
use glam::Vec3;

use super::Lanes;
use super::boxes::{BoxRay, lane_numbers, splat};

/// Lines that bound a ray from both sides, prepared for `A` boxes at once: 4 or 8. `[INST-4]`
///
/// The near planes are selected by the signs of the direction, so nothing is sorted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    /// For near planes and for far planes: the start of the line on each axis, and the reciprocals of its direction.
    near: [[V; 3]; 2],
    far: [[V; 3]; 2],
    /// For each axis, the start of the near planes: at 0, those of lo, or at `A`, those of hi.
    side: [usize; 3],
    tmin: V,
    /// The numbers of the lanes, as bits.
    lanes: V,
}

impl<S: Simd, V: Lanes<S, A>, const A: usize> Lines<S, V, A> {
    /// Creates the lines from the starts for near and for far planes, and the reciprocals of their directions; and
    /// whether these run backward on each axis.
    #[inline(always)]
    pub(super) fn new(simd: S, [near, far]: [[Vec3; 2]; 2], backward: [bool; 3], tmin: f32) -> Self {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        // If the ray runs backward, it meets the upper planes first.
        let side = |axis: usize| if backward[axis] { A } else { 0 };
        Self {
            simd,
            near: [splat(simd, near[0]), splat(simd, near[1])],
            far: [splat(simd, far[0]), splat(simd, far[1])],
            side: [side(0), side(1), side(2)],
            tmin: V::splat(simd, tmin),
            lanes: V::load_array(simd, lane_numbers()),
        }
    }

    /// Computes [`BoxRay::enter`].
    #[inline(always)]
    pub(super) fn enter(&self, planes: &[[[f32; A]; 2]; 3], end: f32) -> (V, u32) {
        let ([x, y, z], [origin, inverse]) = (self.side, &self.near);
        let near = BoxRay::distances(self.simd, planes, [x, y, z], origin, inverse);
        let [origin, inverse] = &self.far;
        let far = BoxRay::distances(self.simd, planes, [x ^ A, y ^ A, z ^ A], origin, inverse);
        BoxRay::ranked(self.simd, near, self.tmin, far, end, self.lanes)
    }
}
