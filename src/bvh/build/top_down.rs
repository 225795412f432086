//! Construction from the top down: a builder is a function that cuts a range of items in two, or makes it a leaf.

use super::draft::{Draft, DraftNode};
use super::item::{Item, Spread};

/// A cut of a range that has been reordered: the `left` first items have the smaller centroids on `axis`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) axis: usize,
    pub(super) left: usize,
}

/// Builds with `cut`, which gets a range and its depth, and reorders it, or returns `None` for a leaf.
pub(super) fn build(
    mut items: Vec<Item>,
    mut cut: impl FnMut(&mut [Item], u32) -> Option<Cut>,
    progress: &(dyn Fn(usize) + Sync),
) -> Draft {
    let mut nodes = vec![DraftNode::NONE];
    let mut pending = vec![(0, 0, items.len(), 0)];
    while let Some((index, first, end, depth)) = pending.pop() {
        let range = &mut items[first..end];
        let aabb = Spread::of(range).aabb();
        nodes[index] = if let Some(Cut { axis, left }) = cut(range, depth) {
            let child = nodes.len();
            nodes.extend([DraftNode::NONE; 2]);
            pending.push((child + 1, first + left, end, depth + 1));
            pending.push((child, first, first + left, depth + 1));
            DraftNode::inner(aabb, child, axis)
        } else {
            progress(range.len());
            DraftNode::leaf(aabb, first, range.len())
        };
    }
    Draft { nodes, references: items.iter().map(Item::prim).collect() }
}

/// Cuts at the exact middle of the count, along the axis on which the centroids spread most.
///
/// The order is total (centroid, then index), so equal centroids are no trouble. The range needs two items.
pub(super) fn halve(items: &mut [Item]) -> Cut {
    let axis = Spread::of_centroids(items).widest_axis();
    let left = items.len() / 2;
    items.select_nth_unstable_by(left, |a, b| {
        let by_centroid = a.centroid()[axis].total_cmp(&b.centroid()[axis]);
        by_centroid.then(a.prim().cmp(&b.prim()))
    });
    Cut { axis, left }
}
