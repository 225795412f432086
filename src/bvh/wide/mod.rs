//! Hierarchies of four or eight children, for tests of many boxes at once.
//!
//! A collapse makes a [`WideBvh`] from a tree of two children: a node adopts grandchildren and further descendants
//! until its slots are full. The dynamic programme of Ylitie, Karras & Laine 2017, "Efficient incoherent ray traversal
//! on GPUs through compressed wide BVHs", section 4, selects them. spec/wide.md has the requirements of traversals on
//! the tree.
//!
//! ```
//! use stackless_bvh::bvh::WideBvh;
//! use stackless_bvh::generate::procedural;
//!
//! let mesh = procedural::strands(1, 100);
//! let wide = WideBvh::build(&mesh)?;
//! wide.validate(&mesh)?;
//! assert!(8 * wide.nodes().len() < mesh.triangles().len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bytes;
mod collapse;
mod collapse_dp;
mod draft;
mod layout;
mod refit;
mod validate;

pub use bytes::WideBvhFileError;
pub use collapse::{WideError, WideOptions};
pub use validate::WideBvhError;

use std::ops::Range;

use super::least::Least;
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, Region, Triangle};
use crate::tree::Node;
use crate::wide::Topology;

use glam::Vec3;

/// A hierarchy over the triangles of a mesh, with up to `A` children per node: 4 or 8. Boxes are in single precision,
/// in the [frame](crate::geom::Frame) of a mesh in double precision. `[WIDE-1]`
#[derive(Clone, Debug)]
pub struct WideBvh<const A: usize = 8, V: Precision = Vec3> {
    nodes: Vec<WideNode<A>>,
    blocks: Vec<Block<V>>,
    region: Region,
    levels: u32,
    /// Triangles of the mesh, including those in no leaf.
    triangles: usize,
    duplicates: usize,
    pub(super) least: Least,
}

/// An inner node: 256 bytes for eight children, 128 for four.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct WideNode<const A: usize> {
    /// For each axis, the lower planes of the slots' boxes, then the upper planes. An empty slot has plus and minus
    /// infinity. `[BOX-7]`
    pub planes: [[[f32; A]; 2]; 3],
    /// Bits of the children's [`Node`]s; 0 in an empty slot. The index of an inner node is its place in
    /// [`WideBvh::nodes`]; that of a leaf is the input of [`WideBvh::leaf`].
    pub children: [u32; A],
    /// In the lowest 24 bits the indices of the `A` nearest ancestors, the parent first; the root's, which is 0, beyond
    /// the root. In the highest 8 bits of the first the set of the slots that hold leaves.
    pub ancestors: [u32; A],
}

/// Bits of an index in [`WideNode::ancestors`].
const ANCESTOR_BITS: u32 = 24;

/// Bits of a leaf's index for the place of its first block. The bits above them are the number of its triangles.
const BLOCK_BITS: u32 = 27;

/// Number of triangles that a thread takes at a time. The order of nodes depends on it.
const CUT: u32 = 4096;

