//! Quotients of exact determinants, rounded once.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::Certainty;
use super::predicates::{Pairs, add_edge, minus};
use super::sum::{Sum, two_product};
use crate::geom::Real;

/// A ratio of two exact sums: t, u or v.
pub(super) struct Ratio {
    /// d . (e2 x e1).
    det: Sum<96>,
    /// The numerator.
    top: Sum<192>,
    d: DVec3,
    e1: Pairs,
    e2: Pairs,
}

/// Distance to a triangle that the line meets, rounded to the nearest float; `None` outside the closed interval.
#[cold]
#[inline(never)]
pub(super) fn distance(corners: &[DVec3; 3], o: DVec3, d: DVec3, interval: [f32; 2]) -> Option<f32> {
    let ratio = Ratio::distance(corners, o, d);
    let [tmin, tmax] = interval;
    let is_within =
        ratio.compare_wide(tmin.into()) >= 0 && (tmax == f32::INFINITY || ratio.compare_wide(tmax.into()) <= 0);
    is_within.then(|| ratio.nearest())
}

/// [`distance`] for numbers that are doubles, of which sums are exact, to the nearest number of any kind; open if sums
/// cannot tell. `[EXACT-3]` `[EXACT-8]` `[INST-5]`
#[cold]
#[inline(never)]
pub(super) fn distance_of_doubles<R: Real>(
    corners: &[DVec3; 3],
    o: DVec3,
    d: DVec3,
    [tmin, tmax]: [R; 2],
) -> Certainty<R> {
    let ratio = Ratio::distance(corners, o, d);
    let Some(t) = ratio.nearest_number() else { return Certainty::Open };
    // Rounding keeps the order, so that only an end that is equal leaves a question.
    let is_after = tmin < t || tmin == t && ratio.compare_double(t.into()) >= 0;
    let is_before = t < tmax || t == tmax && (t == R::INFINITY || ratio.compare_double(t.into()) <= 0);
    if is_after && is_before { Certainty::Hit(t) } else { Certainty::Miss }
}

