//! Four triangles in double precision: the filter, and the hits of a leaf by bounds of their distances.

use fearless_simd::{Simd, SimdBase, SimdMask as _, f64x4};
use glam::DVec3;

use super::precision::{FourLanes as _, Hits};
use super::triangles::{CONSTANTS, Found, OFF, OFF_EDGE};
use super::{Block, LaneSet, Precision as _, TriangleRay, filled};
use crate::geom::kernel::{Corrected, EDGE, Exact64, QUOTIENT, USUAL};
use crate::geom::{EnclosedRay, Interval, Kernel as _, Once, Ray, Region, Triangle};

/// Half of the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;

/// As in single precision. `[LANES-5]`
const OFF_REACH: f64 = 9.0 / (EDGE as f64 * UNIT);

impl<S: Simd> TriangleRay<S, DVec3> {
    /// Prepares a ray. `region` must contain all triangles of the tests.
    #[inline(always)]
    pub(super) fn double(simd: S, ray: &Ray<DVec3>, region: &Region) -> Self {
        Self::double_with(simd, [ray.origin(), ray.direction()], region, CONSTANTS.map(f64::from))
    }

    /// Prepares a ray that is known within bounds. It rejects triangles that all rays within them miss, or meet beyond.
    /// `[LANES-5]`
    #[inline(always)]
    pub(super) fn double_enclosed(simd: S, ray: &EnclosedRay, region: &Region) -> Self {
        let ((origin, moved), (direction, turned)) =
            (Interval::middles(&ray.origin), Interval::middles(&ray.direction));
        let middle = [origin, direction];
        let constants = [OFF_EDGE.into(), OFF_REACH, OFF.into()];
        Self::double_with(simd, middle, region, CONSTANTS.map(f64::from)).around(
            simd,
            ray,
            middle,
            [moved, turned],
            constants,
        )
    }

    /// Prepares a ray with other constants, as [`with_constants`](TriangleRay::with_constants).
    #[inline(always)]
    fn double_with(simd: S, [o, d]: [DVec3; 2], region: &Region, [edge, det, t]: [f64; 3]) -> Self {
        let (c, length) = (region.distance(o), d.abs().max_element());
        let is_usual = *USUAL.start() <= length.min(c) && length.max(c) <= *USUAL.end() && DVec3::can_filter(region);
        let unit = if is_usual { UNIT } else { f64::INFINITY };
        let all = |x: f64| f64x4::splat(simd, x);
        Self {
            origin: [all(o.x), all(o.y), all(o.z)],
            direction: [all(d.x), all(d.y), all(d.z)],
            edge: all(edge * unit * length),
            det: all(det * unit * length),
            t: all(t * unit * c),
            twice_c: all(2.0 * c),
        }
    }

    /// Returns the lanes that the line certainly meets, and bounds of their distances. `[LANES-6]`
    #[inline(always)]
    fn certain(&self, simd: S, block: &Block<DVec3>, found: &Found<f64x4<S>>) -> (u32, [[f64; 4]; 2]) {
        let (det, t, edge) = (found.det, found.t, f64x4::load_array_ref(simd, &block.edges));
        let square = edge * edge;
        let reciprocal = f64x4::splat(simd, 1.0) / det;
        let x = t * reciprocal;
        let error = (self.t * square + x.abs() * (self.det * square)) * reciprocal.abs()
            + x.abs() * (f64::from(QUOTIENT) * UNIT);
        (self.is_met(edge, found).to_bitmask() as u32 & 15, [(x - error).into(), (x + error).into()])
    }

    /// Returns the lanes that the ray certainly meets between these distances, and those that it certainly meets
    /// before. `[LANES-7]`
    #[inline(always)]
    fn placed(&self, simd: S, block: &Block<DVec3>, found: &Found<f64x4<S>>, [tmin, tmax]: [f64; 2]) -> [u32; 2] {
        let (det, t, edge) = (found.det, found.t, f64x4::load_array_ref(simd, &block.edges));
        let square = edge * edge;
        let (t, t_off, det, det_off) = (t.turned(det), self.t * square, det.abs(), self.det * square);
        let (is_met, end, least) = (self.is_met(edge, found), t + t_off, det - det_off);
        let is_between = (t - t_off).simd_gt((det + det_off) * tmin) & end.simd_lt(least * tmax);
        let is_before = end.simd_lt(least * tmin);
        [(is_met & is_between).to_bitmask() as u32 & 15, (is_met & is_before).to_bitmask() as u32 & 15]
    }

