use std::array;

use super::*;
use crate::generate::{Rng, Source};
use crate::geom::truth::{self, Meeting, RBig};

type Corners = [DVec3; 3];

/// Returns the exact distance; `None` for a miss.
fn truth([a, b, c]: &Corners, o: DVec3, d: DVec3) -> Option<RBig> {
    match truth::meet([a, b, c].map(DVec3::to_array), o.to_array(), d.to_array()) {
        Meeting::Hit(point) => Some(point.t),
        Meeting::Miss | Meeting::Coplanar => None,
    }
}

/// Draws a number of few digits, of single precision, or of double precision.
fn number(rng: &mut Rng) -> f64 {
    let whole = rng.below(1 << 24) as f64 - f64::from(1 << 23);
    match rng.below(4) {
        0 => (rng.below(9) as f64 - 4.0) * 0.25,
        1 => f64::from((whole / 3e6) as f32),
        2 => whole * 2f64.powi(-43) + 1.0,
        _ => whole / 3e6,
    }
}

fn vector(rng: &mut Rng) -> DVec3 {
    DVec3::from(array::from_fn(|_| number(rng)))
}

/// Draws a triangle close to another: with permuted corners, with corners moved by single ulps, or with a common edge
/// or corner.
fn near(rng: &mut Rng, corners: &Corners) -> Corners {
    let mut next = *corners;
    next.rotate_left(rng.below(3) as usize);
    if rng.below(2) == 0 {
        next.swap(0, 1);
    }
    match rng.below(8) {
        0 => {}
        kept @ 1..=2 => next[kept as usize..].iter_mut().for_each(|corner| *corner = vector(rng)),
        kept @ 3..=4 => next[kept as usize - 3..].iter_mut().for_each(|corner| corner.z = corner.z.next_up()),
        5 => next[rng.below(3) as usize].x += 2f64.powi(-23),
        6 => next = array::from_fn(|_| next[0] + (next[1] - next[0]) * number(rng) + (next[2] - next[0]) * number(rng)),
        _ => next = array::from_fn(|_| vector(rng)),
    }
    next
}

/// Draws a direction to a point of the triangle, often on an edge, at a corner, or with weights of few digits.
fn aim(rng: &mut Rng, [a, b, c]: &Corners, o: DVec3) -> DVec3 {
    let weights: [f64; 2] = match rng.below(5) {
        0 => [0.0, 0.0],
        1 => [0.5, 0.0],
        2 => [0.25, 0.75],
        3 => [0.25, 0.5],
        _ => array::from_fn(|_| rng.below(1 << 20) as f64 * 2f64.powi(-21)),
    };
    a + (b - a) * weights[0] + (c - a) * weights[1] - o
}

/// Checks pairs of triangles that a ray hits, with the comparison of their exact distances, for `cases` draws at a
/// scale.
fn pairs(seed: u64, scale: f64, cases: usize, mut check: impl FnMut([&Corners; 2], DVec3, DVec3, &RBig, &RBig)) {
    let mut rng = Rng::new(seed);
    for _ in 0..cases {
        let one = array::from_fn(|_| vector(&mut rng));
        let other = near(&mut rng, &one);
        let o = vector(&mut rng) * [1.0, 1e3, 1e15][rng.below(3) as usize];
        let d = aim(&mut rng, &one, o);
        let ([one, other], o, d) = ([one, other].map(|corners| corners.map(|v| v * scale)), o * scale, d * scale);
        if let (Some(t), Some(to_other)) = (truth(&one, o, d), truth(&other, o, d)) {
            check([&one, &other], o, d, &t, &to_other);
        }
    }
}

/// [EXACT-13]
#[test]
fn distances_compare_as_their_fractions() {
    let mut seen = [0; 3];
    for (seed, exponent) in (1..).zip([0, 0, -40, 90, -190, 190, -300, 330]) {
        pairs(seed, 2f64.powi(exponent), 3000, |[one, other], o, d, t, to_other| {
            let crossing = |corners| Crossing { corners, o, d, has_room: (-200..200).contains(&exponent) };
            let (crossing, crossing_other) = (crossing(one), crossing(other));
            let order = t.cmp(to_other);
            assert_eq!(crossing.compare(&crossing_other), order, "{one:?} {other:?} {o} {d}");
            assert_eq!(crossing_other.compare(&crossing), order.reverse());
            seen[(order as i32 + 1) as usize] += 1;
            for float in [truth::round_f64(t), truth::round_f64(to_other), 0.0, 1.0] {
                let expected = t.cmp(&RBig::try_from(float).expect("finite"));
                assert_eq!(crossing.compare_with(float), expected, "{one:?} {o} {d} {float}");
            }
            assert_eq!(
                [f64::NEG_INFINITY, f64::INFINITY].map(|end| crossing.compare_with(end)),
                [Ordering::Greater, Ordering::Less]
            );
        });
    }
    assert!(seen.iter().all(|&seen| seen > 1000), "{seen:?}");
}

/// The order of triangles hit at a common edge or corner, of coincident triangles, and of triangles in a common plane
/// across an axis is decided without a quotient. [EXACT-13]
#[test]
fn triangles_that_are_met_together_are_told_by_signs() {
    let [a, b, c, e] = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 2.0], [0.0, -4.0, 7.0]].map(DVec3::from);
    let flat = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
    let moved = flat.map(|v| v - DVec3::new(0.5, 0.5, 0.0));
    // On one line, seen from above, and not on one line.
    let wall = [[0.1, 0.3, -9.0], [0.7, 0.2, -9.0], [0.7, 0.2, 5.0]].map(|v| DVec3::from(v) * 5.0);
    let longer = [wall[0], wall[1] + DVec3::Z * 60.0, wall[1]].map(|v| v - DVec3::Z * 0.1);
    let turned = [longer[0], longer[1], longer[2].with_y(1.1)];
    for (one, other, at, expected) in [
        ([a, b, c], [c, a, b], [1.0, 1.0], true),
        ([a, b, c], [b, a, c], [1.0, 1.0], true),
        ([a, b, c], [b, a, e], [1.0, 0.0], true),
        ([a, b, c], [e, a, b], [0.0, 0.0], true),
        ([b, c, a], [a, e, b + DVec3::Z], [0.0, 0.0], true),
        ([a, b, c], [a, b, e + 4.0 * DVec3::Y], [1.0, 0.5], false),
        (wall, longer, [1.0, 1.0], true),
        (wall, turned, [1.0, 1.0], false),
        (flat, moved, [0.25, 0.25], true),
        (flat, moved.map(|v| v + DVec3::Z), [0.25, 0.25], false),
    ] {
        let [o, d] = [DVec3::from([at[0], at[1], -3.0]), DVec3::Z];
        let crossing = |corners| Crossing { corners, o, d, has_room: true };
        assert_eq!(crossing(&one).is_met_with(&crossing(&other)), expected, "{one:?} {other:?} {at:?}");
        assert_eq!(crossing(&other).is_met_with(&crossing(&one)), expected, "{one:?} {other:?} {at:?}");
    }
}
