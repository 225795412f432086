//! Closest hit and any hit in a wide hierarchy.

use std::marker::PhantomData;

use fearless_simd::{Simd, f32x8};

use crate::bvh::{WideBvh, wide::WideTree};
use crate::geom::lanes::{Hits, Lanes, Level, NodeBoxes, Precision, TriangleRay};
use crate::geom::{Ray, Real as _};
use crate::order::Flow;
use crate::trace::Hit;
use crate::tree::Node;
use crate::wide::{Ranks, Search, Tables, Wanted};

/// The kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HitQuery {
    /// The closest hit.
    Closest,
    /// The closest hit; the weights in the answer are 0.
    Distance,
    /// Whether there is a hit; distance and weights in the answer are meaningless.
    Any,
    /// Any hit.
    AnyHit,
}

/// The hierarchy and the kind of query.
#[derive(Clone, Copy)]
pub(super) struct Job<'a, V: Precision> {
    pub(super) bvh: &'a WideBvh<8, V>,
    pub(super) tables: &'a Tables,
    pub(super) level: Level,
    pub(super) ask: HitQuery,
}

/// The state of a ray in a wide hierarchy, exact. With `ANY`, the first hit ends it.
///
/// Nothing points into it, so it can be in registers. The exact test must be in memory, so it is borrowed.
#[derive(Debug)]
pub(super) struct WideSearch<'a, 'm, S: Simd, V: Precision, const ANY: bool> {
    simd: S,
    bvh: &'a WideBvh<8, V>,
    tree: WideTree<'a, 8, V>,
    boxes: V::Boxes<S>,
    filter: TriangleRay<S, V>,
    hits: &'m mut V::Hits<'a>,
    nearest: Nearest<'a, V>,
    /// Boxes that begin beyond it are skipped.
    pub(super) end: f32,
}

type Nearest<'a, V> = <<V as Precision>::Hits<'a> as Hits<'a, V>>::Nearest;

/// A hit of a tracer.
pub(super) type HitOf<V> = Hit<<V as crate::geom::Vector>::Real>;

impl<'a, 'm, S: Simd, V: Precision, const ANY: bool> WideSearch<'a, 'm, S, V, ANY> {
    /// Prepares the search for the ray of `hits`.
    #[inline(always)]
    pub(super) fn new(simd: S, bvh: &'a WideBvh<8, V>, tree: WideTree<'a, 8, V>, hits: &'m mut V::Hits<'a>) -> Self {
        let (boxes, filter, nearest) = (V::Boxes::new(simd, hits.ray(), bvh.region()), hits.filter(simd), hits.none());
        let end = boxes.end(V::Hits::end(&nearest));
        Self { simd, bvh, tree, boxes, filter, hits, nearest, end }
    }

    /// Prepares the search for another ray.
    #[inline(always)]
    pub(super) fn with_ray(self, ray: &'a Ray<V>) -> Self {
        *self.hits = V::Hits::new(ray, self.bvh.region());
        Self::new(self.simd, self.bvh, self.tree, self.hits)
    }

    /// Returns the requested answer, after the traversal.
    #[inline(always)]
    pub(super) fn answer(&mut self, ask: HitQuery) -> Option<HitOf<V>> {
        let prim = V::Hits::prim(&self.nearest)?;
        let zero = V::Real::ZERO;
        match ask {
            HitQuery::Any => Some(Hit { prim, t: zero, u: zero, v: zero }),
            HitQuery::Distance => Some(Hit { prim, t: self.hits.distance(self.simd, self.nearest), u: zero, v: zero }),
            HitQuery::Closest | HitQuery::AnyHit => {
                let (t, [u, v]) = self.hits.whole(self.simd, self.nearest)?;
                Some(Hit { prim, t, u, v })
            }
        }
    }
}

impl<S: Simd, V: Precision, const ANY: bool> Search<8> for WideSearch<'_, '_, S, V, ANY> {
    const SORTED: bool = !ANY;
    type Ranks = LaneRanks<S, f32x8<S>, 8>;

    #[inline(always)]
    fn ask(&mut self, node: Node) -> Wanted<Self::Ranks> {
        let node = &self.tree.nodes[node.index()];
        let (ranks, set) = self.boxes.enter(&node.planes, self.end);
        Wanted { set, ranks: LaneRanks::new(ranks) }
    }

    #[inline(always)]
    fn leaf(&mut self, leaf: Node) -> Flow {
        let (blocks, count) = self.tree.leaf(leaf);
        if ANY {
            let Some(hit) = self.hits.any(self.simd, &self.filter, blocks, count) else { return Flow::Continue };
            self.nearest = hit;
            return Flow::Stop;
        }
        let before = V::Hits::end(&self.nearest);
        self.nearest = self.hits.nearest(self.simd, &self.filter, blocks, count, self.nearest);
        let end = V::Hits::end(&self.nearest);
        if end < before {
            self.end = self.boxes.end(end);
        }
        Flow::Continue
    }

    #[inline(always)]
    fn end(&self) -> u32 {
        // Without an order nothing is beyond: WIDE-6.
        if ANY { u32::MAX } else { self.end.to_bits() }
    }
}

/// The ranks of a node's boxes. `[LANES-2]`
#[derive(Clone, Copy, Debug)]
pub(in crate::trace) struct LaneRanks<S, V, const A: usize> {
    ranks: V,
    simd: PhantomData<S>,
}

impl<S, V, const A: usize> LaneRanks<S, V, A> {
    #[inline(always)]
    pub(in crate::trace) const fn new(ranks: V) -> Self {
        Self { ranks, simd: PhantomData }
    }
}

impl<S: Simd, V: Lanes<S, A>, const A: usize> Ranks<A> for LaneRanks<S, V, A> {
    #[inline(always)]
    fn all(self) -> [u32; A] {
        self.ranks.as_array().map(f32::to_bits)
    }
}
