//! Bounds of twice the digits, in any unit: from far away, all parts of a mesh have nearly the same distance.
//! `[NEAR-8]`
//!
//! Double precision bounds a distance up to some units of its last place, so it cannot prove that a box is not nearer
//! than the best triangle. These bounds can, unless the midpoint of two floats is between them.

use glam::DVec3;

use super::nearest;
use crate::geom::Frame;
use crate::geom::fine::Fine;
use crate::geom::frame::{exponent_of, power_of_two};

/// A double, and its rounding error.
type Sum = [f64; 2];

/// Returns a lower bound of the distance of a box with these corners in the frame. `below` and `above` are
/// approximations of its start after the point and its end before it, on each axis, and `about` approximates the
/// distance.
#[inline(never)]
pub(super) fn to_box(
    point: DVec3,
    frame: &Frame,
    [lo, hi]: [DVec3; 2],
    [below, above]: [DVec3; 2],
    about: f64,
) -> Option<Sum> {
    let exponent = unit_of(about);
    let inside = |x: f64| scaled(Fine::exact(x), frame.exponent() - exponent);
    let mut square = Fine::ZERO;
    for axis in 0..3 {
        let point = scaled(Fine::exact(point[axis]) - Fine::exact(frame.origin()[axis]), -exponent);
        let way = if below[axis] > 0.0 {
            inside(lo[axis]) - point
        } else if above[axis] > 0.0 {
            point - inside(hi[axis])
        } else {
            continue;
        };
        square = square + way * way;
    }
    Some(back(square.root()?, exponent))
}

/// Returns a lower bound of the distance of a triangle: the least product of a corner and a direction, over the length
/// of the direction. `None` if there is no guess of the direction, or it gives no bound.
#[inline(never)]
pub(super) fn to_triangle(corners: &[DVec3; 3], point: DVec3) -> Option<Sum> {
    let guess = nearest(&corners.map(|corner| corner - point));
    let greatest = guess.abs().max_element();
    if !(greatest > 0.0 && greatest.is_finite()) {
        return None;
    }
    let exponent = unit_of(greatest);
    let direction = (guess * power_of_two(-exponent)).to_array().map(Fine::exact);
    let dot = |[a, b, c]: [Fine; 3]| a * direction[0] + b * direction[1] + c * direction[2];
    let products = corners.map(|corner| {
        dot([0, 1, 2].map(|axis| scaled(Fine::exact(corner[axis]) - Fine::exact(point[axis]), -exponent)))
    });
    let [a, b, c] = products.map(|product| product.bounds()[0]);
    // False for a NaN.
    if !(a[0] > 0.0 && b[0] > 0.0 && c[0] > 0.0) {
        return None;
    }
    let lesser = |x: Sum, y: Sum| if x < y { x } else { y };
    let least = lesser(lesser(a, b), c);
    Some(back(Fine::of_two(least).over(dot(direction).root()?)?, exponent))
}

/// Returns the exponent of a unit in which squares of about this size neither over- nor underflow; 0 for the unit 1.
fn unit_of(about: f64) -> i32 {
    let exponent = exponent_of(about);
    if exponent.abs() <= 200 { 0 } else { exponent.clamp(-900, 1000) }
}

fn scaled(x: Fine, exponent: i32) -> Fine {
    match exponent {
        0 => x,
        -1000..=1000 => x.scaled(exponent),
        _ => x.scaled(exponent / 2).scaled(exponent - exponent / 2),
    }
}

/// Returns the least of these numbers, in the unit 1.
fn back(lengths: Fine, exponent: i32) -> Sum {
    lengths.bounds()[0].map(|part| part * power_of_two(exponent))
}

#[cfg(test)]
mod tests;
