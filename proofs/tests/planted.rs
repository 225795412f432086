//! The planted bugs of the checks, each caught by a harness body; the table of which ones is printed, as markdown.

use std::panic::{AssertUnwindSafe, catch_unwind};

use proofs::reference::{Keyed, Told, Watch};
use proofs::shape::{Script, Shape};
use proofs::traversals::follows;
use proofs::{Cases, Drawn};
use stackless_bvh::check::planted::{self, Planted};
use stackless_bvh::event::Recorder;
use stackless_bvh::generate::{Cell, Rng, Tape};
use stackless_bvh::order::{Descent, Flow, Pruning, Visitor};
use stackless_bvh::tree::{Node, Topology, Tree};

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
            Self::Traversal7 => "traversal, 7 nodes",
            Self::Traversal11 => "traversal, 11 nodes",
            Self::Disjoint11 => "traversal with disjoint nodes, 11 nodes",
        }
    }

    fn run(self, choose: &mut Drawn<false>, suspect: &Planted) -> Option<()> {
        let run = |case: &Case, told: &mut Told<'_, Case>, watch: &mut Watch<'_, Case>| {
            suspect.run_any(&case.tree, &case.tape, told, |seen| watch.visit(seen));
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

/// One row: which bodies catch a suspect.
fn row(suspect: &Planted, bodies: &[Body]) -> Option<String> {
    let caught: Vec<_> = bodies.iter().filter_map(|&body| Some((body.name(), body.catches(suspect)?))).collect();
    let text: Vec<_> = caught.iter().map(|(body, case)| format!("{body} (case {case})")).collect();
    println!("| {} | {} |", suspect.name(), text.join("; "));
    (!caught.is_empty()).then(|| text.join("; "))
}

/// What no harness body can show: a choice between boxes that are missed, and words of 8 bits in trees of more than 7 levels, which
/// the harnesses about depth exclude.
const BEYOND: [&str; 4] = [
    "Algorithm 1 of H: ClosestOfMissed",
    "Algorithm 1 of H: AnyDepth",
    "Algorithm 2 of J: Combined",
    "Algorithm 2 of J: AnyDepth",
];

/// One test, so that the panics of one part are not shown while another is silent.
#[test]
fn every_planted_bug_is_caught_by_a_harness_body() {
    let bodies = |bug: &Planted| match bug.test().pruning() {
        Pruning::Never => &[Body::Traversal7, Body::Traversal11][..],
        _ => &[Body::Disjoint11],
    };
    // Whether it runs over any search.
    let applies = |bug: &Planted| {
        let leaf = Tree::new(&[None]).unwrap();
        let tape = Tape::from_cells(&leaf, vec![Cell::default()]).unwrap();
        bug.run_any(&leaf, &tape, &mut Nobody, |_| Flow::Stop) && !BEYOND.contains(&bug.name())
    };
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    println!("| planted bug | caught by |\n|---|---|");
    let accused: Vec<_> = planted::controls().into_iter().filter(|bug| row(bug, bodies(bug)).is_some()).collect();
    let bugs: Vec<_> = planted::all().into_iter().filter(applies).collect();
    let missed: Vec<_> = bugs.iter().filter(|bug| row(bug, bodies(bug)).is_none()).collect();
    std::panic::set_hook(quiet);
    assert!(accused.is_empty() && missed.is_empty() && bugs.len() > 70, "{accused:?} {missed:?} {}", bugs.len());
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
