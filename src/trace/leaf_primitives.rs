//! Leaf contents, independent of the arity of the tree.

use crate::bvh::wide::leaf_places;
use crate::bvh::{Bvh, WideBvh};
use crate::geom::lanes::Precision;
use crate::geom::{Region, Slabs, Triangle};
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
