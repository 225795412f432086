//! Queries of everything along a ray: all hits, and the number of crossings.

use std::cmp::Ordering;
use std::collections::HashSet;

use super::Hit;
use super::leaf_primitives::{LeafFilter, LeafPrimitives};
use super::prepared_ray::PreparedRay;
use super::query::binary_query;
use super::winding::vector;
use crate::bvh::Bvh;
use crate::geom::kernel::{Exact, Exact64, Parity, Real};
use crate::geom::slabs::{Directed, Slabs64};
use crate::geom::{Kernel, Once, Ray, Real as _, Region, Slabs, Vector as _};
use crate::tree::Node;

/// All hits of a ray, exact: every closed triangle that it meets, edges and corners included. `[EXACT-1]`
///
/// ```
/// use stackless_bvh::bvh::Bvh;
/// use stackless_bvh::geom::{Mesh, Ray};
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::internals::trace::AllHits;
/// use stackless_bvh::traverse::{Stack, traverse};
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z], vec![[0, 1, 2], [0, 2, 1], [0, 1, 3]])?;
/// let bvh = Bvh::median(&mesh, 1)?;
/// let ray = Ray::new(Vec3::new(0.25, -0.25, -1.0), Vec3::new(0.0, 0.5, 1.0))?;
/// let mut hits = AllHits::new(&bvh, &ray);
/// traverse(Stack::new(&bvh, &mut Vec::new()), &mut hits, &mut ());
/// let hits = hits.into_hits();
/// assert_eq!(hits.iter().map(|hit| (hit.prim, hit.t)).collect::<Vec<_>>(), [(0, 1.0), (1, 1.0)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type AllHits<'a> = AllHitsQuery<'a, Exact, Directed>;

/// [`AllHits`] in double precision. `[EXACT-7]`
pub type AllHits64<'a> = AllHitsQuery<'a, Exact64, Slabs64>;

/// The state of a ray that collects all its hits in a hierarchy `H`, with the triangle test `K` and the box test `B`.
/// It visits all boxes that the ray meets.
#[derive(Clone, Debug)]
pub struct AllHitsQuery<'a, K: Kernel, B, H = Bvh<<K as Kernel>::Shape>> {
    pub(super) cast: PreparedRay<'a, K, B, H>,
    repeats: Repeats,
    distances: Once<K::Shape, Option<Real<K>>>,
    /// Distance, triangle, and its place in the hierarchy.
    found: Vec<(Real<K>, u32, usize)>,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> AllHitsQuery<'a, K, B> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>) -> Self {
        Self::watching(bvh, ray, bvh.duplicates() > 0)
    }

    /// Prepares a query that reports repeated triangles once. Without `watch`, no triangle may be in several leaves.
    pub(super) fn watching(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>, watches: bool) -> Self {
        Self::over(PreparedRay::new(bvh, ray), watches)
    }

    /// Returns whether it detects repeated triangles.
    #[cfg(test)]
    pub(super) fn watches(&self) -> bool {
        self.repeats.0.is_some()
    }
}

impl<'a, K: Kernel, B, H: LeafPrimitives<K::Shape>> AllHitsQuery<'a, K, B, H> {
    pub(super) fn over(cast: PreparedRay<'a, K, B, H>, watches: bool) -> Self {
        Self { cast, repeats: Repeats::new(watches), distances: Once::NEVER, found: Vec::new() }
    }

    /// Returns all hits, after the traversal, in the order of exact distance and then of primitive.
    pub fn into_hits(self) -> Vec<Hit<Real<K>>> {
        let (PreparedRay { bvh, kernel, .. }, mut found) = (self.cast, self.found);
        // No distance is a NaN.
        found.sort_unstable_by(|(t, prim, place), (other, next, at)| {
            let at_one_distance = || kernel.order((&bvh.shape(*place), *prim), (&bvh.shape(*at), *next));
            t.partial_cmp(other).unwrap_or(Ordering::Equal).then_with(at_one_distance)
        });
        let mut weights = Once::NEVER;
        let hit = |(t, prim, place): (Real<K>, u32, usize)| {
            let [u, v] = weights.answer(&bvh.shape(place), |shape| kernel.weights(shape));
            Hit { prim, t, u, v }
        };
        found.into_iter().map(hit).collect()
    }

    #[inline]
    pub(super) fn meet(&mut self, leaf: Node)
    where
        B: LeafFilter<H, K::Shape, Real<K>>,
    {
        let Self { cast: PreparedRay { bvh, kernel, slabs, end }, repeats, distances, found } = self;
        slabs.for_each_left(bvh, leaf, *end, |place, shape, prim| {
            if let Some(t) = distances.answer(shape, |shape| kernel.distance(shape, Real::<K>::INFINITY))
                && repeats.is_new(prim)
            {
                found.push((t, prim, place));
            }
        });
    }
}

