//! What C calls for scenes in single precision: double.rs with other names, which test.sh makes.

use std::ffi::c_char;
use std::ptr;

use glam::Vec3;

use crate::border::answer;
use crate::error::Error;
use crate::memory::{In, Out, exclusive, path, shared, values};
use crate::scene::{Scene, check_count};
use crate::types::{Hit, Near, Options, Ray};

/// Builds a scene in single precision. Vertices and faces are copied. Strides are in bytes; they and the addresses of
/// both arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null after
/// an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_new_f(
    vertices: *const f32,
    vertex_stride: usize,
    vertex_count: usize,
    faces: *const u32,
    face_stride: usize,
    face_count: usize,
    options: *const Options,
    scene: *mut *mut Scene<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (mut made, vertices, faces, options) = unsafe {
            let mut made = Out::one("scene", scene)?;
            made.set(0, ptr::null_mut());
            check_count(vertex_count, "vertex_count")?;
            check_count(face_count, "face_count")?;
            let vertices = In::new("vertices", vertices.cast(), vertex_stride, vertex_count)?;
            let faces = In::new("faces", faces.cast(), face_stride, face_count)?;
            let is_default = options.is_null();
            let options = if is_default { Options::default() } else { *shared(options, "options")? };
            (made, vertices, faces, options)
        };
        made.set(0, Box::into_raw(Box::new(Scene::new(&vertices, &faces, options)?)));
        Ok(())
    })
}

/// Destroys a scene, which no thread may use any more. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_free_f(scene: *mut Scene<Vec3>) -> Error {
    answer(|| {
        if !scene.is_null() {
            // SAFETY: the header requires a scene that this library made, and that is used no more.
            drop(unsafe { Box::from_raw(ptr::from_mut(exclusive(scene, "scene")?)) });
        }
        Ok(())
    })
}

/// Moves the vertices, as many as the scene has; the faces stay. Much faster than a new scene, but queries are slower
/// the more the vertices have moved relative to each other. No other thread may use the scene meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_refit_f(
    scene: *mut Scene<Vec3>,
    vertices: *const f32,
    vertex_stride: usize,
    vertex_count: usize,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, vertices) = unsafe {
            let scene = exclusive(scene, "scene")?;
            check_count(vertex_count, "vertex_count")?;
            (scene, In::new("vertices", vertices.cast(), vertex_stride, vertex_count)?)
        };
        scene.refit(&vertices)
    })
}

/// Writes the numbers of vertices and of faces. Each pointer but the first may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_counts_f(
    scene: *const Scene<Vec3>,
    vertex_count: *mut usize,
    face_count: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what this function does.
        let mesh = unsafe { shared(scene, "scene") }?.mesh();
        let counts = [mesh.vertices().len(), mesh.triangles().len()];
        for (pointer, name, count) in [(vertex_count, "vertex_count", counts[0]), (face_count, "face_count", counts[1])]
        {
            if !pointer.is_null() {
                // SAFETY: likewise.
                unsafe { Out::one(name, pointer) }?.set(0, count);
            }
        }
        Ok(())
    })
}

/// Writes the least and the greatest coordinates of the corners of faces, three numbers each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_bounds_f(
    scene: *const Scene<Vec3>,
    lower: *mut f32,
    upper: *mut f32,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, mut lower, mut upper) =
            unsafe { (shared(scene, "scene")?, values("lower", lower, 3)?, values("upper", upper, 3)?) };
        let [least, greatest] = scene.bounds();
        lower.fill(&least);
        upper.fill(&greatest);
        Ok(())
    })
}

/// Writes a scene to a file, whole or not at all. The path is UTF-8. Files are the same on all machines, and those of
/// the Python package.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_save_f(scene: *const Scene<Vec3>, file: *const c_char) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe { shared(scene, "scene")?.save(path(file, "file")?) })
}

/// Reads a scene from a file. Everything in it is checked. `threads` is as in `stackless_options`. `*scene` is null
/// after an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_load_f(
    file: *const c_char,
    threads: u32,
    scene: *mut *mut Scene<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (mut made, file) = unsafe {
            let mut made = Out::one("scene", scene)?;
            made.set(0, ptr::null_mut());
            (made, path(file, "file")?)
        };
        made.set(0, Box::into_raw(Box::new(Scene::load(file, threads)?)));
        Ok(())
    })
}

