//! Exact points, and rays that start at them, in double precision.

use std::ptr;

use glam::DVec3;

use crate::border::answer;
use crate::error::{Error, Fault};
use crate::exact::{Answers, Exact as _, Point, Way};
use crate::filters::Filters;
use crate::instances::Instances;
use crate::memory::{In, Out, exclusive, room, shared};
use crate::scene::Scene;
use crate::types::{ExactRay, Filter, Hit, InstanceHit, Ray, STACKLESS_SERIAL};

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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, way, mut hit, mut made) = unsafe {
            let mut made = if point.is_null() { None } else { Some(Out::one("point", point)?) };
            clear(&mut made);
            (shared(scene, "scene")?, one(ray, filter)?, Out::one("hit", hit)?, made)
        };
        write(scene.exact_closest(&[way], made.is_some(), STACKLESS_SERIAL)?, &mut hit, &mut made);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, way, mut is_hit) =
            unsafe { (shared(scene, "scene")?, one(ray, filter)?, Out::one("is_hit", is_hit)?) };
        is_hit.fill(&scene.exact_any(&[way], STACKLESS_SERIAL)?);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, ways, mut hits, mut made) = unsafe {
            let mut made = if points.is_null() { None } else { Some(Out::new("points", points, point_stride, count)?) };
            clear(&mut made);
            let ways = several(rays, ray_stride, count, filters, filter_stride)?;
            (shared(scene, "scene")?, ways, Out::new("hits", hits, hit_stride, count)?, made)
        };
        write(scene.exact_closest(&ways, made.is_some(), flags)?, &mut hits, &mut made);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, ways, mut is_hit) = unsafe {
            let ways = several(rays, ray_stride, count, filters, filter_stride)?;
            (shared(scene, "scene")?, ways, Out::new("is_hit", is_hit, is_hit_stride, count)?)
        };
        is_hit.fill(&scene.exact_any(&ways, flags)?);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, way, mut hit, mut made) = unsafe {
            let mut made = if point.is_null() { None } else { Some(Out::one("point", point)?) };
            clear(&mut made);
            (shared(instances, "instances")?, one(ray, filter)?, Out::one("hit", hit)?, made)
        };
        write(instances.exact_closest(&[way], made.is_some(), STACKLESS_SERIAL)?, &mut hit, &mut made);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, way, mut is_hit) =
            unsafe { (shared(instances, "instances")?, one(ray, filter)?, Out::one("is_hit", is_hit)?) };
        is_hit.fill(&instances.exact_any(&[way], STACKLESS_SERIAL)?);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, ways, mut hits, mut made) = unsafe {
            let mut made = if points.is_null() { None } else { Some(Out::new("points", points, point_stride, count)?) };
            clear(&mut made);
            let ways = several(rays, ray_stride, count, filters, filter_stride)?;
            (shared(instances, "instances")?, ways, Out::new("hits", hits, hit_stride, count)?, made)
        };
        write(instances.exact_closest(&ways, made.is_some(), flags)?, &mut hits, &mut made);
        Ok(())
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
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, ways, mut is_hit) = unsafe {
            let ways = several(rays, ray_stride, count, filters, filter_stride)?;
            (shared(instances, "instances")?, ways, Out::new("is_hit", is_hit, is_hit_stride, count)?)
        };
        is_hit.fill(&instances.exact_any(&ways, flags)?);
        Ok(())
    })
}

/// Reads an exact ray.
///
/// # Safety
/// See [`way`].
unsafe fn one<'a, S: Copy, H: Copy>(
    ray: *const ExactRay<f64, DVec3>,
    filter: *const Filter<ExactRay<f64, DVec3>, S, H>,
) -> Result<Way<'a, DVec3, S, H>, Fault> {
    // SAFETY: the caller guarantees the requirements.
    unsafe { way(&In::one("ray", ray)?, &Filters::new(filter, 0, 1)?, 0) }
}

/// Reads exact rays.
///
/// # Safety
/// See [`way`].
unsafe fn several<'a, S: Copy, H: Copy>(
    rays: *const ExactRay<f64, DVec3>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<ExactRay<f64, DVec3>, S, H>,
    filter_stride: usize,
) -> Result<Vec<Way<'a, DVec3, S, H>>, Fault> {
    // SAFETY: the caller guarantees the requirements.
    unsafe {
        let (rays, filters) = (In::new("rays", rays, ray_stride, count)?, Filters::new(filters, filter_stride, count)?);
        let mut ways = room(count)?;
        for index in 0..count {
            ways.push(way(&rays, &filters, index)?);
        }
        Ok(ways)
    }
}

/// Reads an exact ray of an array, and its filter.
///
/// # Safety
/// See [`shared`], for the points of the rays.
unsafe fn way<'a, S: Copy, H: Copy>(
    rays: &In<'a, ExactRay<f64, DVec3>>,
    filters: &Filters<'_, ExactRay<f64, DVec3>, S, H>,
    index: usize,
) -> Result<Way<'a, DVec3, S, H>, Fault> {
    let (element, filter) = (rays.element(index), filters.get(index, rays)?);
    let ExactRay { origin, target, direction, tmax, is_closed } = rays.get(index);
    // SAFETY: the caller guarantees the requirements.
    let points = unsafe {
        let point = |point, name| shared(point, name).map_err(|fault| fault.within(element));
        (point(origin, "origin")?, if target.is_null() { None } else { Some(point(target, "target")?) })
    };
    let (origin, target) = points;
    Ok(Way { origin, target, direction, tmax, is_closed, filter, element })
}

/// Writes null to all elements.
fn clear(points: &mut Option<Out<'_, *mut Point<DVec3>>>) {
    if let Some(points) = points {
        for index in 0..points.count() {
            points.set(index, ptr::null_mut());
        }
    }
}

fn write<H: Copy>(answers: Answers<DVec3, H>, hits: &mut Out<'_, H>, points: &mut Option<Out<'_, *mut Point<DVec3>>>) {
    for (index, (hit, point)) in answers.into_iter().enumerate() {
        hits.set(index, hit);
        if let (Some(points), Some(point)) = (&mut *points, point) {
            points.set(index, boxed(point));
        }
    }
}

fn boxed(point: Point<DVec3>) -> *mut Point<DVec3> {
    Box::into_raw(Box::new(point))
}
