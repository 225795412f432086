use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::Aabb;
use crate::geom::tests::{exact, vectors};
use crate::geom::truth::RBig;

/// Half of the distance from 1 to the next double.
fn unit() -> f64 {
    2f64.powi(-53)
}

fn parts(Errors { sign, det, t }: Errors) -> [f64; 3] {
    [sign, det, t]
}

/// Returns the bounds of spec/exactness.md for the greatest components of d, s, and e1 and e2.
fn derived([d, c, e]: [f64; 3]) -> [f64; 3] {
    [78.0 * unit() * d * e * (c + e), 38.75 * unit() * d * e * e, 43.75 * unit() * c * e * e]
}

/// Returns a triangle, origin and direction with greatest components of 7, 11 and 6, for both orders of corners.
fn case(turn: bool) -> ([DVec3; 3], DVec3, DVec3) {
    let [a, b, c] = [[1.0, 2.0, 3.0], [7.0, 2.0, 3.0], [1.0, 4.0, 3.0]].map(DVec3::from);
    (if turn { [a, c, b] } else { [a, b, c] }, DVec3::new(1.0, 2.0, -8.0), DVec3::new(1.0, -2.0, 7.0))
}

const SIZES: [f64; 3] = [7.0, 11.0, 6.0];

/// For one triangle, and for a scene that extends to 8 and is 6 wide, with a ray from 3 at most. [EXACT-4]
#[test]
fn bounds_are_no_wider_than_derived() {
    let region = Region::of(&Aabb { lo: Vec3::splat(2.0), hi: Vec3::new(8.0, 4.0, 3.0) });
    assert_eq!(parts(Errors::of_scene(3.0, 7.0, &region)), derived(SIZES));
    assert_eq!(parts(Errors::within([0.0; 2], SIZES)), derived(SIZES));
    for (corners, o, d) in [case(false), case(true)] {
        assert_eq!(parts(Errors::of_triangle(&corners, o, d)), derived(SIZES));
        assert_eq!(parts(Errors::of_triangle_within([0.0; 2], &corners, o, d)), derived(SIZES));
    }
}

/// [INST-5]
#[test]
fn rays_within_bounds_add_what_is_derived() {
    let [origin, direction] = [2f64.powi(-20), 2f64.powi(-22)];
    let [d, c, e] = SIZES;
    let added =
        [12.0 * e * (direction * (c + e) + origin * (d + direction)), 6.0 * direction * e * e, 6.0 * origin * e * e];
    let expected: Vec<_> = derived(SIZES).iter().zip(added).map(|(exact, off)| exact + off).collect();
    let (corners, o, along) = case(false);
    assert_eq!(parts(Errors::of_triangle_within([origin, direction], &corners, o, along)).as_slice(), expected);
}

/// The errors of the parts, and four roundings. [EXACT-9]
#[test]
fn quotients_are_as_wide_as_derived() {
    let errors = Errors { sign: 2f64.powi(-10), det: 2f64.powi(-12), t: 2f64.powi(-9) };
    let around = |x: f64, error: f64| {
        let off = (error + x.abs() * errors.det) / 4.0 + 4.0 * unit() * x.abs();
        [x - off, x + off]
    };
    for sign in [1.0, -1.0] {
        for t in [12.0, -12.0] {
            let found = Determinants { det: 4.0 * sign, edges: [2.0 * sign, sign, sign], t: t * sign };
            assert_eq!(found.distance(&errors), around(t / 4.0, errors.t));
            assert_eq!(found.weights(&errors), [0.5, 0.25].map(|x| around(x, 1.25 * errors.sign)));
        }
    }
}

#[test]
fn what_is_as_great_as_its_bound_has_no_certain_sign() {
    let bound = 2f64.powi(-20);
    let errors = Errors { sign: bound, det: 0.0, t: 0.0 };
    for det in [1.0, -1.0] {
        for edge in 0..3 {
            let verdict = |x: f64| {
                let mut edges = [det; 3];
                edges[edge] = x * det;
                let found = Determinants { det, edges, t: 0.0 };
                (found.is_hit(&errors), found.is_miss(&errors))
            };
            assert_eq!([verdict(bound), verdict(0.0), verdict(-bound)], [(false, false); 3]);
            assert_eq!([verdict(bound.next_up()), verdict(-bound.next_up())], [(true, false), (false, true)]);
        }
    }
}

