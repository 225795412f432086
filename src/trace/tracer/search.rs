//! Closest hit and any hit in a wide hierarchy.

use std::marker::PhantomData;

use fearless_simd::Simd;

use super::turns::Ask;
use crate::bvh::{WideBvh, wide::WideTree};
use crate::geom::lanes::{BoxRay, Lanes, LazyExact, Nearest, TriangleRay};
use crate::geom::{Kernel, Ray};
use crate::order::Flow;
use crate::trace::Hit;
use crate::tree::Node;
use crate::wide::{Ranks, Search, Wanted};

/// A ray on its way through a wide hierarchy, exact. With `ANY`, the first hit ends it.
///
/// Nothing points into it, so that it can be in registers. The exact test has to be in memory, so it is borrowed.
#[derive(Debug)]
pub(super) struct WideSearch<'a, 'm, S: Simd, V: Lanes<S, A>, const A: usize, const ANY: bool> {
    simd: S,
    bvh: &'a WideBvh<A>,
    tree: WideTree<'a, A>,
    boxes: BoxRay<S, V, A>,
    filter: TriangleRay<S>,
    exact: &'m mut LazyExact<'a>,
    best: Nearest,
}

impl<'a, 'm, S: Simd, V: Lanes<S, A>, const A: usize, const ANY: bool> WideSearch<'a, 'm, S, V, A, ANY> {
    /// For the ray of `exact`.
    #[inline(always)]
    pub(super) fn new(simd: S, bvh: &'a WideBvh<A>, tree: WideTree<'a, A>, exact: &'m mut LazyExact<'a>) -> Self {
        let (ray, region) = (exact.ray(), bvh.region());
        Self {
            simd,
            bvh,
            tree,
            boxes: BoxRay::new(simd, ray, region),
            filter: TriangleRay::new(simd, ray, region),
            exact,
            best: Nearest::none(ray),
        }
    }

    /// The same for another ray.
    #[inline(always)]
    pub(super) fn with_ray(self, ray: &'a Ray) -> Self {
        *self.exact = LazyExact::new(ray, self.bvh.region());
        Self::new(self.simd, self.bvh, self.tree, self.exact)
    }

    /// After the traversal: what was asked for.
    #[inline(always)]
    pub(super) fn answer(&mut self, ask: Ask) -> Option<Hit> {
        let Nearest { prim, t } = self.best;
        match ask {
            _ if !self.best.is_some() => None,
            Ask::Distance | Ask::Any => Some(Hit { prim, t, u: 0.0, v: 0.0 }),
            Ask::Closest | Ask::AnyHit => whole::<ANY>(self.exact, self.best),
        }
    }
}

/// The hit with its weights.
#[inline(never)]
fn whole<const ANY: bool>(exact: &mut LazyExact<'_>, Nearest { prim, t }: Nearest) -> Option<Hit> {
    let shape = exact.found()?;
    let exact = exact.get();
    let t = if ANY { exact.distance(&shape, f32::INFINITY)? } else { t };
    let [u, v] = exact.weights(&shape);
    Some(Hit { prim, t, u, v })
}

impl<S: Simd, V: Lanes<S, A>, const A: usize, const ANY: bool> Search<A> for WideSearch<'_, '_, S, V, A, ANY> {
    const SORTED: bool = !ANY;
    type Ranks = LaneRanks<S, V, A>;

    #[inline(always)]
    fn ask(&mut self, node: Node) -> Wanted<Self::Ranks> {
        let node = &self.tree.nodes[node.index()];
        let (ranks, set) = self.boxes.enter(&node.planes, self.best.t);
        Wanted { set, ranks: LaneRanks::new(ranks) }
    }

    #[inline(always)]
    fn leaf(&mut self, leaf: Node) -> Flow {
        let (blocks, count) = self.tree.leaf(leaf);
        if ANY {
            let Some(prim) = self.exact.any(self.simd, &self.filter, blocks, count) else { return Flow::Continue };
            self.best.prim = prim;
            return Flow::Stop;
        }
        self.best = self.exact.nearest(self.simd, &self.filter, blocks, count, self.best);
        Flow::Continue
    }

    #[inline(always)]
    fn end(&self) -> u32 {
        // Without an order nothing is beyond: WIDE-6.
        if ANY { u32::MAX } else { self.best.t.to_bits() }
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
