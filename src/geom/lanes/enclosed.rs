//! The slab test of all boxes of a node, for a ray that is known within bounds.

use fearless_simd::Simd;
use glam::Vec3;

use super::Lanes;
use super::boxes::ranked_by_pairs;
use super::lines::Lines;
use crate::geom::slabs::{EnclosedSlabs, Slabs};

/// A ray that is known within bounds, prepared for `A` boxes at once: 4 or 8. `[INST-4]`
///
/// The test is that of [`EnclosedSlabs`]. Rays that it tests in double precision are tested box by box.
#[derive(Clone, Copy, Debug)]
pub struct EnclosedBoxes<S: Simd, V: Lanes<S, A>, const A: usize> {
    simd: S,
    lines: Lines<S, V, A>,
    slabs: EnclosedSlabs,
}

impl<S: Simd, V: Lanes<S, A>, const A: usize> EnclosedBoxes<S, V, A> {
    /// Prepares a ray.
    #[inline(always)]
    pub fn new(simd: S, slabs: EnclosedSlabs) -> Self {
        let [(x, is_back_x), (y, is_back_y), (z, is_back_z)] = slabs.axes().map(line);
        let part = |planes: usize, part: usize| Vec3::new(x[planes][part], y[planes][part], z[planes][part]);
        let lines = [[part(0, 0), part(0, 1)], [part(1, 0), part(1, 1)]];
        Self { simd, lines: Lines::new(simd, lines, [is_back_x, is_back_y, is_back_z], slabs.tmin()), slabs }
    }

    /// Returns the result of [`BoxRay::enter`](super::BoxRay::enter): the ranks of all boxes, and the set of those that
    /// any ray within the bounds meets up to `end`.
    #[inline(always)]
    pub fn enter(&self, planes: &[[[f32; A]; 2]; 3], end: f32) -> (V, u32) {
        if self.slabs.is_wide() {
            let (ranks, set) = enter_wide(&self.slabs, planes, end);
            return (V::load_array(self.simd, ranks), set);
        }
        self.lines.enter(planes, end)
    }
}

/// Returns for the near and the far plane the start of the ray and the reciprocal of its direction; and whether it runs
/// backward, so that the ray meets the upper plane first.
#[inline(always)]
fn line([lo, hi]: [[f32; 2]; 2]) -> ([[f32; 2]; 2], bool) {
    let [_, inverse] = lo;
    if inverse < 0.0 { ([hi, lo], true) } else { ([lo, hi], false) }
}

/// Tests in double precision, two boxes at a time.
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
