//! Queries over some of the hits of instances.

use std::fmt;

use super::walk::{Found, Search, Wanted};
use super::{InstanceHit, InstanceTracer, Object, Stage};
use crate::bvh::LeafTriangle;
use crate::geom::kernel::EnclosedTest;
use crate::geom::{ExactPoint, ExactRay, Triangle, Vector};
use crate::trace::RayQueries;

/// Chooses the hits that count, like [`Filter`](crate::trace::Filter), by the path to their instance as well.
/// [`InstanceTracer::filtered`] applies it. `[FILTER-1]`
///
/// Both functions must be pure. They are called in no particular order, perhaps several times for one triangle, and by
/// several threads in queries on all threads.
pub struct InstanceFilter<'f, R = f32> {
    triangles: Option<TriangleTest<'f>>,
    hits: Option<HitTest<'f, R>>,
}

type TriangleTest<'f> = &'f (dyn Fn(&[u32], u32) -> bool + Sync);

type HitTest<'f, R> = &'f (dyn Fn(&InstanceHit<R>) -> bool + Sync);

impl<'f, R> InstanceFilter<'f, R> {
    /// Accepts all hits.
    pub const ALL: Self = Self { triangles: None, hits: None };

    /// Accepts hits of some triangles only, by path and index. Other triangles are not tested: for masks, and for the
    /// triangle that a ray leaves.
    #[must_use]
    pub const fn triangles(self, accepts: TriangleTest<'f>) -> Self {
        Self { triangles: Some(accepts), ..self }
    }

    /// Accepts some hits only: for transparency, and for the sides of triangles.
    #[must_use]
    pub const fn hits(self, accepts: HitTest<'f, R>) -> Self {
        Self { hits: Some(accepts), ..self }
    }

    pub(super) const fn is_by_triangle(&self) -> bool {
        self.triangles.is_some()
    }

    fn accepts_triangle(&self, path: &[u32], prim: u32) -> bool {
        self.triangles.is_none_or(|accepts| accepts(path, prim))
    }

    fn accepts_hit(&self, hit: &InstanceHit<R>) -> bool {
        self.hits.is_none_or(|accepts| accepts(hit))
    }
}

/// A tracer and an [`InstanceFilter`]: answers queries as if there were no hits but the accepted ones.
#[derive(Clone, Copy, Debug)]
pub struct FilteredInstances<'t, V: Vector> {
    tracer: &'t InstanceTracer<V>,
    filter: InstanceFilter<'t, V::Real>,
}

impl<V: Vector> InstanceTracer<V> {
    /// Returns a view of this tracer that has only the hits that a filter accepts. The closest hit is the first accepted
    /// one, in the order of [`all`](RayQueries::all). Queries without a filter do not become slower. `[FILTER-1]`
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Bvh};
    /// use stackless_bvh::geom::{AffineMap, Mesh, Ray};
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::trace::{Assembly, Instance, InstanceFilter, InstanceTracer, RayQueries};
    /// use stackless_bvh::traverse::Method;
    ///
    /// let mut assembly = Assembly::new();
    /// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
    /// let object = assembly.add_mesh(Bvh::median(&mesh, 1)?);
    /// let place = |z| AffineMap::translation(Vec3::Z * z).map(|affine| Instance { object, affine });
    /// let row = assembly.add_group(vec![place(1.0)?, place(2.0)?, place(3.0)?], &BuildOptions::default())?;
    /// let tracer = InstanceTracer::new(&assembly, row, Method::default())?;
    ///
    /// let (masks, ray_mask) = ([1, 2, 3], 2);
    /// let is_visible = |path: &[u32], _| masks[path[0] as usize] & ray_mask != 0;
    /// let visible = tracer.filtered(InstanceFilter::ALL.triangles(&is_visible));
    /// let ray = Ray::new(Vec3::new(0.25, 0.5, 0.0), Vec3::Z)?;
    /// assert_eq!(visible.closest(&ray).map(|hit| (hit.path, hit.t)), Some((vec![1], 2.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn filtered<'t>(&'t self, filter: InstanceFilter<'t, V::Real>) -> FilteredInstances<'t, V> {
        FilteredInstances { tracer: self, filter }
    }

    /// Returns the object at the end of a path of instances: for the path of a hit, its mesh. `None` if no instance has
    /// this path.
    pub fn object(&self, path: &[u32]) -> Option<Object> {
        path.iter().try_fold(self.root, |object, &index| match self.stage(object)? {
            Stage::Group(group, _) => group.instances.get(index as usize).map(|instance| instance.object),
            Stage::Mesh(..) | Stage::Wide(..) => None,
        })
    }

    /// Returns a hit, with its weights, and its exact point.
    pub(super) fn hit_and_point(
        &self,
        ray: ExactRay<V>,
        found: Found<V>,
    ) -> Option<(InstanceHit<V::Real>, ExactPoint<V>)> {
        let Found { triangle, test, .. } = found;
        let hit = self.hit(&ray, found)?;
        let point = ExactPoint::of(ray, &triangle, self.maps(&hit.path), test.span(&triangle));
        Some((hit, point))
    }
}

