use dashu_int::IBig;
use glam::{DVec3, Vec3};

use super::*;
use crate::generate::{Rng, Source, procedural};
use crate::geom::truth::{Place, RBig};

/// Draws a number in -1..1.
fn unit(random: &mut Rng) -> f32 {
    (random.bits() >> 40) as f32 / f32::powi(2.0, 23) - 1.0
}

fn point(random: &mut Rng) -> Vec3 {
    Vec3::new(unit(random), unit(random), unit(random))
}

/// Returns rays at corners, midpoints of edges and points close to the mesh, from anywhere, along axes and off them,
/// with and without ends. Invalid rays are omitted.
fn rays(mesh: &Mesh, seed: u64, n: usize) -> Vec<Ray> {
    let mut random = Rng::new(seed);
    let corners = mesh.vertices();
    let lo = corners.iter().fold(Vec3::INFINITY, |lo, corner| lo.min(*corner));
    let hi = corners.iter().fold(Vec3::NEG_INFINITY, |hi, corner| hi.max(*corner));
    let ray = |i: usize| {
        let [a, b, _] = mesh.triangle(random.below(mesh.triangles().len() as u64) as usize);
        let any = lo * 0.5 + hi * 0.5 + (hi * 0.5 - lo * 0.5) * point(&mut random);
        let aim = [a, a * 0.5 + b * 0.5, any][i % 3];
        let mut origin = [corners[random.below(corners.len() as u64) as usize], any * 2.0 - aim, any][i / 3 % 3];
        if (i / 9).is_multiple_of(3) {
            // Along an axis, or with a zero component of either sign.
            let axis = random.below(3) as usize;
            let moved = origin[axis];
            origin = if random.coin() { aim.with_x(moved) } else { origin };
            origin[axis] = if random.coin() { aim[axis] } else { moved };
        }
        let mut direction = aim - origin;
        if i.is_multiple_of(7) {
            direction = direction.map(|x| if x == 0.0 { -0.0 } else { x });
        }
        let [tmin, tmax] = [[0.0, f32::INFINITY], [0.0, 1.0], [1.0, 2.0], [0.5, 0.75]][random.below(4) as usize];
        Ray::within(origin, direction, tmin, tmax).ok()
    };
    (0..n).filter_map(ray).collect()
}

/// Compares every answer with the definition. Returns the numbers of hits and of candidates.
fn compare(mesh: &Mesh, rays: &[Ray]) -> (usize, usize) {
    let truth = Truth::new(mesh);
    let (mut hits, mut candidates) = (0, 0);
    for ray in rays {
        let all = brute_force(mesh, ray);
        assert_eq!(truth.all(ray), all, "{ray:?}");
        assert_eq!(truth.closest(ray).as_ref(), all.first(), "{ray:?}");
        assert_eq!(truth.any(ray), !all.is_empty(), "{ray:?}");
        hits += usize::from(!all.is_empty());
        candidates += truth.candidates(ConservativeCull::new(ray)).count();
    }
    (hits, candidates)
}

/// Compares like [`compare`], for a mesh with many hits and few candidates.
fn compare_well(mesh: &Mesh, seed: u64) {
    let mut rays = rays(mesh, seed, 600);
    rays.extend(procedural::rays(mesh, seed, 200));
    let (hits, candidates) = compare(mesh, &rays);
    assert!(rays.len() > 400 && hits * 4 > rays.len(), "{hits} hits of {} rays", rays.len());
    let share = candidates as f64 / (rays.len() * mesh.triangles().len()) as f64;
    assert!(share < 0.25, "{share} of the triangles are tested");
}

/// Returns the mesh with changed corners, which must stay finite.
fn changed(mesh: &Mesh, change: impl Fn(Vec3) -> Vec3) -> Mesh {
    let corners = mesh.vertices().iter().map(|corner| change(*corner)).collect();
    Mesh::new(corners, mesh.triangles().to_vec()).expect("a mesh")
}

/// Returns a cube of `n` squares along an edge, with integer corners and two triangles per square.
fn cube(n: i16) -> Mesh {
    let (mut corners, mut triangles) = (Vec::new(), Vec::new());
    for face in 0..6 {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let first = corners.len() as u32;
            for (i, j) in [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)] {
                let mut corner = [i, j, n * (face % 2)].map(f32::from);
                corner.rotate_right(face as usize / 2);
                corners.push(Vec3::from_array(corner));
            }
            triangles.extend([[first, first + 1, first + 2], [first + 1, first + 3, first + 2]]);
        }
    }
    Mesh::new(corners, triangles).expect("a mesh")
}

