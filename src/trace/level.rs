//! A hierarchy with what queries on it need besides.

use super::{Part, Plan, Query};
use crate::bvh::Bvh;
use crate::event::Recorder;
use crate::geom::Aabb;
use crate::order::{Descent, Flow, NodeTest, Pruned, Pruning, Visitor};
use crate::traverse::{Method, Tables, Unfit, WordName};
use crate::tree::{Implicit, Node, Topology};

/// A hierarchy, a traversal and its tables.
pub(super) struct Level<'a, S> {
    pub(super) bvh: &'a Bvh<S>,
    pub(super) method: Method,
    pub(super) word: WordName,
    pub(super) tables: Tables<'a, Bvh<S>>,
    /// Each node's own box, for the traversals that test it.
    pub(super) boxes: Vec<Aabb>,
}

impl<'a, S> Level<'a, S> {
    /// What a plan says, which must be for this hierarchy.
    pub(super) fn new(bvh: &'a Bvh<S>, plan: &Plan) -> Result<Self, Unfit> {
        let level = Self::unchecked(bvh, plan);
        // A search that is over at the root: what is unfit is found before the first step.
        level.try_run(0, &mut Vec::new(), &mut Nothing, &mut ()).map(|()| level)
    }

    pub(super) fn unchecked(bvh: &'a Bvh<S>, plan: &Plan) -> Self {
        let (method, word) = (plan.method(), plan.word());
        let boxes = if plan.skips(Part::OwnBoxes) { Vec::new() } else { bvh.own_boxes() };
        let others: &[Method] = if plan.skips(Part::OtherTables) { &[] } else { &Method::ALL };
        let tables = Tables::new(bvh, bvh.axes(), &[&[method], others].concat(), Implicit::LIMIT);
        Self { bvh, method, word, tables, boxes }
    }

    /// Memory of the tables, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.tables.bytes() + size_of_val(&*self.boxes)
    }

    /// Bytes of the state of a traversal.
    pub(super) fn state_bytes(&self) -> usize {
        self.method.state_bytes_in(self.word, self.bvh.depth())
    }

    /// Runs a query in a copy of the traversals that is compiled for it, if the keys are short.
    #[inline]
    pub(super) fn run_fast(&self, octant: u8, memory: &mut Vec<Node>, query: &mut impl Query) {
        let method = self.method_for(query);
        let fits = match self.word {
            WordName::U32 => self.tables.run::<u32, _>(method, octant, memory, query, &mut ()),
            WordName::U64 => self.tables.run::<u64, _>(method, octant, memory, query, &mut ()),
            WordName::U128 | WordName::Grow => self.try_run(octant, memory, query, &mut ()),
        };
        debug_assert_eq!(fits, Ok(()), "checked when this was made");
    }

    /// Runs any query.
    pub(super) fn run(&self, octant: u8, memory: &mut Vec<Node>, query: &mut dyn Query, recorder: &mut impl Recorder) {
        let fits = self.try_run(octant, memory, query, recorder);
        debug_assert_eq!(fits, Ok(()), "checked when this was made");
    }

    fn try_run(
        &self,
        octant: u8,
        memory: &mut Vec<Node>,
        mut query: &mut dyn Query,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unfit> {
        self.tables.run_in(self.word, self.method_for(&query), octant, memory, &mut query, recorder)
    }

    /// Searches that nothing can be pruned from are traversed as a whole.
    #[inline]
    pub(super) fn method_for(&self, query: &(impl Pruned + ?Sized)) -> Method {
        if query.allows(self.method.test().pruning()) { self.method } else { self.method.without_pruning() }
    }
}

impl<S> std::fmt::Debug for Level<'_, S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Level").field("method", &self.method).field("word", &self.word).finish_non_exhaustive()
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

impl Pruned for Nothing {
    fn allows(&self, _: Pruning) -> bool {
        true
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
