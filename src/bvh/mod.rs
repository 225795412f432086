//! The bounding volume hierarchy of the ray tracer.
//!
//! An inner node holds the boxes of both children, so one visit decides on both (Aila & Laine 2009, "Understanding the
//! efficiency of ray traversal on GPUs"). Inner nodes and leaves have separate indices, each in depth-first order: a
//! left child that is an inner node follows its parent. Builders put the child of larger surface on the left. Triangles
//! are in the order of the leaves.

mod build;
pub(crate) mod bytes;
mod cover;
mod least;
mod primitives;
mod refit;
mod tree;
mod validate;
pub mod wide;

pub use build::{BuildError, BuildOptions, Builder, Degenerate, SahOptions, SpatialOptions};
pub use bytes::{BvhFileError, FileError};
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
/// Boxes are in single precision. Boxes of a [`Mesh`](crate::geom::Mesh) in double precision are rounded outwards, in a
/// separate [frame](Self::frame) for each mesh. So they are equally tight far from the origin, and in any unit.
/// `[FRAME-1]`
///
/// ```
/// use stackless_bvh::glam::Vec3;
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

/// A triangle in a leaf, as its corners or as another [`Shape`](crate::geom::Kernel::Shape) of a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LeafTriangle<S = Triangle> {
    /// The corners, as in the mesh, or the kernel's precomputed form of them.
    pub shape: S,
    /// Index of the triangle in the mesh.
    pub prim: u32,
}

impl<S> Bvh<S> {
    /// Returns the frame of the boxes: [`Frame::IDENTITY`] over meshes in single precision.
    #[inline]
    pub fn frame(&self) -> &Frame {
        self.region.frame()
    }

    /// Returns the box of all triangles, in the [frame](Self::frame).
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Returns the properties of the whole hierarchy that ray tests need.
    #[inline]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// Returns the number of degenerate triangles of the mesh that were [omitted](Degenerate::LeftOut).
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// Returns the number of references to triangles beyond the first of each: 0 unless spatial splits divided some
    /// triangles.
    ///
    /// If this is 0, a leaf's box contains all of its triangles. Otherwise it contains the parts that the other leaves
    /// of the triangle do not contain, and a query for more than the closest hit meets some triangles repeatedly.
    pub fn duplicates(&self) -> usize {
        self.duplicates
    }

    /// Returns nodes and leaves, without the triangles: the type for which traversals are compiled.
    #[inline]
    pub fn tree(&self) -> &BvhTree {
        &self.tree
    }

    /// Returns the inner nodes, by [`Node::index`].
    pub fn nodes(&self) -> &[BvhNode] {
        &self.tree.nodes
    }

    /// Returns the leaves, by [`Node::index`].
    pub fn leaves(&self) -> &[Leaf] {
        &self.tree.leaves
    }

    /// Returns all triangles, in the order of the leaves.
    pub fn triangles(&self) -> &[LeafTriangle<S>] {
        &self.triangles
    }

    /// Returns the inner node at index `i`, which must exist.
    #[inline]
    pub fn node(&self, i: usize) -> &BvhNode {
        &self.tree.nodes[i]
    }

    /// Returns the leaf of the triangle at `place` in [`triangles`](Self::triangles), which must exist.
    pub fn leaf_of(&self, place: usize) -> Node {
        let after = self.tree.leaves.partition_point(|leaf| leaf.first as usize <= place);
        Node::leaf(after.saturating_sub(1) as u32)
    }

    /// Returns the triangles of a leaf, which must be in this tree.
    #[inline]
    pub fn leaf_triangles(&self, leaf: Node) -> &[LeafTriangle<S>] {
        &self.triangles[self.leaf_range(leaf)]
    }

    /// Returns the range of a leaf's triangles in [`triangles`](Self::triangles). The leaf must be in this tree.
    #[inline]
    pub fn leaf_range(&self, leaf: Node) -> Range<usize> {
        let Leaf { first, count, .. } = self.tree.leaves[leaf.index()];
        first as usize..first as usize + count as usize
    }

    /// Returns for each inner node the axis (0, 1, 2) along which the centers of its children differ most, plus
    /// [`SignOrder::REVERSED`](crate::order::SignOrder::REVERSED) if the center of the right child is smaller.
    pub fn axes(&self) -> &[u8] {
        &self.tree.axes
    }

    /// Returns each node's own box, by [`slot`](Topology::slot): the numbers of the parent's record, and
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

    /// Returns this hierarchy with other references in the two free fields of each record. Initially they refer to
    /// parent and sibling.
    #[must_use]
    pub fn with_links(mut self, recorded: Recorded) -> Self {
        self.tree.record(recorded);
        self
    }

    /// Returns the memory of nodes, leaves and triangles, in bytes. (Axes, which few traversals use, are not counted.)
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.tree.nodes) + size_of_val(&*self.tree.leaves) + size_of_val(&*self.triangles)
    }

    /// Returns this hierarchy with other shapes in its leaves, computed from its triangles.
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
