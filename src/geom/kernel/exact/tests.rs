use super::*;
use crate::generate::draw::Draw;
use crate::generate::{Rng, Source as _};
use crate::geom::tests::{holds, vectors};
use crate::geom::truth::{self, Number as _, meet};
use crate::geom::{Aabb, EnclosedRay, ExactPoint, Real};

#[test]
fn the_stage_is_the_one_that_decides() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0]);
    let stage_in = |region: Aabb, triangle: &Triangle, [x, y]: [f32; 2], tmax: f32| {
        let ray = Ray::within(Vec3::new(x, y, 1.0), Vec3::NEG_Z, 0.0, tmax).unwrap();
        Exact::new(&ray, &Region::of(&region)).stage(triangle)
    };
    let stage = |at, tmax| stage_in(triangle.aabb(), &triangle, at, tmax);
    // Outside, inside, on an edge, and at a corner.
    assert_eq!(stage([4.0, 4.0], f32::INFINITY), Stage::Scene);
    assert_eq!(stage([1.0, 1.0], f32::INFINITY), Stage::Scene);
    assert_eq!(stage([1.0, 0.0], f32::INFINITY), Stage::Sums);
    assert_eq!(stage([3.0, 0.0], f32::INFINITY), Stage::Sums);
    // Close to an edge, on either side, where the scene's bounds are too coarse.
    let wide = Aabb { lo: Vec3::splat(-1e6), hi: Vec3::splat(1e6) };
    assert_eq!(stage_in(wide, &triangle, [1.0, 0.001], f32::INFINITY), Stage::Triangle);
    assert_eq!(stage_in(wide, &triangle, [1.0, -0.001], f32::INFINITY), Stage::Triangle);
    assert_eq!(stage([1.0, 0.001], f32::INFINITY), Stage::Scene);
    // The interval ends before the triangle, or exactly on it.
    assert_eq!(stage([1.0, 1.0], 0.5), Stage::Scene);
    assert_eq!(stage([1.0, 1.0], 1.0), Stage::Sums);
    // The interval begins before the triangle, exactly on it, or behind it.
    let from = |tmin: f32| {
        let ray = Ray::within(Vec3::ONE, Vec3::NEG_Z, tmin, f32::INFINITY).unwrap();
        Exact::new(&ray, &Region::of(&triangle.aabb())).stage(&triangle)
    };
    assert_eq!([0.5, 1.0, 2.0].map(from), [Stage::Scene, Stage::Sums, Stage::Scene]);
    // The distance is the midpoint between 1 and the next float.
    let below = Triangle(triangle.0.map(|v| v - Vec3::Z * (f32::EPSILON / 2.0)));
    assert_eq!(stage_in(below.aabb(), &below, [1.0, 1.0], f32::INFINITY), Stage::Sums);
}

/// The distance is the midpoint between 1 and the next float. Beyond the limit, no exact sum is computed for it.
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

/// Each shape differs from the previous one in one coordinate, by so little that only the last stages separate hit from
/// miss.
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
            // The shape, its copy, and its copy with the signs of zeros changed.
            let same = Triangle(shape.0.map(|v| Vec3::select(v.cmpeq(Vec3::ZERO), -v, v)));
            assert_eq!(
                [shape, shape, same].map(|shape| once.distance(&shape, f32::INFINITY).map(|met| met.t)),
                [answer; 3]
            );
            answers.push(answer.is_some());
        }
    }
    assert_eq!(answers, [true, false, true, true].repeat(2));
}

