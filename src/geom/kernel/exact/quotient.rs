//! Quotients of exact determinants, rounded once. `[EXACT-8]`

use dashu_ratio::Relaxed;
use glam::DVec3;

use super::accumulator::Accumulator;
use super::predicates::apart;
use crate::geom::Real;
use crate::geom::frame::power_of_two;
use crate::geom::truth::holds_fraction;

/// Returns the distance to a triangle that the line meets, rounded to the nearest float; `None` outside the closed
/// interval. `[EXACT-3]`
#[cold]
#[inline(never)]
pub(super) fn distance<R: Real>(
    corners: &[DVec3; 3],
    o: DVec3,
    d: DVec3,
    interval @ [tmin, tmax]: [R; 2],
) -> Option<R> {
    let [top, det] = distance_parts(corners, o, d);
    let ratio = Ratio { top: &top, det: &det };
    // Rounding keeps the order, so only an equal end leaves the result open.
    match ratio.nearest() {
        Some(t) if tmin < t && (t < tmax || tmax == R::INFINITY) => Some(t),
        Some(t) if t < tmin || tmax < t => None,
        _ => {
            let t = ratio.fraction();
            holds_fraction(interval, &t).then(|| R::nearest_to(&t))
        }
    }
}

/// Returns the distance to a triangle that the line meets, without rounding.
pub(super) fn fraction(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Relaxed {
    let [top, det] = distance_parts(corners, o, d);
    Ratio { top: &top, det: &det }.fraction()
}

/// Returns T and det.
fn distance_parts(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> [Accumulator; 2] {
    let (e1, e2, s) = (apart([v0, v1]), apart([v0, v2]), apart([v0, o]));
    [Accumulator::volume(&e2, &s, &e1), Accumulator::volume(&apart([DVec3::ZERO, d]), &e2, &e1)]
}

/// Returns the weights of the second and third corner of a triangle that the line meets, rounded to the nearest floats.
#[cold]
#[inline(never)]
pub(super) fn weights<R: Real>(&[v0, v1, v2]: &[DVec3; 3], o: DVec3, d: DVec3) -> [R; 2] {
    let (e1, e2, s, d) = (apart([v0, v1]), apart([v0, v2]), apart([v0, o]), apart([DVec3::ZERO, d]));
    let det = Accumulator::volume(&d, &e2, &e1);
    // U = s . (d x e2) and V = d . (s x e1).
    [Accumulator::volume(&d, &e2, &s), Accumulator::volume(&d, &s, &e1)].map(|top| {
        let ratio = Ratio { top: &top, det: &det };
        ratio.nearest().unwrap_or_else(|| R::nearest_to(&ratio.fraction()))
    })
}

/// A quotient of two sums.
struct Ratio<'s> {
    top: &'s Accumulator,
    /// Not 0 for a line that meets a triangle.
    det: &'s Accumulator,
}

impl Ratio<'_> {
    /// Returns the nearest float, if the first digits decide; for weights and distances on coarse grids they decide
    /// ties too.
    fn nearest<R: Real>(&self) -> Option<R> {
        let Some(top) = self.top.leading() else { return Some(R::ZERO) };
        let det = self.det.leading()?;
        // From 2^63 to 2^65, and a last digit for the remainder.
        let divisor = det.digits >> 64;
        let (quotient, rest) = (top.digits / divisor, top.digits % divisor);
        let [least, most] = if top.is_exact && det.is_exact && det.digits as u64 == 0 {
            [2 * quotient + u128::from(rest != 0); 2]
        } else {
            [2 * (top.digits / (divisor + 1)), 2 * (quotient + 2)]
        };
        let scale = top.exponent - det.exponent - 65;
        let is_negative = top.is_negative != det.is_negative;
        // The quotient of the digits is at least 2^64, in these units: this one is beyond all numbers.
        if scale >= 960 {
            return Some(R::rounded(if is_negative { f64::NEG_INFINITY } else { f64::INFINITY }));
        }
        // Neither subnormal nor infinite.
        if !(-900..900).contains(&scale) {
            return None;
        }
        let ends = [least, most].map(|x| {
            let high = x as f64;
            // Only the sign of the rounding error matters.
            let rest = f64::from((x as i128 - high as i128).signum() as i8);
            [high * power_of_two(scale), rest].map(|x| if is_negative { -x } else { x })
        });
        R::between(if is_negative { [ends[1], ends[0]] } else { ends })
    }

    /// Returns the quotient itself; 0 if the divisor is.
    fn fraction(&self) -> Relaxed {
        if self.det.sign().is_eq() {
            return Relaxed::ZERO;
        }
        Relaxed::from_parts_signed(self.top.integer(), self.det.integer())
    }
}

#[cfg(test)]
mod tests;
