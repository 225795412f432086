//! Rays: the hits of every kernel, compared with a model of its arithmetic and with the exact tracer.

use std::fmt;

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::Ray;
use stackless_bvh::order::Pruning;
use stackless_bvh::trace::Hit;

use crate::kernel::Kernel;
use crate::launch::{Buffers, compile, params};
use crate::model::{Found, Model, through};
use crate::probe::Arithmetic;
use crate::scene::{Eight, Query, Scene, rays_words};
use crate::tapes::Edit;
use crate::{Checks, Gpu, GpuError, Pipeline};

/// The comparison of a kernel's hits.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Number of rays.
    pub rays: usize,
    /// Number of rays whose hit differs from the model, bit for bit. Kernels with another order match the model only if
    /// arithmetic is exact.
    pub mismatches: usize,
    /// The first mismatch.
    pub first: Option<String>,
}

/// Single precision compared with the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Errors {
    /// Hitting rays without a hit.
    pub missed: usize,
    /// Missing rays with a hit.
    pub invented: usize,
    /// Hits of another triangle.
    pub other: usize,
    /// Maximum number of floats between the distances of equal triangles.
    pub ulps: u32,
    /// Hits that differ in any bit.
    pub differences: usize,
}

impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { missed, invented, other, ulps, .. } = self;
        write!(f, "against the truth {missed} missed, {invented} invented, {other} other triangles, {ulps} ulps")
    }
}

/// The hits of a kernel with an edited text.
///
/// # Errors
/// [`GpuError`].
pub fn trace(
    gpu: &Gpu,
    scene: &Scene,
    kernel: &Kernel,
    query: Query<'_>,
    rays: &[Ray],
    edit: Edit<'_>,
) -> Result<Vec<Found>, GpuError> {
    let placed = scene.placed(kernel)?;
    let pipeline = compile(gpu, kernel, placed.depth, &edit(placed.source(gpu, kernel, query)), Checks::All)?;
    launch(gpu, scene, kernel, &pipeline, rays)
}

/// The hits of a compiled kernel, for this scene or for any scene.
///
/// # Errors
/// [`GpuError`].
pub fn launch(
    gpu: &Gpu,
    scene: &Scene,
    kernel: &Kernel,
    pipeline: &Pipeline,
    rays: &[Ray],
) -> Result<Vec<Found>, GpuError> {
    // A value that no kernel writes, so that omitted rays are detected.
    let [words, _] = run(gpu, scene, kernel, pipeline, rays, 0xdead_beef, 4)?;
    Ok(words.as_chunks().0.iter().map(|&words| Found::of_words(words)).collect())
}

/// Returns the four words of each ray, initially `unwritten`, and the kernel's `work` words, initially 0.
pub(crate) fn run(
    gpu: &Gpu,
    scene: &Scene,
    kernel: &Kernel,
    pipeline: &Pipeline,
    rays: &[Ray],
    unwritten: u32,
    work: usize,
) -> Result<[Vec<u32>; 2], GpuError> {
    let (count, placed) = (rays.len() as u32, scene.placed(kernel)?);
    let mut words = rays_words(rays)?;
    words.extend(placed.head());
    let tasks = gpu.buffer("rays", &words)?;
    let results = gpu.buffer("hits", &vec![unwritten; 4 * rays.len()])?;
    let (worked, params) = (gpu.zeros("work", work)?, params(gpu, count)?);
    let [nodes, leaves, displacements, cells] = placed.buffers;
    let buffers = Buffers {
        nodes,
        leaves,
        displacements,
        cells,
        tasks: &tasks,
        results: &results,
        params: &params,
        work: &worked,
    };
    gpu.run_and_read(&[buffers.pass(kernel, pipeline, count)], [(&results, 4 * rays.len()), (&worked, work)])
}

/// The expected hits of kernels, by the model. Kernels with equal visits share answers.
#[derive(Debug)]
pub struct Models<'a> {
    arithmetic: &'a Arithmetic,
    bvh: &'a Bvh,
    eight: Option<&'a Eight>,
    rays: &'a [Ray],
    any: bool,
    known: Vec<(Option<Pruning>, Vec<Found>)>,
}

impl<'a> Models<'a> {
    /// For these rays through the hierarchies of a scene, of two children and of eight.
    pub const fn new(
        arithmetic: &'a Arithmetic,
        (bvh, eight): (&'a Bvh, Option<&'a Eight>),
        rays: &'a [Ray],
        any: bool,
    ) -> Self {
        Self { arithmetic, bvh, eight, rays, any, known: Vec::new() }
    }

    /// The expected hits of a kernel.
    ///
    /// # Errors
    /// [`GpuError::Data`] without the hierarchy of the kernel.
    pub fn of(&mut self, kernel: &Kernel) -> Result<&[Found], GpuError> {
        let Self { arithmetic, bvh, eight, rays, any, ref mut known } = *self;
        // No kernel of eight children prunes.
        let pruning = kernel.method().map(|method| method.test().pruning());
        if let Some(at) = known.iter().position(|&(of, _)| of == pruning) {
            return Ok(&known[at].1);
        }
        let found = match (pruning, eight) {
            (Some(pruning), _) => rays.par_iter().map(|ray| Model::trace(arithmetic, bvh, ray, pruning, any)).collect(),
            (None, Some(eight)) => rays.par_iter().map(|ray| through(arithmetic, eight, ray, any).0).collect(),
            (None, None) => return Err(GpuError::Data("there is no hierarchy of eight children".to_owned())),
        };
        known.push((pruning, found));
        Ok(&known[known.len() - 1].1)
    }
}

/// Compares hits with the model.
pub fn compare(kernel: &Kernel, found: &[Found], expected: &[Found], any: bool, rays: &[Ray]) -> Report {
    let agrees = |found: &Found, expected: &Found| {
        if any && !kernel.keeps_order() { found.is_hit() == expected.is_hit() } else { same(found, expected) }
    };
    let wrong: Vec<usize> = (0..found.len()).filter(|&i| !agrees(&found[i], &expected[i])).collect();
    let first =
        wrong.first().map(|&i| format!("ray {i} {:?}: expected {:?}, found {:?}", rays[i], expected[i], found[i]));
    Report { rays: found.len(), mismatches: wrong.len(), first }
}

/// Whether two results are equal, bit for bit. All misses are equal.
fn same(a: &Found, b: &Found) -> bool {
    let bits = |found: &Found| (found.t.to_bits(), found.weights.map(f32::to_bits));
    a.triangle == b.triangle && (!a.is_hit() || bits(a) == bits(b))
}

/// Compares closest hits with the truth. For any-hit queries, only compares whether there is a hit.
pub fn errors(found: &[Found], truth: &[Option<Hit>], any: bool) -> Errors {
    let mut errors = Errors::default();
    for (found, truth) in found.iter().zip(truth) {
        match truth {
            None => errors.invented += usize::from(found.is_hit()),
            Some(_) if !found.is_hit() => errors.missed += 1,
            Some(_) if any => {}
            Some(hit) if hit.prim != found.triangle => errors.other += 1,
            Some(hit) => errors.ulps = errors.ulps.max(hit.t.to_bits().abs_diff(found.t.to_bits())),
        }
        let exact = truth.map_or(Found { triangle: u32::MAX, t: 0.0, weights: [0.0; 2] }, |hit| Found {
            triangle: hit.prim,
            t: hit.t,
            weights: [hit.u, hit.v],
        });
        let is_same = if any { found.is_hit() == truth.is_some() } else { same(found, &exact) };
        errors.differences += usize::from(!is_same);
    }
    errors
}
