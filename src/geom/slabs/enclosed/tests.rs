use super::*;
use crate::geom::{Aabb, Interval};

const MOST: f64 = (1u128 << 126) as f64;

/// A ray whose components along y are within bounds.
fn ray(o: [f64; 2], d: [f64; 2]) -> EnclosedRay {
    let one = Interval::exact(1.0);
    EnclosedRay::new([one, Interval::between(o), one], [one, Interval::between(d), one])
}

#[test]
fn reciprocals_are_moved_outwards_by_two_floats() {
    let up = |x: f32| x.next_up().next_up();
    let of = |d| lanes(&ray([-3.0, 5.0], d), 1);
    // The greatest origin reaches the lower plane first, in the greatest direction.
    assert_eq!(of([2.0, 4.0]), Some([[5.0, -3.0], [-up(-0.25), up(0.5)]]));
    assert_eq!(of([-4.0, -2.0]), Some([[5.0, -3.0], [-up(0.5), up(-0.25)]]));
    for zero in [[0.0, 0.0], [-0.0, 0.0], [-0.0, -0.0]] {
        assert_eq!(of(zero), Some([[5.0, -3.0], [-up(f32::NEG_INFINITY), f32::INFINITY]]));
    }
}

#[test]
fn single_precision_takes_all_that_runs_one_way_and_does_not_overflow() {
    let usual = [[1.0, 1.0], [1e-30, 1e30], [-1e30, -1e-30], [0.0, 0.0], [f64::from(f32::MIN_POSITIVE), 1.0]];
    for d in usual {
        assert!(lanes(&ray([0.0, 0.0], d), 1).is_some(), "{d:?}");
    }
    let unusual = [
        [-1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 0.0],
        [1e-45, 1.0],
        [-1.0, -1e-45],
        [1.0, 1e39],
        [-1e39, -1.0],
        [1e-45, 2e-45],
    ];
    for d in unusual {
        assert_eq!(lanes(&ray([0.0, 0.0], d), 1), None, "{d:?}");
    }
    let beyond = MOST * 1.000_001;
    for o in [[0.0, MOST], [-MOST, 0.0], [-MOST, MOST], [MOST, MOST]] {
        assert!(lanes(&ray(o, [1.0, 2.0]), 1).is_some(), "{o:?}");
    }
    for o in [[0.0, beyond], [-beyond, 0.0], [-beyond, -MOST], [beyond, beyond]] {
        assert_eq!(lanes(&ray(o, [1.0, 2.0]), 1), None, "{o:?}");
    }
}

#[test]
fn double_precision_is_asked_only_where_it_is_needed() {
    let is_wide = |d: [f64; 2], reach: f32| {
        let region = Region::of(&Aabb { lo: Vec3::splat(-reach), hi: Vec3::ZERO });
        EnclosedSlabs::of(&ray([0.0, 1.0], d), 0.0, &region).is_wide
    };
    let most = MOST as f32;
    for (d, reach, expected) in [
        ([1.0, 2.0], 1.0, false),
        ([1.0, 2.0], most, false),
        ([1.0, 2.0], most.next_up(), true),
        ([-1.0, 2.0], 1.0, true),
        ([-1.0, 2.0], most.next_up(), true),
    ] {
        assert_eq!(is_wide(d, reach), expected, "{d:?} {reach}");
    }
}

#[test]
fn what_is_not_a_number_bounds_nothing() {
    let aabb = Aabb { lo: Vec3::new(2.0, 10.0, 2.0), hi: Vec3::new(3.0, 11.0, 3.0) };
    let region = Region::of(&aabb);
    let touches = |o, d| EnclosedSlabs::of(&ray(o, d), 0.0, &region).one(&aabb, f32::INFINITY).is_some();
    let unknown = [f64::NAN; 2];
    for (o, d) in [([0.0; 2], unknown), (unknown, [0.0; 2]), (unknown, [1.0; 2]), (unknown, unknown)] {
        assert!(touches(o, d), "{o:?} {d:?}");
    }
    assert!(!touches([0.0; 2], [0.0; 2]) && !touches([0.0, 9.0], [0.0; 2]));
    assert!(touches([0.0, 10.0], [0.0; 2]) && touches([0.0; 2], [-1.0, 20.0]));
}
