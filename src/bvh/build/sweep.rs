//! The surface area heuristic, evaluated between any two centroids: for few items.

use glam::{Mat3A, Vec3A};

use super::item::{Extents, Item, Spread};
use super::top_down::Cut;

/// Items that a sweep may have. For so few it is faster than bins.
pub(super) const MAX: usize = 16;

/// The cheapest cut of at most [`MAX`] items.
pub(super) struct Sweep {
    /// For each axis the items by their centroids.
    order: [[u8; MAX]; 3],
    best: Cheapest,
}

impl Sweep {
    /// `None` if no cut has a finite cost.
    pub(super) fn new(items: &[Item]) -> Option<Self> {
        let n = items.len().min(MAX);
        let order = order(items);
        let mut boxes = [Spread::EMPTY; MAX];
        for (aabb, item) in boxes.iter_mut().zip(items) {
            *aabb = item.spread();
        }
        let sorted = |place: usize| [0, 1, 2].map(|axis: usize| boxes[usize::from(order[axis][place]) % MAX]);
        let mut right = [Spread::EMPTY; 3];
        let mut right_weights = [Vec3A::ZERO; MAX];
        for place in (1..n).rev() {
            right = unions(right, sorted(place));
            right_weights[place % MAX] = half_areas(right) * (n - place) as f32;
        }
        let mut left = [Spread::EMPTY; 3];
        let mut best = Candidates::NONE;
        for place in 1..n {
            left = unions(left, sorted(place - 1));
            best.offer(half_areas(left) * place as f32 + right_weights[place % MAX], place);
        }
        Some(Self { order, best: best.cheapest()? })
    }

    /// Sum over both sides of half area times count.
    pub(super) fn weight(&self) -> f32 {
        self.best.weight
    }

    /// Items on the side that has more.
    pub(super) fn greater(&self, n: usize) -> usize {
        self.best.place.max(n - self.best.place)
    }

    /// Puts the items, which must be the same, in order.
    pub(super) fn part(&self, items: &mut [Item]) -> Cut {
        let Cheapest { axis, place: left, .. } = self.best;
        let mut before = [items[0]; MAX];
        before[..items.len()].copy_from_slice(items);
        for (item, &from) in items.iter_mut().zip(&self.order[axis]) {
            *item = before[usize::from(from) % MAX];
        }
        Cut { axis, left, extents: [Extents::of(&items[..left]), Extents::of(&items[left..])] }
    }
}

/// For each axis the items by their centroids, equal ones as they stand.
fn order(items: &[Item]) -> [[u8; MAX]; 3] {
    // Each pair says which of the two comes later. Without a branch, for all axes at once.
    let mut centroids = [Vec3A::ZERO; MAX];
    let mut ranks = [Vec3A::ZERO; MAX];
    for (i, item) in items.iter().enumerate().take(MAX) {
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
    let mut order = [[0; MAX]; 3];
    for (i, rank) in ranks[..items.len().min(MAX)].iter().enumerate() {
        for (order, place) in order.iter_mut().zip(indices(rounded(*rank))) {
            order[place as usize % MAX] = i as u8;
        }
    }
    order
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

    #[inline]
    pub(super) fn cheapest(self) -> Option<Cheapest> {
        let [x, y, z] = self.weights.to_array();
        let axis = if y < x { if z < y { 2 } else { 1 } } else if z < x { 2 } else { 0 };
        let weight = self.weights[axis];
        (weight < f32::INFINITY).then(|| Cheapest { axis, place: self.places[axis] as usize, weight })
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
