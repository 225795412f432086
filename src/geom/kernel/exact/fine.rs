//! Signs, distances and weights in twice the digits of a double. `[EXACT-10]`
//!
//! A double has no more digits than the quotient of the filter, so the filter's bounds rarely round to one number. The
//! bounds here nearly always do, at a fraction of the cost of exact sums. They also determine signs that the filter
//! leaves open: of distant rays, and of rays nearly in the plane of a triangle.

use std::cmp::Ordering;
use std::ops::Add as _;

use glam::DVec3;

use super::Certainty;
use super::filter::{Determinants, Errors, USUAL, has_usual_edges};
use super::sum::Pairs;
use crate::geom::Real;
use crate::geom::fine::{Fine, shortened};
use crate::geom::frame::power_of_two;

/// The determinants of a ray and a triangle, by twice the digits.
pub(in crate::geom) struct FineDeterminants {
    d: [Fine; 3],
    s: [Fine; 3],
    e1: [Fine; 3],
    e2: [Fine; 3],
    det: Fine,
}

impl FineDeterminants {
    /// Computes them. No component of the direction, and none of a corner relative to the origin, may be above 2^200.
    pub(super) fn new(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        Self::of(&corners.map(exact), o, d)
    }

    /// Computes them for corners that are known within bounds; `None` if a number is above 2^200. `[INST-5]`
    pub(in crate::geom) fn within_range(corners: &[[Fine; 3]; 3], o: DVec3, d: DVec3) -> Option<Self> {
        let most = power_of_two(200);
        let is_small = o.abs().max_element() <= most && d.abs().max_element() <= most;
        (is_small && corners.as_flattened().iter().all(|x| x.is_within(most))).then(|| Self::of(corners, o, d))
    }

    fn of([v0, v1, v2]: &[[Fine; 3]; 3], o: DVec3, d: DVec3) -> Self {
        let [d, o] = [d, o].map(exact);
        let (s, e1, e2) = (minus(&o, v0), minus(v1, v0), minus(v2, v0));
        Self { det: dot(&e1, &cross(&d, &e2)), d, s, e1, e2 }
    }

    /// Returns the distance to the triangle, rounded to the nearest float, if it is in an interval, not at an end.
    /// Corners and origin must be those of the constructor. `[INST-5]`
    pub(in crate::geom) fn met<R: Real>(
        &self,
        corners: &[[Fine; 3]; 3],
        o: DVec3,
        interval @ [tmin, tmax]: [R; 2],
    ) -> Certainty<R> {
        match self.meets(corners, o) {
            Some(true) => match self.distance_within(interval) {
                Some(t) => Certainty::Hit(t),
                None if self.distance().is_some_and(|t: R| t < tmin || tmax < t) => Certainty::Miss,
                None => Certainty::Open,
            },
            Some(false) => Certainty::Miss,
            None => Certainty::Open,
        }
    }

    /// Returns whether the line meets the triangle. `None` if the signs are undecided.
    fn meets(&self, corners: &[[Fine; 3]; 3], o: DVec3) -> Option<bool> {
        let (u, v) = (self.second(), self.third());
        let signs = [u, v, self.det - u - v, self.det].map(Fine::sign);
        let is_any = |is: fn(&f64) -> bool| signs.iter().flatten().any(is);
        if is_any(|&sign| sign > 0.0) && is_any(|&sign| sign < 0.0) {
            return Some(false);
        }
        // A corner that is known exactly may be on the line.
        let is_on_line = |corner| cross(&self.d, &minus(corner, &exact(o))).iter().all(|x| x.sign() == Some(0.0));
        let [edges @ .., det] = signs;
        let is_on = edges.iter().all(Option::is_some) || corners.iter().any(is_on_line);
        (is_on && det.is_some_and(|det| det != 0.0)).then_some(true)
    }

    /// Returns the distance, rounded to the nearest float, if that is certain and is in an interval, not at an end.
    /// Rounding keeps the order, so only an equal end leaves the result open.
    fn distance_within<R: Real>(&self, [tmin, tmax]: [R; 2]) -> Option<R> {
        self.distance().filter(|t| tmin < *t && *t < tmax)
    }

    fn distance<R: Real>(&self) -> Option<R> {
        self.nearest(self.top())
    }

    /// Returns the distance times the determinant.
    fn top(&self) -> Fine {
        dot(&self.e2, &cross(&self.s, &self.e1))
    }

    /// Returns the distance of a line that meets the triangle, rounded to the nearest float: a miss if it is not in the
    /// closed interval. `[EXACT-10]`
    pub(super) fn placed<R: Real>(&self, interval @ [tmin, tmax]: [R; 2]) -> Certainty<R> {
        match self.distance::<R>() {
            Some(t) if tmin < t && (t < tmax || tmax == R::INFINITY) => Certainty::Hit(t),
            Some(t) if t < tmin || tmax < t => Certainty::Miss,
            _ => {
                let Some(t) = self.double_distance() else { return Certainty::Open };
                let [tmin, tmax] = interval.map(R::into);
                if tmin <= t && t <= tmax { Certainty::Hit(R::rounded(t + 0.0)) } else { Certainty::Miss }
            }
        }
    }

    /// Returns the distance, if it is a double: this decides the middle of two floats and the ends of intervals.
    fn double_distance(&self) -> Option<f64> {
        let top = self.top();
        let t = top.middle() / self.det.middle();
        ((Fine::exact(t) * self.det - top).sign() == Some(0.0)).then_some(t)
    }

