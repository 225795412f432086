//! The checks bite: planted bugs are caught, made small, and reproduced from a file.

#[path = "bites/mutants.rs"]
mod mutants;
#[path = "bites/printed.rs"]
mod printed;
#[path = "bites/textbook.rs"]
mod textbook;
#[path = "bites/wanderer.rs"]
mod wanderer;

use std::collections::BTreeMap;

use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::check::{
    Battery, Case, CaseOptions, Fault, Plan, Replay, SceneTree, Verdict, Watch, check_scene, shrink,
};
use stackless_bvh::generate::{Family, Kind, Rng, Search};
use stackless_bvh::hash::Lookup;
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{ByNode, Descent, FixedOrder, Flow, LeftFirst, Side, SignOrder, Visitor};
use stackless_bvh::scene::{Mesh, procedural};
use stackless_bvh::trace::Truth;
use stackless_bvh::traverse::{Hapala, Hashed, Method, Skip, Skips, Test, Uncle, WordName, traverse};
use stackless_bvh::tree::{Keys, Node, Parents, Recorded, RecordedUncles, Topology, Tree, UncleLinks, Uncles};

use mutants::{Mutation, mutants};
use printed::{Printed, Slip};
use textbook::{Bug, Textbook};
use wanderer::Wanderer;

const CASES: u64 = 400;

type Run = Box<dyn Fn(&Case, &mut Search<'_, Tree>, &mut Watch<'_>)>;

/// A traversal with a bug.
struct Suspect {
    name: String,
    test: Test,
    restarts: bool,
    /// Name of the fault that at least some cases must show.
    fault: &'static str,
    run: Run,
}

impl Suspect {
    fn new(
        name: impl Into<String>,
        fault: &'static str,
        run: impl Fn(&Case, &mut Search<'_, Tree>, &mut Watch<'_>) + 'static,
    ) -> Self {
        Self { name: name.into(), test: Test::Children, restarts: false, fault, run: Box::new(run) }
    }

    fn textbook(bug: Bug, fault: &'static str) -> Self {
        Self::new(format!("{bug:?}"), fault, move |case, search, watch| {
            traverse(Textbook::new(&case.tree, bug), search, watch);
        })
    }

    fn judge(&self, case: &Case) -> Verdict {
        Battery::new(case, &[]).judge(self.test, self.restarts, |search, watch, _, _| {
            (self.run)(case, search, watch);
            Ok(())
        })
    }

    fn fault(&self, case: &Case) -> Option<Fault> {
        match self.judge(case) {
            Verdict::Differs(fault) => Some(fault),
            Verdict::Agrees { .. } => None,
            Verdict::Refused(unfit) => panic!("{}: {unfit}", self.name),
        }
    }

    /// Caught with the expected fault, on a case that can be made small and kept in a file.
    fn must_be_caught(&self, cases: &[Case]) {
        let caught: Vec<_> = cases.iter().filter_map(|case| Some((case, self.fault(case)?))).collect();
        let mut kinds = BTreeMap::<_, u32>::new();
        for (_, fault) in &caught {
            *kinds.entry(kind(fault)).or_default() += 1;
        }
        println!("{}: {kinds:?} of {}", self.name, cases.len());
        assert!(kinds.contains_key(self.fault), "{}: {kinds:?}, expected {}", self.name, self.fault);

        for (case, _) in caught.iter().step_by(caught.len().div_ceil(20)) {
            self.must_be_made_small(case);
        }
    }

    fn must_be_made_small(&self, case: &Case) {
        let small = shrink(case.clone(), |case| self.fault(case).is_some());
        let fault = self.fault(&small).unwrap();
        assert!(small.size() <= 9, "{}: {} nodes, {fault}", self.name, small.size());

        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("case.json");
        let replay = Replay::of(&small, Method::Stack, WordName::U64, &fault);
        std::fs::write(&file, serde_json::to_string(&replay).unwrap()).unwrap();
        let again = Replay::load(&file).unwrap();
        assert_eq!(again.fault, Some(fault.to_string()));
        let again = again.case().unwrap();
        assert_eq!(again, small, "{}", self.name);
        assert_eq!(self.fault(&again), Some(fault), "{}", self.name);
    }
}

