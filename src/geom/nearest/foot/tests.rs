use glam::{DVec3, Vec3};

use super::*;
use crate::generate::{Rng, Source as _};
use crate::geom::nearest::point::tests::flat;
use crate::geom::nearest::tests::{bits, case};

/// Compares every method of finding a foot with rational arithmetic. Returns which of the two kinds of bounds found it.
fn compare<V: Vector>(triangle: &Triangle<V>, point: V) -> [bool; 2] {
    let weights = truth::nearest_weights(triangle.0.map(V::components), point.components()).expect("finite");
    assert_eq!(weights.iter().fold(RBig::ZERO, |all, weight| all + weight), RBig::ONE, "{triangle:?} {point:?}");
    let zeros = weights.iter().filter(|weight| weight.is_zero()).count();
    let place = [Place::Interior, Place::Edge, Place::Vertex][zeros];
    let [_, u, v] = weights.map(|weight| V::Real::nearest(&weight));
    let expected = Foot { place, weights: [u, v] };
    let (corners, p) = (triangle.widen(), point.widen());
    let by_doubles = weighed::<Rough, V>(&corners, p);
    let by_digits = weighed::<Fine, V>(&corners, p);
    for found in [by_doubles, by_digits, Foot::of(triangle, point)].into_iter().flatten() {
        assert_eq!(found, expected, "{triangle:?} {point:?}");
    }
    [by_doubles.is_some(), by_doubles.or(by_digits).is_some()]
}

fn weighed<E: Enclosure, V: Vector>(corners: &[DVec3; 3], point: DVec3) -> Option<Foot<V::Real>> {
    rounded::<E, V::Real>(Parts::certified::<E>(corners, point)?.only()?, corners, point)
}

fn check_feet<V: Vector>() -> [usize; 2] {
    let (mut random, mut settled) = (Rng::new(8), [0; 2]);
    for kind in 0..20_000 {
        let (triangle, point) = case::<V>(&mut random, kind);
        for (settled, is_settled) in settled.iter_mut().zip(compare(&triangle, point)) {
            *settled += usize::from(is_settled);
        }
    }
    for round in 0..5000 {
        let (triangle, point) = flat::<V>(&mut random, round);
        compare(&triangle, point);
    }
    settled
}

/// [NEAR-9]
#[test]
fn feet_are_the_truth_rounded() {
    let [single, double] = [check_feet::<Vec3>(), check_feet::<DVec3>()];
    assert!(single[0] > 8000 && single[1] > single[0], "{single:?}");
    assert!(double[0] > 500 && double[1] > 8000, "{double:?}");
}

/// Points whose foot is on the border of two regions, in integers: on the line of an edge, and above a corner. [NEAR-9]
#[test]
fn borders_of_parts_belong_to_the_smaller_one() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X * 4.0, Vec3::Y * 4.0]);
    let place = |x: f32, y: f32, z: f32| Foot::of(&triangle, Vec3::new(x, y, z)).expect("finite").place;
    for z in [0.0, 1.0, -3.0] {
        assert_eq!([place(1.0, 0.0, z), place(0.0, 3.0, z), place(2.0, 2.0, z)], [Place::Edge; 3]);
        assert_eq!([place(0.0, 0.0, z), place(4.0, 0.0, z), place(4.0, -1.0, z)], [Place::Vertex; 3]);
        assert_eq!([place(0.0, -1.0, z), place(-1.0, 4.0, z), place(0.0, 5.0, z)], [Place::Vertex; 3]);
        assert_eq!([place(1.0, 1.0, z), place(1.5, 2.0, z)], [Place::Interior; 2]);
    }
    assert_eq!(Foot::of(&triangle, Vec3::NAN), None);
    assert_eq!(Foot::of(&Triangle([Vec3::ZERO, Vec3::INFINITY, Vec3::X]), Vec3::ZERO), None);
}

fn check_normals<V: Vector>() -> usize {
    let (mut random, mut settled) = (Rng::new(9), 0);
    for kind in 0..20_000 {
        let (triangle, _) = case::<V>(&mut random, kind);
        let expected = truth::unit_normal(triangle.0.map(V::components)).map(V::from_components);
        assert_eq!(triangle.normal().map(bits), expected.map(bits), "{triangle:?}");
        assert_eq!(expected.is_none(), triangle.is_degenerate(), "{triangle:?}");
        let by_digits = unit_normal(&triangle.widen()).map(V::from_components);
        assert!(by_digits.is_none_or(|normal| Some(bits(normal)) == expected.map(bits)), "{triangle:?}");
        settled += usize::from(by_digits.is_some());
    }
    settled
}

/// Compares double-double and rational arithmetic with each other, and with double precision for integer corners.
#[test]
fn normals_are_the_truth_rounded() {
    let settled = [check_normals::<Vec3>(), check_normals::<DVec3>()];
    assert!(settled.iter().all(|&settled| settled > 15_000), "{settled:?}");
    let mut random = Rng::new(10);
    for _ in 0..2000 {
        let [a, b, c] = [(); 3].map(|()| DVec3::from([(); 3].map(|()| random.below(99) as f64)));
        let normal = (b - a).cross(c - a);
        let found = Triangle([a, b, c]).normal();
        assert_eq!(found.is_none(), normal == DVec3::ZERO);
        assert!(found.is_none_or(|found| (found - normal.normalize()).abs().max_element() < 4.0 * f64::EPSILON));
    }
}
