//! Exact signs of edge functions.

use glam::DVec3;

use super::fine;
use super::sum::{Sum, difference};

/// A vector whose components are sums of two numbers.
pub(super) type Pairs = [[f64; 2]; 3];

/// a - b, exactly.
pub(super) fn minus(a: DVec3, b: DVec3) -> Pairs {
    [0, 1, 2].map(|k| difference(a[k], b[k]))
}

/// Adds d . (a x b), in up to 96 places.
pub(super) fn add_edge<const N: usize>(sum: &mut Sum<N>, d: DVec3, a: &Pairs, b: &Pairs) {
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        sum.add_product(a[i], b[j], d[k]);
        sum.add_product(a[j], b[i], -d[k]);
    }
}

/// A number with the sign of the edge function d . ((to - o) x (from - o)).
pub(super) fn edge(d: DVec3, o: DVec3, from: DVec3, to: DVec3) -> f64 {
    let [a, b] = side(o, from, to);
    volume(d, &a, &b)
}

/// a and b, of which d . (a x b) is the edge function: with the edge itself in place of one of both. From afar, much
/// less cancels so.
fn side(o: DVec3, from: DVec3, to: DVec3) -> [Pairs; 2] {
    [minus(to, from), minus(from, o)]
}

/// A number with the sign of d . (a x b), of numbers up to 2^200: by twice the digits of a double, and by an exact sum
/// where those do not tell. `[EXACT-10]`
pub(super) fn volume(d: DVec3, a: &Pairs, b: &Pairs) -> f64 {
    fine::volume(d, a, b).unwrap_or_else(|| volume_by_sum(d, a, b))
}

fn volume_by_sum(d: DVec3, a: &Pairs, b: &Pairs) -> f64 {
    let mut sum = Sum::<96>::new();
    add_edge(&mut sum, d, a, b);
    sum.value()
}

/// Whether a line meets the closed triangle, in one point; see [`is_along_axes`] first.
#[cold]
#[inline(never)]
pub(super) fn is_inside(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> bool {
    let sides = sides(corners, o);
    by_twice_the_digits(&sides, d).unwrap_or_else(|known| {
        let known = sides.iter().zip(known);
        meets(known.map(|([a, b], sign)| Some(sign.unwrap_or_else(|| volume_by_sum(d, a, b))))).unwrap_or(false)
    })
}

/// The same as far as twice the digits tell, for numbers up to 2^200, however small. `[EXACT-10]`
#[cold]
#[inline(never)]
pub(super) fn is_inside_by_fine(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> Option<bool> {
    by_twice_the_digits(&sides(corners, o), d).ok()
}

fn sides(&[a, b, c]: &[DVec3; 3], o: DVec3) -> [[Pairs; 2]; 3] {
    [[b, c], [c, a], [a, b]].map(|[from, to]| side(o, from, to))
}

/// Whether the line meets the triangle of these sides; what is known of the signs, if that is too little.
fn by_twice_the_digits(sides: &[[Pairs; 2]; 3], d: DVec3) -> Result<bool, [Option<f64>; 3]> {
    let mut known = [None; 3];
    let signs = sides.iter().zip(&mut known).map(|([a, b], known)| {
        *known = fine::volume(d, a, b);
        *known
    });
    meets(signs).ok_or(known)
}

/// By the signs of the edge functions; `None` if too few are known.
///
/// With A, B, C the corners as seen from the origin, these are d . (C x B), d . (A x C) and d . (B x A). None may
/// differ in sign from another; all three are 0 only if the determinant, their sum, is.
fn meets(signs: impl Iterator<Item = Option<f64>>) -> Option<bool> {
    let (mut any_positive, mut any_negative, mut are_known) = (false, false, true);
    for sign in signs {
        let edge = sign.unwrap_or(0.0);
        are_known &= sign.is_some();
        (any_positive, any_negative) = (any_positive || edge > 0.0, any_negative || edge < 0.0);
        if any_positive && any_negative {
            return Some(false);
        }
    }
    are_known.then_some(any_positive || any_negative)
}

/// Whether twice the digits tell that a line is parallel to a triangle, for numbers up to 2^200. `[EXACT-10]`
#[cold]
#[inline(never)]
pub(super) fn is_parallel(&[v0, v1, v2]: &[DVec3; 3], d: DVec3) -> bool {
    fine::volume(d, &minus(v1, v0), &minus(v2, v0)) == Some(0.0)
}

/// Whether a line is parallel to a triangle that lies across an axis, as walls and floors do: what twice the digits and
/// sums would tell at length, for numbers of any size.
pub(super) fn is_along_axes(&[v0, v1, v2]: &[DVec3; 3], d: DVec3) -> bool {
    (d.cmpeq(DVec3::ZERO) & v0.cmpeq(v1) & v0.cmpeq(v2)).any()
}

/// Whether corners that are floats lie on a line: whether the cross product of two edges is 0, exactly.
pub(in crate::geom) fn is_degenerate(corners: &[DVec3; 3]) -> bool {
    if has_certain_area(corners) {
        return false;
    }
    let &[v0, v1, v2] = corners;
    let (e1, e2) = (minus(v1, v0), minus(v2, v0));
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().all(|axis| volume(axis, &e1, &e2) == 0.0)
}

/// Whether double precision can tell that the corners do not lie on a line.
fn has_certain_area(&[v0, v1, v2]: &[DVec3; 3]) -> bool {
    let (e1, e2) = (v1 - v0, v2 - v0);
    // A component of the cross product is certain if it is not 0: each product has three roundings, their difference
    // one.
    let is_certain = |a: f64, b: f64| (a - b).abs() > 4.0 * f64::EPSILON * (a.abs() + b.abs());
    is_certain(e1.x * e2.y, e1.y * e2.x) || is_certain(e1.y * e2.z, e1.z * e2.y) || is_certain(e1.z * e2.x, e1.x * e2.z)
}

#[cfg(test)]
mod tests;
