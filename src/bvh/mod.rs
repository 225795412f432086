//! The bounding volume hierarchy of the ray tracer.
//!
//! An inner node holds the boxes of both children, so that one visit decides on both (Aila & Laine 2009,
//! "Understanding the efficiency of ray traversal on GPUs"). Inner nodes and leaves are numbered apart, each in
//! depth-first order: a left child that is an inner node follows its parent. Of two children, builders make the one of
//! the larger surface the left one. Triangles lie in the order of the leaves.

mod build;
mod bytes;
mod cover;
mod least;
mod primitives;
mod refit;
mod tree;
mod validate;
pub mod wide;

pub use build::{BuildError, BuildOptions, Builder, Degenerate, SahOptions, SpatialOptions};
pub use bytes::{BvhFileError, FileError, Stored};
pub use primitives::{Bounded, Primitives};
pub use refit::RefitError;
pub use tree::{BvhNode, BvhTree, Leaf};
pub use validate::{BvhError, validate};
pub use wide::{WideBvh, WideError};

use std::ops::Range;

use crate::geom::{Aabb, Frame, Region, Triangle};
use crate::order::Side;
use crate::topology_of;
use crate::tree::{Node, Recorded, Topology};
use least::Least;

/// A binary bounding volume hierarchy over the triangles of a mesh, with a copy of their corners.
///
/// Boxes are in single precision. Those of a [`Mesh`](crate::geom::Mesh) in double precision are rounded outwards, in a
/// [frame](Self::frame) of their own: so they are as good far from the origin, and in any unit. `[FRAME-1]`
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{bvh::{self, Bvh, SahOptions}, geom::Mesh};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// bvh::validate(&bvh, &mesh)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Bvh<S = Triangle> {
    dropped: usize,
    duplicates: usize,
    bounds: Aabb,
    region: Region,
    tree: BvhTree,
    triangles: Vec<LeafTriangle<S>>,
    least: Least,
}

/// A triangle as a leaf holds it, by its corners or in another [`Shape`](crate::geom::Kernel::Shape) that a kernel
/// wants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LeafTriangle<S = Triangle> {
    /// Corners, as in the mesh, or what a kernel makes of them.
    pub shape: S,
    /// Index of the triangle in the mesh.
    pub prim: u32,
}

impl<S> Bvh<S> {
    /// In which boxes are: [`Frame::IDENTITY`] over meshes in single precision.
    #[inline]
    pub fn frame(&self) -> &Frame {
        self.region.frame()
    }

    /// Box of all triangles, in the [frame](Self::frame).
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What the tests of a ray need to know of the whole.
    #[inline]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// How many degenerate triangles of the mesh were [left out](Degenerate::LeftOut).
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// How many references to triangles there are beyond the first of each: 0 unless spatial splits cut some in two.
    ///
    /// A leaf's box holds all of its triangles where this is 0. Otherwise it holds those parts of them that other
    /// leaves do not hold, and a query that looks at more than the closest hit meets some triangles again.
    pub fn duplicates(&self) -> usize {
        self.duplicates
    }

    /// Nodes and leaves, without the triangles: what a traversal is compiled for.
    #[inline]
    pub fn tree(&self) -> &BvhTree {
        &self.tree
    }

    /// Inner nodes, by [`Node::index`].
    pub fn nodes(&self) -> &[BvhNode] {
        &self.tree.nodes
    }

    /// Leaves, by [`Node::index`].
    pub fn leaves(&self) -> &[Leaf] {
        &self.tree.leaves
    }

    /// All triangles, in the order of the leaves.
    pub fn triangles(&self) -> &[LeafTriangle<S>] {
        &self.triangles
    }

    /// The inner node at index `i`, which must be one.
    #[inline]
    pub fn node(&self, i: usize) -> &BvhNode {
        &self.tree.nodes[i]
    }

    /// The leaf that holds the triangle at `place` in [`triangles`](Self::triangles), which must be one.
    pub fn leaf_of(&self, place: usize) -> Node {
        let after = self.tree.leaves.partition_point(|leaf| leaf.first as usize <= place);
        Node::leaf(after.saturating_sub(1) as u32)
    }

    /// Triangles of a leaf, which must be one of this tree.
    #[inline]
    pub fn leaf_triangles(&self, leaf: Node) -> &[LeafTriangle<S>] {
        &self.triangles[self.leaf_range(leaf)]
    }

    /// Where in [`triangles`](Self::triangles) those of a leaf are, which must be one of this tree.
    #[inline]
    pub fn leaf_range(&self, leaf: Node) -> Range<usize> {
        let Leaf { first, count, .. } = self.tree.leaves[leaf.index()];
        first as usize..first as usize + count as usize
    }

    /// Axis (0, 1, 2) along which the middles of each inner node's children differ most, plus
    /// [`SignOrder::REVERSED`](crate::order::SignOrder::REVERSED) where it is the right child whose middle is less.
    pub fn axes(&self) -> &[u8] {
        &self.tree.axes
    }

    /// Each node's own box, by [`slot`](Topology::slot): the numbers that the parent's record holds, and
    /// [`bounds`](Self::bounds) for the root.
    pub fn own_boxes(&self) -> Vec<Aabb> {
        let mut boxes = vec![self.bounds; self.node_count()];
        for node in &self.tree.nodes {
            for side in [Side::Left, Side::Right] {
                boxes[self.slot(node.children[side.index()])] = node.child_box(side);
            }
        }
        boxes
    }

    /// The same hierarchy with other references in the two free places of each record. Parent and sibling stand there
    /// at first.
    #[must_use]
    pub fn with_links(mut self, recorded: Recorded) -> Self {
        self.tree.record(recorded);
        self
    }

    /// Memory of nodes, leaves and triangles, in bytes. (Axes, which few traversals use, are not counted.)
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.tree.nodes) + size_of_val(&*self.tree.leaves) + size_of_val(&*self.triangles)
    }

    /// The same hierarchy with other shapes in its leaves, made from these.
    #[must_use]
    pub fn map<T>(self, shape: impl Fn(S) -> T) -> Bvh<T> {
        let Self { dropped, duplicates, bounds, region, tree, triangles, least } = self;
        let triangles = triangles.into_iter().map(|t| LeafTriangle { shape: shape(t.shape), prim: t.prim }).collect();
        Bvh { dropped, duplicates, bounds, region, tree, triangles, least }
    }
}

impl<S> Topology for Bvh<S> {
    topology_of!(tree);

    fn recorded(&self) -> Recorded {
        self.tree.recorded()
    }

    #[inline]
    fn links(&self, node: Node) -> [Node; 2] {
        self.tree.links(node)
    }
}

#[cfg(test)]
mod tests;
