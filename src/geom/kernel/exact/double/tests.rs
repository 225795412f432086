use super::*;
use crate::generate::{Rng, Source as _};
use crate::geom::Ray;

/// [EXACT-8]
///
/// Where products of three numbers begin to lose digits: the points' unit cubed, or squared times the direction's.
#[test]
fn sums_have_room_for_all_digits() {
    let [least, most] = [-252, 200].map(|exponent| 2f64.powi(exponent));
    for k in 0..3 {
        let with = |x: f64| {
            let mut v = DVec3::new(1.0, -2.0, 0.0);
            v[k] = x;
            v
        };
        for x in [0.0, -0.0, 1.0, least, -least, 3.0 * least, most, -most] {
            assert!(can_sum(&[DVec3::X, with(x)], DVec3::ONE), "{x}");
        }
        for x in [least / 2.0, -1.5 * least, 5e-324, most.next_up(), f64::MAX] {
            assert!(!can_sum(&[DVec3::X, with(x)], DVec3::ONE), "{x}");
        }
        for (place, way) in [(0, -756), (-1, -754), (-100, -556), (-252, -252)] {
            let [x, d] = [place, way].map(|exponent| 2f64.powi(exponent));
            assert!(can_sum(&[with(x)], with(-d)) && !can_sum(&[with(x)], with(0.5 * d)), "{place} {way}");
        }
        assert!(can_sum(&[DVec3::X], with(most)) && !can_sum(&[DVec3::X], with(-most.next_up())));
    }
}

/// [EXACT-10]
///
/// Of a component next to nothing, sums have no room for all digits.
#[test]
fn twice_the_digits_tell_what_a_component_next_to_nothing_does() {
    let corners = [DVec3::ZERO, DVec3::Y, DVec3::X];
    for (x, is_inside) in [(1e-260, true), (-1e-260, false)] {
        let ray = Ray::new(DVec3::new(0.0, 0.3, -0.1), DVec3::new(x, 0.0, 1.0)).expect("a ray");
        let exact = Exact64::new(&ray, &Region::of(&Triangle(corners).aabb()));
        assert!(!exact.can_sum(&Triangle(corners)));
        assert_eq!(exact.is_inside(&Triangle(corners)), Some(is_inside), "{x}");
        assert_eq!(exact.distance(&Triangle(corners), f64::INFINITY), is_inside.then_some(0.1), "{x}");
    }
}

/// [EXACT-12]
///
/// Where all corners and the origin are 0, no unit is better than another: rationals are asked at once.
#[test]
fn what_is_nothing_is_not_scaled_again_and_again() {
    let shape = Triangle([DVec3::ZERO; 3]);
    for d in [DVec3::new(1.0, 1e-300, 0.0), DVec3::new(-1e300, 5e-324, 1.0), DVec3::splat(1e-310)] {
        let exact = Exact64::new(&Ray::new(DVec3::ZERO, d).expect("a ray"), &Region::of(&shape.aabb()));
        assert_eq!(exact.distance(&shape, f64::INFINITY), None, "{d}");
        assert_eq!([exact.blocks(&shape), exact.crosses(&shape)], [false; 2], "{d}");
    }
}

