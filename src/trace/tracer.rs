//! The default tracer: queries over a hierarchy of eight children.

mod count;
mod interleaved;
mod search;
mod shared;

use std::borrow::Borrow;
use std::fmt;
use std::marker::PhantomData;

use glam::Vec3;

use super::filter::{Filterable, FilteredQuery};
use super::prepared_ray::PreparedRay;
use super::{
    AllHitsQuery, Crossings, Filter, Hit, MeshQueries, Near, NearestPoint, NearestPoints, NextHitQuery, Part, Plan,
    QueryKind, RayQueries, next,
};
use crate::bvh::{WideBvh, WideError};
use crate::geom::lanes::{Level, Precision, with_baseline};
use crate::geom::{Ball, Mesh, Ray};
use crate::tree::Node;
use crate::wide::{Method, Tables, Unsupported, Wanted};
use interleaved::{Answers, trace, trace_one};
use search::{HitQuery, Job};
use shared::{LaneRay, Query};

pub(super) use search::LaneRanks;
pub(super) use shared::{Query as SharedQuery, run as run_shared};

/// Answers queries over a hierarchy of eight children, exactly. This is the default tracer.
///
/// It is the fastest tracer of this library, in single and in double precision. [`BinaryTracer`](super::BinaryTracer)
/// is for other shapes, other tests and the traversals of binary trees; its answers are identical, bit for bit.
/// `[DET-1]`
///
/// `T` is `WideBvh`, `&WideBvh`, `Arc<WideBvh>`, or another type that borrows as `WideBvh`. `V` is the precision,
/// [`Vec3`] or [`DVec3`](glam::DVec3). [`RayQueries`] and [`MeshQueries`] have the queries. Rays of a slice are traced
/// interleaved, two at a time: one ray computes while the other waits for memory.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::{geom::Mesh, geom::Ray, trace::RayQueries, trace::Tracer};
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let tracer = Tracer::of(&mesh)?;
/// let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
/// let hit = tracer.closest(&ray).ok_or("a miss")?;
/// assert_eq!((hit.prim, hit.t, hit.u, hit.v), (0, 3.0, 0.25, 0.5));
/// assert_eq!(tracer.any_each(&[ray, ray]), [true, true]);
///
/// // Double precision, at the distance of the earth's surface from its center.
/// use stackless_bvh::glam::DVec3;
/// let [x, y, z] = DVec3::AXES;
/// let at = DVec3::splat(6.4e6);
/// let mesh = Mesh::new(vec![at, at + x, at + y], vec![[0, 1, 2]])?;
/// let hit = Tracer::of(&mesh)?.closest(&Ray::new(at + (x + y) * 0.25 - z, z)?).ok_or("a miss")?;
/// assert_eq!((hit.t, hit.u), (1.0, 0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Tracer<T = WideBvh, V = Vec3> {
    bvh: T,
    method: Method,
    tables: Tables,
    level: Level,
    /// Whether all hits are computed with their weights, to measure the cost.
    with_weights: bool,
    /// Whether a triangle may be in several leaves.
    watches: bool,
    precision: PhantomData<fn() -> V>,
}

impl<V: Precision> Tracer<WideBvh<8, V>, V> {
    /// Builds a tracer that owns a hierarchy over a mesh, by [`WideBvh::build`].
    ///
    /// # Errors
    /// [`WideError`], if the mesh is too large.
    pub fn of(mesh: &Mesh<V>) -> Result<Self, WideError> {
        WideBvh::build(mesh).map(Self::new)
    }
}

impl<V: Precision, T: Borrow<WideBvh<8, V>>> Tracer<T, V> {
    /// Creates a tracer with [`Method::default`], which fits any hierarchy, and the best instructions of this machine.
    pub fn new(bvh: T) -> Self {
        Self::over(bvh, Method::default(), Tables::NONE)
    }

    fn over(bvh: T, method: Method, tables: Tables) -> Self {
        let watches = bvh.borrow().duplicates() > 0;
        Self { bvh, method, tables, level: Level::new(), with_weights: false, watches, precision: PhantomData }
    }