/// [DISJOINT-3] [PAUSE-3]
#[test]
fn slips_with_the_second_trail_and_with_resuming() {
    let printed = |resumes, slip, fault| Suspect {
        test: Test::Disjoint,
        ..Suspect::new(format!("{slip:?}"), fault, move |case, search, watch| {
            traverse(Printed::new(&case.tree, resumes, slip), search, watch);
        })
    };
    // Trees that are deep enough to look keys up, under intervals that often are disjoint.
    let cases: Vec<_> = (0..CASES)
        .map(|seed| {
            let mut rng = Rng::new(seed);
            let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 24);
            Case { any: false, ..Case::with_tree(tree, Kind::Intervals, &mut rng) }
        })
        .collect();
    for resumes in [false, true] {
        let control = printed(resumes, Slip::None, "none");
        assert!(cases.iter().all(|case| control.fault(case).is_none()));
    }
    for slip in [
        Slip::FillBeforeMask,
        Slip::RegisterKept,
        Slip::RegisterLost,
        Slip::MaskInverted,
        Slip::MaskNotShifted,
        Slip::MaskLeftBehind,
    ] {
        printed(false, slip, "node").must_be_caught(&cases);
    }
    printed(true, Slip::NoGuard, "node").must_be_caught(&cases);
}

fn kind(fault: &Fault) -> &'static str {
    match fault {
        Fault::Node { expected: Some(_), .. } => "node",
        Fault::Node { expected: None, .. } => "beyond the end",
        Fault::Early { .. } => "early",
        Fault::Key { .. } => "key",
        Fault::Trail { .. } => "trail",
        Fault::Register { .. } => "register",
        Fault::Endless { .. } => "endless",
        Fault::Hit { .. } => "hit",
        Fault::Visits { .. } => "visits",
        Fault::Restart { .. } => "restart",
        Fault::Miss { .. } => "miss",
        Fault::Unpruned { .. } => "unpruned",
    }
}

fn cases() -> Vec<Case> {
    (0..CASES).map(|seed| Case::random(seed, CaseOptions::default())).collect()
}

/// A hierarchy cannot be damaged through the public interface, but it can be that of another mesh.
#[test]
fn a_hierarchy_that_does_not_hold_the_mesh() {
    let mesh = procedural::soup(3, 400);
    let rays = procedural::rays(&mesh, 1, 300);
    let plan = Plan {
        trees: 0,
        seed: 1,
        options: CaseOptions::default(),
        methods: vec![Method::Stack, Method::Hashed],
        words: vec![WordName::U64],
    };
    let truth = Truth::new(&mesh);
    let check = |held: &Mesh| {
        let bvh = Bvh::sah(held, SahOptions::default()).unwrap();
        check_scene(&plan, &SceneTree::new(&truth, &bvh), &rays, &|_| ())
    };
    let (tally, found) = check(&mesh);
    assert_eq!((tally.disagreements(), found.is_none()), (0, true));

    let without = |lost: usize| {
        let kept = mesh.triangles().iter().enumerate().filter(|&(prim, _)| prim != lost).map(|(_, &corners)| corners);
        Mesh::new(mesh.vertices().to_vec(), kept.collect()).unwrap()
    };
    let moved = mesh.vertices().iter().map(|&vertex| vertex * 1.001).collect();
    let mut turned = mesh.triangles().to_vec();
    turned.rotate_left(1);
    for held in [
        without(0),
        without(7),
        Mesh::new(moved, mesh.triangles().to_vec()).unwrap(),
        Mesh::new(mesh.vertices().to_vec(), turned).unwrap(),
    ] {
        let (tally, found) = check(&held);
        assert!(tally.oracle_faults > 0);
        assert_eq!(tally.disagreements(), tally.oracle_faults);
        let found = found.unwrap();
        assert_eq!(found.method, None);
        assert_ne!(found.expected.hit, found.found.hit);
    }
}