fn mesh(corners: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh::new(corners.iter().copied().map(Vec3::from_array).collect(), triangles.to_vec()).expect("a mesh")
}

fn ray(origin: [f32; 3], direction: [f32; 3], tmin: f32, tmax: f32) -> Ray {
    Ray::within(origin.into(), direction.into(), tmin, tmax).expect("a ray")
}

fn prims(hits: &[TrueHit]) -> Vec<u32> {
    hits.iter().map(|hit| hit.prim).collect()
}

const LEGS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const END: f32 = f32::INFINITY;

#[test]
fn nothing_that_is_hit_is_left_out() {
    compare_well(&procedural::soup(1, 300), 1);
    compare_well(&procedural::strands(2, 12), 2);
    // Flat boxes, axis rays through edges and corners.
    compare_well(&cube(6), 3);
    for n in [1, 2, 3] {
        let mesh = procedural::soup(4, n);
        compare(&mesh, &rays(&mesh, 4, 300));
    }
}

#[test]
fn nothing_that_is_hit_is_left_out_at_any_scale_and_offset() {
    for (seed, scale) in (10..).zip([1e30, 1e-30, 1e37, 1e-37, 1e-43]) {
        compare_well(&changed(&procedural::soup(seed, 200), |corner| corner * scale), seed);
        // Rays between corners with the least numbers often have no direction. The remaining rays have enough hits.
        compare_well(&changed(&cube(5), |corner| corner * scale), seed);
    }
    for (seed, offset) in (20..).zip([1e6, -1e6]) {
        compare_well(&changed(&cube(5), |corner| corner + offset), seed);
        compare_well(&changed(&procedural::soup(seed, 200), |corner| corner * 100.0 + offset), seed);
    }
    // The margin exceeds the small sides of this mesh.
    let flat = changed(&cube(5), |corner| corner * Vec3::new(1e20, 1.0, 1e-20));
    assert!(compare(&flat, &rays(&flat, 30, 600)).0 > 150);
    let flat = changed(&procedural::soup(31, 200), |corner| corner * Vec3::new(1.0, 0.0, 0.5));
    let hits = compare(&flat, &procedural::rays(&flat, 31, 600)).0;
    assert!(hits > 100, "{hits}");
}

