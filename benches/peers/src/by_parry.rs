//! `parry3d`: its hierarchy by locally-ordered clustering, which it recommends for many rays, with its own triangle
//! test.

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::{Ray as ParryRay, RayCast};
use parry3d::shape::Triangle;

use crate::{Hit, Ray, Tracer, each};

pub(crate) struct Hierarchy {
    bvh: Bvh,
    triangles: Vec<Triangle>,
}

impl Hierarchy {
    pub(crate) fn new(corners: &[[[f32; 3]; 3]]) -> Self {
        let triangle = |corners: &[[f32; 3]; 3]| {
            let [a, b, c] = corners.map(Vector::from_array);
            Triangle::new(a, b, c)
        };
        let triangles: Vec<_> = corners.iter().map(triangle).collect();
        let boxes: Vec<Aabb> = triangles.iter().map(Triangle::local_aabb).collect();
        Self { bvh: Bvh::from_leaves(BvhBuildStrategy::Ploc, &boxes), triangles }
    }

    /// The distance of a triangle, if it is within the ray's interval and not beyond the best hit.
    #[inline]
    fn distance(&self, ray: &Ray, prepared: &ParryRay, i: u32, best: f32) -> Option<f32> {
        self.triangles[i as usize].cast_local_ray(prepared, best, false).filter(|&t| ray.tmin <= t)
    }
}

impl Tracer for Hierarchy {
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        each(rays, hits, |ray| {
            let prepared = prepared(ray);
            self.bvh.cast_ray(&prepared, ray.tmax, |i, best| self.distance(ray, &prepared, i, best))
        });
    }

    fn any(&self, rays: &[Ray], hits: &mut [bool]) {
        each(rays, hits, |ray| {
            let prepared = prepared(ray);
            // The crate has no any-hit query. A hit at minus infinity prevents further visits.
            let nearest = |i, best| self.distance(ray, &prepared, i, best).map(|_| f32::NEG_INFINITY);
            self.bvh.cast_ray(&prepared, ray.tmax, nearest).is_some()
        });
    }
}

#[inline]
fn prepared(ray: &Ray) -> ParryRay {
    ParryRay::new(Vector::from_array(ray.origin), Vector::from_array(ray.direction))
}
