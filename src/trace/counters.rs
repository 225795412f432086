//! Counted costs of queries.

use std::borrow::Borrow;

use crate::bvh::Bvh;
use crate::event::Backtracks;
use crate::geom::kernel::Stage;
use crate::geom::{Aabb, Kernel, Ray, Slabs};
use crate::order::{Descent, Flow, NodeTest, Pruned, Pruning, Repeatable, Visitor};
use crate::threads;
use crate::tree::{Node, Reach};

use super::ray_queries::CHUNK;
use super::{BinaryTracer, BoxQuery, ChildOrder, FromLeft, Nearest, NodeSearch};

/// Counts over many rays. They cost nothing for other queries: counting queries run in a separate copy of the
/// traversals.
#[derive(Clone, Debug)]
pub struct Counters {
    /// Rays.
    pub rays: u64,
    /// Visits of inner nodes. Traversals that test nodes at their own visits also visit those that the ray misses.
    pub inner: u64,
    /// Visits of leaves whose box the ray meets.
    pub leaves: u64,
    /// Box tests.
    pub boxes: u64,
    /// Triangle tests.
    pub triangles: u64,
    /// Triangle tests that the error bounds for the whole scene leave undecided, whether or not a filter rejects the
    /// triangles before.
    pub fallbacks: u64,
    /// Undecided tests that needed exact sums.
    pub sums: u64,
    /// Backtracks by distance and by the source of the address, if the traversal has key and trail.
    pub backtracks: Backtracks,
}

/// Counts over many rays in a hierarchy of eight children.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WideCounters {
    /// Rays.
    pub rays: u64,
    /// Number of inner nodes whose boxes were tested, all boxes of a node at once. Some traversals test them again when
    /// they return to a node.
    pub nodes: u64,
    /// Visits of leaves.
    pub leaves: u64,
    /// Triangles in these leaves.
    pub triangles: u64,
}

impl Default for Counters {
    fn default() -> Self {
        let backtracks = Backtracks::new(Reach::ALGORITHM_1);
        Self { rays: 0, inner: 0, leaves: 0, boxes: 0, triangles: 0, fallbacks: 0, sums: 0, backtracks }
    }
}

impl Counters {
    /// Returns the sums of the two counters.
    #[must_use]
    pub fn merge(self, other: &Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            inner: self.inner + other.inner,
            leaves: self.leaves + other.leaves,
            boxes: self.boxes + other.boxes,
            triangles: self.triangles + other.triangles,
            fallbacks: self.fallbacks + other.fallbacks,
            sums: self.sums + other.sums,
            backtracks: self.backtracks.merge(&other.backtracks),
        }
    }
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> BinaryTracer<T, K, B> {
    /// Counts the cost of each ray's closest hit. Not for timing.
    pub fn count_closest(&self, rays: &[Ray<K::Vector>]) -> Counters {
        self.count::<false, Nearest>(rays)
    }

    /// Counts the cost of each ray's any-hit query.
    pub fn count_any(&self, rays: &[Ray<K::Vector>]) -> Counters {
        self.count::<true, FromLeft>(rays)
    }

    fn count<const ANY: bool, O: ChildOrder>(&self, rays: &[Ray<K::Vector>]) -> Counters {
        let (bvh, level) = (self.bvh(), &self.level);
        let count = |chunk: &[Ray<K::Vector>]| {
            let (mut counters, mut memory) = (Counters::default(), Vec::new());
            let mut backtracks = Backtracks::new(Reach::ALGORITHM_1);
            for ray in chunk {
                counters.rays += 1;
                backtracks.begin();
                let mut query = Counting::<K, B, ANY, O>::new(bvh, &level.boxes, ray, &mut counters);
                level.run_counted(bvh.tree(), ray.octant(), &mut memory, &mut query, &mut backtracks);
            }
            Counters { backtracks, ..counters }
        };
        threads::reduce(rays, CHUNK, count, |a, b| a.merge(&b)).unwrap_or_default()
    }
}

/// A search that counts.
pub(super) struct Counting<'a, 'c, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O> {
    pub(super) search: NodeSearch<'a, K, B, ANY, O>,
    /// Also for triangles that a filter rejects, to determine their stages: so counts are equal on all machines.
    kernel: K,
    counters: &'c mut Counters,
}

impl<'a, 'c, K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Counting<'a, 'c, K, B, ANY, O> {
    pub(super) fn new(
        bvh: &'a Bvh<K::Shape>,
        boxes: &'a [Aabb],
        ray: &Ray<K::Vector>,
        counters: &'c mut Counters,
    ) -> Self {
        Self { search: NodeSearch::new(bvh, boxes, ray), kernel: K::new(ray, bvh.region()), counters }
    }

    fn triangles(&mut self, leaf: Node) -> Flow {
        let Self { search, kernel, counters } = self;
        counters.leaves += 1;
        search.query.leaf_watched(leaf, |shape| {
            let stage = kernel.stage(shape);
            counters.triangles += 1;
            counters.fallbacks += u64::from(stage > Stage::Scene);
            counters.sums += u64::from(stage > Stage::Triangle);
        })
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Visitor
    for Counting<'_, '_, K, B, ANY, O>
{
    fn inner(&mut self, node: Node) -> Descent {
        self.counters.inner += 1;
        self.counters.boxes += 2;
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.triangles(node)
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Pruned
    for Counting<'_, '_, K, B, ANY, O>
{
    fn allows(&self, pruning: Pruning) -> bool {
        self.search.allows(pruning)
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        self.counters.inner += 1;
        self.counters.boxes += 2;
        self.search.inner_marked(node)
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.search.found_at(leaf)
    }

    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        self.search.postponed(node, descent)
    }

    fn end(&self) -> u32 {
        self.search.end()
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> BoxQuery
    for Counting<'_, '_, K, B, ANY, O>
{
    fn touches(&self, aabb: &Aabb) -> bool {
        self.search.touches(aabb)
    }

    fn slot(&self, node: Node) -> usize {
        self.search.slot(node)
    }
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> Repeatable
    for Counting<'_, '_, K, B, ANY, O>
{
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, const ANY: bool, O: ChildOrder> NodeTest
    for Counting<'_, '_, K, B, ANY, O>
{
    fn accept(&mut self, node: Node) -> bool {
        self.counters.inner += 1;
        self.counters.boxes += 1;
        self.search.accept(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.counters.boxes += 1;
        if self.search.accept(node) { self.triangles(node) } else { Flow::Continue }
    }
}
