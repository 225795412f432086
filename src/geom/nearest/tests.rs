use super::*;
use crate::generate::{Rng, Source};
use truth::square_distance;

/// Draws a number in -1..1 with 24 bits.
fn unit(random: &mut Rng) -> f64 {
    ((random.bits() >> 39) as f32 / (1 << 24) as f32 - 1.0).into()
}

pub(super) fn vector(random: &mut Rng) -> DVec3 {
    DVec3::new(unit(random), unit(random), unit(random))
}

pub(super) fn narrow<V: Vector>(v: DVec3) -> V {
    V::from_components(v.to_array().map(V::Real::rounded))
}

/// Draws a triangle and a point of a kind, of varying magnitude, in double precision also far away.
pub(super) fn case<V: Vector>(random: &mut Rng, kind: usize) -> (Triangle<V>, V) {
    let is_double = size_of::<V>() == size_of::<DVec3>();
    let powers = if is_double && kind.is_multiple_of(7) { 332 } else { 120 };
    let scale = 2f64.powi((random.bits() % powers) as i32 - powers as i32 / 2);
    let far = [0.0, 6.4e6, 1e9][if is_double { kind / 20 % 3 } else { 0 }] * vector(random);
    // With more bits than single precision.
    let [a, b, c] = [(); 3].map(|()| vector(random) + vector(random) * 2f64.powi(-25));
    let triangle = match kind % 4 {
        // A thin triangle, a small one far away, and one on a grid.
        0 => [a, b, a.lerp(b, unit(random)) + c * 1e-6],
        1 => [a, b, c].map(|corner| corner * 1e-4 + DVec3::ONE),
        2 => [a, b, c].map(|corner| (corner * 4.0).round()),
        _ => [a, b, c],
    };
    // Rounds the corners.
    let place = |v: DVec3| narrow::<V>((v + far) * scale);
    let corners = triangle.map(place);
    let [a, b, c] = corners.map(V::widen);
    let [u, v] = [unit(random).abs(), unit(random).abs()];
    let inside = a + (b - a) * u + (c - a) * (v * (1.0 - u));
    let point = match kind / 4 % 5 {
        0 => place(vector(random) * 2.0),
        1 => narrow(a.lerp(b, if kind % 8 < 4 { u } else { 0.5 })),
        2 => corners[2],
        3 => narrow(inside),
        _ => narrow(inside + vector(random) * 1e-5 * scale),
    };
    (Triangle(corners), point)
}

pub(super) fn square<V: Vector>(triangle: &Triangle<V>, point: V) -> RBig {
    square_distance(triangle.0.map(V::components), point.components()).expect("finite")
}

fn relative<V: Vector>(triangle: &Triangle<V>, point: V) -> [DVec3; 3] {
    triangle.widen().map(|corner| corner - point.widen())
}

/// Returns the number of distances that were settled without rational arithmetic.
fn distances<V: Vector>() -> usize {
    let mut random = Rng::new(1);
    (0..20_000)
        .filter(|&kind| {
            let (triangle, point) = case::<V>(&mut random, kind);
            let truth = truth::round_root(&square(&triangle, point));
            let measure = Measure::new(point, V::Real::INFINITY);
            assert_eq!(measure.distance(&triangle, V::Real::INFINITY), Some(truth), "{triangle:?} {point:?}");
            let fine = measure.fine(&triangle);
            assert!(fine.is_none_or(|fine| fine == truth), "{triangle:?} {point:?} {fine:?}");
            fine.is_some()
        })
        .count()
}

/// [NEAR-1] [NEAR-5]
#[test]
fn distances_are_the_truth_rounded() {
    let settled = [distances::<Vec3>(), distances::<DVec3>()];
    assert!(settled[0] > 14_000 && settled[1] > 9_000, "{settled:?}");
}

fn check_bounds<V: Vector>() -> usize {
    let (mut random, mut bare) = (Rng::new(2), 0);
    for kind in 0..20_000 {
        let (triangle, point) = case::<V>(&mut random, kind);
        let (truth, corners) = (square(&triangle, point), relative(&triangle, point));
        let is_within = |[near, far]: [f64; 2]| {
            let [near, far] = [near, far].map(|bound| RBig::try_from(bound).expect("finite"));
            &near * &near <= truth && truth <= &far * &far
        };
        let [near, far] = bounds(&corners);
        if far.is_nan() {
            // Without area there are no bounds, and rational arithmetic decides.
            continue;
        }
        assert!(is_within([near, far]), "{triangle:?} {point:?}");
        let margin = MARGIN * corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        bare += usize::from(!is_within([(near + margin).max(0.0), (far - margin).max(0.0)]));
    }
    bare
}

