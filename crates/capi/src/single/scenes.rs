//! Scenes in single precision.

use std::ffi::c_char;
use std::ptr;

use glam::Vec3;

use crate::border::answer;
use crate::error::Error;
use crate::memory::{In, Out, exclusive, path, shared, values};
use crate::scene::{Scene, check_count};
use crate::types::Options;

/// Builds a scene in single precision. Vertices and faces are copied. Strides are in bytes; the strides and addresses
/// of these arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null
/// after an error.
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
        // SAFETY: the header states the requirements of these functions.
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

/// Destroys a scene. No thread may use it any more. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_free_f(scene: *mut Scene<Vec3>) -> Error {
    answer(|| {
        if !scene.is_null() {
            // SAFETY: the header requires an unused scene of this library.
            drop(unsafe { Box::from_raw(ptr::from_mut(exclusive(scene, "scene")?)) });
        }
        Ok(())
    })
}

/// Moves the vertices. The faces and the number of vertices stay. Much faster than a new scene, but queries become
/// slower the more the vertices move relative to each other. No other thread may use the scene during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_refit_f(
    scene: *mut Scene<Vec3>,
    vertices: *const f32,
    vertex_stride: usize,
    vertex_count: usize,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, vertices) = unsafe {
            let scene = exclusive(scene, "scene")?;
            check_count(vertex_count, "vertex_count")?;
            (scene, In::new("vertices", vertices.cast(), vertex_stride, vertex_count)?)
        };
        scene.refit(&vertices)
    })
}

/// Sets the mask of each face. Filters of rays are compared with these masks. Masks are not saved. No other thread may
/// use the scene during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_set_masks_f(
    scene: *mut Scene<Vec3>,
    masks: *const u32,
    mask_stride: usize,
    face_count: usize,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        check_count(face_count, "face_count")?;
        exclusive(scene, "scene")?.set_masks(&In::new("masks", masks, mask_stride, face_count)?)
    })
}

/// Writes the numbers of vertices and of faces. Each pointer except the first may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_counts_f(
    scene: *const Scene<Vec3>,
    vertex_count: *mut usize,
    face_count: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of this function.
        let mesh = unsafe { shared(scene, "scene") }?.mesh();
        let counts = [mesh.vertices().len(), mesh.triangles().len()];
        for (pointer, name, count) in [(vertex_count, "vertex_count", counts[0]), (face_count, "face_count", counts[1])]
        {
            if !pointer.is_null() {
                // SAFETY: see above.
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
        // SAFETY: the header states the requirements of these functions.
        let (scene, mut lower, mut upper) =
            unsafe { (shared(scene, "scene")?, values("lower", lower, 3)?, values("upper", upper, 3)?) };
        let [least, greatest] = scene.bounds();
        lower.fill(&least);
        upper.fill(&greatest);
        Ok(())
    })
}

/// Writes a scene to a file, atomically. The path is UTF-8. Files are portable between machines, and compatible with
/// the Python package.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_save_f(scene: *const Scene<Vec3>, file: *const c_char) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe { shared(scene, "scene")?.save(path(file, "file")?) })
}

/// Reads a scene from a file, and checks its content. `threads` is as in `stackless_options`. `*scene` is null after an
/// error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_load_f(
    file: *const c_char,
    threads: u32,
    scene: *mut *mut Scene<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (mut made, file) = unsafe {
            let mut made = Out::one("scene", scene)?;
            made.set(0, ptr::null_mut());
            (made, path(file, "file")?)
        };
        made.set(0, Box::into_raw(Box::new(Scene::load(file, threads)?)));
        Ok(())
    })
}

/// Writes the bytes of a scene, up to the capacity. `size` receives the total number. With a capacity of 0, `bytes` may
/// be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_to_bytes_f(
    scene: *const Scene<Vec3>,
    bytes: *mut u8,
    capacity: usize,
    size: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, mut room, mut size) =
            unsafe { (shared(scene, "scene")?, values("bytes", bytes, capacity)?, Out::one("size", size)?) };
        size.set(0, room.fill(&scene.to_bytes()?));
        Ok(())
    })
}

/// Reads a scene from bytes, like `stackless_scene_load_f`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_scene_from_bytes_f(
    bytes: *const u8,
    size: usize,
    threads: u32,
    scene: *mut *mut Scene<Vec3>,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (mut made, bytes) = unsafe {
            let mut made = Out::one("scene", scene)?;
            made.set(0, ptr::null_mut());
            (made, In::new("bytes", bytes, 1, size)?)
        };
        made.set(0, Box::into_raw(Box::new(Scene::from_bytes(&bytes.to_vec()?, threads)?)));
        Ok(())
    })
}
