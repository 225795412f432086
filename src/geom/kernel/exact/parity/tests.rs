use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::geom::kernel::Kernel;
use crate::geom::truth::{Meeting, Place, meet, round_f64};
use crate::geom::{Aabb, Ray, Region};

type Point = [i32; 3];

/// Draws closed meshes: corners, and triangles with a common orientation seen from outside.
fn closed() -> impl Strategy<Value = (Vec<Point>, Vec<[usize; 3]>)> {
    let tetrahedron = (0..4usize).map(|i| [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]][i]).collect::<Vec<_>>();
    let corners = [any_point(4), any_point(4), any_point(4), any_point(4)];
    let tetrahedra = corners.prop_map(move |corners| (corners.to_vec(), tetrahedron.clone()));
    let octahedra = (any_point(2), [1..4i32, 1..4, 1..4]).prop_map(|(o, size)| {
        let tip = |axis: usize, sign: i32| std::array::from_fn(|k| o[k] + if k == axis { sign * size[k] } else { 0 });
        let corners = (0..6).map(|i| tip(i / 2, if i % 2 == 0 { 1 } else { -1 })).collect();
        let face = |i: usize| {
            let [x, y, z] = [i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)];
            if i.count_ones().is_multiple_of(2) { [x, y, z] } else { [x, z, y] }
        };
        (corners, (0..8).map(face).collect())
    });
    let cubes = (any_point(3), [1..5i32, 1..5, 1..5], 0..64u32).prop_map(|(lo, size, diagonals)| {
        let corners = (0..8).map(|i| std::array::from_fn(|k| lo[k] + (i >> k & 1) * size[k])).collect();
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let faces = quads.into_iter().enumerate().flat_map(|(i, [a, b, c, d])| {
            if diagonals >> i & 1 == 0 { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
        });
        (corners, faces.collect())
    });
    prop_oneof![tetrahedra, octahedra, cubes]
}

fn any_point(most: i32) -> impl Strategy<Value = Point> {
    let x = move || -most..=most;
    [x(), x(), x()]
}

fn float([x, y, z]: Point) -> Vec3 {
    Vec3::new(x as f32, y as f32, z as f32)
}

/// Returns six times the signed volume of the triangle and `o`.
fn orientation([a, b, c]: [Point; 3], o: Point) -> i32 {
    let [a, b, c] = [a, b, c].map(|p| [0, 1, 2].map(|k| p[k] - o[k]));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    cross[0] * c[0] + cross[1] * c[1] + cross[2] * c[2]
}

/// Returns whether the ray crosses the triangle after its origin is moved by (2^-16, 2^-32, 2^-48). Doubles do not
/// round here, and the move is too small to change the sign of any nonzero integer of this size.
fn crosses_when_moved(corners: [Vec3; 3], o: Vec3, d: Vec3) -> bool {
    let by = [-16, -32, -48].map(|power| 2f64.powi(power));
    let moved = o.as_dvec3() + DVec3::from(by);
    assert_eq!((moved - o.as_dvec3()).to_array(), by);
    let d = d.as_dvec3().to_array();
    match meet(corners.map(|v| v.as_dvec3().to_array()), moved.to_array(), d) {
        Meeting::Hit(point) => {
            assert_eq!(point.place, Place::Interior);
            round_f64(&point.t) > 0.0
        }
        _ => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40_000))]

    #[test]
    fn crossings_are_those_of_the_moved_ray_and_odd_from_inside(
        (corners, triangles) in closed(),
        o in any_point(6),
        along in any_point(3),
        (aim, first, second) in (0..4, any::<prop::sample::Index>(), 0..3usize),
    ) {
        let triangles: Vec<_> = triangles.into_iter().map(|face| face.map(|i| corners[i])).collect();
        let triangle = triangles[first.index(triangles.len())];
        let [a, b] = [triangle[second], triangle[(second + 1) % 3]];
        // At a corner, at twice the midpoint of an edge, along an edge, or anywhere.
        let d = match aim {
            0 => [0, 1, 2].map(|k| a[k] - o[k]),
            1 => [0, 1, 2].map(|k| a[k] + b[k] - 2 * o[k]),
            2 => [0, 1, 2].map(|k| b[k] - a[k]),
            _ => along,
        };
        prop_assume!(d != [0; 3]);
        let sides: Vec<_> = triangles.iter().map(|&face| orientation(face, o)).collect();
        let is_inside = sides.iter().all(|&side| side > 0) || sides.iter().all(|&side| side < 0);
        // Outside a convex mesh with a volume: on the other side of a face.
        let volume: i32 = sides.iter().sum();
        let is_outside = sides.iter().any(|&side| side * volume < 0) || volume == 0;
        let (o, d) = (float(o), float(d));
        let shapes: Vec<_> = triangles.into_iter().map(|face| Triangle(face.map(float))).collect();
        let on_surface = |shape: &Triangle| {
            let out = Ray::within(o, d, 0.0, 0.0).expect("a ray");
            Exact::new(&out, &Region::of(&shape.aabb())).blocks(shape)
        };
        prop_assume!(is_inside || is_outside && !shapes.iter().any(on_surface));
        let region = Region::of(&shapes.iter().map(Triangle::aabb).fold(Aabb::EMPTY, Aabb::union));
        let exact = Exact::new(&Ray::new(o, d).expect("a ray"), &region);
        let mut count = 0;
        for shape in &shapes {
            let is_crossed = exact.crosses(shape);
            prop_assert_eq!(is_crossed, crosses_when_moved(shape.0, o, d), "{:?} {} {}", shape, o, d);
            prop_assert!(!is_crossed || exact.blocks(shape));
            let Triangle([a, b, c]) = *shape;
            for turned in [[b, c, a], [c, b, a]] {
                prop_assert_eq!(exact.crosses(&Triangle(turned)), is_crossed);
            }
            count += u32::from(is_crossed);
        }
        prop_assert!(count <= 2);
        prop_assert_eq!(count % 2 == 1, is_inside);
    }
}

