use glam::Vec3;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::truth::RBig;

type Point = [RBig; 3];

fn exact(v: DVec3) -> Point {
    v.to_array().map(|x| RBig::try_from(x).expect("finite"))
}

/// Returns the corners of the exact part of a triangle in a box, given by least and greatest coordinates.
fn exact_part(corners: &[DVec3; 3], [lo, hi]: [DVec3; 2]) -> Vec<Point> {
    let mut polygon: Vec<Point> = corners.iter().map(|&v| exact(v)).collect();
    for axis in 0..3 {
        for (plane, is_upper) in [(lo[axis], false), (hi[axis], true)] {
            let plane = RBig::try_from(plane).expect("finite");
            let beyond = |v: &Point| if is_upper { &v[axis] - &plane } else { &plane - &v[axis] };
            let mut left = Vec::new();
            for (i, a) in polygon.iter().enumerate() {
                let b = &polygon[(i + 1) % polygon.len()];
                let [from, to] = [a, b].map(beyond);
                if from <= RBig::ZERO {
                    left.push(a.clone());
                }
                if from < RBig::ZERO && to > RBig::ZERO || from > RBig::ZERO && to < RBig::ZERO {
                    let t = &from / (&from - &to);
                    left.push(std::array::from_fn(|k| &a[k] + (&b[k] - &a[k]) * &t));
                }
            }
            polygon = left;
        }
    }
    polygon
}

/// Checks a part, and returns whether it is tight: no plane is more than two floats and 2^-44 of the coordinates
/// farther out than the exact part in a box enlarged by this margin.
fn check<V: Vector>(corners: [V; 3], part: Aabb) -> Option<bool> {
    let triangle = Triangle(corners);
    let (found, wide) = (triangle.part(&part), triangle.widen());
    let [lo, hi] = [part.lo, part.hi].map(Vec3::as_dvec3);
    let points = exact_part(&wide, [lo, hi]);
    for point in &points {
        for (axis, x) in point.iter().enumerate() {
            let [lo, hi] = [found.lo[axis], found.hi[axis]].map(|x| RBig::try_from(x).expect("finite"));
            assert!(lo <= *x && *x <= hi, "{corners:?} {part:?}: {found:?}");
        }
    }
    if points.is_empty() {
        return None;
    }
    assert!(part.encloses(&found) && triangle.aabb().encloses(&found));
    let slack = wide.iter().fold(DVec3::ZERO, |m, v| m.max(v.abs())) * 2f64.powi(-44);
    let points = exact_part(&wide, [lo - slack, hi + slack]);
    let tight = (0..3).all(|axis| {
        let slack = RBig::try_from(slack[axis]).expect("finite");
        let least = points.iter().map(|v| &v[axis]).min().expect("a corner");
        let most = points.iter().map(|v| &v[axis]).max().expect("a corner");
        let lo = RBig::try_from(found.lo[axis].next_up().next_up()).expect("finite") + &slack;
        let hi = RBig::try_from(found.hi[axis].next_down().next_down()).expect("finite") - &slack;
        lo >= *least && hi <= *most
    });
    Some(tight)
}

#[test]
fn parts_hold_all_and_are_tight() {
    let mut draw = Draw::new(17);
    let (mut some, mut none) = (0, 0);
    for i in 0..6000 {
        let mut corner = || match i % 4 {
            0 => draw.cube(),
            1 => draw.ints(4),
            2 => draw.cube() * Vec3::new(1e6, 1.0, 1e-6) + Vec3::X * 1e6,
            _ => draw.floats(-149, 120),
        };
        let corners = [(); 3].map(|()| corner());
        let [mut a, mut b] = [(); 2].map(|()| corner());
        if i % 3 == 0 {
            // Through a corner, as after cuts at corners.
            a = corners[0];
            b = corners[1].with_x(b.x);
        }
        match check(corners, Aabb::of(&[a, b])) {
            Some(tight) => {
                assert!(tight, "{corners:?} {a} {b}: {:?}", Triangle(corners).part(&Aabb::of(&[a, b])));
                some += 1;
            }
            None => none += 1,
        }
    }
    assert!(some > 1500 && none > 1000, "{some} {none}");
}

#[test]
fn double_precision_of_all_sizes() {
    let mut draw = Draw::new(18);
    let mut some = 0;
    for i in 0..2000 {
        let scale = 2f64.powi([0, -60, 100, -1000][i % 4]);
        let corners = [(); 3].map(|()| (draw.cube().as_dvec3() + draw.cube().as_dvec3() * 1e-9) * scale);
        let part = Aabb::of(&[draw.cube(), draw.cube()].map(|v| (v.as_dvec3() * scale).as_vec3()));
        some += usize::from(check(corners, part).is_some());
    }
    assert!(some > 400, "{some}");
}

