//! The bugs, each with the clause that it breaks.

use super::asked::{Misasked, Misuse};
use super::given::{Misled, Misrecord, RightFirst, Short, misrecorded};
use super::mutants::{Mutation, mutants};
use super::printed::{Printed, Slip};
use super::slips::{Barringer, BarringerPrinted, Binder, BinderPrinted};
use super::textbook::{Bug, Textbook};
use super::wanderer::Wanderer;
use super::{Planted, drive};
use stackless_bvh::order::{ByNode, Descent, FixedOrder, LeftFirst, SignOrder, Whole};
use stackless_bvh::traverse::{Cursor, Hapala, Hashed, Skip, Skips, Test};
use stackless_bvh::tree::{Linked, Topology};

/// All bugs.
pub fn all() -> Vec<Planted> {
    let told = [Mutation::FarFirst, Mutation::FarLost, Mutation::MissedWanted];
    [
        BUGS.iter().map(|&(bug, clause)| textbook(bug, clause)).collect(),
        // Only what passes for a restart is not compared with the reference's next visit, and could go on for ever. And a
        // traversal that does not restart may not say that it does.
        vec![textbook(Bug::Endless, "TRAVERSE-1").restarting(), called_restart()],
        SLIPS.iter().map(|&(slip, clause)| second_trail(slip, clause)).collect(),
        vec![resumed(Slip::NoGuard)],
        told.into_iter().flat_map(mutants).collect(),
        READINGS_OF_BINDER.iter().map(|&(reading, clause, bits)| binder(reading, clause, bits)).collect(),
        READINGS_OF_BARRINGER.iter().map(|&(reading, clause)| barringer(reading, clause)).collect(),
        MISUSES.iter().map(|&(how, clause)| asked(how, clause)).collect(),
        vec![found_beyond_end(), root_untested()],
        given(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The same traversals without a bug: no check may find one.
pub fn controls() -> Vec<Planted> {
    let mut controls =
        vec![textbook(Bug::None, "TRAVERSE-1"), second_trail(Slip::None, "DISJOINT-2"), resumed(Slip::None)];
    controls.extend(mutants(Mutation::None));
    controls
}

const BUGS: [(Bug, &str); 26] = [
    (Bug::NoExit, "TRAIL-3"),
    (Bug::TrailNotToggled, "TRAIL-4"),
    (Bug::KeyNotToggled, "TRAIL-4"),
    (Bug::ShiftShort, "TRAIL-4"),
    (Bug::ShiftLong, "TRAIL-4"),
    (Bug::TrailShiftShort, "TRAIL-4"),
    (Bug::BothForOne, "TRAIL-2"),
    (Bug::NoneForBoth, "TRAIL-2"),
    (Bug::OnlyChildForgets, "TRAIL-2"),
    (Bug::NearTwice, "TRAIL-4"),
    (Bug::SkipsPostponed, "TRAIL-3"),
    (Bug::StopsOneShort, "TRAIL-3"),
    (Bug::OldestFirst, "TRAIL-3"),
    (Bug::WrongOrder, "ORDER-1"),
    (Bug::SiblingForUncle, "REGISTER-1"),
    (Bug::StaleKey, "TRAIL-4"),
    (Bug::LeftKeys, "KEY-2"),
    (Bug::NarrowKey, "DEPTH-1"),
    (Bug::NarrowTrail, "DEPTH-1"),
    (Bug::RegisterOfNear, "REGISTER-1"),
    (Bug::RegisterKept, "REGISTER-2"),
    (Bug::TrailAboveRoot, "TRAIL-1"),
    (Bug::TrailNotShifted, "TRAIL-4"),
    (Bug::CounterWithoutStart, "SPARSE-1"),
    (Bug::ShiftByWord, "TRAIL-3"),
    (Bug::AddressToggled, "TRAIL-4"),
];

const SLIPS: [(Slip, &str); 6] = [
    (Slip::FillBeforeMask, "DISJOINT-3"),
    (Slip::RegisterKept, "DISJOINT-3"),
    (Slip::RegisterLost, "DISJOINT-3"),
    (Slip::MaskInverted, "DISJOINT-1"),
    (Slip::MaskNotShifted, "DISJOINT-1"),
    (Slip::MaskLeftBehind, "DISJOINT-1"),
];

/// The last number is the width of the words.
const READINGS_OF_BINDER: [(Binder, &str, u32); 4] = [
    (Binder::ClosestOfMissed, "ORDER-1", 64),
    (Binder::DanglingElse, "HASHED-1", 64),
    (Binder::DoneIsMinusOne, "TRAIL-3", 64),
    (Binder::AnyDepth, "DEPTH-1", 8),
];

const READINGS_OF_BARRINGER: [(Barringer, &str); 3] =
    [(Barringer::MaskOfRejected, "IMPLICIT-1"), (Barringer::Combined, "IMPLICIT-3"), (Barringer::AnyDepth, "DEPTH-2")];

const MISUSES: [(Misuse, &str); 5] = [
    (Misuse::EndsAtFirstHit, "ORACLE-1"),
    (Misuse::NeverEnds, "ORACLE-1"),
    (Misuse::FirstLeafUnseen, "ORACLE-1"),
    (Misuse::AsksTwice, "ORDER-1"),
    (Misuse::LooksTwice, "ORDER-1"),
];

fn textbook(bug: Bug, clause: &'static str) -> Planted {
    Planted::any(format!("{bug:?}"), clause, move |tree, _, visitor, watcher| {
        drive(Textbook::new(tree, bug), visitor, watcher);
    })
}

fn called_restart() -> Planted {
    Planted::any("Endless, called a restart", "TRACE-1", |tree, _, visitor, watcher| {
        drive(Textbook::new(tree, Bug::Endless), visitor, watcher);
    })
}

fn second_trail(slip: Slip, clause: &'static str) -> Planted {
    let run = Planted::any(format!("second trail: {slip:?}"), clause, move |tree, _, visitor, watcher| {
        drive(Printed::new(tree, false, slip), visitor, watcher);
    });
    run.held_to(Test::Disjoint)
}

fn resumed(slip: Slip) -> Planted {
    let run = Planted::any(format!("resumed: {slip:?}"), "PAUSE-3", move |tree, _, visitor, watcher| {
        drive(Printed::new(tree, true, slip), visitor, watcher);
    });
    run.held_to(Test::Disjoint)
}

fn binder(reading: Binder, clause: &'static str, bits: u32) -> Planted {
    Planted::any(format!("Algorithm 1 of H: {reading:?}"), clause, move |tree, tape, visitor, watcher| {
        drive(BinderPrinted::new(tree, tape, reading, bits), visitor, watcher);
    })
}

fn barringer(reading: Barringer, clause: &'static str) -> Planted {
    Planted::any(format!("Algorithm 2 of J: {reading:?}"), clause, move |tree, tape, visitor, watcher| {
        drive(BarringerPrinted::new(tree, tape, reading), visitor, watcher);
    })
}

fn asked(how: Misuse, clause: &'static str) -> Planted {
    Planted::case(format!("{how:?}"), clause, move |case, search, watcher| {
        let mut misasked = Misasked { tree: &case.tree, search, how };
        drive(Textbook::new(&case.tree, Bug::None), &mut misasked, watcher);
    })
}

fn found_beyond_end() -> Planted {
    let run = Planted::case("FoundBeyondEnd", "DISJOINT-4", |case, search, watcher| {
        let mut misasked = Misasked { tree: &case.tree, search, how: Misuse::FoundBeyondEnd };
        drive(Printed::new(&case.tree, false, Slip::None), &mut misasked, watcher);
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
            let search = ByNode { test: search, order: LeftFirst };
            drive(Skip::new(&case.tree, &skips, LeftFirst), &mut Whole(search), watcher);
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
            drive(Wanderer::new(tree, &mut Vec::new()), visitor, watcher);
        })
        .restarting(),
    ]
}
