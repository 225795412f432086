//! Construction from the top down: a builder is a function that cuts a range of items in two, or makes it a leaf.
//!
//! A subtree over `n` items has at most `2 n - 2` nodes below its root. It owns that many places behind its parent's
//! children, whether it needs them or not. So no two tasks write to the same memory, and where a node stands does not
//! depend on who is first.

use std::ops::Range;

use rayon::Scope;

use super::draft::{Draft, DraftNode};
use super::item::{Extents, Item};

/// A cut of a range that has been reordered: the `left` first items have the smaller centroids on `axis`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) axis: usize,
    pub(super) left: usize,
    /// Of the left and of the right side.
    pub(super) extents: [Extents; 2],
}

/// Builds with `cut`, which gets a range, its extents and its depth, and reorders it, or returns `None` for a leaf.
///
/// There must be an item. `cut` must leave no side empty.
pub(super) fn build<C>(mut items: Vec<Item>, cut: C, progress: &(dyn Fn(usize) + Sync)) -> Draft
where
    C: Fn(&mut [Item], &Extents, u32) -> Option<Cut> + Sync,
{
    let mut nodes = vec![DraftNode::NONE; (2 * items.len()).saturating_sub(1)];
    let extents = Extents::of(&items);
    if let [own, below @ ..] = &mut *nodes {
        let root = Subtree { items: &mut items, first: 0, extents, depth: 0, own, below, place: 1 };
        let task = Task { cut, progress };
        rayon::scope(|scope| task.run(vec![root], scope));
    }
    Draft { nodes, references: items.iter().map(Item::prim).collect() }
}

/// Goes on below the leaves of `top`, each of which names one of the `parts` of the items.
pub(super) fn go_on<C>(
    top: Draft,
    mut items: Vec<Item>,
    parts: &[Range<usize>],
    cut: C,
    progress: &(dyn Fn(usize) + Sync),
) -> Draft
where
    C: Fn(&mut [Item], &Extents, u32) -> Option<Cut> + Sync,
{
    let Draft { mut nodes, references } = top;
    // Parents come before their children.
    let mut depths = vec![0; nodes.len()];
    for (place, node) in nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
        for child in node.children() {
            depths[child] = depths[place] + 1;
        }
    }
    let above = nodes.len();
    nodes.resize((2 * items.len()).saturating_sub(1), DraftNode::NONE);
    let (nodes_above, mut below) = nodes.split_at_mut(above);
    let mut place = above;
    let mut rest = &mut *items;
    let mut slices: Vec<_> = parts.iter().map(|part| rest.split_off_mut(..part.len())).collect();
    let mut subtrees = Vec::with_capacity(parts.len());
    for (own, &depth) in nodes_above.iter_mut().zip(&depths).filter(|(own, _)| own.is_leaf()) {
        let part = references[own.references().start] as usize;
        let Some(items) = slices[part].take() else { continue };
        let room = 2 * items.len() - 2;
        let Some(below) = below.split_off_mut(..room) else { continue };
        let extents = Extents::of(items);
        subtrees.push(Subtree { items, first: parts[part].start, extents, depth, own, below, place });
        place += room;
    }
    let task = Task { cut, progress };
    rayon::scope(|scope| {
        let task = &task;
        while !subtrees.is_empty() {
            let some = subtrees.split_off(subtrees.len().saturating_sub(TASK / 16));
            scope.spawn(move |scope| task.run(some, scope));
        }
    });
    Draft { nodes, references: items.iter().map(Item::prim).collect() }
}

/// A subtree that is still to be built.
struct Subtree<'a> {
    items: &'a mut [Item],
    /// Where the items start among all.
    first: usize,
    extents: Extents,
    depth: u32,
    /// The root of the subtree.
    own: &'a mut DraftNode,
    /// Room for all nodes below it.
    below: &'a mut [DraftNode],
    /// Where that room starts among all.
    place: usize,
}

/// Subtrees of so many items are tasks of their own.
const TASK: usize = 1 << 12;

struct Task<'b, C> {
    cut: C,
    progress: &'b (dyn Fn(usize) + Sync),
}

impl<C: Fn(&mut [Item], &Extents, u32) -> Option<Cut> + Sync> Task<'_, C> {
    /// Not by recursion: trees may be deep.
    fn run<'a>(&'a self, mut pending: Vec<Subtree<'a>>, scope: &Scope<'a>) {
        let mut done = 0;
        while let Some(Subtree { items, first, extents, depth, own, below, place }) = pending.pop() {
            let aabb = extents.boxes.aabb();
            let Some(Cut { axis, left, extents }) = (self.cut)(items, &extents, depth) else {
                *own = DraftNode::leaf(aabb, first, items.len());
                done += items.len();
                continue;
            };
            *own = DraftNode::inner(aabb, place, axis);
            let [left_own, right_own, below @ ..] = below else { continue };
            let (items, right_items) = items.split_at_mut(left);
            let (below, right_below) = below.split_at_mut(2 * left - 2);
            let [left_extents, right_extents] = extents;
            let (depth, place) = (depth + 1, place + 2);
            let right = Subtree {
                items: right_items,
                first: first + left,
                extents: right_extents,
                depth,
                own: right_own,
                below: right_below,
                place: place + 2 * left - 2,
            };
            let left = Subtree { items, first, extents: left_extents, depth, own: left_own, below, place };
            for child in [right, left] {
                if child.items.len() < TASK {
                    pending.push(child);
                } else {
                    scope.spawn(move |scope| self.run(vec![child], scope));
                }
            }
        }
        (self.progress)(done);
    }
}

/// Cuts at the exact middle of the count, along the axis on which the centroids spread most.
///
/// The order is total (centroid, then index), so equal centroids are no trouble. The range needs two items.
pub(super) fn halve(items: &mut [Item], extents: &Extents) -> Cut {
    let axis = extents.centroids.widest_axis();
    let left = items.len() / 2;
    items.select_nth_unstable_by(left, |a, b| {
        let by_centroid = a.centroid()[axis].total_cmp(&b.centroid()[axis]);
        by_centroid.then(a.prim().cmp(&b.prim()))
    });
    let (below, above) = items.split_at(left);
    Cut { axis, left, extents: [Extents::of(below), Extents::of(above)] }
}
