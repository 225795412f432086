//! Properties of every triangle test.

use glam::Vec3;
use proptest::prelude::*;

use stackless_bvh::geom::{Aabb, Ray, Region, Triangle};
use stackless_bvh::internals::geom::kernel::{Affine, Exact, ExactFromSingle, Kernel, Moller32, Moller64, Woop};
use stackless_check::check_triangle;

const UNIT: Triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);

fn distance<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>(triangle: Triangle, ray: &Ray) -> Option<f32> {
    K::new(ray, &Region::of(&triangle.aabb())).distance(&triangle.into(), f32::INFINITY)
}

fn ray(o: [f32; 3], d: [f32; 3], tmin: f32, tmax: f32) -> Ray {
    Ray::within(o.into(), d.into(), tmin, tmax).expect("a ray")
}

/// Runs a test for every kernel of single-precision rays.
macro_rules! for_each_kernel {
    ($test:ident) => {
        mod $test {
            #[test]
            fn exact() {
                super::$test::<super::Exact>();
            }
            #[test]
            fn exact_from_single() {
                super::$test::<super::ExactFromSingle>();
            }
            #[test]
            fn moller_32() {
                super::$test::<super::Moller32>();
            }
            #[test]
            fn moller_64() {
                super::$test::<super::Moller64>();
            }
            #[test]
            fn woop() {
                super::$test::<super::Woop>();
            }
            #[test]
            fn affine() {
                super::$test::<super::Affine>();
            }
        }
    };
}

for_each_kernel!(edges_corners_and_both_sides_count);
fn edges_corners_and_both_sides_count<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>() {
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5], [0.25, 0.25]] {
        for side in [1.0, -1.0] {
            let ray = ray([x, y, -2.0 * side], [0.0, 0.0, side], 0.0, f32::INFINITY);
            assert_eq!(distance::<K>(UNIT, &ray), Some(2.0));
            let kernel = K::new(&ray, &Region::of(&UNIT.aabb()));
            assert!(kernel.blocks(&UNIT.into()));
            assert_eq!(kernel.weights(&UNIT.into()), [x, y]);
        }
    }
    for [x, y] in [[-0.001, 0.5], [0.5, -0.001], [0.501, 0.501]] {
        assert_eq!(distance::<K>(UNIT, &ray([x, y, -2.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY)), None);
    }
}