/// [`weights`] for such numbers; `None` if sums cannot tell.
#[cold]
#[inline(never)]
pub(super) fn weights_of_doubles<R: Real>(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Option<[R; 2]> {
    let [u, v] = Ratio::weights(corners, o, d).map(|weight| weight.nearest_number());
    Some([u?, v?])
}

/// Weights of the second and third corner of a triangle that the line meets, rounded to the nearest floats.
#[cold]
#[inline(never)]
pub(super) fn weights(corners: [DVec3; 3], o: DVec3, d: DVec3) -> [f32; 2] {
    Ratio::weights(&corners, o, d).map(|weight| weight.nearest())
}

/// Ratios of sums are rounded to doubles within these bounds: there, nothing underflows.
const DOUBLES: RangeInclusive<f64> = f64::from_bits((1023 - 250) << 52)..=f64::from_bits((1023 + 250) << 52);

impl Ratio {
    /// The distance to the plane of a triangle that is not parallel to the line.
    pub(super) fn distance(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        let [a, b, c] = corners.map(|corner| minus(corner, o));
        Self::new(corners, d, |top| {
            // T = -A . (B x C).
            for k in 0..3 {
                for half in a[k].into_iter().filter(|&half| half != 0.0) {
                    let mut only = DVec3::ZERO;
                    only[k] = -half;
                    add_edge(top, only, &b, &c);
                }
            }
        })
    }

    /// The weights of the second and third corner.
    pub(super) fn weights(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> [Self; 2] {
        let [a, b, c] = corners.map(|corner| minus(corner, o));
        let u = Self::new(corners, d, |top| add_edge(top, d, &a, &c));
        let v = Self::new(corners, d, |top| add_edge(top, d, &b, &a));
        [u, v]
    }

    fn new(&[v0, v1, v2]: &[DVec3; 3], d: DVec3, add_top: impl FnOnce(&mut Sum<192>)) -> Self {
        let (mut det, mut top) = (Sum::new(), Sum::new());
        let (e1, e2) = (minus(v1, v0), minus(v2, v0));
        add_edge(&mut det, d, &e2, &e1);
        add_top(&mut top);
        Self { det, top, d, e1, e2 }
    }

    /// The ratio minus a number, times the determinant, with a relative error of at most 2^-50. `products` sum up to
    /// the number times d. `N` must be 192 and 96 for each of them.
    fn minus<const N: usize>(&self, products: &[DVec3]) -> f64 {
        let mut difference = Sum::<N>::new();
        difference.add_sum(&self.top);
        for &product in products {
            add_edge(&mut difference, -product, &self.e2, &self.e1);
        }
        difference.value()
    }

    /// The sign of the ratio, if `x` is a number with the sign of its numerator.
    fn sign(&self, x: f64) -> i32 {
        if x == 0.0 {
            0
        } else if x.is_sign_positive() == self.det.value().is_sign_positive() {
            1
        } else {
            -1
        }
    }

    /// The sign of the ratio minus `m`, which must have at most 25 bits: then its products with floats are exact.
    fn compare_wide(&self, m: f64) -> i32 {
        self.sign(self.minus::<288>(&[self.d * m]))
    }

    /// The nearest float, the even one of two.
    fn nearest(&self) -> f32 {
        let (top, det) = (self.top.value(), self.det.value());
        let t = top / det;
        // Both sums are off by 2^-50 at most, and the quotient by 2^-53 more.
        let error = t.abs() * 2f64.powi(-48);
        let [low, high] = [t - error, t + error].map(|t| t as f32);
        if low == high {
            // Not -0.
            return low + 0.0;
        }
        // Neighbours. Beyond the greatest float stands 2^128, as if there were another.
        let wide = |x: f32| if x.is_infinite() { 2f64.powi(128).copysign(x.into()) } else { f64::from(x) };
        match self.compare_wide(f64::midpoint(wide(low), wide(high))) {
            1 => high,
            -1 => low,
            _ => {
                if low.to_bits() & 1 == 0 {
                    low
                } else {
                    high
                }
            }
        }
    }

    /// The sign of the ratio minus a number that is 0 or within [`DOUBLES`].
    fn compare_double(&self, m: f64) -> i32 {
        self.sign(self.minus::<384>(&self.products(m)))
    }

    /// The nearest number of a kind, the even one of two. `None` where [`nearest_double`](Self::nearest_double) is, and where
    /// the ratio is all but in the middle of two floats of single precision.
    fn nearest_number<R: Real>(&self) -> Option<R> {
        let t = self.top.value() / self.det.value();
        let error = t.abs() * 2f64.powi(-48);
        if DOUBLES.contains(&t.abs())
            && let Some(t) = R::between([t - error, t + error].map(|end| [end, 0.0]))
        {
            return Some(t);
        }
        let t = self.nearest_double()?;
        let number = R::rounded(t);
        if number.into() == t {
            return Some(number);
        }
        // What rounding to a double left out has the sign of this.
        R::between([[t, self.compare_double(t).into()]; 2])
    }

    /// The nearest double, the even one of two. `None` if the ratio is neither 0 nor within [`DOUBLES`].
    ///
    /// Sums of products of the ray's and the triangle's numbers must be exact. `[EXACT-8]`
    fn nearest_double(&self) -> Option<f64> {
        let (top, det) = (self.top.value(), self.det.value());
        if top == 0.0 {
            return Some(0.0);
        }
        let first = top / det;
        if !DOUBLES.contains(&first.abs()) {
            return None;
        }
        // What the first quotient left, off by 2^-50 for the numerator and for the determinant, and by 2^-53.
        let rest = self.minus::<384>(&self.products(first)) / det;
        let error = rest.abs() * 2f64.powi(-47);
        let [low, high] = [rest - error, rest + error].map(|rest| first + rest);
        if low == high {
            return Some(low);
        }
        // Neighbours, with the middle between them in two numbers.
        let ([a, b], [c, d]) = (self.products(low), self.products(high * 0.5 - low * 0.5));
        Some(match self.sign(self.minus::<576>(&[a, b, c, d])) {
            1 => high,
            0 if low.to_bits() & 1 == 1 => high,
            _ => low,
        })
    }

    /// The direction times `m`, as two vectors.
    fn products(&self, m: f64) -> [DVec3; 2] {
        let [x, y, z] = self.d.to_array().map(|d| two_product(d, m));
        [DVec3::new(x.0, y.0, z.0), DVec3::new(x.1, y.1, z.1)]
    }
}

#[cfg(test)]
mod tests;
