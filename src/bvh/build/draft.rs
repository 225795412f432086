//! A hierarchy while it is built, in whatever order suits the builder, and its layout.

use super::Primitives;
use super::item::CHUNK;
use crate::bvh::least::Least;
use crate::bvh::{Bvh, BvhNode, BvhTree, Leaf, LeafTriangle};
use crate::geom::{Aabb, Region};
use crate::order::SignOrder;
use crate::threads;
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

    /// The same where all places are `by` further on.
    pub(super) fn moved(mut self, by: usize) -> Self {
        if !self.is_leaf() {
            self.first += by as u32;
        }
        self
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

/// For children that no plane has parted: the axis on which their centres differ most, and whether the first one has
/// the smaller centre there.
pub(super) fn order_of(first: &Aabb, second: &Aabb) -> (usize, bool) {
    let apart = second.centroid() - first.centroid();
    let axis = apart.abs().max_position();
    (axis, apart[axis] >= 0.0)
}

impl Draft {
    /// Writes nodes, leaves and shapes in depth-first order.
    pub(super) fn lay_out<P: Primitives + ?Sized>(&self, primitives: &P, dropped: usize) -> Bvh<P::Shape> {
        let bounds = self.nodes[0].aabb;
        let Layout { nodes, axes, leaves, prims, root, depth } = Layout::of(self);
        let held = |prim: u32| LeafTriangle { shape: primitives.shape(prim as usize), prim };
        let triangles = threads::map(0..prims.len(), CHUNK, |i| held(prims[i]));
        let (recorded, region) = (Recorded::ParentSibling, Region::within(primitives.frame(), &bounds));
        let duplicates = self.references.len() + dropped - primitives.count();
        let tree = BvhTree { root, depth, recorded, nodes, axes, leaves };
        Bvh { dropped, duplicates, bounds, region, tree, triangles, least: Least::default() }
    }
}

/// All but the shapes.
struct Layout {
    nodes: Vec<BvhNode>,
    axes: Vec<u8>,
    leaves: Vec<Leaf>,
    /// Of all leaves.
    prims: Vec<u32>,
    root: Node,
    depth: u32,
}

impl Layout {
    fn of(draft: &Draft) -> Self {
        // Leaves that are not reached are counted too, so this is room enough.
        let leaves = draft.nodes.iter().filter(|node| node.is_leaf() && node.tag > 0).count();
        let mut layout = Self {
            nodes: Vec::with_capacity(leaves),
            axes: Vec::with_capacity(leaves),
            leaves: Vec::with_capacity(leaves),
            prims: Vec::with_capacity(draft.references.len()),
            root: if draft.nodes[0].is_leaf() { Node::leaf(0) } else { Node::inner(0) },
            depth: 0,
        };
        layout.place(draft);
        layout.link();
        layout
    }

    /// Places all nodes, which name no others than their children yet.
    fn place(&mut self, draft: &Draft) {
        let links = [self.root; 2];
        // Nodes still to be placed, and where the address of each is to stand.
        let mut pending = vec![(0, 0, None)];
        while let Some((index, depth, parent)) = pending.pop() {
            let node = &draft.nodes[index];
            let is_leaf = node.is_leaf();
            let address =
                if is_leaf { Node::leaf(self.leaves.len() as u32) } else { Node::inner(self.nodes.len() as u32) };
            if let Some((parent, side)) = parent {
                let parent: &mut BvhNode = &mut self.nodes[parent];
                parent.children[side] = address;
            }
            if is_leaf {
                let (first, count) = (self.prims.len() as u32, node.references().len() as u32);
                self.leaves.push(Leaf { first, count, links });
                self.prims.extend_from_slice(&draft.references[node.references()]);
                self.depth = self.depth.max(depth);
                continue;
            }
            let [mut left, mut right] = node.children();
            let mut axis = node.axis() as u8;
            // The larger one is the left one: it is visited more often, and stands behind its parent.
            if draft.nodes[left].aabb.half_area() < draft.nodes[right].aabb.half_area() {
                (left, right) = (right, left);
                axis |= SignOrder::REVERSED;
            }
            // The left child is placed next.
            pending.push((right, depth + 1, Some((address.index(), 1))));
            pending.push((left, depth + 1, Some((address.index(), 0))));
            self.axes.push(axis);
            let mut node = BvhNode { planes: [[0.0; 4]; 3], children: links, links };
            node.set_child_boxes(&draft.nodes[left].aabb, &draft.nodes[right].aabb);
            self.nodes.push(node);
        }
    }

    /// Has all records name parent and sibling, which the default traversal climbs by. The root names itself.
    fn link(&mut self) {
        for i in 0..self.nodes.len() {
            let [left, right] = self.nodes[i].children;
            for (child, sibling) in [(left, right), (right, left)] {
                let index = child.index();
                let links = if child.is_leaf() { &mut self.leaves[index].links } else { &mut self.nodes[index].links };
                *links = [Node::inner(i as u32), sibling];
            }
        }
    }
}
