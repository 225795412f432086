//! The binary tree that is collapsed.

use crate::bvh::Bvh;
use crate::geom::Aabb;
use crate::order::Side;
use crate::tree::{Node, Topology};

/// A binary tree in which no leaf has more triangles than it may. A parent stands before its children.
pub(super) struct Draft {
    pub(super) nodes: Vec<DraftNode>,
}

/// A node of it, and all triangles below, which are one range of [`Bvh::triangles`].
#[derive(Clone, Copy)]
pub(super) struct DraftNode {
    pub(super) aabb: Aabb,
    /// `None` of a leaf.
    pub(super) children: Option<[u32; 2]>,
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Draft {
    /// A leaf of more than `max_leaf` triangles is halved until none is.
    pub(super) fn of(bvh: &Bvh, max_leaf: u32) -> Self {
        let mut draft = Self { nodes: Vec::with_capacity(bvh.nodes().len() + bvh.leaves().len()) };
        draft.nodes.push(DraftNode { aabb: bvh.bounds(), children: None, first: 0, count: 0 });
        let mut pending = vec![(bvh.root(), 0_usize)];
        while let Some((node, place)) = pending.pop() {
            if node.is_leaf() {
                let range = bvh.leaf_range(node);
                draft.nodes[place].first = range.start as u32;
                draft.nodes[place].count = range.len() as u32;
                draft.halve(bvh, place, max_leaf);
                continue;
            }
            let children = bvh.children(node);
            let at = draft.add([Side::Left, Side::Right].map(|side| bvh.node(node.index()).child_box(side)));
            draft.nodes[place].children = Some(at);
            pending.extend(children.into_iter().zip(at.map(|at| at as usize)));
        }
        draft.count();
        draft
    }

    fn add(&mut self, boxes: [Aabb; 2]) -> [u32; 2] {
        let at = self.nodes.len() as u32;
        self.nodes.extend(boxes.map(|aabb| DraftNode { aabb, children: None, first: 0, count: 0 }));
        [at, at + 1]
    }

    /// Halves a leaf, and its halves, where they are too large.
    fn halve(&mut self, bvh: &Bvh, place: usize, max_leaf: u32) {
        let mut pending = vec![place];
        while let Some(place) = pending.pop() {
            let DraftNode { aabb, first, count, .. } = self.nodes[place];
            if count <= max_leaf {
                continue;
            }
            let middle = first + count / 2;
            let halves = [(first, count / 2), (middle, count - count / 2)];
            // A leaf's box may hold only parts of its triangles: then other leaves hold the others.
            let within = |(first, count): (u32, u32)| {
                let held = &bvh.triangles()[first as usize..(first + count) as usize];
                let around = held.iter().fold(Aabb::EMPTY, |around, held| around.union(held.shape.aabb()));
                around.intersection(&aabb)
            };
            let at = self.add(halves.map(within));
            for (at, (first, count)) in at.into_iter().zip(halves) {
                (self.nodes[at as usize].first, self.nodes[at as usize].count) = (first, count);
            }
            self.nodes[place].children = Some(at);
            pending.extend(at.map(|at| at as usize));
        }
    }

    /// Of all inner nodes, the triangles below.
    fn count(&mut self) {
        for place in (0..self.nodes.len()).rev() {
            if let Some(children) = self.nodes[place].children {
                let [left, right] = children.map(|child| self.nodes[child as usize]);
                self.nodes[place].first = left.first.min(right.first);
                self.nodes[place].count = left.count + right.count;
            }
        }
    }

    /// The leaves below a node, from left to right.
    pub(super) fn leaves_below(&self, place: u32) -> Vec<u32> {
        let (mut leaves, mut pending) = (Vec::new(), vec![place]);
        while let Some(place) = pending.pop() {
            match self.nodes[place as usize].children {
                Some([left, right]) => pending.extend([right, left]),
                None => leaves.push(place),
            }
        }
        leaves
    }
}

/// The address of a leaf.
pub(super) const fn leaf_address(block: usize, count: usize) -> Node {
    Node::leaf((count as u32) << super::BLOCK_BITS | block as u32)
}
