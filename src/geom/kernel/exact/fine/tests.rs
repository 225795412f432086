use std::cmp::Ordering;

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::generate::{Rng, Source};
use crate::geom::kernel::exact::Certainty::{Hit, Miss, Open};
use crate::geom::kernel::exact::sum::difference;
use crate::geom::tests::threshold;
use crate::geom::truth::{self, Meeting, RBig};

fn vector() -> impl Strategy<Value = DVec3> {
    let few = vec![0.0, 1.0, -1.0, 0.5, 3.0, 1e-130, -1e-300, 0.1, 5e-324];
    let small = threshold().prop_filter("small", |x| x.abs() <= 2.0);
    let number = || prop_oneof![1 => prop::sample::select(few.clone()), 2 => -2.0..2.0f64, 1 => small.clone()];
    [number(), number(), number()].prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Every certain answer equals rational arithmetic. [EXACT-10]
    #[test]
    fn what_is_certain_is_the_truth(
        corners in [vector(), vector(), vector()], o in vector(), d in vector(),
        scales in prop::sample::select(vec![[0, 0], [100, -100], [-190, 150], [198, 0], [-100, -199], [-500, 0], [0, -900]]),
        shift in prop::sample::select(vec![0.0, 0.0, 1e9, 1e15]), is_aimed in any::<bool>(),
    ) {
        let [size, length] = scales.map(|exponent| 2f64.powi(exponent));
        let d = if is_aimed { corners[0] * 0.25 + corners[1] * 0.5 + corners[2] * 0.25 - o } else { d };
        let (corners, o, d) = (corners.map(|v| (v + shift) * size), (o + shift) * size, d * length);
        let found = FineDeterminants::new(&corners, o, d);
        let meets = found.meets(&corners.map(exact), o);
        match truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array()) {
            Meeting::Hit(point) => {
                prop_assert_ne!(meets, Some(false));
                if let Some(t) = found.distance::<f64>() {
                    prop_assert_eq!(t, truth::round_f64(&point.t));
                }
                if let Some(weights) = found.weights::<f64>() {
                    prop_assert_eq!(weights, [&point.u, &point.v].map(truth::round_f64));
                }
            }
            // The determinant is 0, and never certain to be nonzero.
            Meeting::Coplanar => {
                prop_assert_eq!((found.distance::<f64>(), found.weights::<f64>()), (None, None));
                prop_assert_ne!(meets, Some(true));
            }
            Meeting::Miss => prop_assert_ne!(meets, Some(true)),
        }
    }
}

/// Nearly all answers are certain. Otherwise the stage would be useless.
#[test]
fn nearly_all_are_certain() {
    let mut rng = Rng::new(3);
    let mut certain = 0;
    for _ in 0..1000 {
        let mut vector = || DVec3::from([(); 3].map(|()| rng.below(1 << 20) as f64 / 1e6));
        let corners = [vector(), vector(), vector()];
        let o = vector() - 5.0;
        let target = corners[0] * 0.3 + corners[1] * 0.3 + corners[2] * 0.4;
        let found = FineDeterminants::new(&corners, o, target - o);
        let is_told = found.meets(&corners.map(exact), o) == Some(true) && found.distance::<f64>().is_some();
        certain += u32::from(is_told && found.weights::<f64>().is_some());
    }
    assert!(certain > 990, "{certain}");
}

/// A line through an exactly known corner hits the triangle, for any bounds of the remaining numbers. Through an
/// inexact corner, the hit is uncertain. [INST-5]
#[test]
fn corners_that_are_known_are_met() {
    let (corners, o) =
        ([DVec3::ZERO, DVec3::new(3.0, 1.0, 0.5), DVec3::new(-1.0, 2.0, 0.25)], DVec3::new(0.5, 0.25, 7.0));
    for (k, &corner) in corners.iter().enumerate() {
        let third = Fine::exact(1.0).over(Fine::exact(3.0)).unwrap();
        let whole = third + third + third;
        let beside = |i: usize, x: f64| if i == k { Fine::exact(x) } else { whole * Fine::exact(x) };
        let near = [0, 1, 2].map(|i| corners[i].to_array().map(|x| beside(i, x)));
        let meets = |corners: &[[Fine; 3]; 3]| FineDeterminants::of(corners, o, (corner - o) * 0.25).meets(corners, o);
        assert_eq!(meets(&near), Some(true), "{k}");
        let unknown = near.map(|corner| corner.map(|x| whole * (x + Fine::exact(1.0))));
        assert_eq!(FineDeterminants::of(&unknown, o, corner + 1.0 - o).meets(&unknown, o), None, "{k}");
    }
}

