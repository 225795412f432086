//! Construction from the top down: a builder is a function that cuts a range of items in two, or makes it a leaf.

use super::draft::{Draft, DraftNode};
use super::item::{Extents, Item};
use crate::threads;

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
    let mut nodes = Vec::with_capacity(items.len());
    nodes.push(DraftNode::NONE);
    let extents = Extents::of(&items);
    let builder = TopDown { cut, progress, is_parallel: threads::count() > 1 };
    builder.run(Subtree { items: &mut items, first: 0, extents, depth: 0, own: 0 }, &mut nodes);
    Draft { nodes, references: items.iter().map(Item::prim).collect() }
}

/// A subtree that is still to be built.
struct Subtree<'a> {
    items: &'a mut [Item],
    /// Where the items start among all.
    first: usize,
    extents: Extents,
    depth: u32,
    /// Where its root stands.
    own: usize,
}

/// Subtrees of so many items are tasks of their own.
const TASK: usize = 1 << 12;

struct TopDown<'b, C> {
    cut: C,
    progress: &'b (dyn Fn(usize) + Sync),
    is_parallel: bool,
}

impl<C: Fn(&mut [Item], &Extents, u32) -> Option<Cut> + Sync> TopDown<'_, C> {
    /// Adds the nodes of a subtree. Recursive only where both sides have many items, as trees may be deep.
    fn run(&self, root: Subtree<'_>, nodes: &mut Vec<DraftNode>) {
        let mut done = 0;
        let mut pending = vec![root];
        while let Some(Subtree { items, first, extents, depth, own }) = pending.pop() {
            let aabb = extents.boxes.aabb();
            let Some(Cut { axis, left, extents }) = (self.cut)(items, &extents, depth) else {
                nodes[own] = DraftNode::leaf(aabb, first, items.len());
                done += items.len();
                if done >= TASK {
                    (self.progress)(std::mem::take(&mut done));
                }
                continue;
            };
            let place = nodes.len();
            nodes[own] = DraftNode::inner(aabb, place, axis);
            nodes.extend([DraftNode::NONE; 2]);
            let (left_items, right_items) = items.split_at_mut(left);
            let [left_extents, right_extents] = extents;
            let (first_right, depth) = (first + left, depth + 1);
            let left = Subtree { items: left_items, first, extents: left_extents, depth, own: place };
            let right =
                Subtree { items: right_items, first: first_right, extents: right_extents, depth, own: place + 1 };
            if self.is_parallel && left.items.len().min(right.items.len()) >= TASK {
                let mut others = vec![DraftNode::NONE];
                threads::join(|| self.run(left, nodes), || self.run(Subtree { own: 0, ..right }, &mut others));
                nodes[place + 1] = append(nodes, &others);
            } else {
                pending.extend([right, left]);
            }
        }
        (self.progress)(done);
    }
}

/// Adds the nodes of another draft but its root, which is returned.
pub(super) fn append(nodes: &mut Vec<DraftNode>, others: &[DraftNode]) -> DraftNode {
    let by = nodes.len() - 1;
    let mut others = others.iter().map(|node| node.moved(by));
    let root = others.next().unwrap_or(DraftNode::NONE);
    nodes.extend(others);
    root
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