#[test]
fn nothing_that_is_hit_is_left_out_between_the_least_and_the_greatest_numbers() {
    let mut random = Rng::new(40);
    let mut hits = 0;
    for _ in 0..200 {
        let mut number = || loop {
            let x = f32::from_bits(random.bits() as u32);
            if x.is_finite() {
                return if random.below(8) == 0 { 0.0 } else { x };
            }
        };
        let corners: Vec<_> = (0..24).map(|_| Vec3::new(number(), number(), number())).collect();
        let mut rays: Vec<_> = (0..10)
            .filter_map(|_| {
                let [origin, direction] = [(); 2].map(|()| Vec3::new(number(), number(), number()));
                Ray::within(origin, direction, 0.0, END).ok()
            })
            .collect();
        let mesh = Mesh::new(corners, (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh");
        rays.extend(self::rays(&mesh, 41, 20));
        hits += compare(&mesh, &rays).0;
    }
    assert!(hits > 500, "{hits}");
}

#[test]
fn without_the_margin_rounding_would_leave_out_a_hit() {
    // 1 + 2^-53 is 321 times a number of 45 bits, the exact distance to the first corner of the triangle. The sum
    // rounds to 1. A 321st of 1 is less than the distance to the other plane, which involves no rounding.
    const WHOLE: u32 = 28_059_810_762_433_u64.div_euclid(1 << 22) as u32;
    const REST: u32 = 28_059_810_762_433_u64.rem_euclid(1 << 22) as u32;
    let unit = f32::powi(2.0, -53);
    let x = WHOLE as f32 * (f32::powi(2.0, 22) * unit);
    let mesh = mesh(&[[x, 1.0, 0.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]], &[[0, 1, 2]]);
    let ray = ray([-(REST as f32) * unit, -unit, 0.0], [1.0, 321.0, 0.0], 0.0, END);
    assert_eq!(Truth::new(&mesh).closest(&ray).map(|hit| hit.point.place), Some(Place::Vertex));
    let [near, far] = [(f64::from(x) - f64::from(ray.origin().x)), (1.0 - f64::from(ray.origin().y)) / 321.0];
    assert!(far < near);
}

/// Even for tiny differences: half an ulp of the rounded distance, or many ulps. [EXACT-1]
#[test]
fn the_nearer_triangle_comes_first_and_the_lower_one_of_equals() {
    for (least, is_apart) in [(0.0, false), (1e-40, false), (f32::EPSILON, true)] {
        let nearer = LEGS.map(|[x, y, _]| [x, y, -least]);
        let corners: Vec<_> = LEGS.into_iter().chain(nearer).collect();
        let mesh = mesh(&corners, &[[0, 1, 2], [3, 4, 5]]);
        let hits = Truth::new(&mesh).all(&ray([0.25, 0.25, -1.0], [0.0, 0.0, 1.0], 0.0, END));
        let is_turned = least > 0.0;
        assert_eq!(hits.iter().map(|hit| hit.prim).collect::<Vec<_>>(), if is_turned { [1, 0] } else { [0, 1] });
        assert_eq!((hits[0].point.t < hits[1].point.t, hits[0].t < hits[1].t), (is_turned, is_apart));
    }
}

/// Returns the closest hit, by both methods.
fn closest(mesh: &Mesh, ray: &Ray) -> Option<TrueHit> {
    compare(mesh, &[*ray]);
    brute_force(mesh, ray).into_iter().next()
}

#[test]
fn the_interval_is_compared_with_the_exact_distance() {
    // The distance is 1/3, and the nearest float is above it.
    let mesh = mesh(&LEGS, &[[0, 1, 2]]);
    let third = 1.0f32 / 3.0;
    for (tmin, tmax, is_hit) in
        [(0.0, third, true), (0.0, third.next_down(), false), (third, END, false), (third.next_down(), END, true)]
    {
        let ray = ray([0.25, 0.25, -1.0], [0.0, 0.0, 3.0], tmin, tmax);
        assert_eq!(closest(&mesh, &ray).map(|hit| hit.t), is_hit.then_some(third), "{tmin} {tmax}");
    }
    // Both ends are included, at the origin too.
    let at = |z, t| closest(&mesh, &ray([0.25, 0.25, z], [0.0, 0.0, 1.0], t, t)).is_some();
    assert!(at(-1.0, 1.0) && at(0.0, 0.0) && !at(1e-45, 0.0) && !at(-1e-45, 0.0));
}

#[test]
fn a_distance_beyond_all_floats_is_infinite() {
    let mesh = mesh(&LEGS, &[[0, 1, 2]]);
    let up_to = |tmax| closest(&mesh, &ray([0.25, 0.25, -1.0], [0.0, 0.0, 1e-40], 0.0, tmax));
    let hit = up_to(END).expect("a hit");
    assert_eq!(hit.t, END);
    assert!(hit.point.t > RBig::from(IBig::ONE << 128));
    assert_eq!(up_to(f32::MAX), None);
}

#[test]
fn all_triangles_at_a_corner_and_an_edge_are_hit_and_degenerate_ones_are_not() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let fan = mesh(&corners, &[[0, 1, 2], [0, 2, 3], [1, 0, 3], [0, 3, 4], [0, 0, 1], [4, 1, 0]]);
    let truth = Truth::new(&fan);
    let at = |x, y| truth.all(&ray([x, y, -1.0], [0.0, 0.0, 1.0], 0.0, END));
    assert_eq!(prims(&at(0.0, 0.0)), [0, 1, 3, 5]);
    assert!(at(0.0, 0.0).iter().all(|hit| hit.point.place == Place::Vertex));
    assert_eq!(prims(&at(0.0, 0.5)), [0, 1]);
    assert!(at(0.0, 0.5).iter().all(|hit| hit.point.place == Place::Edge));
    assert_eq!(at(0.25, 0.5).iter().map(|hit| (hit.prim, hit.point.place)).collect::<Vec<_>>(), [(0, Place::Interior)]);
    assert_eq!(prims(&at(1.0, 1.0)), [0; 0]);
}

/// Double precision at its limits: the conservative test must not skip hits, and should skip misses.
#[test]
fn nothing_that_is_hit_is_left_out_in_double_precision() {
    let soup = procedural::soup(50, 60);
    let mut random = Rng::new(51);
    for scale in [1.0, 1e12, 1e100, 1e-100, 1e-119, 1e-121, 1e119, 1e121, 1e-300, 1e298, 1e-321] {
        for offset in [0.0, 1.0, 1e9] {
            let place = |v: Vec3| (v.as_dvec3() + offset) * scale;
            let corners: Vec<_> = soup.vertices().iter().copied().map(place).collect();
            let mesh = Mesh::new(corners, soup.triangles().to_vec()).expect("a mesh");
            let truth = Truth::new(&mesh);
            let (mut hits, mut rays, mut candidates, mut usual) = (0, 0, 0, 0);
            for ray in procedural::rays(&soup, 52, 60) {
                let by = [1.0, 1e-100, 1e100, 1e-300, 1e200][random.below(5) as usize];
                let direction = ray.direction().as_dvec3() * scale * by;
                let Ok(ray) = Ray::new(place(ray.origin()), direction) else { continue };
                let all = brute_force(&mesh, &ray);
                assert_eq!(truth.all(&ray), all, "{ray:?}");
                assert_eq!(truth.closest(&ray).as_ref(), all.first(), "{ray:?}");
                assert!(all.iter().all(|hit| hit.t == f64::nearest(&hit.point.t)));
                hits += usize::from(!all.is_empty());
                rays += 1;
                if by == 1.0 {
                    usual += 1;
                    candidates += truth.candidates(ConservativeCull::new(&ray)).count();
                }
            }
            assert!(hits * 5 > rays, "{hits} of {rays} at {scale}, {offset}");
            // With this offset the margin exceeds the mesh.
            let skips = (1e-100..=1e100).contains(&scale) && offset < 1e9;
            assert!(!skips || candidates * 2 < usual * soup.triangles().len(), "{candidates} at {scale}, {offset}");
        }
    }
}

#[test]
fn a_difference_that_overflows_leaves_nothing_out() {
    let corner = |y: f64, z: f64| DVec3::new(1.5e308, y, z);
    let mesh = Mesh::new(vec![corner(-10.0, -10.0), corner(20.0, -10.0), corner(-10.0, 20.0)], vec![[0, 1, 2]]);
    let mesh = mesh.expect("a mesh");
    let origin = DVec3::new(-1.5e308, 0.0, 0.0);
    let ray = Ray::new(origin, DVec3::new(1e308, 1.0, 0.0)).expect("a ray");
    assert_eq!(brute_force(&mesh, &ray).len(), 1);
    assert!(Truth::new(&mesh).any(&ray));
}

/// Products that underflow decide nothing, for any other factor.
#[test]
fn what_underflows_leaves_nothing_out() {
    let mut random = Rng::new(50);
    let mut number = |size: f64| (random.below(17) as f64 - 8.0) * size;
    let mut hits = 0;
    for way in [1.0, 2f64.powi(600)] {
        for _ in 0..2000 {
            let mut point = |size: f64| DVec3::new(number(size), number(size), number(size));
            let size = 2f64.powi(-540);
            let mesh = Mesh::new(vec![point(size), point(size), point(size)], vec![[0, 1, 2]]).expect("a mesh");
            let Ok(ray) = Ray::new(point(size), point(way)) else { continue };
            let is_hit = !brute_force(&mesh, &ray).is_empty();
            hits += usize::from(is_hit);
            assert!(
                !is_hit || !ConservativeCull::new(&ray).misses_triangle::<DVec3>(&corners(&mesh, 0)),
                "{mesh:?} {ray:?}"
            );
        }
    }
    assert!(hits > 100, "{hits}");
}

/// Both distances round to 0, and the second triangle is nearer.
#[test]
fn distances_that_are_rounded_to_zero_are_in_order() {
    let [size, near, far] = [-50, -52, -51].map(|e| f32::powi(2.0, e));
    let corners = |z: f32| [[-size, -size, z], [size, -size, z], [0.0, size, z]];
    let corners = [corners(far), corners(near)].concat();
    let mesh = mesh(&corners, &[[0, 1, 2], [3, 4, 5]]);
    let hit = closest(&mesh, &ray([0.0; 3], [0.0, 0.0, f32::powi(2.0, 100)], 0.0, END));
    assert_eq!(hit.map(|hit| (hit.prim, hit.t)), Some((1, 0.0)));
}
