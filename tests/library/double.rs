//! The exact triangle test in double precision.

use proptest::prelude::*;

use glam::DVec3;
use stackless_bvh::geom::{Aabb, Ray, Region, Triangle};
use stackless_bvh::internals::geom::kernel::{Exact64, Kernel};
use stackless_check::{check_degenerate, check_triangle};

/// Returns a power of two, exact for the exponents of normal numbers.
fn power_of_two(exponent: i32) -> f64 {
    2f64.powi(exponent)
}

fn kernel(ray: &Ray<DVec3>, aabb: &Aabb) -> Exact64 {
    Exact64::new(ray, &Region::of(aabb))
}

fn is_exact(triangle: Triangle<DVec3>, ray: &Ray<DVec3>) -> Result<bool, TestCaseError> {
    check_triangle::<Exact64, _>(&triangle, ray).map_err(|fault| TestCaseError::fail(fault.to_string()))
}

/// Checks exactness with intervals that end at the distance and at its neighbours.
fn is_exact_at_its_ends(triangle: Triangle<DVec3>, ray: &Ray<DVec3>) -> Result<(), TestCaseError> {
    is_exact(triangle, ray)?;
    let Some(t) = kernel(ray, &triangle.aabb()).distance(&triangle, f64::INFINITY).filter(|t| t.is_finite()) else {
        return Ok(());
    };
    for end in [t, t.next_up(), t.next_down().max(0.0)].into_iter().filter(|end| end.is_finite()) {
        for [tmin, tmax] in [[0.0, end], [end, f64::INFINITY]] {
            is_exact(triangle, &Ray::within(ray.origin(), ray.direction(), tmin, tmax).expect("a ray"))?;
        }
    }
    Ok(())
}

/// Draws numbers of all magnitudes, including range limits, from few values, so equal numbers occur.
fn number() -> impl Strategy<Value = f64> {
    let few = vec![0.0, -0.0, 1.0, -1.0, 0.5, 3.0, f64::MAX, -f64::MAX, f64::MIN_POSITIVE, 5e-324, -1e-310];
    let ends = [-200, -201, 200, 201, -250, 250, -400, 128].map(power_of_two);
    prop_oneof![
        4 => prop::sample::select(few),
        2 => -2.0..2.0f64,
        1 => prop::sample::select(ends.to_vec()).prop_flat_map(|x| prop::sample::select(vec![x, -x, x.next_up(), x.next_down()])),
        1 => any::<f64>().prop_filter("a number", |x| x.is_finite()),
    ]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from)
}

