//! A ray among the boxes and triangles of a hierarchy: what rare queries share. (The frequent ones have it in
//! [`Search`](super::Search).)

use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::slabs::Intervals;
use crate::geom::{Aabb, Kernel, Ray, Slabs};
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// A ray that is prepared for the tests of a hierarchy.
#[derive(Clone, Debug)]
pub(super) struct Cast<'a, K: Kernel, B: Slabs<Vector = K::Vector>> {
    pub(super) bvh: &'a Bvh<K::Shape>,
    pub(super) kernel: K,
    pub(super) slabs: B,
    /// Where boxes begin to be too far.
    pub(super) end: Real<K>,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> Cast<'a, K, B> {
    pub(super) fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>) -> Self {
        let region = bvh.region();
        Self { bvh, kernel: K::new(ray, region), slabs: B::new(ray, region), end: ray.tmax() }
    }

    /// The children that the ray meets, the nearer one first.
    #[inline]
    pub(super) fn inner(&self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let Intervals { hit: [left, right], near, .. } = self.slabs.pair(planes, self.end);
        Descent::new(left, right, near[1] < near[0])
    }

    /// Whether the ray meets a box.
    pub(super) fn touches(&self, aabb: &Aabb) -> bool {
        self.slabs.one(aabb, self.end).is_some()
    }

    pub(super) fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}