for_each_kernel!(both_ends_of_the_interval_count);
fn both_ends_of_the_interval_count<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>() {
    let within = |tmin, tmax| {
        let ray = ray([0.25, 0.25, -2.0], [0.0, 0.0, 1.0], tmin, tmax);
        let hit = distance::<K>(UNIT, &ray).is_some();
        assert_eq!(K::new(&ray, &Region::of(&UNIT.aabb())).blocks(&UNIT.into()), hit);
        hit
    };
    assert!(within(2.0, 2.0) && within(0.0, 2.0) && within(2.0, 9.0));
    assert!(!within(0.0, 2.0f32.next_down()) && !within(2.0f32.next_up(), 9.0));
    let behind = ray([0.25, 0.25, 1.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY);
    assert!(distance::<K>(UNIT, &behind).is_none());
}

for_each_kernel!(flat_triangles_are_missed);
fn flat_triangles_are_missed<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>() {
    let (point, line) = (Triangle([Vec3::X; 3]), Triangle([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]));
    for triangle in [point, line] {
        assert_eq!(distance::<K>(triangle, &ray([1.0, 0.0, -1.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY)), None);
    }
    let edge_on = ray([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0], 0.0, f32::INFINITY);
    assert_eq!(distance::<K>(UNIT, &edge_on), None);
}

for_each_kernel!(any_triangle_is_met_in_and_missed_beside_it);
fn any_triangle_is_met_in_and_missed_beside_it<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>() {
    // All weights and points are exact, and the determinants are none of 1 and -1.
    let [a, b, c] = [[1.0, 2.0, 3.0], [5.0, 1.0, 4.0], [2.0, 6.0, 8.0]].map(Vec3::from);
    let corners = [[a, b, c], [a, c, b], [a * -2.0, c * -2.0, b * -2.0], [c * 0.25, a * 0.25, b * 0.25]];
    let ways = [[1.0, 2.0, -4.0], [-3.0, 1.0, 2.0], [2.0, -5.0, 1.0], [0.0, 0.0, -3.0]].map(Vec3::from);
    for ([a, b, c], way) in corners.into_iter().flat_map(|corners| ways.map(|way| (corners, way))) {
        let triangle = Triangle([a, b, c]);
        let at = |u: f32, v: f32| Ray::new(a + (b - a) * u + (c - a) * v - way * 2.0, way).unwrap();
        for [u, v] in [[0.25, 0.5], [0.5, 0.25], [0.125, 0.125], [0.625, 0.125]] {
            let ray = at(u, v);
            let kernel = K::new(&ray, &Region::of(&triangle.aabb()));
            let t = distance::<K>(triangle, &ray).expect("a hit");
            assert!((t - 2.0).abs() < 1e-5 && kernel.blocks(&triangle.into()), "{triangle:?} {way} {t}");
            let [p, q] = kernel.weights(&triangle.into());
            assert!((p - u).abs() < 1e-5 && (q - v).abs() < 1e-5, "{triangle:?} {way}: {p} {q}");
        }
        for [u, v] in [[-0.25, 0.5], [0.5, -0.25], [0.75, 0.5], [-0.5, -0.5], [-0.25, 1.5], [1.5, -0.25]] {
            let ray = at(u, v);
            assert_eq!(distance::<K>(triangle, &ray), None, "{triangle:?} {way} {u} {v}");
            assert!(!K::new(&ray, &Region::of(&triangle.aabb())).blocks(&triangle.into()));
        }
    }
}

/// Numbers of all magnitudes, and few enough others to meet again.
fn number() -> impl Strategy<Value = f32> {
    let few = [0.0, -0.0, 1.0, -1.0, 0.5, 3.0, f32::MAX, -f32::MAX, f32::MIN_POSITIVE, 1e-45, -1e-40];
    prop_oneof![
        4 => prop::sample::select(few.to_vec()),
        2 => -2.0..2.0f32,
        1 => any::<f32>().prop_filter("a number", |x| x.is_finite()),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from)
}

/// A triangle, and a ray at a point with simple weights, so that edges and corners are often met or nearly so.
fn aimed() -> impl Strategy<Value = (Triangle, Ray)> {
    let weight = || prop_oneof![Just(0.0f32), Just(1.0), Just(0.5), 0.0..1.0f32, -0.1..1.1f32];
    let tame = || [-2.0..2.0f32, -2.0..2.0f32, -2.0..2.0f32].prop_map(Vec3::from);
    let integer = || [-9..10i8, -9..10i8, -9..10i8].prop_map(|p| Vec3::from(p.map(f32::from)));
    let corners = prop_oneof![[tame(), tame(), tame()], [integer(), integer(), integer()]];
    let scale = prop::sample::select(vec![1.0f32, 1e-3, 1e6, 1e-20, 1e20, 1e-37, 1e35]);
    (corners, prop_oneof![tame(), integer()], weight(), weight(), scale, 0..5u8).prop_filter_map(
        "not a ray",
        |(corners, o, u, v, scale, end)| {
            let ([a, b, c], o) = (corners.map(|corner| corner * scale), o * scale);
            let target = a + (b - a) * u + (c - a) * (v * (1.0 - u));
            let [tmin, tmax] =
                [[0.0, f32::INFINITY], [0.0, 1.0], [1.0, 2.0], [0.0, 1.0f32.next_down()], [0.5, 1.0]][usize::from(end)];
            Some((Triangle([a, b, c]), Ray::within(o, target - o, tmin, tmax).ok()?))
        },
    )
}

fn is_exact<K: Kernel<Vector = Vec3, Shape = Triangle>>(triangle: Triangle, ray: &Ray) -> Result<(), TestCaseError> {
    check_triangle::<K, _>(&triangle, ray).map(|_| ()).map_err(|fault| TestCaseError::fail(fault.to_string()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn exact_is_exact_for_aimed_rays((triangle, ray) in aimed()) {
        is_exact::<Exact>(triangle, &ray)?;
        is_exact::<ExactFromSingle>(triangle, &ray)?;
    }

    #[test]
    fn exact_is_exact_for_wild_numbers(corners in [vector(), vector(), vector()], o in vector(), d in vector()) {
        if let Ok(ray) = Ray::new(o, d) {
            is_exact::<Exact>(Triangle(corners), &ray)?;
            is_exact::<ExactFromSingle>(Triangle(corners), &ray)?;
        }
    }
}

#[test]
fn the_box_of_doubles_holds_them() {
    let (a, b) = (glam::DVec3::new(0.1, -0.1, 1e300), glam::DVec3::new(1.0, 1e-300, -1e300));
    let Aabb { lo, hi } = Triangle([a, b, a]).aabb();
    assert_eq!((lo.z, hi.z), (f32::NEG_INFINITY, f32::INFINITY));
    for p in [a, b] {
        assert!(lo.as_dvec3().cmple(p).all() && p.cmple(hi.as_dvec3()).all(), "{lo} {p} {hi}");
    }
    assert_eq!((lo.x, hi.x), (0.1f32.min(0.099_999_994), 1.0));
}

#[test]
fn numbers_and_vectors_answer_for_their_precision() {
    use stackless_bvh::geom::{Real, Vector};
    let third = 1.0 / 3.0;
    let ([down, up], [zero, same]) = (third.ranks(), [(-0.0_f64).ranks(), 0.5_f64.ranks()]);
    assert_eq!((f32::from_bits(down), f32::from_bits(up)), ((third as f32).next_down(), third as f32));
    assert_eq!((zero, same), ([0; 2], [0.5_f32.to_bits(); 2]));
    let [down, up] = (2.0 / 3.0_f64 + 1e-9).ranks();
    assert!(f64::from(f32::from_bits(down)) < 2.0 / 3.0 + 1e-9 && f32::from_bits(down).next_up() == f32::from_bits(up));
    assert_eq!(((-0.0_f32).ranks(), 0.5_f32.ranks()), ([0; 2], [0.5_f32.to_bits(); 2]));
    assert_eq!((Real::next_down(1.0_f32), Real::next_down(1.0_f64)), (1.0_f32.next_down(), 1.0_f64.next_down()));
    for bad in [f32::NAN, f32::INFINITY] {
        assert!(
            !Vector::is_finite(Vec3::new(0.0, bad, 0.0)) && !Vector::is_finite(Vec3::new(0.0, bad, 0.0).as_dvec3())
        );
    }
    assert!(Vector::is_finite(Vec3::MAX) && Vector::is_finite(glam::DVec3::MAX));
    for ([a, b, c], are) in [
        ([Vec3::ZERO, Vec3::X, Vec3::X * 3.0], true),
        ([Vec3::ONE; 3], true),
        ([Vec3::ZERO, Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.1, 0.2, 0.3) * 2.0], true),
        ([Vec3::ZERO, Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.2, 0.4, 0.6_f32.next_up())], false),
        ([Vec3::ZERO, Vec3::X, Vec3::Y], false),
        ([Vec3::ZERO, Vec3::Y, Vec3::Z], false),
        ([Vec3::ZERO, Vec3::Z, Vec3::X], false),
    ] {
        assert_eq!(Vec3::are_collinear(&[a, b, c]), are, "{a} {b} {c}");
        assert_eq!(glam::DVec3::are_collinear(&[a, b, c].map(Vec3::as_dvec3)), are, "{a} {b} {c}");
    }
}

#[test]
fn octants_are_the_signs() {
    use stackless_bvh::internals::geom::EnclosedRay;
    for octant in 0..8_u8 {
        let sign = |axis: u8| if octant >> axis & 1 == 1 { -2.0 } else { 3.0 };
        let ray = ray([0.0; 3], [sign(0), sign(1), sign(2)], 0.0, 1.0);
        assert_eq!((ray.octant(), EnclosedRay::exact(&ray).octant()), (octant, octant));
    }
    assert_eq!(ray([0.0; 3], [0.0, -0.0, 1.0], 0.0, 1.0).octant(), 0);
}
