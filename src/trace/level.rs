//! The data of queries in addition to the hierarchy.

use super::{Part, Plan, Query};
use crate::bvh::{Bvh, BvhTree};
use crate::event::Backtracks;
use crate::geom::Aabb;
use crate::order::{Descent, Flow, NodeTest, Pruned, Pruning, Visitor};
use crate::traverse::{AuxTables, Method, Run, Stack, Tables, Test, Unsupported, WordName, traverse};
use crate::tree::{Implicit, Node, Topology};

/// A traversal and its tables. Callers pass the hierarchy of these tables with each query.
#[derive(Debug)]
pub(super) struct Level {
    pub(super) method: Method,
    pub(super) word: WordName,
    beside: AuxTables,
    /// Each node's own box, for the traversals that test it.
    pub(super) boxes: Vec<Aabb>,
}

impl Level {
    /// Creates the level of a plan. It checks the plan once, so tracing is infallible.
    pub(super) fn new<S>(bvh: &Bvh<S>, method: Method, plan: &Plan) -> Result<Self, Unsupported> {
        let level = Self::unchecked(bvh, method, plan);
        // A search that ends at the root detects an unfit traversal before the first step.
        level.try_run(bvh.tree(), 0, &mut Vec::new(), &mut Nothing).map(|()| level)
    }

    pub(super) fn unchecked<S>(bvh: &Bvh<S>, method: Method, plan: &Plan) -> Self {
        let method = match method.with_second_trail() {
            Some(pruning) if plan.restores(Part::SecondTrail) => pruning,
            _ if plan.skips(Part::SecondTrail) && method.test() == Test::Disjoint => method.without_pruning(),
            _ => method,
        };
        let narrowest = WordName::narrowest(bvh.depth());
        let word = match narrowest {
            WordName::U32 | WordName::U64 if plan.restores(Part::LongKeys) => WordName::U128,
            _ => narrowest,
        };
        let boxes = if plan.skips(Part::OwnBoxes) { Vec::new() } else { bvh.own_boxes() };
        let others = plan.restores(Part::Hash).then_some(Method::Hashed);
        let methods: Vec<_> = others.into_iter().chain([method]).collect();
        let beside = AuxTables::new(bvh.tree(), bvh.axes(), &methods, Implicit::LIMIT);
        Self { method, word, beside, boxes }
    }

    /// Returns the memory of the tables, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.beside.bytes() + size_of_val(&*self.boxes)
    }

    /// Returns the bytes of the state of a traversal.
    pub(super) fn state_bytes<S>(&self, bvh: &Bvh<S>) -> usize {
        self.method.state_bytes_in(self.word, bvh.depth())
    }

    /// Runs a query to its end. It uses a copy of the traversals that is compiled for the query, if keys are short and
    /// the records have the traversal's links. Otherwise it uses the shared copy.
    #[inline]
    pub(super) fn run(&self, tree: &BvhTree, octant: u8, memory: &mut Vec<Node>, query: &mut impl Query) {
        let (method, tables) = (self.method_for(query), self.tables(tree));
        if !matches!(self.word, WordName::U32 | WordName::U64) || !tables.are_direct(method) {
            return self.run_shared(tree, octant, memory, query);
        }
        let run = Run { from: tables.directly(octant, memory), search: &mut *query, recorder: &mut () };
        let fits =
            if self.word == WordName::U32 { method.dispatch::<u32, _>(run) } else { method.dispatch::<u64, _>(run) };
        if fits.is_err() {
            by_stack(tree, query);
        }
    }

    /// Runs any query, in the shared copy of the traversals.
    pub(super) fn run_shared(&self, tree: &BvhTree, octant: u8, memory: &mut Vec<Node>, query: &mut dyn Query) {
        if self.try_run(tree, octant, memory, query).is_err() {
            by_stack(tree, query);
        }
    }

    /// Runs a query with all backtracks counted, in a separate copy.
    pub(super) fn run_counted(
        &self,
        tree: &BvhTree,
        octant: u8,
        memory: &mut Vec<Node>,
        mut query: &mut dyn Query,
        backtracks: &mut Backtracks,
    ) {
        let method = self.method_for(query);
        let ran = self.tables(tree).run_in(self.word, method, octant, memory, &mut query, backtracks);
        if ran.is_err() {
            by_stack(tree, query);
        }
    }

    fn try_run(
        &self,
        tree: &BvhTree,
        octant: u8,
        memory: &mut Vec<Node>,
        query: &mut dyn Query,
    ) -> Result<(), Unsupported> {
        self.tables(tree).run_query(self.word, self.method_for(query), octant, memory, query)
    }

    #[inline]
    pub(super) fn tables<'t>(&'t self, tree: &'t BvhTree) -> Tables<'t, BvhTree> {
        Tables::lent(tree, tree.axes(), &self.beside)
    }

    /// Searches that allow no pruning run without it.
    #[inline]
    pub(super) fn method_for(&self, query: &(impl Pruned + ?Sized)) -> Method {
        if query.allows(self.method.test().pruning()) { self.method } else { self.method.without_pruning() }
    }
}

/// Unreachable after [`Level::new`]; falls back to a traversal that fits every hierarchy, not to a miss.
#[cold]
#[inline(never)]
fn by_stack(tree: &BvhTree, mut query: &mut dyn Query) {
    traverse(Stack::new(tree, &mut Vec::new()), &mut query, &mut ());
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::SahOptions;
    use crate::generate::procedural;
    use crate::trace::truth::Truth;
    use crate::trace::{Closest, OwnBoxes, QueryKind};

    /// Keys of 32 bits in a hierarchy that is too deep for them, without a table of the traversal that runs.
    #[test]
    fn a_level_that_does_not_fit_is_found_at_once_and_answers_even_so() {
        let mesh = procedural::layers(60);
        let bvh = Bvh::sah(&mesh, SahOptions { depth_limit: u32::MAX, ..SahOptions::default() }).expect("a tree");
        assert!(bvh.depth() > 31, "{}", bvh.depth());
        let plan = Plan::new(&bvh, Method::Uncle, QueryKind::Hit);
        let level = Level { word: WordName::U32, ..Level::unchecked(&bvh, Method::Uncle, &plan) };
        let refused = level.try_run(bvh.tree(), 0, &mut Vec::new(), &mut Nothing);
        assert!(matches!(refused, Err(Unsupported::TooDeep(_))));
        let (truth, rays) = (Truth::new(&mesh), procedural::rays(&mesh, 5, 200));
        let mut hits = 0;
        for ray in &rays {
            let expected = truth.closest(ray).map(|hit| hit.rounded());
            hits += usize::from(expected.is_some());
            let search = || OwnBoxes::over(Closest::new(&bvh, ray), &level.boxes);
            let [mut own, mut shared] = [search(), search()];
            level.run(bvh.tree(), ray.octant(), &mut Vec::new(), &mut own);
            assert_eq!(own.hit(), expected, "{ray:?}");
            level.run_shared(bvh.tree(), ray.octant(), &mut Vec::new(), &mut shared);
            assert_eq!(shared.hit(), expected, "{ray:?}");
        }
        assert!(hits > 20, "{hits}");
    }
}