    /// Creates a tracer with the given traversal.
    ///
    /// # Errors
    /// [`Unsupported`] if the hierarchy has too many levels for it.
    pub fn with_method(bvh: T, method: Method) -> Result<Self, Unsupported> {
        let tables = Tables::of(method, bvh.borrow());
        let tracer = Self::over(bvh, method, tables);
        // Detects an unfit traversal before the first ray.
        tracer.run(&[], HitQuery::Distance, Answers::Distances(&mut [])).map(|()| tracer)
    }

    /// Returns this tracer with another instruction level. The answers do not change.
    #[must_use]
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// Returns the parts that it needs for queries of a kind, and those that it omits.
    pub fn plan(&self, ask: QueryKind) -> Plan {
        Plan::wide(self.bvh(), self.method, ask)
    }

    /// Returns this tracer with the restored parts of its [`plan`](Self::plan), to measure their cost: hash, weights,
    /// and watch for repeats. [`Plan::options`] and [`Plan::on`] restore the other parts. The answers do not change.
    ///
    /// ```
    /// use stackless_bvh::{generate::procedural, trace::Part, trace::QueryKind, trace::RayQueries, trace::Tracer};
    ///
    /// let mesh = procedural::strands(1, 100);
    /// let (tracer, rays) = (Tracer::of(&mesh)?, procedural::rays(&mesh, 1, 50));
    /// let (plan, answers) = (tracer.plan(QueryKind::Any), tracer.any_each(&rays));
    /// let with_weights = tracer.planned(&plan.with(Part::Weights));
    /// assert_eq!(with_weights.any_each(&rays), answers);
    /// # Ok::<(), stackless_bvh::bvh::WideError>(())
    /// ```
    #[must_use]
    pub fn planned(mut self, plan: &Plan) -> Self {
        if plan.restores(Part::Hash) {
            self.tables = Tables::new(self.bvh());
        }
        self.with_weights |= plan.restores(Part::Weights);
        self.watches |= plan.restores(Part::Repeats);
        self
    }

    /// Returns the hierarchy.
    pub fn bvh(&self) -> &WideBvh<8, V> {
        self.bvh.borrow()
    }

    /// Returns the traversal.
    pub const fn method(&self) -> Method {
        self.method
    }

    /// Returns the instruction level.
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Returns the memory of its tables in bytes, without the hierarchy.
    pub fn bytes(&self) -> usize {
        self.tables.bytes()
    }

    /// Returns triangle and distance of the [`closest`](RayQueries::closest) hit, without its weights.
    pub fn closest_distance(&self, ray: &Ray<V>) -> Option<(u32, V::Real)> {
        self.one(ray, HitQuery::Distance).map(|hit| (hit.prim, hit.t))
    }

    /// Computes the [`closest_distance`](Self::closest_distance) of each ray, on this thread, into `found`. If the
    /// lengths differ, the shorter slice determines the number of rays.
    pub fn closest_distances(&self, rays: &[Ray<V>], found: &mut [Option<(u32, V::Real)>]) {
        let count = rays.len().min(found.len());
        self.run_fit(&rays[..count], HitQuery::Distance, Answers::Distances(&mut found[..count]));
    }

    /// Returns the children of an inner node that a ray wants before its first hit: those whose boxes it meets, with
    /// the ranks that order them. For programs that display or count a traversal. `[LANES-2]`
    pub fn wanted(&self, ray: &Ray<V>, node: Node) -> Wanted<[u32; 8]> {
        let bvh = self.bvh();
        with_baseline!(simd => PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh)).ask(node))
    }

    fn run_shared(&self, query: &mut dyn Query) {
        let ran = shared::run(self.method, self.bvh(), &self.tables, query);
        debug_assert_eq!(ran, Ok(()));
    }

    fn one(&self, ray: &Ray<V>, ask: HitQuery) -> Option<Hit<V::Real>> {
        let answer = trace_one(self.method, self.job(ask), ray);
        debug_assert!(answer.is_ok(), "{answer:?}");
        answer.unwrap_or(None)
    }

    fn hits(&self, rays: &[Ray<V>], ask: HitQuery) -> Vec<Option<Hit<V::Real>>> {
        let mut hits = vec![None; rays.len()];
        self.run_fit(rays, ask, Answers::Hits(&mut hits));
        hits
    }

    /// The constructor has checked that the traversal fits.
    fn run_fit(&self, rays: &[Ray<V>], ask: HitQuery, answers: Answers<'_, V>) {
        let ran = self.run(rays, ask, answers);
        debug_assert_eq!(ran, Ok(()));
    }

    fn run(&self, rays: &[Ray<V>], ask: HitQuery, mut answers: Answers<'_, V>) -> Result<(), Unsupported> {
        trace(self.method, self.job(ask), rays, &mut answers)
    }

    fn job(&self, ask: HitQuery) -> Job<'_, V> {
        let ask = match ask {
            HitQuery::Any if self.with_weights => HitQuery::AnyHit,
            HitQuery::Distance if self.with_weights => HitQuery::Closest,
            _ => ask,
        };
        Job { bvh: self.bvh(), tables: &self.tables, level: self.level, ask }
    }
}

