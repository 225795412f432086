//! The cheapest planes, found at the borders of bins.

use glam::Vec3A;

use super::super::Primitives;
use super::super::record::Record;
use super::super::sah::NODE_COST;
use super::extents::{Extents, Spread};
use super::split::{Scale, Side, Split};

/// Bins on each axis.
const BINS: usize = 32;

/// Memory for the bins of one axis, and the sums from the right.
pub(super) struct Bins {
    bins: Vec<Bin>,
    right: Vec<Side>,
}

/// Items that begin in a bin, items that end in it, and the box of their parts in it.
#[derive(Clone, Copy)]
struct Bin {
    spread: Spread,
    begin: usize,
    end: usize,
}

impl Bin {
    const EMPTY: Self = Self { spread: Spread::EMPTY, begin: 0, end: 0 };

    /// Adds a part, unless it is empty.
    fn add(&mut self, part: Spread) {
        if !part.is_empty() {
            self.spread = self.spread.union(part);
        }
    }
}

impl Bins {
    pub(super) fn new() -> Self {
        Self { bins: vec![Bin::EMPTY; BINS], right: vec![Side::EMPTY; BINS] }
    }

    /// Returns the cheapest split between items, by their centroids.
    pub(super) fn between(&mut self, items: &[Record], extents: &Extents) -> Option<Split> {
        self.cheapest(items.len(), 0, &extents.boxes, |bins, axis| {
            let scale = Scale::new(&extents.centroids, axis, bins.len())?;
            for item in items {
                let bin = &mut bins[scale.bin(item.centroid()[axis])];
                bin.spread = bin.spread.union(Spread::of(item));
                bin.begin += 1;
                bin.end += 1;
            }
            Some(scale)
        })
    }

    /// Returns the cheapest plane that divides at most `spare` items.
    pub(super) fn across<P: Primitives + ?Sized>(
        &mut self,
        primitives: &P,
        items: &[Record],
        spare: usize,
        spread: &Spread,
    ) -> Option<Split> {
        let mut slices = [Spread::EMPTY; BINS];
        self.cheapest(items.len(), spare, spread, |bins, axis| {
            let scale = Scale::new(spread, axis, bins.len())?;
            let ends = |whole: &Spread| [whole.lo, whole.hi].map(|plane| scale.bin(plane[axis]));
            for item in items {
                let [begin, end] = ends(&Spread::of(item));
                bins[begin].begin += 1;
                bins[end].end += 1;
            }
            // Parts are expensive: if every plane cuts too many items, none is made.
            if !has_candidate(bins, items.len(), spare) {
                return None;
            }
            for item in items {
                let whole = Spread::of(item);
                let [begin, end] = ends(&whole);
                if begin == end {
                    bins[begin].spread = bins[begin].spread.union(whole);
                    continue;
                }
                let crossed = &mut bins[begin..=end];
                let prim = item.first() as usize;
                if let Some(corners) = primitives.corners(prim) {
                    let slices = &mut slices[..crossed.len()];
                    slice(slices, corners.map(Vec3A::from), begin, &scale, axis);
                    for (bin, slice) in crossed.iter_mut().zip(slices) {
                        bin.add(slice.intersection(whole));
                    }
                    continue;
                }
                for (i, bin) in (begin..).zip(crossed) {
                    let mut part = whole.aabb();
                    if i > begin {
                        part.lo[axis] = scale.border(i);
                    }
                    if i < end {
                        part.hi[axis] = scale.border(i + 1);
                    }
                    let part = primitives.part(prim, &part);
                    bin.add(Spread { lo: part.lo.into(), hi: part.hi.into() });
                }
            }
            Some(scale)
        })
    }

    /// Returns the cheapest border of three axes that cuts at most `spare` items. `fill` fills the bins of an axis.
    fn cheapest(
        &mut self,
        count: usize,
        spare: usize,
        whole: &Spread,
        mut fill: impl FnMut(&mut [Bin], usize) -> Option<Scale>,
    ) -> Option<Split> {
        // More bins do not improve splits of few items.
        let used = self.bins.len().min(2 * count + 2);
        let (bins, sums) = (&mut self.bins[..used], &mut self.right[..used]);
        let area = whole.half_area();
        let mut best: Option<Split> = None;
        for axis in 0..3 {
            bins.fill(Bin::EMPTY);
            let Some(scale) = fill(bins, axis) else { continue };
            let mut right = Side::EMPTY;
            for (bin, sum) in bins.iter().zip(sums.iter_mut()).rev() {
                right = right.with(&bin.spread, bin.end);
                *sum = right;
            }
            let mut left = Side::EMPTY;
            for (border, (bin, right)) in (1..).zip(bins.iter().zip(&sums[1..])) {
                left = left.with(&bin.spread, bin.begin);
                if !is_candidate([left.count, right.count], count + spare) {
                    continue;
                }
                let cost = NODE_COST + (left.weight() + right.weight()) / area;
                let split = Split { axis, scale, border, cost, sides: [left, *right] };
                if cost.is_finite() && best.as_ref().is_none_or(|best| split.order() < best.order()) {
                    best = Some(split);
                }
            }
        }
        best
    }
}

/// Returns whether there are items on both sides of a border, and at most `most` on both together: items that it cuts
/// count twice.
fn is_candidate([left, right]: [usize; 2], most: usize) -> bool {
    left > 0 && right > 0 && left + right <= most
}

/// Returns whether some border is a candidate, by the counts alone.
fn has_candidate(bins: &[Bin], count: usize, spare: usize) -> bool {
    let (mut left, mut right) = (0, count);
    bins[1..].iter().zip(bins).any(|(_, before)| {
        left += before.begin;
        right -= before.end;
        is_candidate([left, right], count + spare)
    })
}

/// Computes boxes of the parts of a triangle in each bin from `begin` on. They are approximate, because they only
/// select a plane; [`Primitives::part`] then computes the parts on both sides.
pub(super) fn slice(boxes: &mut [Spread], corners: [Vec3A; 3], begin: usize, scale: &Scale, axis: usize) {
    boxes.fill(Spread::EMPTY);
    let last = boxes.len() - 1;
    let before = corners.map(|corner| scale.borders_before(corner[axis]));
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        if let Some(own) = before[i].checked_sub(begin + 1)
            && own <= last
        {
            boxes[own] = boxes[own].add(corners[i]);
        }
        let (low, high) = if corners[i][axis] <= corners[j][axis] { (i, j) } else { (j, i) };
        let edge = corners[high] - corners[low];
        let slope = edge / edge[axis];
        for border in before[low].max(begin)..before[high].min(begin + last + 2) {
            let point = corners[low] + slope * (scale.border(border) - corners[low][axis]);
            // The point is in the bins on both sides.
            let right = border - begin;
            for bin in &mut boxes[right.saturating_sub(1)..=right.min(last)] {
                *bin = bin.add(point);
            }
        }
    }
}