/// Draws a line from a distance of `far` that passes through zero, or next to an edge by `beside` of the edge. The
/// length of its direction is `length`.
fn from_afar(rng: &mut Rng, [far, beside, length]: [i32; 3], is_off: bool) -> ([DVec3; 3], DVec3, DVec3) {
    let mut vector = || DVec3::from([(); 3].map(|()| (rng.bits() >> 40) as f64 / 2f64.powi(23) - 1.0));
    let (corners, off, way) = ([vector(), vector(), vector()], vector(), vector() * 2f64.powi(far));
    let target = corners[0] * 0.5 + corners[1] * 0.5 + off * 2f64.powi(beside);
    let o = if is_off { vector() - way } else { way * -0.75 };
    (corners.map(|corner| corner - target), o, way * 2f64.powi(length))
}

fn sign(x: &RBig) -> Ordering {
    x.cmp(&RBig::ZERO)
}

/// From a close point of the line, signs and weights become certain that are uncertain from its origin, and none is
/// wrong. [EXACT-12]
#[test]
fn from_a_near_point_signs_are_told_and_true() {
    let mut rng = Rng::new(5);
    let (mut near, mut far, mut weights) = (0, 0, 0);
    for i in 0..6000 {
        let sizes = [20 + i % 140, [-900, -20, -40, 0][i as usize % 4], [0, -150, 30][i as usize % 3]];
        let (corners @ [a, b, _], o, d) = from_afar(&mut rng, sizes, i % 5 == 0);
        let [edge, way] = [[a, b], [o, a]].map(|[from, to]| [0, 1, 2].map(|k| difference(to[k], from[k])));
        let exact = |v: DVec3| v.to_array().map(|x| RBig::try_from(x).expect("finite"));
        let minus = |x: DVec3, y: DVec3| -> [RBig; 3] { std::array::from_fn(|k| &exact(x)[k] - &exact(y)[k]) };
        let (e, w, direction) = (minus(b, a), minus(a, o), exact(d));
        let cross = |i: usize, j: usize| &e[i] * &w[j] - &e[j] * &w[i];
        let truth = &direction[0] * cross(1, 2) + &direction[1] * cross(2, 0) + &direction[2] * cross(0, 1);
        let told = volume_from_near(d, &edge, &way).and_then(|x| x.partial_cmp(&0.0));
        assert!(told.is_none_or(|told| told == sign(&truth)), "{corners:?} {o} {d}");
        let from_there = volume(d, &edge, &way);
        near += usize::from(told.is_some());
        far += usize::from(from_there.is_some());
        if let Some(found) = super::weights::<f32>(&corners, o, d)
            && let Meeting::Hit(point) = truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array())
        {
            assert_eq!(found, [&point.u, &point.v].map(truth::round_f32), "{corners:?} {o} {d}");
            weights += 1;
        }
    }
    assert!(near > 4400 && far < 2300 && weights > 1500, "{near} {far} {weights}");
}

/// The line passes the close point within the reported distance, but not through it. [EXACT-12]
#[test]
fn the_line_passes_a_near_point_where_it_says() {
    let mut rng = Rng::new(7);
    let mut beside = 0;
    for i in 0..1000 {
        let (corners, o, d) = from_afar(&mut rng, [40 + i % 100, -20, 0], i % 5 == 0);
        let NearPoint { point, off } = near_point(&corners, o, d).expect("the line begins far away");
        assert!(passes(o, d, point, off), "{corners:?} {o} {d}: {point} {off}");
        beside += usize::from(!passes(o, d, point, off / 64.0));
    }
    assert!(beside > 500, "{beside}");
}

/// Returns whether a line has a point within a distance of another point on each axis.
fn passes(o: DVec3, d: DVec3, point: DVec3, off: f64) -> bool {
    let exact = |x: f64| RBig::try_from(x).expect("finite");
    let spans = [0, 1, 2].map(|k| {
        let mut ends = [-off, off].map(|off| (exact(point[k]) + exact(off) - exact(o[k])) / exact(d[k]));
        ends.sort();
        ends
    });
    let [latest, first] = [0, 1].map(|end| spans.iter().map(move |span| &span[end]));
    latest.max() <= first.min()
}

