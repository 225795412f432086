use super::*;
use crate::generate::Rng;
use truth::{RBig, square_distance};

/// In -1..1, with 24 bits.
fn unit(random: &mut Rng) -> f32 {
    (random.bits() >> 39) as f32 / (1 << 24) as f32 - 1.0
}

fn vector(random: &mut Rng) -> Vec3 {
    Vec3::new(unit(random), unit(random), unit(random))
}

/// Any triangle and point of a kind, of ever other sizes.
fn case(random: &mut Rng, kind: usize) -> (Triangle, Vec3) {
    let scale = 2f32.powi((random.bits() % 120) as i32 - 60);
    let [a, b, c] = [(); 3].map(|()| vector(random));
    let triangle = match kind % 4 {
        // A sliver, a small one far away, and one on a grid.
        0 => [a, b, a.lerp(b, unit(random)) + c * 1e-6],
        1 => [a, b, c].map(|corner| corner * 1e-4 + Vec3::ONE),
        2 => [a, b, c].map(|corner| (corner * 4.0).round()),
        _ => [a, b, c],
    };
    let [u, v] = [unit(random).abs(), unit(random).abs()];
    let inside = triangle[0] + (triangle[1] - triangle[0]) * u + (triangle[2] - triangle[0]) * (v * (1.0 - u));
    let point = match kind / 4 % 5 {
        0 => vector(random) * 2.0,
        1 => triangle[0].lerp(triangle[1], u),
        2 => triangle[2],
        3 => inside,
        _ => inside + vector(random) * 1e-5,
    };
    (Triangle(triangle.map(|corner| corner * scale)), point * scale)
}

fn square(triangle: &Triangle, point: Vec3) -> RBig {
    square_distance(triangle.0.map(|corner| corner.to_array()), point.to_array()).expect("finite")
}

/// [NEAR-1]
#[test]
fn distances_are_the_truth_rounded() {
    let mut random = Rng::new(1);
    for kind in 0..20_000 {
        let (triangle, point) = case(&mut random, kind);
        let truth = truth::round_root_f32(&square(&triangle, point));
        let found = Measure::new(point, f32::INFINITY).distance(&triangle, f32::INFINITY);
        assert_eq!(found, Some(truth), "{triangle:?} {point}");
    }
}

#[test]
fn bounds_hold_the_truth_and_need_their_margin() {
    let (mut random, mut bare) = (Rng::new(2), 0);
    for kind in 0..20_000 {
        let (triangle, point) = case(&mut random, kind);
        let truth = square(&triangle, point);
        let corners = Measure::new(point, 1.0).relative(&triangle);
        let is_within = |[near, far]: [f64; 2]| {
            let [near, far] = [near, far].map(|bound| RBig::try_from(bound).expect("finite"));
            &near * &near <= truth && truth <= &far * &far
        };
        let [near, far] = bounds(&corners);
        if far.is_nan() {
            // No area: nothing is bounded, and rational arithmetic decides.
            continue;
        }
        assert!(is_within([near, far]), "{triangle:?} {point}");
        let margin = MARGIN * corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        bare += usize::from(!is_within([(near + margin).max(0.0), (far - margin).max(0.0)]));
    }
    assert!(bare > 100, "{bare}");
}

#[test]
fn boxes_are_not_farther_than_what_is_in_them() {
    let mut random = Rng::new(3);
    for kind in 0..20_000 {
        let (triangle, point) = case(&mut random, kind);
        let bound = RBig::try_from(Measure::new(point, 1.0).to_box(&triangle.aabb())).expect("finite");
        assert!(&bound * &bound <= square(&triangle, point), "{triangle:?} {point}");
    }
}

