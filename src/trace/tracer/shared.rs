//! The rare queries: all hits, the next hit, crossings, and nearest points. As in binary hierarchies, they share one
//! copy of the traversals.

use fearless_simd::{Simd, SimdBase, f32x8};

use super::LaneRanks;
use super::search::{HitOf, HitQuery, Job, WideSearch};
use crate::bvh::WideBvh;
use crate::bvh::wide::leaf_places;
use crate::geom::lanes::{BoxPoint, Hits as _, LaneSet, NodeBoxes as _, Precision, TriangleRay, filled, with_baseline};
use crate::geom::{Ray, Triangle};
use crate::order::Flow;
use crate::trace::counters::WideCounters;
use crate::trace::filter::FilteredQuery;
use crate::trace::leaf_primitives::LeafFilter;
use crate::trace::memory::with_memory;
use crate::trace::nearest::Around;
use crate::trace::prepared_ray::PreparedRay;
use crate::trace::{AllHitsQuery, Crossings, NearestPoint, NearestPoints, NextHitQuery};
use crate::tree::Node;
use crate::wide::{Method, Ranks, Search, Supply, Tables, Unsupported, Wanted};

/// A query for any traversal. As `&mut dyn Query` it is one type for all kinds.
pub(in crate::trace) trait Query {
    /// Returns the children of an inner node that it wants, with the distances of their boxes.
    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]>;

    /// Tests the triangles of a leaf.
    fn leaf(&mut self, leaf: Node);

    /// Returns the distance beyond which boxes are skipped.
    fn end(&self) -> f32;
}

/// Runs a query to its end.
pub(in crate::trace) fn run<V: Precision>(
    method: Method,
    tree: &WideBvh<8, V>,
    tables: &Tables,
    query: &mut dyn Query,
) -> Result<(), Unsupported> {
    with_memory(|[memory, _]| method.run_in(Supply { tree, tables, memory }, &mut Shared(query), &mut ()))
}

/// Checks that a traversal fits a hierarchy.
pub(super) fn check<V: Precision>(method: Method, Job { bvh, tables, .. }: Job<'_, V>) -> Result<(), Unsupported> {
    run(method, bvh, tables, &mut Nothing)
}

/// Finds the closest hit of a ray, or any hit.
pub(super) fn trace<V: Precision>(
    method: Method,
    job: Job<'_, V>,
    ray: &Ray<V>,
) -> Result<Option<HitOf<V>>, Unsupported> {
    match job.ask {
        HitQuery::Closest | HitQuery::Distance => trace_by::<V, false>(method, job, ray),
        HitQuery::Any | HitQuery::AnyHit => trace_by::<V, true>(method, job, ray),
    }
}

fn trace_by<V: Precision, const ANY: bool>(
    method: Method,
    Job { bvh, tables, ask, .. }: Job<'_, V>,
    ray: &Ray<V>,
) -> Result<Option<HitOf<V>>, Unsupported> {
    let mut hits = V::Hits::new(ray, bvh.region());
    with_baseline!(simd => {
        let mut search = WideSearch::<_, V, ANY>::new(simd, bvh, bvh.tree(), &mut hits);
        run(method, bvh, tables, &mut search)?;
        Ok(search.answer(ask))
    })
}

impl<S: Simd, V: Precision, const ANY: bool> Query for WideSearch<'_, '_, S, V, ANY> {
    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
        let Wanted { set, ranks } = Search::ask(self, node);
        Wanted { set, ranks: ranks.all() }
    }

    fn leaf(&mut self, leaf: Node) {
        if Search::leaf(self, leaf) == Flow::Stop {
            self.end = 0.0;
        }
    }

    fn end(&self) -> f32 {
        self.end
    }
}

/// A query that wants no box.
struct Nothing;

impl Query for Nothing {
    fn ask(&mut self, _: Node) -> Wanted<[u32; 8]> {
        Wanted { set: 0, ranks: [0; 8] }
    }

    fn leaf(&mut self, _: Node) {}

    fn end(&self) -> f32 {
        0.0
    }
}

/// A query with counts.
pub(super) struct Counted<'q, 'c>(pub(super) &'q mut dyn Query, pub(super) &'c mut WideCounters);

impl Query for Counted<'_, '_> {
    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
        self.1.nodes += 1;
        self.0.ask(node)
    }

    fn leaf(&mut self, leaf: Node) {
        self.1.leaves += 1;
        self.1.triangles += leaf_places(leaf).len() as u64;
        self.0.leaf(leaf);
    }

    fn end(&self) -> f32 {
        self.0.end()
    }
}

struct Shared<'q>(&'q mut dyn Query);

impl Search<8> for Shared<'_> {
    type Ranks = [u32; 8];

    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
        self.0.ask(node)
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.0.leaf(leaf);
        Flow::Continue
    }

    fn end(&self) -> u32 {
        // -0 becomes 0.
        (self.0.end() + 0.0).to_bits()
    }
}

/// A ray prepared for the boxes of a node, and for the filter of a block.
#[derive(Clone, Debug)]
pub(super) struct LaneRay<S: Simd, V: Precision> {
    simd: S,
    boxes: V::Boxes<S>,
    filter: TriangleRay<S, V>,
}

