//! The property body: one traversal against its oracle.

use std::sync::Arc;

use super::Case;
use super::watch::{Expected, Fault, Watch};
use stackless_bvh::event::Trace;
use stackless_bvh::generate::{Outcome, Search};
use stackless_bvh::internals::traverse::{AuxTables, VerifiedTables, WithWord, with_word};
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, LeftOrder, Pruned, Pruning, SignOrder, Unpruned};
use stackless_bvh::traverse::{Method, PruningStack, Stack, Tables, Test, Unsupported, WordName, traverse_pruned};
use stackless_bvh::tree::{Keys, Node, Parents, Topology, Tree};

/// The result of checking one traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict<F = Fault> {
    /// The traversal agrees with its oracle, with this number of visits.
    Agrees {
        /// Visits, restarts included.
        steps: u64,
    },
    /// The traversal does not support this tree with this word, and refused it before the first step.
    Refused(Unsupported),
    /// The traversal differs from its oracle.
    Differs(F),
}

/// A case with its oracles and the tables of the traversals to check. `[CONF-1]`
#[derive(Debug)]
pub struct Battery<'c> {
    case: &'c Case,
    tables: VerifiedTables<'c, Tree>,
    keys: Arc<Keys>,
    is_static: bool,
    parents: Parents,
    /// One oracle per [`Test`], computed on first use.
    oracles: [Option<Oracle>; Test::ALL.len()],
    memory: Vec<Node>,
}

#[derive(Debug)]
struct Oracle {
    trace: Trace,
    outcome: Outcome,
}

impl<'c> Battery<'c> {
    /// The deepest tree that gets the implicit layout here: 64 KiB of addresses. Deeper trees are looked up in the
    /// plain map; scenes exercise the reserved layout.
    const IMPLICIT_DEPTH: u32 = 13;

    /// Prepares a case for the given traversals.
    pub fn new(case: &'c Case, methods: &[Method]) -> Self {
        let octants = case.octant..case.octant.saturating_add(1);
        let beside = AuxTables::for_octants(&case.tree, case.tape.axes(), methods, Self::IMPLICIT_DEPTH, octants);
        let keys = Arc::new(Keys::of(&case.tree));
        Self {
            case,
            tables: Tables::verified(&case.tree, case.tape.axes(), beside, Arc::clone(&keys)),
            keys,
            is_static: case.is_static(),
            parents: Parents::of(&case.tree),
            oracles: Default::default(),
            memory: Vec::new(),
        }
    }

    /// Checks one traversal with one word.
    pub fn check(&mut self, method: Method, word: WordName) -> Verdict {
        with_word(word, Check { battery: self, method })
    }

    /// Checks a cursor that the caller drives. `run` gets the search and the recorder, and `test` selects the oracle.
    ///
    /// With `restarts`, visits on the way down from the root are skipped. Where answers change during a search, only
    /// the hit is compared.
    pub fn judge(
        &mut self,
        test: Test,
        restarts: bool,
        run: impl FnOnce(
            &mut Search<'_, Tree>,
            &mut Watch<'_>,
            &VerifiedTables<'c, Tree>,
            &mut Vec<Node>,
        ) -> Result<(), Unsupported>,
    ) -> Verdict {
        let case = self.case;
        if test.pruning() != Pruning::Never
            && let Err(fault) = self.is_pruning_right(test)
        {
            return Verdict::Differs(fault);
        }
        let oracle = self.oracles[test as usize].get_or_insert_with(|| Oracle::run(case, test, &mut self.memory));
        let exact = !restarts || self.is_static;
        let expected = oracle.trace.nodes();
        let longest_way = u64::from(case.tree.depth()) + 2;
        let step_limit = match (exact, restarts) {
            (true, false) => expected.len() as u64 + 1,
            (true, true) => (expected.len() as u64 + 1) * longest_way,
            (false, _) => (case.size() as u64 + 1) * longest_way,
        };
        let expected = if exact { Expected::Nodes(expected) } else { Expected::Nothing };
        let mut watch = Watch::new(&case.tree, &self.keys, &self.parents, expected, step_limit, restarts);
        let mut search = Search::new(&case.tree, &case.tape, case.any);
        let misses_before = self.tables.misses();
        if let Err(unfit) = run(&mut search, &mut watch, &self.tables, &mut self.memory) {
            return Verdict::Refused(unfit);
        }
        let lookups = self.tables.misses() - misses_before;
        if lookups > 0 {
            return Verdict::Differs(Fault::Miss { lookups });
        }
        match watch.finish().and_then(|steps| oracle.compare(search.outcome, exact, restarts).map(|()| steps)) {
            Ok(steps) => Verdict::Agrees { steps },
            Err(fault) => Verdict::Differs(fault),
        }
    }

