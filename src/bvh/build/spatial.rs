//! Spatial splits: a node is cut between primitives, or by a plane that cuts primitives too.
//!
//! Stich, Friedrich & Dietrich 2009, "Spatial splits in bounding volume hierarchies": where the children of the best
//! cut between primitives overlap, planes are tried that refer the primitives which they cut to both sides, each with
//! the box of the part on that side. Such a primitive goes to one side alone where that is cheaper (reference
//! unsplitting).
//!
//! A range of items comes with free places for further references. What a cut leaves of them is divided among the two
//! sides by their counts. So a subtree depends on its own range alone, and the tree is the same for any number of
//! threads.

mod bins;
mod split;

use super::draft::{Draft, DraftNode};
use super::item::{Extents, Item};
use super::sah::capacity;
use super::top_down::halve;
use super::{BuildError, BuildOptions, Primitives, SahOptions};
use crate::geom::Aabb;
use crate::threads;
use crate::tree::Node;
use bins::Bins;
use split::Split;

/// How the builder with spatial splits cuts primitives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialOptions {
    /// References beyond the first of each primitive, at most, in hundredths of the number of primitives: 0 to
    /// [`MAX_EXTRA_PERCENT`](Self::MAX_EXTRA_PERCENT). Memory for all of them is taken while the tree is built.
    pub extra_percent: u32,
    /// Planes that cut primitives are tried where the children of the best other cut overlap by more than this share of
    /// the root's surface.
    pub overlap: f32,
}

impl SpatialOptions {
    /// Greatest number of further references: ten for each primitive.
    pub const MAX_EXTRA_PERCENT: u32 = 1000;
}

impl Default for SpatialOptions {
    /// Up to 30 in 100 primitives more, and an overlap of 10^-3. With the 10^-5 of the paper, trees have twice as many
    /// further references, and are hardly faster.
    fn default() -> Self {
        Self { extra_percent: 30, overlap: 1e-3 }
    }
}

pub(super) fn build<P: Primitives + ?Sized>(
    primitives: &P,
    mut items: Vec<Item>,
    options: &BuildOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    let SahOptions { bins, max_leaf, depth_limit } = options.sah;
    let count = items.len();
    options.sah.check(count)?;
    let extra = (count as u64 * u64::from(options.spatial.extra_percent) / 100) as usize;
    let places = count.saturating_add(extra).min(Node::MAX_INDEX as usize);
    items.resize(places, Item::new(&Aabb::EMPTY, 0));
    let mut nodes = vec![DraftNode::NONE; 2 * places - 1];
    let least_overlap = options.spatial.overlap * Extents::of(&items[..count]).boxes.half_area();
    let builder = Builder { primitives, bins: bins as usize, max_leaf, depth_limit, least_overlap, progress };
    if let Some((node, below)) = nodes.split_first_mut() {
        builder.run(Range { items: &mut items, count, own: count, first: 0, node, below, next: 1, depth: 0 });
    }
    Ok(without_free_places(nodes, &items))
}

fn without_free_places(mut nodes: Vec<DraftNode>, items: &[Item]) -> Draft {
    let mut references = Vec::new();
    for node in nodes.iter_mut().filter(|node| node.is_leaf()) {
        let (first, range) = (references.len(), node.references());
        *node = DraftNode::leaf(node.aabb, first, range.len());
        references.extend(items[range].iter().map(Item::prim));
    }
    Draft { nodes, references }
}

struct Builder<'a, P: ?Sized> {
    primitives: &'a P,
    bins: usize,
    max_leaf: u32,
    depth_limit: u32,
    /// Half area from which on spatial splits are tried.
    least_overlap: f32,
    progress: &'a (dyn Fn(usize) + Sync),
}

/// Items that a subtree is to be built over.
struct Range<'a> {
    /// The items, and free places behind them.
    items: &'a mut [Item],
    count: usize,
    /// Items less the references that were made for primitives which another range counts.
    own: usize,
    /// Where the items are in the whole list.
    first: usize,
    node: &'a mut DraftNode,
    /// Two fewer than twice the places, so that every leaf may have one reference.
    below: &'a mut [DraftNode],
    /// Where those nodes are in the draft.
    next: usize,
    depth: u32,
}

