//! Ray queries over binary hierarchies.

use std::borrow::Borrow;
use std::cell::Cell;
use std::fmt;
use std::hint::black_box;
use std::marker::PhantomData;

use super::filter::{Filterable, FilteredQuery};
use super::level::Level;
use super::memory::lend;
use super::prepared_ray::PreparedRay;
use super::{
    AllHitsQuery, BoxQuery, Crossings, Filter, FromLeft, Hit, MeshQueries, Near, NearestPoint, NearestPoints,
    NextHitQuery, NodeSearch, OwnBoxes, Part, Plan, QueryKind, RayQueries,
};
use crate::bvh::{BuildError, Bvh};
use crate::geom::kernel::{Exact, Parity, Real};
use crate::geom::slabs::Directed;
use crate::geom::{Ball, Kernel, Mesh, Ray, Slabs, Triangle, Vector};
use crate::traverse::{Method, Unsupported, WordName};
use crate::tree::Node;

/// Answers queries over a binary hierarchy with one of the traversals, the triangle test `K` and the box test `B`.
/// [`Tracer`](super::Tracer) is faster, if none of these choices matters.
///
/// The tracer owns, borrows or shares the hierarchy: `T` is `Bvh`, `&Bvh`, `Arc<Bvh>`, or another type that always
/// borrows as the same `Bvh`. A tracer can be stored, sent and shared by threads as `T` can.
///
/// [`RayQueries`] and [`MeshQueries`] have the queries. Construction refuses a traversal that does not fit the
/// hierarchy; tracing is infallible. Exact tests, the default, give identical answers for all hierarchies and
/// traversals. `[DET-1]`
///
/// ```
/// use std::sync::Arc;
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::{bvh::Bvh, geom::Mesh, geom::Ray, traverse::Method};
/// use stackless_bvh::trace::{BinaryTracer, RayQueries};
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
/// let hit = BinaryTracer::of(&mesh)?.closest(&ray).ok_or("a miss")?;
/// assert_eq!((hit.prim, hit.t, hit.u, hit.v), (0, 3.0, 0.25, 0.5));
///
/// let bvh = Bvh::build(&mesh)?;
/// let stack = BinaryTracer::with_method(&bvh, Method::Stack)?;
/// assert_eq!(stack.closest_each(&[ray, ray]), [Some(hit); 2]);
///
/// let shared: BinaryTracer<Arc<Bvh>> = BinaryTracer::new(Arc::new(bvh));
/// assert!(std::thread::spawn(move || shared.any(&ray)).join().is_ok_and(|any| any));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct BinaryTracer<T = Bvh, K = Exact, B = Directed> {
    bvh: T,
    pub(super) level: Level,
    /// Whether all hits are computed with their weights, to measure the cost.
    pub(super) with_weights: bool,
    watches: bool,
    tests: PhantomData<fn() -> (K, B)>,
}

impl BinaryTracer {
    /// Builds a tracer that owns a hierarchy over a mesh, by [`Bvh::build`].
    ///
    /// # Errors
    /// [`BuildError`], for more than 2^31 triangles.
    pub fn of(mesh: &Mesh) -> Result<Self, BuildError> {
        Bvh::build(mesh).map(Self::new)
    }
}

impl<T: Borrow<Bvh>> BinaryTracer<T> {
    /// Creates a tracer with [`Method::default`], which runs on any hierarchy, and the narrowest words that the
    /// hierarchy allows.
    ///
    /// It follows the links of a new hierarchy. If the records have [other links](Bvh::with_links), a separate table
    /// has the parents and siblings, and queries share a slower copy of the traversals. This holds for all traversals.
    pub fn new(bvh: T) -> Self {
        let plan = Plan::new(bvh.borrow(), Method::default(), QueryKind::Hit);
        let level = Level::unchecked(bvh.borrow(), Method::default(), &plan);
        Self::over(bvh, level, &plan)
    }

