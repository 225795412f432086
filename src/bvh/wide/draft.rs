//! The binary tree that is collapsed.

use std::ops::Range;

use super::CUT;
use crate::bvh::Bvh;
use crate::geom::{Aabb, Triangle, Vector};
use crate::order::Side;
use crate::threads;
use crate::tree::{Node, Topology};

/// A binary tree in which no leaf has more triangles than it may.
///
/// Children stand side by side. What is below the left one stands behind them, then what is below the right one. So all
/// descendants of a node are one range, and threads fill ranges of their own.
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

/// What is below a node.
enum Below {
    /// A node of the hierarchy, with the numbers of its leaves.
    Subtree(Node, Range<u32>),
    /// Triangles of a leaf that is halved.
    Part(Range<u32>),
}

/// A node whose descendants are to be written.
struct Task<'d> {
    below: Below,
    aabb: Aabb,
    /// The place of the first of `nodes`.
    from: u32,
    /// The descendants.
    nodes: &'d mut [DraftNode],
}

impl Draft {
    /// A leaf of more than `max_leaf` triangles is halved until none is.
    pub(super) fn of<V: Vector>(bvh: &Bvh<Triangle<V>>, max_leaf: u32) -> Self {
        let source = Source::new(bvh, max_leaf);
        let (root, aabb) = (Below::Subtree(bvh.root(), 0..bvh.leaves().len() as u32), bvh.bounds());
        let none = DraftNode { aabb: Aabb::EMPTY, children: None, first: 0, count: 0 };
        let mut nodes = vec![none; 2 * source.leaves(&root) as usize - 1];
        let (first, rest) = nodes.split_at_mut(1);
        first[0] = source.node(&root, aabb, 1);
        let (mut open, mut small) = (vec![Task { below: root, aabb, from: 1, nodes: rest }], Vec::new());
        while let Some(task) = open.pop() {
            if task.nodes.len() > CUT {
                open.extend(source.divide(task));
            } else {
                small.push(Some(task));
            }
        }
        threads::update(&mut small, 1, |task| {
            let mut open: Vec<_> = task.take().into_iter().collect();
            while let Some(task) = open.pop() {
                if !task.nodes.is_empty() {
                    open.extend(source.divide(task));
                }
            }
        });
        drop(small);
        Self { nodes }
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

/// A hierarchy, and how many leaves of the draft are before each of its leaves.
struct Source<'a, V: Vector> {
    bvh: &'a Bvh<Triangle<V>>,
    max_leaf: u32,
    before: Vec<u32>,
}

impl<'a, V: Vector> Source<'a, V> {
    fn new(bvh: &'a Bvh<Triangle<V>>, max_leaf: u32) -> Self {
        let mut sum = 0;
        let counts = bvh.leaves().iter().map(|leaf| parts(leaf.count, max_leaf));
        let before = [0].into_iter().chain(counts.map(|count| {
            sum += count;
            sum
        }));
        Self { bvh, max_leaf, before: before.collect() }
    }

    /// How many leaves of the draft are below.
    fn leaves(&self, below: &Below) -> u32 {
        match below {
            Below::Subtree(_, leaves) => self.before[leaves.end as usize] - self.before[leaves.start as usize],
            Below::Part(triangles) => parts(triangles.len() as u32, self.max_leaf),
        }
    }

    /// A node whose descendants begin at a place.
    fn node(&self, below: &Below, aabb: Aabb, from: u32) -> DraftNode {
        let triangles = match below {
            Below::Subtree(_, leaves) => {
                let range = |leaf: u32| self.bvh.leaf_range(Node::leaf(leaf));
                range(leaves.start).start as u32..range(leaves.end - 1).end as u32
            }
            Below::Part(triangles) => triangles.clone(),
        };
        let children = (self.leaves(below) > 1).then_some([from, from + 1]);
        DraftNode { aabb, children, first: triangles.start, count: triangles.len() as u32 }
    }

    /// Writes the children of a node that has some.
    fn divide<'d>(&self, task: Task<'d>) -> [Task<'d>; 2] {
        let Task { below, aabb, from, nodes } = task;
        let [(left, left_box), (right, right_box)] = self.halves(below, &aabb);
        let (children, rest) = nodes.split_at_mut(2);
        let (of_left, of_right) = rest.split_at_mut(2 * self.leaves(&left) as usize - 2);
        let starts = [from + 2, from + 2 + of_left.len() as u32];
        children[0] = self.node(&left, left_box, starts[0]);
        children[1] = self.node(&right, right_box, starts[1]);
        [
            Task { below: left, aabb: left_box, from: starts[0], nodes: of_left },
            Task { below: right, aabb: right_box, from: starts[1], nodes: of_right },
        ]
    }

    fn halves(&self, below: Below, aabb: &Aabb) -> [(Below, Aabb); 2] {
        match below {
            Below::Subtree(node, leaves) if !node.is_leaf() => {
                let [left, right] = self.bvh.children(node);
                // Inner nodes and leaves are numbered in depth-first order.
                let middle = match (left.is_leaf(), right.is_leaf()) {
                    (true, _) => leaves.start + 1,
                    (_, true) => right.index() as u32,
                    _ => leaves.start + (right.index() - left.index()) as u32 + 1,
                };
                let boxes = [Side::Left, Side::Right].map(|side| self.bvh.node(node.index()).child_box(side));
                [
                    (Below::Subtree(left, leaves.start..middle), boxes[0]),
                    (Below::Subtree(right, middle..leaves.end), boxes[1]),
                ]
            }
            Below::Subtree(leaf, _) => {
                let triangles = self.bvh.leaf_range(leaf);
                self.halves(Below::Part(triangles.start as u32..triangles.end as u32), aabb)
            }
            Below::Part(Range { start, end }) => {
                let middle = start + (end - start) / 2;
                // A leaf's box may hold only parts of its triangles: then other leaves hold the others.
                let half = |triangles: Range<u32>| {
                    let held = &self.bvh.triangles()[triangles.start as usize..triangles.end as usize];
                    let around =
                        held.iter().fold(Aabb::EMPTY, |around, held| around.union(self.bvh.frame().aabb(&held.shape)));
                    (Below::Part(triangles), around.intersection(aabb))
                };
                [half(start..middle), half(middle..end)]
            }
        }
    }
}

/// Leaves of at most `max_leaf` triangles that so many are halved into.
fn parts(count: u32, max_leaf: u32) -> u32 {
    if count <= max_leaf { 1 } else { parts(count / 2, max_leaf) + parts(count - count / 2, max_leaf) }
}

/// The address of a leaf.
pub(super) const fn leaf_address(block: usize, count: usize) -> Node {
    Node::leaf((count as u32) << super::BLOCK_BITS | block as u32)
}
