//! The planted bugs of the checks, each caught by a harness body; tests/PLANTED.md has by which.

#[path = "../../tests/library/bites/table.rs"]
#[allow(dead_code, reason = "of the whole table this test has a column")]
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};

use proofs::reference::{Keyed, Told, Watch};
use proofs::shape::{Script, Shape};
use proofs::traversals::follows;
use proofs::{Cases, Drawn};
use stackless_bvh::event::Recorder;
use stackless_bvh::generate::{Cell, Rng, Tape};
use stackless_bvh::order::{Descent, Flow, Pruning, Visitor, Whole};
use stackless_bvh::tree::{Node, Topology, Tree};
use stackless_check::planted::{self, Planted, Seer};

/// Random cases for a bug.
const CASES: u32 = 30_000;

/// A shape in an arena, as the buggy traversals take trees, with the keys of its nodes.
struct Case {
    tree: Tree,
    /// Which prefers left everywhere: harnesses know decisions only.
    tape: Tape,
    keys: Vec<u32>,
}

impl Case {
    fn new(shape: Shape) -> Self {
        let (mut keys, mut children) = (vec![1], Vec::new());
        while let Some(&key) = keys.get(children.len()) {
            let next = keys.len() as u32;
            children.push(shape.is_inner(key).then_some([next, next + 1]));
            if shape.is_inner(key) {
                keys.extend([2 * key, 2 * key + 1]);
            }
        }
        let tree = Tree::new(&children).unwrap();
        let tape = Tape::from_cells(&tree, vec![Cell::default(); keys.len()]).unwrap();
        Self { tree, tape, keys }
    }
}

impl Topology for Case {
    fn root(&self) -> Node {
        self.tree.root()
    }
    fn children(&self, node: Node) -> [Node; 2] {
        self.tree.children(node)
    }
    fn node_count(&self) -> usize {
        self.tree.node_count()
    }
    fn slot(&self, node: Node) -> usize {
        self.tree.slot(node)
    }
    fn depth(&self) -> u32 {
        self.tree.depth()
    }
}

impl Keyed for Case {
    fn key(&self, node: Node) -> u32 {
        self.keys[node.index()]
    }
}

/// The harness bodies that a suspect is put through: what they compare, and the search they run.
#[derive(Clone, Copy, Debug)]
enum Body {
    /// Decisions without marks, trees of up to 7 nodes.
    Traversal7,
    /// Up to 11 nodes.
    Traversal11,
    /// Disjoint nodes, and leaves where something is found, up to 11 nodes.
    Disjoint11,
}

impl Body {
    fn name(self) -> &'static str {
        match self {
            Self::Traversal7 => "7 nodes",
            Self::Traversal11 => "11 nodes",
            Self::Disjoint11 => "11 nodes, disjoint",
        }
    }

    fn run(self, choose: &mut Drawn<false>, suspect: &Planted) -> Option<()> {
        let run = |case: &Case, told: &mut Told<'_, Case>, watch: &mut Watch<'_, Case>| {
            suspect.run_any(&case.tree, &case.tape, told, |seen| watch.visit(seen.node, || *seen));
        };
        match self {
            Self::Traversal7 => follows(choose, 3, Pruning::Never, Script::any, Case::new, run),
            Self::Traversal11 => follows(choose, 5, Pruning::Never, Script::any, Case::new, run),
            Self::Disjoint11 => {
                let script = |choose: &mut Drawn<false>, shape| Script::any(choose, shape).with_marks(choose, shape);
                follows(choose, 5, Pruning::Disjoint, script, Case::new, run)
            }
        }
    }

    /// The number of the first case that refutes a suspect.
    fn catches(self, suspect: &Planted) -> Option<u32> {
        let mut drawn = Drawn::new(Cases::Some(Rng::new(2)));
        (1..=CASES).find(|_| catch_unwind(AssertUnwindSafe(|| self.run(&mut drawn, suspect))).is_err())
    }
}

/// Which bodies catch a suspect, each with the number of the case.
fn caught(suspect: &Planted) -> Option<String> {
    let bodies: &[Body] = match suspect.test().pruning() {
        Pruning::Never => &[Body::Traversal7, Body::Traversal11],
        _ => &[Body::Disjoint11],
    };
    let caught = bodies.iter().filter_map(|&body| Some(format!("{}: {}", body.name(), body.catches(suspect)?)));
    let caught: Vec<_> = caught.collect();
    (!caught.is_empty()).then(|| caught.join("; "))
}

/// One test, so that the panics of one part are not shown while another is silent.
#[test]
fn every_planted_bug_is_caught_by_a_harness_body() {
    // Whether it runs over any search.
    let applies = |bug: &Planted| {
        let leaf = Tree::new(&[None]).unwrap();
        let tape = Tape::from_cells(&leaf, vec![Cell::default()]).unwrap();
        bug.run_any(&leaf, &tape, &mut Whole(Nobody), |_| Flow::Stop)
    };
    // In what is asked, where it does not.
    let asked = "harnesses have neither tapes nor tests of nodes: it is in what a search is asked";
    let beyond = |bug: &Planted| planted::unseen(bug.name(), Seer::Harness).or((!applies(bug)).then_some(asked));
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let accused: Vec<_> = planted::controls().into_iter().filter(|bug| caught(bug).is_some()).collect();
    let bugs = planted::all();
    let seen = bugs.iter().map(|bug| match beyond(bug) {
        Some(why) => (bug.name().to_owned(), Some(format!("{}{why}", table::NO))),
        None => (bug.name().to_owned(), caught(bug)),
    });
    let (seen, missed): (Vec<_>, Vec<_>) = seen.partition(|(_, seen)| seen.is_some());
    std::panic::set_hook(quiet);
    assert!(accused.is_empty() && missed.is_empty(), "{accused:?} {missed:?}");
    table::compare_column("harness", &seen.into_iter().filter_map(|(name, seen)| Some((name, seen?))).collect());
}

struct Nobody;

impl Visitor for Nobody {
    fn inner(&mut self, _: Node) -> Descent {
        Descent::NEITHER
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}
