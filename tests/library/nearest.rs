//! The nearest triangles of a point.

use glam::Vec3;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions, SpatialOptions};
use stackless_bvh::generate::{Rng, Source, procedural, stress};
use stackless_bvh::geom::{Ball, Mesh, Triangle};
use stackless_bvh::trace::{BinaryTracer, Near};
use stackless_bvh::traverse::Method;
use stackless_check::{check_distance, nearest as truth};

/// In the last one triangles are in several leaves.
fn trees(mesh: &Mesh) -> [Bvh; 2] {
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let sah = SahOptions { max_leaf: 1, ..SahOptions::default() };
    let options = BuildOptions { builder: Builder::Spatial, sah, spatial, ..BuildOptions::default() };
    let cut = options.build(mesh);
    [Bvh::sah(mesh, SahOptions::default()), cut].map(|bvh| bvh.expect("a tree"))
}

/// Loose triangles; long ones, which are cut; a closed surface; whole coordinates, each triangle twice, and degenerate
/// ones between.
fn meshes() -> [Mesh; 4] {
    let sphere = stress::icosphere(2, 1.0, Vec3::new(0.25, 0.5, -1.0)).expect("a mesh");
    let corners = (0..64).map(|i| Vec3::new((i % 4) as f32, (i / 4 % 4) as f32, (i / 16) as f32)).collect();
    let mut random = Rng::new(9);
    let corner = |random: &mut Rng| random.below(64) as u32;
    let mut whole: Vec<_> = (0..60).map(|_| [(); 3].map(|()| corner(&mut random))).collect();
    whole.extend(whole.clone());
    let whole = Mesh::new(corners, whole).expect("a mesh");
    let mut unit = || random.below(1 << 25) as f32 / (1 << 24) as f32 - 1.0;
    let long = (0..60).flat_map(|_| {
        let [a, b] = [(); 2].map(|()| Vec3::new(unit(), unit(), unit()));
        [a, b, b + Vec3::splat(0.01 * unit())]
    });
    let long = Mesh::new(long.collect(), (0..60).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh");
    [procedural::soup(1, 80), long, sphere, whole]
}

fn size(mesh: &Mesh) -> f32 {
    mesh.vertices().iter().fold(0.0, |size, corner| corner.abs().max_element().max(size))
}

/// On the mesh and near it, far away, as far from one corner as from another, and anywhere.
fn point(mesh: &Mesh, random: &mut Rng) -> Vec3 {
    let mut unit = || random.below(1 << 25) as f32 / (1 << 24) as f32 - 1.0;
    let any = Vec3::new(unit(), unit(), unit()) * size(mesh) * 1.5;
    let (u, v) = (unit().abs(), unit().abs());
    let [a, b, c] = mesh.triangle(random.below(mesh.triangles().len() as u64) as usize);
    let other = mesh.vertices()[random.below(mesh.vertices().len() as u64) as usize];
    let on = a + (b - a) * u + (c - a) * (v * (1.0 - u));
    match random.below(9) {
        0 => a,
        1 => a.midpoint(b),
        2 => on,
        3 => on + any * 1e-5,
        4 => any * 1e3,
        5 => a.midpoint(other),
        6 => any.round(),
        7 => a + (a - other),
        _ => any,
    }
}

fn all(nears: &[Near]) -> Vec<(f32, u32)> {
    nears.iter().map(|near| (near.distance, near.prim)).collect()
}

fn ball(point: Vec3, radius: f32) -> Ball {
    Ball::new(point, radius).expect("a point and a radius")
}

/// [NEAR-2]
#[test]
fn every_traversal_finds_the_nearest_triangles() {
    let mut duplicates = 0;
    for mesh in meshes() {
        let (mut random, n) = (Rng::new(7), mesh.triangles().len());
        let queries: Vec<_> = (0..12).map(|_| point(&mesh, &mut random)).collect();
        for bvh in trees(&mesh) {
            duplicates += bvh.duplicates();
            let tracers: Vec<_> = Method::ALL.iter().filter_map(|&m| BinaryTracer::with_method(&bvh, m).ok()).collect();
            assert!(tracers.len() >= Method::ALL.len() - 1);
            for &point in &queries {
                for (k, radius) in [(5, f32::INFINITY), (n, size(&mesh) * 0.3), (n + 5, f32::INFINITY)] {
                    let truth = truth(&mesh, point, radius, k);
                    for tracer in &tracers {
                        let nears = tracer.nearest_k(&ball(point, radius), k);
                        assert_eq!(all(&nears), truth, "{tracer:?} {point} {k}");
                        for Near { distance, point: found, .. } in nears {
                            let error = ((found - point).length() - distance).abs();
                            assert!(error <= 1e-5 * (distance + size(&mesh)), "{tracer:?} {point}");
                        }
                    }
                }
            }
        }
    }
    assert!(duplicates > 20, "{duplicates}");
}

/// One, none, a few and all of the nearest, over both kinds of trees. Returns how often two distances were one.
fn check(queries: u32) -> usize {
    let meshes = meshes();
    let trees: Vec<_> = meshes.iter().map(trees).collect();
    let tracers: Vec<_> = trees.iter().map(|trees| trees.each_ref().map(BinaryTracer::new)).collect();
    let (mut random, mut ties) = (Rng::new(3), 0);
    for i in 0..queries {
        let m = random.below(4) as usize;
        let (mesh, tracer) = (&meshes[m], &tracers[m][random.below(2) as usize]);
        let (point, k) = (point(mesh, &mut random), [1, 2, 1 + random.below(9) as usize][i as usize % 3]);
        let truth = truth(mesh, point, f32::INFINITY, k.max(2));
        ties += usize::from(truth.first().map(|near| near.0) == truth.get(1).map(|near| near.0));
        let near = tracer.nearest(&ball(point, f32::INFINITY));
        assert_eq!(near.map(|near| (near.distance, near.prim)), truth.first().copied(), "{point}");
        let nears = tracer.nearest_k(&ball(point, f32::INFINITY), k);
        assert_eq!(all(&nears), truth[..k.min(truth.len())], "{point} {k}");
        if k == 1 {
            assert_eq!(nears.first(), near.as_ref(), "{point}");
        }
    }
    ties
}

#[test]
fn the_nearest_of_thousands_of_points_are_the_truth() {
    assert!(check(3000) > 500);
}

#[test]
#[ignore = "the same with more points, some 10 s: cargo test --lib -- --ignored hundred_thousand"]
fn the_nearest_of_a_hundred_thousand_points_are_the_truth() {
    assert!(check(100_000) > 20_000);
}

/// [NEAR-1] [NEAR-3]
#[test]
fn distances_and_points_are_the_truth_rounded_whatever_the_limits() {
    let mut random = Rng::new(3);
    for mesh in meshes() {
        for i in 0..5_000 {
            let triangle = Triangle(mesh.triangle(i % mesh.triangles().len()));
            let point = point(&mesh, &mut random);
            check_distance(&triangle, point).unwrap_or_else(|fault| panic!("{fault}: {triangle:?} {point}"));
        }
    }
}

#[test]
fn no_triangle_too_many_triangles_and_a_radius_that_is_a_distance() {
    let mesh = stress::icosphere(1, 1.0, Vec3::ZERO).expect("a mesh");
    let n = mesh.triangles().len();
    for bvh in trees(&mesh) {
        let tracer = BinaryTracer::new(&bvh);
        let nearest = |radius, k| tracer.nearest_k(&ball(Vec3::ZERO, radius), k);
        assert_eq!(nearest(f32::INFINITY, 0), []);
        assert_eq!(nearest(0.0, 3), []);
        for k in [n, n + 1, usize::MAX] {
            assert_eq!(all(&nearest(f32::INFINITY, k)), truth(&mesh, Vec3::ZERO, f32::INFINITY, n));
        }
        // A corner's distance: six triangles or five have it, and no other is so near.
        let corner = mesh.vertices()[0];
        let nears = tracer.nearest_k(&ball(corner, 0.0), n);
        assert!((5..=6).contains(&nears.len()) && nears.iter().all(|near| near.distance == 0.0), "{nears:?}");
        assert_eq!(tracer.nearest_k(&ball(corner, 0.0), 2), nears[..2]);
    }
    let flat = Mesh::new(vec![Vec3::X; 3], vec![[0, 1, 2]; 4]).expect("a mesh");
    let bvh = Bvh::median(&flat, 4).expect("a tree");
    assert_eq!(BinaryTracer::new(&bvh).nearest_k(&ball(Vec3::ZERO, f32::INFINITY), 4), []);
}