/// Greatest number of triangles in a leaf that 4 bits hold.
const MAX_COUNT: u32 = 15;

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// Greatest level of an inner node: all traversals carry this many levels. `[WIDE-14]`
    pub const MAX_LEVEL: u32 = if A == 8 { 16 } else { 30 };

    /// Greatest number of inner nodes.
    pub const MAX_NODES: usize = 1 << ANCESTOR_BITS;

    /// Greatest number of blocks.
    pub const MAX_BLOCKS: usize = 1 << BLOCK_BITS;

    /// Creates a hierarchy of no triangles: a root without children.
    pub fn empty() -> Self {
        let region = Region::of(&Aabb { lo: Vec3::ZERO, hi: Vec3::ZERO });
        let least = Least::default();
        Self { nodes: vec![WideNode::EMPTY], blocks: Vec::new(), region, levels: 0, triangles: 0, duplicates: 0, least }
    }

    /// Returns the inner nodes, at least the root, which is the first. A parent comes before its children.
    #[inline(always)]
    pub fn nodes(&self) -> &[WideNode<A>] {
        &self.nodes
    }

    /// Returns the triangles, four at a time, in the order of the leaves.
    #[inline(always)]
    pub fn blocks(&self) -> &[Block<V>] {
        &self.blocks
    }

    /// Returns the data that a traversal reads.
    #[inline(always)]
    pub(crate) fn tree(&self) -> WideTree<'_, A, V> {
        WideTree { nodes: &self.nodes, blocks: &self.blocks, levels: self.levels }
    }

    /// Returns the properties of the whole hierarchy that ray tests need.
    #[inline(always)]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// Returns the number of references to triangles beyond the first of each: 0 unless spatial splits divided some
    /// triangles.
    pub fn duplicates(&self) -> usize {
        self.duplicates
    }

    /// Returns the number of degenerate triangles of the mesh that were [omitted](super::Degenerate::LeftOut).
    pub fn dropped(&self) -> usize {
        let references: usize = self.leaf_boxes().map(|(leaf, _)| leaf_places(leaf).len()).sum();
        self.triangles + self.duplicates - references
    }

    /// Replaces the region by another one that contains all boxes and triangles.
    pub(crate) fn map_region(&mut self, change: impl FnOnce(Region) -> Region) {
        self.region = change(self.region);
    }

    /// Returns the memory of nodes and blocks, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks)
    }

    /// Returns leaves and their boxes, node by node.
    fn leaf_boxes(&self) -> impl Iterator<Item = (Node, Aabb)> {
        self.nodes.iter().flat_map(|node| {
            let slots = (0..A as u32).filter(|slot| node.leaves() >> slot & 1 == 1);
            slots.map(|slot| (node.child(slot), node.child_box(slot)))
        })
    }

    /// Returns the blocks of a leaf, and the number of triangles in them.
    #[inline(always)]
    pub fn leaf(&self, leaf: Node) -> (&[Block<V>], u32) {
        let (first, count) = leaf_parts(leaf);
        (&self.blocks[first..first + count.div_ceil(4) as usize], count)
    }

    /// Returns the index in the mesh of the triangle at a [place](leaf_places).
    pub(crate) fn prim(&self, place: usize) -> u32 {
        self.blocks[place / 4].prims[place & 3]
    }

    /// Returns the triangle at a [place](leaf_places).
    pub(crate) fn triangle(&self, place: usize) -> Triangle<V> {
        self.blocks[place / 4].triangle(place & 3)
    }

    /// Returns the least index of the triangles of a leaf, or below an inner node.
    pub(crate) fn least_below(&self, node: Node) -> u32 {
        let children = |i: usize| {
            let node = &self.nodes()[i];
            (0..A as u32).filter(|&slot| node.has_child(slot)).map(|slot| node.child(slot))
        };
        let prims = |leaf| leaf_places(leaf).map(|place| self.prim(place));
        self.least.below(node, self.nodes().len(), children, prims)
    }
}

/// The data of a hierarchy that a traversal reads: a value, not a reference. So the compiler knows that no write of a
/// traversal moves or shortens the slices, and a node's place is computed and checked once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideTree<'a, const A: usize = 8, V: Precision = Vec3> {
    pub(crate) nodes: &'a [WideNode<A>],
    blocks: &'a [Block<V>],
    levels: u32,
}

impl<'a, const A: usize, V: Precision> WideTree<'a, A, V> {
    /// Returns the blocks from a leaf's first block on, and the number of the leaf's triangles.
    #[inline(always)]
    pub(crate) fn leaf(&self, leaf: Node) -> (&'a [Block<V>], u32) {
        let (first, count) = leaf_parts(leaf);
        (&self.blocks[first..], count)
    }
}

impl<const A: usize, V: Precision> Topology<A> for WideTree<'_, A, V> {
    #[inline(always)]
    fn root(&self) -> Node {
        Node::inner(0)
    }

    #[inline(always)]
    fn children(&self, node: Node) -> u32 {
        let node = &self.nodes[node.index()];
        (0..A as u32).fold(0, |set, slot| set | u32::from(node.has_child(slot)) << slot)
    }

    #[inline(always)]
    fn leaves(&self, node: Node) -> u32 {
        self.nodes[node.index()].leaves()
    }

    #[inline(always)]
    fn child(&self, node: Node, slot: u32) -> Node {
        self.nodes[node.index()].child(slot)
    }

    #[inline(always)]
    fn levels(&self) -> u32 {
        self.levels
    }

    #[inline(always)]
    fn ancestor(&self, node: Node, up: u32) -> Node {
        self.nodes[node.index()].ancestor(up)
    }
}

impl<const A: usize, V: Precision> Topology<A> for WideBvh<A, V> {
    #[inline(always)]
    fn root(&self) -> Node {
        self.tree().root()
    }

