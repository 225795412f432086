//! Exact signs of edge functions, for floats of any size.

use std::cmp::Ordering;

use glam::DVec3;

use super::accumulator::Accumulator;
use super::fine;
use super::sum::{Pairs, difference};
use crate::geom::frame::power_of_two;

/// Returns the sign of the edge function d . ((to - o) x (from - o)): by twice the digits of a double, if they have
/// room, and by an exact sum if those do not decide.
pub(super) fn edge(d: DVec3, o: DVec3, from: DVec3, to: DVec3, has_room: bool) -> Ordering {
    let [a, b] = side(o, from, to);
    sign(d, a, b, has_room)
}

/// Returns the sign of d . (a x b) for vectors from one point to another, by the same stages.
pub(super) fn sign(d: DVec3, a: [DVec3; 2], b: [DVec3; 2], has_room: bool) -> Ordering {
    let known = if has_room { fine_volume(d, a, b) } else { None };
    known.unwrap_or_else(|| volume(d, a, b))
}

/// Returns the ends of a and b such that d . (a x b) is the edge function. The edge itself replaces one of them,
/// because less cancels for a far origin.
fn side(o: DVec3, from: DVec3, to: DVec3) -> [[DVec3; 2]; 2] {
    [[from, to], [o, from]]
}

/// Returns the sign of d . (a x b), if twice the digits decide; for numbers up to 2^200. `[EXACT-10]`
fn fine_volume(d: DVec3, a: [DVec3; 2], b: [DVec3; 2]) -> Option<Ordering> {
    let [edge, way] = [a, b].map(|[from, to]| (to - from).abs().max_element());
    if way > edge * fine::FAR {
        return near_volume(d, a, b);
    }
    let [a, b] = [a, b].map(|[from, to]| minus(to, from));
    fine::volume(d, &a, &b)?.partial_cmp(&0.0)
}

/// Returns this sign from a point of the line near to the edge a; b is the vector to the edge. `[EXACT-12]`
#[cold]
#[inline(never)]
fn near_volume(d: DVec3, a: [DVec3; 2], b: [DVec3; 2]) -> Option<Ordering> {
    let [a, b] = [a, b].map(|[from, to]| minus(to, from));
    fine::volume_from_near(d, &a, &b)?.partial_cmp(&0.0)
}

/// Returns the sign of d . (a x b) for vectors from one point to another, by an exact sum. `[EXACT-8]`
pub(super) fn volume(d: DVec3, a: [DVec3; 2], b: [DVec3; 2]) -> Ordering {
    Accumulator::volume(&apart([DVec3::ZERO, d]), &apart(a), &apart(b)).sign()
}

/// Returns the vector from one point to another, exactly: if a difference overflows, as its operands.
pub(super) fn apart([from, to]: [DVec3; 2]) -> Pairs {
    let difference = minus(to, from);
    [0, 1, 2].map(|k| if difference[k][1].is_nan() { [to[k], -from[k]] } else { difference[k] })
}

/// Returns a - b, which is exact if no difference is above 2^1000.
fn minus(a: DVec3, b: DVec3) -> Pairs {
    [0, 1, 2].map(|k| difference(a[k], b[k]))
}

/// Returns whether a line meets the closed triangle, in one point; call [`is_flat_at_sight`] first. It uses twice the
/// digits if they have room.
#[cold]
#[inline(never)]
pub(super) fn is_inside(corners: &[DVec3; 3], o: DVec3, d: DVec3, has_room: bool) -> bool {
    if has_room && let Some(is_inside) = fine::near_point(corners, o, d).and_then(|near| near.is_inside(corners, d)) {
        return is_inside;
    }
    let &[a, b, c] = corners;
    let sides = [[b, c], [c, a], [a, b]].map(|[from, to]| side(o, from, to));
    let mut known = [None; 3];
    if has_room {
        let signs = sides.iter().zip(&mut known).map(|(&[a, b], known)| {
            *known = fine_volume(d, a, b);
            *known
        });
        if let Some(meets) = meets(signs) {
            return meets;
        }
    }
    let known = sides.iter().zip(known);
    meets(known.map(|(&[a, b], known)| known.or_else(|| Some(volume(d, a, b))))).unwrap_or(false)
}

