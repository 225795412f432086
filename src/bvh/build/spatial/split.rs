//! A split of a range, and the items of both sides.

use super::super::Primitives;
use super::super::record::Record;
use super::extents::Spread;

/// A border between bins.
#[derive(Clone, Copy)]
pub(super) struct Split {
    pub(super) axis: usize,
    pub(super) scale: Scale,
    /// First bin of the right side.
    pub(super) border: usize,
    /// Cost of the node with this split, in triangle tests.
    pub(super) cost: f32,
    pub(super) sides: [Side; 2],
}

impl Split {
    /// Orders splits: cheaper first, then more even.
    pub(super) fn order(&self) -> (f32, usize) {
        (self.cost, self.sides[0].count.max(self.sides[1].count))
    }

    /// Returns the half area of the intersection of both boxes.
    pub(super) fn overlap(&self) -> f32 {
        let [left, right] = self.sides.map(|side| side.spread);
        let both = left.intersection(right);
        if both.lo.cmple(both.hi).all() { both.half_area() } else { 0.0 }
    }

    /// Moves the items with centroids left of the border to the front.
    pub(super) fn part(&self, items: &mut [Record]) -> [usize; 2] {
        let mut left = 0;
        for i in 0..items.len() {
            if self.scale.bin(items[i].centroid()[self.axis]) < self.border {
                items.swap(left, i);
                left += 1;
            }
        }
        [left, items.len() - left]
    }

    /// Returns the items of both sides, with parts of the items that the plane cuts. `None` if one side would have
    /// none.
    pub(super) fn cut<P: Primitives + ?Sized>(
        &self,
        primitives: &P,
        items: &[Record],
        mut spare: usize,
    ) -> Option<[Vec<Record>; 2]> {
        let (axis, plane) = (self.axis, self.scale.border(self.border));
        let (mut lists, mut sides) = ([Vec::new(), Vec::new()], [Side::EMPTY; 2]);
        let mut cut = Vec::new();
        for item in items {
            let Spread { lo, hi } = Spread::of(item);
            let side = if hi[axis] <= plane {
                0
            } else if plane <= lo[axis] {
                1
            } else {
                cut.push(item);
                continue;
            };
            sides[side] = sides[side].with(&Spread::of(item), 1);
            lists[side].push(*item);
        }
        for item in cut {
            let whole = Spread::of(item);
            let [mut left, mut right] = [whole.aabb(); 2];
            left.hi[axis] = plane;
            right.lo[axis] = plane;
            let parts = [left, right].map(|part| primitives.part(item.first() as usize, &part));
            // A box may extend beyond its primitive.
            let holds = parts.map(|part| part.lo.cmple(part.hi).all());
            let parts = parts.map(|part| Record::item(&part, item.first()));
            let alone = [0, 1].map(|i| sides[i].with(&whole, 1).weight() + sides[1 - i].weight());
            let both = [0, 1].map(|i| sides[i].with(&Spread::of(&parts[i]), 1));
            let chosen: &[(usize, Record)] =
                if holds[0] && holds[1] && spare > 0 && both[0].weight() + both[1].weight() < alone[0].min(alone[1]) {
                    spare -= 1;
                    &[(0, parts[0]), (1, parts[1])]
                } else if holds[0] != holds[1] {
                    let side = usize::from(holds[1]);
                    &[(side, parts[side])]
                } else {
                    &[(usize::from(alone[1] < alone[0]), *item)]
                };
            for &(side, item) in chosen {
                sides[side] = sides[side].with(&Spread::of(&item), 1);
                lists[side].push(item);
            }
        }
        lists.iter().all(|list| !list.is_empty()).then_some(lists)
    }
}

/// One side of a split.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) spread: Spread,
    pub(super) count: usize,
}

impl Side {
    pub(super) const EMPTY: Self = Self { spread: Spread::EMPTY, count: 0 };

    #[inline]
    pub(super) fn with(self, spread: &Spread, count: usize) -> Self {
        Self { spread: self.spread.union(*spread), count: self.count + count }
    }

    /// Returns the expected triangle tests below, times the half area of the box.
    #[inline]
    pub(super) fn weight(&self) -> f32 {
        if self.count == 0 { 0.0 } else { self.spread.half_area() * self.count as f32 }
    }
}

/// Bins of equal width along an axis.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    start: f32,
    width: f32,
    factor: f32,
    last: f32,
}

impl Scale {
    /// Creates bins; `None` if there is no extent to divide.
    pub(super) fn new(spread: &Spread, axis: usize, bins: usize) -> Option<Self> {
        let extent = spread.extent()[axis];
        let (width, factor) = (extent / bins as f32, bins as f32 / extent);
        let is_usual = width > 0.0 && width.is_finite() && factor.is_finite();
        is_usual.then_some(Self { start: spread.lo[axis], width, factor, last: bins as f32 - 1.0 })
    }

    /// Returns the bin of a coordinate; monotone.
    #[inline]
    pub(super) fn bin(&self, coordinate: f32) -> usize {
        ((coordinate - self.start) * self.factor).min(self.last) as usize
    }

    /// Returns the approximate start of a bin.
    #[inline]
    pub(super) fn border(&self, bin: usize) -> f32 {
        self.start + self.width * bin as f32
    }

    /// Returns the approximate number of borders that are not beyond a coordinate, of the borders from that of bin 0 to
    /// one after the last bin.
    #[inline]
    pub(super) fn borders_before(&self, coordinate: f32) -> usize {
        // Before the first border it is negative, which counts as 0.
        ((coordinate - self.start) * self.factor + 1.0).min(self.last + 2.0) as usize
    }
}
