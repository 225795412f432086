//! What it costs to come from C: closest and any hits of the same rays in Rust and through `libstackless.so`, interleaved, in
//! the time of this thread.
//!
//! `cargo run --release -p stackless-capi --example overhead -- target/release/libstackless.so`

#![allow(unsafe_code, reason = "it calls C")]

use std::error::Error;
use std::ffi::c_void;
use std::hint::black_box;
use std::{array, env, ptr};

use cpu_time::ThreadTime;
use glam::{DVec3, Vec3};
use libloading::Library;
use stackless_bvh::generate::procedural::{self, View};
use stackless_bvh::geom::lanes::Precision;
use stackless_bvh::geom::{Mesh, Ray, Vector};
use stackless_bvh::trace::{RayQueries as _, Tracer};

const RAYS: usize = 1 << 16;
const ROUNDS: usize = 9;

/// As in `stackless.h`.
#[repr(C)]
#[derive(Clone, Copy)]
struct RawRay<R> {
    origin: [R; 3],
    tmin: R,
    direction: [R; 3],
    tmax: R,
}

#[repr(C)]
#[derive(Clone, Copy)]
struct RawHit<R> {
    t: R,
    u: R,
    v: R,
    face: u32,
}

type New<R> =
    unsafe extern "C" fn(*const R, usize, usize, *const u32, usize, usize, *const c_void, *mut *mut c_void) -> u32;
type One<R, A> = unsafe extern "C" fn(*const c_void, *const RawRay<R>, *mut A) -> u32;
type Many<R, A> = unsafe extern "C" fn(*const c_void, *const RawRay<R>, usize, usize, *mut A, usize, u32) -> u32;

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("usage: overhead PATH of libstackless.so")?;
    // SAFETY: it has no code that runs when it is loaded.
    let library = unsafe { Library::new(path) }?;
    println!("| scene | precision | closest1 | closest_n | any1 | any_n |\n|---|---|---:|---:|---:|---:|");
    for (name, mesh) in [("strands", procedural::strands(1, 2000)), ("soup", procedural::soup(1, 100_000))] {
        let rays = View::of(&mesh).rays(RAYS);
        run::<Vec3>(&library, name, &mesh, &rays)?;
        let vertices = mesh.vertices().iter().map(|v| v.as_dvec3()).collect();
        let double = |ray: &Ray| {
            Ray::within(ray.origin().as_dvec3(), ray.direction().as_dvec3(), ray.tmin().into(), ray.tmax().into())
        };
        let rays = rays.iter().map(double).collect::<Result<Vec<_>, _>>()?;
        run::<DVec3>(&library, name, &Mesh::new(vertices, mesh.triangles().to_vec())?, &rays)?;
    }
    Ok(())
}

/// Prints the speed through C as a share of that in Rust.
fn run<V: Precision>(library: &Library, name: &str, mesh: &Mesh<V>, rays: &[Ray<V>]) -> Result<(), Box<dyn Error>> {
    type Real<V> = <V as Vector>::Real;
    let suffix = if size_of::<Real<V>>() == 4 { "f" } else { "d" };
    let symbol = |name: &str| format!("stackless_{name}_{suffix}\0");
    let tracer = Tracer::of(mesh)?;
    let vertices: Vec<[Real<V>; 3]> = mesh.vertices().iter().map(|v| v.components()).collect();
    let raw = |ray: &Ray<V>| {
        let (origin, direction) = (ray.origin().components(), ray.direction().components());
        RawRay { origin, tmin: ray.tmin(), direction, tmax: ray.tmax() }
    };
    let raws: Vec<_> = rays.iter().map(raw).collect();
    let mut scene = ptr::null_mut();
    let mut hits =
        vec![RawHit { t: Real::<V>::default(), u: Real::<V>::default(), v: Real::<V>::default(), face: 0 }; raws.len()];
    let mut are_hit = vec![false; raws.len()];
    // SAFETY: the types are those of the header, and arrays are as long as the calls say.
    let (mut rust, mut c) = ([f64::INFINITY; 4], [f64::INFINITY; 4]);
    unsafe {
        let new = library.get::<New<Real<V>>>(symbol("scene_new").as_bytes())?;
        let closest1 = *library.get::<One<Real<V>, RawHit<Real<V>>>>(symbol("closest1").as_bytes())?;
        let any1 = *library.get::<One<Real<V>, bool>>(symbol("any1").as_bytes())?;
        let closest_n = *library.get::<Many<Real<V>, RawHit<Real<V>>>>(symbol("closest_n").as_bytes())?;
        let any_n = *library.get::<Many<Real<V>, bool>>(symbol("any_n").as_bytes())?;
        let (stride, faces) = (size_of::<[Real<V>; 3]>(), mesh.triangles());
        let error = new(
            vertices.as_ptr().cast(),
            stride,
            vertices.len(),
            faces.as_ptr().cast(),
            12,
            faces.len(),
            ptr::null(),
            &raw mut scene,
        );
        assert_eq!(error, 0);
        let (ray, hit) = (size_of::<RawRay<Real<V>>>(), size_of::<RawHit<Real<V>>>());
        for _ in 0..ROUNDS {
            best(&mut rust[0], || rays.iter().for_each(|ray| drop(black_box(tracer.closest(ray)))));
            best(&mut c[0], || raws.iter().zip(&mut hits).for_each(|(ray, hit)| drop(closest1(scene, ray, hit))));
            best(&mut rust[1], || drop(black_box(tracer.closest_each(rays))));
            best(&mut c[1], || drop(closest_n(scene, raws.as_ptr(), ray, raws.len(), hits.as_mut_ptr(), hit, 0)));
            best(&mut rust[2], || rays.iter().for_each(|ray| drop(black_box(tracer.any(ray)))));
            best(&mut c[2], || raws.iter().zip(&mut are_hit).for_each(|(ray, is_hit)| drop(any1(scene, ray, is_hit))));
            best(&mut rust[3], || drop(black_box(tracer.any_each(rays))));
            best(&mut c[3], || drop(any_n(scene, raws.as_ptr(), ray, raws.len(), are_hit.as_mut_ptr(), 1, 0)));
        }
    }
    for ((found, hit), is_hit) in tracer.closest_each(rays).into_iter().zip(&hits).zip(are_hit) {
        assert_eq!(found.map_or(u32::MAX, |found| found.prim), hit.face);
        assert_eq!(found.is_some(), is_hit);
    }
    let [a, b, c, d] = array::from_fn(|i| rust[i] / c[i]);
    println!("| {name} | {suffix} | {a:.3} | {b:.3} | {c:.3} | {d:.3} |");
    Ok(())
}

/// Keeps the least time, in seconds.
fn best(least: &mut f64, work: impl FnOnce()) {
    let start = ThreadTime::now();
    work();
    *least = least.min(start.elapsed().as_secs_f64());
}
