use glam::Vec3;

use super::*;
use crate::generate::{Rng, Source as _};
use crate::geom::truth::{self, Meeting, Point, RBig};
use crate::geom::{Aabb, Frame};

/// [EXACT-8]
///
/// An almost vanishing component decides.
#[test]
fn a_component_next_to_nothing_counts() {
    let corners = [DVec3::ZERO, DVec3::Y, DVec3::X];
    for (x, is_inside) in [(1e-260, true), (-1e-260, false), (5e-324, true), (-5e-324, false)] {
        let ray = Ray::new(DVec3::new(0.0, 0.3, -0.1), DVec3::new(x, 0.0, 1.0)).expect("a ray");
        let exact = Exact64::new(&ray, &Region::of(&Triangle(corners).aabb()));
        assert_eq!(exact.distance(&Triangle(corners), f64::INFINITY), is_inside.then_some(0.1), "{x}");
    }
}

/// All corners and the origin are 0.
#[test]
fn what_is_nothing_is_missed() {
    let shape = Triangle([DVec3::ZERO; 3]);
    for d in [DVec3::new(1.0, 1e-300, 0.0), DVec3::new(-1e300, 5e-324, 1.0), DVec3::splat(1e-310)] {
        let exact = Exact64::new(&Ray::new(DVec3::ZERO, d).expect("a ray"), &Region::of(&shape.aabb()));
        assert_eq!(exact.distance(&shape, f64::INFINITY), None, "{d}");
        assert_eq!([exact.blocks(&shape), exact.crosses(&shape)], [false; 2], "{d}");
    }
}

/// [EXACT-8]
///
/// Numbers of all magnitudes, in triangles that rays hit, graze and miss.
#[test]
fn the_answer_is_that_of_rationals() {
    let mut rng = Rng::new(12);
    let (mut hits, mut crossings, mut staged) = (0, 0, 0);
    let nothing = Region::of(&Triangle([DVec3::ZERO; 3]).aabb());
    let all = |place: i32| {
        let most = Vec3::splat(2f32.powi(40));
        Region::within(Frame::new(DVec3::ZERO, place).expect("a frame"), &Aabb { lo: -most, hi: most })
    };
    for case in 0..20_000 {
        let [place, way] = [(); 2].map(|()| rng.below(1400) as i32 - 700);
        let (ray, shape) = aimed(&mut rng, [place, way], case % 4 == 0);
        let (corners, o, d) = (shape.0.map(|v| v.to_array()), ray.origin().to_array(), ray.direction().to_array());
        let expected = truth::meet(corners, o, d).within([ray.tmin(), ray.tmax()]);
        let t = expected.as_ref().map(|point| truth::round_f64(&point.t));
        let crosses = t.is_some() && is_crossed_in_rationals(&shape.0, ray.origin(), ray.direction());
        let weights = expected.map(|Point { u, v, .. }| [&u, &v].map(truth::round_f64));
        // By sums alone, if the region is unsuitable for the filters, and by all stages.
        for (is_staged, region) in [(false, nothing), (true, all(place))] {
            let exact = Exact64::new(&ray, &region);
            assert_eq!(exact.distance(&shape, f64::INFINITY), t, "{ray:?} {shape:?}");
            assert_eq!(exact.blocks(&shape), t.is_some(), "{ray:?} {shape:?}");
            assert_eq!(exact.crosses(&shape), crosses, "{ray:?} {shape:?}");
            if let Some(weights) = weights {
                assert_eq!(exact.weights(&shape), weights, "{ray:?} {shape:?}");
            }
            staged += u32::from(is_staged && exact.can_filter(&shape));
        }
        (hits, crossings) = (hits + u32::from(t.is_some()), crossings + u32::from(crosses));
        let [a, b, c] = corners;
        let on_a_line = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| truth::meet([a, b, c], a, axis.to_array()));
        assert_eq!(predicates::is_degenerate(&shape.0), on_a_line == [const { Meeting::Coplanar }; 3], "{shape:?}");
    }
    assert!(hits > 8_000 && (4_000..hits).contains(&crossings) && staged > 500, "{hits} {crossings} {staged}");
}