#[test]
fn bounds_hold_the_truth_and_need_their_margin() {
    let bare = [check_bounds::<Vec3>(), check_bounds::<DVec3>()];
    assert!(bare.into_iter().all(|bare| bare > 100), "{bare:?}");
}

/// Outside the range, products may overflow or underflow.
#[test]
fn bounds_are_for_a_range() {
    let corners = [DVec3::new(1.0, 0.0, 0.5), DVec3::new(0.0, 1.0, 0.5), DVec3::new(-1.0, -1.0, 0.5)];
    let far = |power| bounds(&corners.map(|corner| corner * 2f64.powi(power)))[1];
    assert_eq!([-201, -200, 200, 201].map(|power| far(power).is_nan()), [true, false, false, true]);
}

fn check_boxes<V: Vector>() {
    let mut random = Rng::new(3);
    for kind in 0..20_000 {
        let (triangle, point) = case::<V>(&mut random, kind);
        let bound = RBig::try_from(Measure::new(point, V::Real::default()).to_box(&triangle.aabb())).expect("finite");
        assert!(&bound * &bound <= square(&triangle, point), "{triangle:?} {point:?}");
    }
}

#[test]
fn boxes_are_not_farther_than_what_is_in_them() {
    check_boxes::<Vec3>();
    check_boxes::<DVec3>();
}

/// Squares of doubles overflow or underflow, or boxes are unbounded.
#[test]
fn boxes_are_not_farther_at_the_ends_of_the_range() {
    let below = |distance: f64| distance * (1.0 - 8.0 * UNIT);
    let aabb = |lo: f32, hi: f32| Aabb { lo: Vec3::splat(lo), hi: Vec3::splat(hi) };
    let to_box = |x: f64, aabb: &Aabb| Measure::new(DVec3::splat(x), 0.0).to_box(aabb);
    let is_just_below = |found: f64, exact: f64| below(exact) * (1.0 - 8.0 * UNIT) <= found && found < exact;
    assert!(is_just_below(to_box(1e300, &aabb(0.0, 1.0)), 3f64.sqrt() * 1e300));
    assert!(is_just_below(to_box(-1e-200, &aabb(0.0, 1.0)), 3f64.sqrt() * 1e-200));
    assert_eq!(to_box(-f64::MAX, &aabb(f32::MAX, f32::INFINITY)), below(f64::MAX));
    assert_eq!(to_box(1e300, &aabb(f32::MAX, f32::INFINITY)), 0.0);
    assert_eq!(to_box(-1e300, &aabb(f32::NEG_INFINITY, -1.0)), 0.0);
    assert_eq!(to_box(-1e-300, &aabb(0.0, 1.0)), below(1e-300));
}

/// Draws a thin or a broad triangle, of any magnitude, and a point close to its first corner.
fn beside_a_corner(random: &mut Rng, round: i32) -> ([DVec3; 3], DVec3) {
    let [b, c, way] = [vector(random), vector(random), vector(random)];
    let c = if round % 3 == 0 { b.lerp(c, 1e-5) } else { c };
    let flat = DVec3::new(1.0, 1.0, if round % 5 == 0 { 0.0 } else { 1.0 });
    let (size, near) = (2f64.powi(round * 7 % 300 - 150), 2f64.powi(-(round % 40)));
    let a = if round % 2 == 0 { DVec3::ZERO } else { vector(random) };
    ([DVec3::ZERO, b * flat, c * flat].map(|v| (v + a) * size), (a + way * near * flat) * size)
}

/// Returns the number of bounds above the exact distance.
fn wrong_cones(margin: f64) -> usize {
    let mut random = Rng::new(13);
    (0..60_000)
        .filter(|&round| {
            let (corners, point) = beside_a_corner(&mut random, round);
            [0, 1, 2].into_iter().any(|first| {
                let turned = [0, 1, 2].map(|k| corners[(first + k) % 3]);
                let bound = RBig::try_from(cone::seen_from(turned, point, margin)).expect("finite");
                &bound * &bound > square(&Triangle(corners), point)
            })
        })
        .count()
}

/// [NEAR-7]
#[test]
fn cones_are_not_farther_than_the_triangle_and_need_a_margin() {
    assert_eq!([wrong_cones(cone::MARGIN), wrong_cones(cone::MARGIN / 8.0)], [0, 0]);
    assert!(wrong_cones(0.0) > 1000, "{}", wrong_cones(0.0));
}

