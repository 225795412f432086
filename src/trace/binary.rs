//! Ray queries over binary hierarchies, as functions.

mod crossings;
mod nearest;

use std::borrow::Borrow;
use std::marker::PhantomData;
use std::{fmt, slice, vec};

use super::level::Level;
use super::{Ask, Asked, Following, FromLeft, Hit, NodeSearch, OwnBoxes, Part, Plan, Sweep};
use crate::bvh::{BuildError, Bvh};
use crate::geom::kernel::{Exact, Real};
use crate::geom::slabs::Directed;
use crate::geom::{EnvironmentError, Kernel, Mesh, Ray, Slabs};
use crate::threads;
use crate::traverse::{Method, Unfit, WordName};
use crate::tree::Node;

/// Answers queries over a binary hierarchy by one of the traversals, with the triangle test `K` and the box test `B`.
/// Where nothing of these matters, [`Tracer`](super::Tracer) is faster.
///
/// The hierarchy is its own, borrowed or shared: `T` is `Bvh`, `&Bvh`, `Arc<Bvh>`, or whatever else borrows as one,
/// always the same. A tracer can be stored, sent and shared by threads as `T` can.
///
/// Each query is there for one ray, for a slice on this thread (`_each`), and for a slice on all threads (`_parallel`).
/// Whatever the traversal is not made for is found when the tracer is made; a ray cannot fail. The answers are exact
/// unless other tests are asked for, and then the same for all hierarchies and traversals. `[DET-1]`
///
/// ```
/// use std::sync::Arc;
/// use glam::Vec3;
/// use stackless_bvh::{bvh::Bvh, geom::Mesh, geom::Ray, trace::BinaryTracer, traverse::Method};
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
/// let hit = BinaryTracer::of(&mesh)?.closest(&ray).ok_or("a miss")?;
/// assert_eq!((hit.prim, hit.t, hit.u, hit.v), (0, 3.0, 0.25, 0.5));
///
/// let bvh = Bvh::build(&mesh)?;
/// let hashed = BinaryTracer::with_method(&bvh, Method::Hashed)?;
/// assert_eq!(hashed.closest_each(&[ray, ray]), [Some(hit); 2]);
///
/// let shared: BinaryTracer<Arc<Bvh>> = BinaryTracer::new(Arc::new(bvh));
/// assert!(std::thread::spawn(move || shared.any(&ray)).join().is_ok_and(|any| any));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct BinaryTracer<T = Bvh, K = Exact, B = Directed> {
    bvh: T,
    pub(super) level: Level,
    /// What the plan says of hits.
    ask: Ask,
    with_weights: bool,
    watches: bool,
    tests: PhantomData<fn() -> (K, B)>,
}

/// Rays that a thread takes at once.
pub(super) const CHUNK: usize = 256;

impl BinaryTracer {
    /// A tracer that owns a hierarchy over a mesh, by [`Bvh::build`].
    ///
    /// # Errors
    /// [`BuildError`], for more than 2^31 triangles.
    pub fn of(mesh: &Mesh) -> Result<Self, BuildError> {
        Bvh::build(mesh).map(Self::new)
    }
}

impl<T: Borrow<Bvh>> BinaryTracer<T> {
    /// A tracer by [`Method::default`], which runs on any hierarchy, with words as narrow as that allows.
    ///
    /// It follows the links that a new hierarchy has. Where the records name [others](Bvh::with_links), they are in a
    /// table beside it, and queries share a slower copy of the traversals; so it is with all traversals.
    pub fn new(bvh: T) -> Self {
        let plan = Plan::new(bvh.borrow(), Method::default(), Ask::Hit);
        let level = Level::unchecked(bvh.borrow(), &plan);
        Self::over(bvh, level, &plan)
    }

    /// A tracer by any traversal, with tables and words as narrow as the hierarchy allows.
    ///
    /// # Errors
    /// [`Unfit`] where the traversal is not for this hierarchy: `complete` on one that is not, `laine-*` on one that is
    /// deeper than 126.
    pub fn with_method(bvh: T, method: Method) -> Result<Self, Unfit> {
        Self::with_tests(bvh, method)
    }

