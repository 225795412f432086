//! Leaf contents, independent of the arity of the tree.

use crate::bvh::wide::leaf_places;
use crate::bvh::{Bvh, WideBvh};
use crate::geom::lanes::{LaneSet, Precision, filled, with_baseline};
use crate::geom::{Region, Slabs, Triangle, Vector};
use crate::tree::Node;

/// The shapes in the leaves of a hierarchy. Rare queries need only these and boxes.
pub trait LeafPrimitives<S> {
    /// Returns the properties of the whole hierarchy that ray tests need.
    fn region(&self) -> &Region;

    /// Returns whether a shape may be in several leaves.
    fn has_repeats(&self) -> bool;

    /// Calls `show` for the shapes of a leaf: with the place, an argument of [`shape`](Self::shape), the shape, and its
    /// index in the mesh.
    fn for_each(&self, leaf: Node, show: impl FnMut(usize, &S, u32));

    /// Returns the least index of the triangles of a leaf, or below an inner node. `[NEAR-6]`
    fn least_below(&self, node: Node) -> u32;

    /// Returns the shape at a place.
    fn shape(&self, place: usize) -> S;
}

/// A ray's tests in a hierarchy `H`, which may reject triangles.
pub(super) trait LeafFilter<H, S, R> {
    /// Calls `show` for the shapes of a leaf, as [`for_each`](LeafPrimitives::for_each), except for some that the ray
    /// does not meet up to `end`.
    fn for_each_left(&self, bvh: &H, leaf: Node, end: R, show: impl FnMut(usize, &S, u32));
}

/// Leaves for searches around a point.
pub trait NearTriangles<V: Vector>: LeafPrimitives<Triangle<V>> {
    /// Calls `show` for the triangles of a leaf, as [`for_each`](LeafPrimitives::for_each), except for some that are
    /// farther from the point than the limit. `show` returns the limit for the next triangles.
    fn for_each_near(
        &self,
        leaf: Node,
        point: V,
        limit: V::Real,
        show: impl FnMut(usize, &Triangle<V>, u32) -> V::Real,
    );
}

impl<B: Slabs, S: Copy, R> LeafFilter<Bvh<S>, S, R> for B {
    #[inline]
    fn for_each_left(&self, bvh: &Bvh<S>, leaf: Node, _: R, show: impl FnMut(usize, &S, u32)) {
        bvh.for_each(leaf, show);
    }
}

impl<S: Copy> LeafPrimitives<S> for Bvh<S> {
    #[inline]
    fn region(&self) -> &Region {
        self.region()
    }

    #[inline]
    fn has_repeats(&self) -> bool {
        self.duplicates() > 0
    }

    #[inline]
    fn for_each(&self, leaf: Node, mut show: impl FnMut(usize, &S, u32)) {
        let range = self.leaf_range(leaf);
        for (place, held) in range.clone().zip(&self.triangles()[range]) {
            show(place, &held.shape, held.prim);
        }
    }

    fn least_below(&self, node: Node) -> u32 {
        self.least_below(node)
    }

    #[inline]
    fn shape(&self, place: usize) -> S {
        self.triangles()[place].shape
    }
}

impl<V: Vector> NearTriangles<V> for Bvh<Triangle<V>> {
    #[inline]
    fn for_each_near(
        &self,
        leaf: Node,
        point: V,
        mut limit: V::Real,
        mut show: impl FnMut(usize, &Triangle<V>, u32) -> V::Real,
    ) {
        self.for_each(leaf, |place, shape, prim| {
            if shape.may_be_near(point, limit) {
                limit = show(place, shape, prim);
            }
        });
    }
}

/// A place is four times the block's index, plus the lane.
impl<const A: usize, V: Precision> LeafPrimitives<Triangle<V>> for WideBvh<A, V> {
    fn region(&self) -> &Region {
        self.region()
    }

    fn has_repeats(&self) -> bool {
        self.duplicates() > 0
    }

    fn for_each(&self, leaf: Node, mut show: impl FnMut(usize, &Triangle<V>, u32)) {
        for place in leaf_places(leaf) {
            show(place, &self.triangle(place), self.prim(place));
        }
    }

    fn least_below(&self, node: Node) -> u32 {
        self.least_below(node)
    }

    fn shape(&self, place: usize) -> Triangle<V> {
        self.triangle(place)
    }
}

impl<const A: usize, V: Precision> NearTriangles<V> for WideBvh<A, V> {
    fn for_each_near(
        &self,
        leaf: Node,
        point: V,
        mut limit: V::Real,
        mut show: impl FnMut(usize, &Triangle<V>, u32) -> V::Real,
    ) {
        let (blocks, count) = self.leaf(leaf);
        let first = leaf_places(leaf).start;
        for (i, (block, filled)) in filled(blocks, count).enumerate() {
            let near = with_baseline!(simd => block.near(simd, point, limit));
            for lane in LaneSet(near & filled) {
                limit = show(first + 4 * i + lane, &block.triangle(lane), block.prims[lane]);
            }
        }
    }
}