/// The bounds for the whole triangle leave these cases undecided, and double-double arithmetic is not needed. [NEAR-7]
#[test]
fn cones_tell_the_needles_at_the_pole_of_a_fan_apart() {
    let point = DVec3::new(1e-30, 2e-30, 0.0);
    let told = (0..1000u32).filter(|&i| {
        let spoke = |i: u32| {
            let angle = f64::from(i) / 1000.0 * std::f64::consts::TAU;
            DVec3::new(angle.cos(), angle.sin(), 0.0).as_vec3().as_dvec3()
        };
        let corners = [spoke(i), spoke(i + 1), DVec3::ZERO];
        let bound = cone::least_distance(&corners, point);
        assert!(RBig::try_from(bound * bound).expect("finite") <= square(&Triangle(corners), point) || bound < 1e-40);
        bounds(&corners.map(|corner| corner - point))[0] == 0.0 && bound > 0.0
    });
    assert!(told.count() >= 998);
}

/// If products may overflow or underflow, the bound is trivial. [NEAR-7]
#[test]
fn cones_are_for_a_range() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let bound = |power, way: f64| cone::least_distance(&corners.map(|v| v * 2f64.powi(power)), DVec3::splat(-way));
    assert_eq!([-201, -200, 199, 201].map(|power| bound(power, 2f64.powi(power)) > 0.0), [false, true, true, false]);
    assert_eq!([0.0, 2f64.powi(-201)].map(|way| bound(0, way)), [0.0; 2]);
    assert!(bound(0, 2f64.powi(-200)) > 0.0);
    // Along an edge, the distance across it is 0.
    assert_eq!(cone::least_distance(&corners, DVec3::X * 0.25), 0.0);
}

