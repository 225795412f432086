use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::affine::tests::{double, number, solution};
use crate::geom::tests::{exact, exponent, holds, sorted};
use crate::geom::{AffineMap, Ray};

/// Draws an interval.
fn interval(end: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Interval> {
    let from = |x: f64, y: f64| sorted([x, y]);
    let near =
        (end.clone(), 0..3).prop_map(move |(x, steps)| from(x, (0..steps).fold(x, |x, _| x.next_up()).min(f64::MAX)));
    prop_oneof![near, (end.clone(), end).prop_map(move |(x, y)| from(x, y))]
}

fn is_held<R: crate::geom::Real>(map: &AffineMap<R>, ray: &EnclosedRay) -> Result<(), TestCaseError> {
    let bounds = map.pull_back(ray);
    let corner = |v: &[Interval; 3], which: usize| [0, 1, 2].map(|k| exact(v[k].ends()[which >> k & 1]));
    for which in 0..8 {
        let (o, d) = (corner(&ray.origin, which), corner(&ray.direction, which));
        let origin = solution(map, &[0, 1, 2].map(|k| &o[k] - exact(map.rows()[k][3])));
        let direction = solution(map, &d);
        for k in 0..3 {
            prop_assert!(holds(bounds.origin[k], &origin[k]), "{k}, {which}: {:?}", bounds.origin);
            prop_assert!(holds(bounds.direction[k], &direction[k]), "{k}, {which}: {:?}", bounds.direction);
        }
    }
    Ok(())
}

fn rows<R: std::fmt::Debug>(number: impl Strategy<Value = R> + Clone) -> impl Strategy<Value = [[R; 4]; 3]> {
    let row = move || [number.clone(), number.clone(), number.clone(), number.clone()];
    [row(), row(), row()]
}

fn vector(end: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = [Interval; 3]> {
    [interval(end.clone()), interval(end.clone()), interval(end)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// [INST-3]
    #[test]
    fn all_corners_of_bounds_are_held(
        rows in rows(-4.0..4.0f32),
        origin in vector(-4.0..4.0),
        direction in vector(-4.0..4.0),
    ) {
        let Ok(map) = AffineMap::new(rows) else { return Ok(()) };
        is_held(&map, &EnclosedRay::new(origin, direction))?;
    }

    /// [INST-3]
    #[test]
    fn numbers_of_all_sizes_are_held(
        rows in rows(double().boxed()),
        origin in vector(double().boxed()),
        direction in vector(double().boxed()),
    ) {
        let Ok(map) = AffineMap::new(rows) else { return Ok(()) };
        is_held(&map, &EnclosedRay::new(origin, direction))?;
    }

    /// The midpoints are 0 and the factors positive, so only the radii have an effect. [INST-3]
    #[test]
    fn radii_are_wide_enough(rows in rows(1.0..2.0f64), radii in [1.0..2.0f64, 1.0..2.0f64, 1.0..2.0f64]) {
        let Ok(map) = AffineMap::new(rows.map(|[x, y, z, _]| [x, y, z, 0.0])) else { return Ok(()) };
        let around = radii.map(|x| Interval::between([-x, x]));
        is_held(&map, &EnclosedRay::new(around, around))?;
    }

    /// [INST-3]
    #[test]
    fn bounds_are_narrow(rows in rows(number().boxed()), o in [-4.0..4.0, -4.0..4.0, -4.0..4.0]) {
        let Ok(map) = AffineMap::new(rows) else { return Ok(()) };
        let (Inverse::Nearest(entries), Ok(ray)) = (map.inverse, Ray::within(DVec3::from(o), DVec3::X, 0.0, 1.0))
        else {
            return Ok(());
        };
        let bounds = map.pull_back(&EnclosedRay::exact(&ray));
        for (row, bounds) in entries.iter().zip(bounds.origin) {
            let offset = map.rows().map(|row| f64::from(row[3]));
            let sizes: f64 = (0..3).map(|k| (row[k] * (o[k] - offset[k])).abs()).sum();
            let [lo, hi] = bounds.ends();
            prop_assert!(hi - lo <= 10.0 * f64::EPSILON * sizes, "{bounds:?} {sizes}");
        }
    }
}

/// The entry, the component, the product and both sums are rounded down by nearly half a unit: five of the six
/// roundings in the bound. [INST-3]
#[test]
fn the_bound_is_hardly_too_great() {
    let unit = f64::EPSILON;
    // 1/d is just below the midpoint of two doubles.
    let j = 94_906_264.0;
    let d = 1.0 - j * unit / 2.0;
    let entry = 1.0 + j / 2.0 * unit;
    // Its product with s is also just below a midpoint.
    let s = 1.0 + (0.5 / unit / (j / 2.0)).floor() * unit;
    let nearly_half = 0.499_999 * unit;
    let map = AffineMap::new([[d, -1.0, -1.0, -nearly_half], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]).unwrap();
    let Inverse::Nearest(entries) = map.inverse else { panic!("{:?}", map.inverse) };
    assert_eq!(entries[0], [entry; 3]);
    let origin = [s, nearly_half, nearly_half].map(Interval::exact);
    let bounds = map.pull_back(&EnclosedRay::new(origin, origin)).origin[0];
    let [truth, ..] = solution(&map, &[exact(s) + exact(nearly_half), exact(nearly_half), exact(nearly_half)]);
    assert!(holds(bounds, &truth), "{bounds:?}");
    let [lo, hi] = bounds.ends();
    let off = truth - exact(lo * 0.5 + hi * 0.5);
    assert!(off > exact(4.9 / 2.0 * unit) && off < exact(3.0 * unit), "{}", off.to_f64().value() / unit);
}

/// A direction parallel to the planes of boxes stays parallel, and an origin in a plane stays in it. [INST-3]
#[test]
fn what_is_zero_stays_so() {
    let map = AffineMap::new([[0.6, -0.8, 0.0, 1.0], [0.8, 0.6, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0f32]]).unwrap();
    assert!(matches!(map.inverse, Inverse::Nearest(_)));
    let ray = Ray::within(DVec3::new(0.1, 0.2, 3.0), DVec3::new(0.3, 0.4, 0.0), 0.0, 1.0).unwrap();
    let EnclosedRay { origin, direction, .. } = map.pull_back(&EnclosedRay::exact(&ray));
    assert_eq!([origin, direction].map(|v| v.map(|x| x.is_zero())), [[false, false, true]; 2]);
}

/// The radii are so small that all products with them round to 0. [INST-3]
#[test]
fn the_least_radii_count() {
    let map = AffineMap::new([[3.0, -4.0, 0.0, 0.0], [4.0, 3.0, 0.0, 0.0], [0.0, 0.0, 5.0, 0.0f32]]).unwrap();
    assert!(matches!(map.inverse, Inverse::Nearest(_)));
    let least = [Interval::between([-5e-324, 5e-324]); 3];
    is_held(&map, &EnclosedRay::new(least, least)).unwrap();
}

/// Mirrors, quarter turns and powers of two. [INST-3]
#[test]
fn turned_rays_stay_exact() {
    let v = [Interval::exact(0.1), Interval::between([-3.0, 5.0]), Interval::between([7.0, 7.5])];
    for columns in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for factors in
            [[1.0, 1.0, 1.0], [-1.0, 0.5, -8.0], [4.0, -0.25, power_of_two(1000)], [-power_of_two(1000), -2.0, 1.0]]
        {
            let mut rows = [[0.0; 4]; 3];
            for (row, (column, factor)) in rows.iter_mut().zip(columns.into_iter().zip(factors)) {
                row[column] = factor;
            }
            let map = AffineMap::new(rows).unwrap();
            assert!(matches!(map.inverse, Inverse::Turned(_)));
            let found = map.pull_back(&EnclosedRay::new(v, v));
            for row in 0..3 {
                let [lo, hi] = v[row].ends().map(|x| x / factors[row]);
                let expected = Interval::between([lo.min(hi), lo.max(hi)]);
                assert_eq!([found.origin, found.direction].map(|v| v[columns[row]]), [expected; 2]);
            }
        }
    }
}

/// Shears by doubles: the result may be an interval, but the ray can still be exact. [INST-3]
#[test]
fn sheared_rays_may_stay_exact() {
    let map = AffineMap::new([[1.0, 3.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 7.0, 1.0, 0.0f32]]).unwrap();
    let ray = Ray::within(DVec3::new(1.5, 2.5, -1.0), DVec3::new(1.0, 0.25, 3.0), 0.0, 1.0).unwrap();
    let EnclosedRay { origin, direction, .. } = map.pull_back(&EnclosedRay::exact(&ray));
    assert_eq!(origin, [1.5 - 5.0 - 7.5, 2.5, -1.0 - 17.5].map(Interval::exact));
    assert_eq!(direction, [0.25, 0.25, 1.25].map(Interval::exact));
}

/// Exact rays pass through two maps that rotate and scale by powers of two, down to subnormal numbers. They must be
/// reported as exact only if they are. [INST-3]
#[test]
fn turned_rays_are_held_at_thresholds() {
    let (mut draw, mut seen) = (Draw::new(1), [0; 2]);
    for _ in 0..20_000 {
        let numbers = [(); 6].map(|()| draw.threshold());
        let exact_ray = |v: &[f64]| [0, 1, 2].map(|k| Interval::exact(v[k]));
        let mut bounds = EnclosedRay::new(exact_ray(&numbers[..3]), exact_ray(&numbers[3..]));
        let [mut o, mut d] = [&numbers[..3], &numbers[3..]].map(|v| [0, 1, 2].map(|k| exact(v[k])));
        for _ in 0..2 {
            let (first, mut rows) = (draw.below(3), [[0.0; 4]; 3]);
            for (axis, row) in rows.iter_mut().enumerate() {
                row[(first + axis) % 3] = f64::from(draw.sign()) * power_of_two(exponent(&mut draw, numbers[axis]));
                row[3] = if draw.one_in(2) { draw.threshold() } else { 0.0 };
            }
            let map = AffineMap::new(rows).unwrap();
            assert!(matches!(map.inverse, Inverse::Turned(_)));
            o = solution(&map, &[0, 1, 2].map(|k| &o[k] - exact(rows[k][3])));
            d = solution(&map, &d);
            bounds = map.pull_back(&bounds);
        }
        for (found, expected) in bounds.origin.iter().chain(&bounds.direction).zip(o.iter().chain(&d)) {
            assert!(holds(*found, expected), "{found:?} {numbers:?}");
            seen[usize::from(found.is_exact())] += 1;
        }
    }
    assert!(seen.into_iter().all(|seen| seen > 20_000), "{seen:?}");
}
