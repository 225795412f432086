//! Planted bugs: traversals with one mistake each, which every layer of checks has to catch.
//!
//! Battery, fuzzer, proof harnesses, conformance cases: a check that lets one of these pass where it could show is no
//! check.
//!
//! Beside them are other layers ([`LAYERS`]): tables, tests of triangles and boxes, searches, hierarchies and traversals
//! of wide trees with one mistake each, for the property bodies of these. `tests/PLANTED.md` says what is seen of each.

mod asked;
mod doubles;
mod draw;
mod files;
mod filters;
mod given;
mod hierarchies;
mod implicit;
mod kernels;
mod layers;
mod list;
mod lookups;
mod machine;
mod mutants;
mod paths;
mod searches;
mod shaders;
mod slabs;
mod tables;
mod wide;
mod wrapped;

pub use given::Shallow;
pub use layers::{Hits, Instead, LAYERS, Layer, Mistake, Table};
pub use list::{Seer, all, controls, marks, rows, unseen};
pub use lookups::Function;
pub use shaders::{SHADERS, Shader, ShownBy};
pub use wide::WidePlanted;

use super::{Battery, Case, Fault, Verdict, Watch};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::{Search, Tape};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Flow, Pruned};
use stackless_bvh::traverse::{Cursor, Test, traverse_pruned};
use stackless_bvh::tree::{Node, Tree};

/// A traversal with a bug, or, as a control, without one.
pub struct Planted {
    name: String,
    clause: &'static str,
    test: Test,
    restarts: bool,
    carries: u32,
    run: Run,
}

/// The deepest tree that every traversal carries in words of 64 bits.
const DEEPEST: u32 = 62;

/// What a bug can be run over.
enum Run {
    /// Any search over any tree; the tape says which child is preferred where only one is wanted.
    Any(Box<AnyRun>),
    /// Cases only: the bug is in what a traversal asks or is given.
    Case(Box<CaseRun>),
}

type AnyRun = dyn Fn(&Tree, &Tape, &mut dyn Pruned, &mut Watcher<'_>);
type CaseRun = dyn Fn(&Case, &mut Search<'_, Tree>, &mut Watcher<'_>);

/// Looks at each visit.
struct Watcher<'a>(&'a mut dyn FnMut(&State<u64>) -> Flow);

impl Planted {
    fn any(
        name: impl Into<String>,
        clause: &'static str,
        run: impl Fn(&Tree, &Tape, &mut dyn Pruned, &mut Watcher<'_>) + 'static,
    ) -> Self {
        Self::new(name.into(), clause, Run::Any(Box::new(run)))
    }

    fn case(
        name: impl Into<String>,
        clause: &'static str,
        run: impl Fn(&Case, &mut Search<'_, Tree>, &mut Watcher<'_>) + 'static,
    ) -> Self {
        Self::new(name.into(), clause, Run::Case(Box::new(run)))
    }

    fn new(name: String, clause: &'static str, run: Run) -> Self {
        Self { name, clause, test: Test::Children, restarts: false, carries: DEEPEST, run }
    }

    fn held_to(self, test: Test) -> Self {
        Self { test, ..self }
    }

    fn restarting(self) -> Self {
        Self { restarts: true, ..self }
    }

    fn carrying(self, depth: u32) -> Self {
        Self { carries: depth, ..self }
    }

    /// What is wrong, in a few words: unique.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The clause that it breaks.
    pub fn clause(&self) -> &'static str {
        self.clause
    }

    /// The reference that it is held to.
    pub fn test(&self) -> Test {
        self.test
    }

    /// Whether it goes down from the root again, and asks again on its way.
    pub fn restarts(&self) -> bool {
        self.restarts
    }

    /// The deepest tree, in edges, that it does not refuse.
    pub fn carries(&self) -> u32 {
        self.carries
    }

    /// How it differs from its reference over a case; `None` if it does not.
    pub fn fault(&self, case: &Case) -> Option<Fault> {
        let verdict = Battery::new(case, &[]).judge(self.test, self.restarts, |search, watch: &mut Watch<'_>, _, _| {
            self.run(case, search, |seen| watch.visit(seen.node, || *seen));
            Ok(())
        });
        match verdict {
            Verdict::Differs(fault) => Some(fault),
            Verdict::Agrees { .. } | Verdict::Refused(_) => None,
        }
    }

    /// Runs it over a case.
    pub fn run(&self, case: &Case, search: &mut Search<'_, Tree>, mut watch: impl FnMut(&State<u64>) -> Flow) {
        let watcher = &mut Watcher(&mut watch);
        match &self.run {
            Run::Any(run) => run(&case.tree, &case.tape, search, watcher),
            Run::Case(run) => run(case, search, watcher),
        }
    }

    /// Runs it over any search; `false`, and nothing is run, if the bug is one of [`Search`]es or of node tests.
    pub fn run_any(
        &self,
        tree: &Tree,
        tape: &Tape,
        visitor: &mut dyn Pruned,
        mut watch: impl FnMut(&State<u64>) -> Flow,
    ) -> bool {
        match &self.run {
            Run::Any(run) => run(tree, tape, visitor, &mut Watcher(&mut watch)),
            Run::Case(_) => return false,
        }
        true
    }
}

impl core::fmt::Debug for Planted {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.name)
    }
}

impl Recorder for &mut Watcher<'_> {
    fn visit<W: KeyWord>(&mut self, _: Node, state: impl FnOnce() -> State<W>) -> Flow {
        (self.0)(&state().map(|word| word.to_u64()))
    }
}

fn drive(cursor: impl Cursor, visitor: &mut (impl Pruned + ?Sized), mut watcher: &mut Watcher<'_>) {
    traverse_pruned(cursor, &mut { visitor }, &mut watcher);
}
