//! The differences of the two precisions in wide trees.

use std::fmt::Debug;

use fearless_simd::{Simd, SimdFloat, f32x4, f32x8, f64x4};
use glam::{DVec3, Vec3};

use super::{Block, BoxRay, FramedBoxes, LazyExact, LazyExact64, TriangleRay, block};
use crate::geom::frame::power_of_two;
use crate::geom::kernel::{Exact, Exact64, MAX_COORDINATE, Parity, USUAL};
use crate::geom::slabs::{self, Directed, Framed, Slabs, Slabs64};
use crate::geom::{EnclosedRay, Ray, Region, Triangle, Vector};

/// Positions in single or in double precision, for wide trees. Boxes are always in single precision.
pub trait Precision: Vector {
    /// The exact test.
    type Exact: Parity<Vector = Self>;
    /// The corresponding box test in binary trees.
    type Slabs: Slabs<Vector = Self>;
    /// Four coordinates.
    type Lanes<S: Simd>: FourLanes<S, Self::Real>;
    /// A ray, prepared for the boxes of a node.
    type Boxes<S: Simd>: NodeBoxes<S, Self>;
    /// The search for hits in a leaf.
    type Hits<'a>: Hits<'a, Self>;

    /// Whether closest and any hits have copies of all traversals, and not only of the default one.
    const HAS_ALL_COPIES: bool;

    /// Minimum edge length in the error bounds of the filter; it covers all errors of underflow too. `[LANES-3]`
    const MIN_EDGE: Self::Real;

    /// Greatest error of a ray for which the filter is used. `[LANES-5]`
    const MOST_OFF: f64;

    /// Returns whether a ray certainly misses the region, if this takes less time than to prepare the ray. `[BOX-9]`
    fn passes_by(ray: &Ray<Self>, region: &Region) -> bool;

    /// Returns whether the filter can reject triangles of a region. Otherwise each is tested exactly. `[LANES-3]`
    fn can_filter(region: &Region) -> bool;

    /// Returns whether boxes are tested from the origins of near rays, not from their entries into the region.
    /// `[BOX-9]`
    fn has_near_rays(region: &Region) -> bool;

    /// Creates the filter of a ray that is known within bounds. `[LANES-5]`
    fn enclosed<S: Simd>(simd: S, ray: &EnclosedRay, region: &Region) -> TriangleRay<S, Self>;

    /// Returns the greatest component of the edges from the first corner, as the filter computes it, at least
    /// [`MIN_EDGE`](Self::MIN_EDGE). `[LANES-3]`
    fn longest(triangle: &Triangle<Self>) -> Self::Real;
}

/// A vector of four numbers.
pub trait FourLanes<S: Simd, R>: SimdFloat<S, Element = R, Array = [R; 4]> {
    /// Returns the numbers with their signs changed where those of other numbers are negative.
    #[must_use]
    fn turned(self, others: Self) -> Self;
}

/// A ray, prepared for the eight boxes of a node, in the units of their frame.
pub trait NodeBoxes<S: Simd, V: Precision>: Clone + Debug {
    /// Prepares a ray. `region` must contain all boxes of the tests.
    fn new(simd: S, ray: &Ray<V>, region: &Region) -> Self;

    /// Returns an upper bound of the reported distance of each box with a hit at or before `t`. Neither `t` nor the
    /// result is negative.
    fn end(&self, t: V::Real) -> f32;

    /// Returns the ranks of all boxes, and the set of those that are met up to an [end](Self::end). `[LANES-2]`
    fn enter(&self, planes: &[[[f32; 8]; 2]; 3], end: f32) -> (f32x8<S>, u32);
}

