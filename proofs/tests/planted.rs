//! The planted bugs of the checks, each caught by a harness body; the table of which ones is printed, as markdown.

#[path = "../../tests/bites/mutants.rs"]
mod mutants;
#[path = "../../tests/bites/printed.rs"]
mod printed;
#[path = "../../tests/bites/textbook.rs"]
mod textbook;

use std::panic::{AssertUnwindSafe, catch_unwind};

use proofs::reference::{Keyed, Told, Watch};
use proofs::shape::{Script, Shape};
use proofs::traversals::follows;
use proofs::{Cases, Drawn};
use stackless_bvh::generate::Rng;
use stackless_bvh::order::Pruning;
use stackless_bvh::traverse::traverse;
use stackless_bvh::tree::{Node, Topology, Tree};

use mutants::{Mutation, mutants};
use printed::{Printed, Slip};
use textbook::{Bug, Textbook};

/// Random cases for a bug.
const CASES: u32 = 30_000;

/// A shape in an arena, as the buggy traversals take trees, with the keys of its nodes.
pub(crate) struct Case {
    tree: Tree,
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
        Self { tree: Tree::new(&children).unwrap(), keys }
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

type Run = Box<dyn Fn(&Case, &mut Told<'_, Case>, &mut Watch<'_, Case>)>;

/// A traversal with a bug.
struct Suspect {
    name: String,
    #[allow(dead_code, reason = "the list of mutants fills it in for the checks")]
    restarts: bool,
    run: Run,
}

impl Suspect {
    fn new(
        name: impl Into<String>,
        _fault: &'static str,
        run: impl Fn(&Case, &mut Told<'_, Case>, &mut Watch<'_, Case>) + 'static,
    ) -> Self {
        Self { name: name.into(), restarts: false, run: Box::new(run) }
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

    fn run(self, choose: &mut Drawn<false>, suspect: &Suspect) -> Option<()> {
        let run =
            |tree: &Case, told: &mut Told<'_, Case>, watch: &mut Watch<'_, Case>| (suspect.run)(tree, told, watch);
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
    fn catches(self, suspect: &Suspect) -> Option<u32> {
        let mut drawn = Drawn::new(Cases::Some(Rng::new(2)));
        (1..=CASES).find(|_| catch_unwind(AssertUnwindSafe(|| self.run(&mut drawn, suspect))).is_err())
    }
}

/// One row: which bodies catch a suspect.
fn row(suspect: &Suspect, bodies: &[Body]) -> Option<String> {
    let caught: Vec<_> = bodies.iter().filter_map(|&body| Some((body.name(), body.catches(suspect)?))).collect();
    let text: Vec<_> = caught.iter().map(|(body, case)| format!("{body} (case {case})")).collect();
    println!("| {} | {} |", suspect.name, text.join("; "));
    (!caught.is_empty()).then(|| text.join("; "))
}

/// Puts suspects and their controls through bodies: suspects are caught, controls are not.
fn judge(controls: &[Suspect], suspects: &[Suspect], bodies: &[Body]) {
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let accused: Vec<_> = controls.iter().filter(|control| row(control, bodies).is_some()).collect();
    let missed: Vec<_> = suspects.iter().filter(|suspect| row(suspect, bodies).is_none()).collect();
    std::panic::set_hook(quiet);
    let names = |suspects: Vec<&Suspect>| suspects.iter().map(|suspect| suspect.name.clone()).collect::<Vec<_>>();
    assert_eq!((names(accused), names(missed)), (vec![], vec![]));
}

fn textbook(bug: Bug) -> Suspect {
    Suspect::new(format!("{bug:?}"), "", move |case, told, watch| {
        traverse(Textbook::new(&case.tree, bug), told, watch);
    })
}

fn printed(resumes: bool, slip: Slip) -> Suspect {
    let name = if resumes { format!("{slip:?}, resumed") } else { format!("{slip:?}") };
    Suspect::new(name, "", move |case, told, watch| {
        traverse(Printed::new(&case.tree, resumes, slip), told, watch);
    })
}

/// One test, so that the panics of one part are not shown while another is silent.
#[test]
fn every_planted_bug_is_caught_by_a_harness_body() {
    println!("| planted bug | caught by |\n|---|---|");
    let bugs = [
        Bug::NoExit,
        Bug::TrailNotToggled,
        Bug::KeyNotToggled,
        Bug::ShiftShort,
        Bug::ShiftLong,
        Bug::TrailShiftShort,
        Bug::BothForOne,
        Bug::NoneForBoth,
        Bug::OnlyChildForgets,
        Bug::NearTwice,
        Bug::SkipsPostponed,
        Bug::StopsOneShort,
        Bug::OldestFirst,
        Bug::WrongOrder,
        Bug::SiblingForUncle,
        Bug::StaleKey,
        Bug::LeftKeys,
        Bug::NarrowKey,
        Bug::NarrowTrail,
        Bug::RegisterOfNear,
        Bug::RegisterKept,
        Bug::TrailAboveRoot,
        Bug::TrailNotShifted,
        Bug::CounterWithoutStart,
        Bug::Endless,
    ];
    judge(&[textbook(Bug::None)], &bugs.map(textbook), &[Body::Traversal7, Body::Traversal11]);

    let slips = [
        Slip::FillBeforeMask,
        Slip::RegisterKept,
        Slip::RegisterLost,
        Slip::MaskInverted,
        Slip::MaskNotShifted,
        Slip::MaskLeftBehind,
    ];
    let mut suspects: Vec<_> = slips.map(|slip| printed(false, slip)).into();
    suspects.push(printed(true, Slip::NoGuard));
    judge(&[printed(false, Slip::None), printed(true, Slip::None)], &suspects, &[Body::Disjoint11]);

    for mutation in [Mutation::FarFirst, Mutation::FarLost, Mutation::MissedWanted] {
        judge(&mutants(Mutation::None, ""), &mutants(mutation, ""), &[Body::Traversal7]);
    }
}
