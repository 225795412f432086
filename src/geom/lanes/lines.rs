//! The slab test of all boxes of a node by lines that bound a ray.

use fearless_simd::Simd;

use super::Lanes;
use super::boxes::{BoxRay, lane_numbers};

/// Lines that bound a ray from both sides, prepared for `A` boxes at once: 4 or 8. `[INST-4]`
///
/// The near planes are picked by the signs of the direction, so that nothing is sorted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    /// For near planes and for far planes: where the line starts, and the reciprocal of its direction.
    near: [[V; 2]; 3],
    far: [[V; 2]; 3],
    /// Of each axis, where the near planes begin: at 0, those of lo, or at `A`, those of hi.
    side: [usize; 3],
    tmin: V,
    /// The numbers of the lanes, as bits.
    lanes: V,
}

/// Of an axis, for near and for far planes, where the line starts, and the reciprocal of its direction; and whether that
/// runs backward.
pub(super) type Line = ([[f32; 2]; 2], bool);

impl<S: Simd, V: Lanes<S, A>, const A: usize> Lines<S, V, A> {
    #[inline(always)]
    pub(super) fn new(simd: S, [x, y, z]: [Line; 3], tmin: f32) -> Self {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        let splat = |[origin, inverse]: [f32; 2]| [V::splat(simd, origin), V::splat(simd, inverse)];
        // Where the ray runs backward, it meets the upper planes first.
        let side = |is_backward: bool| if is_backward { A } else { 0 };
        let ([[near_x, far_x], [near_y, far_y], [near_z, far_z]], tmin) = ([x.0, y.0, z.0], V::splat(simd, tmin));
        Self {
            simd,
            near: [splat(near_x), splat(near_y), splat(near_z)],
            far: [splat(far_x), splat(far_y), splat(far_z)],
            side: [side(x.1), side(y.1), side(z.1)],
            tmin,
            lanes: V::load_array(simd, lane_numbers()),
        }
    }

    /// As [`BoxRay::enter`].
    #[inline(always)]
    pub(super) fn enter(&self, planes: &[[[f32; A]; 2]; 3], end: f32) -> (V, u32) {
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