/// The stages are used if direction, distance, scene and the longest edge are within 2^-200 to 2^200. [EXACT-7]
#[test]
fn stages_are_asked_within_their_range() {
    let power = |exponent: i32| 2f64.powi(exponent);
    let is_usual = |d: f64, o: f64, exponent: i32| {
        let frame = Frame::new(DVec3::ZERO, exponent).expect("a frame");
        let ray = Ray::new(DVec3::X * o, DVec3::Y * d).expect("a ray");
        Exact64::new(&ray, &Region::within(frame, &Aabb { lo: Vec3::ZERO, hi: Vec3::ONE })).is_usual
    };
    let (least, most) = (power(-200), power(200));
    for (d, o, exponent) in [(1.0, 0.0, 0), (least, 0.0, 0), (most, 0.0, 0), (1.0, most / 2.0, 0), (1.0, 0.0, -200)] {
        assert!(is_usual(d, o, exponent), "{d} {o} {exponent}");
    }
    let beyond = [(least.next_down(), 0.0, 0), (most.next_up(), 0.0, 0), (1.0, most, 0), (1.0, 1.0, -201)];
    for (d, o, exponent) in beyond {
        assert!(!is_usual(d, o, exponent), "{d} {o} {exponent}");
    }
    let has_usual_edges = |e1: f64, e2: f64| has_usual_edges(&[DVec3::ZERO, DVec3::X * e1, DVec3::Y * e2]);
    for [short, long] in [[5e-324, least], [1.0, most], [0.0, 1.0]] {
        assert!(has_usual_edges(short, long) && has_usual_edges(long, short), "{short} {long}");
    }
    for [short, long] in [[0.0, least.next_down()], [1.0, most.next_up()]] {
        assert!(!has_usual_edges(short, long) && !has_usual_edges(long, short), "{short} {long}");
    }
}

/// The moved line of [PARITY-1], by rational arithmetic.
fn is_crossed_in_rationals(corners: &[DVec3; 3], o: DVec3, d: DVec3) -> bool {
    let rational = |v: DVec3| v.to_array().map(|x| RBig::try_from(x).expect("a finite number"));
    let minus = |a: &[RBig; 3], b: &[RBig; 3]| [0, 1, 2].map(|k| &a[k] - &b[k]);
    let cross =
        |a: &[RBig; 3], b: &[RBig; 3]| [[1, 2], [2, 0], [0, 1]].map(|[i, j]: [usize; 2]| &a[i] * &b[j] - &a[j] * &b[i]);
    let ([a, b, c], o, d) = (corners.map(rational), rational(o), rational(d));
    let side = |[from, to]: [&[RBig; 3]; 2]| {
        let [x, y, z] = cross(&minus(to, &o), &minus(from, &o));
        let in_place = &d[0] * x + &d[1] * y + &d[2] * z;
        let moved = cross(&minus(to, from), &d);
        let first = [in_place].into_iter().chain(moved).find(|x| *x != RBig::ZERO);
        first.map_or(0, |x| if x > RBig::ZERO { 1 } else { -1 })
    };
    let sides = [[&b, &c], [&c, &a], [&a, &b]].map(side);
    sides == [1; 3] || sides == [-1; 3]
}

/// Between the units of a huge triangle and those of its ray, a distance close to 1 is subnormal.
#[test]
fn a_distance_is_not_rounded_to_fewer_digits_in_other_units() {
    let corners = [DVec3::Y * 1.35, DVec3::X * 1e60, DVec3::NEG_X * f64::MAX];
    let ray = Ray::new(DVec3::Z, DVec3::Z * -0.814_679_627_926_693_7).expect("a ray");
    let exact = Exact64::new(&ray, &Region::of(&Triangle([DVec3::ZERO; 3]).aabb()));
    assert_eq!(exact.distance(&Triangle(corners), f64::INFINITY), Some(1.0 / 0.814_679_627_926_693_7));
}

/// Draws a ray at a corner, at an edge, inside a triangle, or just outside, in the units 2^place and 2^way. If
/// `is_mixed`, some numbers are far smaller than the remaining ones.
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
        // The target is at distance 1.
        let ends = [[0.0, f64::INFINITY], [0.0, 1.0], [1.0, f64::INFINITY], [0.5, 1.0], [1.0, 1.0], [0.0, 0.5]];
        let [start, end] = ends[(number(6) + 3.0) as usize];
        let times = |t: f64| t * 2f64.powi((place - way).clamp(-1000, 1000));
        if let Ok(ray) = Ray::within(o * unit, d * pace, times(start), times(end)) {
            return (ray, Triangle([a, b, c].map(|corner| corner * unit)));
        }
    }
}
