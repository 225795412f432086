//! Filters: ray queries over some of the hits, chosen by triangle or by hit.

use std::fmt;

use super::leaf_primitives::{LeafFilter, LeafPrimitives};
use super::prepared_ray::PreparedRay;
use super::query::binary_query;
use super::{Hit, RayQueries};
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Kernel, Ray, Slabs, Vector};
use crate::tree::Node;

/// Chooses the hits that count, by triangle and by hit. [`Filterable::filtered`] applies it to a tracer. `[FILTER-1]`
///
/// Both functions must be pure. They are called in no particular order, perhaps several times for one triangle, and by
/// several threads in queries on all threads. To see each hit once and in order, call
/// [`MeshQueries::next`](super::MeshQueries::next).
#[derive(Clone, Copy)]
pub struct Filter<'f, R = f32> {
    triangles: Option<&'f (dyn Fn(u32) -> bool + Sync)>,
    hits: Option<HitTest<'f, R>>,
}

type HitTest<'f, R> = &'f (dyn Fn(&Hit<R>) -> bool + Sync);

impl<'f, R> Filter<'f, R> {
    /// Accepts all hits.
    pub const ALL: Self = Self { triangles: None, hits: None };

    /// Accepts hits of some triangles only, by index. Other triangles are not tested: for masks, and for the triangle that
    /// a ray leaves.
    #[must_use]
    pub const fn triangles(self, accepts: &'f (dyn Fn(u32) -> bool + Sync)) -> Self {
        Self { triangles: Some(accepts), ..self }
    }

    /// Accepts some hits only: for transparency, and for the sides of triangles.
    #[must_use]
    pub const fn hits(self, accepts: HitTest<'f, R>) -> Self {
        Self { hits: Some(accepts), ..self }
    }

    fn accepts_triangle(&self, prim: u32) -> bool {
        self.triangles.is_none_or(|accepts| accepts(prim))
    }

    fn accepts_hit(&self, hit: &Hit<R>) -> bool {
        self.hits.is_none_or(|accepts| accepts(hit))
    }
}

/// A tracer and a [`Filter`]: answers [`RayQueries`] as if there were no hits but the accepted ones.
#[derive(Clone, Copy, Debug)]
pub struct Filtered<'t, T, R = f32> {
    tracer: &'t T,
    filter: Filter<'t, R>,
}

/// Tracers of one mesh, whose hits can be filtered.
pub trait Filterable<V: Vector>: RayQueries<Ray<V>, Hit = Hit<V::Real>> {
    /// Returns a view of this tracer that has only the hits that a filter accepts. The closest hit is the first accepted
    /// one, in the order of [`all`](RayQueries::all). Queries without a filter do not become slower. `[FILTER-1]`
    ///
    /// ```
    /// use stackless_bvh::geom::{Mesh, Ray};
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::trace::{Filter, Filterable, Hit, RayQueries, Tracer};
    ///
    /// // Two equal triangles, and a third one behind them.
    /// let vertices = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::X + Vec3::Z, Vec3::Y + Vec3::Z];
    /// let tracer = Tracer::of(&Mesh::new(vertices, vec![[0, 1, 2], [0, 1, 2], [3, 4, 5]])?)?;
    /// let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
    ///
    /// let (masks, ray_mask) = ([1, 2, 3], 2);
    /// let is_visible = |prim: u32| masks[prim as usize] & ray_mask != 0;
    /// let visible = tracer.filtered(Filter::ALL.triangles(&is_visible));
    /// assert_eq!(visible.closest(&ray).map(|hit| hit.prim), Some(1));
    ///
    /// let is_opaque = |hit: &Hit| hit.prim != 1 || hit.v < 0.5;
    /// let solid = tracer.filtered(Filter::ALL.triangles(&is_visible).hits(&is_opaque));
    /// assert_eq!(solid.closest_each(&[ray])[0].map(|hit| (hit.prim, hit.t)), Some((2, 4.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn filtered<'t>(&'t self, filter: Filter<'t, V::Real>) -> Filtered<'t, Self, V::Real>
    where
        Self: Sized,
    {
        Filtered { tracer: self, filter }
    }

