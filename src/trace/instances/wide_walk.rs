//! A ray on its way through the wide hierarchy of a mesh.

use fearless_simd::{Simd, f32x8};
use glam::Vec3;

use super::walk::{Search, Triangles};
use crate::bvh::{LeafTriangle, WideBvh};
use crate::geom::lanes::{Block, EnclosedBoxes, LaneSet, TriangleRay, filled, with_baseline};
use crate::geom::slabs::EnclosedSlabs;
use crate::geom::{EnclosedRay, Real, Triangle, Vector};
use crate::order::Flow;
use crate::trace::tracer::{LaneRanks, with_memory};
use crate::tree::Node;
use crate::wide::{self, Method, Supply, Tables, Topology, Unfit, Wanted};

/// A traversal and its tables. The hierarchy that they were made for comes with each ray.
#[derive(Debug)]
pub(super) struct WideLevel {
    method: Method,
    tables: Tables,
}

impl WideLevel {
    /// Checked once and for all: no ray can fail.
    pub(super) fn new(bvh: &WideBvh, method: Method) -> Result<Self, Unfit> {
        let level = Self { method, tables: Tables::of(method, bvh) };
        // A search that is over at the root: what is unfit is found before the first step.
        level.method.run(bvh, &level.tables, &mut Nothing, &mut ()).map(|()| level)
    }

    /// Bytes of the state of a traversal.
    pub(super) fn state_bytes(&self, bvh: &WideBvh) -> usize {
        self.method.state_bytes::<8>(bvh.levels() as usize)
    }

    /// Traverses the hierarchy with a ray.
    pub(super) fn run<V: Vector>(
        &self,
        bvh: &WideBvh,
        ray: &EnclosedRay,
        triangles: Triangles<'_, V>,
        search: &mut Search<'_, V>,
    ) {
        let slabs = EnclosedSlabs::of(ray, search.tmin(), bvh.region());
        with_baseline!(simd => {
            let boxes = EnclosedBoxes::<_, f32x8<_>, 8>::new(simd, slabs);
            let filter = TriangleRay::enclosed(simd, ray, bvh.region());
            if search.any {
                self.walk(WideWalk::<_, _, true> { simd, bvh, boxes, filter, triangles, search });
            } else {
                self.walk(WideWalk::<_, _, false> { simd, bvh, boxes, filter, triangles, search });
            }
        });
    }

    /// No other wide hierarchy is in one, so the memory of this thread is free.
    fn walk<S: Simd, V: Vector, const ANY: bool>(&self, mut walk: WideWalk<'_, '_, S, V, ANY>) {
        let tree = walk.bvh;
        let ran = with_memory(|[memory, _]| {
            self.method.run_in(Supply { tree, tables: &self.tables, memory }, &mut walk, &mut ())
        });
        // Whether the traversal fits was found when the tracer was made.
        debug_assert_eq!(ran, Ok(()));
    }
}

/// A ray on its way. With `ANY`, the first hit ends it.
struct WideWalk<'s, 'r, S: Simd, V: Vector, const ANY: bool> {
    simd: S,
    bvh: &'s WideBvh,
    boxes: EnclosedBoxes<S, f32x8<S>, 8>,
    filter: TriangleRay<S>,
    triangles: Triangles<'s, V>,
    search: &'s mut Search<'r, V>,
}

impl<S: Simd, V: Vector, const ANY: bool> wide::Search<8> for WideWalk<'_, '_, S, V, ANY> {
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
            let lanes = self.filter.survivors(self.simd, block, self.search.end) & filled;
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

impl<S: Simd, V: Vector, const ANY: bool> WideWalk<'_, '_, S, V, ANY> {
    /// The exact test of these lanes' triangles.
    #[inline(never)]
    fn settle(&mut self, block: &Block, lanes: u32) -> Flow {
        for lane in LaneSet(lanes) {
            let held = LeafTriangle { shape: Triangle(block.triangle(lane).0.map(widened)), prim: block.prims[lane] };
            self.triangles.settle(&held, self.search);
            if self.search.is_over() {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }
}

/// The same point.
#[inline(always)]
fn widened<V: Vector>(v: Vec3) -> V {
    V::from_components(v.to_array().map(|x| V::Real::rounded(x.into())))
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
