//! Meshes in double precision, at any place and of any size: boxes are in a separate frame. [FRAME-1]

use std::thread;

use glam::{DVec3, Vec3};

use stackless_bvh::bvh::{self, BuildOptions, Builder, Bvh, SpatialOptions, WideBvh};
use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::geom::{Mesh, Ray, Triangle};
use stackless_bvh::internals::geom::kernel::Exact64;
use stackless_bvh::internals::geom::slabs::Slabs64;
use stackless_bvh::internals::trace::{TrueHit, Truth};
use stackless_bvh::trace;
use stackless_bvh::trace::{BinaryTracer, MeshQueries, RayQueries};
use stackless_bvh::traverse::Method;

type Tracer<'a> = BinaryTracer<&'a Bvh<Triangle<DVec3>>, Exact64, Slabs64>;

/// Scales, and shifts relative to them: where single precision is too coarse or too narrow, and where it suffices.
const PLACES: [(f64, f64); 9] = [
    (1.0, 0.0),
    (1.0, 6.4e6),
    (1.0, -1e9),
    (1e-6, 1e7),
    (1e-50, 0.0),
    (1e50, 0.0),
    (1e-40, 1e9),
    (1e40, 6.4e6),
    (1.0, 1e14),
];

/// Returns a translated and scaled mesh with its rays: those of single precision, with each coordinate rounded.
fn placed(mesh: &Mesh, rays: &[Ray], (scale, shift): (f64, f64)) -> (Mesh<DVec3>, Vec<Ray<DVec3>>) {
    let space = |v: DVec3| (v + DVec3::new(shift, -0.7 * shift, 0.3 * shift)) * scale;
    let vertices = mesh.vertices().iter().map(|v| space(v.as_dvec3())).collect();
    let mesh = Mesh::new(vertices, mesh.triangles().to_vec()).expect("finite");
    let ray = |ray: &Ray| {
        let [tmin, tmax] = [ray.tmin(), ray.tmax()].map(f64::from);
        Ray::within(space(ray.origin().as_dvec3()), ray.direction().as_dvec3() * scale, tmin, tmax).expect("a ray")
    };
    let rays = rays.iter().map(ray);
    // At the corners of triangles, from far away.
    let from = space(DVec3::new(0.31, 0.47, 900.0));
    let aimed = (0..40).map(|i| mesh.vertices()[i * 7 % mesh.vertices().len()] - from);
    let aimed = aimed.filter_map(|d| Ray::new(from, d).ok()).collect::<Vec<_>>();
    (mesh, rays.chain(aimed).collect())
}