#[test]
fn both_ends_of_the_interval_count() {
    let square = [[Vec3::ZERO, Vec3::X, Vec3::ONE.with_z(0.0)], [Vec3::ZERO, Vec3::ONE.with_z(0.0), Vec3::Y]];
    let count = |o: Vec3, tmin, tmax| {
        let ray = Ray::within(o, Vec3::Z, tmin, tmax).expect("a ray");
        let exact = Exact::new(&ray, &Region::of(&Aabb::of(&[Vec3::ZERO, Vec3::ONE])));
        square.iter().filter(|corners| exact.crosses(&Triangle(**corners))).count()
    };
    for o in [Vec3::new(0.5, 0.5, -2.0), Vec3::new(0.75, 0.25, -2.0)] {
        assert_eq!([count(o, 2.0, 2.0), count(o, 0.0, 2.0), count(o, 2.0, 9.0)], [1; 3]);
        assert_eq!([count(o, 0.0, 2f32.next_down()), count(o, 2f32.next_up(), 9.0)], [0; 2]);
    }
}

/// Fans around an axis, for rays along it, of all magnitudes.
#[test]
fn one_triangle_of_a_fan_is_crossed_at_its_hub() {
    for exponent in [-140, -60, 0, 60, 120] {
        for n in 3..40u32 {
            let scale = 2f64.powi(exponent) as f32;
            let rim = |i: u32| {
                let i = i % n;
                let (sin, cos) = (std::f32::consts::TAU * i as f32 / n as f32).sin_cos();
                Vec3::new(cos, sin, 0.1 * (i % 3) as f32) * scale * 100.0
            };
            let hub = Vec3::new(0.3, 0.1, 0.2) * scale;
            let fan: Vec<_> = (0..n).map(|i| Triangle([hub, rim(i), rim(i + 1)])).collect();
            let region = Region::of(&fan.iter().map(Triangle::aabb).fold(Aabb::EMPTY, Aabb::union));
            for d in [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.25, -0.5, 2.0)] {
                // There is no rounding, because the numbers have only a few more bits than the floats of the hub.
                let ray = Ray::new(hub - d * (scale * 64.0), d).expect("a ray");
                let exact = Exact::new(&ray, &region);
                assert_eq!(fan.iter().filter(|shape| exact.crosses(shape)).count(), 1, "{n} {exponent} {d}");
            }
        }
    }
}

/// Triangles without area, and triangles with an edge along the ray.
#[test]
fn no_line_along_an_edge_crosses_a_triangle() {
    let d = DVec3::new(1.0, 2.0, -3.0);
    for corners in [[0.0, 1.0, 3.0], [0.0, 0.0, 2.0], [1.0; 3]] {
        for o in [DVec3::ZERO, DVec3::X] {
            assert!(![true, false].iter().any(|&fine| is_crossed_by_line(&corners.map(|along| d * along), o, d, fine)));
        }
    }
    for apex in [DVec3::X, DVec3::Y, DVec3::NEG_Z] {
        for corners in [[DVec3::ZERO, d, apex], [apex, d, DVec3::ZERO], [d * 2.0, apex, d]] {
            for (o, has_room) in [(DVec3::ZERO, true), (DVec3::ZERO, false), (apex * 0.25, true), (apex * 0.25, false)]
            {
                assert!(!is_crossed_by_line(&corners, o, d, has_room), "{o} {has_room}");
            }
        }
    }
}
