use glam::Vec3;

use super::*;
use crate::geom::Aabb;

/// Half of the distance from 1 to the next double.
fn unit() -> f64 {
    2f64.powi(-53)
}

fn parts(Errors { sign, det, t }: Errors) -> [f64; 3] {
    [sign, det, t]
}

/// The bounds of spec/exactness.md for greatest components of d, s, and e1 and e2.
fn derived([d, c, e]: [f64; 3]) -> [f64; 3] {
    [78.0 * unit() * d * e * (c + e), 38.75 * unit() * d * e * e, 43.75 * unit() * c * e * e]
}

/// A triangle, origin and direction with greatest components of 7, 11 and 6, however the corners are turned.
fn case(turn: bool) -> ([DVec3; 3], DVec3, DVec3) {
    let [a, b, c] = [[1.0, 2.0, 3.0], [7.0, 2.0, 3.0], [1.0, 4.0, 3.0]].map(DVec3::from);
    (if turn { [a, c, b] } else { [a, b, c] }, DVec3::new(1.0, 2.0, -8.0), DVec3::new(1.0, -2.0, 7.0))
}

const SIZES: [f64; 3] = [7.0, 11.0, 6.0];

/// For one triangle, and for a scene that reaches to 8 and is 6 wide, with a ray from 3 at most. [EXACT-4]
#[test]
fn bounds_are_no_wider_than_derived() {
    let region = Region::of(&Aabb { lo: Vec3::splat(2.0), hi: Vec3::new(8.0, 4.0, 3.0) });
    assert_eq!(parts(Errors::of_scene(3.0, 7.0, &region)), derived(SIZES));
    assert_eq!(parts(Errors::of_scene_within([0.0; 2], 3.0, 7.0, &region)), derived(SIZES));
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

/// Errors of the parts, and four roundings. [EXACT-9]
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
