//! The visitor of a ray in the wide hierarchy of a mesh.

use std::fmt::Debug;

use fearless_simd::{Simd, f32x8};

use super::nearest::NearTest;
use super::walk::{Search, Triangles};
use super::wide_nearest::WideNear;
use crate::bvh::{LeafTriangle, WideBvh};
use crate::geom::lanes::{Block, EnclosedBoxes, LaneSet, Precision, TriangleRay, filled, with_baseline};
use crate::geom::slabs::EnclosedSlabs;
use crate::geom::{EnclosedRay, Real as _, Region, Triangle, Vector};
use crate::order::Flow;
use crate::trace::memory::with_memory;
use crate::trace::tracer::{LaneRanks, run_shared};
use crate::tree::Node;
use crate::wide::{self, Method, Supply, Tables, Topology, Unsupported, Wanted};

/// A traversal and its tables. Callers pass the hierarchy of these tables with each ray.
#[derive(Debug)]
pub(super) struct WideLevel {
    method: Method,
    tables: Tables,
}

/// A wide hierarchy whose triangles are in the precision of an assembly, or in a lower precision.
pub(super) trait WideObject<V: Vector>: Debug + Send + Sync {
    /// Returns the properties of the whole hierarchy that ray tests need.
    fn region(&self) -> &Region;

    /// Returns the data to traverse it. They are checked once, so tracing is infallible.
    fn level(&self, method: Method) -> Result<WideLevel, Unsupported>;

    /// Returns the bytes of the state of a traversal.
    fn state_bytes(&self, level: &WideLevel) -> usize;

    /// Traverses it with a ray.
    fn run(&self, level: &WideLevel, ray: &EnclosedRay, triangles: Triangles<'_, V>, search: &mut Search<'_, V>);

    /// Traverses it with a point.
    fn run_near(&self, level: &WideLevel, near: &mut dyn NearTest<Triangle<V>>);
}

impl<V: Vector + From<W>, W: Precision> WideObject<V> for WideBvh<8, W> {
    fn region(&self) -> &Region {
        self.region()
    }

    fn level(&self, method: Method) -> Result<WideLevel, Unsupported> {
        let level = WideLevel { method, tables: Tables::of(method, self) };
        // A search that ends at the root detects an unfit traversal before the first step.
        level.method.run(self, &level.tables, &mut Nothing, &mut ()).map(|()| level)
    }

    fn state_bytes(&self, level: &WideLevel) -> usize {
        level.method.state_bytes::<8>(self.levels() as usize)
    }

    fn run(&self, level: &WideLevel, ray: &EnclosedRay, triangles: Triangles<'_, V>, search: &mut Search<'_, V>) {
        let (bvh, slabs) = (self, EnclosedSlabs::of(ray, search.tmin(), self.region()));
        with_baseline!(simd => {
            let boxes = EnclosedBoxes::<_, f32x8<_>, 8>::new(simd, slabs);
            let filter = W::enclosed(simd, ray, bvh.region());
            if search.wanted.is_any() {
                level.walk(WideWalk::<_, _, _, true> { simd, bvh, boxes, filter, triangles, search });
            } else {
                level.walk(WideWalk::<_, _, _, false> { simd, bvh, boxes, filter, triangles, search });
            }
        });
    }

    fn run_near(&self, level: &WideLevel, near: &mut dyn NearTest<Triangle<V>>) {
        let ran = run_shared(level.method, self, &level.tables, &mut WideNear { bvh: self, near });
        debug_assert_eq!(ran, Ok(()));
    }
}

impl WideLevel {
    /// A wide hierarchy contains no other wide hierarchy, so the memory of this thread is free.
    fn walk<S: Simd, V: Vector + From<W>, W: Precision, const ANY: bool>(
        &self,
        mut walk: WideWalk<'_, '_, S, V, W, ANY>,
    ) {
        let tree = walk.bvh;
        let ran = with_memory(|[memory, _]| {
            self.method.run_in(Supply { tree, tables: &self.tables, memory }, &mut walk, &mut ())
        });
        // The constructor has checked that the traversal fits.
        debug_assert_eq!(ran, Ok(()));
    }
}

/// The visitor of a ray. With `ANY`, the first hit ends it.
struct WideWalk<'s, 'r, S: Simd, V: Vector, W: Precision, const ANY: bool> {
    simd: S,
    bvh: &'s WideBvh<8, W>,
    boxes: EnclosedBoxes<S, f32x8<S>, 8>,
    filter: TriangleRay<S, W>,
    triangles: Triangles<'s, V>,
    search: &'s mut Search<'r, V>,
}

impl<S: Simd, V: Vector + From<W>, W: Precision, const ANY: bool> wide::Search<8> for WideWalk<'_, '_, S, V, W, ANY> {
    const SORTED: bool = !ANY;

    type Ranks = LaneRanks<S, f32x8<S>, 8>;

    #[inline(always)]
    fn ask(&mut self, node: Node) -> Wanted<Self::Ranks> {
        let (ranks, set) = self.boxes.enter(&self.bvh.nodes()[node.index()].planes, self.search.end);
        Wanted { set, ranks: LaneRanks::new(ranks) }
    }

    #[inline(always)]
    fn leaf(&mut self, leaf: Node) -> Flow {
        let (blocks, count) = self.bvh.leaf(leaf);
        self.search.counts.triangles += u64::from(count);
        for (block, filled) in filled(blocks, count) {
            let lanes = self.filter.survivors(self.simd, block, self.limit()) & filled;
            if lanes != 0 && self.settle(block, lanes) == Flow::Stop {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }

    #[inline(always)]
    fn end(&self) -> u32 {
        // Without an order nothing is beyond: WIDE-6.
        if ANY { u32::MAX } else { self.search.end.to_bits() }
    }
}

impl<S: Simd, V: Vector + From<W>, W: Precision, const ANY: bool> WideWalk<'_, '_, S, V, W, ANY> {
    /// An upper bound of the distance of the best hit.
    #[inline(always)]
    fn limit(&self) -> W::Real {
        W::Real::rounded(self.search.end.into())
    }

    /// The exact test of these lanes' triangles.
    #[inline(never)]
    fn settle(&mut self, block: &Block<W>, lanes: u32) -> Flow {
        for lane in LaneSet(lanes) {
            let held = LeafTriangle { shape: Triangle(block.triangle(lane).0.map(V::from)), prim: block.prims[lane] };
            self.triangles.settle(&held, self.search);
            if self.search.is_over() {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }
}

/// A search that ends at the root.
struct Nothing;

impl wide::Search<8> for Nothing {
    type Ranks = [u32; 8];

    fn ask(&mut self, _: Node) -> Wanted<[u32; 8]> {
        Wanted { set: 0, ranks: [0; 8] }
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Stop
    }

    fn end(&self) -> u32 {
        0
    }
}
