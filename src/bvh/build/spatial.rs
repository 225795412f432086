//! Spatial splits: a node is split between primitives, or by a plane that also cuts primitives.
//!
//! Stich, Friedrich & Dietrich 2009, "Spatial splits in bounding volume hierarchies": if the children of the best split
//! between primitives overlap, the builder tries planes. A plane refers the primitives that it cuts to both sides, each
//! with the box of the part on that side. Such a primitive goes to one side alone if that is cheaper (reference
//! unsplitting).
//!
//! A range of items has free places for additional references. A split divides the remaining free places between the
//! two sides by their counts. So a subtree depends on its own range alone, and the tree is the same for any number of
//! threads.

mod bins;
mod extents;
mod split;

use super::record::Record;
use super::top_down::halve;
use super::{BuildError, BuildOptions, Primitives, SahOptions, filled, reserve};
use crate::threads;
use crate::tree::Node;
use bins::Bins;
use extents::Extents;
use split::Split;

/// Options for the builder with spatial splits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialOptions {
    /// Greatest number of references beyond the first of each primitive, in percent of the number of primitives: 0 to
    /// [`MAX_EXTRA_PERCENT`](Self::MAX_EXTRA_PERCENT). The builder allocates memory for all of them.
    pub extra_percent: u32,
    /// Planes that cut primitives are tried if the children of the best other split overlap by more than this fraction
    /// of the root's surface.
    pub overlap: f32,
}

impl SpatialOptions {
    /// Greatest number of additional references: ten for each primitive.
    pub const MAX_EXTRA_PERCENT: u32 = 1000;
}

impl Default for SpatialOptions {
    /// Up to 30 % more references, and an overlap of 10^-3. With the 10^-5 of the paper, trees have twice the number of
    /// additional references, and are hardly faster.
    fn default() -> Self {
        Self { extra_percent: 30, overlap: 1e-3 }
    }
}

/// Builds a node for each part, and the nodes over them: children are adjacent, with free places in between.
pub(super) fn build<P: Primitives + ?Sized>(
    primitives: &P,
    mut items: Vec<Record>,
    options: &BuildOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Record>, BuildError> {
    let count = items.len();
    let extra = (count as u64 * u64::from(options.spatial.extra_percent) / 100) as usize;
    let places = count.saturating_add(extra).min(Node::MAX_INDEX as usize);
    let least_overlap = options.spatial.overlap * Extents::of(&items).boxes.half_area();
    reserve(&mut items, places - count)?;
    items.resize(places, Record::NONE);
    let mut nodes = filled(Record::NONE, 2 * places - 1)?;
    let builder = Builder { primitives, sah: options.sah, least_overlap, progress };
    if let Some((node, below)) = nodes.split_first_mut() {
        builder.run(Range { items: &mut items, count, own: count, node, below, next: 1, depth: 0 });
    }
    Ok(nodes)
}

struct Builder<'a, P: ?Sized> {
    primitives: &'a P,
    sah: SahOptions,
    /// Overlap from which on spatial splits are tried, as half area.
    least_overlap: f32,
    progress: &'a (dyn Fn(usize) + Sync),
}

/// The items of a subtree.
struct Range<'a> {
    /// The items, and free places after them.
    items: &'a mut [Record],
    count: usize,
    /// Items without the references to primitives that another range counts.
    own: usize,
    node: &'a mut Record,
    /// Two fewer than twice the places.
    below: &'a mut [Record],
    /// The place of the first of those nodes.
    next: usize,
    depth: u32,
}

/// Ranges of at least this many items are built in parallel.
const PARALLEL: usize = 2048;

impl<P: Primitives + ?Sized> Builder<'_, P> {
    /// Builds the subtree.
    fn run(&self, range: Range<'_>) {
        let mut bins = Bins::new();
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

    /// Splits the range, unless it is one item.
    fn cut<'r>(&self, range: Range<'r>, bins: &mut Bins) -> Option<[Range<'r>; 2]> {
        let Range { items, count, own, node, below, next, depth } = range;
        if count == 1 {
            *node = items[0];
            (self.progress)(own);
            return None;
        }
        let extents = Extents::of(&items[..count]);
        *node = Record::over(&extents.boxes.planes(), next as u32, count as u32);
        let [left, right] = self.part(items, count, &extents, depth, bins);
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
                node: left_node,
                below: left_below,
                next: next + 2,
                depth: depth + 1,
            },
            Range {
                items: right_items,
                count: right,
                own: own - own_left,
                node: right_node,
                below: right_below,
                next: next + 2 * places,
                depth: depth + 1,
            },
        ])
    }

    /// Moves the items of the left side to the front, those of the right side after them, and returns their numbers.
    fn part(&self, items: &mut [Record], count: usize, extents: &Extents, depth: u32, bins: &mut Bins) -> [usize; 2] {
        let levels = self.sah.levels_below(depth);
        // Below the greatest depth are leaves.
        let most = if levels == 0 { 0 } else { self.sah.capacity(levels - 1) };
        let fits = |counts: &[usize; 2]| counts.iter().all(|&count| count <= most);
        let (range, spare) = (&items[..count], items.len() - count);
        let object = bins.between(range, extents).filter(|_| levels > 0);
        let overlaps = object.as_ref().is_none_or(|split| split.overlap() > self.least_overlap);
        let may_cut = spare > 0 && overlaps && levels > 0;
        let spatial = if may_cut { bins.across(self.primitives, range, spare, &extents.boxes) } else { None };
        let cost = |split: &Option<Split>| split.as_ref().map_or(f32::INFINITY, |split| split.cost);
        // Parts cost more than they save if a leaf would be equally cheap.
        let is_worth = |split: &Split| count > self.sah.max_leaf as usize || split.cost < count as f32;
        if let Some(split) = spatial.filter(|split| split.cost < cost(&object) && is_worth(split))
            && let Some([left, right]) = split.cut(self.primitives, range, spare)
            && fits(&[left.len(), right.len()])
        {
            items[..left.len()].copy_from_slice(&left);
            items[left.len()..left.len() + right.len()].copy_from_slice(&right);
            return [left.len(), right.len()];
        }
        let range = &mut items[..count];
        object.map(|split| split.part(range)).filter(fits).unwrap_or_else(|| {
            let left = halve(range, &extents.centroids.planes());
            [left, count - left]
        })
    }
}

#[cfg(test)]
mod tests;
