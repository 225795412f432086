//! Closest hit and any hit.

use std::marker::PhantomData;

use super::Hit;
use super::child_order::{ChildOrder, FromLeft, Nearest};
use super::query::{BoxQuery, OwnBoxes};
use crate::bvh::{Bvh, LeafTriangle};
use crate::geom::kernel::{Exact, Exact64, Filter, Real};
use crate::geom::slabs::{Directed, Intervals, Slabs64};
use crate::geom::{self, Aabb, Kernel, Ray, Real as _, Slabs, Vector};
use crate::order::{Descent, Flow, Pruned, Pruning, Repeatable, Visitor};
use crate::tree::{Node, Topology};

/// A closest-hit query, exact: visits the nearer child first, and of equally near children the left one.
pub type Closest<'a> = Search<'a, Exact, Directed, false>;

/// An any-hit query, exact: visits the left child first, which is larger. It stops at the first hit.
pub type Any<'a> = Search<'a, Exact, Directed, true, FromLeft>;

/// A closest-hit query in double precision, exact. `[EXACT-7]`
///
/// ```
/// use stackless_bvh::bvh::{Bvh, SahOptions};
/// use stackless_bvh::geom::{Mesh, Ray};
/// use stackless_bvh::glam::DVec3;
/// use stackless_bvh::internals::trace::Closest64;
/// use stackless_bvh::traverse::{Stack, traverse};
///
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + 1e9);
/// let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]])?;
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// let ray = Ray::new(DVec3::splat(1e9 + 0.25) - DVec3::Z, DVec3::Z)?;
/// let mut closest = Closest64::new(&bvh, &ray);
/// traverse(Stack::new(&bvh, &mut Vec::new()), &mut closest, &mut ());
/// assert_eq!(closest.hit().map(|hit| (hit.t, hit.u, hit.v)), Some((0.75, 0.25, 0.25)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Closest64<'a> = Search<'a, Exact64, Slabs64, false>;

/// An any-hit query in double precision, exact.
pub type Any64<'a> = Search<'a, Exact64, Slabs64, true, FromLeft>;

/// A closest-hit query, exact, that tests each node's own box.
pub type ClosestByNode<'a> = NodeSearch<'a, Exact, Directed, false>;

/// An any-hit query, exact, that tests each node's own box.
pub type AnyByNode<'a> = NodeSearch<'a, Exact, Directed, true, FromLeft>;

/// The state of a ray in a hierarchy, with the triangle test `K`, the box test `B` and the order `O` of children. With
/// `ANY`, the first hit ends it.
#[derive(Clone, Debug)]
pub struct Search<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O = Nearest> {
    bvh: &'a Bvh<K::Shape>,
    ray: Ray<K::Vector>,
    /// Prepared at the first leaf: a ray that meets no leaf does not pay for it.
    filter: Option<K::Filter>,
    /// Prepared at the first triangle that the filter does not reject.
    kernel: Option<K>,
    slabs: B,
    best: Best<Real<K>>,
    order: PhantomData<O>,
}

/// The best hit so far.
#[derive(Clone, Copy, Debug)]
struct Best<R> {
    /// Its distance, or the ray's end.
    t: R,
    prim: u32,
    /// The place of its triangle in the hierarchy.
    place: usize,
}

