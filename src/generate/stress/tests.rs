use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec3};

use super::*;
use crate::geom::Aabb;

pub(super) const RAYS: usize = 200;

pub(super) fn named(name: &str) -> StressCase {
    case(name, RAYS).unwrap_or_else(|| panic!("no case {name}"))
}

/// Returns the triangle at which a ray of most cases is aimed.
pub(super) fn aimed_at(case: &StressCase, i: usize) -> [Vec3; 3] {
    case.mesh.triangle(i % case.mesh.triangles().len())
}

fn vertices_and_numbers(case: &StressCase) -> impl Iterator<Item = f32> {
    let numbers = |ray: &Ray| {
        let ([a, b, c], [d, e, f]) = (ray.origin().to_array(), ray.direction().to_array());
        [a, b, c, d, e, f, ray.tmin(), ray.tmax()]
    };
    case.mesh.vertices().iter().flat_map(Vec3::to_array).chain(case.rays.iter().flat_map(numbers))
}

#[test]
fn there_are_enough_cases_of_different_names() {
    assert!(NAMES.len() >= 60, "{}", NAMES.len());
    assert_eq!(NAMES.iter().collect::<BTreeSet<_>>().len(), NAMES.len());
    for name in NAMES {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-^".contains(c);
        assert!(!name.is_empty() && name.chars().all(plain), "{name}");
    }
    assert_eq!(case("no such case", 1), None);
}

#[test]
fn every_case_has_its_size_and_its_rays() {
    assert!(cases(3).map(|case| case.name).eq(NAMES));
    let mut abouts = BTreeSet::new();
    for case in cases(RAYS) {
        assert_eq!(case.rays.len(), RAYS, "{}", case.name);
        assert!((12..=2000).contains(&case.mesh.triangles().len()), "{}", case.name);
        assert!(abouts.insert(case.about) && !case.about.contains('\n'), "{}", case.name);
        let distinct: BTreeSet<_> = case.rays.iter().map(|ray| format!("{ray:?}")).collect();
        assert!(distinct.len() * 3 > RAYS, "{}: {} different rays", case.name, distinct.len());
    }
}

#[test]
fn the_first_rays_do_not_depend_on_how_many_there_are() {
    for (few, many) in cases(9).zip(cases(40)) {
        assert_eq!(few.mesh, many.mesh, "{}", few.name);
        assert_eq!(few.rays, many.rays[..9], "{}", few.name);
    }
}

/// Tests a hit in double precision, which suffices except for the most difficult rays.
fn hits(corners: [Vec3; 3], ray: &Ray) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
    let (e1, e2, s) = (b - a, c - a, origin - a);
    let (p, q) = (direction.cross(e2), s.cross(e1));
    let det = e1.dot(p);
    let (u, v, t) = (s.dot(p) / det, direction.dot(q) / det, e2.dot(q) / det);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= ray.tmin().into() && t <= ray.tmax().into()
}

#[test]
fn rays_hit_and_miss() {
    let mut missed = 0;
    for case in cases(RAYS) {
        let triangles = case.mesh.triangles().len();
        let hit = |ray: &&Ray| (0..triangles).any(|i| hits(case.mesh.triangle(i), ray));
        let hits = case.rays.iter().filter(hit).count();
        assert!(hits * 8 > RAYS, "{}: {hits} of {RAYS} hit", case.name);
        missed += usize::from(hits < RAYS);
    }
    assert!(missed * 2 > NAMES.len(), "{missed}");
}

/// This checksum of all bits of all cases is equal on every machine. Intended changes must update it.
#[test]
fn the_cases_are_the_same_everywhere() {
    let mut hash = 0_u64;
    for case in cases(100) {
        let bits = vertices_and_numbers(&case).map(f32::to_bits);
        for bits in bits.chain(case.mesh.triangles().iter().flatten().copied()) {
            hash = hash.rotate_left(5).wrapping_add(u64::from(bits)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
    }
    assert_eq!(hash, 0x5322_d9ea_7bfb_9791, "{hash:#x}");
}

fn assert_closed(name: &str, mesh: &Mesh) {
    let mut edges = BTreeMap::<[u32; 2], [u32; 2]>::new();
    for &[a, b, c] in mesh.triangles() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            edges.entry([from.min(to), from.max(to)]).or_default()[usize::from(from > to)] += 1;
        }
    }
    assert!(edges.iter().all(|([a, b], &there_and_back)| a < b && there_and_back == [1, 1]), "{name} is open");
}