    /// Returns whether the pruning oracle loses no hit. Computed once.
    fn is_pruning_right(&mut self, test: Test) -> Result<(), Fault> {
        let case = self.case;
        if self.oracles[test as usize].is_some() {
            return Ok(());
        }
        let whole = self.oracles[Test::Children as usize]
            .get_or_insert_with(|| Oracle::run(case, Test::Children, &mut self.memory));
        let pruned = Oracle::run(case, test, &mut self.memory);
        pruned.is_part_of(whole)?;
        self.oracles[test as usize] = Some(pruned);
        Ok(())
    }
}

struct Check<'a, 'c> {
    battery: &'a mut Battery<'c>,
    method: Method,
}

impl WithWord for Check<'_, '_> {
    type Output = Verdict;

    fn call<W: KeyWord>(self) -> Verdict {
        let Self { battery, method } = self;
        let octant = battery.case.octant;
        battery.judge(method.test(), method.restarts(), |search, watch, tables, memory| {
            tables.run::<W, _>(method, octant, memory, search, watch)
        })
    }
}

impl Oracle {
    fn run(case: &Case, test: Test, memory: &mut Vec<Node>) -> Self {
        let mut search = Search::new(&case.tree, &case.tape, case.any);
        let tree = &case.tree;
        let trace = match test {
            Test::Children | Test::Disjoint | Test::Distance => Self::trace(tree, test, &mut search, memory),
            Test::NodeLeftFirst => {
                let by_node = ByNode { test: &mut search, order: LeftOrder };
                Self::trace(tree, test, &mut Unpruned(by_node), memory)
            }
            Test::NodeBySign => {
                let order = SignOrder { axes: case.tape.axes(), octant: case.octant };
                Self::trace(tree, test, &mut Unpruned(ByNode { test: &mut search, order }), memory)
            }
        };
        Self { trace, outcome: search.outcome }
    }

    fn trace(tree: &Tree, test: Test, visitor: &mut impl Pruned, memory: &mut Vec<Node>) -> Trace {
        let (mut trace, pruning) = (Trace::default(), test.pruning());
        if tree.depth() <= oracle::DEPTH_LIMIT {
            oracle::traverse_pruned(tree, tree.root(), pruning, visitor, &mut trace);
            return trace;
        }
        match pruning {
            Pruning::Never => traverse_pruned(Stack::new(tree, memory), visitor, &mut trace),
            Pruning::Disjoint => traverse_pruned(PruningStack::<_, false>::new(tree, memory), visitor, &mut trace),
            Pruning::Distance => traverse_pruned(PruningStack::<_, true>::new(tree, memory), visitor, &mut trace),
        };
        trace
    }

    /// Checks that this pruned search finds the hit of the whole search and visits no other nodes.
    fn is_part_of(&self, whole: &Self) -> Result<(), Fault> {
        if self.outcome.hit != whole.outcome.hit {
            return Err(Fault::Hit { expected: whole.outcome.hit, found: self.outcome.hit });
        }
        let mut rest = whole.trace.nodes().iter();
        match self.trace.nodes().iter().find(|&node| !rest.any(|other| other == node)) {
            Some(&node) => Err(Fault::Unpruned { node }),
            None => Ok(()),
        }
    }

    fn compare(&self, found: Outcome, exact: bool, restarts: bool) -> Result<(), Fault> {
        if found.hit != self.outcome.hit {
            return Err(Fault::Hit { expected: self.outcome.hit, found: found.hit });
        }
        let counts = |outcome: Outcome| (if restarts { 0 } else { outcome.inner_visits }, outcome.leaf_visits);
        if exact && counts(found) != counts(self.outcome) {
            return Err(Fault::Visits { expected: counts(self.outcome), found: counts(found) });
        }
        Ok(())
    }
}
