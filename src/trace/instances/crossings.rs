//! The crossings of a ray with the triangles of all instances.

use super::InstanceTracer;
use super::walk::{Found, Wanted};
use crate::geom::{EnvironmentError, ExactRay, Vector};
use crate::trace::ray_queries::in_parallel;

impl<V: Vector> InstanceTracer<V> {
    /// Counts how often a ray crosses the exact images of all triangles. At an edge or a corner of a closed mesh it
    /// counts one of the triangles there, and it crosses a surface that it touches an even number of times. `[INST-8]`
    ///
    /// If all placed meshes are closed, a ray without end crosses an odd number of times iff an odd number of instances
    /// contain its origin, unless the origin is on one of them.
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Bvh};
    /// use stackless_bvh::geom::{AffineMap, Mesh, Ray};
    /// use stackless_bvh::glam::DVec3;
    /// use stackless_bvh::trace::{Assembly, Instance, InstanceTracer};
    /// use stackless_bvh::traverse::Method;
    ///
    /// // A tetrahedron and its mirror image, and rays through their corners and common edges.
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let mesh = Mesh::new(corners.clone(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// let mut assembly = Assembly::new();
    /// let object = assembly.add_mesh(Bvh::build(&mesh)?);
    /// let mirror = AffineMap::new([[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])?;
    /// let placed = [AffineMap::IDENTITY, mirror].map(|affine| Instance { object, affine });
    /// let scene = assembly.add_group(placed.to_vec(), &BuildOptions::default())?;
    /// let tracer = InstanceTracer::new(&assembly, scene, Method::default())?;
    /// let inside = DVec3::splat(0.2);
    /// for corner in corners {
    ///     assert_eq!(tracer.crossings(&Ray::new(inside, corner - inside)?) % 2, 1);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn crossings<R>(&self, ray: &R) -> u32
    where
        for<'r> &'r R: Into<ExactRay<V>>,
    {
        let ray = ray.into();
        let mut found = self.search(&ray, Wanted::All).found;
        // A triangle may be in several leaves.
        found.sort_unstable_by(|a, b| (a.prim, &a.path).cmp(&(b.prim, &b.path)));
        found.dedup_by(|a, b| a.prim == b.prim && a.path == b.path);
        found.iter().filter(|found| self.is_crossing(&ray, found)).count() as u32
    }

    /// Counts the [`crossings`](Self::crossings) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    pub fn crossings_parallel<R: Sync>(&self, rays: &[R]) -> Result<Vec<u32>, EnvironmentError>
    where
        for<'r> &'r R: Into<ExactRay<V>>,
    {
        in_parallel(rays, |rays| rays.iter().map(|ray| self.crossings(ray)).collect())
    }

    /// Returns whether a hit is a crossing. Bounds decide for hits in the interior of the triangle, which are.
    fn is_crossing(&self, ray: &ExactRay<V>, Found { path, triangle, test, .. }: &Found<V>) -> bool {
        test.span(triangle).is_some() || ray.crosses(triangle, &self.maps(path))
    }
}
