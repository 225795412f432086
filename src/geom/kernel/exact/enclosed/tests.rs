use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::geom::tests::threshold;
use crate::geom::truth::{Meeting, Number, Point, holds, meet, round_f32};
use crate::geom::{Aabb, Interval, Ray, Region};

fn coordinate() -> impl Strategy<Value = f64> {
    let few = [0.0, 1.0, -1.0, 0.5, 2.0, 1e-3, 1e6];
    let small = threshold().prop_filter("small", |x| x.abs() <= 1e6);
    prop_oneof![2 => prop::sample::select(few.to_vec()), 6 => -2.0..2.0f64, 1 => small]
}

/// Draws a number, and half the width of an interval around it.
fn around() -> impl Strategy<Value = (f64, f64)> {
    let width = prop_oneof![Just(0.0), Just(1e-15), Just(1e-9), Just(1e-4), Just(0.05), Just(1.0)];
    (coordinate(), width)
}

fn triangle() -> impl Strategy<Value = Triangle> {
    let corner = || [coordinate(), coordinate(), coordinate()].prop_map(|x| Vec3::from(x.map(|x| x as f32)));
    [corner(), corner(), corner()].prop_map(Triangle)
}

const INTERVAL: [f32; 2] = [0.0, 8.0];

/// Returns the exact hit of a ray in double precision.
fn truth<V: Vector>(triangle: &Triangle<V>, o: [f64; 3], d: [f64; 3]) -> Option<Point> {
    match meet(triangle.widen().map(|corner| corner.to_array()), o, d) {
        Meeting::Hit(point) => Some(point),
        _ => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40_000))]

    /// For all 64 corners of the bounds and for the midpoint.
    #[test]
    fn verdicts_hold_for_every_ray_within_bounds(
        triangle in triangle(),
        numbers in [around(), around(), around(), around(), around(), around()],
        aim in [0.0..1.0f64, 0.0..1.0f64],
        aims in any::<bool>(),
    ) {
        let numbers = if aims { aimed(&triangle, numbers, aim) } else { numbers };
        verdicts_hold(&triangle, numbers, [1.0; 2])?;
    }

    /// Also for triangles with corners that are doubles, far from zero, tiny and huge.
    #[test]
    fn verdicts_hold_for_doubles(
        corners in [[coordinate(), coordinate(), coordinate()], [coordinate(), coordinate(), coordinate()],
            [coordinate(), coordinate(), coordinate()]],
        numbers in [around(), around(), around(), around(), around(), around()],
        aim in [0.0..1.0f64, 0.0..1.0f64],
        aims in any::<bool>(),
        shift in prop::sample::select(vec![0.0, 6.4e6]),
        exponents in prop::sample::select(vec![[0, 0], [0, 0], [-166, -166], [166, 166], [-166, 100], [-220, -220], [-60, -60]]),
    ) {
        let [size, length] = exponents.map(|exponent| 2f64.powi(exponent));
        let triangle = Triangle(corners.map(|corner| (DVec3::from(corner) + shift) * size));
        let mut numbers = numbers;
        for (x, width) in &mut numbers[..3] {
            (*x, *width) = ((*x + shift) * size, *width * size);
        }
        let mut numbers = if aims { aimed(&triangle, numbers, aim) } else { numbers };
        for (x, width) in &mut numbers[3..] {
            (*x, *width) = (*x * (if aims { length / size } else { length }), *width * length);
        }
        verdicts_hold(&triangle, numbers, [size, length])?;
    }
}

/// Aims a ray at a point close to the edge between the first corners, or inside.
fn aimed<V: Vector>(triangle: &Triangle<V>, mut numbers: [(f64, f64); 6], aim: [f64; 2]) -> [(f64, f64); 6] {
    let [a, b, c] = triangle.widen();
    let target = a + (b - a) * aim[0] + (c - a) * (aim[1] * aim[1] * (1.0 - aim[0]));
    for k in 0..3 {
        numbers[3 + k].0 = target[k] - numbers[k].0;
    }
    numbers
}

