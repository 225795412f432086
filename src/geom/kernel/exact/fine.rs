//! Signs, distances and weights in twice the digits of a double. `[EXACT-10]`
//!
//! A double holds no more digits than the quotient of the filter, whose bounds therefore hardly ever round alike. These
//! nearly always do, at a fraction of the cost of exact sums. And they tell signs where the filter does not: of rays
//! from afar, and of those nearly in the plane of a triangle.

use std::ops::Add as _;

use glam::DVec3;

use super::predicates::Pairs;
use crate::geom::Real;
use crate::geom::fine::Fine;
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
    /// No component of the direction, and none of a corner as seen from the origin, may be above 2^200.
    pub(super) fn new(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Self {
        Self::of(&corners.map(exact), o, d)
    }

    /// Of corners that are known within bounds; `None` where a number is above 2^200. `[INST-5]`
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

    /// The distance, rounded to the nearest float, if that is certain and is in an interval, not at an end. Rounding
    /// keeps the order, so that only an end that is equal leaves a question.
    pub(in crate::geom) fn distance_within<R: Real>(&self, [tmin, tmax]: [R; 2]) -> Option<R> {
        self.distance().filter(|t| tmin < *t && *t < tmax)
    }

    fn distance<R: Real>(&self) -> Option<R> {
        self.nearest(dot(&self.e2, &cross(&self.s, &self.e1)))
    }

    /// The weights of the second and the third corner, likewise.
    pub(in crate::geom) fn weights<R: Real>(&self) -> Option<[R; 2]> {
        let u = self.nearest(dot(&self.s, &cross(&self.d, &self.e2)))?;
        Some([u, self.nearest(dot(&self.d, &cross(&self.s, &self.e1)))?])
    }

    fn nearest<R: Real>(&self, top: Fine) -> Option<R> {
        R::between(top.over(self.det)?.bounds())
    }
}

/// A number with the sign of d . (a x b), where that is certain. No number may be above 2^200.
pub(super) fn volume(d: DVec3, a: &Pairs, b: &Pairs) -> Option<f64> {
    let [a, b] = [a, b].map(|v| v.map(Fine::of_two));
    // Often d is along an axis.
    let terms = (0..3).filter(|&k| d[k] != 0.0).map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Fine::exact(d[k]) * (a[i] * b[j] - a[j] * b[i])
    });
    terms.fold(Fine::ZERO, Fine::add).sign()
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
