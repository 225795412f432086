use glam::{DVec3, Vec3};

use crate::bvh::{BuildOptions, Builder, Bvh, SpatialOptions};
use crate::generate::{procedural, stress};
use crate::geom::kernel::{Exact, Exact64};
use crate::geom::slabs::{Directed, Slabs64};
use crate::geom::{Mesh, Ray};
use crate::trace::{BinaryTracer, MeshQueries, Tracer};
use crate::traverse::Method;

type Tracer64 = BinaryTracer<Bvh<crate::geom::Triangle<DVec3>>, Exact64, Slabs64>;

fn tracer64(mesh: &Mesh<DVec3>) -> Tracer64 {
    BinaryTracer::with_tests(Bvh::build(mesh).expect("a tree"), Method::default()).expect("a tracer")
}

/// Scales a mesh and rays by a power of two, in double precision.
fn scaled(mesh: &Mesh, rays: &[Ray], by: f64) -> (Mesh<DVec3>, Vec<Ray<DVec3>>) {
    let vertices = mesh.vertices().iter().map(|v| v.as_dvec3() * by).collect();
    let ray = |ray: &Ray| Ray::new(ray.origin().as_dvec3() * by, ray.direction().as_dvec3()).expect("a ray");
    (Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh"), rays.iter().map(ray).collect())
}

/// The numbers of crossings equal those in single precision for every deciding stage: filter and sums, or rational
/// arithmetic for huge or tiny numbers. [PARITY-1]
#[test]
fn crossings_in_double_precision_are_those_in_single() {
    let mut cases = 0;
    for case in stress::cases(200) {
        let has_no_ends = case.rays.iter().all(|ray| ray.tmin() == 0.0 && ray.tmax() == f32::INFINITY);
        if !case.closed || !has_no_ends {
            continue;
        }
        cases += 1;
        let expected = Tracer::of(&case.mesh).expect("a tracer").crossings_each(&case.rays);
        let few = &case.rays[..case.rays.len().min(20)];
        for (by, rays) in
            [(1.0, &*case.rays), (2f64.powi(-40), &*case.rays), (2f64.powi(-600), few), (2f64.powi(500), few)]
        {
            let (mesh, rays) = scaled(&case.mesh, rays, by);
            let tracer = tracer64(&mesh);
            assert_eq!(tracer.crossings_each(&rays), expected[..rays.len()], "{} {by:e}", case.name);
            assert_eq!(tracer.crossings_parallel(&rays), Ok(tracer.crossings_each(&rays)));
        }
    }
    assert!(cases > 10, "{cases}");
}

/// Every traversal counts a triangle in several leaves once.
#[test]
fn crossings_are_those_of_the_wide_tracer() {
    let (mesh, spatial) = (procedural::layers(40), SpatialOptions { extra_percent: 200, overlap: 0.0 });
    let rays = procedural::rays(&mesh, 2, 100);
    let expected = Tracer::of(&mesh).expect("a tracer").crossings_each(&rays);
    assert!(expected.iter().sum::<u32>() > 50);
    for builder in Builder::ALL {
        let bvh = BuildOptions { builder, spatial, ..BuildOptions::default() }.build(&mesh).expect("a tree");
        for method in Method::ALL {
            if let Ok(tracer) = BinaryTracer::<_, Exact, Directed>::with_tests(&bvh, method) {
                assert_eq!(tracer.crossings_each(&rays), expected, "{builder} {method}");
            }
        }
    }
}

/// Coordinates beyond single precision.
#[test]
fn rays_through_corners_that_are_doubles_cross_an_odd_number_of_times() {
    let sphere = stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh");
    let vertices: Vec<_> = sphere.vertices().iter().map(|v| (v.as_dvec3() + 0.1) / 3.0).collect();
    let tracer = tracer64(&Mesh::new(vertices.clone(), sphere.triangles().to_vec()).expect("a mesh"));
    for corner in vertices {
        let inside = DVec3::splat(0.1 / 3.0);
        assert_eq!(tracer.crossings(&Ray::new(inside, corner - inside).expect("a ray")) % 2, 1);
        let outside = DVec3::new(-0.7, 0.1 / 3.0, 3.3);
        assert_eq!(tracer.crossings(&Ray::new(outside, corner - outside).expect("a ray")) % 2, 0);
    }
}