    /// A tracer that has what a plan says. A plan that was made for another hierarchy may cost time or memory, or be
    /// refused; it does not change an answer.
    ///
    /// # Errors
    /// [`Unfit`], also where the keys of the plan are too short for the hierarchy.
    pub fn planned(bvh: T, plan: &Plan) -> Result<Self, Unfit> {
        let level = Level::new(bvh.borrow(), plan)?;
        Ok(Self::over(bvh, level, plan))
    }
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> BinaryTracer<T, K, B> {
    /// [`with_method`](BinaryTracer::with_method) for other tests than the exact ones, or other shapes than triangles:
    /// `BinaryTracer::<_, K, B>::with_tests(...)`.
    ///
    /// # Errors
    /// As [`with_method`](BinaryTracer::with_method).
    pub fn with_tests(bvh: T, method: Method) -> Result<Self, Unfit> {
        let plan = Plan::new(bvh.borrow(), method, Ask::Hit);
        let level = Level::new(bvh.borrow(), &plan)?;
        Ok(Self::over(bvh, level, &plan))
    }

    fn over(bvh: T, level: Level, plan: &Plan) -> Self {
        // A triangle is reported once, whatever the plan was made for.
        let watches = !plan.skips(Part::Repeats) || bvh.borrow().duplicates() > 0;
        Self { bvh, level, ask: plan.ask(), with_weights: !plan.skips(Part::Weights), watches, tests: PhantomData }
    }

    /// The hierarchy.
    pub fn bvh(&self) -> &Bvh<K::Shape> {
        self.bvh.borrow()
    }

    /// The traversal.
    pub fn method(&self) -> Method {
        self.level.method
    }

    /// The word of its keys.
    pub fn word(&self) -> WordName {
        self.level.word
    }

    /// Memory of its tables, in bytes, besides the hierarchy.
    pub fn bytes(&self) -> usize {
        self.level.bytes()
    }

    /// The closest hit: the least exact distance, and of equal ones the least index. `[EXACT-1]`
    pub fn closest(&self, ray: &Ray<K::Vector>) -> Option<Hit<Real<K>>> {
        self.search_closest(ray, &mut Vec::new(), NodeSearch::hit)
    }

    /// [`closest`](Self::closest) of each ray, on this thread.
    pub fn closest_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Hit<Real<K>>>> {
        each(rays, |ray, memory| self.search_closest(ray, memory, NodeSearch::hit))
    }

    /// [`closest`](Self::closest) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn closest_parallel(&self, rays: &[Ray<K::Vector>]) -> Result<Vec<Option<Hit<Real<K>>>>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(rays, |ray, memory| self.search_closest(ray, memory, NodeSearch::hit))
    }

    /// Triangle and distance of the [`closest`](Self::closest) hit, without its weights.
    pub fn closest_distance(&self, ray: &Ray<K::Vector>) -> Option<(u32, Real<K>)> {
        let mut found = [None];
        self.closest_distances(slice::from_ref(ray), &mut found);
        found[0]
    }

    /// [`closest_distance`](Self::closest_distance) of each ray, on this thread, into `found`: of as many as both have.
    pub fn closest_distances(&self, rays: &[Ray<K::Vector>], found: &mut [Option<(u32, Real<K>)>]) {
        let mut memory = Vec::new();
        for (ray, found) in rays.iter().zip(found) {
            *found = self.search_closest(ray, &mut memory, NodeSearch::found);
        }
    }

    /// Whether there is any hit.
    pub fn any(&self, ray: &Ray<K::Vector>) -> bool {
        self.search_any(ray, &mut Vec::new(), NodeSearch::found).is_some()
    }

    /// [`any`](Self::any) of each ray, on this thread.
    pub fn any_each(&self, rays: &[Ray<K::Vector>]) -> Vec<bool> {
        each(rays, |ray, memory| self.search_any(ray, memory, NodeSearch::found).is_some())
    }