    /// Finds the closest accepted hit, or any.
    fn find(&self, ray: &Ray<V>, filter: Filter<'_, V::Real>, is_any: bool) -> Option<Hit<V::Real>>;
}

impl<V: Vector, T: Filterable<V>> RayQueries<Ray<V>> for Filtered<'_, T, V::Real> {
    type Hit = Hit<V::Real>;

    fn closest(&self, ray: &Ray<V>) -> Option<Self::Hit> {
        self.tracer.find(ray, self.filter, false)
    }

    fn any(&self, ray: &Ray<V>) -> bool {
        self.any_hit(ray).is_some()
    }

    fn any_hit(&self, ray: &Ray<V>) -> Option<Self::Hit> {
        self.tracer.find(ray, self.filter, true)
    }

    fn all(&self, ray: &Ray<V>) -> Vec<Self::Hit> {
        let mut hits = self.tracer.all(ray);
        hits.retain(|hit| self.filter.accepts_triangle(hit.prim) && self.filter.accepts_hit(hit));
        hits
    }
}

/// A ray on its way through a hierarchy `H` that looks for the closest accepted hit, or any.
#[derive(Clone, Debug)]
pub(super) struct FilteredQuery<'a, K: Kernel, B, H> {
    cast: PreparedRay<'a, K, B, H>,
    filter: Filter<'a, Real<K>>,
    is_any: bool,
    /// The best accepted hit so far, and where its triangle is in the hierarchy.
    best: Option<(Hit<Real<K>>, usize)>,
}

impl<'a, K: Kernel, B, H: LeafPrimitives<K::Shape>> FilteredQuery<'a, K, B, H> {
    pub(super) const fn over(cast: PreparedRay<'a, K, B, H>, filter: Filter<'a, Real<K>>, is_any: bool) -> Self {
        Self { cast, filter, is_any, best: None }
    }

    /// The hit, after the traversal.
    pub(super) fn hit(&self) -> Option<Hit<Real<K>>> {
        self.best.map(|(hit, _)| hit)
    }

    /// Returns the ray, unless nothing is left to find.
    pub(super) fn pending(&self) -> Option<&PreparedRay<'a, K, B, H>> {
        (!self.is_done()).then_some(&self.cast)
    }

    fn is_done(&self) -> bool {
        self.is_any && self.best.is_some()
    }

    /// The filter comes last, so it is called only for the hits that come before the best one.
    #[inline]
    pub(super) fn meet(&mut self, leaf: Node)
    where
        B: LeafFilter<H, K::Shape, Real<K>>,
    {
        let Self { cast: PreparedRay { bvh, kernel, slabs, end }, filter, is_any, best } = self;
        slabs.for_each_left(bvh, leaf, *end, |place, shape, prim| {
            if *is_any && best.is_some() || !filter.accepts_triangle(prim) {
                return;
            }
            let Some(t) = kernel.distance(shape, *end) else { return };
            let is_first = |(best, at): (Hit<Real<K>>, usize)| {
                t < best.t || t == best.t && kernel.order((shape, prim), (&bvh.shape(at), best.prim)).is_lt()
            };
            if !best.is_none_or(is_first) {
                return;
            }
            let [u, v] = kernel.weights(shape);
            let hit = Hit { prim, t, u, v };
            if filter.accepts_hit(&hit) {
                (*end, *best) = (t, Some((hit, place)));
            }
        });
    }
}

binary_query!([K: Kernel, B: Slabs<Vector = K::Vector>] FilteredQuery<'_, K, B, Bvh<K::Shape>>, cast.inner, until is_done);

impl<R> fmt::Debug for Filter<'_, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { triangles, hits } = self;
        let fields = (triangles.is_some(), hits.is_some());
        f.debug_struct("Filter").field("triangles", &fields.0).field("hits", &fields.1).finish()
    }
}

#[cfg(test)]
mod tests;
