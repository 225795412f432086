//! Exact answers by a device that has single precision: kernels say what is certain, the CPU settles the rest.
//!
//! `triangle_band.wgsl` tells certain misses from certain hits by the error bounds of BAND-2, and knows a hit's
//! distance within those of BAND-4. A hit replaces another only if its upper bound is less than the other's lower one:
//! both are floats, so the rounded distances are in that order too. A box is skipped only if it begins beyond the upper
//! bound of the best hit. What is in doubt ends the search; such rays are queued, and traced by the exact tracer. For
//! the others the triangle is certain, and the CPU computes its exact distance and weights. So the hits are those of
//! the exact tracer, bit for bit (BAND-5).

use std::time::Instant;

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::kernel::Exact;
use stackless_bvh::geom::{EnvironmentError, Kernel as _, Ray};
use stackless_bvh::trace::{BinaryTracer, Hit};

use crate::kernel::Kernel;
use crate::launch::compile;
use crate::model::has_parallel;
use crate::probe::Arithmetic;
use crate::rays::run;
use crate::scene::{Query, Scene};
use crate::{Checks, Gpu, GpuError, Pipeline};

/// What is written for a ray in doubt.
pub const UNCERTAIN: u32 = u32::MAX - 1;

/// The factor of u D E (2C + E) that bounds the errors of edge functions. `[BAND-2]`
pub const EDGE_FACTOR: f32 = 39.0;

/// Exact closest hits, and what they took.
#[derive(Debug)]
pub struct Settled {
    /// The hits.
    pub hits: Vec<Option<Hit>>,
    /// Rays that the device left in doubt.
    pub uncertain: usize,
    /// Seconds until the device was done, transfers included.
    pub device_seconds: f64,
    /// Seconds of the CPU after that.
    pub settle_seconds: f64,
}

/// Traces rays exactly, by a kernel whose edge functions are taken to be off by `factor`, which should be
/// [`EDGE_FACTOR`].
///
/// # Errors
/// [`GpuError::Feature`] for a device on which the bounds do not hold; what else a device may refuse.
pub fn closest(
    gpu: &Gpu,
    (scene, bvh): (&Scene, &Bvh),
    arithmetic: &Arithmetic,
    kernel: &Kernel,
    rays: &[Ray],
    factor: f32,
) -> Result<Settled, GpuError> {
    let start = Instant::now();
    holds(arithmetic)?;
    let triangles = triangles(factor);
    let parallel = rays.iter().any(has_parallel);
    let query = Query { triangles: &triangles, any: false, parallel, refines: false };
    let source = scene.source(gpu, kernel, query)?;
    let pipeline = compile(gpu, kernel, scene.placed(kernel)?.depth, &source, Checks::All)?;
    let found = launch(gpu, scene, kernel, &pipeline, rays)?;
    let device_seconds = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (hits, uncertain) = settle(bvh, rays, &found)?;
    Ok(Settled { hits, uncertain, device_seconds, settle_seconds: start.elapsed().as_secs_f64() })
}

/// Whether the bounds hold on a device. `[BAND-1]`
///
/// # Errors
/// [`GpuError::Feature`] with what is missing.
pub const fn holds(arithmetic: &Arithmetic) -> Result<(), GpuError> {
    match (arithmetic.rounds, arithmetic.keeps_subnormals) {
        (true, true) => Ok(()),
        (false, _) => Err(GpuError::Feature("rounding to nearest")),
        (true, false) => Err(GpuError::Feature("subnormal numbers")),
    }
}

/// The text of the triangle test.
pub fn triangles(factor: f32) -> String {
    format!("const EDGE_FACTOR = f32({factor});\n{}", include_str!("../wgsl/triangle_band.wgsl"))
}

/// What a compiled kernel says of each ray: a triangle, a miss, or [`UNCERTAIN`].
///
/// # Errors
/// As [`closest`].
pub fn launch(
    gpu: &Gpu,
    scene: &Scene,
    kernel: &Kernel,
    pipeline: &Pipeline,
    rays: &[Ray],
) -> Result<Vec<u32>, GpuError> {
    let [words, queue] = run(gpu, scene, kernel, pipeline, rays, UNCERTAIN, 1 + rays.len())?;
    let mut found: Vec<u32> = words.iter().step_by(4).copied().collect();
    for &ray in queue.iter().skip(1).take(queue[0] as usize) {
        if let Some(found) = found.get_mut(ray as usize) {
            *found = UNCERTAIN;
        }
    }
    Ok(found)
}

/// The hits of rays by what a kernel has said of each, and how many were in doubt.
///
/// # Errors
/// Of this machine's threads, if their floats are of no use.
pub fn settle(bvh: &Bvh, rays: &[Ray], found: &[u32]) -> Result<(Vec<Option<Hit>>, usize), EnvironmentError> {
    let mut places = vec![u32::MAX; bvh.triangles().iter().map(|held| held.prim as usize + 1).max().unwrap_or(0)];
    for (held, place) in bvh.triangles().iter().zip(0..) {
        places[held.prim as usize] = place;
    }
    let certain = |(ray, &triangle): (&Ray, &u32)| {
        let place = *places.get(triangle as usize)?;
        let (exact, held) = (Exact::new(ray, bvh.region()), bvh.triangles().get(place as usize)?);
        let t = exact.distance(&held.shape, f32::INFINITY)?;
        let [u, v] = exact.weights(&held.shape);
        Some(Hit { prim: held.prim, t, u, v })
    };
    let mut hits: Vec<Option<Hit>> = rays.par_iter().zip(found).map(certain).collect();
    let uncertain: Vec<usize> = (0..rays.len()).filter(|&i| found.get(i) == Some(&UNCERTAIN)).collect();
    let open: Vec<Ray> = uncertain.iter().map(|&i| rays[i]).collect();
    for (&i, hit) in uncertain.iter().zip(BinaryTracer::new(bvh).closest_parallel(&open)?) {
        hits[i] = hit;
    }
    Ok((hits, uncertain.len()))
}