#[test]
fn the_ends_of_the_range() {
    let far = Triangle([Vec3::splat(f32::MAX), Vec3::new(f32::MAX, 0.0, 0.0), Vec3::new(0.0, f32::MAX, f32::MAX)]);
    let measure = Measure::new(Vec3::splat(-f32::MAX), f32::INFINITY);
    assert_eq!(measure.distance(&far, f32::INFINITY), Some(f32::INFINITY));
    assert_eq!(Measure::new(Vec3::splat(-f32::MAX), f32::MAX).distance(&far, f32::INFINITY), None);
    let least = f32::from_bits(1);
    let small = Triangle([Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * least));
    assert_eq!(Measure::new(Vec3::ZERO, 1.0).distance(&small, 1.0), Some(least));
    assert_eq!(Measure::new(Vec3::X * least, 0.0).distance(&small, 0.0), Some(0.0));
}

/// On weights that are not negative rests the upper bound. [NEAR-1]
#[test]
fn a_guess_above_the_triangle_has_weights_that_are_positive() {
    // Corners on a line but for rounding, beside which no edge is thought nearest: the first weight is rounded to 0.
    let needle = [
        DVec3::new(0.260_786_912_615_089_7, 0.580_635_970_183_850_9, -0.142_294_428_392_012_67),
        DVec3::new(-0.369_332_056_339_633_2, -0.413_501_223_746_040_6, 0.645_391_724_978_742),
        DVec3::new(-0.302_371_844_920_074_6, -0.307_858_257_948_615_93, 0.561_687_481_874_525_1),
    ];
    assert!(nearest(&needle).is_nan(), "{}", nearest(&needle));
    assert!(bounds(&needle)[1].is_nan());
}

