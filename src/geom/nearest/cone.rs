//! A bound of the distance of a triangle that starts near the point.
//!
//! The bounds of double precision have a margin in units of the whole triangle. So they do not separate the thin
//! triangles at the pole of a fan, if the point is closer to the pole than the rounding errors of the far corners.
//! Relative to the nearest corner, the vector to it and the edges are rounded in their own units.

use glam::DVec3;

use super::{RANGE, SQUARES, UNIT};

/// Greatest error of the bound, in units of 2^-53 of the distance of the nearest corner. `[NEAR-7]`
pub(super) const MARGIN: f64 = 32.0 * UNIT;

/// Returns a lower bound of the distance of a triangle from a point, by the cone of the edges at its nearest corner; 0
/// if that gives no bound. `[NEAR-7]`
pub(super) fn least_distance(corners: &[DVec3; 3], point: DVec3) -> f64 {
    seen_from(nearest_first(corners, point), point, MARGIN)
}

/// Computes the bound from the first corner, with some margin.
pub(super) fn seen_from([a, b, c]: [DVec3; 3], point: DVec3, margin: f64) -> f64 {
    let vectors @ [way, b, c] = [a - point, b - a, c - a];
    if !vectors.iter().all(|v| RANGE.contains(&v.abs().max_element())) {
        return 0.0;
    }
    let [length, of_b, of_c] = vectors.map(DVec3::length);
    let margin = margin * length;
    if way.dot(b) > margin * of_b && way.dot(c) > margin * of_c {
        // The two edges lead away.
        return length - margin;
    }
    // The distance of a line from the corner between the two edges is |way x edge| / |edge|; this is a part of it.
    let [x, y] = [way.cross(b), way.cross(c)];
    let square = x.length_squared();
    if !SQUARES.contains(&square) {
        return 0.0;
    }
    ((square / of_b).min(x.dot(y) / of_c) / square.sqrt() - margin).max(0.0)
}

/// Returns the corners in the same cyclic order, starting at the nearest one.
pub(super) fn nearest_first(&[a, b, c]: &[DVec3; 3], point: DVec3) -> [DVec3; 3] {
    let [of_a, of_b, of_c] = [a, b, c].map(|corner| (corner - point).abs().max_element());
    if of_a <= of_b && of_a <= of_c {
        [a, b, c]
    } else if of_b <= of_c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
