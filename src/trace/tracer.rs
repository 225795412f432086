//! Ray queries as functions: the library's front door.

use std::fmt;
use std::marker::PhantomData;

use super::counters::{Counters, Counting};
use super::level::Level;
use super::{
    Ask, Following, FromLeft, Hit, Near, NearError, Nearest, NearestPoint, NearestPoints, NodeSearch, OwnBoxes, Plan,
    Query, Sweep,
};
use crate::bvh::Bvh;
use crate::event::Backtracks;
use crate::geom::kernel::{Exact, Real};
use crate::geom::slabs::Directed;
use crate::geom::{Kernel, Ray, Slabs, Vector};
use crate::threads;
use crate::traverse::{Method, Unfit, WordName};
use crate::tree::{Node, Uncles};
use glam::Vec3;

/// Answers queries over a hierarchy by one of the traversals, with the triangle test `K` and the box test `B`.
///
/// The answers are exact unless other tests are asked for, and then the same for all trees and traversals. `[DET-1]` A
/// tracer can be shared by threads.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{bvh::{Bvh, SahOptions}, geom::Ray, geom::Mesh, trace::Tracer};
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// let tracer = Tracer::new(&bvh);
/// let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
/// let hit = tracer.closest(&ray).ok_or("a miss")?;
/// assert_eq!((hit.prim, hit.t, hit.u, hit.v), (0, 3.0, 0.25, 0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Tracer<'a, K: Kernel = Exact, B = Directed> {
    pub(super) level: Level<'a, K::Shape>,
    slabs: PhantomData<fn() -> B>,
}

/// Rays that a thread takes at once.
const CHUNK: usize = 256;

impl<'a> Tracer<'a> {
    /// A tracer by `hashed`, with tables and words as narrow as the hierarchy allows.
    pub fn new(bvh: &'a Bvh) -> Self {
        // No hierarchy is known for which the hash cannot be built. Uncle references need none.
        Self::with_method(bvh, Method::Hashed)
            .unwrap_or_else(|_| Self::over(Level::unchecked(bvh, &Plan::new(bvh, Method::Uncle, Ask::All))))
    }

    /// The point of the mesh that is nearest to `point`, if there is one within the radius, included. `[NEAR-1]`
    ///
    /// # Errors
    /// What [`NearError`] lists.
    pub fn nearest(&self, point: Vec3, radius: f32) -> Result<Option<Near>, NearError> {
        let mut search = OwnBoxes::over(NearestPoint::new(self.level.bvh, point, radius)?, &self.level.boxes);
        self.level.run(0, &mut Vec::new(), &mut search, &mut ());
        Ok(search.query.near())
    }

    /// The `k` triangles that are nearest to `point`, in order of distance and then index, as many as there are within the
    /// radius, included. `[NEAR-2]`
    ///
    /// # Errors
    /// What [`NearError`] lists.
    pub fn nearest_k(&self, point: Vec3, radius: f32, k: usize) -> Result<Vec<Near>, NearError> {
        let mut search = OwnBoxes::over(NearestPoints::new(self.level.bvh, point, radius, k)?, &self.level.boxes);
        self.level.run(0, &mut Vec::new(), &mut search, &mut ());
        Ok(search.query.nears().collect())
    }
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> Tracer<'a, K, B> {
    /// A tracer by any traversal, with tables and words as narrow as the hierarchy allows.
    ///
    /// # Errors
    /// [`Unfit`] where the traversal is not for this hierarchy: `complete` on one that is not, `laine-*` on one that is deeper
    /// than 126.
    pub fn with_method(bvh: &'a Bvh<K::Shape>, method: Method) -> Result<Self, Unfit> {
        Self::planned(bvh, &Plan::new(bvh, method, Ask::All))
    }

    /// A tracer that has what a plan says, which must be for this hierarchy.
    ///
    /// # Errors
    /// As [`with_method`](Self::with_method).
    pub fn planned(bvh: &'a Bvh<K::Shape>, plan: &Plan) -> Result<Self, Unfit> {
        Level::new(bvh, plan).map(Self::over)
    }

    fn over(level: Level<'a, K::Shape>) -> Self {
        Self { level, slabs: PhantomData }
    }

    /// The hierarchy.
    pub fn bvh(&self) -> &'a Bvh<K::Shape> {
        self.level.bvh
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

    /// The closest hit: the least distance, and of equal ones the least index. `[EXACT-1]`
    pub fn closest(&self, ray: &Ray<K::Vector>) -> Option<Hit<Real<K>>> {
        self.closest_in(ray, &mut Vec::new())
    }

    /// Whether there is any hit.
    pub fn any(&self, ray: &Ray<K::Vector>) -> bool {
        self.any_in(ray, &mut Vec::new())
    }

    /// [`closest_distance`](Self::closest_distance) of each ray, on this thread, into `found`, which has room for all.
    pub fn closest_distances(&self, rays: &[Ray<K::Vector>], found: &mut [Option<(u32, Real<K>)>]) {
        let mut memory = Vec::new();
        for (ray, found) in rays.iter().zip(found) {
            let mut search = NodeSearch::<K, B, false>::new(self.level.bvh, &self.level.boxes, ray);
            self.level.run_fast(ray.octant(), &mut memory, &mut search);
            *found = search.found();
        }
    }

    /// Triangle and distance of the [`closest`](Self::closest) hit, without its weights.
    pub fn closest_distance(&self, ray: &Ray<K::Vector>) -> Option<(u32, Real<K>)> {
        let mut found = [None];
        self.closest_distances(std::slice::from_ref(ray), &mut found);
        found[0]
    }

