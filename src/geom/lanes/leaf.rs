//! Leaves: the filter of four triangles, then the exact test of the survivors.

use fearless_simd::Simd;
use glam::Vec3;

use super::{Block, Hits, Precision, TriangleRay};
use crate::geom::kernel::{Exact, ExactOnce, Met};
use crate::geom::{Kernel, Ray, Region, Triangle};

/// The nearest hit so far: the least exact distance, and of equal distances the least index. `[EXACT-1]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its distance, rounded; the end of the ray if there is no hit.
    pub t: f32,
    /// Its triangle; [`Block::NONE`] if there is no hit.
    pub prim: u32,
}

impl Nearest {
    /// Creates the state before any hit. An end of -0 becomes 0.
    #[inline(always)]
    pub fn none(ray: &Ray) -> Self {
        Self { t: ray.tmax() + 0.0, prim: Block::NONE }
    }

    /// Returns whether there is a hit.
    #[inline(always)]
    pub fn is_some(&self) -> bool {
        self.prim != Block::NONE
    }
}

/// The exact test, prepared at the first triangle that the filter does not reject: a ray that misses everything does
/// not pay for it. It also holds the triangle of the hit so far, for comparisons with triangles at the same rounded
/// distance.
///
/// Its alignment is that of registers: so the stack frame that holds it is aligned too, and registers that are spilled
/// there do not cross cache lines.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub struct LazyExact<'a> {
    ray: &'a Ray,
    region: &'a Region,
    exact: Option<ExactOnce>,
    /// The block and the lane of the hit so far; and the hit, unless it is any.
    found: Option<(&'a Block, usize, Option<Met>)>,
}

impl<'a> LazyExact<'a> {
    /// Creates the test for this ray. `region` must contain all triangles of the tests.
    #[inline(always)]
    pub const fn new(ray: &'a Ray, region: &'a Region) -> Self {
        Self { ray, region, exact: None, found: None }
    }

    /// Returns the ray.
    #[inline(always)]
    pub const fn ray(&self) -> &'a Ray {
        self.ray
    }

    /// Returns the test.
    #[inline(always)]
    pub fn get(&mut self) -> &Exact {
        &self.once().exact
    }

    #[inline(always)]
    fn once(&mut self) -> &ExactOnce {
        let (ray, region) = (self.ray, self.region);
        self.exact.get_or_insert_with(
            #[inline(always)]
            || ExactOnce::new(ray, region),
        )
    }

    /// The nearest hit of `nearest` and the first `count` triangles of these blocks. `nearest` must be none, or what this
    /// has returned last.
    ///
    /// # Panics
    /// If `count` is more than 31. A leaf has at most 15 triangles.
    ///
    /// ```
    /// use fearless_simd::{Level, Simd, dispatch};
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::internals::geom::lanes::{Block, LazyExact, Nearest, TriangleRay};
    /// use stackless_bvh::geom::{Ray, Region, Triangle};
    ///
    /// let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    /// let mut block = Block::EMPTY;
    /// block.set(0, &triangle, 7);
    /// let (ray, region) = (Ray::new(Vec3::new(0.25, 0.25, -3.0), Vec3::Z)?, Region::of(&triangle.aabb()));
    ///
    /// #[inline(always)]
    /// fn nearest<S: Simd>(simd: S, ray: &Ray, region: &Region, block: Block) -> Nearest {
    ///     let filter = TriangleRay::new(simd, ray, region);
    ///     LazyExact::new(ray, region).nearest(simd, &filter, &[block], 1, Nearest::none(ray))
    /// }
    /// let found = dispatch!(Level::new(), simd => nearest(simd, &ray, &region, block));
    /// assert_eq!(found, Nearest { t: 3.0, prim: 7 });
    /// # Ok::<(), stackless_bvh::geom::RayError>(())
    /// ```
    #[inline(always)]
    pub fn nearest<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S>,
        blocks: &'a [Block],
        count: u32,
        mut nearest: Nearest,
    ) -> Nearest {
        for (block, filled) in filled(blocks, count) {
            let lanes = filter.survivors(simd, block, nearest.t) & filled;
            if lanes != 0 {
                nearest = self.settle(block, lanes, nearest);
            }
        }
        nearest
    }

    /// Returns a triangle, among the first `count` of these blocks, that the ray meets within its interval.
    ///
    /// # Panics
    /// If `count` is more than 31. A leaf has at most 15 triangles.
    #[inline(always)]
    pub fn any<S: Simd>(&mut self, simd: S, filter: &TriangleRay<S>, blocks: &'a [Block], count: u32) -> Option<u32> {
        for (block, filled) in filled(blocks, count) {
            let lanes = filter.survivors(simd, block, self.ray.tmax()) & filled;
            if lanes != 0
                && let Some(prim) = self.blocking(block, lanes)
            {
                return Some(prim);
            }
        }
        None
    }

    /// Returns the nearest hit of `nearest` and these lanes' triangles.
    ///
    /// It receives `nearest` by value: a value behind a pointer cannot be in registers. Registers also cannot be kept
    /// across a function call: as a separate function, this took 3 to 5 % of a ray's instructions more.
    #[inline(always)]
    fn settle(&mut self, block: &'a Block, lanes: u32, mut nearest: Nearest) -> Nearest {
        for lane in LaneSet(lanes) {
            let shape = block.triangle(lane);
            let Some(met) = self.once().distance(&shape, nearest.t) else { continue };
            let t = met.t;
            let prim = block.prims[lane];
            if t < nearest.t || t == nearest.t && prim != nearest.prim && self.comes_first(&shape, prim) {
                nearest = Nearest { t, prim };
                self.found = Some((block, lane, Some(met)));
            }
        }
        nearest
    }

    /// Returns whether a hit at the rounded distance of the nearest hit so far comes before it. `[EXACT-13]`
    #[cold]
    #[inline(never)]
    fn comes_first(&mut self, shape: &Triangle, prim: u32) -> bool {
        let Some((block, lane, _)) = self.found else { return true };
        self.get().order((shape, prim), (&block.triangle(lane), block.prims[lane])).is_lt()
    }

    /// Returns one of these lanes' triangles that the ray meets within its interval.
    ///
    /// By a loop: `find` is a separate function, which is not compiled for the level.
    #[inline(always)]
    fn blocking(&mut self, block: &'a Block, lanes: u32) -> Option<u32> {
        for lane in LaneSet(lanes) {
            if self.get().blocks(&block.triangle(lane)) {
                self.found = Some((block, lane, None));
                return Some(block.prims[lane]);
            }
        }
        None
    }
}

