//! Exact answers by a device with single precision: kernels report certain results, and the CPU settles the remaining
//! rays.
//!
//! `triangle_band.wgsl` distinguishes certain misses from certain hits by the error bounds of BAND-2, and bounds a
//! hit's distance by BAND-4. A hit replaces the best hit only if its upper bound is less than the best hit's lower
//! bound. Both bounds are floats, so the rounded distances have that order. A box is skipped only if it begins beyond
//! the upper bound of the best hit. Any doubt ends the search; such rays are queued, and the exact tracer traces them.
//! For all other rays the triangle is certain, and the CPU computes the exact distance and weights. So the hits are
//! those of the exact tracer, bit for bit (BAND-5).

use std::time::Instant;

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::Kernel as _;
use stackless_bvh::geom::{EnvironmentError, Ray};
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::trace::{BinaryTracer, Hit, RayQueries};

use crate::kernel::Kernel;
use crate::launch::compile;
use crate::model::has_parallel;
use crate::probe::Arithmetic;
use crate::rays::run;
use crate::scene::{Query, Scene};
use crate::{Checks, Gpu, GpuError, Pipeline};

/// The result of a ray in doubt.
pub const UNCERTAIN: u32 = u32::MAX - 1;

/// The factor of u D E (2C + E) that bounds the errors of edge functions. `[BAND-2]`
pub const EDGE_FACTOR: f32 = 39.0;

/// Exact closest hits, with times.
#[derive(Debug)]
pub struct Settled {
    /// The hits.
    pub hits: Vec<Option<Hit>>,
    /// Number of rays that the device left in doubt.
    pub uncertain: usize,
    /// Seconds until the device finished, including transfers.
    pub device_seconds: f64,
    /// Seconds of the CPU after the device finished.
    pub settle_seconds: f64,
}

/// Traces rays exactly, by a kernel that assumes errors of edge functions up to `factor`, which should be
/// [`EDGE_FACTOR`].
///
/// # Errors
/// [`GpuError::Feature`] for a device without the bounds; other errors of the device.
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
    let triangles = triangles(arithmetic, factor);
    let parallel = rays.iter().any(has_parallel);
    let query = Query { triangles: &triangles, any: false, parallel, refines: false };
    let placed = scene.placed(kernel)?;
    let pipeline = compile(gpu, kernel, placed.depth, &placed.source(gpu, kernel, query), Checks::All)?;
    let found = launch(gpu, scene, kernel, &pipeline, rays)?;
    let device_seconds = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (hits, uncertain) = settle(bvh, rays, &found)?;
    Ok(Settled { hits, uncertain, device_seconds, settle_seconds: start.elapsed().as_secs_f64() })
}

/// Checks that the bounds hold on a device. `[BAND-1]`
///
/// # Errors
/// [`GpuError::Feature`] with the missing property.
pub const fn holds(arithmetic: &Arithmetic) -> Result<(), GpuError> {
    if arithmetic.rounds { Ok(()) } else { Err(GpuError::Feature("rounding to nearest")) }
}

/// The text of the triangle test.
pub fn triangles(arithmetic: &Arithmetic, factor: f32) -> String {
    let floor = floor(*arithmetic);
    let test = include_str!("../wgsl/triangle_band.wgsl");
    format!("const EDGE_FACTOR = f32({factor});\nconst FLOOR = f32({floor:e});\n{test}")
}

/// The minimum size in error bounds, so that underflow does not matter. `[BAND-1]`
const fn floor(arithmetic: Arithmetic) -> f32 {
    let exponent = if arithmetic.keeps_subnormals { 40 } else { 32 };
    f32::from_bits((127 - exponent) << 23)
}

/// Runs a compiled kernel. Returns for each ray a triangle, a miss, or [`UNCERTAIN`].
///
/// # Errors
/// The errors of [`closest`].
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

