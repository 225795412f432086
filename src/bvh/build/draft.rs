//! A tree with a node for each primitive, from which binary and wide hierarchies are written.

use super::record::{CHUNK, Record};
use super::reinsert::reinsert;
use super::sah::NODE_COST;
use super::{BuildError, Primitives, Rounds, SahOptions, filled, reserve, room};
use crate::bvh::least::Least;
use crate::bvh::{Bvh, BvhNode, BvhTree, Leaf, LeafTriangle};
use crate::geom::{Aabb, Region};
use crate::order::SignOrder;
use crate::threads;
use crate::tree::{Node, Recorded};

/// A tree whose root is node 0. Children are adjacent, the first pair at 1; some places may be free.
#[derive(Clone, Debug)]
pub(in crate::bvh) struct Draft {
    pub(in crate::bvh) nodes: Vec<Record>,
    /// Whether one primitive may have several nodes, each for a part of it.
    pub(in crate::bvh) has_parts: bool,
    /// The nodes with their own boxes, if those in `nodes` are scaled.
    pub(super) unscaled: Option<Vec<Record>>,
}

/// The nodes that become leaves.
#[derive(Clone, Copy, Debug)]
pub(super) enum Leaves {
    /// Nodes whose primitives fit in a leaf and cost less there.
    Cheapest,
    /// Nodes whose primitives fit in a leaf.
    Full,
    /// Nodes at this depth.
    At(u32),
}

impl Draft {
    pub(in crate::bvh) fn node(&self, place: u32) -> &Record {
        &self.nodes[place as usize]
    }

    /// Returns the box of a node.
    pub(in crate::bvh) fn aabb(&self, place: u32) -> Aabb {
        self.unscaled.as_ref().unwrap_or(&self.nodes)[place as usize].aabb()
    }

    /// Returns the children of an inner node.
    pub(in crate::bvh) fn children(&self, node: &Record) -> [&Record; 2] {
        [self.node(node.first()), self.node(node.first() + 1)]
    }

    /// Creates a draft of nodes whose children come after their parents, and counts the primitives below each.
    pub(in crate::bvh) fn counted(nodes: Vec<Record>, has_parts: bool) -> Self {
        let mut draft = Self { nodes, has_parts, unscaled: None };
        for place in (0..draft.nodes.len()).rev() {
            let node = &draft.nodes[place];
            if !node.is_leaf() {
                draft.nodes[place] = node.holding(draft.children(node).map(Record::count).iter().sum());
            }
        }
        draft
    }

    /// Calls `visit` with all places, children before their parents.
    fn upward(&self, mut visit: impl FnMut(u32)) -> Result<(), BuildError> {
        let mut order = room(self.nodes.len())?;
        let mut pending = vec![0];
        while let Some(place) = pending.pop() {
            order.push(place);
            let node = self.node(place);
            if !node.is_leaf() {
                pending.extend([node.first(), node.first() + 1]);
            }
        }
        order.into_iter().rev().for_each(&mut visit);
        Ok(())
    }

    /// Returns the draft after these moves.
    pub(in crate::bvh) fn improved(
        mut self,
        rounds: Rounds,
        sah: SahOptions,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Self, BuildError> {
        reinsert(&mut self.nodes, rounds, sah, progress)?;
        Ok(self)
    }

    /// Returns this tree with the boxes of its items, by `aabb`, instead of scaled boxes.
    pub(in crate::bvh) fn fitted(mut self, aabb: impl Fn(u32) -> Aabb) -> Result<Self, BuildError> {
        let mut nodes = filled(Record::NONE, self.nodes.len())?;
        self.upward(|place| {
            let first = self.node(place).first();
            nodes[place as usize] = if self.node(place).is_leaf() {
                Record::item(&aabb(first), first)
            } else {
                Record::parent([0, 1].map(|side| &nodes[(first + side) as usize]), first)
            };
        })?;
        self.unscaled = Some(nodes);
        Ok(self)
    }

    /// Collects the primitives below a node, from left to right. With parts, each is collected once, in order.
    fn prims(&self, place: u32, prims: &mut Vec<u32>) {
        let start = prims.len();
        self.leaves(place, |leaf| prims.push(self.node(leaf).first()));
        if self.has_parts {
            let mut own = prims.split_off(start);
            own.sort_unstable();
            own.dedup();
            prims.append(&mut own);
        }
    }

    /// Calls `visit` with the leaves below a node, from left to right.
    pub(in crate::bvh) fn leaves(&self, place: u32, mut visit: impl FnMut(u32)) {
        let mut pending = vec![place];
        while let Some(place) = pending.pop() {
            let node = self.node(place);
            if node.is_leaf() { visit(place) } else { pending.extend([node.first() + 1, node.first()]) }
        }
    }

    /// Writes nodes, leaves and shapes in depth-first order.
    pub(super) fn lay_out<P: Primitives + ?Sized>(
        &self,
        primitives: &P,
        dropped: usize,
        leaves: Leaves,
        sah: SahOptions,
    ) -> Result<Bvh<P::Shape>, BuildError> {
        let bounds = self.aabb(0);
        let mut layout = Layout { draft: self, rule: leaves, sah, made: Made::default(), prims: Vec::new() };
        reserve(&mut layout.prims, self.nodes[0].count() as usize)?;
        layout.place();
        let Layout { mut made, prims, .. } = layout;
        made.link();
        let held = |prim: u32| LeafTriangle { shape: primitives.shape(prim as usize), prim };
        let mut triangles = room(prims.len())?;
        threads::map_into(&mut triangles, 0..prims.len(), CHUNK, |i| held(prims[i]));
        let (recorded, region) = (Recorded::ParentSibling, Region::within(primitives.frame(), &bounds));
        let duplicates = prims.len() + dropped - primitives.count();
        let Made { nodes, axes, leaves, depth } = made;
        let root = if nodes.is_empty() { Node::leaf(0) } else { Node::inner(0) };
        let tree = BvhTree { root, depth, recorded, nodes, axes, leaves };
        Ok(Bvh { dropped, duplicates, bounds, region, tree, triangles, least: Least::default() })
    }
}

struct Layout<'a> {
    draft: &'a Draft,
    rule: Leaves,
    sah: SahOptions,
    made: Made,
    /// The primitives of all leaves.
    prims: Vec<u32>,
}

