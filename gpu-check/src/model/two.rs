//! The search of `search_ray.wgsl`.

use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::Ray;
use stackless_bvh::order::{Descent, Flow, Pruned, Pruning, Side, Visitor};
use stackless_bvh::traverse::{PruningStack, Stack, traverse, traverse_pruned};
use stackless_bvh::tree::Node;

use super::{Found, OfRay};
use crate::probe::Arithmetic;

/// The search of a ray through a hierarchy of two children.
#[derive(Debug)]
pub struct Model<'a> {
    of: OfRay<'a>,
    bvh: &'a Bvh,
    any: bool,
    leaf: Option<Node>,
}

impl<'a> Model<'a> {
    /// The result of a ray with this pruning, for a closest-hit or any-hit query.
    pub fn trace(arithmetic: &'a Arithmetic, bvh: &'a Bvh, ray: &Ray, pruning: Pruning, any: bool) -> Found {
        let mut model = Self { of: OfRay::new(arithmetic, ray), bvh, any, leaf: None };
        let mut memory = Vec::new();
        let (search, recorder) = (&mut model, &mut ());
        match pruning {
            Pruning::Never => traverse(Stack::new(bvh, &mut memory), search, recorder),
            Pruning::Disjoint => traverse_pruned(PruningStack::<_, false>::new(bvh, &mut memory), search, recorder),
            Pruning::Distance => traverse_pruned(PruningStack::<_, true>::new(bvh, &mut memory), search, recorder),
        };
        model.of.found
    }

    fn slab(&self, node: Node, side: Side) -> [f32; 2] {
        let aabb = self.bvh.node(node.index()).child_box(side);
        self.of.slab(|axis| [aabb.lo[axis], aabb.hi[axis]])
    }

    fn slabs(&self, node: Node) -> [[f32; 2]; 2] {
        [Side::Left, Side::Right].map(|side| self.slab(node, side))
    }

    fn prefers_right(&self, [left, right]: [[f32; 2]; 2]) -> bool {
        !self.any && right[0] < left[0]
    }
}

impl Visitor for Model<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let slabs = self.slabs(node);
        let [left, right] = slabs.map(|[near, far]| near <= far);
        Descent::new(left, right, self.prefers_right(slabs))
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        let bvh = self.bvh;
        for held in bvh.leaf_triangles(leaf) {
            if self.of.meets(&held.shape, held.prim) {
                self.leaf = Some(leaf);
                if self.any {
                    return Flow::Stop;
                }
            }
        }
        Flow::Continue
    }
}

impl Pruned for Model<'_> {
    fn allows(&self, _: Pruning) -> bool {
        true
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let slabs = self.slabs(node);
        let right = self.prefers_right(slabs);
        let [first, second] = if right { [slabs[1], slabs[0]] } else { slabs };
        self.inner(node).disjoint_if(first[1] < second[0])
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.leaf == Some(leaf)
    }

    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        let [near, _] = self.slab(node, descent.first().other());
        near.to_bits()
    }

    fn end(&self) -> u32 {
        self.of.found.t.to_bits()
    }
}