/// The nearest point by another way: the foot on the plane if it is inside, else the nearest point of an edge.
fn nearest_by_edges([a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let foot = normal * (normal.dot(a) / normal.length_squared());
    let edges = [(a, b), (b, c), (c, a)];
    if edges.iter().all(|&(p, q)| normal.cross(q - p).dot(foot - p) >= 0.0) {
        return foot;
    }
    let of_edge = |(p, q): (DVec3, DVec3)| p + (q - p) * (-p.dot(q - p) / (q - p).length_squared()).clamp(0.0, 1.0);
    edges.map(of_edge).into_iter().min_by(|p, q| p.length().total_cmp(&q.length())).unwrap_or(a)
}

#[test]
fn the_nearest_point_is_that_of_the_plane_the_edges_and_the_corners() {
    let (mut random, mut regions) = (Rng::new(4), 0);
    for _ in 0..20_000 {
        let corners = [(); 3].map(|()| vector(&mut random).as_dvec3());
        if (corners[1] - corners[0]).cross(corners[2] - corners[0]).length() < 0.1 {
            continue;
        }
        let point = vector(&mut random) * 2.0;
        let triangle = Triangle(corners.map(DVec3::as_vec3));
        let relative = corners.map(|corner| corner - point.as_dvec3());
        let (expected, found) = (nearest_by_edges(relative), nearest(&relative));
        assert!((expected - found).length() < 1e-12, "{corners:?} {point}: {expected} {found}");
        let [near, far] = bounds(&relative);
        assert!(far - near < 1e-13 && near <= expected.length() && expected.length() <= far, "{near} {far}");
        let placed = Measure::new(point, 1.0).nearest(&triangle);
        assert!((placed.as_dvec3() - point.as_dvec3() - expected).length() < 1e-6);
        regions += 1;
    }
    assert!(regions > 15_000, "{regions}");
}

/// The margins are as they are derived.
#[test]
fn bounds_of_a_face_ahead() {
    let u = 2f64.powi(-53);
    let corners = [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(0.0, 1.0, 1.0)];
    assert_eq!(bounds(&corners), [1.0 - 72.0 * u, 1.0 + 72.0 * u]);
    let aabb = Aabb { lo: Vec3::ONE, hi: Vec3::splat(2.0) };
    assert_eq!(Measure::new(Vec3::new(1.5, 1.5, 0.0), 9.0).to_box(&aabb), 1.0 - 8.0 * u);
    assert_eq!(Measure::new(Vec3::new(1.5, 1.5, 4.0), 9.0).to_box(&aabb), 2.0 - 16.0 * u);
    let triangle = Triangle(corners.map(DVec3::as_vec3));
    for (limit, expected) in [(0.5, None), (1.0, Some(1.0)), (2.0, Some(1.0))] {
        assert_eq!(Measure::new(Vec3::ZERO, f32::INFINITY).distance(&triangle, limit), expected);
    }
}

/// Within the radius, where both bounds are the same float: then nothing is left to rational arithmetic.
#[test]
fn bounds_that_agree_within_the_radius_are_certain() {
    let measure = Measure::new(Vec3::ZERO, 2.0);
    let (below, above) = (1f32.next_down(), 1f32.next_up());
    for (bounds, expected) in [
        ([1.0; 2], true),
        ([0.0; 2], true),
        ([below, 1.0], false),
        ([1.0, above], false),
        ([2.0; 2], false),
        ([3.0; 2], false),
    ] {
        assert_eq!(measure.is_certain(bounds), expected, "{bounds:?}");
    }
}

fn true_point(triangle: &Triangle, point: Vec3) -> [u32; 3] {
    let nearest = truth::nearest_point(triangle.0.map(|corner| corner.to_array()), point.to_array()).expect("finite");
    nearest.each_ref().map(|x| (truth::round_f32(x) + 0.0).to_bits())
}

/// [NEAR-3]
#[test]
fn nearest_points_are_the_truth_rounded() {
    let mut random = Rng::new(6);
    let mut by_intervals = 0;
    for kind in 0..20_000 {
        let (triangle, point) = case(&mut random, kind);
        let found = Measure::new(point, 1.0).nearest(&triangle);
        assert_eq!(found.to_array().map(f32::to_bits), true_point(&triangle, point), "{triangle:?} {point}: {found}");
        let ends = point::enclose(&triangle, point);
        by_intervals += usize::from(ends.is_some_and(|ends| ends.into_iter().all(|ends| one_float(ends).is_some())));
    }
    assert!(by_intervals > 10_000, "{by_intervals}");
}

/// A needle whose corners round to two seen from the point, and one that is long where its corners differ least.
#[test]
fn nearest_points_of_needles_with_their_corners_in_any_order() {
    let needles = [
        ([[0.0, 1.0, 0.0], [6.123_234e-17, 1.0, 0.0], [1.0, 2.0, 0.0]], [5.0, 0.5, 0.0]),
        ([[-0.2, -40_265_320.0, 0.5], [0.5, 33_554_432.0, 0.5], [-0.2, 33_554_432.0, 0.8]], [0.3, 20_132_660.0, 0.7]),
        // Twice the same corner: no area, so no hierarchy holds it.
        ([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0, 0.0, 1.0]),
    ];
    for (corners, point) in needles {
        let ([a, b, c], point) = (corners.map(Vec3::from_array), Vec3::from_array(point));
        for order in [[a, b, c], [b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]] {
            let (triangle, measure) = (Triangle(order), Measure::new(point, f32::INFINITY));
            let found = measure.nearest(&triangle).to_array().map(f32::to_bits);
            assert_eq!(found, true_point(&triangle, point), "{triangle:?} {point}");
        }
    }
}

#[test]
fn a_float_is_certain_where_all_between_round_to_it() {
    let above = 1.0 + 2f64.powi(-24);
    assert_eq!([[1.0, above], [1.0, above.next_up()], [-1e-50, -1e-60]].map(one_float), [Some(1.0), None, Some(0.0)]);
    assert_eq!(one_float([-1e-60, 1e-60]).map(f32::to_bits), Some(0));
    assert_eq!([[f64::NAN, 1.0], [1.0, f64::NAN]].map(one_float), [None; 2]);
    let measure = Measure::new(Vec3::ZERO, 1.0);
    assert!(measure.nearest(&Triangle([Vec3::X, Vec3::Y, Vec3::NAN])).is_nan());
}