    #[inline(always)]
    fn children(&self, node: Node) -> u32 {
        self.tree().children(node)
    }

    #[inline(always)]
    fn leaves(&self, node: Node) -> u32 {
        self.tree().leaves(node)
    }

    #[inline(always)]
    fn child(&self, node: Node, slot: u32) -> Node {
        self.tree().child(node, slot)
    }

    #[inline(always)]
    fn levels(&self) -> u32 {
        self.levels
    }

    #[inline(always)]
    fn ancestor(&self, node: Node, up: u32) -> Node {
        self.tree().ancestor(node, up)
    }
}

impl<const A: usize> WideNode<A> {
    /// A node without children.
    pub const EMPTY: Self =
        Self { planes: [[[f32::INFINITY; A], [f32::NEG_INFINITY; A]]; 3], children: [0; A], ancestors: [0; A] };

    /// Returns the child in a slot; the root's address if the slot is empty.
    #[inline(always)]
    pub fn child(&self, slot: u32) -> Node {
        Node::from_bits(self.children[slot as usize & (A - 1)])
    }

    /// Returns whether a slot holds a child.
    #[inline(always)]
    pub fn has_child(&self, slot: u32) -> bool {
        self.children[slot as usize & (A - 1)] != 0
    }

    /// Returns whether a slot holds an inner node.
    #[inline(always)]
    pub fn has_inner(&self, slot: u32) -> bool {
        self.has_child(slot) && !self.child(slot).is_leaf()
    }

    /// Returns the slots that hold leaves.
    #[inline(always)]
    pub fn leaves(&self) -> u32 {
        self.ancestors[0] >> ANCESTOR_BITS
    }

    /// Returns one of the `A` nearest ancestors: 1 for the parent, and so on.
    #[inline(always)]
    pub fn ancestor(&self, levels: u32) -> Node {
        Node::inner(self.ancestors[levels.wrapping_sub(1) as usize & (A - 1)] & ((1 << ANCESTOR_BITS) - 1))
    }

    /// Returns the box in a slot.
    pub fn child_box(&self, slot: u32) -> Aabb {
        let at = |side: usize| Vec3::from_array([0, 1, 2].map(|axis| self.planes[axis][side][slot as usize & (A - 1)]));
        Aabb { lo: at(0), hi: at(1) }
    }

    /// Returns the box around all children.
    fn aabb(&self) -> Aabb {
        (0..A as u32).map(|slot| self.child_box(slot)).fold(Aabb::EMPTY, Aabb::union)
    }

    fn set_child_box(&mut self, slot: u32, aabb: &Aabb) {
        for (axis, [lo, hi]) in self.planes.iter_mut().enumerate() {
            (lo[slot as usize & (A - 1)], hi[slot as usize & (A - 1)]) = (aabb.lo[axis], aabb.hi[axis]);
        }
    }
}

/// Returns the place of a leaf's first block, and the number of its triangles.
#[inline(always)]
fn leaf_parts(leaf: Node) -> (usize, u32) {
    let index = leaf.index() as u32;
    ((index & ((1 << BLOCK_BITS) - 1)) as usize, index >> BLOCK_BITS & MAX_COUNT)
}

/// Returns the places of a leaf's triangles: four times the block's index, plus the lane.
pub(crate) fn leaf_places(leaf: Node) -> Range<usize> {
    let (first, count) = leaf_parts(leaf);
    4 * first..4 * first + count as usize
}

/// Writes the ancestors and leaf sets of records, with `name` for their indices. It skips a child that does not come
/// after its parent.
fn name_ancestors<const A: usize>(nodes: &mut [WideNode<A>], name: impl Fn(usize) -> u32) {
    for index in 0..nodes.len() {
        for slot in 0..A as u32 {
            let node = &nodes[index];
            let (child, above) = (node.child(slot), node.ancestors);
            if !node.has_child(slot) {
                continue;
            }
            if child.is_leaf() {
                nodes[index].ancestors[0] |= 1 << (ANCESTOR_BITS + slot);
            } else if child.index() > index
                && let Some(below) = nodes.get_mut(child.index())
            {
                // Its own leaves are not known yet; they follow in its iteration.
                below.ancestors[0] = name(index);
                for (own, above) in below.ancestors[1..].iter_mut().zip(above) {
                    *own = above & ((1 << ANCESTOR_BITS) - 1);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
