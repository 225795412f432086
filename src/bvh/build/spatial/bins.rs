//! The cheapest planes, found at the borders of bins.

use super::super::Primitives;
use super::super::item::{Extents, Item, Spread};
use super::super::sah::NODE_COST;
use super::split::{Scale, Side, Split};

/// Room for the bins of one axis, and the sums from the right.
pub(super) struct Bins {
    bins: Vec<Bin>,
    right: Vec<Side>,
}

/// Items that begin in a bin, that end in it, and the box of what they have in it.
#[derive(Clone, Copy)]
struct Bin {
    spread: Spread,
    begin: usize,
    end: usize,
}

impl Bin {
    const EMPTY: Self = Self { spread: Spread::EMPTY, begin: 0, end: 0 };
}

impl Bins {
    pub(super) fn new(bins: usize) -> Self {
        Self { bins: vec![Bin::EMPTY; bins], right: vec![Side::EMPTY; bins] }
    }

    /// The cheapest cut between items, by their centroids.
    pub(super) fn between(&mut self, items: &[Item], extents: &Extents) -> Option<Split> {
        self.cheapest(items.len(), &extents.boxes, |bins, axis| {
            let scale = Scale::new(&extents.centroids, axis, bins.len())?;
            for item in items {
                let bin = &mut bins[scale.bin(item.centroid()[axis])];
                bin.spread = bin.spread.union(item.spread());
                bin.begin += 1;
                bin.end += 1;
            }
            Some(scale)
        })
    }

    /// The cheapest plane that may cut items in two.
    pub(super) fn across<P: Primitives + ?Sized>(
        &mut self,
        primitives: &P,
        items: &[Item],
        spread: &Spread,
    ) -> Option<Split> {
        self.cheapest(items.len(), spread, |bins, axis| {
            let scale = Scale::new(spread, axis, bins.len())?;
            for item in items {
                let whole = item.spread();
                let [begin, end] = [whole.lo, whole.hi].map(|plane| scale.bin(plane[axis]));
                bins[begin].begin += 1;
                bins[end].end += 1;
                if begin == end {
                    bins[begin].spread = bins[begin].spread.union(whole);
                    continue;
                }
                for (i, bin) in (begin..).zip(&mut bins[begin..=end]) {
                    let mut part = whole.aabb();
                    if i > begin {
                        part.lo[axis] = scale.border(i);
                    }
                    if i < end {
                        part.hi[axis] = scale.border(i + 1);
                    }
                    let part = primitives.part(item.prim() as usize, &part);
                    if part.lo.cmple(part.hi).all() {
                        bin.spread = bin.spread.union(Spread { lo: part.lo.into(), hi: part.hi.into() });
                    }
                }
            }
            Some(scale)
        })
    }

    /// The cheapest border of three axes, whose bins `fill` fills.
    fn cheapest(
        &mut self,
        count: usize,
        whole: &Spread,
        mut fill: impl FnMut(&mut [Bin], usize) -> Option<Scale>,
    ) -> Option<Split> {
        // More bins than these do not make better cuts of few items.
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
                if left.count == 0 || right.count == 0 {
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