/// Parameters: numbers and half the widths of intervals around them, and the magnitudes of the triangle and of the
/// direction.
fn verdicts_hold<V: Vector>(
    triangle: &Triangle<V>,
    numbers: [(f64, f64); 6],
    [size, length]: [f64; 2],
) -> Result<(), TestCaseError> {
    let bounds = numbers.map(|(x, width)| Interval::between([x - width, x + width]));
    let [ox, oy, oz, dx, dy, dz] = bounds;
    let ray = EnclosedRay::new([ox, oy, oz], [dx, dy, dz]);
    let interval = [0.0, 8.0 * (size / length)].map(V::Real::rounded);
    let frame = V::frame(triangle.0);
    let region = Region::within(frame, &frame.aabb(triangle));
    let test = EnclosedTest::new(&ray, interval, &region);
    let (distance, blocks, weights) =
        (test.distance(triangle, interval[1]), test.blocks(triangle), test.weights(triangle));
    if (distance, blocks, weights) == (Certainty::Open, Certainty::Open, None) {
        return Ok(());
    }
    for corner in 0..65 {
        let pick = |k: usize| {
            let [lo, hi] = bounds[k].ends();
            if corner == 64 {
                lo * 0.5 + hi * 0.5
            } else if corner >> k & 1 == 0 {
                lo
            } else {
                hi
            }
        };
        let hit = truth(triangle, [0, 1, 2].map(pick), [3, 4, 5].map(pick)).filter(|hit| holds(interval, &hit.t));
        match blocks {
            Certainty::Hit(()) => prop_assert!(hit.is_some()),
            Certainty::Miss => prop_assert!(hit.is_none()),
            Certainty::Open => (),
        }
        match distance {
            Certainty::Hit(t) => prop_assert_eq!(hit.as_ref().map(|hit| V::Real::nearest(&hit.t)), Some(t)),
            Certainty::Miss => prop_assert!(hit.is_none()),
            Certainty::Open => (),
        }
        if let (Some([u, v]), Some(hit)) = (weights, hit) {
            prop_assert_eq!([u, v], [V::Real::nearest(&hit.u), V::Real::nearest(&hit.v)]);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40_000))]

    /// Half of the lines are aimed at a corner or at the midpoint of an edge, also with coordinates of all digits.
    #[test]
    fn sums_tell_of_every_ray_that_is_known_exactly(
        triangle in triangle(),
        o in [coordinate(), coordinate(), coordinate()],
        d in [coordinate(), coordinate(), coordinate()],
        aim in prop::option::of((0..3usize, any::<bool>())),
        ends in prop::option::of(any::<bool>()),
    ) {
        let (o, d) = match aim {
            Some((corner, is_corner)) => {
                let (corners, o) = (triangle.widen(), o.map(|x| f64::from(x as f32)));
                let (from, to) = (corners[corner], corners[(corner + 1) % 3]);
                let target = if is_corner { from } else { (from + to) * 0.5 };
                (o, (target - DVec3::from(o)).to_array())
            }
            None => (o, d),
        };
        prop_assume!(d != [0.0; 3]);
        let [origin, direction] = [o, d].map(|v| v.map(Interval::exact));
        // An end of the interval is at the hit.
        let at = match meet(triangle.widen().map(|corner| corner.to_array()), o, d) {
            Meeting::Hit(point) => round_f32(&point.t),
            _ => 1.0,
        };
        let interval = match ends {
            Some(true) => [at, f32::INFINITY],
            Some(false) => [-8.0, at],
            None => [-8.0, 8.0],
        };
        let test = EnclosedTest::new(&EnclosedRay::new(origin, direction), interval, &Region::of(&triangle.aabb()));
        let hit = meet(triangle.widen().map(|corner| corner.to_array()), o, d).within(interval);
        if !test.is_exact {
            // A subnormal number whose half is not representable.
            return Ok(());
        }
        let expected = hit.as_ref().map_or(Certainty::Miss, |hit| Certainty::Hit(round_f32(&hit.t)));
        prop_assert_eq!(test.settle(&triangle), expected);
        if let Some(hit) = hit {
            prop_assert_eq!(test.weights(&triangle), Some([round_f32(&hit.u), round_f32(&hit.v)]));
        }
    }
}

