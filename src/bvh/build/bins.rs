//! The surface area heuristic, evaluated at the borders of bins.
//!
//! Wald 2007, "On fast construction of SAH-based bounding volume hierarchies": centroids are counted in bins of equal
//! width along each axis. The node is split at the cheapest border between two bins.

use fearless_simd::{Select, Simd, SimdBase, SimdInt, SimdMask, f32x4, f32x8, i32x4};

use super::record::{EMPTY, Planes, Record, union};

/// Boxes and numbers of the items in each of `N` bins, on each axis. A bin does not cross a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Bins<const N: usize> {
    boxes: [[Planes; 4]; N],
    counts: [[i32; 4]; N],
}

/// A border between bins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Border {
    pub(super) axis: usize,
    /// The first bin of the right side.
    bin: usize,
    /// Items of the left side.
    pub(super) left: usize,
    /// The boxes of both sides.
    pub(super) boxes: [Planes; 2],
}

impl<const N: usize> Bins<N> {
    const EMPTY: Self = Self { boxes: [[EMPTY; 4]; N], counts: [[0; 4]; N] };

    #[inline(always)]
    pub(super) fn of<S: Simd>(simd: S, items: &[Record], scale: &Scale) -> Self {
        let mut bins = Self::EMPTY;
        if items.len() < 32 * N {
            for item in items {
                bins.add(simd, item, scale);
            }
            return bins;
        }
        // Neighbours often fall into the same bins. Two interleaved sets avoid waits for the previous item.
        let mut others = Self::EMPTY;
        let (pairs, rest) = items.as_chunks::<2>();
        for [a, b] in pairs {
            bins.add(simd, a, scale);
            others.add(simd, b, scale);
        }
        for item in rest {
            bins.add(simd, item, scale);
        }
        bins.and(others)
    }

    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, item: &Record, scale: &Scale) {
        let planes = item.load(simd);
        let at = scale.bins(simd, planes).to_array();
        for (axis, at) in at.into_iter().enumerate().take(3) {
            let bin = at.to_bits() as usize % N;
            let grown = f32x8::load_array_ref(simd, &self.boxes[bin][axis]).min(planes);
            grown.store_array(&mut self.boxes[bin][axis]);
            self.counts[bin][axis] += 1;
        }
    }

    /// Adds the contents of other bins.
    pub(super) fn and(mut self, other: Self) -> Self {
        for (a, b) in self.boxes.as_flattened_mut().iter_mut().zip(other.boxes.as_flattened()) {
            *a = union(a, b);
        }
        for (a, b) in self.counts.as_flattened_mut().iter_mut().zip(other.counts.as_flattened()) {
            *a += b;
        }
        self
    }

    /// Returns the cheapest border of `n` items: the least sum over both sides of half area times count. `None` if no
    /// border has items on both sides, or areas vanish.
    #[inline(always)]
    pub(super) fn cheapest<S: Simd>(&self, simd: S, n: usize) -> Option<Border> {
        let empty = f32x8::splat(simd, f32::INFINITY);
        let mut right = [empty; 3];
        let mut areas = [[0.0_f32; 4]; N];
        for bin in (1..N).rev() {
            right = self.grown(simd, right, bin);
            areas[bin] = half_areas(simd, right).to_array();
        }
        let mut left = [empty; 3];
        let mut counts = f32x4::splat(simd, 0.0);
        let (mut weights, mut places) = (f32x4::splat(simd, f32::INFINITY), f32x4::splat(simd, 0.0));
        for (border, &right) in areas.iter().enumerate().skip(1) {
            left = self.grown(simd, left, border - 1);
            let count: f32x4<S> = i32x4::load_array_ref(simd, &self.counts[border - 1]).to_float();
            counts += count;
            let others = f32x4::splat(simd, n as f32) - counts;
            // The empty box has an infinite area; times a count of 0 that is NaN, which is not less.
            let weight = half_areas(simd, left) * counts + f32x4::load_array(simd, right) * others;
            let is_less = weight.simd_lt(weights);
            weights = is_less.select(weight, weights);
            places = is_less.select(f32x4::splat(simd, border as f32), places);
        }
        let ([x, y, z, _], places) = (weights.to_array(), places.to_array());
        let axis = if y < x {
            if z < y { 2 } else { 1 }
        } else if z < x {
            2
        } else {
            0
        };
        let weight = [x, y, z][axis];
        let is_told = (f32::MIN_POSITIVE..f32::INFINITY).contains(&weight);
        is_told.then(|| self.border(simd, axis, places[axis] as usize))
    }

    #[inline(always)]
    fn border<S: Simd>(&self, simd: S, axis: usize, bin: usize) -> Border {
        let mut boxes = [f32x8::splat(simd, f32::INFINITY); 2];
        let mut left = 0;
        for i in 0..N {
            let side = usize::from(i >= bin);
            boxes[side] = boxes[side].min(f32x8::load_array_ref(simd, &self.boxes[i][axis]));
            left += if side == 0 { self.counts[i][axis] as usize } else { 0 };
        }
        Border { axis, bin, left, boxes: [boxes[0].to_array(), boxes[1].to_array()] }
    }

    #[inline(always)]
    fn grown<S: Simd>(&self, simd: S, all: [f32x8<S>; 3], bin: usize) -> [f32x8<S>; 3] {
        let boxes = &self.boxes[bin];
        [
            all[0].min(f32x8::load_array_ref(simd, &boxes[0])),
            all[1].min(f32x8::load_array_ref(simd, &boxes[1])),
            all[2].min(f32x8::load_array_ref(simd, &boxes[2])),
        ]
    }
}

