//! The surface area heuristic, evaluated at the borders of bins: for many items.

use glam::Vec3A;
use rayon::prelude::*;

use super::item::{CHUNK, Extents, Item, Spread};
use super::sweep::{Candidates, Cheapest, half_areas, indices, unions};
use super::top_down::Cut;

/// At most `N` bins on each axis, a power of two.
struct Bins<const N: usize> {
    boxes: [[Spread; 3]; N],
    counts: [[u32; 3]; N],
}

/// A border between bins.
pub(super) struct Plane {
    axis: usize,
    scale: Scale,
    /// First bin of the right side.
    border: usize,
    boxes: [Spread; 2],
    /// Sum over both sides of half area times count.
    pub(super) weight: f32,
    /// Items on the side that has more.
    pub(super) greater: usize,
}

impl Plane {
    /// The cheapest one that has centroids on both sides. `None` if there is none of finite cost.
    pub(super) fn cheapest<const N: usize>(items: &[Item], extents: &Extents, bins: usize) -> Option<Self> {
        let scale = Scale::new(extents.centroids, bins.min(N));
        let of = |items: &[Item]| Bins::<N>::of(items, scale);
        let bins = if items.len() < 4 * CHUNK {
            of(items)
        } else {
            items.par_chunks(CHUNK).map(of).reduce(|| Bins::EMPTY, Bins::merge)
        };
        let Cheapest { axis, place: border, weight } = bins.cheapest(items.len())?;
        let [left, right] = [0..border, border..N].map(|range| {
            let range = range.map(|bin| (bins.boxes[bin][axis], bins.counts[bin][axis]));
            range.fold((Spread::EMPTY, 0), |(all, sum), (aabb, count)| (all.union(aabb), sum + count as usize))
        });
        Some(Self { axis, scale, border, boxes: [left.0, right.0], weight, greater: left.1.max(right.1) })
    }

    /// Moves what is left of the plane to the front.
    pub(super) fn part(&self, items: &mut [Item]) -> Cut {
        let mut left = 0;
        let mut centroids = [Spread::EMPTY; 2];
        for i in 0..items.len() {
            let item = items[i];
            let centroid = item.centroid();
            let is_right = self.scale.bins(centroid)[self.axis] >= self.border as u32;
            let side = &mut centroids[usize::from(is_right)];
            *side = side.add(centroid);
            // Swapped in any case, as branches would be mispredicted: an item of the right may change places with another.
            items[i] = items[left];
            items[left] = item;
            left += usize::from(!is_right);
        }
        let extents = [0, 1].map(|side| Extents { boxes: self.boxes[side], centroids: centroids[side] });
        Cut { axis: self.axis, left, extents }
    }
}

impl<const N: usize> Bins<N> {
    const EMPTY: Self = Self { boxes: [[Spread::EMPTY; 3]; N], counts: [[0; 3]; N] };

    fn of(items: &[Item], scale: Scale) -> Self {
        let mut bins = Self::EMPTY;
        for item in items {
            for (axis, bin) in scale.bins(item.centroid()).into_iter().enumerate() {
                let bin = bin as usize % N;
                bins.boxes[bin][axis] = bins.boxes[bin][axis].union(item.spread());
                bins.counts[bin][axis] += 1;
            }
        }
        bins
    }

    fn merge(mut self, other: Self) -> Self {
        for bin in 0..N {
            self.boxes[bin] = unions(self.boxes[bin], other.boxes[bin]);
            self.counts[bin] = [0, 1, 2].map(|axis| self.counts[bin][axis] + other.counts[bin][axis]);
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
            right = unions(right, self.boxes[bin]);
            right_areas[bin] = half_areas(right);
        }
        let mut left = [Spread::EMPTY; 3];
        let mut count = [0; 3];
        let mut best = Candidates::NONE;
        for border in 1..N {
            left = unions(left, self.boxes[border - 1]);
            count = [0, 1, 2].map(|axis| count[axis] + self.counts[border - 1][axis]);
            let others = count.map(|count| n as u32 - count);
            best.offer(half_areas(left) * numbers(count) + right_areas[border] * numbers(others), border);
        }
        best.cheapest()
    }
}

/// Maps centroids to bins of equal width, monotonically on each axis.
#[derive(Clone, Copy)]
struct Scale {
    start: Vec3A,
    factor: Vec3A,
    last: Vec3A,
}

impl Scale {
    fn new(centroids: Spread, bins: usize) -> Self {
        let extent = centroids.extent();
        let factor = Vec3A::select(extent.cmpgt(Vec3A::ZERO), bins as f32 / extent, Vec3A::ZERO);
        Self { start: centroids.lo, factor, last: Vec3A::splat(bins as f32 - 1.0) }
    }

    /// Bin on each axis. Where the extent is 0 or overflows, the first bin has all.
    #[inline]
    fn bins(&self, centroid: Vec3A) -> [u32; 3] {
        // Less a half, as the nearest integer is taken.
        indices(((centroid - self.start) * self.factor - 0.5).max(Vec3A::ZERO).min(self.last))
    }
}