impl<'a> Hits<'a, Vec3> for LazyExact<'a> {
    type Nearest = Nearest;

    #[inline(always)]
    fn new(ray: &'a Ray, region: &'a Region) -> Self {
        Self::new(ray, region)
    }

    #[inline(always)]
    fn ray(&self) -> &'a Ray {
        self.ray
    }

    #[inline(always)]
    fn filter<S: Simd>(&self, simd: S) -> TriangleRay<S> {
        TriangleRay::new(simd, self.ray, self.region)
    }

    #[inline(always)]
    fn none(&self) -> Nearest {
        Nearest::none(self.ray)
    }

    #[inline(always)]
    fn end(nearest: &Nearest) -> f32 {
        nearest.t
    }

    #[inline(always)]
    fn prim(nearest: &Nearest) -> Option<u32> {
        nearest.is_some().then_some(nearest.prim)
    }

    #[inline(always)]
    fn nearest<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S>,
        blocks: &'a [Block],
        count: u32,
        nearest: Nearest,
    ) -> Nearest {
        self.nearest(simd, filter, blocks, count, nearest)
    }

    #[inline(always)]
    fn any<S: Simd>(&mut self, simd: S, filter: &TriangleRay<S>, blocks: &'a [Block], count: u32) -> Option<Nearest> {
        let prim = self.any(simd, filter, blocks, count)?;
        Some(Nearest { prim, ..Nearest::none(self.ray) })
    }

    #[inline(always)]
    fn distance<S: Simd>(&mut self, _: S, nearest: Nearest) -> f32 {
        nearest.t
    }

    #[inline(never)]
    fn whole<S: Simd>(&mut self, _: S, _: Nearest) -> Option<(f32, [f32; 2])> {
        let (block, lane, met) = self.found?;
        let (shape, exact) = (block.triangle(lane), self.once());
        let met = met.or_else(|| exact.distance(&shape, f32::INFINITY))?;
        Some((met.t, exact.weights(&met, &shape)))
    }
}

/// Returns the blocks of the first `count` triangles, less than 32, each with the set of its lanes among them.
#[inline(always)]
pub(crate) fn filled<V: Precision>(blocks: &[Block<V>], count: u32) -> impl Iterator<Item = (&Block<V>, u32)> {
    assert!(count < u32::BITS, "{count} triangles");
    // A bit for each.
    let mut left = (1_u32 << count) - 1;
    blocks.iter().map_while(
        #[inline(always)]
        move |block| {
            let lanes = left & 15;
            left >>= 4;
            (lanes != 0).then_some((block, lanes))
        },
    )
}

/// A set of a block's lanes; as an iterator, the lowest lane first.
#[derive(Clone, Debug)]
pub(crate) struct LaneSet(pub(crate) u32);

impl Iterator for LaneSet {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let Self(lanes) = *self;
        self.0 &= lanes.checked_sub(1)?;
        // The mask makes a bounds check unnecessary.
        Some(lanes.trailing_zeros() as usize & 3)
    }
}
