//! The queries of tracers of one mesh, in addition to those of all tracers.

use super::ray_queries::in_parallel;
use super::{Hit, Near};
use crate::geom::{Ball, EnvironmentError, Ray, Vector};

/// Queries of a mesh of precision `V`, in the forms of [`RayQueries`](super::RayQueries): for one ray or ball, for a
/// slice on this thread (`_each`), and for a slice on all threads (`_parallel`).
pub trait MeshQueries<V: Vector> {
    /// Finds the first hit after a given one (`t`, primitive), in the order of [`all`](super::RayQueries::all). So a
    /// caller can iterate over hits: no hit is lost or repeated, even if many have the same `t`. If the ray does not
    /// hit the given triangle at a distance that rounds to `t`, hits after `t` itself count. `[EXACT-13]`
    ///
    /// ```
    /// # use stackless_bvh::glam::Vec3;
    /// # use stackless_bvh::{geom::Ray, geom::Mesh, trace::{MeshQueries, RayQueries, Tracer}};
    /// # let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0], [1, 0, 2]])?;
    /// # let tracer = Tracer::of(&mesh)?;
    /// # let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
    /// let mut hits = Vec::new();
    /// let mut hit = tracer.closest(&ray);
    /// while let Some(found) = hit {
    ///     hits.push(found);
    ///     hit = tracer.next(&ray, (found.t, found.prim));
    /// }
    /// assert_eq!(tracer.all(&ray), hits);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn next(&self, ray: &Ray<V>, after: (V::Real, u32)) -> Option<Hit<V::Real>>;

    /// Counts how often the ray crosses a closed mesh, where a crossing at an edge or a corner is one, and touching is
    /// none: an odd number of times from a point inside, an even number from a point outside. `[PARITY-1]`
    ///
    /// ```
    /// use stackless_bvh::glam::DVec3;
    /// use stackless_bvh::{geom::Mesh, geom::Ray, trace::{MeshQueries, Tracer}};
    ///
    /// // A tetrahedron, and rays through its corners from inside.
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let mesh = Mesh::new(corners.clone(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// let tracer = Tracer::of(&mesh)?;
    /// let inside = DVec3::splat(0.2);
    /// for corner in corners {
    ///     assert_eq!(tracer.crossings(&Ray::new(inside, corner - inside)?), 1);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn crossings(&self, ray: &Ray<V>) -> u32;

    /// Counts how often the ray leaves the solid of a closed, oriented mesh, less how often it enters: the winding
    /// number of its origin, if the ray has no end and the origin is not on the mesh. Faces are seen counterclockwise
    /// from outside. `[PARITY-1]`
    ///
    /// ```
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::{generate::stress, geom::Mesh, geom::Ray, trace::{MeshQueries, Tracer}};
    ///
    /// // Two spheres that overlap.
    /// let spheres = [0.0, 0.5].map(|x| stress::icosphere(2, 1.0, Vec3::X * x));
    /// let [one, other] = [spheres[0].clone()?, spheres[1].clone()?];
    /// let corners = one.vertices().len() as u32;
    /// let faces = other.triangles().iter().map(|face| face.map(|corner| corner + corners));
    /// let faces = one.triangles().iter().copied().chain(faces).collect();
    /// let both = Mesh::new([one.vertices(), other.vertices()].concat(), faces)?;
    /// let tracer = Tracer::of(&both)?;
    /// let around = |x| Ray::new(Vec3::X * x, Vec3::Y).map(|ray| tracer.winding(&ray));
    /// assert_eq!([around(0.25)?, around(-0.75)?, around(2.0)?], [2, 1, 0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn winding(&self, ray: &Ray<V>) -> i32;

    /// Counts the [`crossings`](Self::crossings) of a ray, or with `signed` sums their signs, as
    /// [`winding`](Self::winding) does. `None` if the origin is exactly on a triangle with an area; the ray must start
    /// at its origin. `[CLOSED-2]`
    fn crossings_off_surface(&self, ray: &Ray<V>, signed: bool) -> Option<i32>;

    /// Finds the point of the mesh nearest to the center of a ball, if one is in the ball. `[NEAR-1]` The result is
    /// exact for all ray tests of the tracer.
    fn nearest(&self, ball: &Ball<V>) -> Option<Near<V>>;

    /// Finds the `k` triangles nearest to the center of a ball, in order of distance and then index. Returns fewer if
    /// the ball has fewer triangles. `[NEAR-2]`
    ///
    /// ```
    /// use stackless_bvh::glam::DVec3;
    /// use stackless_bvh::{geom::Ball, geom::Mesh, trace::{MeshQueries, Tracer}};
    ///
    /// let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2], [0, 1, 3]])?;
    /// let tracer = Tracer::of(&mesh)?;
    /// let ball = Ball::around(DVec3::new(0.25, 0.5, -1e-10))?;
    /// assert_eq!(tracer.nearest(&ball).map(|near| (near.prim, near.distance)), Some((0, 1e-10)));
    /// assert_eq!(tracer.nearest_k(&ball, 9).len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn nearest_k(&self, ball: &Ball<V>, k: usize) -> Vec<Near<V>>;

    /// Counts the [`crossings`](Self::crossings) of each ray, on this thread.
    fn crossings_each(&self, rays: &[Ray<V>]) -> Vec<u32> {
        rays.iter().map(|ray| self.crossings(ray)).collect()
    }

    /// Sums the signs of the crossings of each ray, as [`winding`](Self::winding), on this thread.
    fn winding_each(&self, rays: &[Ray<V>]) -> Vec<i32> {
        rays.iter().map(|ray| self.winding(ray)).collect()
    }

    /// Finds the [`nearest`](Self::nearest) point of each ball, on this thread.
    fn nearest_each(&self, balls: &[Ball<V>]) -> Vec<Option<Near<V>>> {
        balls.iter().map(|ball| self.nearest(ball)).collect()
    }

    /// Counts the [`crossings`](Self::crossings) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn crossings_parallel(&self, rays: &[Ray<V>]) -> Result<Vec<u32>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.crossings_each(rays))
    }

    /// Sums the signs of the crossings of each ray, as [`winding`](Self::winding), on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn winding_parallel(&self, rays: &[Ray<V>]) -> Result<Vec<i32>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.winding_each(rays))
    }

    /// Finds the [`nearest`](Self::nearest) point of each ball, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn nearest_parallel(&self, balls: &[Ball<V>]) -> Result<Vec<Option<Near<V>>>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(balls, |balls| self.nearest_each(balls))
    }
}

#[cfg(test)]
mod tests;