    /// [`any`](Self::any) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn any_parallel(&self, rays: &[Ray<K::Vector>]) -> Result<Vec<bool>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(rays, |ray, memory| self.search_any(ray, memory, NodeSearch::found).is_some())
    }

    /// Any hit, whole: the first that is met, which depends on hierarchy and traversal.
    pub fn any_hit(&self, ray: &Ray<K::Vector>) -> Option<Hit<Real<K>>> {
        self.search_any(ray, &mut Vec::new(), NodeSearch::hit)
    }

    /// [`any_hit`](Self::any_hit) of each ray, on this thread.
    pub fn any_hit_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Hit<Real<K>>>> {
        each(rays, |ray, memory| self.search_any(ray, memory, NodeSearch::hit))
    }

    /// [`any_hit`](Self::any_hit) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn any_hit_parallel(&self, rays: &[Ray<K::Vector>]) -> Result<Vec<Option<Hit<Real<K>>>>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(rays, |ray, memory| self.search_any(ray, memory, NodeSearch::hit))
    }

    /// All hits, each triangle once, in the order of exact distance and then of primitive: edges and corners
    /// included.
    ///
    /// ```
    /// use glam::Vec3;
    /// use stackless_bvh::{generate::procedural, geom::Ray, trace::BinaryTracer};
    ///
    /// let tracer = BinaryTracer::of(&procedural::soup(1, 2000))?;
    /// let ray = Ray::new(Vec3::new(0.5, 0.5, -1.0), Vec3::Z)?;
    /// assert!(tracer.all(&ray).is_sorted_by_key(|hit| hit.t));
    /// assert_eq!(tracer.all(&ray).next(), tracer.closest(&ray));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn all(&self, ray: &Ray<K::Vector>) -> vec::IntoIter<Hit<Real<K>>> {
        self.all_in(ray, &mut Vec::new()).into_iter()
    }

    /// [`all`](Self::all) of each ray, on this thread.
    pub fn all_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Vec<Hit<Real<K>>>> {
        each(rays, |ray, memory| self.all_in(ray, memory))
    }

    /// [`all`](Self::all) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn all_parallel(&self, rays: &[Ray<K::Vector>]) -> Result<Vec<Vec<Hit<Real<K>>>>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(rays, |ray, memory| self.all_in(ray, memory))
    }

    /// The first hit after a given one (`t`, primitive), in the order of [`all`](Self::all). So hits can be walked through
    /// one by one: none is lost or met again, not even where many have the same `t`. If the ray does not hit the given
    /// triangle at a distance that rounds to `t`, hits after `t` itself count. `[EXACT-13]`
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use stackless_bvh::{geom::Ray, geom::Mesh, trace::BinaryTracer};
    /// # let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0], [1, 0, 2]])?;
    /// # let tracer = BinaryTracer::of(&mesh)?;
    /// # let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
    /// let mut hits = Vec::new();
    /// let mut hit = tracer.closest(&ray);
    /// while let Some(found) = hit {
    ///     hits.push(found);
    ///     hit = tracer.next(&ray, (found.t, found.prim));
    /// }
    /// assert!(tracer.all(&ray).eq(hits));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next(&self, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Option<Hit<Real<K>>> {
        let bvh = self.bvh();
        let mut search = OwnBoxes::over(Following::<K, B>::new(bvh, ray, after), &self.level.boxes);
        self.level.run_shared(bvh.tree(), ray.octant(), &mut Vec::new(), &mut search);
        search.query.hit()
    }

    /// What the [`Plan`] asks for, of each ray, on this thread: of any hit or of the closest one, and no more of it
    /// than the plan wants.
    pub fn asked_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Asked<Real<K>>>> {
        let whole = |hit: Hit<_>| Asked { prim: hit.prim, t: Some(hit.t), weights: Some([hit.u, hit.v]) };
        each(rays, |ray, memory| match (self.ask, self.with_weights) {
            (Ask::Any, true) => self.search_any(ray, memory, NodeSearch::hit).map(whole),
            (Ask::Any, false) => {
                let (prim, _) = self.search_any(ray, memory, NodeSearch::found)?;
                Some(Asked { prim, t: None, weights: None })
            }
            (_, true) => self.search_closest(ray, memory, NodeSearch::hit).map(whole),
            (_, false) => {
                let (prim, t) = self.search_closest(ray, memory, NodeSearch::found)?;
                Some(Asked { prim, t: Some(t), weights: None })
            }
        })
    }

    /// What is asked of a closest-hit query that has run to its end. (A query that is returned is so large that it is not
    /// inlined in loops over rays, which then take a third longer for rays that miss all.)
    #[inline]
    fn search_closest<'a, A>(
        &'a self,
        ray: &Ray<K::Vector>,
        memory: &mut Vec<Node>,
        answer: impl FnOnce(&NodeSearch<'a, K, B, false>) -> A,
    ) -> A {
        let mut search = NodeSearch::new(self.bvh(), &self.level.boxes, ray);
        self.level.run(self.bvh().tree(), ray.octant(), memory, &mut search);
        answer(&search)
    }

    /// The same of an any-hit query.
    #[inline]
    fn search_any<'a, A>(
        &'a self,
        ray: &Ray<K::Vector>,
        memory: &mut Vec<Node>,
        answer: impl FnOnce(&NodeSearch<'a, K, B, true, FromLeft>) -> A,
    ) -> A {
        let mut search = NodeSearch::new(self.bvh(), &self.level.boxes, ray);
        self.level.run(self.bvh().tree(), ray.octant(), memory, &mut search);
        answer(&search)
    }

    fn all_in(&self, ray: &Ray<K::Vector>, memory: &mut Vec<Node>) -> Vec<Hit<Real<K>>> {
        let mut search = OwnBoxes::over(self.sweep(ray), &self.level.boxes);
        self.level.run_shared(self.bvh().tree(), ray.octant(), memory, &mut search);
        search.query.hits()
    }

    pub(super) fn sweep(&self, ray: &Ray<K::Vector>) -> Sweep<'_, K, B> {
        Sweep::watching(self.bvh(), ray, self.watches)
    }
}

/// Answers one after the other, with memory that is kept in between.
fn each<I, A>(items: &[I], answer: impl Fn(&I, &mut Vec<Node>) -> A) -> Vec<A> {
    let mut memory = Vec::new();
    items.iter().map(|item| answer(item, &mut memory)).collect()
}

/// The same on all threads.
fn in_parallel<I: Sync, A: Send>(
    items: &[I],
    answer: impl Fn(&I, &mut Vec<Node>) -> A + Sync + Send,
) -> Result<Vec<A>, EnvironmentError> {
    threads::guarded(|| threads::map_with(0..items.len(), CHUNK, Vec::new, |memory, i| answer(&items[i], memory)))
}

impl<T, K, B> fmt::Debug for BinaryTracer<T, K, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (method, word) = (self.level.method, self.level.word);
        f.debug_struct("BinaryTracer").field("method", &method).field("word", &word).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