/// A ray with its tests of boxes and triangles of a wide hierarchy.
type WidePreparedRay<'a, S, V> = PreparedRay<'a, <V as Precision>::Exact, LaneRay<S, V>, WideBvh<8, V>>;

impl<S: Simd, V: Precision> LaneRay<S, V> {
    pub(super) fn new(simd: S, ray: &Ray<V>, bvh: &WideBvh<8, V>) -> Self {
        let region = bvh.region();
        Self { simd, boxes: V::Boxes::new(simd, ray, region), filter: V::Hits::new(ray, region).filter(simd) }
    }
}

/// `[LANES-3]` `[LANES-4]`
impl<S: Simd, V: Precision> LeafFilter<WideBvh<8, V>, Triangle<V>, V::Real> for LaneRay<S, V> {
    fn for_each_left(
        &self,
        bvh: &WideBvh<8, V>,
        leaf: Node,
        end: V::Real,
        mut show: impl FnMut(usize, &Triangle<V>, u32),
    ) {
        let (blocks, count) = bvh.leaf(leaf);
        let first = leaf_places(leaf).start;
        for (i, (block, filled)) in filled(blocks, count).enumerate() {
            for lane in LaneSet(self.filter.survivors(self.simd, block, end) & filled) {
                show(first + 4 * i + lane, &block.triangle(lane), block.prims[lane]);
            }
        }
    }
}

impl<S: Simd, V: Precision> WidePreparedRay<'_, S, V> {
    /// Returns the children that the ray meets. `[LANES-2]`
    pub(super) fn ask(&self, node: Node) -> Wanted<[u32; 8]> {
        let (ranks, set) = self.slabs.boxes.enter(&self.bvh.nodes()[node.index()].planes, self.box_end());
        Wanted { set, ranks: LaneRanks::<S, f32x8<S>, 8>::new(ranks).all() }
    }

    fn box_end(&self) -> f32 {
        self.slabs.boxes.end(self.end) + 0.0
    }
}

impl<V: Precision> Around<'_, WideBvh<8, V>, V> {
    /// Returns the children that are near enough. `[NEAR-4]`
    fn ask(&self, node: Node) -> Wanted<[u32; 8]> {
        let planes = &self.bvh.nodes()[node.index()].planes;
        with_baseline!(simd => {
            let (ranks, set) = BoxPoint::<_, f32x8<_>, 8>::new(simd, self.measure().ends_in_frame()).within(planes, self.end());
            let ranks: &[f32; 8] = ranks.as_array();
            let set = if self.is_settled_below(node, ranks, set) { 0 } else { set };
            Wanted { set, ranks: ranks.map(f32::to_bits) }
        })
    }

    /// Returns whether no triangle in these slots, or below them, is relevant. `[NEAR-6]`
    fn is_settled_below(&self, node: Node, ranks: &[f32; 8], set: u32) -> bool {
        // Ranks omit the last bits, and more of a subnormal distance.
        const OFF: f64 = 64.0 * f32::EPSILON as f64;
        const LEAST: f32 = f32::from_bits(16);
        let record = &self.bvh.nodes()[node.index()];
        let mut slots = (0..8).filter(|slot| set >> slot & 1 == 1);
        let distance = |slot: u32| self.measure().out_of_frame(ranks[slot as usize] + LEAST);
        slots.clone().all(|slot| self.is_about_limit(distance(slot), OFF))
            && slots.all(|slot| self.is_settled(self.to_box(&record.child_box(slot)), record.child(slot)))
    }
}

impl<S: Simd, V: Precision> Query for FilteredQuery<'_, V::Exact, LaneRay<S, V>, WideBvh<8, V>> {
    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
        self.pending().map_or(Nothing.ask(node), |cast| cast.ask(node))
    }

    fn leaf(&mut self, leaf: Node) {
        self.meet(leaf);
    }

    fn end(&self) -> f32 {
        self.pending().map_or(0.0, WidePreparedRay::box_end)
    }
}

/// Implements a query that delegates to one of its fields.
macro_rules! query {
    ($([$($generic:tt)*] $query:ty, $field:ident: $end:ident;)*) => {$(
        impl<$($generic)*> Query for $query {
            fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
                self.$field.ask(node)
            }

            fn leaf(&mut self, leaf: Node) {
                self.meet(leaf);
            }

            fn end(&self) -> f32 {
                self.$field.$end()
            }
        }
    )*};
}
query! {
    [S: Simd, V: Precision] AllHitsQuery<'_, V::Exact, LaneRay<S, V>, WideBvh<8, V>>, cast: box_end;
    [S: Simd, V: Precision] NextHitQuery<'_, V::Exact, LaneRay<S, V>, WideBvh<8, V>>, cast: box_end;
    [S: Simd, V: Precision] Crossings<'_, V::Exact, LaneRay<S, V>, WideBvh<8, V>>, cast: box_end;
    [V: Precision] NearestPoint<'_, WideBvh<8, V>, V>, around: end;
    [V: Precision] NearestPoints<'_, WideBvh<8, V>, V>, around: end;
}