#[test]
fn what_is_apart_has_no_part() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    let corner = Aabb { lo: Vec3::new(0.6, 0.6, 0.0), hi: Vec3::ONE };
    let none = triangle.part(&corner);
    assert!(!none.lo.cmple(none.hi).all());
    let diagonal = triangle.part(&Aabb { lo: Vec3::new(0.5, 0.5, -1.0), hi: Vec3::ONE });
    assert!(diagonal.contains(Vec3::new(0.5, 0.5, 0.0)) && diagonal.hi.x < 0.500_001);
}

/// Triangles from 2^-900 to 2^1000 are clipped. For other triangles the boxes are.
#[test]
fn all_that_cannot_overflow_is_cut() {
    let part = Aabb { lo: Vec3::new(0.5, 0.0, f32::NEG_INFINITY), hi: Vec3::new(1.0, 1.0, f32::INFINITY) };
    for (exponent, is_cut) in [(-901, false), (-900, true), (-3, true), (1000, true), (1001, false)] {
        let z = DVec3::Z * 2f64.powi(exponent);
        let triangle = Triangle([DVec3::ZERO, DVec3::X + z, DVec3::Y + z]);
        assert_eq!(triangle.part(&part).hi.y < 0.75, is_cut, "{exponent}");
    }
}

#[test]
fn parts_do_not_depend_on_the_order_of_corners() {
    let mut draw = Draw::new(19);
    for _ in 0..1000 {
        let ([a, b, c], part) = ([(); 3].map(|()| draw.cube()), Aabb::of(&[draw.cube(), draw.cube()]));
        let found = Triangle([a, b, c]).part(&part);
        for corners in [[b, c, a], [c, a, b], [a, c, b], [b, a, c], [c, b, a]] {
            assert_eq!(Triangle(corners).part(&part), found, "{a} {b} {c} {part:?}");
        }
    }
}

/// For any number of crossings of the plane.
#[test]
fn a_cut_adds_half_as_many_corners_at_most() {
    let mut polygon = Polygon::EMPTY;
    for i in 0..19 {
        polygon.push(DVec3::new(f64::from(i % 2), f64::from(i), 0.0));
    }
    let mut left = Polygon::EMPTY;
    polygon.cut(0, 1.0, 0.5, &mut left);
    assert_eq!(left.count, MOST);
    polygon.cut(0, -1.0, -0.5, &mut left);
    assert_eq!(left.count, MOST - 1);
}

/// An edge rises by an ulp from end to end, and is cut close to its start. In doubles the point of the cut is as high
/// as the end.
#[test]
fn what_rounding_would_lose_is_held() {
    for sign in [1.0, -1.0] {
        let corners = [Vec3::Y, Vec3::new(1.0, 1f32.next_up(), 0.0), Vec3::ZERO].map(|v| v * Vec3::new(1.0, sign, 1.0));
        let part = Aabb { lo: Vec3::splat(-2.0), hi: Vec3::new(2f32.powi(-31), 2.0, 2.0) };
        assert_eq!(check(corners, part), Some(true));
    }
}

/// Computing back from a dropped corner would be wrong: 1 + (1e-20 - 1) is 0.
#[test]
fn an_edge_from_a_corner_on_the_plane_is_cut_in_that_corner() {
    let on_plane = DVec3::new(0.0, 1e-20, 0.0);
    let polygon = Polygon::of([on_plane, DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)]);
    let mut left = Polygon::EMPTY;
    polygon.cut(0, 1.0, 0.0, &mut left);
    assert_eq!(left.corners(), [on_plane; 3]);
}

/// Found by fuzzing: the triangle's x is not 0, but so small in the frame that its nearest double is 0. [SPLIT-1]
#[test]
fn what_becomes_0_in_a_frame_is_held() {
    let frame = Frame::new(DVec3::ZERO, 612).expect("a frame");
    let corners = [[0.0, -2.1e184, -1e-42], [-5.6e-181, -5.0, 0.5], [-2.1e-174, 0.4375, 1.2e-31]].map(DVec3::from);
    let half_of = |corners: [DVec3; 3]| {
        let triangle = Triangle(corners);
        let whole = frame.aabb(&triangle);
        let half = Aabb { hi: whole.hi.with_y(whole.lo.y / 2.0), ..whole };
        (whole, frame.part(&triangle, &half))
    };
    let (whole, part) = half_of(corners);
    assert!(whole.lo.x < 0.0 && frame.rounded(corners[2]).x == 0.0);
    assert!(part.lo.x <= whole.lo.x && part.hi.x >= whole.hi.x, "{part:?}");
    let (_, flat) = half_of(corners.map(|v| v.with_x(0.0)));
    assert_eq!([flat.lo.x, flat.hi.x], [0.0; 2]);
}
