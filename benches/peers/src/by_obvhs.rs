//! `obvhs`: its binary hierarchy and its compressed wide one, with the preset `medium_build`.
//!
//! As its examples advise, triangles have the order of the leaves, so traversal needs no index lookup. They have the
//! crate's format for tracing on CPUs ([`RtTriangle`], with precomputed edges and normal).

use std::time::Duration;

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray as ObvhsRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

use crate::{Hit, Ray, Tracer, each};

pub(crate) struct Binary {
    bvh: Bvh2,
    triangles: Vec<RtTriangle>,
}

pub(crate) struct Wide {
    bvh: CwBvh,
    triangles: Vec<RtTriangle>,
}

impl Binary {
    pub(crate) fn new(corners: &[[[f32; 3]; 3]]) -> Self {
        let triangles = triangles(corners);
        let bvh = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = in_order(&triangles, &bvh.primitive_indices);
        Self { bvh, triangles }
    }
}

impl Wide {
    pub(crate) fn new(corners: &[[[f32; 3]; 3]]) -> Self {
        let triangles = triangles(corners);
        let bvh = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = in_order(&triangles, &bvh.primitive_indices);
        Self { bvh, triangles }
    }
}

/// Both hierarchies have the same methods, but no trait.
macro_rules! tracer {
    ($type:ty) => {
        impl Tracer for $type {
            fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
                each(rays, hits, |ray| {
                    let mut hit = RayHit::none();
                    let is_hit =
                        self.bvh.ray_traverse(prepared(ray), &mut hit, |ray, i| self.triangles[i].intersect(ray));
                    is_hit.then(|| (self.bvh.primitive_indices[hit.primitive_id as usize], hit.t))
                });
            }

            fn any(&self, rays: &[Ray], hits: &mut [bool]) {
                each(rays, hits, |ray| {
                    !self.bvh.ray_traverse_miss(prepared(ray), |ray, i| self.triangles[i].intersect(ray))
                });
            }
        }
    };
}

tracer!(Binary);
tracer!(Wide);

#[inline]
fn prepared(ray: &Ray) -> ObvhsRay {
    ObvhsRay::new(ray.origin.into(), ray.direction.into(), ray.tmin, ray.tmax)
}

fn triangles(corners: &[[[f32; 3]; 3]]) -> Vec<Triangle> {
    let triangle = |corners: &[[f32; 3]; 3]| {
        let [v0, v1, v2] = corners.map(Vec3A::from_array);
        Triangle { v0, v1, v2 }
    };
    corners.iter().map(triangle).collect()
}

fn in_order(triangles: &[Triangle], order: &[u32]) -> Vec<RtTriangle> {
    order.iter().map(|&i| RtTriangle::from(&triangles[i as usize])).collect()
}