/// Writes the bytes of a scene, as many as there is room for, and to `size` how many it has. To learn that, call it
/// with a capacity of 0; `bytes` may then be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_to_bytes_f(
    scene: *const Scene<Vec3>,
    bytes: *mut u8,
    capacity: usize,
    size: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, mut room, mut size) =
            unsafe { (shared(scene, "scene")?, values("bytes", bytes, capacity)?, Out::one("size", size)?) };
        size.set(0, room.fill(&scene.to_bytes()?));
        Ok(())
    })
}

/// Reads a scene from bytes, as `stackless_scene_load_f`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_from_bytes_f(
    bytes: *const u8,
    size: usize,
    threads: u32,
    scene: *mut *mut Scene<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (mut made, bytes) = unsafe {
            let mut made = Out::one("scene", scene)?;
            made.set(0, ptr::null_mut());
            (made, In::new("bytes", bytes, 1, size)?)
        };
        made.set(0, Box::into_raw(Box::new(Scene::from_bytes(&bytes.to_vec()?, threads)?)));
        Ok(())
    })
}

/// Finds the closest hit of a ray: the least exact distance, and of equal ones the least index of a face.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_closest1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
    hit: *mut Hit<f32>,
) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, ray, mut hit) = unsafe { (shared(scene, "scene")?, In::one("ray", ray)?, Out::one("hit", hit)?) };
        hit.set(0, scene.closest1(&ray)?);
        Ok(())
    })
}

/// Finds out whether a ray hits anything.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_any1_f(scene: *const Scene<Vec3>, ray: *const Ray<f32>, is_hit: *mut bool) -> Error {
    answer(|| {
        // SAFETY: the header requires what these functions do.
        let (scene, ray, mut is_hit) =
            unsafe { (shared(scene, "scene")?, In::one("ray", ray)?, Out::one("is_hit", is_hit)?) };
        is_hit.set(0, scene.any1(&ray)?);
        Ok(())
    })
}

/// Finds all hits of a ray, each face once, in the order of exact distances and then of indices. Writes the first ones,
/// as many as there is room for, and to `count` how many there are. With a capacity of 0, `hits` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_all1_f(
    scene: *const Scene<Vec3>,
    ray: *const Ray<f32>,
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
        count.set(0, hits.fill(&scene.all1(&ray)?));
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

/// Finds the closest hit of each ray.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_closest_n_f(
    scene: *const Scene<Vec3>,
    rays: *const Ray<f32>,
    ray_stride: usize,
    count: usize,
    hits: *mut Hit<f32>,
    hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        shared(scene, "scene")?.closest_n(&rays, Out::new("hits", hits, hit_stride, count)?, flags)
    })
}

/// Finds out for each ray whether it hits anything.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_any_n_f(
    scene: *const Scene<Vec3>,
    rays: *const Ray<f32>,
    ray_stride: usize,
    count: usize,
    is_hit: *mut bool,
    is_hit_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let rays = In::new("rays", rays, ray_stride, count)?;
        shared(scene, "scene")?.any_n(&rays, Out::new("is_hit", is_hit, is_hit_stride, count)?, flags)
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

/// Says of each point, three numbers, whether it is inside, outside or on a face: `STACKLESS_INSIDE`,
/// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
/// looks at all edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_locate_n_f(
    scene: *const Scene<Vec3>,
    points: *const f32,
    point_stride: usize,
    count: usize,
    rule: u32,
    locations: *mut u8,
    location_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let locations = Out::new("locations", locations, location_stride, count)?;
        shared(scene, "scene")?.locate_n(&points, rule, locations, flags)
    })
}

/// Measures how far each point, three numbers, is from the mesh: the exact distance, rounded once, and negative inside
/// by a rule `STACKLESS_RULE_...`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_signed_distances_n_f(
    scene: *const Scene<Vec3>,
    points: *const f32,
    point_stride: usize,
    count: usize,
    rule: u32,
    distances: *mut f32,
    distance_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let distances = Out::new("distances", distances, distance_stride, count)?;
        shared(scene, "scene")?.signed_distances_n(&points, rule, distances, flags)
    })
}

/// Finds the point of the mesh that is nearest to each point, three numbers, and no farther than the radius, which may
/// be infinite. Of equally near faces it is the one of the least index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_nearest_n_f(
    scene: *const Scene<Vec3>,
    points: *const f32,
    point_stride: usize,
    count: usize,
    radius: f32,
    nears: *mut Near<f32>,
    near_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header requires what these functions do.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let nears = Out::new("nears", nears, near_stride, count)?;
        shared(scene, "scene")?.nearest_n(&points, radius, nears, flags)
    })
}
