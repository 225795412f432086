use glam::Vec3;

use super::*;
use crate::generate::Rng;
use crate::geom::nearest::tests::{square, vector};
use crate::geom::truth::{RBig, round_root};
use crate::geom::{Aabb, Measure, Real, Triangle};

/// Draws a vector to a place 2^-6 to 2^90 lengths away, where a mesh may be, in any unit.
fn way(random: &mut Rng, round: i32) -> (DVec3, f64) {
    (vector(random) * 2f64.powi(round % 97 - 6), 2f64.powi(round * 37 % 1601 - 800))
}

/// Returns the rounded distance of a box.
fn true_distance(point: DVec3, frame: &Frame, aabb: &Aabb) -> f64 {
    let number = |x: f64| RBig::try_from(x).expect("finite");
    let unit = number(power_of_two(frame.exponent()));
    let square = [0, 1, 2].map(|axis| {
        let inside = |x: f32| number(frame.origin()[axis]) + number(x.into()) * &unit - number(point[axis]);
        let way = inside(aabb.lo[axis]).max(-inside(aabb.hi[axis])).max(RBig::ZERO);
        &way * &way
    });
    round_root(&square.into_iter().fold(RBig::ZERO, |sum, part| sum + part))
}

/// Bounds of boxes equal their distances. [NEAR-8]
#[test]
fn boxes_are_as_far_as_they_are() {
    let (mut random, mut right, mut rough, mut rounds) = (Rng::new(31), 0, 0, 0);
    for round in 0..20_000 {
        let (way, unit) = way(&mut random, round);
        let origin = if round % 3 == 0 { DVec3::ZERO } else { vector(&mut random) * 100.0 * unit };
        let frame = Frame::new(origin, exponent_of(unit)).expect("a frame");
        let [a, b] = [(); 2].map(|()| vector(&mut random).as_vec3());
        let aabb = Aabb { lo: a.min(b), hi: a.max(b) };
        let point = origin + way * unit;
        let measure = Measure::within(&frame, point, f64::INFINITY);
        let (truth, found) = (true_distance(point, &frame, &aabb), measure.to_box_by_digits(&aabb));
        assert!(found <= truth, "{point} {frame:?} {aabb:?}: {found:e}, expected at most {truth:e}");
        if truth > 0.0 {
            (rounds, right) = (rounds + 1, right + usize::from(found == truth));
            rough += usize::from(measure.to_box(&aabb) == truth);
        }
    }
    assert!(rounds > 15_000 && right * 100 > rounds * 99 && rough * 10 < rounds, "{right} {rough} {rounds}");
}

/// [NEAR-8]
#[test]
fn triangles_are_not_nearer_than_the_plane_across_the_guess() {
    let (mut random, mut right, mut told) = (Rng::new(32), 0, 0);
    for round in 0..20_000 {
        let (way, unit) = way(&mut random, round);
        let flat = DVec3::new(1.0, f64::from(round % 5), f64::from(round % 2));
        let triangle = Triangle([(); 3].map(|()| vector(&mut random) * flat * unit));
        let point = way * unit;
        let Some([bound, rest]) = to_triangle(&triangle.0, point) else { continue };
        let truth = square(&triangle, point);
        let bound = RBig::try_from(bound).expect("finite") + RBig::try_from(rest).expect("finite");
        assert!(&bound * &bound <= truth, "{triangle:?} {point}");
        told += 1;
        right += usize::from(round_root::<f64>(&(&bound * &bound)) == round_root(&truth));
    }
    assert!(told > 15_000 && right * 10 > told * 9, "{right} {told}");
}

/// At the limits of the range, for unbounded boxes, and in single precision, which needs no additional digits.
#[test]
fn what_cannot_be_told_is_left_to_fewer_digits() {
    let aabb = |lo: f32, hi: f32| Aabb { lo: Vec3::splat(lo), hi: Vec3::splat(hi) };
    let to_box = |x: f64, aabb: &Aabb| Measure::new(DVec3::splat(x), f64::INFINITY).to_box_by_digits(aabb);
    assert_eq!(to_box(f64::MAX, &aabb(0.0, 1.0)), f64::INFINITY);
    assert_eq!(to_box(1e300, &aabb(0.0, 1.0)), true_distance(DVec3::splat(1e300), &Frame::IDENTITY, &aabb(0.0, 1.0)));
    assert_eq!(to_box(1e300, &aabb(f32::NEG_INFINITY, f32::INFINITY)), 0.0);
    assert_eq!(to_box(5e-324, &aabb(1.0, f32::INFINITY)), 3f64.sqrt());
    assert_eq!(to_box(-1e-320, &aabb(0.0, 1.0)), 0.0);
    let measure = Measure::new(Vec3::splat(3e38), f32::INFINITY);
    assert_eq!(measure.to_box_by_digits(&aabb(-3e38, 0.0)), f32::rounded(3e38 * 3f64.sqrt()));
    assert_eq!(to_triangle(&[DVec3::ZERO, DVec3::X, DVec3::Y], DVec3::splat(0.0)), None);
    assert_eq!(to_triangle(&[DVec3::MAX, DVec3::MIN, DVec3::Y], DVec3::X), None);
}