impl Border {
    /// Moves the items of the left side to the front. Returns their number, and the boxes of the centroids of both
    /// sides.
    #[inline(always)]
    pub(super) fn part<S: Simd>(&self, simd: S, items: &mut [Record], scale: &Scale) -> (usize, [Planes; 2]) {
        let empty = f32x8::splat(simd, f32::INFINITY);
        let (mut of_left, mut of_right) = (empty, empty);
        let least = f32x8::splat(simd, threshold(self.bin));
        let axis = self.axis & 3;
        let (start, factor) = (scale.start[axis], scale.factor[axis]);
        let mut left = 0;
        for i in 0..items.len() {
            let planes = items[i].planes();
            let along = planes[axis] * 0.5 - planes[axis + 4] * 0.5;
            let planes = items[i].load(simd);
            // By masks and unconditional swaps: branches would be mispredicted.
            let is_right = f32x8::splat(simd, (along - start) * factor - 0.5).simd_ge(least);
            let centroid = centroid(simd, planes);
            of_left = of_left.min(is_right.select(empty, centroid));
            of_right = of_right.min(is_right.select(centroid, empty));
            items[i] = items[left];
            items[left] = Record::stored(planes);
            left += 1 - (is_right.to_bitmask() & 1) as usize;
        }
        (left, [of_left.to_array(), of_right.to_array()])
    }
}

/// Maps centroids to bins of equal width, monotonically on each axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    start: [f32; 4],
    factor: [f32; 4],
    last: f32,
}

/// From here on, the last bit of a float is one.
const ROUND: f32 = 8_388_608.0;

impl Scale {
    pub(super) fn new(centroids: &Planes, bins: usize) -> Self {
        let factor = |axis: usize| {
            let extent = -(centroids[axis] + centroids[axis + 4]);
            // The quotient overflows for the smallest extents.
            if extent > 0.0 { (bins as f32 / extent).min(f32::MAX) } else { 0.0 }
        };
        let [x, y, z, ..] = *centroids;
        Self { start: [x, y, z, 0.0], factor: [factor(0), factor(1), factor(2), 0.0], last: bins as f32 - 1.0 }
    }

    /// Returns the bin on each axis, in the last bits of a float.
    #[inline(always)]
    fn bins<S: Simd>(&self, simd: S, planes: f32x8<S>) -> f32x4<S> {
        let (lo, hi) = simd.split_f32x8(planes);
        let centroid = lo * 0.5 - hi * 0.5;
        let start = f32x4::load_array(simd, self.start);
        let factor = f32x4::load_array(simd, self.factor);
        // Less a half, because rounding is to the nearest integer.
        ((centroid - start) * factor - 0.5).max(0.0).min(self.last) + ROUND
    }
}

/// Returns the least number that rounds to a bin or a later one: ties go to the even bin.
fn threshold(bin: usize) -> f32 {
    let middle = bin as f32 - 0.5;
    if bin.is_multiple_of(2) { middle } else { middle.next_up() }
}

/// The box of some items, and that of their centroids.
#[inline(always)]
pub(super) fn extents<S: Simd>(simd: S, items: &[Record]) -> [Planes; 2] {
    let mut boxes = f32x8::splat(simd, f32::INFINITY);
    let mut centroids = boxes;
    for item in items {
        let planes = item.load(simd);
        boxes = boxes.min(planes);
        centroids = centroids.min(centroid(simd, planes));
    }
    [boxes.to_array(), centroids.to_array()]
}

/// The center, and the negated center.
#[inline(always)]
fn centroid<S: Simd>(simd: S, planes: f32x8<S>) -> f32x8<S> {
    let (lo, hi) = simd.split_f32x8(planes);
    planes * 0.5 - simd.combine_f32x4(hi, lo) * 0.5
}

/// Half of the surface area of each.
#[inline(always)]
fn half_areas<S: Simd>(simd: S, [a, b, c]: [f32x8<S>; 3]) -> f32x4<S> {
    // Without `map`: closures would not be compiled for the instruction level.
    let (a, b, c) = (extent(simd, a), extent(simd, b), extent(simd, c));
    let (first, second) = (a.zip_low(c), b.zip_low(c));
    let (third, fourth) = (a.zip_high(c), b.zip_high(c));
    let (x, y, z) = (first.zip_low(second), first.zip_high(second), third.zip_low(fourth));
    (x + y) * z + x * y
}

/// Negated, like both factors of an area.
#[inline(always)]
fn extent<S: Simd>(simd: S, planes: f32x8<S>) -> f32x4<S> {
    let (lo, hi) = simd.split_f32x8(planes);
    lo + hi
}

#[cfg(test)]
mod tests;
