//! Instances of scenes in double precision.

use std::ptr;

use glam::DVec3;

use crate::border::answer;
use crate::error::{Error, Fault};
use crate::filters::Filters;
use crate::instances::{Instances, Object, Source};
use crate::memory::{In, Out, exclusive, room, shared, values};
use crate::scene::check_count;
use crate::types::{Filter, InstanceHit, Options, Ray};

/// Places scenes, and other instances, by affine maps. Instance i is `objects[indices[i]]`, placed by `transforms[i]`:
/// three rows of four numbers, the translation last. Maps are exact: no transformed vertex is rounded. They must have an
/// inverse. Strides are in bytes; the stride and the address of the transforms need not be aligned. `options` may be
/// null. `*instances` is null after an error.
///
/// Instances do not need their objects any more: these may be refitted or destroyed. Instances keep the vertices and the
/// masks that their scenes had.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_new_d(
    objects: *const Object<DVec3>,
    object_stride: usize,
    object_count: usize,
    indices: *const u32,
    index_stride: usize,
    transforms: *const f64,
    transform_stride: usize,
    count: usize,
    options: *const Options,
    instances: *mut *mut Instances<DVec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (mut made, sources, indices, transforms, options) = unsafe {
            let mut made = Out::one("instances", instances)?;
            made.set(0, ptr::null_mut());
            check_count(object_count, "object_count")?;
            check_count(count, "count")?;
            let objects = In::new("objects", objects, object_stride, object_count)?;
            let mut sources = room(object_count)?;
            for index in 0..object_count {
                let found = source(objects.get(index)).and_then(Source::check);
                sources.push(found.map_err(|fault| fault.within(objects.element(index)))?);
            }
            let indices = In::new("indices", indices, index_stride, count)?;
            let transforms = In::new("transforms", transforms.cast(), transform_stride, count)?;
            let is_default = options.is_null();
            let options = if is_default { Options::default() } else { *shared(options, "options")? };
            (made, sources, indices, transforms, options)
        };
        made.set(0, Box::into_raw(Box::new(Instances::new(&sources, &indices, &transforms, options)?)));
        Ok(())
    })
}

/// Destroys instances. No thread may use them any more. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_free_d(instances: *mut Instances<DVec3>) -> Error {
    answer(|| {
        if !instances.is_null() {
            // SAFETY: the header requires unused instances of this library.
            drop(unsafe { Box::from_raw(ptr::from_mut(exclusive(instances, "instances")?)) });
        }
        Ok(())
    })
}

/// Writes the least and the greatest coordinates of a box that contains all faces, three numbers each. The box may be
/// larger than necessary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_bounds_d(
    instances: *const Instances<DVec3>,
    lower: *mut f64,
    upper: *mut f64,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, mut lower, mut upper) =
            unsafe { (shared(instances, "instances")?, values("lower", lower, 3)?, values("upper", upper, 3)?) };
        let [least, greatest] = instances.bounds();
        lower.fill(&least);
        upper.fill(&greatest);
        Ok(())
    })
}

/// Finds the closest hit of a ray: the hit with the least exact distance, of equal distances the least path, and of
/// equal paths the least index of a face. With a filter, which may be null, finds the first accepted hit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_closest1_d(
    instances: *const Instances<DVec3>,
    ray: *const Ray<f64>,
    filter: *const Filter<Ray<f64>, InstanceHit<f64>, InstanceHit<f64>>,
    hit: *mut InstanceHit<f64>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions. `filter.skip` may be `hit`: it is read before.
        let (instances, ray, filter, mut hit) = unsafe {
            let filter = Filters::new(filter, 0, 1)?;
            (shared(instances, "instances")?, In::one("ray", ray)?, filter, Out::one("hit", hit)?)
        };
        hit.set(0, instances.closest1(&ray, &filter, 0)?);
        Ok(())
    })
}

/// Finds whether a ray has a hit; with a filter, which may be null, an accepted hit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_any1_d(
    instances: *const Instances<DVec3>,
    ray: *const Ray<f64>,
    filter: *const Filter<Ray<f64>, InstanceHit<f64>, InstanceHit<f64>>,
    is_hit: *mut bool,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, ray, filter, mut is_hit) = unsafe {
            let filter = Filters::new(filter, 0, 1)?;
            (shared(instances, "instances")?, In::one("ray", ray)?, filter, Out::one("is_hit", is_hit)?)
        };
        is_hit.set(0, instances.any1(&ray, &filter, 0)?);
        Ok(())
    })
}

/// Finds all hits of a ray, each face of each instance once, in the order of exact distances, then of paths and
/// indices. The other arguments are those of `stackless_all1_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_all1_d(
    instances: *const Instances<DVec3>,
    ray: *const Ray<f64>,
    filter: *const Filter<Ray<f64>, InstanceHit<f64>, InstanceHit<f64>>,
    hits: *mut InstanceHit<f64>,
    hit_stride: usize,
    capacity: usize,
    count: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (instances, ray, filter, mut hits, mut count) = unsafe {
            let (filter, hits) = (Filters::new(filter, 0, 1)?, Out::new("hits", hits, hit_stride, capacity)?);
            (shared(instances, "instances")?, In::one("ray", ray)?, filter, hits, Out::one("count", count)?)
        };
        count.set(0, hits.fill(&instances.all1(&ray, &filter)?));
        Ok(())
    })
}

/// Finds the closest hit of each ray, by `stackless_instances_closest1_d`. Filters are as in `stackless_closest_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_closest_n_d(
    instances: *const Instances<DVec3>,
    rays: *const Ray<f64>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<Ray<f64>, InstanceHit<f64>, InstanceHit<f64>>,
    filter_stride: usize,
    hits: *mut InstanceHit<f64>,
    hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        let filters = Filters::new(filters, filter_stride, count)?;
        let hits = Out::new("hits", hits, hit_stride, count)?;
        shared(instances, "instances")?.closest_n(&rays, &filters, hits, flags)
    })
}

/// Finds whether each ray has a hit, by `stackless_instances_any1_d`. Filters are as in `stackless_closest_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_instances_any_n_d(
    instances: *const Instances<DVec3>,
    rays: *const Ray<f64>,
    ray_stride: usize,
    count: usize,
    filters: *const Filter<Ray<f64>, InstanceHit<f64>, InstanceHit<f64>>,
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
        shared(instances, "instances")?.any_n(&rays, &filters, is_hit, flags)
    })
}

/// Reads an object.
///
/// # Safety
/// See [`shared`], for both pointers.
unsafe fn source<'a>(Object { scene, instances }: Object<DVec3>) -> Result<Source<'a, DVec3>, Fault> {
    match (scene.is_null(), instances.is_null()) {
        // SAFETY: the caller guarantees the requirements.
        (false, true) => unsafe { shared(scene, "scene") }.map(Source::Scene),
        // SAFETY: see above.
        (true, false) => unsafe { shared(instances, "instances") }.map(Source::Instances),
        (true, true) => Err(Fault::argument("scene: null, expected a scene or instances")),
        (false, false) => Err(Fault::argument("scene: two objects, expected null for one of them")),
    }
}