/// No triangle has this index, and every hit up to the ray's end comes before it.
const NO_PRIM: u32 = u32::MAX;

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Search<'a, K, B, ANY, O> {
    /// Prepares a query.
    #[inline]
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>) -> Self {
        let slabs = B::new(ray, bvh.region());
        Self {
            bvh,
            ray: *ray,
            filter: None,
            kernel: None,
            slabs,
            best: Best { t: ray.tmax(), prim: NO_PRIM, place: usize::MAX },
            order: PhantomData,
        }
    }

    /// Returns the hit, after the traversal: the closest, or with `ANY` the first that was met.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let ((prim, mut t), kernel) = (self.found()?, self.kernel?);
        let shape = &self.bvh.triangles()[self.best.place].shape;
        if ANY {
            t = kernel.distance(shape, Real::<K>::INFINITY)?;
        }
        let [u, v] = kernel.weights(shape);
        Some(Hit { prim, t, u, v })
    }

    /// Returns triangle and distance of the [`hit`](Self::hit), without its weights. With `ANY` the distance is
    /// meaningless.
    #[inline]
    pub fn found(&self) -> Option<(u32, Real<K>)> {
        (self.best.prim != NO_PRIM).then_some((self.best.prim, self.best.t))
    }

    /// Returns the leaf of the [`hit`](Self::hit).
    pub(super) fn hit_leaf(&self) -> Option<Node> {
        self.found().map(|_| self.bvh.leaf_of(self.best.place))
    }

    /// Tests the triangles of a leaf. Calls `watch` for each, up to the triangle that ends the search.
    #[inline(always)]
    pub(super) fn leaf_watched(&mut self, leaf: Node, watch: impl FnMut(&K::Shape)) -> Flow {
        if K::Filter::REJECTS { self.leaf_by_fours(leaf, watch) } else { self.leaf_one_by_one(leaf, watch) }
    }

    /// A separate loop: in the loop over blocks of four, tests without a filter took 3 % longer.
    #[inline(always)]
    fn leaf_one_by_one(&mut self, leaf: Node, mut watch: impl FnMut(&K::Shape)) -> Flow {
        let kernel = *self.kernel.get_or_insert_with(|| K::new(&self.ray, self.bvh.region()));
        let (range, triangles) = (self.bvh.leaf_range(leaf), self.bvh.triangles());
        for (place, held) in range.clone().zip(&triangles[range]) {
            watch(&held.shape);
            if self.best.meet::<K, ANY>(&kernel, place, held, triangles) == Flow::Stop {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }

    #[inline(always)]
    fn leaf_by_fours(&mut self, leaf: Node, mut watch: impl FnMut(&K::Shape)) -> Flow {
        let Self { bvh, ray, filter, kernel, best, .. } = self;
        let (range, region) = (bvh.leaf_range(leaf), bvh.region());
        let filter = filter.get_or_insert_with(|| K::Filter::new(ray, region));
        for (place, held) in range.clone().step_by(4).zip(bvh.triangles()[range].chunks(4)) {
            let last = held.len() - 1;
            // The remaining lanes repeat the last triangle.
            let shape = |lane: usize| &held[lane.min(last)].shape;
            let shapes = [shape(0), shape(1), shape(2), shape(3)];
            let mut left = filter.survivors(shapes, best.t) & ((2 << last) - 1);
            while left != 0 {
                let lane = (left.trailing_zeros() as usize).min(last);
                left &= left - 1;
                let kernel = kernel.get_or_insert_with(|| K::new(ray, region));
                if best.meet::<K, ANY>(kernel, place + lane, &held[lane], bvh.triangles()) == Flow::Stop {
                    shapes[..=lane].iter().for_each(|shape| watch(shape));
                    return Flow::Stop;
                }
            }
            shapes[..=last].iter().for_each(|shape| watch(shape));
        }
        Flow::Continue
    }
}

impl<R: geom::Real> Best<R> {
    /// Tests one triangle.
    #[inline(always)]
    fn meet<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: &K,
        place: usize,
        held: &LeafTriangle<K::Shape>,
        triangles: &[LeafTriangle<K::Shape>],
    ) -> Flow
    where
        K::Vector: Vector<Real = R>,
    {
        if ANY {
            if kernel.blocks(&held.shape) {
                (self.prim, self.place) = (held.prim, place);
                return Flow::Stop;
            }
        } else if let Some(t) = kernel.distance(&held.shape, self.t) {
            // Of a triangle in parts, the part that is met last counts: the box of its leaf may be the one that
            // contains the hit.
            let is_before =
                |best: &LeafTriangle<_>| kernel.order((&held.shape, held.prim), (&best.shape, best.prim)).is_lt();
            let is_first = || self.prim == NO_PRIM || self.prim == held.prim || is_before(&triangles[self.place]);
            if t < self.t || t == self.t && is_first() {
                *self = Self { t, prim: held.prim, place };
            }
        }
        Flow::Continue
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Visitor for Search<'_, K, B, ANY, O> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let Intervals { hit: [left, right], near, .. } = self.slabs.pair(planes, self.best.t);
        Descent::new(left, right, O::prefers_right(near))
    }

    #[inline(always)]
    fn leaf(&mut self, node: Node) -> Flow {
        self.leaf_watched(node, |_| ())
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Pruned for Search<'_, K, B, ANY, O> {
    /// Not over triangles in parts: a hit may lie beyond the leaf's box and behind results in other boxes, and only
    /// [`NodeSearch`] has the box.
    fn allows(&self, pruning: Pruning) -> bool {
        match pruning {
            Pruning::Never => true,
            Pruning::Disjoint => self.is_sorted() && !self.is_in_parts(),
            Pruning::Distance => !ANY,
        }
    }

    /// For every order, the first interval must end before the second begins.
    #[inline(always)]
    fn inner_marked(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let Intervals { hit: [left, right], near, far } = self.slabs.pair(planes, self.best.t);
        let prefers_right = O::prefers_right(near);
        let is_disjoint = if prefers_right { far[1] < near[0] } else { far[0] < near[1] };
        Descent::new(left, right, prefers_right).disjoint_if(is_disjoint)
    }

    #[inline(always)]
    fn found_at(&self, leaf: Node) -> bool {
        self.bvh.leaf_range(leaf).contains(&self.best.place)
    }

    #[inline(always)]
    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        let planes = &self.bvh.node(node.index()).planes;
        let [begins, _] = self.slabs.pair(planes, self.best.t).near[descent.first().other().index()].ranks();
        begins
    }

    #[inline(always)]
    fn end(&self) -> u32 {
        let [_, end] = self.best.t.ranks();
        end
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Repeatable for Search<'_, K, B, ANY, O> {}

/// A [`Search`] for the traversals that test a node at its own visit, and for all other traversals too.
pub type NodeSearch<'a, K, B, const ANY: bool, O = Nearest> = OwnBoxes<'a, Search<'a, K, B, ANY, O>>;

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> NodeSearch<'a, K, B, ANY, O> {
    /// Prepares a query. `boxes` must be the tree's [`own_boxes`](Bvh::own_boxes), or empty if the traversal tests no
    /// node's own box.
    #[inline]
    pub fn new(bvh: &'a Bvh<K::Shape>, boxes: &'a [Aabb], ray: &Ray<K::Vector>) -> Self {
        Self::over(Search::new(bvh, ray), boxes)
    }

    /// Returns [`Search::hit`].
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        self.query.hit()
    }

    /// Returns [`Search::found`].
    #[inline]
    pub fn found(&self) -> Option<(u32, Real<K>)> {
        self.query.found()
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> BoxQuery for Search<'_, K, B, ANY, O> {
    #[inline]
    fn touches(&self, aabb: &Aabb) -> bool {
        self.slabs.one(aabb, self.best.t).is_some()
    }

    #[inline]
    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }

    #[inline]
    fn is_sorted(&self) -> bool {
        !ANY && O::IS_BY_DISTANCE
    }

    #[inline]
    fn is_in_parts(&self) -> bool {
        self.bvh.duplicates() > 0
    }

    /// The end of the ray in the box is at the hit, or before it.
    #[inline]
    fn ends_in(&self, aabb: &Aabb) -> bool {
        let planes = aabb.planes_twice();
        self.slabs.pair(&planes, self.best.t).far[0] >= self.best.t
    }
}

#[cfg(test)]
mod tests;
