//! Quotients of exact determinants, rounded once. `[EXACT-8]`

use dashu_ratio::Relaxed;
use glam::DVec3;

use super::accumulator::Accumulator;
use super::predicates::apart;
use crate::geom::Real;
use crate::geom::truth::holds_fraction;

/// Distance to a triangle that the line meets, rounded to the nearest float; `None` outside the closed interval.
/// `[EXACT-3]`
#[cold]
#[inline(never)]
pub(super) fn distance<R: Real>(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3, interval: [R; 2]) -> Option<R> {
    let (e1, e2, s) = (apart([v0, v1]), apart([v0, v2]), apart([v0, o]));
    let t = fraction(&Accumulator::volume(&e2, &s, &e1), &Accumulator::volume(&apart([DVec3::ZERO, d]), &e2, &e1));
    holds_fraction(interval, &t).then(|| R::nearest_to(&t))
}

/// Weights of the second and third corner of a triangle that the line meets, rounded to the nearest floats.
#[cold]
#[inline(never)]
pub(super) fn weights<R: Real>(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> [R; 2] {
    let (e1, e2, s, d) = (apart([v0, v1]), apart([v0, v2]), apart([v0, o]), apart([DVec3::ZERO, d]));
    let det = Accumulator::volume(&d, &e2, &e1);
    // U = s . (d x e2) and V = d . (s x e1).
    [Accumulator::volume(&d, &e2, &s), Accumulator::volume(&d, &s, &e1)].map(|top| R::nearest_to(&fraction(&top, &det)))
}

/// A quotient; 0 if the divisor is, which it is for no line that meets a triangle.
fn fraction(top: &Accumulator, det: &Accumulator) -> Relaxed {
    if det.sign().is_eq() { Relaxed::ZERO } else { Relaxed::from_parts_signed(top.integer(), det.integer()) }
}

#[cfg(test)]
mod tests;