/// Returns the winding number of the mesh around a point: the solid angles of its triangles (Van Oosterom & Strackee
/// 1983) divided by 4 pi.
///
/// On the surface it is not an integer. Axes may be scaled beforehand.
fn winding(vertices: &[DVec3], triangles: &[[u32; 3]], origin: DVec3) -> f64 {
    let half_angle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| (vertices[corner as usize] - origin).normalize());
        a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    triangles.iter().map(half_angle).sum::<f64>() / (2.0 * std::f64::consts::PI)
}

#[test]
fn closed_cases_are_closed_and_their_origins_inside() {
    let closed: Vec<_> = cases(100).filter(|case| case.closed).collect();
    assert!(closed.len() >= 15);
    for case in closed {
        assert_closed(case.name, &case.mesh);
        let bounds = Aabb::of(case.mesh.vertices());
        let size = bounds.hi.as_dvec3() - bounds.lo.as_dvec3();
        let unit = |v: Vec3| (v.as_dvec3() - bounds.lo.as_dvec3()) / size;
        let vertices: Vec<_> = case.mesh.vertices().iter().copied().map(unit).collect();
        for ray in &case.rays {
            assert_eq!((ray.tmin(), ray.tmax()), (0.0, f32::INFINITY), "{}", case.name);
            let turns = winding(&vertices, case.mesh.triangles(), unit(ray.origin()));
            assert!((turns.abs() % 2.0 - 1.0).abs() < 1e-6, "{}: {turns} turns around {ray:?}", case.name);
        }
    }
}

#[test]
fn the_sphere_has_its_size_and_shape() {
    for level in 0..=6 {
        let sphere = icosphere(level, 1.0, Vec3::ZERO).expect("a sphere");
        assert_eq!(sphere.triangles().len(), 20 << (2 * level));
        assert_eq!(sphere.vertices().len(), (10 << (2 * level)) + 2);
        assert!(sphere.vertices().iter().all(|v| (v.as_dvec3().length() - 1.0).abs() < 1.1e-7));
        assert_closed("icosphere", &sphere);
        let vertices: Vec<_> = sphere.vertices().iter().map(|v| v.as_dvec3()).collect();
        assert!((winding(&vertices, sphere.triangles(), DVec3::ZERO) - 1.0).abs() < 1e-9);
        // The rays along axes depend on this.
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let all: BTreeSet<_> = sphere.vertices().iter().map(|&v| bits(v + 0.0)).collect();
        assert!(sphere.vertices().iter().all(|&v| all.contains(&bits(-v + 0.0))));
        assert!(sphere.vertices().iter().all(|&v| all.contains(&bits(v * Vec3::new(-1.0, 1.0, 1.0) + 0.0))));
    }
    assert!(icosphere(14, 1.0, Vec3::ZERO).is_err() && icosphere(1, f32::MAX, Vec3::splat(f32::MAX)).is_err());
    let far = icosphere(6, 1.0, Vec3::splat(1e6)).expect("a sphere");
    assert_eq!(far.triangles().len(), 81_920);
    assert_closed("far", &far);
    assert!(far.vertices().iter().all(|v| (v.as_dvec3() - 1e6).length() < 1.06));
}

#[test]
fn extremes_are_reached() {
    let any = |name: &str, wanted: fn(f32) -> bool| vertices_and_numbers(&named(name)).filter(|&x| wanted(x)).count();
    let subnormal = |x: f32| x != 0.0 && !x.is_normal() && x.is_finite();
    for name in ["edge-2^-149", "edge-2^-132", "scale-1e-38", "scale-1e-43", "sphere-subnormal", "max-and-tiny"] {
        assert!(any(name, subnormal) > 50, "{name}");
    }
    for name in ["near-max", "max-and-tiny"] {
        assert!(any(name, |x| x.is_finite() && x.abs() > f32::MAX * 0.5) > 50, "{name}");
    }
    for name in ["direction-subnormal", "direction-2^-149", "plane-exit", "reciprocal-overflow"] {
        let odd = |ray: &&Ray| ray.direction().to_array().into_iter().any(subnormal);
        assert!(named(name).rays.iter().filter(odd).count() > 60, "{name}");
    }
    let overflows = |x: f32| x != 0.0 && x.recip().is_infinite();
    let rays = named("reciprocal-overflow").rays;
    assert!(rays.iter().filter(|ray| ray.direction().to_array().into_iter().any(overflows)).count() > 60);
    let negative_zero = |x: f32| x == 0.0 && x.is_sign_negative();
    for name in ["signed-zeros", "axis-grid", "plane-origin", "soup-mixed"] {
        let rays = named(name).rays;
        let count = rays.iter().filter(|ray| ray.direction().to_array().into_iter().any(negative_zero)).count();
        assert!(count > 10, "{name}: {count}");
    }
    let t = |name: &str| {
        let case = named(name);
        let height = move |(i, ray): (usize, &Ray)| {
            (f64::from(aimed_at(&case, i)[0].z) - f64::from(ray.origin().z)) / f64::from(ray.direction().z)
        };
        named(name).rays.iter().enumerate().map(height).map(|t| t as f32).collect::<Vec<_>>()
    };
    let far = t("t-overflow");
    assert!(far.iter().filter(|t| t.is_infinite()).count() > 20 && far.iter().filter(|t| t.is_finite()).count() > 20);
    let near = t("t-underflow");
    assert!(near.iter().filter(|&&t| t == 0.0).count() > 20 && near.iter().filter(|&&t| subnormal(t)).count() > 20);
}

