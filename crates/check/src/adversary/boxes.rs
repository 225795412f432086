//! Box tests against rational arithmetic, for all boxes of a complete tree.

use glam::Vec3;

use super::Cost;
use super::kernels::share;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::{Slabs, truth};

/// Boxes that are entered and not touched, of all boxes.
pub(super) fn in_vain<B: Slabs<Vector = Vec3>>(case: &StressCase) -> Option<Cost> {
    share(answers::<B>(case)?.into_iter().map(|(touched, entered)| !touched && entered))
}

/// Boxes that are touched and skipped, of all boxes.
pub(super) fn skipped<B: Slabs<Vector = Vec3>>(case: &StressCase) -> Option<Cost> {
    share(answers::<B>(case)?.into_iter().map(|(touched, entered)| touched && !entered))
}

/// Of each ray and box: whether it is truly touched, and whether it is entered.
fn answers<B: Slabs<Vector = Vec3>>(case: &StressCase) -> Option<Vec<(bool, bool)>> {
    let bvh = Bvh::median(&case.mesh, 1).ok()?;
    let boxes = bvh.own_boxes();
    let of_ray = |ray| {
        let slabs = B::new(ray, bvh.region());
        boxes.iter().map(move |aabb| {
            let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
            let touched = truth::touches(o, d, [ray.tmin(), ray.tmax()], lo, hi);
            (touched, slabs.one(aabb, ray.tmax()).is_some())
        })
    };
    Some(case.rays.iter().flat_map(of_ray).collect())
}