/// Returns the hits of rays from the results of a kernel, and the number of rays in doubt.
///
/// # Errors
/// The floating-point environment of this machine's threads is unsuitable.
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

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use glam::{DVec3, Vec3};
    use stackless_bvh::generate::{Rng, Source as _};
    use stackless_bvh::internals::geom::kernel::Accumulator;

    use super::{Arithmetic, EDGE_FACTOR, floor};

    const U: f32 = f32::EPSILON / 2.0;

    /// Adds a . (b x c), or subtracts it.
    fn add_triple(sum: &mut Accumulator, sign: f64, [a, b, c]: [DVec3; 3]) {
        for [k, i, j] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            sum.add_product([sign * a[k], b[i], c[j]]);
            sum.add_product([-sign * a[k], b[j], c[i]]);
        }
    }

    /// Whether the error of `found`, compared with a sum of triple products, is at most `bound`.
    fn is_within(bound: f32, found: f32, truth: &Accumulator) -> bool {
        let side = |end: f64| {
            let mut sum = truth.clone();
            sum.add_product([-end, 1.0, 1.0]);
            sum.sign()
        };
        let (found, bound) = (f64::from(found), f64::from(bound));
        side(found - bound) != Ordering::Less && side(found + bound) != Ordering::Greater
    }

    /// Counts small triangles whose determinant, edge function or numerator exceeds its bound on a device that flushes.
    /// The numerator's error must exceed 2^-121.
    fn beyond(arithmetic: Arithmetic, floor: f32) -> usize {
        let mut rng = Rng::new(1);
        let mut number = |exponent: i32, spread: u64| {
            let digits = (1 << 23 | rng.below(1 << 23)) as f32 * f32::EPSILON;
            let sign = if rng.below(2) == 0 { 1.0 } else { -1.0 };
            sign * digits * f32::exp2((exponent - rng.below(spread) as i32) as f32)
        };
        let sizes = (-46..-26).flat_map(|edge| [-20, -12].map(|size| (edge, size)));
        let mut beyond = 0;
        for (edge, size) in sizes.cycle().take(40_000) {
            let [v0, v1, v2] = [(); 3].map(|()| Vec3::from([(); 3].map(|()| number(edge, 8))));
            let origin = Vec3::from([(); 3].map(|()| number(edge + 1, 12)));
            let direction = Vec3::new(number(size, 1), number(size, 30), number(size, 8));
            let [e1, e2, s] =
                [v1 - v0, v2 - v0, origin - v0].map(|v| Vec3::from(v.to_array().map(|x| arithmetic.kept(x))));
            // Exact in double precision.
            let exactly = |a: Vec3, b: Vec3| a.as_dvec3() - b.as_dvec3();
            let [x, y, z, d] = [exactly(v1, v0), exactly(v2, v0), exactly(origin, v0), direction.as_dvec3()];
            let truth = |terms: &[(f64, [DVec3; 3])]| {
                let mut sum = Accumulator::new();
                for &(sign, vectors) in terms {
                    add_triple(&mut sum, sign, vectors);
                }
                sum
            };
            for fuses in [false, true] {
                let device = Arithmetic { fuses, ..arithmetic };
                let (p, q) = (device.cross(direction, e2), device.cross(s, e1));
                let det = device.dot(e1, p);
                let (u, v) = (device.dot(s, p), device.dot(direction, q));
                let w = device.kept(device.kept(det - u) - v);
                let [reach, sides, widest] = [s, e1.abs().max(e2.abs()), direction].map(|v| v.abs().max_element());
                let (reach, sides) = (reach.max(floor), sides.max(floor));
                let delta = ((EDGE_FACTOR * U * widest) * sides) * (2.0 * reach + sides);
                let [t_off, det_off] =
                    [36.0 * U * reach, 32.0 * U * widest].map(|x| device.kept(device.kept(x * sides) * sides));
                let spare = f32::exp2(-121.0);
                let checks = [
                    (delta, u, truth(&[(1.0, [z, d, y])])),
                    (delta, v, truth(&[(1.0, [d, z, x])])),
                    (delta, w, truth(&[(1.0, [x, d, y]), (-1.0, [z, d, y]), (-1.0, [d, z, x])])),
                    (det_off, det, truth(&[(1.0, [x, d, y])])),
                    (t_off - spare, device.dot(e2, q), truth(&[(1.0, [y, z, x])])),
                ];
                beyond += checks.iter().filter(|(bound, found, truth)| !is_within(*bound, *found, truth)).count();
            }
        }
        beyond
    }

    /// If subnormal results are lost, the bounds hold with the greater floor, and fail with the smaller floor. [BAND-2]
    /// [BAND-3]
    #[test]
    fn bounds_hold_where_results_are_flushed() {
        let flushes = Arithmetic {
            fuses: true,
            rounds: true,
            contracts: false,
            divides: false,
            divides_refined: true,
            keeps_subnormals: false,
            min_is_select: true,
        };
        assert_eq!(beyond(flushes, floor(flushes)), 0);
        assert!(beyond(flushes, floor(Arithmetic { keeps_subnormals: true, ..flushes })) > 0);
    }
}