#[test]
fn numbers_beyond_the_range_are_left_open() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    let along = |z: f64, d: f64| {
        let exact = |v: [f64; 3]| v.map(Interval::exact);
        let ray = EnclosedRay::new(exact([0.25, 0.25, z]), exact([0.0, 0.0, d]));
        EnclosedTest::new(&ray, [0.0, f32::INFINITY], &Region::of(&triangle.aabb())).distance(&triangle, f32::INFINITY)
    };
    assert_eq!(along(-3.0, 1.0), Certainty::Hit(3.0));
    assert_eq!((along(-3.0, 1e-100), along(-1e100, 1.0)), (Certainty::Open, Certainty::Open));
    let nowhere = Interval::between([f64::NEG_INFINITY, f64::INFINITY]);
    let ray = EnclosedRay::new([nowhere; 3], [nowhere; 3]);
    let test = EnclosedTest::new(&ray, [0.0, 1.0], &Region::of(&triangle.aabb()));
    assert_eq!((test.distance(&triangle, 1.0), test.weights(&triangle)), (Certainty::Open, None));
}

/// A line through the midpoint of an edge, at the end of bounds with the greatest effect on the edge function. With
/// half of [`OFF_SIGN`](crate::geom::kernel::OFF_SIGN) the triangle would be missed.
#[test]
fn bounds_of_signs_are_needed() {
    let corners = [[64.9375, -62.9375, 63.0], [64.0, -64.0, 64.0], [66.0, -62.0, 62.0]];
    let (triangle, d) = (Triangle(corners.map(Vec3::from)), [65.0, -63.0, 63.0]);
    assert!(truth(&triangle, [0.0; 3], d).is_some());
    for off in [2f64.powi(-20), -2f64.powi(-20)] {
        let ends = |x: f64| Interval::between(if off > 0.0 { [x, x + 2.0 * off] } else { [x + 2.0 * off, x] });
        let ray = EnclosedRay::new([Interval::exact(0.0); 3], d.map(ends));
        assert_eq!(EnclosedTest::new(&ray, INTERVAL, &Region::of(&triangle.aabb())).blocks(&triangle), Certainty::Open);
    }
}

/// Of many rays, some have distances close to the midpoint of two floats. With half of
/// [`OFF`](crate::geom::kernel::OFF), for the determinant or for the distance, hundreds of distances reported as
/// certain would be wrong.
#[test]
fn bounds_of_distances_are_needed() {
    // The normal is (0, 2, 2), so the sum of all changes matters.
    let triangle = Triangle([Vec3::new(-1.0, 1.0, 3.0), Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.0, 2.0, 2.0)]);
    let region = Region::of(&triangle.aabb());
    let mut certain = 0;
    for step in 0..40_000 {
        let (height, off) = (f64::from(step) * 1e-5, 2f64.powi(-30) * (1.0 + f64::from(step % 97)));
        for of_origin in [true, false] {
            let exact = |v: [f64; 3]| v.map(Interval::exact);
            let (o, d) = ([-0.5, 0.5, 0.5 - height], [0.0, 0.25, 1.0]);
            let wide = |v: [f64; 3]| v.map(|x| Interval::between([x, x + 2.0 * off]));
            let (origin, direction) = if of_origin { (wide(o), exact(d)) } else { (exact(o), wide(d)) };
            let test = EnclosedTest::new(&EnclosedRay::new(origin, direction), INTERVAL, &region);
            if let Certainty::Hit(t) = test.distance(&triangle, 8.0) {
                certain += 1;
                assert_eq!(truth(&triangle, o, d).map(|hit| round_f32(&hit.t)), Some(t));
            }
        }
    }
    assert!(certain > 1000, "{certain}");
}