    /// Any hit, whole: the first that is met, which depends on hierarchy and traversal.
    pub fn any_hit(&self, ray: &Ray<K::Vector>) -> Option<Hit<Real<K>>> {
        self.any_hit_in(ray, &mut Vec::new())
    }

    /// [`any_hit`](Self::any_hit) of each ray, on this thread.
    pub fn any_hit_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Hit<Real<K>>>> {
        let mut memory = Vec::new();
        rays.iter().map(|ray| self.any_hit_in(ray, &mut memory)).collect()
    }

    /// What the closest hit (or with `any`, any hit) of each ray costs, counted. Of no use for timing.
    pub fn count(&self, rays: &[Ray<K::Vector>], any: bool) -> Counters {
        let count = |chunk: &[Ray<K::Vector>]| {
            let (mut counters, mut memory) = (Counters::default(), Vec::new());
            let mut backtracks = Backtracks::new(<Uncles>::REACH);
            for ray in chunk {
                counters.rays += 1;
                backtracks.begin();
                let (bvh, boxes, counters) = (self.level.bvh, &*self.level.boxes, &mut counters);
                let query: &mut dyn Query = if any {
                    &mut Counting::<K, B, true, FromLeft> { search: NodeSearch::new(bvh, boxes, ray), counters }
                } else {
                    &mut Counting::<K, B, false, Nearest> { search: NodeSearch::new(bvh, boxes, ray), counters }
                };
                self.level.run(ray.octant(), &mut memory, query, &mut backtracks);
            }
            Counters { backtracks, ..counters }
        };
        threads::reduce(rays, CHUNK, count, |a, b| a.merge(&b)).unwrap_or_default()
    }

    /// The closest hit of each ray, on this thread.
    pub fn closest_each(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Hit<Real<K>>>> {
        let mut memory = Vec::new();
        rays.iter().map(|ray| self.closest_in(ray, &mut memory)).collect()
    }

    /// Whether there is any hit of each ray, on this thread.
    pub fn any_each(&self, rays: &[Ray<K::Vector>]) -> Vec<bool> {
        let mut memory = Vec::new();
        rays.iter().map(|ray| self.any_in(ray, &mut memory)).collect()
    }

    /// The closest hit of each ray, on all threads.
    pub fn closest_parallel(&self, rays: &[Ray<K::Vector>]) -> Vec<Option<Hit<Real<K>>>> {
        in_parallel(rays, |ray, memory| self.closest_in(ray, memory))
    }

    /// Whether there is any hit of each ray, on all threads.
    pub fn any_parallel(&self, rays: &[Ray<K::Vector>]) -> Vec<bool> {
        in_parallel(rays, |ray, memory| self.any_in(ray, memory))
    }

    /// All hits, each triangle once, in the order (`t`, primitive): edges and corners included.
    pub fn all(&self, ray: &Ray<K::Vector>) -> Vec<Hit<Real<K>>> {
        let mut search = OwnBoxes::over(Sweep::<K, B>::new(self.level.bvh, ray), &self.level.boxes);
        self.level.run(ray.octant(), &mut Vec::new(), &mut search, &mut ());
        search.query.hits()
    }

    /// The first hit in the order (`t`, primitive) that comes after the given one, which need not be a hit. So hits can be
    /// walked through one by one: none is lost or met again, not even where many have the same `t`.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use stackless_bvh::{bvh::{Bvh, SahOptions}, geom::Ray, geom::Mesh, trace::Tracer};
    /// # let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0], [1, 0, 2]])?;
    /// # let bvh = Bvh::sah(&mesh, SahOptions::default())?;
    /// # let tracer = Tracer::new(&bvh);
    /// # let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
    /// let mut hits = Vec::new();
    /// let mut hit = tracer.closest(&ray);
    /// while let Some(found) = hit {
    ///     hits.push(found);
    ///     hit = tracer.next(&ray, (found.t, found.prim));
    /// }
    /// assert_eq!(hits, tracer.all(&ray));
    /// # assert_eq!(hits.len(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn next(&self, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Option<Hit<Real<K>>> {
        let mut search = OwnBoxes::over(Following::<K, B>::new(self.level.bvh, ray, after), &self.level.boxes);
        self.level.run(ray.octant(), &mut Vec::new(), &mut search, &mut ());
        search.query.hit()
    }

    #[inline]
    fn closest_in(&self, ray: &Ray<K::Vector>, memory: &mut Vec<Node>) -> Option<Hit<Real<K>>> {
        let mut search = NodeSearch::<K, B, false>::new(self.level.bvh, &self.level.boxes, ray);
        self.level.run_fast(ray.octant(), memory, &mut search);
        search.hit()
    }

    #[inline]
    fn any_in(&self, ray: &Ray<K::Vector>, memory: &mut Vec<Node>) -> bool {
        let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.level.bvh, &self.level.boxes, ray);
        self.level.run_fast(ray.octant(), memory, &mut search);
        search.found().is_some()
    }

    fn any_hit_in(&self, ray: &Ray<K::Vector>, memory: &mut Vec<Node>) -> Option<Hit<Real<K>>> {
        let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.level.bvh, &self.level.boxes, ray);
        self.level.run_fast(ray.octant(), memory, &mut search);
        search.hit()
    }
}

/// Answers each ray into its place. Threads keep their memory between chunks.
fn in_parallel<V: Vector, A: Send>(
    rays: &[Ray<V>],
    answer: impl Fn(&Ray<V>, &mut Vec<Node>) -> A + Sync + Send,
) -> Vec<A> {
    threads::map_with(0..rays.len(), CHUNK, Vec::new, |memory, i| answer(&rays[i], memory))
}

impl<K: Kernel, B> fmt::Debug for Tracer<'_, K, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tracer").field("level", &self.level).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
