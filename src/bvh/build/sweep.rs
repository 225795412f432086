//! The surface area heuristic, evaluated between any two centroids: for few items.

use glam::{Mat3A, Vec3A};

use super::item::{Extents, Item, Spread};
use super::sah::Split;
use super::top_down::Cut;

/// Items that a sweep may have. For so few it is faster than bins.
pub(super) const MAX: usize = 16;

/// The cheapest cut of at most `N` items, a power of two.
pub(super) struct Sweep<const N: usize> {
    /// For each item its place in the order of the centroids, on each axis.
    ranks: [[u32; 3]; N],
    /// How many items there are.
    n: usize,
    best: Cheapest,
}

impl<const N: usize> Sweep<N> {
    /// `None` if weights tell no cut from another.
    pub(super) fn new(items: &[Item]) -> Option<Self> {
        let n = items.len().min(N);
        let ranks = ranks(items);
        let mut sorted = [[Spread::EMPTY; N]; 3];
        for (item, ranks) in items.iter().zip(&ranks) {
            for (sorted, &rank) in sorted.iter_mut().zip(ranks) {
                sorted[rank as usize % N] = item.spread();
            }
        }
        let at = |place: usize| [0, 1, 2].map(|axis: usize| sorted[axis][place % N]);
        let mut right = [Spread::EMPTY; 3];
        let mut right_weights = [Vec3A::ZERO; N];
        for place in (1..n).rev() {
            right = unions(right, at(place));
            right_weights[place % N] = half_areas(right) * (n - place) as f32;
        }
        let mut left = [Spread::EMPTY; 3];
        let mut best = Candidates::NONE;
        for place in 1..n {
            left = unions(left, at(place - 1));
            best.offer(half_areas(left) * place as f32 + right_weights[place % N], place);
        }
        Some(Self { ranks, n, best: best.cheapest()? })
    }
}

impl<const N: usize> Split for Sweep<N> {
    fn weight(&self) -> f32 {
        self.best.weight
    }

    fn greater(&self) -> usize {
        self.best.place.max(self.n - self.best.place)
    }

    /// Puts the items in order.
    fn part(&self, items: &mut [Item]) -> Cut {
        let Cheapest { axis, place: left, .. } = self.best;
        let mut sorted = [items[0]; N];
        for (item, ranks) in items.iter().zip(&self.ranks) {
            sorted[ranks[axis] as usize % N] = *item;
        }
        items.copy_from_slice(&sorted[..items.len()]);
        Cut { axis, left, extents: [Extents::of(&items[..left]), Extents::of(&items[left..])] }
    }
}

/// For each item how many come before it on each axis, equal centroids as they stand.
fn ranks<const N: usize>(items: &[Item]) -> [[u32; 3]; N] {
    // Each pair says which of the two comes later. Without a branch, for all axes at once.
    let mut centroids = [Vec3A::ZERO; N];
    let mut ranks = [Vec3A::ZERO; N];
    for (i, item) in items.iter().enumerate().take(N) {
        let centroid = item.centroid();
        // All pairs must agree, so a NaN is as good as 0.
        let centroid = Vec3A::select(centroid.cmpeq(centroid), centroid, Vec3A::ZERO);
        let mut rank = Vec3A::ZERO;
        for (earlier, earlier_rank) in centroids[..i].iter().zip(&mut ranks) {
            let is_later = earlier.cmple(centroid);
            rank += Vec3A::select(is_later, Vec3A::ONE, Vec3A::ZERO);
            *earlier_rank += Vec3A::select(is_later, Vec3A::ZERO, Vec3A::ONE);
        }
        (centroids[i], ranks[i]) = (centroid, rank);
    }
    ranks.map(|rank| indices(rounded(rank)))
}

/// The cheapest cut so far on each axis.
pub(super) struct Candidates {
    weights: Vec3A,
    places: Vec3A,
}

/// A cut of least weight.
pub(super) struct Cheapest {
    pub(super) axis: usize,
    pub(super) place: usize,
    /// Sum over both sides of half area times count.
    pub(super) weight: f32,
}

impl Candidates {
    pub(super) const NONE: Self = Self { weights: Vec3A::INFINITY, places: Vec3A::ZERO };

    /// The first of equals stays. No NaN is ever taken.
    #[inline]
    pub(super) fn offer(&mut self, weights: Vec3A, place: usize) {
        let is_less = weights.cmplt(self.weights);
        self.weights = Vec3A::select(is_less, weights, self.weights);
        self.places = Vec3A::select(is_less, Vec3A::splat(place as f32), self.places);
    }

    /// `None` where weights tell no cut from another: the least has overflowed, or underflowed.
    #[inline]
    pub(super) fn cheapest(self) -> Option<Cheapest> {
        let [x, y, z] = self.weights.to_array();
        let axis = if y < x {
            if z < y { 2 } else { 1 }
        } else if z < x {
            2
        } else {
            0
        };
        let weight = self.weights[axis];
        let is_told = (f32::MIN_POSITIVE..f32::INFINITY).contains(&weight);
        is_told.then(|| Cheapest { axis, place: self.places[axis] as usize, weight })
    }
}

#[inline]
pub(super) fn unions(a: [Spread; 3], b: [Spread; 3]) -> [Spread; 3] {
    [a[0].union(b[0]), a[1].union(b[1]), a[2].union(b[2])]
}

/// Half of the surface area of each.
#[inline]
pub(super) fn half_areas([a, b, c]: [Spread; 3]) -> Vec3A {
    let Mat3A { x_axis: x, y_axis: y, z_axis: z } = Mat3A::from_cols(a.extent(), b.extent(), c.extent()).transpose();
    (x + y) * z + x * y
}

/// 2^23 more than the nearest integers to numbers from 0 up to 2^23; greater for none that is less.
#[inline]
pub(super) fn rounded(numbers: Vec3A) -> Vec3A {
    numbers + 8_388_608.0
}

/// The integers of which [`rounded`] made these: from 2^23 on, the last bit of a float counts ones.
#[inline]
pub(super) fn indices(rounded: Vec3A) -> [u32; 3] {
    rounded.to_array().map(|number| number.to_bits() & 0x7f_ffff)
}

#[cfg(test)]
mod tests;
