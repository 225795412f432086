//! What is said of the distance of a triangle that begins beside the point.
//!
//! The bounds of double precision have a margin in units of the whole triangle, so they do not tell apart the thin
//! triangles at the pole of a fan, nearer to which the point is than the roundings of what is far away. Seen from the
//! nearest corner, the way to it and the edges are rounded in units of their own.

use glam::DVec3;

use super::{RANGE, SQUARES, UNIT};

/// Greatest error of the bound, in units of 2^-53 of the way to the nearest corner. `[NEAR-7]`
pub(super) const MARGIN: f64 = 32.0 * UNIT;

/// At most the distance of a triangle from a point, by the cone of the edges at its nearest corner; 0 where that says
/// nothing. `[NEAR-7]`
pub(super) fn least_distance(corners: &[DVec3; 3], point: DVec3) -> f64 {
    seen_from(nearest_first(corners, point), point, MARGIN)
}

/// From the first corner, with some margin.
pub(super) fn seen_from([a, b, c]: [DVec3; 3], point: DVec3, margin: f64) -> f64 {
    let vectors @ [way, b, c] = [a - point, b - a, c - a];
    if !vectors.iter().all(|v| RANGE.contains(&v.abs().max_element())) {
        return 0.0;
    }
    let [length, of_b, of_c] = vectors.map(DVec3::length);
    let margin = margin * length;
    if way.dot(b) > margin * of_b && way.dot(c) > margin * of_c {
        // Both edges lead away.
        return length - margin;
    }
    // A line from the corner between both edges is as far as |way x edge| / |edge|, of which this is a part.
    let [x, y] = [way.cross(b), way.cross(c)];
    let square = x.length_squared();
    if !SQUARES.contains(&square) {
        return 0.0;
    }
    ((square / of_b).min(x.dot(y) / of_c) / square.sqrt() - margin).max(0.0)
}

/// The corners in the same order, from the nearest one on.
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