    /// Returns whether the line certainly meets a triangle with this greatest component of its edges. `[LANES-6]`
    #[inline(always)]
    fn is_met(&self, edge: f64x4<S>, found: &Found<f64x4<S>>) -> <f64x4<S> as SimdBase<S>>::Mask {
        let [least, most] = found.edges;
        // Twice the bound of one edge function, for its sign and the determinant's together.
        let sign = ((self.edge + self.edge) * edge) * (self.twice_c + edge);
        least.simd_gt(sign) | most.simd_lt(-sign)
    }
}

/// Returns whether a multiplication and an addition are one instruction.
#[inline(always)]
fn is_fused<S: Simd>(simd: S) -> bool {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    let is_fused = matches!(simd.level(), super::Level::Avx2(_));
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    let is_fused = cfg!(target_arch = "aarch64") && !simd.level().is_fallback();
    is_fused
}

/// The nearest hit so far, by bounds of its distance: the least exact distance, and of equal distances the least index.
/// `[EXACT-1]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest64 {
    /// Without a hit, infinity and the end of the ray. Equal if the distance is known, rounded.
    ends: [f64; 2],
    prim: u32,
}

/// The hits of a ray in double precision. If bounds of distances do not decide, the exact test does. It is prepared for
/// each such case, because they are rare.
#[derive(Clone, Debug)]
pub struct LazyExact64<'a> {
    ray: &'a Ray<DVec3>,
    region: &'a Region,
    /// The block and the lane of the hit so far.
    found: Option<(&'a Block<DVec3>, usize)>,
    /// The last test and its answer: many triangles may coincide.
    last: Once<Triangle<DVec3>, Option<f64>>,
}

impl<'a> Hits<'a, DVec3> for LazyExact64<'a> {
    type Nearest = Nearest64;

    #[inline(always)]
    fn new(ray: &'a Ray<DVec3>, region: &'a Region) -> Self {
        Self { ray, region, found: None, last: Once::never() }
    }

    #[inline(always)]
    fn ray(&self) -> &'a Ray<DVec3> {
        self.ray
    }

    #[inline(always)]
    fn none(&self) -> Nearest64 {
        Nearest64 { ends: [f64::INFINITY, self.ray.tmax() + 0.0], prim: Block::NONE }
    }

    #[inline(always)]
    fn filter<S: Simd>(&self, simd: S) -> TriangleRay<S, DVec3> {
        TriangleRay::double(simd, self.ray, self.region)
    }

    #[inline(always)]
    fn end(&Nearest64 { ends: [_, end], .. }: &Nearest64) -> f64 {
        end
    }

    #[inline(always)]
    fn prim(&Nearest64 { prim, .. }: &Nearest64) -> Option<u32> {
        (prim != Block::NONE).then_some(prim)
    }

    #[inline(always)]
    fn nearest<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S, DVec3>,
        blocks: &'a [Block<DVec3>],
        count: u32,
        mut nearest: Nearest64,
    ) -> Nearest64 {
        for (block, filled) in filled(blocks, count) {
            let found = filter.found(simd, block);
            let lanes = filter.left(simd, block, nearest.ends[1], &found) & filled;
            if lanes != 0 {
                nearest = self.settle(block, lanes, filter.certain(simd, block, &found), nearest);
            }
        }
        nearest
    }

    #[inline(always)]
    fn any<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S, DVec3>,
        blocks: &'a [Block<DVec3>],
        count: u32,
    ) -> Option<Nearest64> {
        let interval @ [_, tmax] = [self.ray.tmin(), self.ray.tmax()];
        for (block, filled) in filled(blocks, count) {
            let found = filter.found(simd, block);
            let lanes = filter.left(simd, block, tmax, &found) & filled;
            if lanes != 0
                && let Some(lane) = self.blocking(block, lanes, filter.placed(simd, block, &found, interval))
            {
                self.found = Some((block, lane));
                return Some(Nearest64 { prim: block.prims[lane], ..self.none() });
            }
        }
        None
    }

    #[inline(always)]
    fn distance<S: Simd>(&mut self, simd: S, nearest: Nearest64) -> f64 {
        let [lo, hi] = nearest.ends;
        if lo == hi {
            return lo + 0.0;
        }
        self.corrected(simd).t.or_else(|| self.rounded()).unwrap_or(lo)
    }

    #[inline(always)]
    fn whole<S: Simd>(&mut self, simd: S, nearest: Nearest64) -> Option<(f64, [f64; 2])> {
        let [lo, hi] = nearest.ends;
        if lo < hi
            && let Corrected { t: Some(t), weights: Some(weights) } = self.corrected(simd)
        {
            return Some((t, weights));
        }
        self.whole_slowly()
    }
}

