//! A ray with its tests of boxes and triangles, shared by rare queries. (Frequent queries use
//! [`Search`](super::search::Search).)

use super::leaf_primitives::LeafPrimitives;
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::slabs::Intervals;
use crate::geom::{Aabb, Kernel, Ray, Slabs};
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// A ray that is prepared for the tests of a hierarchy `H`.
#[derive(Clone, Debug)]
pub(super) struct PreparedRay<'a, K: Kernel, B, H> {
    pub(super) bvh: &'a H,
    pub(super) kernel: K,
    pub(super) slabs: B,
    /// The distance from which on boxes are too far.
    pub(super) end: Real<K>,
}

impl<'a, K: Kernel, B, H: LeafPrimitives<K::Shape>> PreparedRay<'a, K, B, H> {
    pub(super) fn with(bvh: &'a H, ray: &Ray<K::Vector>, slabs: B) -> Self {
        Self { bvh, kernel: K::new(ray, bvh.region()), slabs, end: ray.tmax() }
    }
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> PreparedRay<'a, K, B, Bvh<K::Shape>> {
    pub(super) fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>) -> Self {
        Self::with(bvh, ray, B::new(ray, bvh.region()))
    }

    /// Decides on the children that the ray meets, the nearer one first.
    #[inline]
    pub(super) fn inner(&self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let Intervals { hit: [left, right], near, .. } = self.slabs.pair(planes, self.end);
        Descent::new(left, right, near[1] < near[0])
    }

    /// Returns whether the ray meets a box.
    pub(super) fn touches(&self, aabb: &Aabb) -> bool {
        self.slabs.one(aabb, self.end).is_some()
    }

    pub(super) fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}
