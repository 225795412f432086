//! The next hit after a given one.

use super::Hit;
use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Aabb, Kernel, Ray, Real as _, Slabs};
use crate::order::{Descent, Flow, Visitor};
use crate::tree::{Node, Topology};

/// A ray on its way through a hierarchy that looks for the first hit in the order (`t`, primitive) after a given one.
#[derive(Clone, Debug)]
pub struct Following<'a, K: Kernel, B: Slabs<Vector = K::Vector>> {
    bvh: &'a Bvh<K::Shape>,
    kernel: K,
    slabs: B,
    after: (Real<K>, u32),
    /// The distance of the best hit, or the ray's end.
    t: Real<K>,
    /// Triangle of the best hit, and where that is in the hierarchy.
    found: Option<(u32, usize)>,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> Following<'a, K, B> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Self {
        // Boxes that end before the given hit are skipped. Its distance is rounded, and the exact one is beyond the float
        // before. The triangles are tested with the ray itself.
        let start = after.0.next_down();
        let start = if start > ray.tmin() { start } else { ray.tmin() };
        let rest = Ray::new(ray.origin(), ray.direction(), start, ray.tmax()).unwrap_or(*ray);
        let (region, t) = (bvh.region(), ray.tmax());
        Self { bvh, kernel: K::new(ray, region), slabs: B::new(&rest, region), after, t, found: None }
    }

    /// The hit, after the traversal.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let (prim, place) = self.found?;
        let [u, v] = self.kernel.weights(&self.bvh.triangles()[place].shape);
        Some(Hit { prim, t: self.t, u, v })
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Visitor for Following<'_, K, B> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let ([left, right], [near_left, near_right]) = self.slabs.pair(planes, self.t);
        Descent::new(left, right, near_right < near_left)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        let range = self.bvh.leaf_range(node);
        for (place, held) in range.clone().zip(&self.bvh.triangles()[range]) {
            if let Some(t) = self.kernel.distance(&held.shape, self.t) {
                let is_better = self.found.map_or(t <= self.t, |(prim, _)| (t, held.prim) < (self.t, prim));
                if (t, held.prim) > self.after && is_better {
                    (self.t, self.found) = (t, Some((held.prim, place)));
                }
            }
        }
        Flow::Continue
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>> BoxQuery for Following<'_, K, B> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.slabs.one(aabb, self.t).is_some()
    }

    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}
