//! Trees in clusters.

use std::ops::Range;

use super::super::draft::{DraftNode, order_of};
use super::super::item::{CHUNK, Item, Spread};
use super::super::sah::capacity;
use super::super::top_down::append;
use super::{CLUSTER, border, index};
use crate::geom::Aabb;

/// The trees of some clusters.
pub(super) struct Forest {
    /// All below the roots, after one free place.
    pub(super) nodes: Vec<DraftNode>,
    pub(super) roots: Vec<DraftNode>,
    pub(super) references: Vec<u32>,
}

impl Forest {
    /// With those of clusters that come later.
    pub(super) fn and(mut self, other: Self) -> Self {
        let by = self.nodes.len() - 1;
        append(&mut self.nodes, &other.nodes);
        self.roots.extend(other.roots.iter().map(|root| root.moved(by)));
        self.references.extend(other.references);
        self
    }
}

/// How trees are grown.
pub(super) struct Growth<'a> {
    pub(super) items: &'a [Item],
    /// Sorted.
    pub(super) codes: &'a [u64],
    pub(super) max_leaf: u32,
    /// Levels below the root of a cluster, at most.
    pub(super) levels: u32,
    pub(super) progress: &'a (dyn Fn(usize) + Sync),
}

/// Items that are cut by surface area; more are cut where their codes first differ.
const SWEEP: usize = 16;

impl Growth<'_> {
    /// The trees of clusters that follow each other.
    pub(super) fn forest(&self, clusters: &[Range<usize>]) -> Forest {
        let count = clusters.iter().map(ExactSizeIterator::len).sum();
        let mut forest = Forest {
            nodes: Vec::with_capacity(count),
            roots: Vec::with_capacity(clusters.len()),
            references: Vec::with_capacity(count),
        };
        forest.nodes.push(DraftNode::NONE);
        let mut own = [Item::new(&Aabb::EMPTY, 0); CLUSTER];
        let mut told = 0;
        for range in clusters {
            let codes = &self.codes[range.clone()];
            for (own, &code) in own.iter_mut().zip(codes) {
                *own = self.items[index(code)];
                forest.references.push(own.prim());
            }
            let part = Part { items: &own[..codes.len()], first: range.start, levels: self.levels };
            let root = self.by_codes(part, codes, &mut forest.nodes);
            forest.roots.push(root);
            let placed = forest.references.len();
            if placed - told >= CHUNK || placed == count {
                (self.progress)(placed - told);
                told = placed;
            }
        }
        forest
    }

    /// Adds the nodes below the root of a part, which is returned.
    fn by_codes(&self, part: Part<'_>, codes: &[u64], nodes: &mut Vec<DraftNode>) -> DraftNode {
        let n = part.items.len();
        if n <= SWEEP.max(self.max_leaf as usize) {
            let all = part.items.iter().fold(Spread::EMPTY, |all, item| all.union(item.spread()));
            return self.by_area(part, all, nodes);
        }
        let most = capacity(self.max_leaf, part.levels - 1);
        let left = border(codes).filter(|&left| left.max(n - left) <= most).unwrap_or(n / 2);
        let place = room(nodes);
        let (left_part, right_part) = part.cut(left);
        let (left_codes, right_codes) = codes.split_at(left);
        let children = [self.by_codes(left_part, left_codes, nodes), self.by_codes(right_part, right_codes, nodes)];
        join(children, place, nodes)
    }

    /// The same for few items, whose box is known.
    fn by_area(&self, part: Part<'_>, all: Spread, nodes: &mut Vec<DraftNode>) -> DraftNode {
        let Part { items, first, levels } = part;
        if items.len() <= self.max_leaf as usize {
            return DraftNode::leaf(all.aabb(), first, items.len());
        }
        let (left, [left_box, right_box]) = cheapest(items, capacity(self.max_leaf, levels - 1));
        let place = room(nodes);
        let (left_part, right_part) = part.cut(left);
        let children = [self.by_area(left_part, left_box, nodes), self.by_area(right_part, right_box, nodes)];
        join(children, place, nodes)
    }
}

/// Items to build a subtree over.
#[derive(Clone, Copy)]
struct Part<'a> {
    items: &'a [Item],
    /// Where they start among all.
    first: usize,
    /// Levels below the root, at most. The items fit.
    levels: u32,
}

impl Part<'_> {
    fn cut(&self, left: usize) -> (Self, Self) {
        let (items, right_items) = self.items.split_at(left);
        let levels = self.levels - 1;
        (Self { items, levels, ..*self }, Self { items: right_items, first: self.first + left, levels })
    }
}

/// Places for two children.
fn room(nodes: &mut Vec<DraftNode>) -> usize {
    nodes.extend([DraftNode::NONE; 2]);
    nodes.len() - 2
}

/// Puts children in their places. The left one is the one whose middle comes first, on the axis where that differs
/// most.
fn join([a, b]: [DraftNode; 2], place: usize, nodes: &mut [DraftNode]) -> DraftNode {
    let (axis, in_order) = order_of(&a.aabb, &b.aabb);
    let children = if in_order { [a, b] } else { [b, a] };
    nodes[place..place + 2].copy_from_slice(&children);
    DraftNode::inner(a.aabb.union(b.aabb), place, axis)
}

/// Where to cut at most [`SWEEP`] items that stay in order, with at most so many on a side, and the boxes of both
/// sides.
fn cheapest(items: &[Item], most: usize) -> (usize, [Spread; 2]) {
    let n = items.len();
    let mut rights = [Spread::EMPTY; SWEEP];
    let mut weights = [0.0; SWEEP];
    let mut right = Spread::EMPTY;
    for i in (1..n).rev() {
        right = right.union(items[i].spread());
        rights[i] = right;
        weights[i] = right.half_area() * (n - i) as f32;
    }
    let (mut best, mut least) = (n / 2, f32::INFINITY);
    let mut left = Spread::EMPTY;
    for i in 1..n {
        left = left.union(items[i - 1].spread());
        let weight = left.half_area() * i as f32 + weights[i];
        if weight < least && i.max(n - i) <= most {
            (best, least) = (i, weight);
        }
    }
    let left = items[..best].iter().fold(Spread::EMPTY, |all, item| all.union(item.spread()));
    (best, [left, rights[best]])
}
