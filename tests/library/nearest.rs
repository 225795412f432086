//! The nearest triangles of a point.

mod afar;
mod flat;

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions, SpatialOptions};
use stackless_bvh::generate::{Rng, Source, procedural, stress};
use stackless_bvh::geom::{Ball, Mesh, Real, Triangle, Vector};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::{Exact, Exact64, Parity};
use stackless_bvh::internals::geom::slabs::{Directed, Slabs64};
use stackless_bvh::trace::{BinaryTracer, MeshQueries, Near};
use stackless_bvh::traverse::Method;
use stackless_check::{check_distance, nearest as truth};

/// In the last one triangles are in several leaves.
fn trees<V: Vector>(mesh: &Mesh<V>) -> [Bvh<Triangle<V>>; 2] {
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let sah = SahOptions { max_leaf: 1, ..SahOptions::default() };
    let options = BuildOptions { builder: Builder::Spatial, sah, spatial, ..BuildOptions::default() };
    let cut = options.build(mesh);
    [Bvh::sah(mesh, SahOptions::default()), cut].map(|bvh| bvh.expect("a tree"))
}

/// Loose triangles; long ones, which are cut; a closed surface; whole coordinates, each triangle twice, and degenerate
/// ones between.
fn meshes_of_all_kinds() -> [Mesh; 4] {
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

/// The same with more digits, far away, and very small and great: beyond the range of single precision, too.
fn double_meshes() -> Vec<Mesh<DVec3>> {
    let mut random = Rng::new(12);
    let mut unit = || random.bits() as f64 / 2f64.powi(64);
    let places = [(0.0, 1.0), (6.4e6, 1.0), (1e9, 1.0), (0.0, 1e-50), (1.0, 1e50)];
    let mut meshes = Vec::new();
    for mesh in meshes_of_all_kinds() {
        for (far, scale) in places {
            // Whole coordinates stay so: many distances are equal.
            let bits = if mesh.vertices()[1] == Vec3::X { 0.0 } else { 1e-8 };
            let mut place = |v: &Vec3| (v.as_dvec3() + DVec3::new(unit(), unit(), unit()) * bits + far) * scale;
            let vertices = mesh.vertices().iter().map(&mut place).collect();
            meshes.push(Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh"));
        }
    }
    meshes
}

/// The edges of the box, and the farthest coordinate.
fn sizes<V: Vector>(mesh: &Mesh<V>) -> (f64, f64) {
    let corners = || mesh.vertices().iter().map(|v| v.widen());
    let (lo, hi) = corners().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
    ((hi - lo).max_element(), lo.abs().max(hi.abs()).max_element())
}

/// On the mesh and near it, far away, as far from one corner as from another, and anywhere.
fn point<V: Vector>(mesh: &Mesh<V>, random: &mut Rng) -> V {
    let mut unit = || random.below(1 << 25) as f64 / f64::from(1 << 24) - 1.0;
    let (size, _) = sizes(mesh);
    let any = DVec3::new(unit(), unit(), unit()) * size * 1.5;
    let (u, v) = (unit().abs(), unit().abs());
    let [a, b, c] = mesh.triangle(random.below(mesh.triangles().len() as u64) as usize).map(V::widen);
    let other = mesh.vertices()[random.below(mesh.vertices().len() as u64) as usize].widen();
    let on = a + (b - a) * u + (c - a) * (v * (1.0 - u));
    let point = match random.below(9) {
        0 => a,
        1 => a.midpoint(b),
        2 => on,
        3 => on + any * 1e-5,
        4 => any * 1e3,
        5 => a.midpoint(other),
        6 => any.round(),
        7 => a + (a - other),
        _ => a + any,
    };
    V::from_components(point.to_array().map(V::Real::rounded))
}

fn all<V: Vector>(nears: &[Near<V>]) -> Vec<(f64, u32)> {
    nears.iter().map(|near| (near.distance.into(), near.prim)).collect()
}

fn ball<V: Vector>(point: V, radius: f64) -> Ball<V> {
    Ball::new(point, V::Real::rounded(radius)).expect("a point and a radius")
}

fn check_traversals<K, B, V>(meshes: &[Mesh<V>])
where
    K: Parity<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let mut duplicates = 0;
    for mesh in meshes {
        let (mut random, n, (size, far)) = (Rng::new(7), mesh.triangles().len(), sizes(mesh));
        let queries: Vec<_> = (0..12).map(|_| point(mesh, &mut random)).collect();
        for bvh in trees(mesh) {
            duplicates += bvh.duplicates();
            let tracers: Vec<_> =
                Method::ALL.iter().filter_map(|&m| BinaryTracer::<_, K, B>::with_tests(&bvh, m).ok()).collect();
            assert!(tracers.len() >= Method::ALL.len() - 1);
            for &point in &queries {
                for (k, radius) in [(5, f64::INFINITY), (n, size * 0.3), (n + 5, f64::INFINITY)] {
                    let truth = truth(mesh, point, V::Real::rounded(radius), k);
                    for tracer in &tracers {
                        let nears = tracer.nearest_k(&ball(point, radius), k);
                        assert_eq!(all(&nears), truth, "{tracer:?} {point:?} {k}");
                        for Near { distance, point: found, .. } in nears {
                            let error = ((found - point).widen().length() - distance.into()).abs();
                            assert!(error <= 1e-5 * (distance.into() + size + far), "{tracer:?} {point:?}");
                        }
                    }
                }
            }
        }
    }
    assert!(duplicates > 20, "{duplicates}");
}

/// [NEAR-2]
#[test]
fn every_traversal_finds_the_nearest_triangles() {
    check_traversals::<Exact, Directed, _>(&meshes_of_all_kinds());
    check_traversals::<Exact64, Slabs64, _>(&double_meshes());
}

/// One, none, a few and all of the nearest, over both kinds of trees. Returns how often two distances were one.
fn check<K, B, V>(meshes: &[Mesh<V>], queries: u32) -> usize
where
    K: Parity<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let trees: Vec<_> = meshes.iter().map(trees).collect();
    let tracer = |bvh| BinaryTracer::<_, K, B>::with_tests(bvh, Method::default()).expect("a traversal of any tree");
    let tracers: Vec<_> = trees.iter().map(|trees| trees.each_ref().map(tracer)).collect();
    let (mut random, mut ties) = (Rng::new(3), 0);
    for i in 0..queries {
        let m = random.below(meshes.len() as u64) as usize;
        let (mesh, tracer) = (&meshes[m], &tracers[m][random.below(2) as usize]);
        let (point, k) = (point(mesh, &mut random), [1, 2, 1 + random.below(9) as usize][i as usize % 3]);
        let truth = truth(mesh, point, V::Real::INFINITY, k.max(2));
        ties += usize::from(truth.first().map(|near| near.0) == truth.get(1).map(|near| near.0));
        let near = tracer.nearest(&ball(point, f64::INFINITY));
        assert_eq!(all(near.as_slice()), truth[..1], "{point:?}");
        let nears = tracer.nearest_k(&ball(point, f64::INFINITY), k);
        assert_eq!(all(&nears), truth[..k.min(truth.len())], "{point:?} {k}");
        if k == 1 {
            assert_eq!(nears.first(), near.as_ref(), "{point:?}");
        }
    }
    ties
}

