//! Bottom-up construction over few items: the two items with the smallest union are merged first.

use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8, u32x8};

use super::record::{Planes, Record, half_area, union};

/// Greatest number of items.
pub(super) const MAX: usize = 8;

/// Writes the nodes below the parent of 2 to [`MAX`] items, where `from` is the place of the first of `nodes`: the
/// parent's children, then all nodes below the left one, then all nodes below the right one.
#[inline(always)]
pub(in crate::bvh) fn merge<S: Simd>(simd: S, items: &[Record], nodes: &mut [Record], from: u32) {
    match items {
        [a, b] => nodes[..2].copy_from_slice(&[*a, *b]),
        [a, b, c] => {
            let area = |a: &Record, b: &Record| half_area(&a.union(b));
            let (ab, bc, ca) = (area(a, b), area(b, c), area(c, a));
            let [alone, left, right] = if ab <= bc && ab <= ca {
                [c, a, b]
            } else if bc <= ca {
                [a, b, c]
            } else {
                [b, c, a]
            };
            nodes[0] = Record::parent([left, right], from + 2);
            nodes[1] = *alone;
            nodes[2..4].copy_from_slice(&[*left, *right]);
        }
        _ => write(&Merges::of(simd, items), items, nodes, from),
    }
}

/// Pairs of clusters, in the order in which they were merged. A cluster is an item, or [`MAX`] and the number of a merge.
struct Merges {
    pairs: [[u8; 2]; MAX],
    boxes: [Planes; MAX],
    count: usize,
}

impl Merges {
    #[inline(always)]
    fn of<S: Simd>(simd: S, items: &[Record]) -> Self {
        let n = items.len().min(MAX);
        let mut lanes = Lanes([[f32::NEG_INFINITY; MAX]; 6]);
        let (mut boxes, mut clusters) = ([FAR; MAX], [0_u8; MAX]);
        for (i, item) in items.iter().enumerate().take(MAX) {
            (boxes[i], clusters[i]) = (*item.planes(), i as u8);
            lanes.set(i, &boxes[i]);
        }
        let mut best = [f32::INFINITY; MAX];
        for i in 0..n {
            best[i] = lanes.best(simd, i, &boxes[i]);
        }
        let mut merges = Self { pairs: [[0; 2]; MAX], boxes: [FAR; MAX], count: n - 1 };
        for made in 0..n - 1 {
            let (mut a, mut least) = (0, best[0]);
            for (i, &key) in best.iter().enumerate() {
                let is_less = key < least;
                a = if is_less { i } else { a };
                least = if is_less { key } else { least };
            }
            let b = partner(least);
            let (a, b) = (a.min(b), a.max(b));
            let both = union(&boxes[a], &boxes[b]);
            (merges.pairs[made], merges.boxes[made]) = ([clusters[a], clusters[b]], both);
            (boxes[a], clusters[a], best[b]) = (both, (MAX + made) as u8, f32::INFINITY);
            if made + 2 == n {
                break;
            }
            lanes.set(b, &FAR);
            lanes.set(a, &both);
            // A union with the new cluster is no smaller than that with either of its parts: all other clusters keep
            // their partners.
            for i in 0..n {
                let own = partner(best[i]);
                if best[i] < f32::INFINITY && (i == a || own == a || own == b) {
                    best[i] = lanes.best(simd, i, &boxes[i]);
                }
            }
        }
        merges
    }
}

/// The partner in a key of [`Lanes::best`].
#[inline(always)]
fn partner(key: f32) -> usize {
    key.to_bits() as usize % MAX
}

/// An absent cluster: every union with it is infinite.
const FAR: Planes = [f32::NEG_INFINITY; 8];

/// Clusters in parallel lanes, one register for each plane.
#[repr(C, align(32))]
struct Lanes([[f32; MAX]; 6]);

/// The planes of a record.
const PLANES: [usize; 6] = [0, 1, 2, 4, 5, 6];

impl Lanes {
    #[inline(always)]
    fn set(&mut self, lane: usize, planes: &Planes) {
        for (row, plane) in self.0.iter_mut().zip(PLANES) {
            row[lane % MAX] = planes[plane];
        }
    }

    /// Returns the best partner of a lane, as a key: the half area of the union, with the partner in its last bits.
    #[inline(always)]
    fn best<S: Simd>(&self, simd: S, lane: usize, planes: &Planes) -> f32 {
        let [x0, y0, z0, x1, y1, z1] = &self.0;
        let x = row(simd, x0, planes[0]) + row(simd, x1, planes[4]);
        let y = row(simd, y0, planes[1]) + row(simd, y1, planes[5]);
        let z = row(simd, z0, planes[2]) + row(simd, z1, planes[6]);
        // Excludes the lane itself.
        let own = f32x8::from_slice(simd, &OWN[MAX - 1 - lane % MAX..][..MAX]);
        let area = ((x + y) * z + x * y + own).min(f32::MAX);
        let bits: u32x8<S> = area.to_bits();
        let numbers = u32x8::load_array(simd, [0, 1, 2, 3, 4, 5, 6, 7]);
        let key = f32x8::from_bits((bits & !(MAX as u32 - 1)) | numbers);
        let (low, high) = simd.split_f32x8(key);
        let [a, b, c, d] = low.min(high).to_array();
        let (a, b) = (if a < b { a } else { b }, if c < d { c } else { d });
        if a < b { a } else { b }
    }
}

#[inline(always)]
fn row<S: Simd>(simd: S, row: &[f32; MAX], plane: f32) -> f32x8<S> {
    f32x8::load_array_ref(simd, row).min(plane)
}

/// Infinity in the middle.
const OWN: [f32; 2 * MAX - 1] = {
    let mut own = [0.0; 2 * MAX - 1];
    own[MAX - 1] = f32::INFINITY;
    own
};

/// Writes the tree of these merges.
#[inline(always)]
fn write(merges: &Merges, items: &[Record], nodes: &mut [Record], from: u32) {
    let mut counts = [1_u32; 2 * MAX];
    for (made, [a, b]) in merges.pairs.iter().enumerate().take(merges.count) {
        counts[MAX + made] = counts[*a as usize % (2 * MAX)] + counts[*b as usize % (2 * MAX)];
    }
    // Merges whose clusters are not yet written, and their places.
    let mut pending = [(0_usize, 0_u32); MAX];
    pending[0] = (merges.count - 1, 0);
    let mut open = 1;
    while open > 0 {
        open -= 1;
        let (merge, place) = pending[open % MAX];
        let mut below = place + 2;
        for (side, cluster) in merges.pairs[merge % MAX].into_iter().enumerate() {
            let (cluster, place) = (cluster as usize % (2 * MAX), place as usize + side);
            if cluster < MAX {
                nodes[place] = items[cluster];
            } else {
                nodes[place] = Record::over(&merges.boxes[cluster - MAX], from + below, counts[cluster]);
                pending[open % MAX] = (cluster - MAX, below);
                open += 1;
                below += 2 * counts[cluster] - 2;
            }
        }
    }
}

#[cfg(test)]
mod tests;