/// For an exact ray all answers are certain, except for hits at an end of the interval.
#[test]
fn only_the_ends_of_the_interval_are_left_open() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner * 4.0));
    let ray =
        |x: f64, y: f64| EnclosedRay::new([x, y, -2.0].map(Interval::exact), [0.0, 0.0, 1.0].map(Interval::exact));
    let test = |interval| EnclosedTest::new(&ray(1.0, 1.0), interval, &Region::of(&triangle.aabb()));
    let (below, above) = (2f32.next_down(), 2f32.next_up());
    for (interval, distance, blocks) in [
        ([0.0, 9.0], Certainty::Hit(2.0), Certainty::Hit(())),
        ([0.0, above], Certainty::Hit(2.0), Certainty::Hit(())),
        ([below, 9.0], Certainty::Hit(2.0), Certainty::Hit(())),
        ([0.0, 2.0], Certainty::Open, Certainty::Open),
        ([2.0, 9.0], Certainty::Open, Certainty::Open),
        ([2.0, 2.0], Certainty::Open, Certainty::Open),
        ([0.0, 1.0], Certainty::Miss, Certainty::Miss),
        ([3.0, 9.0], Certainty::Miss, Certainty::Miss),
    ] {
        let test = test(interval);
        assert_eq!((test.distance(&triangle, interval[1]), test.blocks(&triangle)), (distance, blocks), "{interval:?}");
    }
    // A closer hit ends the search. The triangle is missed only if that hit is closer than the triangle.
    let whole = test([0.0, 9.0]);
    assert_eq!([1.0, below, 2.0, 3.0].map(|limit| whole.distance(&triangle, limit) == Certainty::Hit(2.0)), [true; 4]);
    let at_end = test([2.0, 9.0]);
    assert_eq!(at_end.distance(&triangle, 1.0), Certainty::Miss);
    assert_eq!(at_end.distance(&triangle, 2.0), Certainty::Open);
    let weights = whole.weights(&triangle).expect("certain");
    assert_eq!(weights, [0.25, 0.25]);
    let beside = EnclosedTest::new(&ray(5.0, 5.0), [0.0, 9.0], &Region::of(&triangle.aabb()));
    assert_eq!((beside.distance(&triangle, 9.0), beside.settle(&triangle)), (Certainty::Miss, Certainty::Miss));
    // Bounds leave an edge undecided, and sums decide it.
    let edge = EnclosedTest::new(&ray(1.0, 0.0), [0.0, 9.0], &Region::of(&triangle.aabb()));
    assert_eq!((edge.distance(&triangle, 9.0), edge.blocks(&triangle)), (Certainty::Open, Certainty::Open));
    assert_eq!((edge.settle(&triangle), edge.weights(&triangle)), (Certainty::Hit(2.0), Some([0.25, 0.0])));
    assert_eq!([at_end.settle(&triangle), test([3.0, 9.0]).settle(&triangle)], [Certainty::Hit(2.0), Certainty::Miss]);
    // Weights are also uncertain if their bounds contain a midpoint between two floats.
    let about = |x: f64, off: f64| Interval::between([x - off, x + off]);
    for [of_x, of_y] in [[1e-5, 0.0], [0.0, 1e-5]] {
        let rays = EnclosedRay { origin: [about(1.0, of_x), about(1.0, of_y), Interval::exact(-2.0)], ..ray(1.0, 1.0) };
        let test = EnclosedTest::new(&rays, [0.0, 9.0], &Region::of(&triangle.aabb()));
        assert_eq!((test.blocks(&triangle), test.weights(&triangle)), (Certainty::Hit(()), None));
        assert_eq!(test.settle(&triangle), Certainty::Open);
    }
}

#[test]
fn directions_are_usual_from_one_end_of_the_range_to_the_other() {
    let asked = |size: f32, d: f64| {
        let triangle = Triangle([Vec3::ZERO, Vec3::X * size, Vec3::Y * size]);
        let size = f64::from(size);
        let ray = EnclosedRay::new(
            [size / 4.0, size / 4.0, -3.0 * size].map(Interval::exact),
            [0.0, 0.0, d].map(Interval::exact),
        );
        EnclosedTest::new(&ray, [0.0, f32::INFINITY], &Region::of(&triangle.aabb())).distance(&triangle, f32::INFINITY)
    };
    let ([small, great], [least, most]) = ([-100, 100].map(|k| 2f32.powi(k)), [-200, 200].map(|k| 2f64.powi(k)));
    assert_eq!([asked(small, least), asked(small, least.next_down())], [Certainty::Hit(3.0 * great), Certainty::Open]);
    assert_eq!([asked(great, most), asked(great, most.next_up())], [Certainty::Hit(3.0 * small), Certainty::Open]);
}

/// Close to an edge, on either side, where the bounds for the whole object are too coarse.
#[test]
fn what_the_object_leaves_open_its_triangle_decides() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner * 3.0));
    let wide = Aabb { lo: Vec3::splat(-1e6), hi: Vec3::splat(1e6) };
    for (y, distance, blocks) in
        [(0.001, Certainty::Hit(1.0), Certainty::Hit(())), (-0.001, Certainty::Miss, Certainty::Miss)]
    {
        let ray = Ray::within(Vec3::new(1.0, y, 1.0), Vec3::NEG_Z, 0.0, 9.0).expect("a ray");
        let test = EnclosedTest::new(&EnclosedRay::exact(&ray), [0.0, 9.0], &Region::of(&wide));
        assert_eq!((test.distance(&triangle, 9.0), test.blocks(&triangle)), (distance, blocks));
    }
}
