//! Instructions of 1,000 rays with each traversal, and of the builder. Counts are equal on every run, so a change of
//! one percent is visible. `cargo bench --bench instructions` needs valgrind and `cargo install gungraun-runner`. A
//! count more than 2 % above that of the previous run fails.
#![allow(missing_docs, missing_debug_implementations, reason = "macros make public items")]

use std::hint::black_box;

use glam::{DVec3, Vec3};
use gungraun::prelude::*;
use gungraun::{Callgrind, EventKind};
use stackless_bvh::bvh::{Bvh, SahOptions, WideBvh};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::{BinaryTracer, RayQueries, Tracer};
use stackless_bvh::traverse::Method;
use stackless_bvh::tree::Recorded;

struct Scene {
    bvh: Bvh,
    rays: Vec<Ray>,
}

fn mesh() -> Mesh {
    procedural::strands(1, 300)
}

/// Returns camera and diffuse rays, with the links that a traversal needs in the records.
fn scene(method: Method) -> (Method, &'static Scene) {
    let mesh = mesh();
    let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
    let mut rays = procedural::View::of(&mesh).rays(500);
    rays.extend(bounce(&mesh, &bvh, &rays, 1));
    let bvh = match method.wants_recorded() {
        Recorded::Nothing => bvh,
        wanted => bvh.with_links(wanted),
    };
    (method, Box::leak(Box::new(Scene { bvh, rays })))
}

fn tracer(method: Method) -> (BinaryTracer<&'static Bvh>, &'static [Ray]) {
    let (method, scene) = scene(method);
    (BinaryTracer::with_method(&scene.bvh, method).expect("it runs on any tree"), &scene.rays)
}

#[library_benchmark(setup = tracer)]
#[bench::stack(Method::Stack)]
#[bench::sparse(Method::Sparse)]
#[bench::afra(Method::Afra)]
#[bench::uncle(Method::Uncle)]
#[bench::hash_only(Method::HashOnly)]
#[bench::hashed(Method::Hashed)]
#[bench::implicit_b1(Method::ImplicitB1)]
fn closest((tracer, rays): (BinaryTracer<&'static Bvh>, &'static [Ray])) -> usize {
    black_box(tracer.closest_each(black_box(rays))).iter().flatten().count()
}

#[library_benchmark(setup = tracer)]
#[bench::stack(Method::Stack)]
#[bench::sparse(Method::Sparse)]
#[bench::afra(Method::Afra)]
#[bench::uncle(Method::Uncle)]
#[bench::hashed(Method::Hashed)]
fn any((tracer, rays): (BinaryTracer<&'static Bvh>, &'static [Ray])) -> usize {
    black_box(tracer.any_each(black_box(rays))).iter().filter(|&&hit| hit).count()
}

/// The default tracer, in both precisions, with its rays.
enum Users {
    Single(Tracer, Vec<Ray>),
    Double(Tracer<WideBvh<8, DVec3>, DVec3>, Vec<Ray<DVec3>>),
}

fn single() -> Users {
    Users::Single(Tracer::of(&mesh()).expect("a tree"), scene(Method::Stack).1.rays.clone())
}

/// A third of the scene: few of its coordinates are single-precision numbers.
fn double() -> Users {
    let mesh = mesh();
    let third = |point: Vec3| point.as_dvec3() / 3.0;
    let vertices = mesh.vertices().iter().copied().map(third).collect();
    let smaller = Mesh::new(vertices, mesh.triangles().to_vec()).expect("finite vertices");
    let ray = |ray: &Ray| {
        let [tmin, tmax] = [ray.tmin(), ray.tmax()].map(f64::from);
        Ray::within(third(ray.origin()), ray.direction().as_dvec3(), tmin, tmax).expect("a ray")
    };
    Users::Double(Tracer::of(&smaller).expect("a tree"), scene(Method::Stack).1.rays.iter().map(ray).collect())
}

#[library_benchmark]
#[bench::single(single())]
#[bench::double(double())]
fn closest_by_default(users: Users) -> usize {
    match black_box(&users) {
        Users::Single(tracer, rays) => black_box(tracer.closest_each(rays)).iter().flatten().count(),
        Users::Double(tracer, rays) => black_box(tracer.closest_each(rays)).iter().flatten().count(),
    }
}

#[library_benchmark]
#[bench::single(single())]
#[bench::double(double())]
fn any_by_default(users: Users) -> usize {
    let hits = match black_box(&users) {
        Users::Single(tracer, rays) => tracer.any_each(rays),
        Users::Double(tracer, rays) => tracer.any_each(rays),
    };
    black_box(hits).iter().filter(|&&hit| hit).count()
}

#[library_benchmark]
#[bench::sah(mesh())]
fn build(mesh: Mesh) -> Bvh {
    black_box(Bvh::sah(black_box(&mesh), SahOptions::default()).expect("a tree"))
}

library_benchmark_group!(name = instructions, benchmarks = [closest, any, closest_by_default, any_by_default, build]);

main!(
    config = LibraryBenchmarkConfig::default().tool(Callgrind::default().soft_limits([(EventKind::Ir, 2.0)])),
    library_benchmark_groups = instructions
);
