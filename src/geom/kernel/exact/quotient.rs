//! Quotients of exact determinants, rounded once.

use glam::DVec3;

use super::predicates::{Pairs, add_edge, minus};
use super::sum::Sum;

/// A ratio of two exact sums: t, u or v.
struct Ratio {
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
pub(super) fn distance(corners: &[DVec3; 3], o: DVec3, d: DVec3, [tmin, tmax]: [f32; 2]) -> Option<f32> {
    let [a, b, c] = corners.map(|corner| minus(corner, o));
    let ratio = Ratio::new(corners, d, |top| {
        // T = -A . (B x C).
        for k in 0..3 {
            for half in a[k].into_iter().filter(|&half| half != 0.0) {
                let mut only = DVec3::ZERO;
                only[k] = -half;
                add_edge(top, only, &b, &c);
            }
        }
    });
    let is_within = ratio.compare(tmin) >= 0 && ratio.compare(tmax) <= 0;
    is_within.then(|| ratio.nearest())
}

/// Weights of the second and third corner of a triangle that the line meets, rounded to the nearest floats.
#[cold]
#[inline(never)]
pub(super) fn weights(corners: [DVec3; 3], o: DVec3, d: DVec3) -> [f32; 2] {
    let [a, b, c] = corners.map(|corner| minus(corner, o));
    let u = Ratio::new(&corners, d, |top| add_edge(top, d, &a, &c));
    let v = Ratio::new(&corners, d, |top| add_edge(top, d, &b, &a));
    [u.nearest(), v.nearest()]
}

impl Ratio {
    fn new(&[v0, v1, v2]: &[DVec3; 3], d: DVec3, add_top: impl FnOnce(&mut Sum<192>)) -> Self {
        let (mut det, mut top) = (Sum::new(), Sum::new());
        let (e1, e2) = (minus(v1, v0), minus(v2, v0));
        add_edge(&mut det, d, &e2, &e1);
        add_top(&mut top);
        Self { det, top, d, e1, e2 }
    }

    /// The sign of the ratio minus `m`, which must have at most 25 bits: then its products with floats are exact.
    fn compare_wide(&self, m: f64) -> i32 {
        let mut difference = Sum::<288>::new();
        difference.add_sum(&self.top);
        add_edge(&mut difference, -self.d * m, &self.e2, &self.e1);
        let (a, b) = (difference.value(), self.det.value());
        if a == 0.0 {
            0
        } else if (a > 0.0) == (b > 0.0) {
            1
        } else {
            -1
        }
    }

    fn compare(&self, x: f32) -> i32 {
        if x == f32::INFINITY { -1 } else { self.compare_wide(x.into()) }
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
}
