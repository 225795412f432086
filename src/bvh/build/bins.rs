//! The surface area heuristic, evaluated at the borders of bins: for many items.

use glam::Vec3A;

use super::item::{CHUNK, Extents, Item, Spread};
use super::sah::Split;
use super::sweep::{Candidates, Cheapest, half_areas, indices, rounded, unions};
use super::top_down::Cut;
use crate::threads;

/// At most `N` bins on each axis, a power of two.
struct Bins<const N: usize> {
    boxes: [[Spread; N]; 3],
    counts: [[u32; N]; 3],
}

/// A border between bins.
pub(super) struct Plane {
    axis: usize,
    scale: Scale,
    /// First bin of the right side.
    border: usize,
    boxes: [Spread; 2],
    /// Sum over both sides of half area times count.
    weight: f32,
    greater: usize,
}

impl Plane {
    /// The cheapest one that has centroids on both sides. `None` if there is none, or weights tell none
    /// from another.
    pub(super) fn cheapest<const N: usize>(items: &[Item], extents: &Extents, bins: usize) -> Option<Self> {
        let scale = Scale::new(extents.centroids, bins.min(N));
        let of = |items: &[Item]| Bins::<N>::of(items, scale);
        let bins = if items.len() < 4 * CHUNK { of(items) } else { threads::reduce(items, CHUNK, of, Bins::merge)? };
        let Cheapest { axis, place: border, weight } = bins.cheapest(items.len())?;
        let [left, right] = [0..border, border..N].map(|range| {
            let range = range.map(|bin| (bins.boxes[axis][bin], bins.counts[axis][bin]));
            range.fold((Spread::EMPTY, 0), |(all, sum), (aabb, count)| (all.union(aabb), sum + count as usize))
        });
        Some(Self { axis, scale, border, boxes: [left.0, right.0], weight, greater: left.1.max(right.1) })
    }
}

impl Split for Plane {
    fn weight(&self) -> f32 {
        self.weight
    }

    fn greater(&self) -> usize {
        self.greater
    }

    /// Moves what is left of the plane to the front.
    fn part(&self, items: &mut [Item]) -> Cut {
        let mut left = 0;
        let mut centroids = [Spread::EMPTY; 2];
        let border = rounded(Vec3A::splat(self.border as f32));
        for i in 0..items.len() {
            let item = items[i];
            let centroid = item.centroid();
            let is_right = self.scale.bins(centroid).cmpge(border).bitmask() >> self.axis & 1;
            let side = &mut centroids[is_right as usize];
            *side = side.add(centroid);
            // Swapped in any case, as branches would be mispredicted: an item of the right may change places with
            // another.
            items[i] = items[left];
            items[left] = item;
            left += 1 - is_right as usize;
        }
        let extents = [0, 1].map(|side| Extents { boxes: self.boxes[side], centroids: centroids[side] });
        Cut { axis: self.axis, left, extents }
    }
}

impl<const N: usize> Bins<N> {
    const EMPTY: Self = Self { boxes: [[Spread::EMPTY; N]; 3], counts: [[0; N]; 3] };

    fn of(items: &[Item], scale: Scale) -> Self {
        let mut bins = Self::EMPTY;
        for item in items {
            for (axis, bin) in indices(scale.bins(item.centroid())).into_iter().enumerate() {
                let bin = bin as usize % N;
                bins.boxes[axis][bin] = bins.boxes[axis][bin].union(item.spread());
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }

    fn merge(mut self, other: Self) -> Self {
        for (aabb, other) in self.boxes.as_flattened_mut().iter_mut().zip(other.boxes.as_flattened()) {
            *aabb = aabb.union(*other);
        }
        for (count, other) in self.counts.as_flattened_mut().iter_mut().zip(other.counts.as_flattened()) {
            *count += other;
        }
        self
    }

    /// All axes at once. The box of nothing has an infinite area; times a count of 0 that is NaN, so that borders with
    /// nothing on one side are never taken.
    fn cheapest(&self, n: usize) -> Option<Cheapest> {
        let numbers = |counts: [u32; 3]| Vec3A::from_array(counts.map(|count| count as i32 as f32));
        let mut right = [Spread::EMPTY; 3];
        let mut right_areas = [Vec3A::ZERO; N];
        for bin in (1..N).rev() {
            right = unions(right, self.boxes.each_ref().map(|boxes| boxes[bin]));
            right_areas[bin] = half_areas(right);
        }
        let mut left = [Spread::EMPTY; 3];
        let mut count = [0; 3];
        let mut best = Candidates::NONE;
        for border in 1..N {
            left = unions(left, self.boxes.each_ref().map(|boxes| boxes[border - 1]));
            count = [0, 1, 2].map(|axis| count[axis] + self.counts[axis][border - 1]);
            let others = count.map(|count| n as u32 - count);
            best.offer(half_areas(left) * numbers(count) + right_areas[border] * numbers(others), border);
        }
        best.cheapest()
    }
}

/// Maps centroids to bins of equal width, monotonically on each axis.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    start: Vec3A,
    factor: Vec3A,
    last: Vec3A,
}

impl Scale {
    pub(super) fn new(centroids: Spread, bins: usize) -> Self {
        let extent = centroids.extent();
        // Of the smallest extents the quotient overflows. An infinite one would tell only the first centroid apart.
        let factor = (bins as f32 / extent).min(Vec3A::MAX);
        let factor = Vec3A::select(extent.cmpgt(Vec3A::ZERO), factor, Vec3A::ZERO);
        Self { start: centroids.lo, factor, last: Vec3A::splat(bins as f32 - 1.0) }
    }

    /// Bin on each axis, for [`indices`]. Where the extent is 0 or overflows, the first bin has all.
    #[inline]
    pub(super) fn bins(&self, centroid: Vec3A) -> Vec3A {
        // Less a half, as the nearest integer is taken.
        rounded(((centroid - self.start) * self.factor - 0.5).max(Vec3A::ZERO).min(self.last))
    }
}
