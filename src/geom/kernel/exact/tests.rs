use super::*;
use crate::geom::Aabb;

#[test]
fn the_stage_is_the_one_that_decides() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0]);
    let stage_in = |region: Aabb, triangle: &Triangle, [x, y]: [f32; 2], tmax: f32| {
        let ray = Ray::within(Vec3::new(x, y, 1.0), Vec3::NEG_Z, 0.0, tmax).unwrap();
        Exact::new(&ray, &Region::of(&region)).stage(triangle)
    };
    let stage = |at, tmax| stage_in(triangle.aabb(), &triangle, at, tmax);
    // Beside it, inside, on an edge, and at a corner.
    assert_eq!(stage([4.0, 4.0], f32::INFINITY), Stage::Scene);
    assert_eq!(stage([1.0, 1.0], f32::INFINITY), Stage::Scene);
    assert_eq!(stage([1.0, 0.0], f32::INFINITY), Stage::Sums);
    assert_eq!(stage([3.0, 0.0], f32::INFINITY), Stage::Sums);
    // Near an edge, on either side, where the scene's bounds are too coarse.
    let wide = Aabb { lo: Vec3::splat(-1e6), hi: Vec3::splat(1e6) };
    assert_eq!(stage_in(wide, &triangle, [1.0, 0.001], f32::INFINITY), Stage::Triangle);
    assert_eq!(stage_in(wide, &triangle, [1.0, -0.001], f32::INFINITY), Stage::Triangle);
    assert_eq!(stage([1.0, 0.001], f32::INFINITY), Stage::Scene);
    // The interval ends before the triangle, or right on it.
    assert_eq!(stage([1.0, 1.0], 0.5), Stage::Scene);
    assert_eq!(stage([1.0, 1.0], 1.0), Stage::Sums);
    // It begins before it, right on it, or behind it.
    let from = |tmin: f32| {
        let ray = Ray::within(Vec3::ONE, Vec3::NEG_Z, tmin, f32::INFINITY).unwrap();
        Exact::new(&ray, &Region::of(&triangle.aabb())).stage(&triangle)
    };
    assert_eq!([0.5, 1.0, 2.0].map(from), [Stage::Scene, Stage::Sums, Stage::Scene]);
    // The distance is in the middle between 1 and the next float.
    let below = Triangle(triangle.0.map(|v| v - Vec3::Z * (f32::EPSILON / 2.0)));
    assert_eq!(stage_in(below.aabb(), &below, [1.0, 1.0], f32::INFINITY), Stage::Sums);
}

/// The distance is in the middle between 1 and the next float: beyond the limit, no exact sum is spent on it.
#[test]
fn what_is_beyond_the_limit_is_not_placed() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0].map(|v| v - Vec3::Z * (f32::EPSILON / 2.0)));
    let ray = Ray::new(Vec3::ONE, Vec3::NEG_Z).unwrap();
    let exact = Exact::new(&ray, &Region::of(&triangle.aabb()));
    assert_eq!([2.0, 1.0, 0.5].map(|limit| exact.distance(&triangle, limit)), [Some(1.0), Some(1.0), None]);
}

#[test]
fn a_distance_that_may_be_an_end_is_open() {
    for (interval, expected) in [
        ([1.0, 4.0], Some(true)),
        ([2.0, 4.0], None),
        ([1.0, 3.0], None),
        ([2.5, 4.0], None),
        ([1.0, 2.5], None),
        ([3.0, 4.0], None),
        ([1.0, 2.0], None),
        ([3.5, 4.0], Some(false)),
        ([1.0, 1.5], Some(false)),
    ] {
        assert_eq!(is_within([2.0, 3.0], interval), expected, "{interval:?}");
    }
}

/// Each shape differs from the one before in one coordinate, by so little that the last stages tell hit from miss.
#[test]
fn of_shapes_that_differ_each_is_asked() {
    let ray = Ray::new(Vec3::new(1.0, 0.0, 1.0), Vec3::NEG_Z).unwrap();
    let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0]);
    let (exact, once) =
        (Exact::new(&ray, &Region::of(&triangle.aabb())), ExactOnce::new(&ray, &Region::of(&triangle.aabb())));
    let mut answers = Vec::new();
    for corner in 0..2 {
        for y in [0.0, 1e-30, -1e-30, 0.0] {
            let mut shape = triangle;
            shape.0[corner].y = y;
            assert_eq!(exact.stage(&shape), Stage::Sums);
            let answer = exact.distance(&shape, f32::INFINITY);
            // It, the same again, and what coincides but for the signs of zeros.
            let same = Triangle(shape.0.map(|v| Vec3::select(v.cmpeq(Vec3::ZERO), -v, v)));
            assert_eq!([shape, shape, same].map(|shape| once.distance(&shape, f32::INFINITY)), [answer; 3]);
            answers.push(answer.is_some());
        }
    }
    assert_eq!(answers, [true, false, true, true].repeat(2));
}
