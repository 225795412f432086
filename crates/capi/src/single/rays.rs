//! Rays in single precision.

use glam::Vec3;

use crate::border::answer;
use crate::error::Error;
use crate::filters::Filters;
use crate::memory::{In, Out, shared};
use crate::scene::Scene;
use crate::types::{Filter, Hit, Ray};

/// Finds the closest hit of a ray: the least exact distance, and of equal ones the least index of a face. With a filter,
/// which may be null, the first hit that it accepts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_closest1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    filter: *const Filter<f32>,
    hit: *mut Hit<f32>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, ray, mut hit) = unsafe { (shared(scene, "scene")?, In::one("ray", ray)?, Out::one("hit", hit)?) };
        // SAFETY: likewise.
        let filter = unsafe { Filters::new(filter, 0, 1) }?;
        hit.set(0, scene.closest1(&ray, &filter, 0)?);
        Ok(())
    })
}

/// Finds out whether a ray hits anything, with a filter anything that it accepts. It may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_any1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    filter: *const Filter<f32>,
    is_hit: *mut bool,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, ray, mut is_hit) =
            unsafe { (shared(scene, "scene")?, In::one("ray", ray)?, Out::one("is_hit", is_hit)?) };
        // SAFETY: likewise.
        let filter = unsafe { Filters::new(filter, 0, 1) }?;
        is_hit.set(0, scene.any1(&ray, &filter, 0)?);
        Ok(())
    })
}

/// Finds all hits of a ray, each face once, in the order of exact distances and then of indices; with a filter, which may
/// be null, those that it accepts. Writes the first ones, as many as there is room for, and to `count` how many there
/// are. With a capacity of 0, `hits` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_all1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    filter: *const Filter<f32>,
    hits: *mut Hit<f32>,
    hit_stride: usize,
    capacity: usize,
    count: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, ray, mut hits, mut count) = unsafe {
            let hits = Out::new("hits", hits, hit_stride, capacity)?;
            (shared(scene, "scene")?, In::one("ray", ray)?, hits, Out::one("count", count)?)
        };
        // SAFETY: likewise.
        let filter = unsafe { Filters::new(filter, 0, 1) }?;
        count.set(0, hits.fill(&scene.all1(&ray, &filter)?));
        Ok(())
    })
}

/// Finds the first hit after another one of the same ray, in the order of `stackless_all1_f`. So a program can walk
/// from hit to hit: none is lost or met again, however close they are. `after` and `hit` may be the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_next1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    after: *const Hit<f32>,
    hit: *mut Hit<f32>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do. `after` is read before anything is written.
        let (scene, ray, after, mut hit) = unsafe {
            let after = In::one("after", after)?.get(0);
            (shared(scene, "scene")?, In::one("ray", ray)?, after, Out::one("hit", hit)?)
        };
        hit.set(0, scene.next1(&ray, after)?);
        Ok(())
    })
}

/// Finds the closest hit of each ray, by `stackless_closest1_f`. `filters` may be null. There is one for each ray, or
/// with a stride of 0 one for all.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_closest_n_f(
    scene: *const Scene<Vec3>,
    rays: *const Ray<f32>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<f32>,
    filter_stride: usize,
    hits: *mut Hit<f32>,
    hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        shared(scene, "scene")?.closest_n(&rays, &filters, Out::new("hits", hits, hit_stride, count)?, flags)
    })
}

/// Finds out for each ray whether it hits anything, by `stackless_any1_f`. Filters are as in `stackless_closest_n_f`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_any_n_f(
    scene: *const Scene<Vec3>,
    rays: *const Ray<f32>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<f32>,
    filter_stride: usize,
    is_hit: *mut bool,
    is_hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        shared(scene, "scene")?.any_n(&rays, &filters, Out::new("is_hit", is_hit, is_hit_stride, count)?, flags)
    })
}

/// Counts how often each ray crosses a closed mesh. A crossing at an edge or a vertex is one, and touching is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_crossings_n_f(
    scene: *const Scene<Vec3>,
    rays: *const Ray<f32>,
    ray_stride: usize,
    count: usize,
    crossings: *mut u32,
    crossing_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        shared(scene, "scene")?.crossings_n(&rays, Out::new("crossings", crossings, crossing_stride, count)?, flags)
    })
}