/// All queries agree with rational arithmetic, over trees of all kinds, in their first frame and in that of a refit.
#[test]
fn answers_are_the_truth_wherever_a_mesh_is() {
    let meshes =
        [procedural::soup(3, 300), stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh"), procedural::layers(9)];
    let check = |mesh: &Mesh, place| {
        let mut rays = procedural::rays(mesh, 5, 100);
        rays.extend(stress::aimed(mesh, 6, 60));
        let (mesh, rays) = placed(mesh, &rays, place);
        let (elsewhere, _) = placed(&procedural::soup(8, mesh.triangles().len()), &[], (1e-30, 1e3));
        let truth = Truth::new(&mesh);
        let spatial = SpatialOptions { extra_percent: 100, overlap: 0.0 };
        let mut hits = 0;
        for (builder, method) in Builder::ALL.into_iter().zip([
            Method::Afra,
            Method::Hashed,
            Method::ImplicitB1,
            Method::Skip,
            Method::Hapala,
        ]) {
            let mut bvh = BuildOptions { builder, spatial, ..BuildOptions::default() }.build(&mesh).expect("a tree");
            bvh::validate(&bvh, &mesh).expect("sound");
            let before = bvh.to_bytes();
            let back = Bvh::<Triangle<DVec3>>::from_bytes(&before).expect("what was written");
            assert_eq!((back.frame(), back.bounds()), (bvh.frame(), bvh.bounds()));
            if bvh.dropped() == 0 {
                let elsewhere = elsewhere_of(&elsewhere, &mesh);
                bvh.refit(&elsewhere).expect("as many");
                bvh::validate(&bvh, &elsewhere).expect("sound");
                assert_eq!(bvh.frame(), elsewhere.frame());
                assert_ne!(bvh.to_bytes(), before);
                bvh.refit(&mesh).expect("as before");
                bvh::validate(&bvh, &mesh).expect("sound");
            }
            let mut wide = WideBvh::<8, DVec3>::of(&bvh).expect("a wide tree");
            let stored = wide.to_bytes();
            wide.refit(&elsewhere_of(&elsewhere, &mesh)).expect("as many");
            assert_ne!(wide.to_bytes(), stored);
            wide.refit(&mesh).expect("as before");
            let read = WideBvh::from_bytes(&stored).expect("what was written");
            assert_eq!(read.to_bytes(), stored);
            for wide in [&wide, &read] {
                wide.validate(&mesh).expect("sound");
                let tracer = trace::Tracer::new(wide);
                for ray in &rays {
                    let expected: Vec<_> = truth.all(ray).iter().map(TrueHit::rounded).collect();
                    assert_eq!(tracer.closest(ray), expected.first().copied(), "{place:?} {builder} {ray:?}");
                    assert_eq!(tracer.any(ray), !expected.is_empty(), "{place:?} {builder} {ray:?}");
                    assert!(tracer.all(ray) == expected, "{place:?} {builder} {ray:?}");
                }
            }
            for bvh in [&bvh, &back] {
                let Ok(tracer) = Tracer::with_tests(bvh, method) else { continue };
                for ray in &rays {
                    let expected: Vec<_> = truth.all(ray).iter().map(TrueHit::rounded).collect();
                    assert_eq!(tracer.closest(ray), expected.first().copied(), "{place:?} {builder} {ray:?}");
                    assert_eq!(tracer.any(ray), !expected.is_empty(), "{place:?} {builder} {ray:?}");
                    assert!(tracer.all(ray) == expected, "{place:?} {builder} {ray:?}");
                    let next = expected.first().and_then(|hit| tracer.next(ray, (hit.t, hit.prim)));
                    assert_eq!(next, expected.get(1).copied(), "{place:?} {builder} {ray:?}");
                    hits += expected.len();
                }
            }
        }
        assert!(hits > 300, "{place:?}: {hits}");
    };
    thread::scope(|scope| {
        for mesh in &meshes {
            scope.spawn(|| PLACES.into_iter().for_each(|place| check(mesh, place)));
        }
    });
}

/// Spatial splits cut triangles in the frame. [SPLIT-1]
#[test]
fn triangles_are_cut_in_every_frame() {
    let corners = (0..20).flat_map(|i| {
        let (from, to) = (Vec3::X * (i as f32 * 0.3), Vec3::new(i as f32 * 0.3 + 9.0, 9.0, 9.1));
        [from, to, to + Vec3::X * 0.1]
    });
    let slivers = Mesh::new(corners.collect(), (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
    let slivers = slivers.expect("a mesh");
    let spatial = SpatialOptions { extra_percent: 100, overlap: 0.0 };
    for place in PLACES {
        let (mesh, rays) = placed(&slivers, &stress::aimed(&slivers, 6, 60), place);
        let bvh = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() }.build(&mesh);
        let (bvh, truth) = (bvh.expect("a tree"), Truth::new(&mesh));
        assert!(bvh.duplicates() > 0, "{place:?}");
        bvh::validate(&bvh, &mesh).expect("sound");
        let tracer = Tracer::with_tests(&bvh, Method::default()).expect("a tracer");
        for ray in &rays {
            assert_eq!(tracer.closest(ray), truth.closest(ray).map(|hit| hit.rounded()), "{place:?} {ray:?}");
        }
    }
}

/// Returns vertices of another mesh with the triangles of this one, none of them degenerate.
fn elsewhere_of(vertices: &Mesh<DVec3>, mesh: &Mesh<DVec3>) -> Mesh<DVec3> {
    let count = mesh.vertices().len();
    let vertices = vertices.vertices().iter().copied().cycle().take(count).collect();
    Mesh::new(vertices, mesh.triangles().to_vec()).expect("finite")
}

/// The purpose of a frame: boxes are as tight as at the origin, so no more are entered in vain.
#[test]
fn a_mesh_far_away_costs_what_it_costs_at_the_origin() {
    let mesh = stress::icosphere(4, 1.0, Vec3::ZERO).expect("a mesh");
    let rays = procedural::rays(&mesh, 2, 200);
    let count = |place| {
        let (mesh, rays) = placed(&mesh, &rays, place);
        let bvh = Bvh::build(&mesh).expect("a tree");
        let tracer = Tracer::with_tests(&bvh, Method::default()).expect("a tracer");
        let counters = tracer.count_closest(&rays);
        counters.boxes + counters.triangles
    };
    let at_origin = count((1.0, 0.0));
    for place in PLACES {
        let far = count(place);
        // Coordinates are rounded to a hundredth of an edge there.
        let factor = if place.1 == 1e14 { 3 } else { 1 };
        assert!(far * 10 <= at_origin * 11 * factor, "{place:?}: {far}, {at_origin}");
    }
}

/// Directions with almost vanishing components.
#[test]
fn components_next_to_nothing() {
    let mesh = stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh");
    let (mesh, _) = placed(&mesh, &[], (1.0, 0.0));
    let (truth, bvh) = (Truth::new(&mesh), Bvh::build(&mesh).expect("a tree"));
    let tracer = Tracer::with_tests(&bvh, Method::default()).expect("a tracer");
    let mut hits = 0;
    for tiny in [1e-130, -1e-130, 1e-300, -5e-324, 1e-45] {
        for (i, &corner) in mesh.vertices().iter().enumerate() {
            let (origin, mut d) = (corner * if i % 2 == 0 { 0.0 } else { 2.0 }, -corner);
            d[i % 3] = tiny;
            let Ok(ray) = Ray::new(DVec3::new(0.1, -0.2, 0.3) + origin, d) else { continue };
            let expected = truth.closest(&ray).map(|hit| hit.rounded());
            hits += usize::from(expected.is_some());
            assert_eq!(tracer.closest(&ray), expected, "{ray:?}");
        }
    }
    assert!(hits > 300, "{hits}");
}
