//! Counted costs of queries.

use std::borrow::Borrow;

use super::Tracer;
use super::shared::{Counted, LaneRay};
use crate::bvh::WideBvh;
use crate::geom::lanes::{Precision, with_baseline};
use crate::geom::{Ball, Ray, Real as _};
use crate::trace::prepared_ray::PreparedRay;
use crate::trace::{AllHitsQuery, NearestPoint, NextHitQuery, WideCounters};

impl<V: Precision, T: Borrow<WideBvh<8, V>>> Tracer<T, V> {
    /// Counts the cost of the closest hits of these rays.
    ///
    /// ```
    /// use stackless_bvh::{bvh::WideBvh, generate::procedural, trace::Tracer, wide::Method};
    ///
    /// let mesh = procedural::soup(1, 1000);
    /// let (bvh, rays) = (WideBvh::build(&mesh)?, procedural::rays(&mesh, 1, 100));
    /// let count = |method| Tracer::with_method(&bvh, method).map(|tracer| tracer.count_closest(&rays));
    /// let (stack, trail) = (count(Method::Stack).unwrap(), count(Method::Trail).unwrap());
    /// assert!(stack.leaves == trail.leaves && stack.nodes < trail.nodes);
    /// # Ok::<(), stackless_bvh::bvh::WideError>(())
    /// ```
    pub fn count_closest(&self, rays: &[Ray<V>]) -> WideCounters {
        let bvh = self.bvh();
        counted(rays, |ray, counters| {
            with_baseline!(simd => {
                // Starts after a hit that precedes all other hits.
                let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh));
                self.run_shared(&mut Counted(&mut NextHitQuery::over(cast, (V::Real::rounded(f64::NEG_INFINITY), 0)), counters));
            });
        })
    }

    /// Counts the cost of all hits of these rays, and the number of their crossings, which need no other tests.
    pub fn count_all(&self, rays: &[Ray<V>]) -> WideCounters {
        let bvh = self.bvh();
        counted(rays, |ray, counters| {
            with_baseline!(simd => {
                let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh));
                self.run_shared(&mut Counted(&mut AllHitsQuery::over(cast, self.watches), counters));
            });
        })
    }

    /// Counts the cost of the nearest points in these balls.
    pub fn count_nearest(&self, balls: &[Ball<V>]) -> WideCounters {
        counted(balls, |ball, counters| {
            self.run_shared(&mut Counted(&mut NearestPoint::new(self.bvh(), ball), counters));
        })
    }
}

/// Returns the counters of these queries. `count` adds each query.
fn counted<Q>(queries: &[Q], count: impl Fn(&Q, &mut WideCounters)) -> WideCounters {
    let mut counters = WideCounters { rays: queries.len() as u64, ..WideCounters::default() };
    for query in queries {
        count(query, &mut counters);
    }
    counters
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::geom::Mesh;

    /// Two adjacent triangles: the counts are those of the elements that the query examines.
    #[test]
    fn queries_are_counted_by_what_they_meet() {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::X + Vec3::Z, Vec3::Y + Vec3::Z];
        let mesh = Mesh::new(corners, [[0, 1, 2]; 40].into_iter().chain([[3, 4, 5]; 60]).collect()).expect("a mesh");
        let tracer = Tracer::of(&mesh).expect("a tracer");
        let ray = Ray::new(Vec3::new(0.25, 0.25, -1.0), Vec3::Z).expect("a ray");
        let (all, closest) = (tracer.count_all(&[ray, ray]), tracer.count_closest(&[ray]));
        assert_eq!((all.rays, all.triangles), (2, 200), "all of them are asked, of each ray");
        assert!(closest.nodes <= all.nodes / 2 && (1..=40).contains(&closest.triangles), "{closest:?}");
        let near = tracer.count_nearest(&[Ball::around(Vec3::new(0.25, 0.25, 2.0)).expect("a ball")]);
        assert!(near.rays == 1 && (1..=60).contains(&near.triangles), "the others are farther away: {near:?}");
        assert_eq!(tracer.count_all(&[]), WideCounters::default());
    }
}
