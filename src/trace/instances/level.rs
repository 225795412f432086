//! One object with what a traversal of it needs.

use crate::bvh::Bvh;
use crate::geom::Aabb;
use crate::order::{Descent, Flow, NodeTest, Visitor};
use crate::trace::{Ask, Part, Plan, Query};
use crate::traverse::{Method, Tables, Unfit, WordName};
use crate::tree::{Implicit, Node, Topology};

/// A hierarchy with the tables of a traversal.
#[derive(Debug)]
pub(super) struct Level<'a, S> {
    pub(super) bvh: &'a Bvh<S>,
    method: Method,
    word: WordName,
    tables: Tables<'a, Bvh<S>>,
    /// Each node's own box, for the traversals that test it.
    pub(super) boxes: Vec<Aabb>,
}

impl<'a, S> Level<'a, S> {
    /// Tables and words as narrow as the hierarchy allows.
    pub(super) fn new(bvh: &'a Bvh<S>, method: Method) -> Result<Self, Unfit> {
        let plan = Plan::new(bvh, method, Ask::Hit);
        let boxes = if plan.skips(Part::OwnBoxes) { Vec::new() } else { bvh.own_boxes() };
        let tables = Tables::new(bvh, bvh.axes(), &[method], Implicit::LIMIT);
        let level = Self { bvh, method, word: plan.word(), tables, boxes };
        // A search that is over at the root: what is unfit is found before the first step.
        level.run(0, &mut Vec::new(), &mut Nothing).map(|()| level)
    }

    /// Bytes of the state of a traversal.
    pub(super) fn state_bytes(&self) -> usize {
        self.method.state_bytes_in(self.word, self.bvh.depth())
    }

    /// Runs a query, in a copy of the traversals that is compiled for it if the keys are short.
    #[inline]
    pub(super) fn run<Q: Query>(&self, octant: u8, memory: &mut Vec<Node>, query: &mut Q) -> Result<(), Unfit> {
        match self.word {
            WordName::U32 => self.tables.run::<u32, _>(self.method, octant, memory, query, &mut ()),
            WordName::U64 => self.tables.run::<u64, _>(self.method, octant, memory, query, &mut ()),
            WordName::U128 | WordName::Grow => {
                let mut query: &mut dyn Query = query;
                self.tables.run_in(self.word, self.method, octant, memory, &mut query, &mut ())
            }
        }
    }
}

/// A query that ends at the root.
struct Nothing;

impl Visitor for Nothing {
    fn inner(&mut self, _: Node) -> Descent {
        Descent::NEITHER
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Stop
    }
}

impl NodeTest for Nothing {
    fn accept(&mut self, _: Node) -> bool {
        false
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Stop
    }
}
