//! The cost of calls from C: closest and any hits of equal rays in Rust and through `libstackless.so`, interleaved, in
//! processor time of this thread. Prints shares of the speed of Rust.
//!
//! `cargo bench -p stackless-capi --bench overhead -- target/release/libstackless.so`

#![allow(unsafe_code, reason = "it calls C")]
#![allow(clippy::needless_for_each, clippy::semicolon_if_nothing_returned, reason = "a loop in a line each")]

use std::error::Error;
use std::ffi::c_void;
use std::hint::black_box;
use std::{env, ptr};

use cpu_time::ThreadTime;
use glam::{DVec3, Vec3};
use libloading::Library;
use stackless_bvh::geom::{Mesh, Precision, Ray, Vector};
use stackless_bvh::trace::{RayQueries as _, Tracer};

const RAYS: usize = 1 << 16;
const ROUNDS: usize = 9;

type Real<V> = <V as Vector>::Real;

/// See `stackless.h`.
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
type One<R, A> = unsafe extern "C" fn(*const c_void, *const RawRay<R>, *const c_void, *mut A) -> u32;
type Many<R, A> = unsafe extern "C" fn(
    *const c_void,
    *const RawRay<R>,
    usize,
    usize,
    *const c_void,
    usize,
    *mut A,
    usize,
    u32,
) -> u32;

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("usage: overhead PATH of libstackless.so")?;
    // SAFETY: the library runs no code when it is loaded.
    let library = unsafe { Library::new(path) }?;
    println!("| precision | Rust | closest1 | closest_n | any1 | any_n |\n|---|---|---:|---:|---:|---:|");
    run::<Vec3>(&library)?;
    run::<DVec3>(&library)
}

type Scene<V> = (Mesh<V>, Vec<Ray<V>>);

/// Hills, and rays that come down on them from all sides.
fn scene<V: Vector>() -> Result<Scene<V>, Box<dyn Error>> {
    const SIDE: u32 = 256;
    let at = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|i| i as f32 / SIDE as f32);
        V::from(Vec3::new(x, y, 0.1 * (20.0 * x).sin() * (17.0 * y).cos()))
    };
    let grid = |side: u32| (0..side * side).map(move |i| (i / side, i % side));
    let vertices = grid(SIDE + 1).map(|(i, j)| at(i, j)).collect();
    let corner = |i: u32, j: u32| i * (SIDE + 1) + j;
    let cell = |(i, j)| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let mesh = Mesh::new(vertices, grid(SIDE).flat_map(cell).collect())?;
    let ray = |i: usize| {
        // A sequence that spreads evenly over four dimensions.
        let [x, y, dx, dy] = [0.857, 0.734, 0.629, 0.539].map(|step| (i as f32 * step).fract());
        Ray::new(V::from(Vec3::new(x, y, 0.5)), V::from(Vec3::new(dx - 0.5, dy - 0.5, -0.5)))
    };
    Ok((mesh, (0..RAYS).map(ray).collect::<Result<_, _>>()?))
}

/// Prints the speed through C as a share of the speed in Rust.
fn run<V: Precision>(library: &Library) -> Result<(), Box<dyn Error>> {
    let (mesh, rays) = scene::<V>()?;
    let (mesh, rays) = (&mesh, &*rays);
    let suffix = if size_of::<Real<V>>() == 4 { "f" } else { "d" };
    let symbol = |name: &str| format!("stackless_{name}_{suffix}\0");
    let tracer = Tracer::of(mesh)?;
    let vertices: Vec<[Real<V>; 3]> = mesh.vertices().iter().map(|v| v.components()).collect();
    let raw = |ray: &Ray<V>| {
        let (origin, direction) = (ray.origin().components(), ray.direction().components());
        RawRay { origin, tmin: ray.tmin(), direction, tmax: ray.tmax() }
    };
    let plain: Vec<_> = rays.iter().map(raw).collect();
    let mut handle = ptr::null_mut();
    let zero = Real::<V>::default();
    let mut hits = vec![RawHit { t: zero, u: zero, v: zero, face: 0 }; RAYS];
    let mut are_hit = vec![false; RAYS];
    // Times for existing rays, for rays that Rust creates from the numbers, and through C.
    let [mut rust, mut with_made, mut c] = [[f64::INFINITY; 4]; 3];
    let checked = |ray: &RawRay<Real<V>>| {
        let [origin, direction] = [ray.origin, ray.direction].map(V::from_components);
        Ray::within(origin, direction, ray.tmin, ray.tmax).ok()
    };
    let all_checked = || plain.iter().map(checked).collect::<Option<Vec<_>>>().unwrap_or_default();
    // SAFETY: the types are those of the header, and arrays have the lengths in the calls.
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
            &raw mut handle,
        );
        assert_eq!(error, 0);
        for _ in 0..ROUNDS {
            let (first, bytes) = (plain.as_ptr(), [size_of::<RawRay<Real<V>>>(), size_of::<RawHit<Real<V>>>()]);
            best(&mut rust[0], || rays.iter().for_each(|ray| _ = black_box(tracer.closest(ray))));
            best(&mut with_made[0], || {
                plain.iter().for_each(|ray| _ = black_box(checked(ray).map(|ray| tracer.closest(&ray))))
            });
            best(&mut c[0], || {
                plain.iter().zip(&mut hits).for_each(|(ray, hit)| _ = closest1(handle, ray, ptr::null(), hit))
            });
            best(&mut rust[1], || _ = black_box(tracer.closest_each(rays)));
            best(&mut with_made[1], || _ = black_box(tracer.closest_each(&all_checked())));
            best(&mut c[1], || {
                _ = closest_n(handle, first, bytes[0], RAYS, ptr::null(), 0, hits.as_mut_ptr(), bytes[1], 0)
            });
            best(&mut rust[2], || rays.iter().for_each(|ray| _ = black_box(tracer.any(ray))));
            best(&mut with_made[2], || {
                plain.iter().for_each(|ray| _ = black_box(checked(ray).map(|ray| tracer.any(&ray))))
            });
            best(&mut c[2], || {
                plain.iter().zip(&mut are_hit).for_each(|(ray, it)| _ = any1(handle, ray, ptr::null(), it))
            });
            best(&mut rust[3], || _ = black_box(tracer.any_each(rays)));
            best(&mut with_made[3], || _ = black_box(tracer.any_each(&all_checked())));
            best(&mut c[3], || _ = any_n(handle, first, bytes[0], RAYS, ptr::null(), 0, are_hit.as_mut_ptr(), 1, 0));
        }
    }
    for ((found, hit), is_hit) in tracer.closest_each(rays).into_iter().zip(&hits).zip(are_hit) {
        assert_eq!(found.map_or(u32::MAX, |found| found.prim), hit.face);
        assert_eq!(found.is_some(), is_hit);
    }
    for (name, rust) in [("traces", rust), ("makes rays and traces", with_made)] {
        let shares = rust.iter().zip(c).map(|(rust, c)| format!(" {:.3} |", rust / c));
        println!("| {suffix} | {name} |{}", shares.collect::<String>());
    }
    let nanoseconds = c.map(|time| format!(" {:.0} |", 1e9 * time / RAYS as f64));
    println!("| {suffix} | nanoseconds of C |{}", nanoseconds.concat());
    Ok(())
}

/// Keeps the least time, in seconds.
fn best(least: &mut f64, work: impl FnOnce()) {
    let start = ThreadTime::now();
    work();
    *least = least.min(start.elapsed().as_secs_f64());
}
