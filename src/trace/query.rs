//! The visitors.

use glam::Vec3;

use super::Hit;
use crate::bvh::Bvh;
use crate::geom::kernel::{Exact, Exact64};
use crate::geom::slabs::{Directed, Wide};
use crate::geom::{Aabb, Kernel, Ray, Real as _, Slabs, Vector};
use crate::order::{Descent, Flow, NodeTest, Visitor};
use crate::tree::{Node, Topology};

/// A closest-hit query, exact: visits the nearer child first, the left one of equals.
pub type Closest<'a> = Search<'a, Exact, Directed, false>;

/// An any-hit query, exact, in the order of [`Closest`]. It stops at the first hit that it meets.
pub type Any<'a> = Search<'a, Exact, Directed, true>;

/// A closest-hit query in double precision, exact. `[EXACT-7]`
///
/// ```
/// use glam::DVec3;
/// use stackless_bvh::{bvh::{Bvh, SahOptions}, geom::Ray, scene::Mesh, trace::Closest64};
/// use stackless_bvh::traverse::{Stack, traverse};
///
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + 1e9);
/// let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]])?;
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// let ray = Ray::new(DVec3::splat(1e9 + 0.25) - DVec3::Z, DVec3::Z, 0.0, f64::INFINITY)?;
/// let mut closest = Closest64::new(&bvh, &ray);
/// traverse(Stack::new(&bvh, &mut Vec::new()), &mut closest, &mut ());
/// assert_eq!(closest.hit().map(|hit| (hit.t, hit.u, hit.v)), Some((0.75, 0.25, 0.25)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Closest64<'a> = Search<'a, Exact64, Wide, false>;

/// An any-hit query in double precision, exact.
pub type Any64<'a> = Search<'a, Exact64, Wide, true>;

/// A closest-hit query, exact, that tests each node's own box.
pub type ClosestByNode<'a> = NodeSearch<'a, Exact, Directed, false>;

/// An any-hit query, exact, that tests each node's own box.
pub type AnyByNode<'a> = NodeSearch<'a, Exact, Directed, true>;

type Real<K> = <<K as Kernel>::Vector as Vector>::Real;

/// A ray on its way through a hierarchy, with the triangle test `K` and the box test `B`. With `ANY`, the first hit ends
/// it.
#[derive(Clone, Debug)]
pub struct Search<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> {
    bvh: &'a Bvh<K::Shape>,
    kernel: K,
    slabs: B,
    /// The distance of the best hit, or the ray's end.
    t: Real<K>,
    prim: u32,
    /// Where the best hit's triangle is in the hierarchy.
    place: usize,
}

/// No triangle has this index, and every hit up to the ray's end comes before it.
const NO_PRIM: u32 = u32::MAX;

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> Search<'a, K, B, ANY> {
    /// Prepares a query.
    #[inline]
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>) -> Self {
        let (region, t) = (bvh.region(), ray.tmax());
        Self { bvh, kernel: K::new(ray, region), slabs: B::new(ray, region), t, prim: NO_PRIM, place: 0 }
    }

    /// The hit, after the traversal: the closest, or with `ANY` the first that was met.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let (prim, mut t) = self.found()?;
        let shape = &self.bvh.triangles()[self.place].shape;
        if ANY {
            t = self.kernel.distance(shape, Real::<K>::INFINITY)?;
        }
        let [u, v] = self.kernel.weights(shape);
        Some(Hit { prim, t, u, v })
    }

    /// Triangle and distance of the [`hit`](Self::hit), without the rest. With `ANY` the distance means nothing.
    #[inline]
    pub fn found(&self) -> Option<(u32, Real<K>)> {
        (self.prim != NO_PRIM).then_some((self.prim, self.t))
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> Visitor for Search<'_, K, B, ANY> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let ([left, right], [near_left, near_right]) = self.slabs.pair(planes, self.t);
        Descent::new(left, right, near_right < near_left)
    }

    #[inline(always)]
    fn leaf(&mut self, node: Node) -> Flow {
        let range = self.bvh.leaf_range(node);
        for (place, held) in range.clone().zip(&self.bvh.triangles()[range]) {
            if ANY {
                if self.kernel.blocks(&held.shape) {
                    (self.prim, self.place) = (held.prim, place);
                    return Flow::Stop;
                }
            } else if let Some(t) = self.kernel.distance(&held.shape, self.t) {
                // The order of hits: by distance, then by triangle.
                if t < self.t || t == self.t && held.prim < self.prim {
                    (self.t, self.prim, self.place) = (t, held.prim, place);
                }
            }
        }
        Flow::Continue
    }
}

/// A [`Search`] for the traversals that test a node at its own visit.
#[derive(Clone, Debug)]
pub struct NodeSearch<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> {
    search: Search<'a, K, B, ANY>,
    boxes: &'a [Aabb],
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> NodeSearch<'a, K, B, ANY> {
    /// Prepares a query. `boxes` must be the tree's [`own_boxes`](Bvh::own_boxes).
    #[inline]
    pub fn new(bvh: &'a Bvh<K::Shape>, boxes: &'a [Aabb], ray: &Ray<K::Vector>) -> Self {
        Self { search: Search::new(bvh, ray), boxes }
    }

    /// As [`Search::hit`].
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        self.search.hit()
    }

    /// As [`Search::found`].
    #[inline]
    pub fn found(&self) -> Option<(u32, Real<K>)> {
        self.search.found()
    }
}

/// A search whose tests are chosen when the program runs: as `&mut dyn Query` it is a visitor and a node test itself.
pub trait Query: Visitor + NodeTest {
    /// As [`Search::hit`].
    fn hit(&self) -> Option<Hit>;
}

impl<K: Kernel<Vector = Vec3>, B: Slabs<Vector = Vec3>, const ANY: bool> Query for NodeSearch<'_, K, B, ANY> {
    fn hit(&self) -> Option<Hit> {
        self.search.hit()
    }
}

/// The search itself: both forms of the query in one type, for traversals that are chosen when the program runs.
impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> Visitor for NodeSearch<'_, K, B, ANY> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.search.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.search.leaf(node)
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool> NodeTest for NodeSearch<'_, K, B, ANY> {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        let Search { bvh, slabs, t, .. } = &self.search;
        slabs.one(&self.boxes[bvh.slot(node)], *t).is_some()
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

impl<V: Query> Query for Counted<V> {
    fn hit(&self) -> Option<Hit> {
        self.inside.hit()
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

#[cfg(test)]
mod tests;
