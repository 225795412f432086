//! The stage of double precision.

use glam::DVec3;

use super::super::{DETERMINANT, DISTANCE, EDGE, QUOTIENT, QUOTIENT_FACTOR};

/// Half of the distance from 1 to the next double.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// The determinants of a ray and a triangle.
///
/// For inputs that are floats, nothing over- or underflows: every product that is not 0 lies between 2^-447 and 2^390.
#[derive(Clone, Copy, Debug)]
pub(super) struct Determinants {
    det: f64,
    edges: [f64; 3],
    t: f64,
    e1: DVec3,
    e2: DVec3,
    s: DVec3,
}

/// Bounds of the errors of [`Determinants`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    det: f64,
    edge: f64,
    t: f64,
}

/// A distance, as far as it is known.
pub(super) enum Distance {
    /// The nearest float; the distance is within the interval.
    Nearest(f32),
    /// Outside the interval, or above the limit.
    Outside,
    /// Too close to tell: to an end of the interval, or to the middle between two floats.
    Unknown,
}

impl Determinants {
    #[inline(always)]
    pub(super) fn of(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
        let (p, q) = (d.cross(e2), s.cross(e1));
        let (det, u, v) = (e1.dot(p), s.dot(p), d.dot(q));
        Self { det, edges: [u, v, (det - u) - v], t: e2.dot(q), e1, e2, s }
    }

    /// Whether an edge function has another sign than the determinant and is beyond `bound`.
    ///
    /// That means a miss if `bound` is at least the sum of the errors of an edge function and of the determinant: if the
    /// sign of the determinant is right, because the edge's is; and if not, because the determinant is then smaller than
    /// its error, and in a hit no edge function is greater than it.
    #[inline(always)]
    pub(super) fn differ_in_sign(&self, bound: f64) -> bool {
        let [u, v, w] = self.edges.map(|edge| self.front(edge));
        !(u >= -bound && v >= -bound && w >= -bound)
    }

    /// A number with the sign that it has if the determinant is positive.
    #[inline(always)]
    fn front(&self, x: f64) -> f64 {
        f64::from_bits(x.to_bits() ^ self.det.to_bits() & 1 << 63)
    }

    /// What the determinants may be off by; `d` is the greatest component of the direction.
    #[inline(always)]
    pub(super) fn errors(&self, d: f64) -> Errors {
        let (c, e) = (greatest(self.s.abs()), greater(greatest(self.e1.abs()), greatest(self.e2.abs())));
        Errors {
            edge: f64::from(EDGE) * UNIT * d * e * (2.0 * c + e),
            det: f64::from(DETERMINANT) * UNIT * d * e * e,
            t: f64::from(DISTANCE) * UNIT * c * e * e,
        }
    }

    /// Whether the line meets the closed triangle, if that is certain.
    #[inline(always)]
    pub(super) fn is_inside(&self, errors: &Errors) -> Option<bool> {
        let [u, v, w] = self.edges;
        let (least, greatest) = (lesser(lesser(u, v), w), greater(greater(u, v), w));
        // The exact edge functions sum up to the determinant, so it has their sign if they have one.
        if least > errors.edge || greatest < -errors.edge {
            Some(true)
        } else if least < -errors.edge && greatest > errors.edge {
            Some(false)
        } else {
            None
        }
    }

    /// Bounds of the distance, if they are close. `[EXACT-5]`
    #[inline(always)]
    fn bounds(&self, errors: &Errors) -> Option<[f64; 2]> {
        let reciprocal = self.det.recip();
        let t = self.t * reciprocal;
        let error = (errors.t + t.abs() * errors.det) * reciprocal.abs() * QUOTIENT_FACTOR
            + t.abs() * (f64::from(QUOTIENT) * UNIT);
        // False for a NaN.
        let is_small = errors.det < self.det.abs() * (1.0 / 64.0);
        is_small.then_some([t - error, t + error])
    }

    /// The distance of a ray whose line meets the triangle.
    #[inline(always)]
    pub(super) fn distance(&self, errors: &Errors, [tmin, tmax]: [f32; 2], limit: f32) -> Distance {
        let Some([least, most]) = self.bounds(errors) else { return Distance::Unknown };
        let [near, far] = [least as f32, most as f32];
        if most < f64::from(tmin) || f64::from(tmax) < least || limit < near {
            Distance::Outside
        } else if near == far && f64::from(tmin) <= least && most <= f64::from(tmax) {
            Distance::Nearest(near)
        } else {
            Distance::Unknown
        }
    }

    /// Whether the distance is within an interval, if that is certain.
    #[inline(always)]
    pub(super) fn is_within(&self, errors: &Errors, [tmin, tmax]: [f32; 2]) -> Option<bool> {
        let [least, most] = self.bounds(errors)?;
        if most < f64::from(tmin) || f64::from(tmax) < least {
            Some(false)
        } else {
            (f64::from(tmin) <= least && most <= f64::from(tmax)).then_some(true)
        }
    }
}

#[inline(always)]
fn greatest(v: DVec3) -> f64 {
    greater(greater(v.x, v.y), v.z)
}

/// The lesser of two numbers, in one instruction: none is a NaN here.
#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers.
#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