impl<V: Vector> FilteredInstances<'_, V> {
    /// Finds the closest accepted hit and its exact point, by [`InstanceTracer::closest_and_point`].
    pub fn closest_and_point(&self, ray: impl Into<ExactRay<V>>) -> Option<(InstanceHit<V::Real>, ExactPoint<V>)> {
        let ray = ray.into();
        let found = self.find(&ray, Wanted::Closest)?;
        self.tracer.hit_and_point(ray, found)
    }

    fn find(&self, ray: &ExactRay<V>, wanted: Wanted) -> Option<Found<V>> {
        let mut search = Search::filtered(ray, wanted, self.filter);
        self.tracer.visit(self.tracer.root, ray.enclosed(), &mut search);
        search.found.pop()
    }
}

impl<V: Vector, R: Sync> RayQueries<R> for FilteredInstances<'_, V>
where
    for<'r> &'r R: Into<ExactRay<V>>,
{
    type Hit = InstanceHit<V::Real>;

    fn closest(&self, ray: &R) -> Option<Self::Hit> {
        let ray = ray.into();
        self.tracer.hit(&ray, self.find(&ray, Wanted::Closest)?)
    }

    fn any(&self, ray: &R) -> bool {
        self.find(&ray.into(), Wanted::AnyHit).is_some()
    }

    fn any_hit(&self, ray: &R) -> Option<Self::Hit> {
        let ray = ray.into();
        self.tracer.hit(&ray, self.find(&ray, Wanted::AnyHit)?)
    }

    fn all(&self, ray: &R) -> Vec<Self::Hit> {
        let mut hits = self.tracer.all(ray);
        hits.retain(|hit| self.filter.accepts_triangle(&hit.path, hit.prim) && self.filter.accepts_hit(hit));
        hits
    }
}

impl<V: Vector> Search<'_, V> {
    /// Returns whether a triangle has no hits: the ray leaves it, or the filter rejects it. Called only for rays
    /// that may exclude some.
    #[inline]
    pub(super) fn excludes(
        &self,
        tracer: &InstanceTracer<V>,
        &LeafTriangle { shape, prim }: &LeafTriangle<Triangle<V>>,
    ) -> bool {
        // The ray meets the triangle that it leaves at 0. Bounds would need all stages to decide this.
        self.ray.leaves(&shape, || tracer.maps(&self.path)) || !self.filter.accepts_triangle(&self.path, prim)
    }

    /// Returns whether the filter accepts a hit that comes before the best one. `[FILTER-1]`
    #[inline]
    pub(super) fn accepts(
        &self,
        tracer: &InstanceTracer<V>,
        t: V::Real,
        held: &LeafTriangle<Triangle<V>>,
        test: &EnclosedTest<V::Real>,
    ) -> bool {
        self.filter.hits.is_none_or(|accepts| {
            let LeafTriangle { shape: triangle, prim } = *held;
            let found = Found { t, path: self.path.clone(), prim, triangle, test: *test };
            tracer.hit(self.ray, found).is_some_and(|hit| accepts(&hit))
        })
    }
}

impl<R> Clone for InstanceFilter<'_, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for InstanceFilter<'_, R> {}

impl<R> fmt::Debug for InstanceFilter<'_, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (triangles, hits) = (self.triangles.is_some(), self.hits.is_some());
        f.debug_struct("InstanceFilter").field("triangles", &triangles).field("hits", &hits).finish()
    }
}