/// Draws a triangle, and a ray at a point with simple weights, so edges and corners are often hit exactly or almost.
fn aimed() -> impl Strategy<Value = (Triangle<DVec3>, Ray<DVec3>)> {
    let weight = || prop_oneof![Just(0.0f64), Just(1.0), Just(0.5), 0.0..1.0f64, -0.1..1.1f64];
    let tame = || [-2.0..2.0f64, -2.0..2.0f64, -2.0..2.0f64].prop_map(DVec3::from);
    let integer = || [-9..10i8, -9..10i8, -9..10i8].prop_map(|p| DVec3::from(p.map(f64::from)));
    let corners = prop_oneof![[tame(), tame(), tame()], [integer(), integer(), integer()]];
    let tame_scales = vec![1.0, 1e-3, 1e6, 1e-20, 1e20, 1e-37, 1e35];
    let wild_scales = vec![1e-59, 1e-61, 1e-100, 1e100, 1e-250, 1e300, 1e-307, 1e-312];
    let scale = prop_oneof![prop::sample::select(tame_scales), prop::sample::select(wild_scales)];
    let turned = prop::sample::select(vec![1.0, 0.1, 1e-9, 1e9, 1e-90, 1e90]);
    (corners, prop_oneof![tame(), integer()], weight(), weight(), (scale, turned), (0..5u8, any::<bool>()))
        .prop_filter_map("not a ray", |(corners, o, u, v, (scale, along), (end, is_far))| {
            let offset = if is_far && scale == 1.0 { DVec3::new(1e12, -1e12, 3e11) } else { DVec3::ZERO };
            let ([a, b, c], o) = (corners.map(|corner| corner * scale + offset), o * scale + offset);
            let target = a + (b - a) * u + (c - a) * (v * (1.0 - u));
            let tmax = if end == 3 { 1f64.next_down() } else { f64::from(end) };
            let [tmin, tmax] =
                if end == 0 { [0.0, f64::INFINITY] } else { [[0.5, 0.0, 1.0, 0.0][usize::from(end) - 1], tmax] };
            Some((Triangle([a, b, c]), Ray::within(o, (target - o) * along, tmin, tmax).ok()?))
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn aimed_rays((triangle, ray) in aimed()) {
        is_exact(triangle, &ray)?;
    }

    #[test]
    fn ends_of_intervals((triangle, ray) in aimed()) {
        is_exact_at_its_ends(triangle, &Ray::new(ray.origin(), ray.direction()).expect("a ray"))?;
    }

    #[test]
    fn wild_numbers(corners in [vector(), vector(), vector()], o in vector(), d in vector()) {
        if let Ok(ray) = Ray::new(o, d) {
            is_exact(Triangle(corners), &ray)?;
        }
    }

    #[test]
    fn degenerate_triangles_are_known(a in vector(), b in vector(), weight in -3..4i8, c in vector()) {
        let between = a + (b - a) * f64::from(weight);
        for c in [between, c, b, a * 2.0 - b] {
            if !c.is_finite() {
                continue;
            }
            check_degenerate(&Triangle([a, b, c])).map_err(|fault| TestCaseError::fail(fault.to_string()))?;
        }
    }
}

/// Powers of two at which each stage reaches the limits of the range.
#[test]
fn at_the_ends_of_the_range() {
    let mut hits = 0;
    for size in [-200, -199, -150, 0, 100, 127, 199, 200] {
        for length in [-200, -199, -100, 0, 100, 199, 200] {
            for far in [-199, -100, 0, 100, 127, 200] {
                let [size, length, far] = [size, length, far].map(power_of_two);
                let corners = [DVec3::new(1.0, 0.0, 0.3), DVec3::new(-0.4, 0.9, 0.1), DVec3::new(-0.5, -0.8, -0.2)];
                let triangle = Triangle(corners.map(|corner| corner * size));
                let o = DVec3::new(0.01 * size, 0.03 * size, -far);
                let d = DVec3::new(0.0, 0.3 * size / far, 1.0) * length;
                if let Ok(ray) = Ray::new(o, d) {
                    hits += usize::from(is_exact(triangle, &ray).expect("the truth"));
                }
            }
        }
    }
    assert!(hits > 60, "{hits}");
}

/// Hits exactly at midpoints between doubles, and almost.
#[test]
fn ties_go_to_even() {
    for odd in [0, 1, 2, 3u32] {
        // The plane is at 2^53 + 2 odd, and 4 above that at the second corner. At (0, 0) the weight of that is a
        // quarter: the distance ends in 1, and floats are 2 apart.
        let low = 2f64.powi(53) + 2.0 * f64::from(odd);
        let triangle =
            Triangle([DVec3::new(-1.0, -1.0, low), DVec3::new(3.0, -1.0, low + 4.0), DVec3::new(-1.0, 3.0, low)]);
        for nudge in [0.0, power_of_two(-70), -power_of_two(-70)] {
            // The nudge adds or subtracts an amount that the first quotients do not show.
            let ray = Ray::new(DVec3::X * nudge, DVec3::Z).expect("a ray");
            assert!(is_exact(triangle, &ray).expect("the truth"));
            let found = kernel(&ray, &triangle.aabb()).distance(&triangle, f64::INFINITY).expect("a hit");
            let is_up = if nudge == 0.0 { odd % 2 == 1 } else { nudge > 0.0 };
            assert_eq!(found, low + if is_up { 2.0 } else { 0.0 });
        }
    }
}

#[test]
fn what_is_beyond_the_limit_is_left_out() {
    let triangle = Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
    let ray = Ray::new(DVec3::new(0.25, 0.25, -1.0), DVec3::Z * 3.0).expect("a ray");
    let exact = kernel(&ray, &triangle.aabb());
    assert_eq!([0.25, 0.5].map(|limit| exact.distance(&triangle, limit)), [None, Some(1.0 / 3.0)]);
}
