//! The point of a certain hit by doubles, corrected by their residual. `[EXACT-14]`
//!
//! For any numbers t, u and v, the difference of the true numbers from them is the solution for the residual r = s + t
//! d - u e1 - v e2 in place of s, exactly. For the results of doubles, r is nearly 0, so doubles suffice for the
//! correction. (Iterative refinement: Wilkinson 1963, "Rounding errors in algebraic processes".)

use glam::DVec3;

use super::filter::{Errors, USUAL};
use super::{two_product, two_sum};
use crate::geom::frame::power_of_two;

/// Bounds of the error of a product with the residual, times E E for the distance and D E for the weights: the first is
/// relative to the residual, the second to the distance of the hit.
const OFF: [f64; 2] = [64.0 * power_of_two(-53), 384.0 * power_of_two(-106)];

/// Distance and weights of a line that certainly meets a triangle; each is present if its rounding is certain.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::geom) struct Corrected {
    pub(in crate::geom) t: Option<f64>,
    pub(in crate::geom) weights: Option<[f64; 2]>,
}

impl Corrected {
    /// Computes them for a certain hit. `[EXACT-6]` `FUSED` if a multiplication and an addition are one instruction.
    #[inline(always)]
    pub(in crate::geom) fn of<const FUSED: bool>(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        let ([s, s_rest], [e1, e1_rest], [e2, e2_rest]) = (apart(o, v0), apart(v1, v0), apart(v2, v0));
        let (n, p, m) = (e1.cross(e2), d.cross(e2), e1.cross(d));
        let det = e1.dot(p);
        let [t, u, v] = [s.dot(n) / det, s.dot(p) / det, s.dot(m) / det];
        let [length, c, e] = [d.abs(), s.abs(), e1.abs().max(e2.abs())].map(DVec3::max_element);
        let far = c + t.abs() * length + (u.abs() + v.abs()) * e;
        // False for a NaN.
        if !(length.min(far).min(e) >= *USUAL.start() && length.max(far).max(e) <= *USUAL.end()) {
            return Self::default();
        }
        let residual = |k: usize| {
            let ((td, td_rest), (ue, ue_rest), (ve, ve_rest)) =
                (product::<FUSED>(t, d[k]), product::<FUSED>(u, e1[k]), product::<FUSED>(v, e2[k]));
            let (sum, rest_1) = two_sum(s[k], td);
            let (sum, rest_2) = two_sum(sum, -ue);
            let (sum, rest_3) = two_sum(sum, -ve);
            let of_products = (td_rest - ue_rest) - ve_rest;
            let of_edges = u * e1_rest[k] + v * e2_rest[k];
            sum + (((rest_1 + rest_2) + (rest_3 + s_rest[k])) + (of_products - of_edges))
        };
        let r = DVec3::new(residual(0), residual(1), residual(2));
        let off = r.abs().max_element() * OFF[0] + far * OFF[1];
        let errors = Errors::new([length, c, e]);
        let corrected = |quotient: f64, left: f64, size: f64| {
            let [lo, hi] = errors.over(left, off * size, det).map(|x| quotient + x);
            (lo == hi).then_some(lo + 0.0)
        };
        let (u, v) = (corrected(u, r.dot(p), length * e), corrected(v, r.dot(m), length * e));
        Self { t: corrected(t, r.dot(n), e * e), weights: u.zip(v).map(<[f64; 2]>::from) }
    }
}

/// Returns a - b, exactly: the rounded difference, and its rounding error.
#[inline(always)]
fn apart(a: DVec3, b: DVec3) -> [DVec3; 2] {
    let (x, y, z) = (two_sum(a.x, -b.x), two_sum(a.y, -b.y), two_sum(a.z, -b.z));
    [DVec3::new(x.0, y.0, z.0), DVec3::new(x.1, y.1, z.1)]
}

/// Returns the rounded product, and its rounding error.
#[inline(always)]
fn product<const FUSED: bool>(a: f64, b: f64) -> (f64, f64) {
    if FUSED {
        let product = a * b;
        (product, a.mul_add(b, -product))
    } else {
        two_product(a, b)
    }
}

#[cfg(test)]
mod tests;
