//! Determinants in twice the precision of doubles, with bounds of their errors. `[EXACT-10]`
//!
//! A double holds no more digits than the quotient of the filter, whose bounds therefore hardly ever round alike. These
//! nearly always do, at a fraction of the cost of exact sums.

use std::ops::{Add, Mul, Sub};

use glam::DVec3;

use super::double::USUAL;
use super::predicates::{Pairs, minus};
use super::sum::{two_product, two_sum};

/// The sum of two doubles of which the second is at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug)]
struct Twofold {
    high: f64,
    low: f64,
}

/// Bound of the error of a determinant, in units of the product of its sizes: 2^-98, 256 units of 2^-106.
const ERROR: f64 = f64::from_bits((1023 - 98) << 52);

/// The same of a quotient beside that: of the products and the difference that it takes.
const REST: f64 = f64::from_bits((1023 - 100) << 52);

/// The ray and the triangle, as differences without rounding.
pub(super) struct Twofolds {
    d: [Twofold; 3],
    s: [Twofold; 3],
    e1: [Twofold; 3],
    e2: [Twofold; 3],
    /// Greatest components of d, s, and e1 and e2.
    sizes: [f64; 3],
    det: Twofold,
}

impl Twofolds {
    /// `None` where the greatest components are not within 2^-200 to 2^200.
    pub(super) fn new(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> Option<Self> {
        let [s, e1, e2] = [minus(o, v0), minus(v1, v0), minus(v2, v0)].map(twofolds);
        let d = d.to_array().map(Twofold::from);
        let sizes = [greatest(&d), greatest(&s), greatest(&e1).max(greatest(&e2))];
        if !sizes.iter().all(|size| USUAL.contains(size)) {
            return None;
        }
        let det = dot(&e1, &cross(&d, &e2));
        Some(Self { d, s, e1, e2, sizes, det })
    }

    /// The distance, rounded to the nearest double, if that is certain. The line must certainly meet the triangle.
    pub(super) fn distance(&self) -> Option<f64> {
        let [_, c, e] = self.sizes;
        self.nearest(dot(&self.e2, &cross(&self.s, &self.e1)), c * e * e)
    }

    /// The weights of the second and the third corner, likewise.
    pub(super) fn weights(&self) -> Option<[f64; 2]> {
        let [d, c, e] = self.sizes;
        let u = dot(&self.s, &cross(&self.d, &self.e2));
        let v = dot(&self.d, &cross(&self.s, &self.e1));
        Some([self.nearest(u, d * c * e)?, self.nearest(v, d * c * e)?])
    }

    /// A determinant of the given size over the one of the triangle, rounded to the nearest double, if that is certain.
    fn nearest(&self, top: Twofold, size: f64) -> Option<f64> {
        let (det, [d, _, e]) = (self.det, self.sizes);
        let first = top.high / det.high;
        if !super::quotient::DOUBLES.contains(&first.abs()) {
            return None;
        }
        let left = top - det * Twofold::from(first);
        let rest = (left.high + left.low) / det.high;
        let off = ERROR * size + first.abs() * (ERROR * (d * e * e)) + REST * top.high.abs();
        // Twice, for the roundings of the bound itself and for the error of the denominator.
        let error = 2.0 * (off / det.high.abs()) + rest.abs() * 2f64.powi(-49);
        let [low, high] = [rest - error, rest + error].map(|rest| first + rest);
        (low == high).then_some(low)
    }
}

impl From<f64> for Twofold {
    fn from(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }
}

impl Mul for Twofold {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (product, rest) = two_product(self.high, other.high);
        joined(product, rest + (self.high * other.low + self.low * other.high))
    }
}

impl Add for Twofold {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (sum, rest) = two_sum(self.high, other.high);
        joined(sum, rest + (self.low + other.low))
    }
}

impl Sub for Twofold {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

/// A sum whose second number is the smaller one.
#[inline]
fn joined(a: f64, b: f64) -> Twofold {
    let high = a + b;
    Twofold { high, low: b - (high - a) }
}

fn twofolds(pairs: Pairs) -> [Twofold; 3] {
    pairs.map(|[high, low]| Twofold { high, low })
}

fn greatest(v: &[Twofold; 3]) -> f64 {
    v.iter().fold(0.0, |size, x| x.high.abs().max(size))
}

#[inline]
fn dot(a: &[Twofold; 3], b: &[Twofold; 3]) -> Twofold {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross(a: &[Twofold; 3], b: &[Twofold; 3]) -> [Twofold; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests;