/// All output except the shapes.
#[derive(Default)]
struct Made {
    nodes: Vec<BvhNode>,
    axes: Vec<u8>,
    leaves: Vec<Leaf>,
    depth: u32,
}

impl Layout<'_> {
    /// Places all nodes, without links except those to children.
    fn place(&mut self) {
        let links = [Node::inner(0); 2];
        // Nodes that are not yet placed, and the fields for their addresses.
        let mut pending = vec![(0, 0, None)];
        while let Some((place, depth, parent)) = pending.pop() {
            let is_leaf = self.is_leaf(self.draft.node(place), depth);
            let (nodes, leaves) = (self.made.nodes.len() as u32, self.made.leaves.len() as u32);
            let address = if is_leaf { Node::leaf(leaves) } else { Node::inner(nodes) };
            if let Some((parent, side)) = parent {
                let parent: &mut BvhNode = &mut self.made.nodes[parent];
                parent.children[side] = address;
            }
            if is_leaf {
                let first = self.prims.len();
                self.draft.prims(place, &mut self.prims);
                let count = self.prims.len() - first;
                self.made.leaves.push(Leaf { first: first as u32, count: count as u32, links });
                self.made.depth = self.made.depth.max(depth);
                continue;
            }
            let first = self.draft.node(place).first();
            let children = self.draft.children(self.draft.node(place));
            let (axis, in_order) = order_of(children.map(Record::aabb));
            // The larger child is on the left: it is visited more often, and follows its parent in memory.
            let left = usize::from(children[0].half_area() < children[1].half_area());
            let boxes = [first, first + 1].map(|place| self.draft.aabb(place));
            let is_reversed = in_order == (left == 1);
            self.made.axes.push(axis as u8 | if is_reversed { SignOrder::REVERSED } else { 0 });
            let mut node = BvhNode { planes: [[0.0; 4]; 3], children: links, links };
            node.set_child_boxes(&boxes[left], &boxes[1 - left]);
            self.made.nodes.push(node);
            // The left child is placed next.
            for side in [1, 0] {
                let place = first + (if side == 0 { left } else { 1 - left }) as u32;
                pending.push((place, depth + 1, Some((address.index(), side))));
            }
        }
    }

    fn is_leaf(&self, node: &Record, depth: u32) -> bool {
        let fits = node.count() <= self.sah.max_leaf;
        node.is_leaf()
            || match self.rule {
                Leaves::Cheapest => fits && (depth >= self.sah.depth_limit || self.cost(node).1),
                Leaves::Full => fits,
                Leaves::At(deepest) => depth >= deepest,
            }
    }

    /// Returns the cost of a node whose primitives fit in a leaf, in tests times half area, and whether a leaf is the
    /// cheapest.
    fn cost(&self, node: &Record) -> (f32, bool) {
        let as_leaf = node.half_area() * node.count() as f32;
        if node.is_leaf() {
            return (as_leaf, true);
        }
        let [left, right] = self.draft.children(node).map(|child| self.cost(child).0);
        let as_node = node.half_area() * NODE_COST + left + right;
        if as_leaf <= as_node { (as_leaf, true) } else { (as_node, false) }
    }
}

/// Returns the axis on which the centers of two boxes differ most, and whether the first center is less there.
fn order_of([first, second]: [Aabb; 2]) -> (usize, bool) {
    let apart = second.centroid() - first.centroid();
    let axis = apart.abs().max_position();
    (axis, apart[axis] >= 0.0)
}

impl Made {
    /// Writes parent and sibling into all records; the default traversal climbs by them. The root refers to itself.
    fn link(&mut self) {
        if self.nodes.is_empty() {
            self.leaves[0].links = [Node::leaf(0); 2];
        }
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