impl<V: Precision, T: Borrow<WideBvh<8, V>>> RayQueries<Ray<V>> for Tracer<T, V> {
    type Hit = Hit<V::Real>;

    fn closest(&self, ray: &Ray<V>) -> Option<Self::Hit> {
        self.one(ray, HitQuery::Closest)
    }

    fn any(&self, ray: &Ray<V>) -> bool {
        self.one(ray, HitQuery::Any).is_some()
    }

    fn any_hit(&self, ray: &Ray<V>) -> Option<Self::Hit> {
        self.one(ray, HitQuery::AnyHit)
    }

    fn all(&self, ray: &Ray<V>) -> Vec<Self::Hit> {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh));
            let mut query = AllHitsQuery::over(cast, self.watches);
            self.run_shared(&mut query);
            query.into_hits()
        })
    }

    fn closest_each(&self, rays: &[Ray<V>]) -> Vec<Option<Self::Hit>> {
        self.hits(rays, HitQuery::Closest)
    }

    fn any_each(&self, rays: &[Ray<V>]) -> Vec<bool> {
        let mut found = vec![false; rays.len()];
        self.run_fit(rays, HitQuery::Any, Answers::Any(&mut found));
        found
    }

    fn any_hit_each(&self, rays: &[Ray<V>]) -> Vec<Option<Self::Hit>> {
        self.hits(rays, HitQuery::AnyHit)
    }
}

impl<V: Precision, T: Borrow<WideBvh<8, V>>> Filterable<V> for Tracer<T, V> {
    fn find(&self, ray: &Ray<V>, filter: Filter<'_, V::Real>, is_any: bool) -> Option<Hit<V::Real>> {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh));
            let mut query = FilteredQuery::over(cast, filter, is_any);
            self.run_shared(&mut query);
            query.hit()
        })
    }
}

impl<V: Precision, T: Borrow<WideBvh<8, V>>> MeshQueries<V> for Tracer<T, V> {
    fn next(&self, ray: &Ray<V>, after: (V::Real, u32)) -> Option<Hit<V::Real>> {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, &next::rest(ray, after.0), bvh));
            let mut query = NextHitQuery::over(cast, after);
            self.run_shared(&mut query);
            query.hit()
        })
    }

    fn crossings(&self, ray: &Ray<V>) -> u32 {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let mut query = Crossings::over(PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh)));
            self.run_shared(&mut query);
            query.count()
        })
    }

    fn winding(&self, ray: &Ray<V>) -> i32 {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let mut query = Crossings::over(PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh))).with_signs(true);
            self.run_shared(&mut query);
            query.winding()
        })
    }

    fn crossings_off_surface(&self, ray: &Ray<V>, signed: bool) -> Option<i32> {
        let bvh = self.bvh();
        with_baseline!(simd => {
            let cast = PreparedRay::with(bvh, ray, LaneRay::new(simd, ray, bvh));
            let mut query = Crossings::over(cast).with_signs(signed).watching(ray.origin());
            self.run_shared(&mut query);
            query.off_surface()
        })
    }

    fn nearest(&self, ball: &Ball<V>) -> Option<Near<V>> {
        let mut query = NearestPoint::new(self.bvh(), ball);
        self.run_shared(&mut query);
        query.near()
    }

    fn nearest_k(&self, ball: &Ball<V>, k: usize) -> Vec<Near<V>> {
        let mut query = NearestPoints::new(self.bvh(), ball, k);
        self.run_shared(&mut query);
        query.nears().collect()
    }
}

impl<T, V> fmt::Debug for Tracer<T, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, level, .. } = self;
        f.debug_struct("Tracer").field("method", method).field("level", level).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
