//! Instances with numbers at thresholds of the format: powers of two, the least normal number, subnormal numbers.
//! Rounded results there must not be treated as exact.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::Builder;
use stackless_bvh::generate::draw::{Draw, one_of};
use stackless_bvh::generate::{Rng, Source};
use stackless_bvh::geom::{Mesh, Ray, Real, Vector};
use stackless_bvh::trace::InstanceTracer;
use stackless_bvh::traverse::Method;
use stackless_check::{InstanceOracle, Shape, check_answer};

use super::scenes::{Kind, Scene, narrow, placed};
use super::{assembly, hierarchies, rays};

/// 2 to this power, from -1074 on.
fn power(exponent: i32) -> f64 {
    2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

fn diagonal(x: f64, offset: f64) -> [[f64; 4]; 3] {
    [[x, 0.0, 0.0, offset], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
}

/// A triangle that these maps place one in another, the innermost first.
fn shapes<V: Vector>(corners: [[f64; 3]; 3], maps: &[[[f64; 4]; 3]]) -> Vec<Shape<V>> {
    let mesh = Mesh::new(corners.map(|corner| narrow(DVec3::from(corner))).to_vec(), vec![[0, 1, 2]]).expect("a mesh");
    placed(mesh, maps)
}

/// The distance and the first weight, which must be those of rational arithmetic.
fn closest<V: Kind>(
    corners: [[f64; 3]; 3],
    maps: &[[[f64; 4]; 3]],
    [origin, direction]: [[f64; 3]; 2],
    tmin: f64,
) -> Option<[f64; 2]> {
    let shapes = shapes::<V>(corners, maps);
    let scene = Scene { name: "thresholds".into(), shapes };
    let (assembly, object) = assembly(&hierarchies(&scene, Builder::Standard, 1), &scene);
    let tracer = InstanceTracer::new(&assembly, object, Method::default()).expect("any tree");
    let [o, d] = [origin, direction].map(|v| narrow::<V>(DVec3::from(v)));
    let ray = Ray::within(o, d, V::Real::rounded(tmin), V::Real::INFINITY).expect("a ray");
    let expected = InstanceOracle::new(&scene.shapes).all(&ray);
    check_answer(&tracer, &expected, &ray).unwrap_or_else(|fault| panic!("{maps:?}, {ray:?}: {fault}"));
    expected.first().map(|hit| [hit.t.into(), hit.u.into()])
}

/// A coordinate that lacks half of the last subnormal digit becomes the least normal number: it was believed to be that,
/// and exact sums decided about another ray. `[INST-3]`
#[test]
fn what_is_rounded_up_to_the_least_normal_number_is_not_exact() {
    let (least, most) = (f64::MIN_POSITIVE, power(-1000));
    let map = [diagonal(power(1000), 0.0)];
    let line = [[(2.0 - f64::EPSILON) * power(-23), 0.0, -1.0], [0.0, 0.0, 1.0]];
    let beside = [[least, -most, 0.0], [least, most, 0.0], [most, 0.0, 0.0]];
    let on_edge = [[least.next_down(), -3.0 * most, 0.0], [least, most, 0.0], [-most, 0.0, 0.0]];
    assert_eq!(closest::<DVec3>(beside, &map, line, 0.0), None);
    assert_eq!(closest::<DVec3>(on_edge, &map, line, 0.0), Some([1.0, 0.75]));
}

/// The same in maps of maps. `[INST-3]`
#[test]
fn what_nested_maps_round_is_not_exact() {
    let wall = [[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]];
    let (line, offset) = ([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], power(-53));
    let two = [diagonal(power(22), 0.0), diagonal(power(1000), offset)];
    assert_eq!(closest::<DVec3>(wall, &two, line, 0.0), Some([1f64.next_down(), 0.25]));
    let mut nine = [diagonal(power(127), 0.0); 9];
    (nine[0], nine[8]) = (diagonal(power(6), 0.0), diagonal(power(127), offset));
    assert_eq!(closest::<Vec3>(wall, &nine, line, 1.0), None);
}

/// Draws a map of axes to axes, by powers of two up to this exponent, and sometimes by numbers next to powers of two.
fn map(draw: &mut Draw, most: i32) -> [[f64; 4]; 3] {
    let (first, mut rows) = (draw.below(3), [[0.0; 4]; 3]);
    for (axis, row) in rows.iter_mut().enumerate() {
        let far = most - draw.int(2).abs() as i32;
        let exponent = one_of([0, 0, draw.int(2) as i32, far, -far, draw.int(most) as i32], draw);
        let x = f64::from(draw.sign()) * power(exponent);
        row[(first + axis) % 3] = if draw.one_in(16) { x * (1.0 + f64::EPSILON) } else { x };
        row[3] = one_of([0.0, 0.0, draw.threshold(), power(-53), 1.0], draw);
    }
    rows
}

/// A vector with each component moved by up to two floats.
fn nudged<V: Vector>(draw: &mut Draw, v: V) -> V {
    V::from_components(v.components().map(|x| match draw.below(6) {
        0 => x.next_up(),
        1 => x.next_down(),
        2 => x.next_up().next_up(),
        _ => x,
    }))
}

/// Triangles of small whole numbers, moved by the inverse of up to nine maps and then by the maps; rays at them, and next
/// to them. `[INST-3]` `[INST-5]`
fn thresholds_are_answered_by_rational_arithmetic<V: Kind>(most: i32, rounds: usize) {
    let (mut draw, mut rng, mut asked, mut hits) = (Draw::new(1), Rng::new(1), 0, 0);
    for round in 0..rounds {
        let levels = if round % 8 == 0 { 9 } else { 1 + draw.below(3) };
        let maps: Vec<_> = (0..levels).map(|_| map(&mut draw, most)).collect();
        let corners = [(); 3].map(|()| {
            let image = maps.iter().rev().fold(draw.ints(2).as_dvec3().to_array(), |image, rows| {
                let mut v = [0.0; 3];
                for (row, x) in rows.iter().zip(image) {
                    let column = row.iter().position(|entry| *entry != 0.0).unwrap_or_default();
                    v[column] = (x - row[3]) / row[column];
                }
                v
            });
            nudged::<V>(&mut draw, narrow(DVec3::from(image)))
        });
        let is_finite = |x: f64| -> bool { f64::is_finite(V::Real::rounded(x).into()) };
        let are_maps = maps.as_flattened().as_flattened().iter().all(|&x| is_finite(x));
        if !are_maps || !corners.iter().all(|&corner| V::is_finite(corner)) {
            continue;
        }
        let shapes = shapes::<V>(corners.map(|corner| corner.widen().to_array()), &maps);
        let (flat, scene) = (InstanceOracle::new(&shapes), Scene { name: format!("{round}"), shapes });
        let Ok((assembly, objects)) = hierarchies(&scene, Builder::Standard, 1).assembly(&scene.shapes) else {
            continue;
        };
        let tracer = InstanceTracer::new(&assembly, objects[levels], Method::default()).expect("any tree");
        let Some([a, b, c]) = flat.corners().next().copied().map(|corners| corners.map(Vector::widen)) else {
            continue;
        };
        let mut cases = rays(&flat, &mut rng, 4);
        for _ in 0..12 {
            let [u, v] = one_of([[0.0, 0.0], [0.5, 0.0], [0.25, 0.5], [0.25, 0.25]], &mut draw);
            let target = nudged::<V>(&mut draw, narrow(a + (b - a) * u + (c - a) * v));
            let (axis, back) = (draw.axis().as_dvec3(), 1.0 + f64::from(draw.int(1)));
            let end = if rng.coin() { V::Real::ZERO } else { V::Real::ONE };
            let origin = narrow::<V>(target.widen() - axis * back);
            cases.extend(Ray::within(origin, narrow(axis), end, V::Real::INFINITY));
        }
        for ray in &cases {
            asked += 1;
            let expected = flat.all(ray);
            hits += usize::from(!expected.is_empty());
            check_answer(&tracer, &expected, ray)
                .unwrap_or_else(|fault| panic!("{round}: {maps:?} {corners:?} {ray:?}: {fault}"));
        }
    }
    assert!(asked > 5 * rounds && hits > asked / 20, "{hits} of {asked}");
}

#[test]
fn thresholds_are_answered_by_rational_arithmetic_in_single() {
    thresholds_are_answered_by_rational_arithmetic::<Vec3>(127, 2000);
}

#[test]
fn thresholds_are_answered_by_rational_arithmetic_in_double() {
    thresholds_are_answered_by_rational_arithmetic::<DVec3>(1000, 300);
}