/// For any two doubles, and for corners and points of any magnitude, distance and point are correctly rounded.
#[test]
fn doubles_of_all_sizes_have_the_true_distance_and_point() {
    let mut random = Rng::new(11);
    let mut number = || {
        let x = f64::from_bits(random.bits());
        if x.is_finite() && random.below(5) > 0 { x } else { [0.0, 1.0, f64::MAX, 5e-324][random.below(4) as usize] }
    };
    for _ in 0..2000 {
        let mut vector = || DVec3::new(number(), number(), number());
        let (triangle, point) = (Triangle([vector(), vector(), vector()]), vector());
        let measure = Measure::new(point, f64::INFINITY);
        let truth = truth::round_root(&square(&triangle, point));
        assert_eq!(measure.distance(&triangle, f64::INFINITY), Some(truth), "{triangle:?} {point}");
        assert_eq!(bits(measure.nearest(&triangle)), true_point(&triangle, point), "{triangle:?} {point}");
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

/// The upper bound depends on non-negative weights. [NEAR-1]
#[test]
fn a_guess_above_the_triangle_has_weights_that_are_positive() {
    // The corners are nearly collinear, and no edge seems nearest. The first weight rounds to 0.
    let needle = [
        DVec3::new(0.260_786_912_615_089_7, 0.580_635_970_183_850_9, -0.142_294_428_392_012_67),
        DVec3::new(-0.369_332_056_339_633_2, -0.413_501_223_746_040_6, 0.645_391_724_978_742),
        DVec3::new(-0.302_371_844_920_074_6, -0.307_858_257_948_615_93, 0.561_687_481_874_525_1),
    ];
    assert!(nearest(&needle).is_nan(), "{}", nearest(&needle));
    assert!(bounds(&needle)[1].is_nan());
}

/// Finds the nearest point by another method: the foot on the plane if it is inside, otherwise the nearest point of an
/// edge.
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
        let corners = [(); 3].map(|()| vector(&mut random));
        if (corners[1] - corners[0]).cross(corners[2] - corners[0]).length() < 0.1 {
            continue;
        }
        let point = (vector(&mut random) * 2.0).as_vec3();
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

/// The margins equal the derived ones.
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

/// Both bounds round to the same float within the radius, so no other stage is needed.
#[test]
fn bounds_that_agree_within_the_radius_are_certain() {
    let (single, double) = (Measure::new(Vec3::ZERO, 2.0), Measure::new(DVec3::ZERO, 2.0));
    let step = f64::from(f32::EPSILON);
    for (near, far, of_single, of_double) in [
        (1.0, 1.0, Some(1.0), Some(1.0)),
        (0.0, 0.0, Some(0.0), Some(0.0)),
        (1.0 - step, 1.0, None, None),
        (1.0, 1.0 + step, None, None),
        (1.0, 1.0 + step / 4.0, Some(1.0), None),
        (2.0, 2.0, None, None),
        (3.0, 3.0, None, None),
    ] {
        let bounds = [[near, 0.0], [far, 0.0]];
        assert_eq!((single.certain(bounds), double.certain(bounds)), (of_single, of_double), "{bounds:?}");
    }
}

pub(super) fn bits<V: Vector>(v: V) -> [u64; 3] {
    v.components().map(|x| Into::<f64>::into(x).to_bits())
}

pub(super) fn true_point<V: Vector>(triangle: &Triangle<V>, point: V) -> [u64; 3] {
    let nearest = truth::nearest_point(triangle.0.map(V::components), point.components()).expect("finite");
    nearest.each_ref().map(|x| (V::Real::nearest(x).into() + 0.0).to_bits())
}

/// Returns the nearest point from one kind of bounds, if they determine it.
pub(super) fn enclosed<E: Enclosure, V: Vector>(corners: &[DVec3; 3], point: DVec3) -> Option<[V::Real; 3]> {
    rounded(Parts::certified::<E>(corners, point)?.foot::<E>(corners, point)?)
}

/// Returns the numbers of points settled by doubles, and by doubles or more digits.
fn check_points<V: Vector>() -> [usize; 2] {
    let (mut random, mut settled) = (Rng::new(6), [0; 2]);
    for kind in 0..20_000 {
        let (triangle, point) = case::<V>(&mut random, kind);
        let found = Measure::new(point, V::Real::default()).nearest(&triangle);
        assert_eq!(bits(found), true_point(&triangle, point), "{triangle:?} {point:?}: {found:?}");
        let (corners, p) = (triangle.widen(), point.widen());
        let by_doubles = enclosed::<Rough, V>(&corners, p);
        let by_digits = enclosed::<Fine, V>(&corners, p);
        for found in by_doubles.into_iter().chain(by_digits) {
            assert_eq!(bits(V::from_components(found)), true_point(&triangle, point), "{triangle:?} {point:?}");
        }
        settled[0] += usize::from(by_doubles.is_some());
        settled[1] += usize::from(by_doubles.or(by_digits).is_some());
    }
    settled
}

/// [NEAR-3] [NEAR-5]
#[test]
fn nearest_points_are_the_truth_rounded() {
    let [single, double] = [check_points::<Vec3>(), check_points::<DVec3>()];
    assert!(single[0] > 10_000 && single[1] > single[0], "{single:?}");
    assert!(double[0] > 1000 && double[1] > 15_000, "{double:?}");
}

/// A thin triangle with two corners that look equal from the point, and one that is long in the axis where its corners
/// differ least.
#[test]
fn nearest_points_of_needles_with_their_corners_in_any_order() {
    let needles = [
        ([[0.0, 1.0, 0.0], [6.123_234e-17, 1.0, 0.0], [1.0, 2.0, 0.0]], [5.0, 0.5, 0.0]),
        ([[-0.2, -40_265_320.0, 0.5], [0.5, 33_554_432.0, 0.5], [-0.2, 33_554_432.0, 0.8]], [0.3, 20_132_660.0, 0.7]),
        // Two equal corners: no area.
        ([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0, 0.0, 1.0]),
    ];
    for (corners, point) in needles {
        let ([a, b, c], point) = (corners.map(Vec3::from_array), Vec3::from_array(point));
        for order in [[a, b, c], [b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]] {
            let (triangle, measure) = (Triangle(order), Measure::new(point, f32::INFINITY));
            assert_eq!(bits(measure.nearest(&triangle)), true_point(&triangle, point), "{triangle:?} {point}");
        }
    }
}

#[test]
fn a_float_is_certain_where_all_between_round_to_it() {
    let above = 1.0 + 2f64.powi(-24);
    let single = |ends: [f64; 2]| f32::between(ends.map(|end| [end, 0.0]));
    assert_eq!([[1.0, above], [1.0, above.next_up()], [-1e-50, -1e-60]].map(single), [Some(1.0), None, Some(0.0)]);
    assert_eq!(single([-1e-60, 1e-60]).map(f32::to_bits), Some(0));
    assert_eq!([[f64::NAN, 1.0], [1.0, f64::NAN]].map(single), [None; 2]);
    // The remainder on one side of the midpoint between two floats decides, although the sum rounds to the midpoint.
    assert_eq!(f32::between([[1.0, 0.0], [above, -1e-30]]), Some(1.0));
    assert_eq!(f32::between([[1.0, 0.0], [above, 1e-30]]), None);
    assert_eq!(f64::between([[1.0, -1e-17], [1.0, 1e-17]]), Some(1.0));
    assert_eq!(f64::between([[1.0, 0.0], [1f64.next_up(), 0.0]]), None);
    assert_eq!(f64::between([[-0.0, 0.0]; 2]).map(f64::to_bits), Some(0));
    let measure = Measure::new(Vec3::ZERO, 1.0);
    assert!(measure.nearest(&Triangle([Vec3::X, Vec3::Y, Vec3::NAN])).is_nan());
    let measure = Measure::new(DVec3::ZERO, 1.0);
    assert!(measure.nearest(&Triangle([DVec3::X, DVec3::Y, DVec3::NAN])).is_nan());
}
