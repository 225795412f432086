//! A hierarchy while it is built, in whatever order suits the builder, and its layout.

use super::Primitives;
use crate::bvh::{Bvh, BvhNode, Leaf, LeafTriangle};
use crate::geom::{Aabb, Region};
use crate::order::Side;
use crate::tree::{Node, Recorded};

/// What a builder makes. Node 0 is the root; nodes that are not reached from it do not count.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) nodes: Vec<DraftNode>,
    /// Indices of primitives; each leaf has a range.
    pub(super) references: Vec<u32>,
}

/// An inner node, whose children stand side by side, or a leaf.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct DraftNode {
    /// Holds everything below. Those of children are inside of their parent's.
    pub(super) aabb: Aabb,
    /// Of an inner node its left child, of a leaf its first reference.
    first: u32,
    /// Of a leaf the number of references, at least 1; of an inner node [`INNER`] and the axis.
    tag: u32,
}

const INNER: u32 = 1 << 31;

impl DraftNode {
    /// What stands where there is no node.
    pub(super) const NONE: Self = Self { aabb: Aabb::EMPTY, first: 0, tag: 0 };

    /// An inner node with children at `left` and `left + 1`, of which the left one has the smaller centroids on `axis`.
    pub(super) fn inner(aabb: Aabb, left: usize, axis: usize) -> Self {
        Self { aabb, first: left as u32, tag: INNER | axis as u32 }
    }

    /// A leaf with a range of references, not empty.
    pub(super) fn leaf(aabb: Aabb, first: usize, count: usize) -> Self {
        Self { aabb, first: first as u32, tag: count as u32 }
    }

    pub(super) fn is_leaf(&self) -> bool {
        self.tag & INNER == 0
    }

    /// Left and right child of an inner node.
    pub(super) fn children(&self) -> [usize; 2] {
        [self.first as usize, self.first as usize + 1]
    }

    /// Split axis of an inner node.
    pub(super) fn axis(&self) -> usize {
        (self.tag & !INNER) as usize
    }

    /// Where the references of a leaf are.
    pub(super) fn references(&self) -> std::ops::Range<usize> {
        self.first as usize..self.first as usize + self.tag as usize
    }
}

impl Draft {
    /// Writes nodes, leaves and shapes in depth-first order.
    pub(super) fn lay_out<P: Primitives + ?Sized>(&self, primitives: &P, dropped: usize) -> Bvh<P::Shape> {
        let bounds = self.nodes[0].aabb;
        let mut bvh = Bvh {
            root: Node::leaf(0),
            depth: 0,
            dropped,
            duplicates: self.references.len() + dropped - primitives.count(),
            recorded: Recorded::Nothing,
            bounds,
            region: Region::of(&bounds),
            nodes: Vec::new(),
            axes: Vec::new(),
            leaves: Vec::new(),
            triangles: Vec::with_capacity(self.references.len()),
        };
        // Nodes still to be laid out, and the place that waits for the address of each.
        let mut pending = vec![(0, 0, None)];
        while let Some((index, depth, parent)) = pending.pop() {
            let draft = &self.nodes[index];
            let node = if draft.is_leaf() {
                let first = bvh.triangles.len() as u32;
                bvh.leaves.push(Leaf { first, count: draft.references().len() as u32, links: [Node::leaf(0); 2] });
                let held = |&prim: &u32| LeafTriangle { shape: primitives.shape(prim as usize), prim };
                bvh.triangles.extend(self.references[draft.references()].iter().map(held));
                Node::leaf(bvh.leaves.len() as u32 - 1)
            } else {
                let i = bvh.nodes.len();
                let [left, right] = draft.children();
                let mut node =
                    BvhNode { planes: [[0.0; 4]; 3], children: [Node::leaf(0); 2], links: [Node::leaf(0); 2] };
                node.set_child_box(Side::Left, &self.nodes[left].aabb);
                node.set_child_box(Side::Right, &self.nodes[right].aabb);
                bvh.nodes.push(node);
                bvh.axes.push(draft.axis() as u8);
                // The left child is laid out next.
                pending.push((right, depth + 1, Some((i, 1))));
                pending.push((left, depth + 1, Some((i, 0))));
                Node::inner(i as u32)
            };
            bvh.depth = bvh.depth.max(depth);
            match parent {
                Some((i, side)) => bvh.nodes[i].children[side] = node,
                None => bvh.root = node,
            }
        }
        bvh.with_links(Recorded::Uncles)
    }
}
