//! The visitors.

use super::Hit;
use crate::bvh::Bvh;
use crate::geom::{Aabb, Ray, RaySlabs};
use crate::order::{Descent, Flow, NodeTest, Visitor};
use crate::tree::{Node, Topology};

/// A closest-hit query: visits the nearer child first, the left one of equals.
pub type Closest<'a> = Search<'a, false>;

/// An any-hit query, in the order of [`Closest`]. It stops at the first hit that it meets.
pub type Any<'a> = Search<'a, true>;

/// A closest-hit query that tests each node's own box.
pub type ClosestByNode<'a> = NodeSearch<'a, false>;

/// An any-hit query that tests each node's own box.
pub type AnyByNode<'a> = NodeSearch<'a, true>;

/// A ray on its way through a hierarchy. With `ANY`, the first hit ends it.
#[derive(Clone, Debug)]
pub struct Search<'a, const ANY: bool> {
    bvh: &'a Bvh,
    ray: Ray,
    slabs: RaySlabs,
    best: Hit,
}

/// No triangle has this index, and every hit up to the ray's end comes before it.
const NO_PRIM: u32 = u32::MAX;

impl<'a, const ANY: bool> Search<'a, ANY> {
    /// Prepares a query.
    #[inline]
    pub fn new(bvh: &'a Bvh, ray: &Ray) -> Self {
        let best = Hit { prim: NO_PRIM, t: ray.tmax(), u: 0.0, v: 0.0 };
        Self { bvh, ray: *ray, slabs: RaySlabs::new(ray), best }
    }

    /// The hit, after the traversal: the closest, or with `ANY` the first that was met.
    #[inline]
    pub fn hit(&self) -> Option<Hit> {
        (self.best.prim != NO_PRIM).then_some(self.best)
    }
}

impl<const ANY: bool> Visitor for Search<'_, ANY> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let ([left, right], [near_left, near_right]) = self.slabs.pair(planes, self.best.t);
        Descent::new(left, right, near_right < near_left)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        for leaf in self.bvh.leaf_triangles(node) {
            if let Some(hit) = leaf.triangle.intersect(&self.ray, &self.slabs) {
                let hit = Hit { prim: leaf.prim, t: hit.t, u: hit.u, v: hit.v };
                if hit.is_before(&self.best) {
                    self.best = hit;
                    if ANY {
                        return Flow::Stop;
                    }
                }
            }
        }
        Flow::Continue
    }
}

/// A [`Search`] for the traversals that test a node at its own visit.
#[derive(Clone, Debug)]
pub struct NodeSearch<'a, const ANY: bool> {
    search: Search<'a, ANY>,
    boxes: &'a [Aabb],
}

impl<'a, const ANY: bool> NodeSearch<'a, ANY> {
    /// Prepares a query. `boxes` must be the tree's [`own_boxes`](Bvh::own_boxes).
    #[inline]
    pub fn new(bvh: &'a Bvh, boxes: &'a [Aabb], ray: &Ray) -> Self {
        Self { search: Search::new(bvh, ray), boxes }
    }

    /// The hit, after the traversal: the closest, or with `ANY` the first that was met.
    #[inline]
    pub fn hit(&self) -> Option<Hit> {
        self.search.hit()
    }
}

/// The search itself: both forms of the query in one type, for traversals that are chosen when the program runs.
impl<const ANY: bool> Visitor for NodeSearch<'_, ANY> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.search.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.search.leaf(node)
    }
}

impl<const ANY: bool> NodeTest for NodeSearch<'_, ANY> {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        let Search { bvh, slabs, best, .. } = &self.search;
        slabs.one(&self.boxes[bvh.slot(node)], best.t).is_some()
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        if self.accept(node) { self.search.leaf(node) } else { Flow::Continue }
    }
}

/// A visitor or node test that counts its visits.
#[derive(Clone, Debug)]
pub struct Counted<V> {
    /// What is counted.
    pub inside: V,
    /// Visits of inner nodes.
    pub inner: u64,
    /// Visits of leaves.
    pub leaves: u64,
}

impl<V> Counted<V> {
    /// Starts at 0.
    pub fn new(inside: V) -> Self {
        Self { inside, inner: 0, leaves: 0 }
    }
}

impl<V: Visitor> Visitor for Counted<V> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.inner += 1;
        self.inside.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.leaves += 1;
        self.inside.leaf(node)
    }
}

impl<V: NodeTest> NodeTest for Counted<V> {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        self.inner += 1;
        self.inside.accept(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.leaves += 1;
        self.inside.leaf(node)
    }
}