/// Any multiple of the direction may be subtracted, but the remainder must enclose the exact difference. [EXACT-12]
#[test]
fn what_is_left_of_a_way_is_less_a_multiple_of_the_direction() {
    let mut rng = Rng::new(6);
    for i in 0..2000 {
        let (_, o, d) = from_afar(&mut rng, [i % 150, 0, i % 7 - 3], false);
        let (left, _) = shortened(exact(o), d);
        let longest = DVec3::from(left.map(Fine::middle)).abs().max_element();
        assert!(longest < 64.0, "{o} {d}: {longest}");
        // The cross product with the direction does not change.
        let [before, after] = [exact(o), left].map(|way| cross(&way, &exact(d)));
        for (before, after) in before.into_iter().zip(after) {
            let apart = (before - after).sign();
            assert!(apart.is_none_or(|apart| apart == 0.0), "{o} {d}");
        }
    }
}

/// The midpoint of two floats, the ends of an interval and points beyond, for a triangle on a grid. Distances that are
/// not doubles are not decided. [EXACT-10]
#[test]
fn distances_that_are_doubles_are_placed_without_sums() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let placed = |from: f64, interval: [f32; 2]| {
        let found = FineDeterminants::new(&corners, DVec3::new(0.25, 0.25, -from), DVec3::Z);
        found.placed(interval)
    };
    let middle = 1.0 + 2f64.powi(-24);
    assert_eq!(placed(middle, [0.0, 9.0]), Hit(1.0), "of two floats the even one");
    assert_eq!(placed(middle + 2f64.powi(-23), [0.0, 9.0]), Hit(1.0 + 2.0 * f32::EPSILON));
    // The exact distance is compared, not its rounded value.
    assert_eq!([placed(middle, [0.0, 1.0]), placed(1.0 - 2f64.powi(-26), [1.0, 9.0])], [Miss; 2]);
    assert_eq!([placed(1.0, [0.0, 1.0]), placed(1.0, [1.0, 2.0])], [Hit(1.0); 2]);
    assert_eq!([placed(3.0, [0.0, 1.0]), placed(-3.0, [0.0, 1.0])], [Miss; 2]);
    assert_eq!(placed(0.0, [0.0, 1.0]), Hit(0.0));
    assert_eq!(placed(-2f64.powi(-60), [0.0, 1.0]), Miss);
    assert_eq!(placed(2f64.powi(150), [0.0, f32::INFINITY]), Hit(f32::INFINITY));
    assert_eq!(placed(2f64.powi(150), [0.0, f32::MAX]), Miss);
    let third = FineDeterminants::new(&corners, DVec3::new(0.25, 0.25, -1.0), DVec3::Z * 3.0);
    assert_eq!((third.double_distance(), third.placed([0.0, 1.0_f32])), (None, Hit(1.0 / 3.0)));
    assert_eq!(third.placed([0.0, 1.0 / 3.0_f32]), Open, "an end that it is rounded to");
}

/// All answers from bounds of a point close to the triangle are right, and from far away nearly all are certain.
/// [EXACT-12]
#[test]
fn a_near_point_tells_hits_and_misses() {
    let mut rng = Rng::new(8);
    let mut told = [0; 2];
    for i in 0..4000 {
        let sizes = [34 + i % 110, [-900, -20, -3, 0][i as usize % 4], [0, -150, 30][i as usize % 3]];
        let (corners, o, d) = from_afar(&mut rng, sizes, i % 5 == 0);
        let Some(near) = near_point(&corners, o, d) else { continue };
        let is_hit = matches!(truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array()), Meeting::Hit(_));
        if let Some(is_inside) = near.is_inside(&corners, d) {
            assert_eq!(is_inside, is_hit, "{corners:?} {o} {d}");
            told[usize::from(is_hit)] += 1;
        }
    }
    assert!(told[0] > 1000 && told[1] > 500, "{told:?}");
    assert!(near_point(&[DVec3::ZERO, DVec3::X, DVec3::Y], DVec3::splat(1e9), DVec3::X).is_none());
}
