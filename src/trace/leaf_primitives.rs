//! What leaves hold, whatever the tree above them.

use crate::bvh::wide::leaf_places;
use crate::bvh::{Bvh, WideBvh};
use crate::geom::lanes::Precision;
use crate::geom::{Region, Slabs, Triangle};
use crate::tree::Node;

/// The shapes in the leaves of a hierarchy: all that rare queries need of it, but for boxes.
pub trait LeafPrimitives<S> {
    /// What the tests of a ray need to know of the whole.
    fn region(&self) -> &Region;

    /// Whether a shape may be in several leaves.
    fn has_repeats(&self) -> bool;

    /// Shows the shapes of a leaf: of each its place, which [`shape`](Self::shape) takes, and its index in the mesh.
    fn for_each(&self, leaf: Node, show: impl FnMut(usize, &S, u32));

    /// The least index of the triangles of a leaf, or below an inner node. `[NEAR-6]`
    fn least_below(&self, node: Node) -> u32;

    /// The shape at a place.
    fn shape(&self, place: usize) -> S;
}

/// A ray's tests of a hierarchy `H`, which may also tell that it misses triangles.
pub(super) trait LeafFilter<H, S, R> {
    /// Shows the shapes of a leaf, as [`for_each`](LeafPrimitives::for_each), but for some that the ray does not meet up to
    /// `end`.
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

/// A place is four times the block's, and the lane.
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
