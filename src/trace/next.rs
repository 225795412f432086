//! The next hit after a given one.

use super::Hit;
use super::cast::Cast;
use super::held::Held;
use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Aabb, Kernel, Ray, Real as _, Slabs, Vector};
use crate::order::{Descent, Flow, Pruned, Repeatable, Visitor};
use crate::tree::Node;

/// A ray on its way through a hierarchy `H` that looks for the first hit in the order (`t`, primitive) after a given
/// one.
#[derive(Clone, Debug)]
pub struct Following<'a, K: Kernel, B, H = Bvh<<K as Kernel>::Shape>> {
    /// It ends at the best hit.
    pub(super) cast: Cast<'a, K, B, H>,
    after: (Real<K>, u32),
    /// Triangle of the best hit, and where that is in the hierarchy.
    found: Option<(u32, usize)>,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> Following<'a, K, B> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Self {
        let slabs = B::new(&rest(ray, after.0), bvh.region());
        Self::over(Cast::with(bvh, ray, slabs), after)
    }
}

/// The part of a ray that boxes are tested with: those that end before the given hit are skipped. The hit's distance is
/// rounded, and the exact one is beyond the float before. Triangles are tested with the ray itself.
pub(super) fn rest<V: Vector>(ray: &Ray<V>, after: V::Real) -> Ray<V> {
    let start = after.next_down();
    let start = if start > ray.tmin() { start } else { ray.tmin() };
    Ray::within(ray.origin(), ray.direction(), start, ray.tmax()).unwrap_or(*ray)
}

impl<'a, K: Kernel, B, H: Held<K::Shape>> Following<'a, K, B, H> {
    /// The boxes' test is for the [`rest`] of the ray.
    pub(super) fn over(cast: Cast<'a, K, B, H>, after: (Real<K>, u32)) -> Self {
        Self { cast, after, found: None }
    }

    /// The hit, after the traversal.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let (prim, place) = self.found?;
        let Cast { bvh, kernel, end: t, .. } = &self.cast;
        let [u, v] = kernel.weights(&bvh.shape(place));
        Some(Hit { prim, t: *t, u, v })
    }

    #[inline]
    pub(super) fn meet(&mut self, leaf: Node) {
        let Self { cast: Cast { bvh, kernel, end, .. }, after, found } = self;
        bvh.for_each(leaf, |place, shape, prim| {
            if let Some(t) = kernel.distance(shape, *end) {
                let is_better = found.map_or(t <= *end, |(best, _)| (t, prim) < (*end, best));
                if (t, prim) > *after && is_better {
                    (*end, *found) = (t, Some((prim, place)));
                }
            }
        });
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Visitor for Following<'_, K, B> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        self.cast.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.meet(node);
        Flow::Continue
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Pruned for Following<'_, K, B> {}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Repeatable for Following<'_, K, B> {}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> BoxQuery for Following<'_, K, B> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.cast.touches(aabb)
    }

    fn slot(&self, node: Node) -> usize {
        self.cast.slot(node)
    }
}