#[test]
fn boxes_are_met_where_said() {
    let case = named("plane-origin");
    let on_a_plane = |ray: &Ray| {
        let aabbs = (0..case.mesh.triangles().len()).map(|i| Aabb::of(&case.mesh.triangle(i)));
        let mut planes = aabbs.flat_map(|aabb| [aabb.lo, aabb.hi]);
        let (origin, direction) = (ray.origin(), ray.direction());
        planes.any(|plane| (0..3).any(|axis| direction[axis] == 0.0 && origin[axis] == plane[axis]))
    };
    assert!(case.rays.iter().all(on_a_plane));
    let flat = |corners: [Vec3; 3]| Aabb::of(&corners).extent().min_element() == 0.0;
    let case = named("flat-box");
    assert!((0..case.mesh.triangles().len()).all(|i| flat(case.mesh.triangle(i))));
    let case = named("point-box");
    let points = (0..case.mesh.triangles().len()).filter(|&i| Aabb::of(&case.mesh.triangle(i)).extent() == Vec3::ZERO);
    assert!(points.count() >= 180);

    // The published ray and box for which 2 ulps of padding fail.
    let case = named("ize");
    let bits = |v: Vec3| v.to_array().map(f32::to_bits);
    let known = |ray: &&Ray| {
        (bits(ray.origin()), bits(ray.direction())) == ([0x33fd_9472, 0xb3f2_3a88, 0], [0x3feb_b676, 0x3ffe_1fe8, 0])
    };
    assert_eq!(case.rays.iter().filter(known).count(), RAYS / 4);
    let boxes = (0..case.mesh.triangles().len()).map(|i| Aabb::of(&case.mesh.triangle(i)));
    let lo = Vec3::new(f32::from_bits(0x4000_4c97), -1.0, -1.0);
    let hi = Vec3::new(9.0, f32::from_bits(0x400a_5221), 1.0);
    assert!(boxes.filter(|aabb| (aabb.lo, aabb.hi) == (lo, hi)).count() > 10);
}

#[test]
fn aimed_rays_are_many_and_of_all_kinds() {
    for name in ["soup", "strands", "sphere-at-1e6", "near-max", "scale-1e-43", "axes-apart", "wild", "point-box"] {
        let mesh = named(name).mesh;
        let rays = aimed(&mesh, 3, 1600);
        assert_eq!(rays.len(), 1600, "{name}");
        assert_eq!(rays, aimed(&mesh, 3, 1600));
        assert_ne!(rays, aimed(&mesh, 4, 1600));
        assert_eq!(rays[..100], aimed(&mesh, 3, 100));
        let count = |f: fn(&Ray) -> bool| rays.iter().filter(|ray| f(ray)).count();
        assert!(count(|ray| ray.direction().cmpeq(Vec3::ZERO).bitmask().count_ones() == 2) >= 100, "{name}");
        assert!(count(|ray| ray.tmin() > 0.0 && ray.tmax() == f32::INFINITY) >= 50, "{name}");
        assert!(count(|ray| ray.tmin() == 0.0 && ray.tmax() < f32::INFINITY) >= 50, "{name}");
        assert!(count(|ray| (ray.direction().length() - 1.0).abs() < 1e-6) >= 190, "{name}");
        let from_corners = |ray: &&Ray| mesh.vertices().contains(&ray.origin());
        assert!(rays.iter().filter(from_corners).count() >= 50, "{name}");
    }
    let point = Mesh::new(vec![Vec3::ONE], vec![[0; 3]]).expect("a mesh");
    assert!(aimed(&point, 1, 160).len() >= 100);
}