/// The hits of a ray in leaves: the filter of four triangles, then the exact test of the survivors.
pub trait Hits<'a, V: Precision>: Debug {
    /// The nearest hit so far: the least exact distance, and of equal distances the least index. `[EXACT-1]`
    type Nearest: Copy + Debug;

    /// Creates the search for this ray. `region` must contain all triangles of the tests.
    fn new(ray: &'a Ray<V>, region: &'a Region) -> Self;

    /// Returns the ray.
    fn ray(&self) -> &'a Ray<V>;

    /// Returns the filter for this ray.
    fn filter<S: Simd>(&self, simd: S) -> TriangleRay<S, V>;

    /// Returns the state before any hit.
    fn none(&self) -> Self::Nearest;

    /// Returns a bound beyond which no hit is nearer than this one: not below 0, and not -0.
    fn end(nearest: &Self::Nearest) -> V::Real;

    /// Returns the triangle, if there is a hit.
    fn prim(nearest: &Self::Nearest) -> Option<u32>;

    /// Returns the nearest hit of `nearest` and the first `count` triangles of these blocks, less than 32. `nearest`
    /// must be none, or the last result.
    fn nearest<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S, V>,
        blocks: &'a [Block<V>],
        count: u32,
        nearest: Self::Nearest,
    ) -> Self::Nearest;

    /// Returns a hit among the first `count` triangles, less than 32. Its distance is unknown.
    fn any<S: Simd>(
        &mut self,
        simd: S,
        filter: &TriangleRay<S, V>,
        blocks: &'a [Block<V>],
        count: u32,
    ) -> Option<Self::Nearest>;

    /// Returns the distance of the nearest hit, rounded. It and the next function receive the hit by value: a value
    /// behind a pointer is not in registers, nor is the search that holds it.
    fn distance<S: Simd>(&mut self, simd: S, nearest: Self::Nearest) -> V::Real;

    /// Returns distance and weights of the last hit.
    fn whole<S: Simd>(&mut self, simd: S, nearest: Self::Nearest) -> Option<(V::Real, [V::Real; 2])>;
}

impl Precision for Vec3 {
    type Exact = Exact;
    type Slabs = Directed;
    type Lanes<S: Simd> = f32x4<S>;
    type Boxes<S: Simd> = BoxRay<S, f32x8<S>, 8>;
    type Hits<'a> = LazyExact<'a>;

    const HAS_ALL_COPIES: bool = true;
    const MIN_EDGE: f32 = super::MIN_EDGE;
    const MOST_OFF: f64 = MAX_COORDINATE as f64;

    #[inline(always)]
    fn passes_by(ray: &Ray, region: &Region) -> bool {
        region.is_passed_by_single(ray)
    }

    #[inline(always)]
    fn can_filter(region: &Region) -> bool {
        region.reach() <= Self::MOST_OFF
    }

    fn has_near_rays(region: &Region) -> bool {
        region.reach() <= f64::from(slabs::MAX_COORDINATE)
    }

    #[inline(always)]
    fn enclosed<S: Simd>(simd: S, ray: &EnclosedRay, region: &Region) -> TriangleRay<S, Self> {
        TriangleRay::enclosed(simd, ray, region)
    }

    #[inline]
    fn longest(triangle: &Triangle) -> f32 {
        block::longest(triangle)
    }
}

impl Precision for DVec3 {
    type Exact = Exact64;
    type Slabs = Slabs64;
    type Lanes<S: Simd> = f64x4<S>;
    type Boxes<S: Simd> = FramedBoxes<S>;
    type Hits<'a> = LazyExact64<'a>;

    const HAS_ALL_COPIES: bool = false;
    /// Smaller than every practical scene.
    const MIN_EDGE: f64 = power_of_two(-400);
    const MOST_OFF: f64 = *USUAL.end();

    #[inline(always)]
    fn passes_by(ray: &Ray<Self>, region: &Region) -> bool {
        region.is_passed_by(ray)
    }

    #[inline(always)]
    fn can_filter(region: &Region) -> bool {
        USUAL.contains(&region.size()) && region.reach() <= Self::MOST_OFF
    }

    fn has_near_rays(region: &Region) -> bool {
        Framed::has_near_rays(region)
    }

    #[inline(always)]
    fn enclosed<S: Simd>(simd: S, ray: &EnclosedRay, region: &Region) -> TriangleRay<S, Self> {
        TriangleRay::double_enclosed(simd, ray, region)
    }

    #[inline]
    fn longest(&Triangle([v0, v1, v2]): &Triangle<Self>) -> f64 {
        (v1 - v0).abs().max((v2 - v0).abs()).max_element().max(Self::MIN_EDGE)
    }
}

impl<S: Simd> NodeBoxes<S, Vec3> for BoxRay<S, f32x8<S>, 8> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray, region: &Region) -> Self {
        Self::new(simd, ray, region)
    }

    #[inline(always)]
    fn end(&self, t: f32) -> f32 {
        t
    }

    #[inline(always)]
    fn enter(&self, planes: &[[[f32; 8]; 2]; 3], end: f32) -> (f32x8<S>, u32) {
        self.enter(planes, end)
    }
}

impl<S: Simd> FourLanes<S, f32> for f32x4<S> {
    #[inline(always)]
    fn turned(self, others: Self) -> Self {
        Self::from_bits(self.to_bits() ^ (others.to_bits() & (1 << 31)))
    }
}

impl<S: Simd> FourLanes<S, f64> for f64x4<S> {
    #[inline(always)]
    fn turned(self, others: Self) -> Self {
        Self::from_bits(self.to_bits() ^ (others.to_bits() & (1 << 63)))
    }
}
