//! Exact answers by a device that has single precision: kernels say what is certain, the CPU settles the rest.
//!
//! `triangle_band.wgsl` tells certain misses from certain hits by the error bounds of EXACT-4 and EXACT-5, and knows a
//! hit's distance within bounds. A hit replaces another only if its upper bound is less than the other's lower one:
//! both are floats, so the rounded distances are in that order too. A box is skipped only if it begins beyond the upper
//! bound of the best hit. What is in doubt ends the search; such rays are queued, and traced by the exact tracer. For
//! the others the triangle is certain, and the CPU computes its exact distance and weights. So the hits are those of
//! the exact tracer, bit for bit.
//!
//! Rounding must be to nearest and subnormal numbers must be kept, as the bounds and BOX-2 ask. Divisions may be off by
//! less than 8 u.

use std::fmt::Write as _;
use std::time::Instant;

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::kernel::Exact;
use stackless_bvh::geom::{Kernel as _, Ray};
use stackless_bvh::trace::{Hit, Tracer};

use crate::kernel::Kernel;
use crate::launch::{BINDINGS, Buffers, params};
use crate::model::has_parallel;
use crate::probe::Arithmetic;
use crate::scene::{Query, Scene, rays_words};
use crate::{Checks, Gpu, GpuError};

/// What is written for a ray in doubt.
const UNCERTAIN: u32 = u32::MAX - 1;

/// The factor of u D E (2C + E) that bounds the errors of edge functions. `[EXACT-4]`
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
    if !arithmetic.rounds {
        return Err(GpuError::Feature("rounding to nearest"));
    }
    if !arithmetic.keeps_subnormals {
        return Err(GpuError::Feature("subnormal numbers"));
    }
    let mut text = format!("const EDGE_FACTOR = f32({factor});\n");
    let _ = writeln!(text, "{}", include_str!("../wgsl/triangle_band.wgsl"));
    let parallel = rays.iter().any(has_parallel);
    let query = Query { triangles: &text, any: false, parallel, refines: false };
    let source = scene.source(gpu, kernel, query);
    let pipeline = gpu.compile("exact", &source, &BINDINGS, Checks::All)?;
    let count = rays.len() as u32;
    let tasks = gpu.buffer("rays", &rays_words(rays)?)?;
    let results = gpu.buffer("hits", &vec![UNCERTAIN; 4 * rays.len()])?;
    let (work, params) = (gpu.zeros("queue", 1 + rays.len())?, params(gpu, count)?);
    let [nodes, leaves, displacements, cells] = scene.buffers(kernel);
    let buffers =
        Buffers { nodes, leaves, displacements, cells, tasks: &tasks, results: &results, params: &params, work: &work };
    gpu.run(&[buffers.pass(kernel, &pipeline, count)])?;
    let words = gpu.read(&results, 4 * rays.len())?;
    let queue = gpu.read(&work, 1 + rays.len())?;
    let device_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let mut places = vec![u32::MAX; bvh.triangles().iter().map(|held| held.prim as usize + 1).max().unwrap_or(0)];
    for (held, place) in bvh.triangles().iter().zip(0..) {
        places[held.prim as usize] = place;
    }
    let certain = |(ray, words): (&Ray, &[u32])| {
        let place = *places.get(words[0] as usize)?;
        let (exact, held) = (Exact::new(ray, bvh.region()), bvh.triangles().get(place as usize)?);
        let t = exact.distance(&held.shape, f32::INFINITY)?;
        let [u, v] = exact.weights(&held.shape);
        Some(Hit { prim: held.prim, t, u, v })
    };
    let mut hits: Vec<Option<Hit>> = rays.par_iter().zip(words.par_chunks_exact(4)).map(certain).collect();
    let uncertain: Vec<usize> = queue.iter().skip(1).take(queue[0] as usize).map(|&ray| ray as usize).collect();
    let open: Vec<Ray> = uncertain.iter().filter_map(|&i| rays.get(i).copied()).collect();
    for (&i, hit) in uncertain.iter().zip(Tracer::new(bvh).closest_parallel(&open)) {
        if let Some(place) = hits.get_mut(i) {
            *place = hit;
        }
    }
    Ok(Settled { hits, uncertain: uncertain.len(), device_seconds, settle_seconds: start.elapsed().as_secs_f64() })
}