binary_query!([K: Kernel, B: Slabs<Vector = K::Vector>] AllHitsQuery<'_, K, B>, cast.inner);

/// Counts how often a ray crosses a closed mesh, exact: each crossing once, also at edges and corners, and not where
/// the ray only touches. `[PARITY-1]`
///
/// The count is odd if the mesh winds around the ray's origin an odd number of times, as it does around a point inside,
/// and even otherwise, if the ray has no end and its origin is not on the mesh.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::{bvh::Bvh, geom::Ray, generate::stress, trace::Crossings};
/// use stackless_bvh::traverse::{Stack, traverse};
///
/// let mesh = stress::icosphere(2, 1.0, Vec3::ZERO)?;
/// let bvh = Bvh::median(&mesh, 4)?;
/// for (origin, count) in [(Vec3::ZERO, 1), (Vec3::splat(4.0), 2)] {
///     for &corner in mesh.vertices() {
///         let ray = Ray::new(origin, corner - origin)?;
///         let mut crossings = Crossings::new(&bvh, &ray);
///         traverse(Stack::new(&bvh, &mut Vec::new()), &mut crossings, &mut ());
///         assert_eq!(crossings.count() % 2, count % 2);
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Crossings<'a, K: Parity = Exact, B = Directed, H = Bvh<<K as Kernel>::Shape>> {
    pub(super) cast: PreparedRay<'a, K, B, H>,
    repeats: Repeats,
    count: u32,
    /// The sum of senses, if requested.
    winding: Option<i32>,
    /// The watched origin, until a triangle contains it.
    off_surface: Option<K::Vector>,
}

impl<'a> Crossings<'a> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh, ray: &Ray) -> Self {
        Self::over(PreparedRay::new(bvh, ray))
    }
}

impl<'a, K: Parity, B, H: LeafPrimitives<K::Shape>> Crossings<'a, K, B, H> {
    pub(super) fn over(cast: PreparedRay<'a, K, B, H>) -> Self {
        let repeats = Repeats::new(cast.bvh.has_repeats());
        Self { cast, repeats, count: 0, winding: None, off_surface: None }
    }

    /// Prepares the query with signs, for [`winding`](Self::winding), or without.
    pub(super) fn with_signs(self, signed: bool) -> Self {
        Self { winding: signed.then_some(0), ..self }
    }

    /// Prepares the query for a ray from a point that may be on a triangle.
    pub(super) fn watching(self, origin: K::Vector) -> Self {
        Self { off_surface: Some(origin), ..self }
    }

    /// Returns the sum of signs if requested, otherwise the count. `None` if the watched origin is on a triangle with an
    /// area.
    pub(super) fn off_surface(&self) -> Option<i32> {
        self.off_surface.map(|_| self.winding.unwrap_or(self.count as i32))
    }

    /// Returns how often the ray leaves the solid, less how often it enters. This is the winding number of its origin,
    /// if the mesh is closed and oriented, the ray has no end, and its origin is not on the mesh. `[PARITY-1]`
    pub(super) fn winding(&self) -> i32 {
        self.winding.unwrap_or(0)
    }

    /// Returns the number of crossed triangles, after the traversal.
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// Returns whether that number is odd.
    pub const fn is_odd(&self) -> bool {
        self.count() % 2 == 1
    }

    /// Counts the triangles of a leaf. The filter is valid because every crossing is a hit. `[PARITY-1]`
    #[inline]
    pub(super) fn meet(&mut self, leaf: Node)
    where
        B: LeafFilter<H, K::Shape, Real<K>>,
    {
        let Self { cast: PreparedRay { bvh, kernel, slabs, end }, repeats, count, winding, off_surface } = self;
        slabs.for_each_left(bvh, leaf, *end, |_, shape, prim| {
            if let Some(origin) = *off_surface
                && is_on::<K>(origin, shape, bvh.region())
            {
                *off_surface = None;
            }
            if kernel.is_crossing(shape) && repeats.is_new(prim) {
                *count += 1;
                if let Some(sum) = winding {
                    *sum += kernel.sense(shape);
                }
            }
        });
    }
}

binary_query!([K: Parity, B: Slabs<Vector = K::Vector>] Crossings<'_, K, B>, cast.inner);

/// Returns whether a point is on a triangle with an area. The triangle's plane is not parallel to all axes, so a ray of
/// length 0 along one of them hits it.
#[inline]
fn is_on<K: Parity>(point: K::Vector, triangle: &K::Shape, region: &Region) -> bool {
    let ([a, b, c], p) = (triangle.widen(), point.widen());
    // Few triangles are this near.
    a.min(b).min(c).cmple(p).all() && p.cmple(a.max(b).max(c)).all() && touches::<K>(point, triangle, region)
}

#[cold]
fn touches<K: Parity>(point: K::Vector, triangle: &K::Shape, region: &Region) -> bool {
    let zero = Real::<K>::ZERO;
    let rays = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|axis| Ray::within(point, vector(axis), zero, zero));
    rays.iter().flatten().any(|ray| K::new(ray, region).blocks(triangle))
}

/// The triangles that were met so far, if a triangle may be in several leaves.
#[derive(Clone, Debug)]
struct Repeats(Option<HashSet<u32>>);

impl Repeats {
    fn new(watches: bool) -> Self {
        Self(watches.then(HashSet::new))
    }

    /// Returns whether a triangle is met for the first time.
    #[inline]
    fn is_new(&mut self, prim: u32) -> bool {
        self.0.as_mut().is_none_or(|met| met.insert(prim))
    }
}

#[cfg(test)]
mod tests;
