//! Top-down construction by surface area, or by medians; few items are merged bottom-up.

use fearless_simd::{Level, Simd};

use super::bins::{Bins, Border, Scale, extents};
use super::merge::{self, merge};
use super::record::{CHUNK, Planes, Record};
use super::{BuildError, SahOptions, filled};
use crate::geom::lanes::vectorize;
use crate::threads;

/// A builder that splits a range of items recursively.
pub(super) struct TopDown<'p> {
    pub(super) options: SahOptions,
    /// Levels that are split by surface area. Below them ranges are split at the middle of their count.
    pub(super) by_area: u32,
    pub(super) level: Level,
    pub(super) progress: &'p (dyn Fn(usize) + Sync),
}

/// The items of a subtree, and memory for its nodes.
struct Task<'a> {
    items: &'a mut [Record],
    /// Two fewer than twice the items.
    nodes: &'a mut [Record],
    /// The place of the first of these nodes.
    from: u32,
    depth: u32,
    centroids: Planes,
}

/// A split of a range that has been reordered.
struct Cut {
    left: usize,
    boxes: [Planes; 2],
    centroids: [Planes; 2],
}

impl Cut {
    #[inline(always)]
    fn in_half<S: Simd>(simd: S, items: &mut [Record], centroids: &Planes) -> Self {
        let left = halve(items, centroids);
        let (of_left, of_right) = items.split_at(left);
        let ([left_box, of_left], [right_box, of_right]) = (extents(simd, of_left), extents(simd, of_right));
        Self { left, boxes: [left_box, right_box], centroids: [of_left, of_right] }
    }
}

/// Subtrees of this many items are separate tasks.
const TASK: usize = 1 << 12;

impl TopDown<'_> {
    /// Builds a node for each item, and the nodes over them: children are adjacent, followed by the nodes below the
    /// left one, then those below the right one.
    pub(super) fn build(&self, mut items: Vec<Record>) -> Result<Vec<Record>, BuildError> {
        let n = items.len();
        let mut nodes = filled(Record::NONE, 2 * n - 1)?;
        let (root, rest) = nodes.split_at_mut(1);
        if n == 1 {
            root[0] = items[0];
            (self.progress)(1);
            return Ok(nodes);
        }
        let [boxes, centroids] = self.extents(&items);
        root[0] = Record::over(&boxes, 1, n as u32);
        self.run(Task { items: &mut items, nodes: rest, from: 1, depth: 0, centroids });
        Ok(nodes)
    }

    fn run(&self, task: Task<'_>) {
        vectorize!(self.level, simd => self.run_by(simd, task));
    }

    /// Recursive only if both sides have many items, because trees may be deep.
    #[inline(always)]
    fn run_by<S: Simd>(&self, simd: S, task: Task<'_>) {
        let mut done = 0;
        let mut pending = vec![task];
        while let Some(Task { items, nodes, from, depth, centroids }) = pending.pop() {
            let n = items.len();
            if n <= merge::MAX && self.may_merge(n, depth) {
                merge(simd, items, nodes, from);
                done += n;
                if done >= TASK {
                    (self.progress)(std::mem::take(&mut done));
                }
                continue;
            }
            let cut = self.cut(simd, items, &centroids, depth);
            let (left_items, right_items) = items.split_at_mut(cut.left);
            let (children, rest) = nodes.split_at_mut(2);
            let (left_nodes, right_nodes) = rest.split_at_mut(2 * left_items.len() - 2);
            let starts = [from + 2, from + 2 + left_nodes.len() as u32];
            let node = |items: &[Record], side: usize| match items {
                [item] => *item,
                _ => Record::over(&cut.boxes[side], starts[side], items.len() as u32),
            };
            (children[0], children[1]) = (node(left_items, 0), node(right_items, 1));
            let ([left_centroids, right_centroids], depth) = (cut.centroids, depth + 1);
            let left = Task { items: left_items, nodes: left_nodes, from: starts[0], depth, centroids: left_centroids };
            let right =
                Task { items: right_items, nodes: right_nodes, from: starts[1], depth, centroids: right_centroids };
            if left.items.len().min(right.items.len()) >= TASK && threads::count() > 1 {
                threads::join(|| self.run(left), || self.run(right));
                continue;
            }
            for task in [right, left] {
                if task.items.len() > 1 { pending.push(task) } else { done += 1 }
            }
        }
        (self.progress)(done);
    }

    /// Returns whether any tree over this many items is flat enough.
    fn may_merge(&self, n: usize, depth: u32) -> bool {
        let is_leaf = n <= self.options.max_leaf as usize;
        n == 2 || depth < self.by_area && (is_leaf || n <= self.options.levels_below(depth) as usize + 1)
    }

    #[inline(always)]
    fn cut<S: Simd>(&self, simd: S, items: &mut [Record], centroids: &Planes, depth: u32) -> Cut {
        let levels = self.options.levels_below(depth);
        // Below the greatest depth are leaves.
        if depth >= self.by_area || levels == 0 {
            return Cut::in_half(simd, items, centroids);
        }
        let most = self.options.capacity(levels - 1);
        match items.len() {
            ..64 => self.cut_by::<S, 8>(simd, items, centroids, most),
            64..1024 => self.cut_by::<S, 16>(simd, items, centroids, most),
            _ => self.cut_by::<S, 32>(simd, items, centroids, most),
        }
    }

    /// Splits at the cheapest border of `N` bins on each axis. Splits at the middle if there is none, or if a side
    /// would have too many items for the depth.
    #[inline(always)]
    fn cut_by<S: Simd, const N: usize>(&self, simd: S, items: &mut [Record], centroids: &Planes, most: usize) -> Cut {
        let (n, scale) = (items.len(), Scale::new(centroids, N));
        let border = if n >= 4 * CHUNK && threads::count() > 1 {
            let of = |items: &[Record]| self.bins::<N>(items, &scale);
            threads::reduce(items, CHUNK, of, Bins::and).and_then(|bins| bins.cheapest(simd, n))
        } else {
            Bins::<N>::of(simd, items, &scale).cheapest(simd, n)
        };
        let Some(border) = border.filter(|border| border.left.max(n - border.left) <= most) else {
            return Cut::in_half(simd, items, centroids);
        };
        let (left, centroids) = border.part(simd, items, &scale);
        let Border { boxes, .. } = border;
        Cut { left, boxes, centroids }
    }

    /// On all threads, so each determines its instruction level.
    fn bins<const N: usize>(&self, items: &[Record], scale: &Scale) -> Bins<N> {
        vectorize!(self.level, simd => Bins::of(simd, items, scale))
    }

    fn extents(&self, items: &[Record]) -> [Planes; 2] {
        vectorize!(self.level, simd => extents(simd, items))
    }
}

/// Moves the items with the smaller centroids to the front, along the axis on which centroids spread most. Returns
/// their number: half of all items.
///
/// The order is total (centroid, then index), so equal centroids need no special case.
pub(super) fn halve(items: &mut [Record], centroids: &Planes) -> usize {
    let extent = [0, 1, 2].map(|axis| -(centroids[axis] + centroids[axis + 4]));
    let later_wins = |best: usize, axis: usize| if extent[axis] > extent[best] { axis } else { best };
    let axis = later_wins(later_wins(0, 1), 2);
    let left = items.len() / 2;
    items.select_nth_unstable_by(left, |a, b| {
        let by_centroid = a.centroid()[axis].total_cmp(&b.centroid()[axis]);
        by_centroid.then(a.first().cmp(&b.first()))
    });
    left
}
