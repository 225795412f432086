//! Exact points, and rays that start at them, in single precision.

use std::ptr;

use glam::Vec3;

use crate::border::answer;
use crate::error::{Error, Fault};
use crate::exact::{Point, Way};
use crate::memory::{In, Out, exclusive, shared};
use crate::scene::Scene;
use crate::types::{ExactRay, Hit, Ray};

/// Creates an exact point from three numbers. `*point` is null after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_point_new_f(coordinates: *const f32, point: *mut *mut Point<Vec3>) -> Error {
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
pub unsafe extern "C" fn stackless_point_of_hit_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    face: u32,
    point: *mut *mut Point<Vec3>,
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
pub unsafe extern "C" fn stackless_point_free_f(point: *mut Point<Vec3>) -> Error {
    answer(|| {
        if !point.is_null() {
            // SAFETY: the header requires an unused point of this library.
            drop(unsafe { Box::from_raw(ptr::from_mut(exclusive(point, "point")?)) });
        }
        Ok(())
    })
}

/// Finds the closest hit of a ray that starts at an exact point, and creates the exact point of the hit, at which the
/// next ray may start. `point` may be null. `*point` is null after a miss and after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_closest1_f(
    scene: *const Scene<Vec3>,
    ray: *const ExactRay<f32, Vec3>,
    hit: *mut Hit<f32>,
    point: *mut *mut Point<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, way, mut hit, mut made) = unsafe {
            let mut made = if point.is_null() { None } else { Some(Out::one("point", point)?) };
            if let Some(made) = &mut made {
                made.set(0, ptr::null_mut());
            }
            (shared(scene, "scene")?, way(ray)?, Out::one("hit", hit)?, made)
        };
        let (found, met) = scene.exact_closest1(&way, made.is_some())?;
        hit.set(0, found);
        if let (Some(made), Some(met)) = (&mut made, met) {
            made.set(0, boxed(met));
        }
        Ok(())
    })
}

/// Finds whether a ray that starts at an exact point hits any face.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_exact_any1_f(
    scene: *const Scene<Vec3>,
    ray: *const ExactRay<f32, Vec3>,
    is_hit: *mut bool,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, way, mut is_hit) = unsafe { (shared(scene, "scene")?, way(ray)?, Out::one("is_hit", is_hit)?) };
        is_hit.set(0, scene.exact_any1(&way)?);
        Ok(())
    })
}

/// Reads an exact ray.
///
/// # Safety
/// See [`shared`], for the ray and for its points.
unsafe fn way<'a>(ray: *const ExactRay<f32, Vec3>) -> Result<Way<'a, Vec3>, Fault> {
    // SAFETY: the caller guarantees the requirements.
    unsafe {
        let ExactRay { origin, target, direction, tmax, is_closed } = *shared(ray, "ray")?;
        let target = if target.is_null() { None } else { Some(shared(target, "ray.target")?) };
        Ok(Way { origin: shared(origin, "ray.origin")?, target, direction, tmax, is_closed })
    }
}

fn boxed(point: Point<Vec3>) -> *mut Point<Vec3> {
    Box::into_raw(Box::new(point))
}