/// Triangles and rays at thresholds. All stages agree with rational arithmetic, also for exact rays. [EXACT-8] [INST-5]
fn thresholds_are_decided<V: Vector, K: Kernel<Vector = V, Shape = Triangle<V>>>(number: fn(&mut Draw) -> f64) {
    let (mut draw, mut hits) = (Draw::new(1), 0);
    for _ in 0..60_000 {
        let [a, b, c, o, d] = vectors(&mut draw, f64::MAX, number);
        // Half of the lines are aimed at a corner, an edge or the interior, as closely as floats permit.
        let targets = [a, a * 0.5 + b * 0.5, a * 0.5 + b * 0.25 + c * 0.25];
        let d = if draw.one_in(2) { targets[draw.below(3)] - o } else { d };
        let [a, b, c, o, d] = [a, b, c, o, d].map(|v| V::from_components(v.to_array().map(V::Real::rounded)));
        let (triangle, Ok(ray)) = (Triangle([a, b, c]), Ray::new(o, d)) else { continue };
        let frame = V::frame(triangle.0);
        let region = Region::within(frame, &frame.aabb(&triangle));
        let interval = [ray.tmin(), ray.tmax()];
        let expected = meet(triangle.0.map(V::components), o.components(), d.components()).within(interval);
        let t = expected.as_ref().map(|hit| V::Real::nearest(&hit.t));
        let (kernel, test) = (K::new(&ray, &region), EnclosedTest::new(&EnclosedRay::exact(&ray), interval, &region));
        assert_eq!(kernel.distance(&triangle, V::Real::INFINITY), t, "{ray:?} {triangle:?}");
        assert_eq!(kernel.blocks(&triangle), t.is_some(), "{ray:?} {triangle:?}");
        let found = test.distance(&triangle, V::Real::INFINITY);
        let certain = t.map_or(Certainty::Miss, Certainty::Hit);
        assert!(found == Certainty::Open || found == certain, "{found:?} {ray:?} {triangle:?}");
        if test.settle(&triangle) != Certainty::Open {
            assert_eq!(test.settle(&triangle), certain, "{ray:?} {triangle:?}");
        }
        let Some(hit) = expected else { continue };
        hits += 1;
        let weights = [&hit.u, &hit.v].map(V::Real::nearest);
        assert_eq!(kernel.weights(&triangle), weights, "{ray:?} {triangle:?}");
        assert!(test.weights(&triangle).is_none_or(|found| found == weights), "{ray:?} {triangle:?}");
        let point = ExactPoint::met(&ray, &triangle).expect("a hit");
        assert!(
            point.bounds().into_iter().zip(point.rational().iter()).all(|(bounds, x)| holds(bounds, x)),
            "{ray:?} {triangle:?}"
        );
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn thresholds_are_decided_in_single() {
    thresholds_are_decided::<Vec3, Exact>(|draw| draw.threshold_in_single().into());
}

#[test]
fn thresholds_are_decided_in_double() {
    thresholds_are_decided::<DVec3, Exact64>(Draw::threshold);
}

/// Lines through edges and corners, and next to them, on grids of few digits or many, from near a corner or from
/// farther away. [EXACT-11]
#[test]
fn what_is_met_on_a_grid_is_that_of_rationals() {
    let (mut rng, mut hits, mut misses) = (Rng::new(11), 0, 0);
    for _ in 0..6000 {
        let [edges, off, at, length] = [20, 20, 5, 2].map(|n| rng.below(n));
        let (is_beside, is_flat) = (rng.coin(), rng.below(8) == 0);
        let mut vector = |digits: u64| {
            let limit = 1 << digits;
            Vec3::from([(); 3].map(|()| rng.below(2 * limit + 1) as f32 - limit as f32))
        };
        let (a, half_e1, half_e2) = (vector(2), vector(edges), vector(edges));
        let (corners, way) = ([a, a + 2.0 * half_e1, a + 2.0 * half_e2], vector(off));
        // Or in the plane.
        let o = a + if is_flat { half_e1 * 3.0 - half_e2 } else { way };
        let target = [a, corners[1], a + half_e1, a + half_e2, a + half_e1 + half_e2][at as usize];
        let beside = if is_beside && !is_flat { vector(0) } else { Vec3::ZERO };
        let Ok(ray) = Ray::new(o, (target + beside - o) * [1.0, 3.0][length as usize]) else { continue };
        let (shape, points) = (Triangle(corners), corners.map(|corner| corner.to_array()));
        let hit = truth::meet(points, o.to_array(), ray.direction().to_array()).within([0.0, f32::INFINITY]);
        let t = hit.map(|hit| truth::round_f32(&hit.t));
        let exact = Exact::new(&ray, &Region::of(&shape.aabb()));
        assert_eq!(exact.distance(&shape, f32::INFINITY), t, "{ray:?} {shape:?}");
        assert_eq!(exact.blocks(&shape), t.is_some(), "{ray:?} {shape:?}");
        if t.is_some() { hits += 1 } else { misses += 1 }
    }
    assert!(hits > 3000 && misses > 500, "{hits} {misses}");
}
