//! Triangle tests against rational arithmetic, and what the exact one costs.

use glam::Vec3;

use super::Cost;
use crate::floats_between;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::truth::{meet, round_f32};
use stackless_bvh::geom::{Aabb, Kernel, Region, Triangle};
use stackless_bvh::trace::{BinaryTracer, Counters};

/// The greatest error of a distance, in floats, where a triangle is hit and found.
pub(super) fn ulps<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>(case: &StressCase) -> Option<Cost> {
    let both = answers::<K>(case).filter_map(|(truth, found)| Some(floats_between(truth?, found?)));
    Cost::new(both.max()?.into(), 1)
}

/// Triangles that are hit and not found, of all that are tested.
pub(super) fn false_misses<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>(case: &StressCase) -> Option<Cost> {
    share(answers::<K>(case).map(|(truth, found)| truth.is_some() && found.is_none()))
}

/// Triangles that are found and not hit, of all that are tested.
pub(super) fn false_hits<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>(case: &StressCase) -> Option<Cost> {
    share(answers::<K>(case).map(|(truth, found)| truth.is_none() && found.is_some()))
}

/// Triangles of a ray about which the bounds for the whole scene do not decide.
pub(super) fn fallbacks(case: &StressCase) -> Option<Cost> {
    let counters = count(case)?;
    Cost::new(counters.fallbacks, counters.rays)
}

/// Triangles of a ray that take exact sums.
pub(super) fn sums(case: &StressCase) -> Option<Cost> {
    let counters = count(case)?;
    Cost::new(counters.sums, counters.rays)
}

/// Box tests of a ray in a complete tree, where all rays hit.
pub(super) fn box_tests(case: &StressCase) -> Option<Cost> {
    let bvh = Bvh::median(&case.mesh, 1).ok()?;
    let tracer = BinaryTracer::new(&bvh);
    let all_hit = case.rays.iter().all(|ray| tracer.closest(ray).is_some());
    let counters = tracer.count_closest(&case.rays);
    Cost::new(counters.boxes, counters.rays).filter(|_| all_hit)
}

/// How many of them.
pub(super) fn share(events: impl Iterator<Item = bool>) -> Option<Cost> {
    let (count, of) = events.fold((0, 0), |(count, of), event| (count + u64::from(event), of + 1));
    Cost::new(count, of)
}

/// The exact closest hits through a complete tree.
fn count(case: &StressCase) -> Option<Counters> {
    let bvh = Bvh::median(&case.mesh, 1).ok()?;
    Some(BinaryTracer::new(&bvh).count_closest(&case.rays))
}

/// Where each ray truly meets each triangle, and where the test finds it.
fn answers<K: Kernel<Vector = Vec3, Shape: From<Triangle>>>(
    case: &StressCase,
) -> impl Iterator<Item = (Option<f32>, Option<f32>)> {
    let region = Region::of(&Aabb::of(case.mesh.vertices()));
    let triangles = 0..case.mesh.triangles().len();
    case.rays.iter().flat_map(move |ray| {
        let kernel = K::new(ray, &region);
        triangles.clone().map(move |i| {
            let corners = case.mesh.triangle(i);
            let meeting = meet(corners.map(Vec3::into), ray.origin().into(), ray.direction().into());
            let truth = meeting.within([ray.tmin(), ray.tmax()]).map(|point| round_f32(&point.t));
            (truth, kernel.distance(&Triangle(corners).into(), ray.tmax()))
        })
    })
}
