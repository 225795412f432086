//! Exact points, and rays that start at them, in double precision.

use std::ptr;

use glam::DVec3;

use crate::border::answer;
use crate::error::Error;
use crate::exact::{ExactRay, Point};
use crate::filters::Filters;
use crate::instances::Instances;
use crate::memory::{In, Out, exclusive, shared};
use crate::scene::Scene;
use crate::types::{Filter, Hit, InstanceHit, Ray, STACKLESS_SERIAL};
use crate::ways::{self, Points, boxed};

/// Creates an exact point from three numbers. `*point` is null after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_point_new_d(coordinates: *const f64, point: *mut *mut Point<DVec3>) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (mut made, coordinates) = unsafe {
            let mut made = Out::one("point", point)?;
            made.set(0, ptr::null_mut());
            (made, In::one("coordinates", coordinates.cast())?)
        };
        made.set(0, boxed(Point::new(coordinates.get(0), coordinates.element(0))?));
        Ok(())
    })
}

/// Creates the exact point at which a ray hits a face. It is not rounded. `*point` is null after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_point_of_hit_d(
    scene: *const Scene<DVec3>,
    ray: *const Ray<f64>,
    face: u32,
    point: *mut *mut Point<DVec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (mut made, scene, ray) = unsafe {
            let mut made = Out::one("point", point)?;
            made.set(0, ptr::null_mut());
            (made, shared(scene, "scene")?, In::one("ray", ray)?)
        };
        made.set(0, boxed(scene.point_of_hit(&ray, face)?));
        Ok(())
    })
}

/// Destroys a point. No thread may use it any more. Null is ignored. Rays that started there do not need it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_point_free_d(point: *mut Point<DVec3>) -> Error {
    answer(|| {
        if !point.is_null() {
            // SAFETY: the header requires an unused point of this library.
            drop(unsafe { Box::from_raw(ptr::from_mut(exclusive(point, "point")?)) });
        }
        Ok(())
    })
}

/// Finds the closest hit of a ray that starts at an exact point, and creates the exact point of the hit, at which the
/// next ray may start. With a filter, which may be null, finds the first accepted hit. `point` may be null. `*point` is
/// null after a miss and after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_closest1_d(
    scene: *const Scene<DVec3>,
    ray: *const ExactRay<f64, DVec3>,
    filter: *const Filter<ExactRay<f64, DVec3>, u32, Hit<f64>>,
    hit: *mut Hit<f64>,
    point: *mut *mut Point<DVec3>,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let point = Points::null(point, |point| Out::one("point", point))?;
        let (ray, filter) = (In::one("ray", ray)?, Filters::new(filter, 0, 1)?);
        ways::closest(shared(scene, "scene")?, &ray, &filter, Out::one("hit", hit)?, point, STACKLESS_SERIAL)
    })
}

/// Finds whether a ray that starts at an exact point hits any face; with a filter, which may be null, whether it has an
/// accepted hit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_any1_d(
    scene: *const Scene<DVec3>,
    ray: *const ExactRay<f64, DVec3>,
    filter: *const Filter<ExactRay<f64, DVec3>, u32, Hit<f64>>,
    is_hit: *mut bool,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let (ray, filter) = (In::one("ray", ray)?, Filters::new(filter, 0, 1)?);
        ways::any(shared(scene, "scene")?, &ray, &filter, Out::one("is_hit", is_hit)?, STACKLESS_SERIAL)
    })
}

/// Finds the closest hit of each ray, by `stackless_exact_closest1_d`. Filters are as in `stackless_closest_n_d`.
/// `points` may be null. Each of its pointers is null after a miss, and all are null after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_closest_n_d(
    scene: *const Scene<DVec3>,
    rays: *const ExactRay<f64, DVec3>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<ExactRay<f64, DVec3>, u32, Hit<f64>>,
    filter_stride: usize,
    hits: *mut Hit<f64>,
    hit_stride: usize,
    points: *mut *mut Point<DVec3>,
    point_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let points = Points::null(points, |points| Out::new("points", points, point_stride, count))?;
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        let hits = Out::new("hits", hits, hit_stride, count)?;
        ways::closest(shared(scene, "scene")?, &rays, &filters, hits, points, flags)
    })
}

/// Finds whether each ray has a hit, by `stackless_exact_any1_d`. Filters are as in `stackless_closest_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_any_n_d(
    scene: *const Scene<DVec3>,
    rays: *const ExactRay<f64, DVec3>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<ExactRay<f64, DVec3>, u32, Hit<f64>>,
    filter_stride: usize,
    is_hit: *mut bool,
    is_hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        let is_hit = Out::new("is_hit", is_hit, is_hit_stride, count)?;
        ways::any(shared(scene, "scene")?, &rays, &filters, is_hit, flags)
    })
}

/// Finds the closest hit of a ray that starts at an exact point, like `stackless_exact_closest1_d`. The point of the hit
/// may be the start of rays of these instances, of other instances and of scenes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_exact_closest1_d(
    instances: *const Instances<DVec3>,
    ray: *const ExactRay<f64, DVec3>,
    filter: *const Filter<ExactRay<f64, DVec3>, InstanceHit<f64>, InstanceHit<f64>>,
    hit: *mut InstanceHit<f64>,
    point: *mut *mut Point<DVec3>,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let point = Points::null(point, |point| Out::one("point", point))?;
        let (ray, filter) = (In::one("ray", ray)?, Filters::new(filter, 0, 1)?);
        ways::closest(shared(instances, "instances")?, &ray, &filter, Out::one("hit", hit)?, point, STACKLESS_SERIAL)
    })
}

/// Finds whether a ray that starts at an exact point has a hit, like `stackless_exact_any1_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_exact_any1_d(
    instances: *const Instances<DVec3>,
    ray: *const ExactRay<f64, DVec3>,
    filter: *const Filter<ExactRay<f64, DVec3>, InstanceHit<f64>, InstanceHit<f64>>,
    is_hit: *mut bool,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let (ray, filter) = (In::one("ray", ray)?, Filters::new(filter, 0, 1)?);
        ways::any(shared(instances, "instances")?, &ray, &filter, Out::one("is_hit", is_hit)?, STACKLESS_SERIAL)
    })
}

/// Finds the closest hit of each ray, like `stackless_exact_closest_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_exact_closest_n_d(
    instances: *const Instances<DVec3>,
    rays: *const ExactRay<f64, DVec3>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<ExactRay<f64, DVec3>, InstanceHit<f64>, InstanceHit<f64>>,
    filter_stride: usize,
    hits: *mut InstanceHit<f64>,
    hit_stride: usize,
    points: *mut *mut Point<DVec3>,
    point_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let points = Points::null(points, |points| Out::new("points", points, point_stride, count))?;
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        let hits = Out::new("hits", hits, hit_stride, count)?;
        ways::closest(shared(instances, "instances")?, &rays, &filters, hits, points, flags)
    })
}

/// Finds whether each ray has a hit, like `stackless_exact_any_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_exact_any_n_d(
    instances: *const Instances<DVec3>,
    rays: *const ExactRay<f64, DVec3>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<ExactRay<f64, DVec3>, InstanceHit<f64>, InstanceHit<f64>>,
    filter_stride: usize,
    is_hit: *mut bool,
    is_hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        let is_hit = Out::new("is_hit", is_hit, is_hit_stride, count)?;
        ways::any(shared(instances, "instances")?, &rays, &filters, is_hit, flags)
    })
}