impl<'a> LazyExact64<'a> {
    fn exact(&self) -> Exact64 {
        Exact64::new(self.ray, self.region)
    }

    /// Returns the corrected hit so far, which must be certain.
    #[inline(always)]
    fn corrected<S: Simd>(&self, simd: S) -> Corrected {
        let Some((block, lane)) = self.found else { return Corrected::default() };
        let (Triangle(corners), o, d) = (block.triangle(lane), self.ray.origin(), self.ray.direction());
        if is_fused(simd) { Corrected::of::<true>(&corners, o, d) } else { Corrected::of::<false>(&corners, o, d) }
    }

    /// Returns the distance of the hit so far.
    #[cold]
    #[inline(never)]
    fn rounded(&self) -> Option<f64> {
        let (block, lane) = self.found?;
        self.exact().distance(&block.triangle(lane), f64::INFINITY)
    }

    /// Returns the distance of the hit so far, with its weights.
    #[cold]
    #[inline(never)]
    fn whole_slowly(&self) -> Option<(f64, [f64; 2])> {
        let ((block, lane), exact) = (self.found?, self.exact());
        let shape = block.triangle(lane);
        Some((exact.distance(&shape, f64::INFINITY)?, exact.weights(&shape)))
    }

    /// Returns the nearest hit of `nearest` and these lanes' triangles, some of which are certainly met. `[LANES-7]`
    #[inline(always)]
    fn settle(
        &mut self,
        block: &'a Block<DVec3>,
        lanes: u32,
        (certain, [near, far]): (u32, [[f64; 4]; 2]),
        mut nearest: Nearest64,
    ) -> Nearest64 {
        let [tmin, tmax] = [self.ray.tmin(), self.ray.tmax()];
        for lane in LaneSet(lanes) {
            let ends @ [lo, hi] = [near[lane], far[lane]];
            if certain >> lane & 1 == 1 {
                if hi < tmin || nearest.ends[1] < lo {
                    continue;
                }
                if tmin < lo && hi < tmax && hi < nearest.ends[0] {
                    nearest = Nearest64 { ends, prim: block.prims[lane] };
                    self.found = Some((block, lane));
                    continue;
                }
            }
            nearest = self.contest(block, lane, nearest);
        }
        nearest
    }

    /// Returns the nearest hit of `nearest` and one triangle, by exact arithmetic.
    #[cold]
    #[inline(never)]
    fn contest(&mut self, block: &'a Block<DVec3>, lane: usize, nearest: Nearest64) -> Nearest64 {
        let (shape, prim, [lo, hi]) = (block.triangle(lane), block.prims[lane], nearest.ends);
        let best = self.found.map(|(block, lane)| block.triangle(lane));
        if best == Some(shape) {
            return Nearest64 { prim: prim.min(nearest.prim), ..nearest };
        }
        let (exact, mut last) = (self.exact(), self.last);
        let t = last.answer(&shape, |shape| exact.distance(shape, hi));
        self.last = last;
        let Some(t) = t.filter(|&t| t <= hi) else { return nearest };
        let is_first = match best {
            Some(best) if t >= lo => exact.order((&shape, prim), (&best, nearest.prim)).is_lt(),
            _ => true,
        };
        if !is_first {
            return nearest;
        }
        self.found = Some((block, lane));
        Nearest64 { ends: [t, t], prim }
    }

    /// Returns one of these lanes whose triangle the ray meets within its interval. The arguments are the lanes that it
    /// certainly meets there, and before.
    #[inline(always)]
    fn blocking(&self, block: &Block<DVec3>, lanes: u32, [between, before]: [u32; 2]) -> Option<usize> {
        LaneSet(lanes & !before).find(|&lane| between >> lane & 1 == 1 || self.blocks(block, lane))
    }

    #[cold]
    #[inline(never)]
    fn blocks(&self, block: &Block<DVec3>, lane: usize) -> bool {
        self.exact().blocks(&block.triangle(lane))
    }
}

#[cfg(test)]
mod tests;
