//! The next hit after a given one.

use super::Hit;
use super::cast::Cast;
use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Aabb, Kernel, Ray, Real as _, Slabs};
use crate::order::{Descent, Flow, Pruned, Repeatable, Visitor};
use crate::tree::Node;

/// A ray on its way through a hierarchy that looks for the first hit in the order (`t`, primitive) after a given one.
#[derive(Clone, Debug)]
pub struct Following<'a, K: Kernel, B: Slabs<Vector = K::Vector>> {
    /// It ends at the best hit.
    cast: Cast<'a, K, B>,
    after: (Real<K>, u32),
    /// Triangle of the best hit, and where that is in the hierarchy.
    found: Option<(u32, usize)>,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> Following<'a, K, B> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Self {
        // Boxes that end before the given hit are skipped. Its distance is rounded, and the exact one is beyond the
        // float before. The triangles are tested with the ray itself.
        let start = after.0.next_down();
        let start = if start > ray.tmin() { start } else { ray.tmin() };
        let rest = Ray::within(ray.origin(), ray.direction(), start, ray.tmax()).unwrap_or(*ray);
        let cast = Cast { slabs: B::new(&rest, bvh.region()), ..Cast::new(bvh, ray) };
        Self { cast, after, found: None }
    }

    /// The hit, after the traversal.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let (prim, place) = self.found?;
        let Cast { bvh, kernel, end: t, .. } = self.cast;
        let [u, v] = kernel.weights(&bvh.triangles()[place].shape);
        Some(Hit { prim, t, u, v })
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Visitor for Following<'_, K, B> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        self.cast.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        let Cast { bvh, kernel, end, .. } = &mut self.cast;
        let range = bvh.leaf_range(node);
        for (place, held) in range.clone().zip(&bvh.triangles()[range]) {
            if let Some(t) = kernel.distance(&held.shape, *end) {
                let is_better = self.found.map_or(t <= *end, |(prim, _)| (t, held.prim) < (*end, prim));
                if (t, held.prim) > self.after && is_better {
                    (*end, self.found) = (t, Some((held.prim, place)));
                }
            }
        }
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
