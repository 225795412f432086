//! Points in double precision.

use glam::DVec3;

use crate::border::answer;
use crate::error::Error;
use crate::memory::{In, Out, shared};
use crate::scene::Scene;
use crate::types::Near;

/// Classifies each point, given by three numbers, as inside, outside or on a face: `STACKLESS_INSIDE`,
/// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
/// examines all edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_locate_n_d(
    scene: *const Scene<DVec3>,
    points: *const f64,
    point_stride: usize,
    count: usize,
    rule: u32,
    locations: *mut u8,
    location_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let locations = Out::new("locations", locations, location_stride, count)?;
        shared(scene, "scene")?.locate_n(&points, rule, locations, flags)
    })
}

/// Computes the distance of each point, given by three numbers, from the mesh. It is exact, then rounded once, and
/// negative inside by a rule `STACKLESS_RULE_...`. It is also 0 on faces without area, which are no surface to
/// `stackless_locate_n_d`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_signed_distances_n_d(
    scene: *const Scene<DVec3>,
    points: *const f64,
    point_stride: usize,
    count: usize,
    rule: u32,
    distances: *mut f64,
    distance_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let distances = Out::new("distances", distances, distance_stride, count)?;
        shared(scene, "scene")?.signed_distances_n(&points, rule, distances, flags)
    })
}

/// Finds the point of the mesh that is nearest to each point, given by three numbers, within the radius, which may be
/// infinite. Of equally near faces it returns the face with the least index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_nearest_n_d(
    scene: *const Scene<DVec3>,
    points: *const f64,
    point_stride: usize,
    count: usize,
    radius: f64,
    nears: *mut Near<f64>,
    near_stride: usize,
    flags: u32,
) -> Error {
    // SAFETY: the header states the requirements of these functions.
    answer(|| unsafe {
        let points = In::new("points", points.cast(), point_stride, count)?;
        let nears = Out::new("nears", nears, near_stride, count)?;
        shared(scene, "scene")?.nearest_n(&points, radius, nears, flags)
    })
}

/// Finds the faces that are nearest to a point, given by three numbers, within the radius, which may be infinite.
/// Writes the first `capacity` faces in the order of distances, then of indices. `count` receives the number of written
/// faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stackless_nearest_k1_d(
    scene: *const Scene<DVec3>,
    point: *const f64,
    radius: f64,
    nears: *mut Near<f64>,
    near_stride: usize,
    capacity: usize,
    count: *mut usize,
) -> Error {
    answer(|| {
        // SAFETY: the header states the requirements of these functions.
        let (scene, point, mut nears, mut count) = unsafe {
            let nears = Out::new("nears", nears, near_stride, capacity)?;
            (shared(scene, "scene")?, In::one("point", point.cast())?, nears, Out::one("count", count)?)
        };
        count.set(0, nears.fill(&scene.nearest_k1(&point, radius, capacity)?));
        Ok(())
    })
}