/// [NEAR-1]
#[test]
fn the_nearest_of_thousands_of_points_are_the_truth() {
    let ties = check::<Exact, Directed, _>(&meshes_of_all_kinds(), 3000);
    assert!(ties > 500, "{ties}");
    let ties = check::<Exact64, Slabs64, _>(&double_meshes(), 3000);
    assert!(ties > 500, "{ties}");
}

#[test]
#[ignore = "the same with more points, some minutes: cargo test --test library -- --ignored hundred_thousand"]
fn the_nearest_of_a_hundred_thousand_points_are_the_truth() {
    assert!(check::<Exact, Directed, _>(&meshes_of_all_kinds(), 100_000) > 20_000);
    assert!(check::<Exact64, Slabs64, _>(&double_meshes(), 100_000) > 20_000);
}

fn check_distances<V: Vector>(meshes: &[Mesh<V>], points: usize) {
    let mut random = Rng::new(3);
    for mesh in meshes {
        for i in 0..points {
            let triangle = Triangle(mesh.triangle(i % mesh.triangles().len()));
            let point = point(mesh, &mut random);
            check_distance(&triangle, point).unwrap_or_else(|fault| panic!("{fault}: {triangle:?} {point:?}"));
        }
    }
}

/// [NEAR-1] [NEAR-3]
#[test]
fn distances_and_points_are_the_truth_rounded_whatever_the_limits() {
    check_distances(&meshes_of_all_kinds(), 5000);
    check_distances(&double_meshes(), 1000);
}

#[test]
fn no_triangle_too_many_triangles_and_a_radius_that_is_a_distance() {
    let mesh = stress::icosphere(1, 1.0, Vec3::ZERO).expect("a mesh");
    let n = mesh.triangles().len();
    for bvh in trees(&mesh) {
        let tracer = BinaryTracer::new(&bvh);
        let nearest = |radius, k| tracer.nearest_k(&ball(Vec3::ZERO, radius), k);
        assert_eq!(nearest(f64::INFINITY, 0), []);
        assert_eq!(nearest(0.0, 3), []);
        for k in [n, n + 1, usize::MAX] {
            assert_eq!(all(&nearest(f64::INFINITY, k)), truth(&mesh, Vec3::ZERO, f32::INFINITY, n));
        }
        // A corner's distance: six triangles or five have it, and no other is so near.
        let corner = mesh.vertices()[0];
        let nears = tracer.nearest_k(&ball(corner, 0.0), n);
        assert!((5..=6).contains(&nears.len()) && nears.iter().all(|near| near.distance == 0.0), "{nears:?}");
        assert_eq!(tracer.nearest_k(&ball(corner, 0.0), 2), nears[..2]);
    }
}