/// Decides by the signs of the edge functions; `None` if too few are known.
///
/// With A, B, C the corners relative to the origin, these are d . (C x B), d . (A x C) and d . (B x A). None may differ
/// in sign from another; all three are 0 only if the determinant, their sum, is.
fn meets(signs: impl Iterator<Item = Option<Ordering>>) -> Option<bool> {
    let (mut any_positive, mut any_negative, mut are_known) = (false, false, true);
    for sign in signs {
        any_positive |= sign == Some(Ordering::Greater);
        any_negative |= sign == Some(Ordering::Less);
        are_known &= sign.is_some();
        if any_positive && any_negative {
            return Some(false);
        }
    }
    are_known.then_some(any_positive || any_negative)
}

/// Returns whether twice the digits prove that a line is parallel to a triangle, for numbers up to 2^200. `[EXACT-10]`
#[cold]
#[inline(never)]
pub(super) fn is_parallel(&[v0, v1, v2]: &[DVec3; 3], d: DVec3) -> bool {
    fine_volume(d, [v0, v1], [v0, v2]) == Some(Ordering::Equal)
}

/// Returns whether a determinant is obviously 0: two corners are one point, or the triangle lies across an axis, like
/// walls and floors, and the line is parallel to it. Twice the digits and sums would need longer. For numbers of any
/// size.
pub(super) fn is_flat_at_sight(&[v0, v1, v2]: &[DVec3; 3], d: DVec3) -> bool {
    v0 == v1 || v0 == v2 || v1 == v2 || (d.cmpeq(DVec3::ZERO) & v0.cmpeq(v1) & v0.cmpeq(v2)).any()
}

/// Returns whether corners lie on a line: whether the cross product of two edges is 0, exactly.
pub(in crate::geom) fn is_degenerate(corners: &[DVec3; 3]) -> bool {
    if has_certain_area(corners) {
        return false;
    }
    let &[v0, v1, v2] = corners;
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().all(|axis| volume(axis, [v0, v1], [v0, v2]).is_eq())
}

/// Returns whether double precision proves that the corners do not lie on a line.
fn has_certain_area(&[v0, v1, v2]: &[DVec3; 3]) -> bool {
    let (e1, e2) = (v1 - v0, v2 - v0);
    is_certain(e1.x * e2.y, e1.y * e2.x) || is_certain(e1.y * e2.z, e1.z * e2.y) || is_certain(e1.z * e2.x, e1.x * e2.z)
}

/// Returns whether the sign of a - b is certain, a component of a cross product of two differences: each product has
/// three roundings, their difference one. Underflow is negligible against the bound, and overflow leaves infinities, of
/// which none is greater.
fn is_certain(a: f64, b: f64) -> bool {
    let least = const { power_of_two(-900) };
    let size = a.abs() + b.abs();
    size > least && (a - b).abs() > 4.0 * f64::EPSILON * size
}

/// A total order of the lines from a point through two other points, equal only if they are one line: by the slopes in
/// y and z over x; then, for those without an x, by the slope in z over y. Exact, for numbers of any size.
pub(crate) fn order_of_lines(from: DVec3, to: [DVec3; 2]) -> Ordering {
    let [a, b] = to;
    // Compares the slopes of two lines in a plane, whose first coordinates change by a[i] and b[i].
    let slope = |i: usize, j: usize, axis: DVec3| {
        let ([ai, aj], [bi, bj]) = ([a[i] - from[i], a[j] - from[j]], [b[i] - from[i], b[j] - from[j]]);
        let (left, right) = (aj * bi, bj * ai);
        let turn = if is_certain(left, right) {
            left.partial_cmp(&right).unwrap_or(Ordering::Equal)
        } else {
            volume(axis, [from, b], [from, a])
        };
        if (a[i] < from[i]) == (b[i] < from[i]) { turn } else { turn.reverse() }
    };
    let moves = |k: usize| [a[k] != from[k], b[k] != from[k]];
    match (moves(0), moves(1)) {
        ([true, true], _) => slope(0, 1, DVec3::Z).then_with(|| slope(0, 2, DVec3::NEG_Y)),
        ([false, false], [true, true]) => slope(1, 2, DVec3::X),
        // Lines along the later axes come later.
        ([false, false], [a, b]) | ([a, b], _) => b.cmp(&a),
    }
}

#[cfg(test)]
mod tests;