#[test]
fn every_case_comes_back_from_a_file() {
    for (seed, case) in cases().into_iter().enumerate() {
        let fault = Fault::Early { visits: 0, expected: 1 };
        let replay = Replay::of(&case, Method::Stack, WordName::U64, &fault);
        let again = replay.case().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert_eq!(again, case);
    }
}

fn all_must_be_caught(suspects: Vec<Suspect>) {
    let cases = cases();
    for suspect in suspects {
        suspect.must_be_caught(&cases);
    }
}

/// [CONF-1] [REGISTER-2]
#[test]
fn bugs_in_a_textbook_traversal() {
    let control = Suspect::textbook(Bug::None, "");
    for case in cases() {
        assert_eq!(control.fault(&case), None);
    }
    let mut suspects: Vec<_> = [
        (Bug::NoExit, "beyond the end"),
        (Bug::TrailNotToggled, "node"),
        (Bug::KeyNotToggled, "key"),
        (Bug::ShiftShort, "node"),
        (Bug::ShiftLong, "node"),
        (Bug::TrailShiftShort, "trail"),
        (Bug::BothForOne, "node"),
        (Bug::NoneForBoth, "early"),
        (Bug::OnlyChildForgets, "early"),
        (Bug::NearTwice, "node"),
        (Bug::SkipsPostponed, "node"),
        (Bug::StopsOneShort, "early"),
        (Bug::OldestFirst, "node"),
        (Bug::WrongOrder, "node"),
        (Bug::SiblingForUncle, "node"),
        (Bug::StaleKey, "key"),
        (Bug::LeftKeys, "key"),
        (Bug::NarrowKey, "key"),
        (Bug::NarrowTrail, "early"),
        (Bug::RegisterOfNear, "register"),
        (Bug::RegisterKept, "register"),
        (Bug::TrailAboveRoot, "trail"),
        (Bug::TrailNotShifted, "trail"),
        (Bug::CounterWithoutStart, "trail"),
    ]
    .map(|(bug, fault)| Suspect::textbook(bug, fault))
    .into();
    // Only what passes for a restart is not compared with the oracle's next visit, and could go on for ever.
    suspects.push(Suspect { restarts: true, ..Suspect::textbook(Bug::Endless, "endless") });
    // A traversal that does not restart may not say that it does.
    suspects.push(Suspect::textbook(Bug::Endless, "restart"));
    all_must_be_caught(suspects);
}

/// A search asked in a wrong way.
struct Misasked<'a, 't> {
    search: &'a mut Search<'t, Tree>,
    how: Misuse,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Misuse {
    /// A closest-hit search ends at its first hit.
    EndsAtFirstHit,
    /// An any-hit search goes on.
    NeverEnds,
    /// The first leaf is visited, and not looked into.
    FirstLeafUnseen,
    /// The decision at an inner node is asked for twice.
    AsksTwice,
    /// A leaf is looked into twice.
    LooksTwice,
}

impl Visitor for Misasked<'_, '_> {
    fn inner(&mut self, node: Node) -> Descent {
        if self.how == Misuse::AsksTwice {
            self.search.inner(node);
        }
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let before = self.search.outcome.hit;
        if self.how == Misuse::LooksTwice {
            Visitor::leaf(self.search, node);
        }
        if self.how == Misuse::FirstLeafUnseen && self.search.outcome.leaf_visits == 0 {
            self.search.outcome.leaf_visits += 1;
            return Flow::Continue;
        }
        let flow = Visitor::leaf(self.search, node);
        match self.how {
            Misuse::EndsAtFirstHit if self.search.outcome.hit != before => Flow::Stop,
            Misuse::NeverEnds => Flow::Continue,
            _ => flow,
        }
    }
}

#[test]
fn bugs_in_asking_the_search() {
    let suspects = [
        (Misuse::EndsAtFirstHit, "early"),
        (Misuse::NeverEnds, "beyond the end"),
        (Misuse::FirstLeafUnseen, "hit"),
        (Misuse::AsksTwice, "visits"),
        (Misuse::LooksTwice, "visits"),
    ];
    all_must_be_caught(
        suspects
            .map(|(how, fault)| {
                Suspect::new(format!("{how:?}"), fault, move |case, search, watch| {
                    traverse(Textbook::new(&case.tree, Bug::None), &mut Misasked { search, how }, watch);
                })
            })
            .into(),
    );
}

#[test]
fn every_traversal_told_something_else() {
    let cases = cases();
    for control in mutants(Mutation::None, "") {
        assert!(cases.iter().all(|case| control.fault(case).is_none()), "{}", control.name);
    }
    for (mutation, fault) in
        [(Mutation::FarFirst, "node"), (Mutation::FarLost, "early"), (Mutation::MissedWanted, "node")]
    {
        all_must_be_caught(mutants(mutation, fault));
    }
}

/// A table that answers with the sibling.
struct Misled<'t>(&'t Tree);