/// Draws integers of these magnitudes: corners and edges up to the ends of the bounds, where all numbers have their
/// greatest values.
fn whole(bits: u32) -> impl Strategy<Value = f64> {
    let end = (1i64 << bits) - 1;
    prop_oneof![Just(end), Just(-end), -end..=end].prop_map(|x| x as f64)
}

fn vector(bits: u32) -> impl Strategy<Value = DVec3> {
    [whole(bits), whole(bits), whole(bits)].prop_map(DVec3::from)
}

/// Draws triangles around a corner and a line from another place, all scaled. They have few digits, or as many as
/// single precision. One of the points may be on a finer grid.
fn on_a_grid() -> impl Strategy<Value = ([DVec3; 3], DVec3, DVec3)> {
    let digits = [1..24u32, 1..24u32, 1..24u32];
    (digits, -100..100, 0..4usize, 0..9i32).prop_flat_map(|([edges, off, direction], scale, finer, by)| {
        let scaled = move |v: DVec3| v * f64::from(scale).exp2();
        let points = [vector(20), vector(edges), vector(edges), vector(off)];
        (points, vector(direction)).prop_map(move |([corner, points @ ..], d)| {
            let fine = |k: usize| if k == finer { f64::from(-by).exp2() } else { 1.0 };
            let [v1, v2, o] = [0, 1, 2].map(|k| scaled(corner + points[k] * fine(k)));
            ([scaled(corner), v1, v2], o, d)
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// The determinant is exact for any origin of the line. [EXACT-11]
    #[test]
    fn nothing_is_rounded_on_a_coarse_grid((corners, o, d) in on_a_grid()) {
        let (are_exact, is_exact) = (Determinants::are_exact(&corners, o, d), Determinants::has_exact_det(&corners, d));
        let Determinants { det, edges: [u, v, w], t } = Determinants::of(&corners, o, d);
        let exact = |v: DVec3| v.to_array().map(|x| RBig::try_from(x).expect("finite"));
        let minus = |a: &[RBig; 3], b: &[RBig; 3]| -> [RBig; 3] { std::array::from_fn(|k| &a[k] - &b[k]) };
        let dot = |a: &[RBig; 3], b: &[RBig; 3]| &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2];
        let cross = |a: &[RBig; 3], b: &[RBig; 3]| -> [RBig; 3] {
            std::array::from_fn(|k| &a[(k + 1) % 3] * &b[(k + 2) % 3] - &a[(k + 2) % 3] * &b[(k + 1) % 3])
        };
        let ([v0, v1, v2], o, d) = (corners.map(exact), exact(o), exact(d));
        let (e1, e2, s) = (minus(&v1, &v0), minus(&v2, &v0), minus(&o, &v0));
        let (p, q) = (cross(&d, &e2), cross(&s, &e1));
        let expected = [dot(&e1, &p), dot(&s, &p), dot(&d, &q), dot(&e1, &p) - dot(&s, &p) - dot(&d, &q), dot(&e2, &q)];
        if is_exact {
            prop_assert_eq!(RBig::try_from(det).expect("finite"), expected[0].clone());
        }
        if are_exact {
            prop_assert_eq!([det, u, v, w, t].map(|x| RBig::try_from(x).expect("finite")), expected);
        }
    }
}

/// One more digit in any of the conditions causes rounding. [EXACT-11]
#[test]
fn grids_are_as_fine_as_they_can_be_told() {
    let corners = |edge: f64| [DVec3::ZERO, DVec3::new(edge, 0.0, 0.0), DVec3::new(0.0, edge, 1.0)];
    let are_exact = |edge: f64, off: f64, d: f64| {
        Determinants::are_exact(&corners(edge), DVec3::new(off, 1.0, 0.0), DVec3::new(0.0, 1.0, d))
    };
    // 16, 16 and 16 digits, with 5 for the sums.
    let all = |digits: i32| 2f64.powi(digits) - 1.0;
    assert!(are_exact(all(16), all(16), all(16)) && !are_exact(all(16), all(16), all(17)));
    assert!(are_exact(all(16), all(16), all(16)) && !are_exact(all(16), all(17), all(16)));
    assert!(are_exact(all(1), all(30), all(17)) && !are_exact(all(17), all(16), all(16)));
    // For the determinant: 3 digits for the sums, and any origin.
    let is_exact = |edge: f64, d: f64| Determinants::has_exact_det(&corners(edge), DVec3::new(0.0, 1.0, d));
    assert!(is_exact(all(16), all(18)) && !is_exact(all(16), all(19)) && !is_exact(all(17), all(17)));
    // The longer of edge and origin matters. For the distance, which does not depend on the direction, only the origin.
    assert!(are_exact(all(23), all(1), all(2)) && !are_exact(all(23), all(1), all(3)));
    assert!(are_exact(all(1), all(23), all(24)) && !are_exact(all(1), all(24), all(24)));
    assert!(are_exact(all(17), all(16), all(14)) && !are_exact(all(17), all(17), all(1)));
    // Positions too far apart for exact differences.
    let far =
        |corner: f64| [DVec3::splat(corner), DVec3::splat(corner + 1.0), DVec3::new(corner, corner + 1.0, corner)];
    let are_exact = |corner: f64| Determinants::are_exact(&far(corner), DVec3::splat(corner), DVec3::X);
    assert!(are_exact(2f64.powi(50)) && !are_exact(2f64.powi(51)));
}

/// Draws zero or a number with this number of digits after the first.
fn number() -> impl Strategy<Value = f64> {
    let some = (0..1u64 << 52, 0..=52u32, -30..30i32, any::<bool>()).prop_map(|(digits, zeros, scale, is_negative)| {
        let x = f64::from_bits(1023 << 52 | digits >> zeros << zeros) * f64::from(scale).exp2();
        if is_negative { -x } else { x }
    });
    prop_oneof![4 => some, 1 => Just(0.0), 1 => Just(-0.0)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Compares with the digits one by one. [EXACT-11]
    #[test]
    fn units_are_those_of_the_last_digits(x in [number(), number(), number()], y in [number(), number(), number()]) {
        let numbers: Vec<f64> = [x, y].concat().into_iter().filter(|&x| x != 0.0).collect();
        let last = |x: f64| exponent(x.abs()) - 52 + (x.to_bits() | 1 << 52).trailing_zeros() as i32;
        let least = numbers.iter().map(|&x| last(x)).min();
        let end = numbers.iter().map(|&x| exponent(x.abs()) + 1).max();
        let expected = match (least, end) {
            (Some(least), Some(end)) => (end - least <= 51).then_some(least),
            _ => Some(1),
        };
        prop_assert_eq!(super::unit([DVec3::from(x), DVec3::from(y)]), expected);
    }
}

/// Determinants at thresholds that are reported as exact are exact. [EXACT-11]
#[test]
fn determinants_that_are_exact_are_the_true_ones() {
    let (mut draw, mut seen) = (Draw::new(1), [0; 2]);
    for _ in 0..100_000 {
        let [a, b, c, o, d] = vectors(&mut draw, f64::MAX, |draw| draw.threshold_in_single().into());
        let found = Determinants::of(&[a, b, c], o, d);
        let [e1, e2, s, d_exact] = [[b, a], [c, a], [o, a], [d, DVec3::ZERO]]
            .map(|[to, from]| [0, 1, 2].map(|k| exact(to[k]) - exact(from[k])));
        let triple = |x: &[RBig; 3], y: &[RBig; 3], z: &[RBig; 3]| {
            let term = |i: usize, j: usize, k: usize| &x[i] * (&y[j] * &z[k] - &y[k] * &z[j]);
            term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1)
        };
        let det = triple(&e1, &d_exact, &e2);
        if Determinants::has_exact_det(&[a, b, c], d) {
            assert_eq!(exact(found.det), det, "{a} {b} {c} {d}");
            seen[0] += 1;
        }
        if Determinants::are_exact(&[a, b, c], o, d) {
            let (u, v) = (triple(&s, &d_exact, &e2), triple(&d_exact, &s, &e1));
            let w = &det - &u - &v;
            let numbers = [found.det, found.edges[0], found.edges[1], found.edges[2], found.t].map(exact);
            assert_eq!(numbers, [det, u, v, w, triple(&e2, &s, &e1)], "{a} {b} {c} {o} {d}");
            seen[1] += 1;
        }
    }
    assert!(seen.into_iter().all(|seen| seen > 500), "{seen:?}");
}
