//! The next hit after a given one.

use std::cmp::Ordering;

use super::Hit;
use super::leaf_primitives::{LeafFilter, LeafPrimitives};
use super::prepared_ray::PreparedRay;
use super::query::binary_query;
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Kernel, Ray, Real as _, Slabs, Vector};
use crate::order::Repeatable;
use crate::tree::Node;

/// The state of a ray that searches a hierarchy `H` for the first hit after a given one, in the order of exact distance
/// and then of primitive. `[EXACT-13]`
///
/// The given one is the hit of a triangle at a rounded distance. If the ray does not hit the triangle at that distance,
/// it is the distance itself.
#[derive(Clone, Debug)]
pub struct NextHitQuery<'a, K: Kernel, B, H = Bvh<<K as Kernel>::Shape>> {
    /// It ends at the best hit that is farther after rounding.
    pub(super) cast: PreparedRay<'a, K, B, H>,
    after: (Real<K>, u32),
    /// The place of the given triangle in the hierarchy, once it is met at the given distance.
    start: Option<usize>,
    /// The other hits at the given distance.
    level: Vec<Met>,
    /// The best hit that is farther.
    farther: Option<Met>,
}

/// A hit triangle, and its place in the hierarchy.
#[derive(Clone, Copy, Debug)]
struct Met {
    prim: u32,
    place: usize,
}

impl<'a, K: Kernel, B: Slabs<Vector = K::Vector>> NextHitQuery<'a, K, B> {
    /// Prepares a query.
    pub fn new(bvh: &'a Bvh<K::Shape>, ray: &Ray<K::Vector>, after: (Real<K>, u32)) -> Self {
        let slabs = B::new(&rest(ray, after.0), bvh.region());
        Self::over(PreparedRay::with(bvh, ray, slabs), after)
    }
}

/// Returns the part of a ray for box tests: boxes that end before the given hit are skipped. The hit's distance is
/// rounded, and the exact distance is greater than the previous float. Triangles are tested with the ray itself.
pub(super) fn rest<V: Vector>(ray: &Ray<V>, after: V::Real) -> Ray<V> {
    let start = after.next_down();
    let start = if start > ray.tmin() { start } else { ray.tmin() };
    Ray::within(ray.origin(), ray.direction(), start, ray.tmax()).unwrap_or(*ray)
}

impl<'a, K: Kernel, B, H: LeafPrimitives<K::Shape>> NextHitQuery<'a, K, B, H> {
    /// Prepares a query; its box test must be for the [`rest`] of the ray.
    pub(super) const fn over(cast: PreparedRay<'a, K, B, H>, after: (Real<K>, u32)) -> Self {
        Self { cast, after, start: None, level: Vec::new(), farther: None }
    }

    /// Returns the hit, after the traversal.
    pub fn hit(&self) -> Option<Hit<Real<K>>> {
        let PreparedRay { bvh, kernel, end, .. } = &self.cast;
        let at_level = self.level.iter().filter(|met| self.is_after(met));
        let of_level = at_level.min_by(|a, b| self.order(a, b)).map(|met| (met, self.after.0));
        let (&Met { prim, place }, t) = of_level.or_else(|| Some((self.farther.as_ref()?, *end)))?;
        let [u, v] = kernel.weights(&bvh.shape(place));
        Some(Hit { prim, t, u, v })
    }

    fn order(&self, a: &Met, b: &Met) -> Ordering {
        let PreparedRay { bvh, kernel, .. } = &self.cast;
        order(*bvh, kernel, a, b)
    }

    /// Returns whether a hit at the given distance comes after the given hit.
    fn is_after(&self, met: &Met) -> bool {
        let (t, prim) = self.after;
        let order = match self.start {
            Some(place) => self.order(met, &Met { prim, place }),
            None => self.cast.kernel.compare_with(&self.cast.bvh.shape(met.place), t).then(met.prim.cmp(&prim)),
        };
        order.is_gt()
    }

    #[inline]
    pub(super) fn meet(&mut self, leaf: Node)
    where
        B: LeafFilter<H, K::Shape, Real<K>>,
    {
        let Self { cast: PreparedRay { bvh, kernel, slabs, end }, after, start, level, farther } = self;
        slabs.for_each_left(bvh, leaf, *end, |place, shape, prim| {
            let Some(t) = kernel.distance(shape, *end) else { return };
            let (met, (given, given_prim)) = (Met { prim, place }, *after);
            if t == given && prim == given_prim {
                *start = Some(place);
            } else if t == given {
                level.push(met);
            } else if t > given
                && farther.map_or(t <= *end, |best| t < *end || order(*bvh, kernel, &met, &best).is_lt())
            {
                (*end, *farther) = (t, Some(met));
            }
        });
    }
}

/// Compares two hits at one rounded distance.
fn order<K: Kernel, H: LeafPrimitives<K::Shape>>(bvh: &H, kernel: &K, a: &Met, b: &Met) -> Ordering {
    kernel.order((&bvh.shape(a.place), a.prim), (&bvh.shape(b.place), b.prim))
}

binary_query!([K: Kernel, B: Slabs<Vector = K::Vector>] NextHitQuery<'_, K, B>, cast.inner);

impl<K: Kernel, B: Slabs<Vector = K::Vector>> Repeatable for NextHitQuery<'_, K, B> {}
