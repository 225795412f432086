//! The bounding volume hierarchy of the ray tracer.
//!
//! An inner node holds the boxes of both children, so that one visit decides on both (Aila & Laine 2009,
//! "Understanding the efficiency of ray traversal on GPUs"). Inner nodes and leaves are numbered apart, each in
//! depth-first order: a left child that is an inner node follows its parent. Of two children, builders make the one of
//! the larger surface the left one. Triangles lie in the order of the leaves.

mod build;
mod bytes;
mod cover;
mod primitives;
mod refit;
mod validate;

pub use build::{BuildError, BuildOptions, Builder, Degenerate, SahOptions, SpatialOptions};
pub use bytes::{BvhFileError, Stored};
pub use primitives::{Bounded, Primitives};
pub use refit::RefitError;
pub use validate::{BvhError, validate};

use std::ops::Range;

use glam::Vec3;

use crate::geom::{Aabb, Region, Triangle};
use crate::order::Side;
use crate::tree::{self, Node, Recorded, Topology};

/// A binary bounding volume hierarchy over the triangles of a mesh, with a copy of their corners.
///
/// Boxes are in single precision. Those of a [`Mesh`](crate::geom::Mesh) in double precision are rounded outwards.
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
    root: Node,
    depth: u32,
    dropped: usize,
    duplicates: usize,
    recorded: Recorded,
    bounds: Aabb,
    region: Region,
    nodes: Vec<BvhNode>,
    axes: Vec<u8>,
    leaves: Vec<Leaf>,
    triangles: Vec<LeafTriangle<S>>,
}

/// An inner node: 64 bytes, one cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct BvhNode {
    /// For each axis: lo and hi of the left child, lo and hi of the right child.
    pub planes: [[f32; 4]; 3],
    /// Left and right child.
    pub children: [Node; 2],
    /// Two more references, as [`Topology::recorded`] says (Binder & Keller 2016, Fig. 4).
    pub links: [Node; 2],
}

/// A leaf: a range of [`Bvh::triangles`], never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Leaf {
    /// Index of the first triangle.
    pub first: u32,
    /// Number of triangles.
    pub count: u32,
    /// Two more references, as [`Topology::recorded`] says (Binder & Keller 2016, Fig. 5).
    pub links: [Node; 2],
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
    /// Box of all triangles.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What the tests of a ray need to know of the whole.
    #[inline]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// How many degenerate triangles of the mesh were left out, as no ray meets them.
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

    /// Inner nodes, by [`Node::index`].
    pub fn nodes(&self) -> &[BvhNode] {
        &self.nodes
    }

    /// Leaves, by [`Node::index`].
    pub fn leaves(&self) -> &[Leaf] {
        &self.leaves
    }

    /// All triangles, in the order of the leaves.
    pub fn triangles(&self) -> &[LeafTriangle<S>] {
        &self.triangles
    }

    /// The inner node at index `i`, which must be one.
    #[inline]
    pub fn node(&self, i: usize) -> &BvhNode {
        &self.nodes[i]
    }

    /// The leaf that holds the triangle at `place` in [`triangles`](Self::triangles), which must be one.
    pub fn leaf_of(&self, place: usize) -> Node {
        let after = self.leaves.partition_point(|leaf| leaf.first as usize <= place);
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
        let Leaf { first, count, .. } = self.leaves[leaf.index()];
        first as usize..first as usize + count as usize
    }

    /// Axis (0, 1, 2) along which each inner node was split, plus
    /// [`SignOrder::REVERSED`](crate::order::SignOrder::REVERSED) where it is the right child that holds the smaller
    /// centroids.
    pub fn axes(&self) -> &[u8] {
        &self.axes
    }

    /// Each node's own box, by [`slot`](Topology::slot): the numbers that the parent's record holds, and
    /// [`bounds`](Self::bounds) for the root.
    pub fn own_boxes(&self) -> Vec<Aabb> {
        let mut boxes = vec![self.bounds; self.node_count()];
        for node in &self.nodes {
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
        self.recorded = recorded;
        let rows = tree::link_rows(&self, recorded);
        let (inner, leaves) = rows.split_at(self.nodes.len());
        for (node, &links) in self.nodes.iter_mut().zip(inner) {
            node.links = links;
        }
        for (leaf, &links) in self.leaves.iter_mut().zip(leaves) {
            leaf.links = links;
        }
        self
    }

    /// Memory of nodes, leaves and triangles, in bytes. (Axes, which few traversals use, are not counted.)
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.leaves) + size_of_val(&*self.triangles)
    }

    /// The same hierarchy with other shapes in its leaves, made from these.
    #[must_use]
    pub fn map<T>(self, shape: impl Fn(S) -> T) -> Bvh<T> {
        let Self { root, depth, dropped, duplicates, recorded, bounds, region, nodes, axes, leaves, triangles } = self;
        let triangles = triangles.into_iter().map(|t| LeafTriangle { shape: shape(t.shape), prim: t.prim }).collect();
        Bvh { root, depth, dropped, duplicates, recorded, bounds, region, nodes, axes, leaves, triangles }
    }
}

impl<S> Topology for Bvh<S> {
    fn recorded(&self) -> Recorded {
        self.recorded
    }

    #[inline]
    fn links(&self, node: Node) -> [Node; 2] {
        if node.is_leaf() { self.leaves[node.index()].links } else { self.nodes[node.index()].links }
    }

    #[inline]
    fn root(&self) -> Node {
        self.root
    }

    #[inline]
    fn children(&self, node: Node) -> [Node; 2] {
        self.nodes[node.index()].children
    }

    #[inline]
    fn node_count(&self) -> usize {
        self.nodes.len() + self.leaves.len()
    }

    #[inline]
    fn slot(&self, node: Node) -> usize {
        if node.is_leaf() { self.nodes.len() + node.index() } else { node.index() }
    }

    #[inline]
    fn depth(&self) -> u32 {
        self.depth
    }
}

impl BvhNode {
    /// Box of a child.
    #[inline]
    pub fn child_box(&self, side: Side) -> Aabb {
        let at = |plane: usize| Vec3::from_array(self.planes.map(|axis| axis[2 * side.index() + plane]));
        Aabb { lo: at(0), hi: at(1) }
    }

    /// Sets the boxes of the left and of the right child.
    fn set_child_boxes(&mut self, left: &Aabb, right: &Aabb) {
        self.planes = [0, 1, 2].map(|axis| [left.lo[axis], left.hi[axis], right.lo[axis], right.hi[axis]]);
    }
}

#[cfg(test)]
mod tests;