/// [EXACT-12]
///
/// Numbers of all sizes, in triangles that rays hit, graze and miss.
#[test]
fn other_units_give_the_answer_of_rationals() {
    let mut rng = Rng::new(12);
    let (mut scaled, mut rational, mut hits) = (0, 0, 0);
    for case in 0..20_000 {
        let [place, way] = [(); 2].map(|()| rng.below(1400) as i32 - 700);
        let (ray, shape) = aimed(&mut rng, [place, way], case % 4 == 0);
        let (corners, o, d) = (shape.0.map(|v| v.to_array()), ray.origin().to_array(), ray.direction().to_array());
        let exact = Exact64::new(&ray, &Region::of(&Triangle([DVec3::ZERO; 3]).aabb()));
        let expected = match truth::meet(corners, o, d) {
            Meeting::Hit(point) => Some(point).filter(|point| truth::holds([ray.tmin(), ray.tmax()], &point.t)),
            Meeting::Miss | Meeting::Coplanar => None,
        };
        let t = expected.as_ref().map(|point| truth::round_f64(&point.t));
        assert_eq!(exact.distance(&shape, f64::INFINITY), t, "{ray:?} {shape:?}");
        assert_eq!(exact.blocks(&shape), t.is_some(), "{ray:?} {shape:?}");
        let crosses = t.is_some() && parity::is_crossed_in_rationals(&shape.0, ray.origin(), ray.direction());
        assert_eq!(exact.crosses(&shape), crosses, "{ray:?} {shape:?}");
        if let Some(Point { u, v, .. }) = expected {
            assert_eq!(exact.weights(&shape), [&u, &v].map(truth::round_f64), "{ray:?} {shape:?}");
            hits += 1;
        }
        let [a, b, c] = corners;
        let on_a_line = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| truth::meet([a, b, c], a, axis.to_array()));
        assert_eq!(is_degenerate_64(&shape.0), on_a_line == [const { Meeting::Coplanar }; 3], "{shape:?}");
        match exact.scaled(&shape) {
            Some(Scaled { exact, shape, .. }) if exact.can_sum(&shape) => scaled += 1,
            _ => rational += 1,
        }
    }
    assert!(hits > 8_000 && scaled > 15_000 && rational > 500, "{hits} {scaled} {rational}");
}

/// [EXACT-12]
///
/// Between the units of a huge triangle and those of its ray a distance near 1 is subnormal.
#[test]
fn a_distance_is_not_rounded_to_fewer_digits_in_other_units() {
    let corners = [DVec3::Y * 1.35, DVec3::X * 1e60, DVec3::NEG_X * f64::MAX];
    let ray = Ray::new(DVec3::Z, DVec3::Z * -0.814_679_627_926_693_7).expect("a ray");
    let exact = Exact64::new(&ray, &Region::of(&Triangle([DVec3::ZERO; 3]).aabb()));
    assert_eq!(exact.distance(&Triangle(corners), f64::INFINITY), Some(1.0 / 0.814_679_627_926_693_7));
}

/// A ray at a corner, at an edge or inside of a triangle, or beside it; in the units 2^place and 2^way. If they are
/// mixed, some numbers are far smaller than others.
fn aimed(rng: &mut Rng, [place, way]: [i32; 2], is_mixed: bool) -> (Ray<DVec3>, Triangle<DVec3>) {
    loop {
        let mut number = |limit: u64| {
            let x = rng.below(limit) as f64 - (limit / 2) as f64;
            if is_mixed && rng.below(4) == 0 { x * 2f64.powi(-(rng.below(700) as i32)) } else { x }
        };
        let limit = if number(2) == 0.0 { 8 } else { 1 << 40 };
        let [a, b, c, o] = [(); 4].map(|()| DVec3::new(number(limit), number(limit), number(limit)));
        let target = match number(6) as i32 {
            0 => a,
            1 => (a + b) * 0.5,
            -1 => a + b - c,
            _ => a * 0.5 + b * 0.25 + c * 0.25,
        };
        let d = target - o;
        let (unit, pace) = (2f64.powi(place), 2f64.powi(way));
        // The target is at 1.
        let ends = [[0.0, f64::INFINITY], [0.0, 1.0], [1.0, f64::INFINITY], [0.5, 1.0], [1.0, 1.0], [0.0, 0.5]];
        let [start, end] = ends[(number(6) + 3.0) as usize];
        let times = |t: f64| t * 2f64.powi((place - way).clamp(-1000, 1000));
        if let Ok(ray) = Ray::within(o * unit, d * pace, times(start), times(end)) {
            return (ray, Triangle([a, b, c].map(|corner| corner * unit)));
        }
    }
}