/// Ranges of at least so many items are built side by side.
const PARALLEL: usize = 2048;

impl<P: Primitives + ?Sized> Builder<'_, P> {
    /// Builds the subtree.
    fn run(&self, range: Range<'_>) {
        let mut bins = Bins::new(self.bins);
        let mut pending = vec![range];
        while let Some(range) = pending.pop() {
            let Some([left, right]) = self.cut(range, &mut bins) else { continue };
            if left.count.min(right.count) >= PARALLEL {
                threads::join(|| self.run(left), || self.run(right));
            } else {
                pending.extend([right, left]);
            }
        }
    }

    /// Cuts the range in two, or makes it a leaf.
    fn cut<'r>(&self, range: Range<'r>, bins: &mut Bins) -> Option<[Range<'r>; 2]> {
        let Range { items, count, own, first, node, below, next, depth } = range;
        let extents = Extents::of(&items[..count]);
        let Some((axis, [left, right])) = self.part(items, count, &extents, depth, bins) else {
            *node = DraftNode::leaf(extents.boxes.aabb(), first, count);
            (self.progress)(own);
            return None;
        };
        *node = DraftNode::inner(extents.boxes.aabb(), next, axis);
        // The free places, by the counts.
        let spare = items.len() - left - right;
        let places = left + (spare as u64 * left as u64 / (left + right) as u64) as usize;
        items.copy_within(left..left + right, places);
        let (left_items, right_items) = items.split_at_mut(places);
        let ([left_node, right_node], below) = below.split_first_chunk_mut::<2>()?;
        let (left_below, right_below) = below.split_at_mut(2 * places - 2);
        let own_left = own.min(left);
        Some([
            Range {
                items: left_items,
                count: left,
                own: own_left,
                first,
                node: left_node,
                below: left_below,
                next: next + 2,
                depth: depth + 1,
            },
            Range {
                items: right_items,
                count: right,
                own: own - own_left,
                first: first + places,
                node: right_node,
                below: right_below,
                next: next + 2 * places,
                depth: depth + 1,
            },
        ])
    }

    /// Moves the items of the left side to the front, those of the right side behind them, and says on which axis they
    /// were cut and how many they are. `None` for a leaf.
    fn part(
        &self,
        items: &mut [Item],
        count: usize,
        extents: &Extents,
        depth: u32,
        bins: &mut Bins,
    ) -> Option<(usize, [usize; 2])> {
        let levels = self.depth_limit - depth;
        if count == 1 || levels == 0 {
            return None;
        }
        let fits = |counts: &[usize; 2]| counts.iter().all(|&count| count <= capacity(self.max_leaf, levels - 1));
        let (range, spare) = (&items[..count], items.len() - count);
        let object = bins.between(range, extents);
        let overlaps = object.as_ref().is_none_or(|split| split.overlap() > self.least_overlap);
        let spatial =
            if spare > 0 && overlaps { bins.across(self.primitives, range, spare, &extents.boxes) } else { None };
        let cost = |split: &Option<Split>| split.as_ref().map_or(f32::INFINITY, |split| split.cost);
        let least = cost(&object).min(cost(&spatial));
        if count <= self.max_leaf as usize && (least >= count as f32 || least.is_infinite()) {
            return None;
        }
        if let Some(split) = spatial.filter(|split| split.cost < cost(&object))
            && let Some([left, right]) = split.cut(self.primitives, range, spare)
            && fits(&[left.len(), right.len()])
        {
            items[..left.len()].copy_from_slice(&left);
            items[left.len()..left.len() + right.len()].copy_from_slice(&right);
            return Some((split.axis, [left.len(), right.len()]));
        }
        let range = &mut items[..count];
        let cut = object.map(|split| (split.axis, split.part(range))).filter(|(_, counts)| fits(counts));
        Some(cut.unwrap_or_else(|| {
            let cut = halve(range, extents);
            (cut.axis, [cut.left, count - cut.left])
        }))
    }
}

#[cfg(test)]
mod tests;
