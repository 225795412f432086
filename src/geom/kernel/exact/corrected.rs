//! Quotients of one double, corrected by what they leave. `[EXACT-14]`
//!
//! The distance of a certain hit is q + n . (s + q d) / det for any number q, exactly. With q the quotient of the filter,
//! the second term is some last places of it, so that a few digits of twice the precision tell what the sum rounds to.

use glam::DVec3;

use super::filter::{Determinants, Errors};
use super::{two_product, two_sum};
use crate::geom::frame::power_of_two;

/// The certain hit of a line and a triangle. `[EXACT-6]`
#[derive(Clone, Copy, Debug)]
pub(super) struct CertainHit {
    found: Determinants,
    errors: Errors,
    d: DVec3,
    s: Pair,
    e1: Pair,
    e2: Pair,
    /// The greatest components of d, s, and e1 and e2.
    sizes: [f64; 3],
}

/// The sum of two vectors, of which the second is what rounding left out of the first.
type Pair = [[f64; 3]; 2];

/// What a numerator may be off by: times E E (C + |q| D) for a distance, and D E (C + |q| D + E) for weights. This is 512 u².
const ERROR: f64 = power_of_two(9 - 106);

/// Numbers of which no product under- or overflows.
const ROOM: [f64; 2] = [power_of_two(-100), power_of_two(100)];

impl CertainHit {
    /// Of these corners, by the determinants and their errors; `None` if it is not certain.
    #[inline]
    pub(super) fn new(
        &[v0, v1, v2]: &[DVec3; 3],
        o: DVec3,
        d: DVec3,
        found: &Determinants,
        errors: &Errors,
    ) -> Option<Self> {
        if !found.is_hit(errors) {
            return None;
        }
        let (s, e1, e2) = (difference(o, v0), difference(v1, v0), difference(v2, v0));
        let sizes = [d.abs().max_element(), greatest(&s), greatest(&e1).max(greatest(&e2))];
        Some(Self { found: *found, errors: *errors, d, s, e1, e2, sizes })
    }

    /// The distance, rounded to the nearest double, if that is certain.
    #[inline]
    pub(super) fn distance(&self) -> Option<f64> {
        let ([_, _, e], [q, ..]) = (self.sizes, self.found.quotients());
        let far = self.far(q)?;
        self.corrected(q, volume(&self.e1, &self.e2, &self.at(q)), e * e * far)
    }

    /// The weights of the second and the third corner, likewise.
    #[inline]
    pub(super) fn weights(&self) -> Option<[f64; 2]> {
        let ([length, _, e], [q, u, v]) = (self.sizes, self.found.quotients());
        let (far, at, d) = (self.far(q)?, self.at(q), [self.d.to_array(), [0.0; 3]]);
        let size = length * e * (far + e);
        let u = self.corrected(u, volume(&d, &self.e2, &along(&at, -u, &self.e1)), size)?;
        Some([u, self.corrected(v, volume(&self.e1, &d, &along(&at, -v, &self.e2)), size)?])
    }

    /// No component of s + q d is greater, nor of what it is made of; `None` if a number has no room.
    #[inline]
    fn far(&self, q: f64) -> Option<f64> {
        let [length, c, e] = self.sizes;
        let far = length * q.abs() + c;
        let [least, most] = ROOM;
        [length, far, e].iter().all(|x| (least..=most).contains(x)).then_some(far)
    }

    /// s + q d.
    #[inline]
    fn at(&self, q: f64) -> Pair {
        along(&self.s, q, &[self.d.to_array(), [0.0; 3]])
    }

    /// A quotient and what it leaves over the determinant, rounded to the nearest double, if that is certain.
    #[inline]
    fn corrected(&self, quotient: f64, left: f64, size: f64) -> Option<f64> {
        let error = ERROR * size + left.abs() * f64::EPSILON;
        let [lo, hi] = self.found.over(left, error, &self.errors).map(|x| quotient + x);
        (lo == hi).then_some(lo + 0.0)
    }
}

/// a - b, exactly.
#[inline]
fn difference(a: DVec3, b: DVec3) -> Pair {
    let (x, y, z) = (two_sum(a.x, -b.x), two_sum(a.y, -b.y), two_sum(a.z, -b.z));
    [[x.0, y.0, z.0], [x.1, y.1, z.1]]
}

#[inline]
fn greatest(&[[x, y, z], _]: &Pair) -> f64 {
    x.abs().max(y.abs()).max(z.abs())
}

/// s + q d.
#[inline]
fn along(s: &Pair, q: f64, d: &Pair) -> Pair {
    let mut sum = [[0.0; 3]; 2];
    for k in 0..3 {
        let (product, rest) = two_product(q, d[0][k]);
        let (high, low) = two_sum(s[0][k], product);
        (sum[0][k], sum[1][k]) = two_sum(high, low + (s[1][k] + (rest + q * d[1][k])));
    }
    sum
}

/// (a x b) . r.
#[inline]
fn volume(a: &Pair, b: &Pair, r: &Pair) -> f64 {
    let (mut sum, mut low) = (0.0, 0.0);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let ((plus, over), (minus, under)) = (two_product(a[0][i], b[0][j]), two_product(a[0][j], b[0][i]));
        let (high, rest) = two_sum(plus, -minus);
        let cross = (a[0][i] * b[1][j] + a[1][i] * b[0][j]) - (a[0][j] * b[1][i] + a[1][j] * b[0][i]);
        let (n, left) = two_sum(high, rest + (over - under) + cross);
        let (product, under) = two_product(n, r[0][k]);
        let (next, rest) = two_sum(sum, product);
        sum = next;
        low += rest + under + (n * r[1][k] + left * r[0][k]);
    }
    sum + low
}

#[cfg(test)]
mod tests;