impl<W: KeyWord> Lookup<W> for Misled<'_> {
    fn node(&self, key: &W) -> Node {
        Keys::walk(self.0, &key.clone().xor(&W::one())).unwrap_or(self.0.root())
    }
}

/// A tree whose records name uncle and grand uncle the wrong way round.
struct Misrecorded<'t> {
    tree: &'t Tree,
    uncles: Uncles,
}

impl Topology for Misrecorded<'_> {
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
    fn recorded(&self) -> Recorded {
        Recorded::Uncles
    }
    fn links(&self, node: Node) -> [Node; 2] {
        match (&self.uncles).row(self.tree, node) {
            [uncle, grand_uncle, _] if grand_uncle == self.root() => [uncle, grand_uncle],
            [uncle, grand_uncle, _] => [grand_uncle, uncle],
        }
    }
}

struct RightFirst;

impl FixedOrder for RightFirst {
    fn first(&self, _: Node) -> Side {
        Side::Right
    }
}

#[test]
fn bugs_in_what_a_traversal_is_given() {
    let by_node = |suspect, test| Suspect { test, ..suspect };
    all_must_be_caught(vec![
        Suspect::new("hashed with a misled table", "node", |case, search, watch| {
            let uncles = <Uncles>::of(&case.tree);
            traverse(Hashed::<u64, _, _, _>::new(&case.tree, &uncles, Misled(&case.tree)).unwrap(), search, watch);
        }),
        Suspect::new("uncle with misrecorded uncles", "register", |case, search, watch| {
            let tree = Misrecorded { tree: &case.tree, uncles: Uncles::of(&case.tree) };
            traverse(Uncle::<u64, _, _>::new(&tree, RecordedUncles::of(&tree).unwrap()).unwrap(), search, watch);
        }),
        by_node(
            Suspect::new("skip pointers of the other order", "early", |case, search, watch| {
                let skips = Skips::of(&case.tree, &RightFirst);
                let mut search = ByNode { test: search, order: LeftFirst };
                traverse(Skip::new(&case.tree, &skips, LeftFirst), &mut search, watch);
            }),
            Test::NodeLeftFirst,
        ),
        by_node(
            Suspect::new("hapala with the order of the opposite octant", "node", |case, search, watch| {
                let order = |octant| SignOrder { axes: case.tape.axes(), octant };
                let mut search = ByNode { test: search, order: order(case.octant) };
                let parents = Parents::of(&case.tree);
                traverse(Hapala::new(&case.tree, &parents, order(!case.octant)), &mut search, watch);
            }),
            Test::NodeBySign,
        ),
    ]);
}

#[test]
fn a_detour_that_passes_for_a_restart() {
    let suspect = Suspect::new("a detour", "restart", |case, search, watch| {
        traverse(Wanderer::new(&case.tree, &mut Vec::new()), search, watch);
    });
    all_must_be_caught(vec![Suspect { restarts: true, ..suspect }]);
}
