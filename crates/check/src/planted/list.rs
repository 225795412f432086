//! The bugs, each with the clause that it breaks.

use super::asked::{Misasked, Misuse};
use super::given::{Misled, Misrecord, RightFirst, Short, misrecorded};
use super::implicit::{Implicit, Reading};
use super::machine::{BUGS, Bug, Machine, Text};
use super::mutants::mutants;
use super::wrapped::{Mutation, Wrapped};
use super::{LAYERS, Layer, Mistake, Planted, SHADERS, drive};
use stackless_bvh::order::{ByNode, Descent, FixedOrder, LeftOrder, SignOrder, Whole};
use stackless_bvh::traverse::{Cursor, Hapala, Hashed, Skip, Skips, Stack, Test};
use stackless_bvh::tree::{Linked, Topology};

/// All bugs.
pub fn all() -> Vec<Planted> {
    let told = [Mutation::FarFirst, Mutation::FarLost, Mutation::MissedWanted];
    [
        machines(Text::Climb).collect(),
        vec![endless(), called_restart()],
        machines(Text::SecondTrail).collect(),
        machines(Text::Resumed).collect(),
        told.into_iter().flat_map(mutants).collect(),
        machines(Text::Algorithm1).collect(),
        READINGS.iter().map(|&(reading, clause)| implicit(reading, clause)).collect(),
        MISUSES.iter().map(|&(how, clause)| asked(how, clause)).collect(),
        vec![marked(Misuse::FoundBeyondEnd, "DISJOINT-4"), root_untested()],
        given(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Searches that mark otherwise than they may. That a hit is lost by it is seen beside the battery's comparison.
pub fn marks() -> Vec<Planted> {
    vec![marked(Misuse::TouchingMarked, "ORDER-2"), marked(Misuse::FarFirstMarked, "ORDER-2")]
}

/// The same traversals without a bug: no check may find one.
pub fn controls() -> Vec<Planted> {
    let texts = [(Text::Climb, "TRAVERSE-1"), (Text::SecondTrail, "DISJOINT-2"), (Text::Resumed, "PAUSE-3")];
    let mut controls: Vec<_> = texts.into_iter().map(|(text, clause)| machine(text, Bug::None, clause)).collect();
    controls.extend(mutants(Mutation::None));
    controls
}

const READINGS: [(Reading, &str); 3] =
    [(Reading::MaskOfRejected, "IMPLICIT-1"), (Reading::Combined, "IMPLICIT-3"), (Reading::AnyDepth, "DEPTH-2")];

const MISUSES: [(Misuse, &str); 5] = [
    (Misuse::EndsAtFirstHit, "ORACLE-1"),
    (Misuse::NeverEnds, "ORACLE-1"),
    (Misuse::FirstLeafUnseen, "ORACLE-1"),
    (Misuse::AsksTwice, "ORDER-1"),
    (Misuse::LooksTwice, "ORDER-1"),
];

/// The mistakes of a text.
fn machines(text: Text) -> impl Iterator<Item = Planted> {
    BUGS.iter().filter(move |bug| bug.0 == text).map(|&(text, bug, clause)| machine(text, bug, clause))
}

fn machine(text: Text, bug: Bug, clause: &'static str) -> Planted {
    let named = match text {
        Text::Climb => "",
        Text::Algorithm1 => "Algorithm 1 of H: ",
        Text::SecondTrail => "second trail: ",
        Text::Resumed => "resumed: ",
    };
    let prunes = matches!(text, Text::SecondTrail | Text::Resumed);
    let run = Planted::any(format!("{named}{bug:?}"), clause, move |tree, tape, visitor, watcher| {
        if prunes {
            drive(Machine::<true>::new(tree, tape, text, bug), visitor, watcher);
        } else {
            drive(Machine::<false>::new(tree, tape, text, bug), visitor, watcher);
        }
    });
    if prunes { run.held_to(Test::Disjoint) } else { run }
}

/// Only what passes for a restart is not compared with the reference's next visit, and could go on for ever.
fn endless() -> Planted {
    machine(Text::Climb, Bug::Endless, "TRAVERSE-1").restarting()
}

/// A traversal that does not restart may not say that it does.
fn called_restart() -> Planted {
    Planted { name: "Endless, called a restart".into(), ..machine(Text::Climb, Bug::Endless, "TRACE-1") }
}

fn implicit(reading: Reading, clause: &'static str) -> Planted {
    Planted::any(format!("Algorithm 2 of J: {reading:?}"), clause, move |tree, tape, visitor, watcher| {
        drive(Implicit::new(tree, tape, reading), visitor, watcher);
    })
}

fn asked(how: Misuse, clause: &'static str) -> Planted {
    Planted::case(format!("{how:?}"), clause, move |case, search, watcher| {
        let machine = Machine::<false>::new(&case.tree, &case.tape, Text::Climb, Bug::None);
        drive(machine, &mut Misasked { case, search, how }, watcher);
    })
}

fn marked(how: Misuse, clause: &'static str) -> Planted {
    let run = Planted::case(format!("{how:?}"), clause, move |case, search, watcher| {
        let machine = Machine::<true>::new(&case.tree, &case.tape, Text::SecondTrail, Bug::None);
        drive(machine, &mut Misasked { case, search, how }, watcher);
    });
    run.held_to(Test::Disjoint)
}

fn root_untested() -> Planted {
    let run = Planted::case("hapala: the root untested", "HAPALA-1", |case, search, watcher| {
        let (tree, order) = (&case.tree, SignOrder { axes: case.tape.axes(), octant: case.octant });
        let linked = Linked::parents(tree);
        let Ok(mut hapala) = Hapala::new(&linked, order) else { return };
        // The first visit is that of the root's near child.
        if !tree.root().is_leaf() {
            hapala.descend(Descent::both(order.first(tree.root())));
        }
        drive(hapala, &mut Whole(ByNode { test: search, order }), watcher);
    });
    run.held_to(Test::NodeBySign)
}

fn given() -> Vec<Planted> {
    vec![
        Planted::any("hashed: a table that answers with the sibling", "HASHED-1", |tree, _, visitor, watcher| {
            if let Ok(cursor) = Hashed::<u64, _, _>::new(&Linked::uncles(tree), Misled(tree)) {
                drive(cursor, visitor, watcher);
            }
        }),
        Planted::any("hashed: the keys of records that reach further", "HASH-3", |tree, _, visitor, watcher| {
            if let Ok(cursor) = Hashed::<u64, _, _>::new(&Linked::uncles(tree), Short::of(tree)) {
                drive(cursor, visitor, watcher);
            }
        }),
        misrecorded("uncle: uncle and grand uncle changed places", Misrecord::GrandUncle),
        Planted::case("skip: pointers of the other order", "SKIP-1", |case, search, watcher| {
            let skips = Skips::of(&case.tree, &RightFirst);
            let search = ByNode { test: search, order: LeftOrder };
            drive(Skip::new(&case.tree, &skips, LeftOrder), &mut Whole(search), watcher);
        })
        .held_to(Test::NodeLeftFirst),
        Planted::case("hapala: the order of the opposite octant", "HAPALA-1", |case, search, watcher| {
            let order = |octant| SignOrder { axes: case.tape.axes(), octant };
            let linked = Linked::parents(&case.tree);
            let Ok(hapala) = Hapala::new(&linked, order(!case.octant)) else { return };
            drive(hapala, &mut Whole(ByNode { test: search, order: order(case.octant) }), watcher);
        })
        .held_to(Test::NodeBySign),
        Planted::any("a detour that passes for a restart", "LAINE-1", |tree, _, visitor, watcher| {
            drive(Wrapped::new(tree, Stack::new(tree, &mut Vec::new()), Mutation::Wandering), visitor, watcher);
        })
        .restarting(),
    ]
}

/// All bugs, in the order of `tests/PLANTED.md`: each as it is called there, which for what is no traversal is after
/// its section and a colon, with the clause that it breaks.
///
/// ```
/// use stackless_check::planted::rows;
///
/// assert!(rows().contains(&("NoExit".to_owned(), "TRAIL-3")));
/// ```
pub fn rows() -> Vec<(String, &'static str)> {
    let traversal = |section: &'static str| move |bug: Planted| (format!("{section}{}", bug.name()), bug.clause());
    let mistake = |layer: &Layer, mistake: &Mistake| (format!("{}: {}", layer.name, mistake.name()), mistake.clause());
    let traversals = all().into_iter().map(traversal("")).chain(marks().into_iter().map(traversal("marks: ")));
    let layers = LAYERS.iter().flat_map(|layer| layer.mistakes.iter().map(move |it| mistake(layer, it)));
    let shaders = SHADERS.iter().map(|bug| (format!("kernels of gpu-check: {}", bug.name), bug.clause));
    traversals.chain(layers).chain(shaders).collect()
}

/// Who looks for planted bugs, beside the battery and the fuzzer, which see all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seer {
    /// The conformance suite.
    Suite,
    /// The bodies of proof harnesses.
    Harness,
}

/// Why a bug does not show, by its name in a section of `tests/PLANTED.md` that is not of traversals after that; `None`
/// if it has to.
pub fn unseen(name: &str, by: Seer) -> Option<&'static str> {
    UNSEEN.iter().find(|row| (row.0, row.1) == (name, by)).map(|row| row.2)
}

const UNSEEN: [(&str, Seer, &str); 8] = [
    ("AsksTwice", Seer::Suite, "the second answer is the first one"),
    ("a detour that passes for a restart", Seer::Suite, "visits on the way down again are not told"),
    ("smaller bounds: half for edge functions in single precision", Seer::Suite, HALF),
    ("smaller bounds: half for signs", Seer::Suite, HALF),
    ("Algorithm 1 of H: ClosestOfMissed", Seer::Harness, "harnesses do not choose between boxes that are missed"),
    ("Algorithm 1 of H: AnyDepth", Seer::Harness, DEEP),
    ("Algorithm 2 of J: Combined", Seer::Harness, DEEP),
    ("Algorithm 2 of J: AnyDepth", Seer::Harness, DEEP),
];

const HALF: &str = "errors of more than half of it are known, but beside an edge, where an answer turns on it, none of \
     more than that of `far-off-single` and `far-off-double`";

const DEEP: &str = "it takes words of 8 bits in deeper trees than harnesses have";
