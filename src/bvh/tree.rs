//! The nodes of a hierarchy, independent of the leaf contents.

use glam::Vec3;

use crate::geom::Aabb;
use crate::order::Side;
use crate::tree::{self, Node, Recorded, Topology};

/// The tree of a [`Bvh`](super::Bvh): nodes and leaves without the triangles. Traversals run over this one type, so
/// they are not compiled again for each shape.
#[derive(Clone, Debug)]
pub struct BvhTree {
    pub(super) root: Node,
    pub(super) depth: u32,
    pub(super) recorded: Recorded,
    pub(super) nodes: Vec<BvhNode>,
    pub(super) axes: Vec<u8>,
    pub(super) leaves: Vec<Leaf>,
}

/// An inner node: 64 bytes, one cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct BvhNode {
    /// For each axis: lo and hi of the left child, lo and hi of the right child.
    pub planes: [[f32; 4]; 3],
    /// Left and right child.
    pub children: [Node; 2],
    /// Two further references; [`Topology::recorded`] determines them (Binder & Keller 2016, Fig. 4).
    pub links: [Node; 2],
}

/// A leaf: a range of [`Bvh::triangles`](super::Bvh::triangles), never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Leaf {
    /// Index of the first triangle.
    pub first: u32,
    /// Number of triangles.
    pub count: u32,
    /// Two further references; [`Topology::recorded`] determines them (Binder & Keller 2016, Fig. 5).
    pub links: [Node; 2],
}

impl BvhTree {
    /// Returns the axis of each inner node, as [`Bvh::axes`](super::Bvh::axes).
    pub fn axes(&self) -> &[u8] {
        &self.axes
    }

    /// Writes other references into the two free fields of each record.
    pub(super) fn record(&mut self, recorded: Recorded) {
        self.recorded = recorded;
        let rows = tree::link_rows(self, recorded);
        let (inner, leaves) = rows.split_at(self.nodes.len());
        for (node, &links) in self.nodes.iter_mut().zip(inner) {
            node.links = links;
        }
        for (leaf, &links) in self.leaves.iter_mut().zip(leaves) {
            leaf.links = links;
        }
    }
}

impl Topology for BvhTree {
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
    /// Returns the box of a child.
    #[inline]
    pub fn child_box(&self, side: Side) -> Aabb {
        let at = |plane: usize| Vec3::from_array(self.planes.map(|axis| axis[2 * side.index() + plane]));
        Aabb { lo: at(0), hi: at(1) }
    }

    /// Sets the boxes of the left and of the right child.
    pub(super) fn set_child_boxes(&mut self, left: &Aabb, right: &Aabb) {
        self.planes = [0, 1, 2].map(|axis| [left.lo[axis], left.hi[axis], right.lo[axis], right.hi[axis]]);
    }
}