    /// Creates a tracer with the given traversal, and the narrowest tables and words that the hierarchy allows.
    ///
    /// # Errors
    /// [`Unsupported`] if the traversal does not support this hierarchy: `complete` on a hierarchy that is not
    /// complete, `laine-*` on one deeper than 126.
    pub fn with_method(bvh: T, method: Method) -> Result<Self, Unsupported> {
        Self::with_tests(bvh, method)
    }

    /// Creates a tracer with a traversal and its plan. A plan for another hierarchy or traversal may cost time or
    /// memory; it does not change an answer.
    ///
    /// # Errors
    /// As [`with_method`](BinaryTracer::with_method).
    pub fn planned(bvh: T, method: Method, plan: &Plan) -> Result<Self, Unsupported> {
        let level = Level::new(bvh.borrow(), method, plan)?;
        Ok(Self::over(bvh, level, plan))
    }
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> BinaryTracer<T, K, B> {
    /// Creates a tracer as [`with_method`](BinaryTracer::with_method), for inexact tests, or for shapes other than
    /// triangles: `BinaryTracer::<_, K, B>::with_tests(...)`.
    ///
    /// # Errors
    /// As [`with_method`](BinaryTracer::with_method).
    pub fn with_tests(bvh: T, method: Method) -> Result<Self, Unsupported> {
        let plan = Plan::new(bvh.borrow(), method, QueryKind::Hit);
        let level = Level::new(bvh.borrow(), method, &plan)?;
        Ok(Self::over(bvh, level, &plan))
    }

    fn over(bvh: T, level: Level, plan: &Plan) -> Self {
        // A triangle is reported once, for every plan.
        let watches = plan.restores(Part::Repeats) || bvh.borrow().duplicates() > 0;
        Self { bvh, level, with_weights: plan.restores(Part::Weights), watches, tests: PhantomData }
    }

    /// Returns the hierarchy.
    pub fn bvh(&self) -> &Bvh<K::Shape> {
        self.bvh.borrow()
    }

    /// Returns the traversal.
    pub fn method(&self) -> Method {
        self.level.method
    }

    /// Returns the word of its keys.
    pub fn word(&self) -> WordName {
        self.level.word
    }

    /// Returns the memory of its tables in bytes, without the hierarchy.
    pub fn bytes(&self) -> usize {
        self.level.bytes()
    }

    /// Returns triangle and distance of the [`closest`](RayQueries::closest) hit, without its weights.
    pub fn closest_distance(&self, ray: &Ray<K::Vector>) -> Option<(u32, Real<K>)> {
        if self.with_weights {
            return black_box(self.closest(ray)).map(|hit| (hit.prim, hit.t));
        }
        self.search_closest(ray, NodeSearch::found)
    }

    /// Computes the [`closest_distance`](Self::closest_distance) of each ray, on this thread, into `found`. If the
    /// lengths differ, the shorter slice determines the number of rays.
    pub fn closest_distances(&self, rays: &[Ray<K::Vector>], found: &mut [Option<(u32, Real<K>)>]) {
        for (ray, found) in rays.iter().zip(found) {
            *found = self.closest_distance(ray);
        }
    }

    /// Extracts the answer of a completed closest-hit query. (A returned query is so large that it is not inlined in
    /// loops over rays. Such loops take a third longer if all rays miss.)
    #[inline]
    fn search_closest<'a, A>(
        &'a self,
        ray: &Ray<K::Vector>,
        answer: impl FnOnce(&NodeSearch<'a, K, B, false>) -> A,
    ) -> A {
        let mut search = NodeSearch::new(self.bvh(), &self.level.boxes, ray);
        lend(&MEMORY, |memory| self.level.run(self.bvh().tree(), ray.octant(), memory, &mut search));
        answer(&search)
    }

    /// Extracts the answer of a completed any-hit query.
    #[inline]
    fn search_any<'a, A>(
        &'a self,
        ray: &Ray<K::Vector>,
        answer: impl FnOnce(&NodeSearch<'a, K, B, true, FromLeft>) -> A,
    ) -> A {
        let mut search = NodeSearch::new(self.bvh(), &self.level.boxes, ray);
        lend(&MEMORY, |memory| self.level.run(self.bvh().tree(), ray.octant(), memory, &mut search));
        answer(&search)
    }

    /// Runs a rare query to its end.
    fn run_shared<Q: BoxQuery>(&self, octant: u8, query: Q) -> Q {
        let mut search = OwnBoxes::over(query, &self.level.boxes);
        lend(&MEMORY, |memory| self.level.run_shared(self.bvh().tree(), octant, memory, &mut search));
        search.query
    }

    pub(super) fn sweep(&self, ray: &Ray<K::Vector>) -> AllHitsQuery<'_, K, B> {
        AllHitsQuery::watching(self.bvh(), ray, self.watches)
    }
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> RayQueries<Ray<K::Vector>>
    for BinaryTracer<T, K, B>
{
    type Hit = Hit<Real<K>>;

    fn closest(&self, ray: &Ray<K::Vector>) -> Option<Self::Hit> {
        self.search_closest(ray, NodeSearch::hit)
    }

    fn any(&self, ray: &Ray<K::Vector>) -> bool {
        if self.with_weights {
            return black_box(self.any_hit(ray)).is_some();
        }
        self.search_any(ray, NodeSearch::found).is_some()
    }

    fn any_hit(&self, ray: &Ray<K::Vector>) -> Option<Self::Hit> {
        self.search_any(ray, NodeSearch::hit)
    }

    fn all(&self, ray: &Ray<K::Vector>) -> Vec<Self::Hit> {
        self.run_shared(ray.octant(), self.sweep(ray)).into_hits()
    }
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> Filterable<K::Vector>
    for BinaryTracer<T, K, B>
{
    fn find(&self, ray: &Ray<K::Vector>, filter: Filter<'_, Real<K>>, is_any: bool) -> Option<Hit<Real<K>>> {
        let cast = PreparedRay::<K, B, _>::new(self.bvh(), ray);
        self.run_shared(ray.octant(), FilteredQuery::over(cast, filter, is_any)).hit()
    }
}

impl<T, K, B, V> MeshQueries<V> for BinaryTracer<T, K, B>
where
    T: Borrow<Bvh<Triangle<V>>>,
    K: Parity<Vector = V>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    fn next(&self, ray: &Ray<V>, after: (V::Real, u32)) -> Option<Hit<V::Real>> {
        self.run_shared(ray.octant(), NextHitQuery::<K, B>::new(self.bvh(), ray, after)).hit()
    }

    fn crossings(&self, ray: &Ray<V>) -> u32 {
        self.run_shared(ray.octant(), Crossings::<K, B>::over(PreparedRay::new(self.bvh(), ray))).count()
    }

    fn winding(&self, ray: &Ray<V>) -> i32 {
        let query = Crossings::<K, B>::over(PreparedRay::new(self.bvh(), ray)).with_signs(true);
        self.run_shared(ray.octant(), query).winding()
    }

    fn crossings_off_surface(&self, ray: &Ray<V>, signed: bool) -> Option<i32> {
        let query = Crossings::<K, B>::over(PreparedRay::new(self.bvh(), ray)).with_signs(signed);
        self.run_shared(ray.octant(), query.watching(ray.origin())).off_surface()
    }

    fn nearest(&self, ball: &Ball<V>) -> Option<Near<V>> {
        self.run_shared(0, NearestPoint::new(self.bvh(), ball)).near()
    }

    fn nearest_k(&self, ball: &Ball<V>, k: usize) -> Vec<Near<V>> {
        self.run_shared(0, NearestPoints::new(self.bvh(), ball, k)).nears().collect()
    }
}

thread_local! {
    /// The stack of a traversal.
    static MEMORY: Cell<Vec<Node>> = const { Cell::new(Vec::new()) };
}

impl<T, K, B> fmt::Debug for BinaryTracer<T, K, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (method, word) = (self.level.method, self.level.word);
        f.debug_struct("BinaryTracer").field("method", &method).field("word", &word).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
