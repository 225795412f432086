//! The solid angle of a triangle on the sphere, one corner of which is the opposite of an axis.
//!
//! ```text
//! tan(angle / 2) = -e·(a × b) / (|a| |b| - (e·a) |b| + (a·b) - (e·b) |a|)       |e| = 1
//! ```
//!
//! (Van Oosterom & Strackee 1983, "The solid angle of a plane triangle".) Near the edge from a to b both parts are
//! nearly 0, and doubles have no correct digit of them. Then twice the digits are used. `[WINDING-2]`

use std::f64::consts::PI;

use glam::DVec3;

use super::fine::Fine;
use super::frame::power_of_two;

/// Fraction of all directions, counterclockwise positive, and a bound of its error.
pub(crate) type Share = [f64; 2];

/// Change of the parts of the quotient by rounding, over π. `[WINDING-2]`
pub(crate) const ROUNDED: f64 = 32.0 * f64::EPSILON;

/// Returns the fraction of all directions that the triangle from the opposite of `e` to two points covers, as seen from
/// another point, by doubles. The error is infinite if it is undecided on which side of `e` the edge passes.
pub(crate) fn share(point: DVec3, ends: [DVec3; 2], e: DVec3) -> Share {
    let [Some(a), Some(b)] = ends.map(|end| direction(point, end)) else { return [0.0; 2] };
    of_parts(-e.dot(a.cross(b)), 1.0 - e.dot(a) + a.dot(b) - e.dot(b), PI * ROUNDED)
}

/// Returns this fraction by twice the digits; `None` for numbers outside the range.
#[cold]
pub(crate) fn fine_share(point: DVec3, ends: [DVec3; 2], e: DVec3) -> Option<Share> {
    let least = power_of_two(-200);
    let usual = |x: f64| x == 0.0 || (least..least.recip()).contains(&x.abs());
    let way = |end: DVec3| [0, 1, 2].map(|k| Fine::exact(end[k]) - Fine::exact(point[k]));
    let [a, b] = ends.map(way);
    if !a.iter().chain(&b).all(|x| usual(x.middle())) {
        return None;
    }
    let e = e.to_array().map(Fine::exact);
    let dot = |u: &[Fine; 3], v: &[Fine; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let [of_a, of_b, of_e] = [dot(&a, &a).root()?, dot(&b, &b).root()?, dot(&e, &e).root()?];
    let top = -dot(&e, &[minor(1, 2), minor(2, 0), minor(0, 1)]);
    let bottom = of_e * (of_a * of_b + dot(&a, &b)) - of_b * dot(&e, &a) - of_a * dot(&e, &b);
    let off = [top, bottom].map(|part| part.interval().ends()).map(|[lo, hi]| hi - lo);
    Some(of_parts(top.middle(), bottom.middle(), off[0].max(off[1])))
}

/// Returns the angle of a half tangent over 4π, from parts with an error of at most `off`.
fn of_parts(top: f64, bottom: f64, off: f64) -> Share {
    // The ray and the sum may be on different sides of the edge.
    let is_open = bottom <= off && top.abs() <= off;
    let error = off / PI / top.abs().max(bottom.abs()).max(f64::MIN_POSITIVE);
    [top.atan2(bottom) / (2.0 * PI), if is_open { f64::INFINITY } else { error }]
}

/// Returns the unit vector from one point to another, at any distance; `None` if they are one point.
fn direction(from: DVec3, to: DVec3) -> Option<DVec3> {
    let whole = to - from;
    let way = if whole.is_finite() { whole } else { to * 0.5 - from * 0.5 };
    let most = way.abs().max_element();
    (most > 0.0).then(|| (way / most).normalize())
}
