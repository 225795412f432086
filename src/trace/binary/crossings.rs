//! The number of crossings over binary hierarchies, in single and in double precision.

use std::borrow::Borrow;

use super::{BinaryTracer, each, in_parallel};
use crate::bvh::Bvh;
use crate::geom::kernel::Parity;
use crate::geom::{EnvironmentError, Ray, Slabs};
use crate::trace::cast::Cast;
use crate::trace::{Crossings, OwnBoxes};
use crate::tree::Node;

impl<T: Borrow<Bvh<K::Shape>>, K: Parity, B: Slabs<Vector = K::Vector>> BinaryTracer<T, K, B> {
    /// How often the ray crosses a closed mesh, as [`Tracer::crossings`](crate::trace::Tracer::crossings) counts. `[PARITY-1]`
    ///
    /// ```
    /// use glam::DVec3;
    /// use stackless_bvh::{bvh::Bvh, geom::Mesh, geom::Ray, geom::kernel::Exact64, geom::slabs::Wide};
    /// use stackless_bvh::{trace::BinaryTracer, traverse::Method};
    ///
    /// // A tetrahedron, and rays through its corners from inside.
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let mesh = Mesh::new(corners.clone(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// let tracer = BinaryTracer::<_, Exact64, Wide>::with_tests(Bvh::build(&mesh)?, Method::default())?;
    /// let inside = DVec3::splat(0.2);
    /// for corner in corners {
    ///     assert_eq!(tracer.crossings(&Ray::new(inside, corner - inside)?), 1);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn crossings(&self, ray: &Ray<K::Vector>) -> u32 {
        self.crossings_in(ray, &mut Vec::new())
    }

    /// [`crossings`](Self::crossings) of each ray, on this thread.
    pub fn crossings_each(&self, rays: &[Ray<K::Vector>]) -> Vec<u32> {
        each(rays, |ray, memory| self.crossings_in(ray, memory))
    }

    /// [`crossings`](Self::crossings) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn crossings_parallel(&self, rays: &[Ray<K::Vector>]) -> Result<Vec<u32>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(rays, |ray, memory| self.crossings_in(ray, memory))
    }

    fn crossings_in(&self, ray: &Ray<K::Vector>, memory: &mut Vec<Node>) -> u32 {
        let query = Crossings::<K, B>::over(Cast::new(self.bvh(), ray));
        let mut search = OwnBoxes::over(query, &self.level.boxes);
        self.level.run_shared(self.bvh().tree(), ray.octant(), memory, &mut search);
        search.query.count()
    }
}

#[cfg(test)]
mod tests;