    /// Compares the distance with that to another triangle, if twice the digits decide. `[EXACT-13]`
    pub(in crate::geom) fn compare_distance(&self, other: &Self) -> Option<Ordering> {
        self.compare_quotient([other.top(), other.det])
    }

    /// Compares the distance with a number, if twice the digits decide.
    pub(in crate::geom) fn compare_distance_with(&self, t: Fine) -> Option<Ordering> {
        self.compare_quotient([t, Fine::exact(1.0)])
    }

    /// Multiplies crosswise. Over- or underflow leaves the sign open.
    fn compare_quotient(&self, [top, det]: [Fine; 2]) -> Option<Ordering> {
        let apart = (self.top() * det - top * self.det).sign()?;
        let is_turned = (self.det.sign()? < 0.0) != (det.sign()? < 0.0);
        if is_turned { 0.0.partial_cmp(&apart) } else { apart.partial_cmp(&0.0) }
    }

    /// Returns the weights of the second and the third corner, if twice the digits decide.
    pub(in crate::geom) fn weights<R: Real>(&self) -> Option<[R; 2]> {
        let u = self.nearest(self.second())?;
        Some([u, self.nearest(self.third())?])
    }

    /// Returns the weight of the second corner times the determinant.
    fn second(&self) -> Fine {
        dot(&self.s, &cross(&self.d, &self.e2))
    }

    /// Returns the weight of the third corner times the determinant.
    fn third(&self) -> Fine {
        dot(&self.d, &cross(&self.s, &self.e1))
    }

    fn nearest<R: Real>(&self, top: Fine) -> Option<R> {
        R::between(top.over(self.det)?.bounds())
    }
}

/// Returns the weights of the second and the third corner, rounded to the nearest floats, if they are certain. No
/// number may be above 2^200.
pub(super) fn weights<R: Real>(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Option<[R; 2]> {
    let found = FineDeterminants::new(corners, o, d);
    let found = if is_far(corners, o) { FineDeterminants { s: shortened(found.s, d).0, ..found } } else { found };
    found.weights()
}

/// A point of a line, with an error bound on each axis.
pub(super) struct NearPoint {
    point: DVec3,
    off: f64,
}

/// Returns a point of the line near to a triangle, if the line starts far away. No number may be above 2^200.
/// `[EXACT-12]`
pub(super) fn near_point(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Option<NearPoint> {
    is_far(corners, o).then(|| {
        let corner = exact(corners[0]);
        let (way, _) = shortened(minus(&exact(o), &corner), d);
        let near = [0, 1, 2].map(|k| corner[k] + way[k]);
        let off = near.iter().map(Fine::off_middle).fold(0.0, f64::max);
        NearPoint { point: DVec3::from(near.map(Fine::middle)), off }
    })
}

impl NearPoint {
    /// Returns whether the line meets the triangle, if the bounds of a ray from the near point decide. `[INST-5]`
    pub(super) fn is_inside(&self, corners: &[DVec3; 3], d: DVec3) -> Option<bool> {
        let found = Determinants::of(corners, self.point, d);
        let errors = Errors::of_triangle_within([self.off, 0.0], corners, self.point, d);
        // Bounds that are not finite leave it open.
        let is_known = has_usual_edges(corners) && USUAL.end() > &self.off;
        if is_known && found.is_miss(&errors) {
            Some(false)
        } else if is_known && found.is_hit(&errors) {
            Some(true)
        } else {
            None
        }
    }
}

/// Returns whether the distance of a triangle exceeds its edges so much that many of twice the digits cancel.
fn is_far(&[v0, v1, v2]: &[DVec3; 3], o: DVec3) -> bool {
    let edges = (v1 - v0).abs().max((v2 - v0).abs());
    (o - v0).abs().max_element() > edges.max_element() * FAR
}

/// Number of edge lengths from which on a distance is far.
pub(super) const FAR: f64 = power_of_two(32);

/// Returns a number with the sign of d . (a x b), if that is certain. No number may be above 2^200.
pub(super) fn volume(d: DVec3, a: &Pairs, b: &Pairs) -> Option<f64> {
    let [a, b] = [a, b].map(|v| v.map(Fine::of_two));
    // Often d is along an axis.
    let terms = (0..3).filter(|&k| d[k] != 0.0).map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Fine::exact(d[k]) * (a[i] * b[j] - a[j] * b[i])
    });
    terms.fold(Fine::ZERO, Fine::add).sign()
}

/// Computes [`volume`] for a vector b from a far point of a line with the direction d to an edge a. It uses a near
/// point of the line, since d . (a x (b - x d)) is d . (a x b) for any x. `[EXACT-12]`
pub(super) fn volume_from_near(d: DVec3, a: &Pairs, b: &Pairs) -> Option<f64> {
    let [a, b] = [a, b].map(|v| v.map(Fine::of_two));
    dot(&exact(d), &cross(&a, &shortened(b, d).0)).sign()
}

fn exact(v: DVec3) -> [Fine; 3] {
    v.to_array().map(Fine::exact)
}

fn minus(a: &[Fine; 3], b: &[Fine; 3]) -> [Fine; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
fn dot(a: &[Fine; 3], b: &[Fine; 3]) -> Fine {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross(a: &[Fine; 3], b: &[Fine; 3]) -> [Fine; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests;
