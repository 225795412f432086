//! The errors of the papers (spec/DEPARTURES.md): the printed algorithm fails on the case of `spec/departures` as the
//! file describes, and on no smaller one. The library is right there.
//!
//! `UPDATE=1 cargo test --test library departures` searches for the cases again.

mod implicit;
mod machine;

use std::fs;
use std::path::PathBuf;

use stackless_bvh::generate::{Cell, Exhaustive, Family, Kind, Rng, Source, Tape, shape};
use stackless_bvh::hash::{BuildError, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::order::{ByNode, Descent, FixedOrder, SignOrder, Unpruned};
use stackless_bvh::traverse::{Cursor, Hapala, Method, Test, WordName, traverse_pruned};
use stackless_bvh::tree::{Linked, Node, Reach, Topology, Tree};
use stackless_bvh::{swap, trail};
use stackless_check::{Battery, Case, CaseOptions, Fault, Replay, Verdict, shrink};

use crate::disjoint::{self, Marks};
use implicit::{Implicit, Reading};
use machine::{Machine, Slip};

/// Where to search for the smallest case.
#[derive(Clone, Copy)]
enum Among {
    /// All trees of up to a number of leaves under all hits and preferences.
    Small(u32),
    /// Chains, for depth.
    Chains,
    /// Random trees with tapes of a kind, which are then shrunk.
    Random(Kind),
}

/// The printed algorithms.
#[derive(Clone, Copy, Debug)]
enum Printed {
    /// Algorithm 1 of Binder & Keller 2016.
    Algorithm1(Slip),
    /// Algorithm 1 with the second trail of Section 2.3.
    SecondTrail(Slip),
    /// Algorithm 2 of Barringer & Akenine-Möller 2013.
    Algorithm2(Reading),
    /// Hapala's traversal, which first visits the root's near child.
    RootUntested,
    /// A search that reports *found* for every best hit, even beyond its leaf's end.
    FoundBeyondEnd,
}

impl Printed {
    /// Returns the test of its reference.
    const fn test(self) -> Test {
        match self {
            Self::Algorithm1(_) | Self::Algorithm2(_) => Test::Children,
            Self::SecondTrail(_) | Self::FoundBeyondEnd => Test::Disjoint,
            Self::RootUntested => Test::NodeBySign,
        }
    }

    /// Returns the difference from its reference over a case, if any.
    fn fault(self, case: &Case) -> Option<Fault> {
        let (tree, tape) = (&case.tree, &case.tape);
        let verdict = Battery::new(case, &[]).judge(self.test(), false, |search, watch, _, _| {
            match self {
                Self::Algorithm1(slip) => {
                    traverse_pruned(Machine::<false>::new(tree, tape, slip), search, watch);
                }
                Self::SecondTrail(slip) => {
                    traverse_pruned(Machine::<true>::new(tree, tape, slip), search, watch);
                }
                Self::Algorithm2(reading) => {
                    traverse_pruned(Implicit::new(tree, tape, reading), search, watch);
                }
                Self::RootUntested => {
                    let order = SignOrder { axes: tape.axes(), octant: case.octant };
                    let linked = Linked::parents(tree);
                    let mut hapala = Hapala::new(&linked, order)?;
                    if !tree.root().is_leaf() {
                        hapala.descend(Descent::both(order.first(tree.root())));
                    }
                    traverse_pruned(hapala, &mut Unpruned(ByNode { test: search, order }), watch);
                }
                Self::FoundBeyondEnd => disjoint::traverse(case, search, Marks::BeyondEnd, watch)?,
            }
            Ok(())
        });
        if let Verdict::Differs(fault) = verdict { Some(fault) } else { None }
    }
}

struct Departure {
    id: &'static str,
    printed: Printed,
    among: Among,
}

const fn departure(id: &'static str, printed: Printed, among: Among) -> Departure {
    Departure { id, printed, among }
}

const DEPARTURES: [Departure; 12] = [
    departure("D-1", Printed::Algorithm1(Slip::ClosestOfMissed), Among::Small(3)),
    departure("D-3", Printed::Algorithm1(Slip::DanglingElse), Among::Small(6)),
    departure("D-4", Printed::Algorithm1(Slip::DoneIsMinusOne), Among::Small(3)),
    departure("D-7", Printed::Algorithm1(Slip::AnyDepth), Among::Chains),
    departure("D-10", Printed::Algorithm2(Reading::MaskOfRejected), Among::Small(3)),
    departure("D-11", Printed::Algorithm2(Reading::Combined), Among::Chains),
    departure("D-14", Printed::Algorithm2(Reading::AnyDepth), Among::Chains),
    departure("D-15", Printed::RootUntested, Among::Small(3)),
    departure("D-19", Printed::SecondTrail(Slip::MaskInverted), Among::Random(Kind::Intervals)),
    departure("D-20", Printed::SecondTrail(Slip::FillBeforeMask), Among::Random(Kind::Intervals)),
    departure("D-21", Printed::FoundBeyondEnd, Among::Random(Kind::Clipped)),
    departure("D-22", Printed::SecondTrail(Slip::NoGuard), Among::Random(Kind::Intervals)),
];

impl Departure {
    /// Returns the first failing case, smaller ones first.
    fn smallest(&self) -> Case {
        let printed = self.printed;
        let found = match self.among {
            Among::Small(leaves) => (1..=leaves).find_map(|leaves| first(printed, leaves)),
            Among::Chains => chains().find(|case| printed.fault(case).is_some()),
            Among::Random(kind) => (0..2000)
                .filter_map(|seed| {
                    let mut rng = Rng::new(seed);
                    let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 2 + seed as u32 % 12);
                    let case = Case { any: false, ..Case::with_tree(tree, kind, &mut rng) };
                    let fails = |case: &Case| printed.fault(case).is_some();
                    fails(&case).then(|| shrink(case, fails))
                })
                .min_by_key(Case::size),
        };
        found.unwrap_or_else(|| panic!("{}: nothing goes wrong", self.id))
    }
}

/// Returns the first failing case with this number of leaves.
fn first(printed: Printed, leaves: u32) -> Option<Case> {
    let mut all = Exhaustive::new();
    while all.next_case() {
        let case = small(&mut all, leaves);
        if printed.fault(&case).is_some() {
            return Some(case);
        }
    }
    None
}

/// Draws a tree with this number of leaves, and any hits and preferences at the reached nodes.
fn small(source: &mut impl Source, leaves: u32) -> Case {
    let children = shape(source, leaves);
    let tree = Tree::new(&children).expect("a tree");
    let mut cells = vec![Cell::default(); children.len()];
    for (at, children) in children.iter().enumerate() {
        let Some(children) = *children else { continue };
        let is_missed = cells[at].miss;
        let says = if is_missed { 3 } else { source.below(8) };
        (cells[at].right_first, cells[at].axis) = (says & 4 != 0, u8::from(says & 4 != 0));
        for (child, bit) in children.into_iter().zip([1, 2]) {
            cells[child as usize].miss = says & bit != 0;
        }
    }
    let tape = Tape::from_cells(&tree, cells).expect("a tape");
    // In this octant the order by sign equals the tape's.
    Case { tree, tape, any: false, octant: 2 }
}

/// Returns chains of growing depth. Only the deep child is wanted, or it comes first, or last.
fn chains() -> impl Iterator<Item = Case> {
    (1..=10_u32).flat_map(|depth| {
        (0..6).map(move |kind| {
            let (right, order) = (kind & 1 == 1, kind / 2);
            let tree = Tree::new(&chain(depth, right)).expect("a chain");
            let cell = |at: u32| Cell {
                miss: order == 0 && at % 2 == 1,
                right_first: at.is_multiple_of(2) && at < 2 * depth && right == (order != 2),
                ..Cell::default()
            };
            let tape = Tape::from_cells(&tree, (0..=2 * depth).map(cell).collect()).expect("a tape");
            Case { tree, tape, any: false, octant: 0 }
        })
    })
}

/// Returns a chain with a leaf as the sibling of each inner node. Even indices continue downwards.
fn chain(depth: u32, right: bool) -> Vec<Option<[u32; 2]>> {
    let children = |at| if right { [at + 1, at + 2] } else { [at + 2, at + 1] };
    (0..=2 * depth).map(|at| (at % 2 == 0 && at < 2 * depth).then(|| children(at))).collect()
}

fn file(id: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../spec/departures/{id}.json"))
}

/// [CONF-1] [DISJOINT-3] [PAUSE-3]
#[test]
fn what_is_printed_goes_wrong_where_the_file_says() {
    for departure in DEPARTURES {
        let Departure { id, printed, .. } = departure;
        if std::env::var_os("UPDATE").is_some() {
            let case = departure.smallest();
            let fault = printed.fault(&case).expect("a fault");
            let replay =
                Replay { methods: Vec::new(), word: None, ..Replay::of(&case, Method::Stack, WordName::U64, &fault) };
            fs::write(file(id), serde_json::to_string_pretty(&replay).expect("text") + "\n").expect("a file");
        }
        let replay = Replay::load(&file(id)).unwrap_or_else(|error| panic!("{id}: {error}"));
        let case = replay.case().expect("a case");
        let fault = printed.fault(&case).map(|fault| fault.to_string());
        assert!(fault.is_some(), "{id}: what is printed is right");
        assert_eq!(fault, replay.fault, "{id}");

        let mut battery = Battery::new(&case, &Method::ALL);
        for method in Method::ALL {
            for word in WordName::ALL {
                let verdict = battery.check(method, word);
                assert!(!matches!(verdict, Verdict::Differs(_)), "{id}: {method} {word}: {verdict:?}");
            }
        }
    }
}

#[test]
fn no_smaller_case_does() {
    for departure in DEPARTURES {
        let printed = departure.printed;
        let case = Replay::load(&file(departure.id)).expect("a replay").case().expect("a case");
        match departure.among {
            Among::Small(_) => {
                let leaves = (case.size() as u32).div_ceil(2);
                for fewer in (1..leaves).take_while(|&fewer| fewer <= 5) {
                    assert_eq!(first(printed, fewer), None, "{}", departure.id);
                }
            }
            Among::Chains => {
                let mut shallower = chains().take_while(|chain| chain.size() < case.size());
                assert!(shallower.all(|chain| printed.fault(&chain).is_none()), "{}", departure.id);
            }
            Among::Random(_) => assert!(case.size() <= 9, "{}: {}", departure.id, case.size()),
        }
    }
}

/// A failing case is shrunk, and keeps its fault through a file.
#[test]
fn a_found_case_is_made_small() {
    let printed = Printed::Algorithm1(Slip::DoneIsMinusOne);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("case.json");
    let mut count = 0;
    for case in (0..40).map(|seed| Case::random(seed, CaseOptions::default())) {
        if printed.fault(&case).is_none() {
            continue;
        }
        count += 1;
        let small = shrink(case, |case| printed.fault(case).is_some());
        let fault = printed.fault(&small).expect("a fault");
        assert!(small.size() <= 9, "{}: {fault}", small.size());
        let replay = Replay::of(&small, Method::Stack, WordName::U64, &fault);
        fs::write(&file, serde_json::to_string(&replay).expect("text")).expect("a file");
        let again = Replay::load(&file).expect("a replay");
        assert_eq!(again.fault, Some(fault.to_string()));
        assert_eq!(again.case().expect("a case"), small);
    }
    assert!(count > 5, "{count}");
}

/// Errors without a case of a tree: shared addresses, numbers, sizes.
#[test]
fn slips_that_numbers_show() {
    // D-2: both children at one address. By address the key turns right wherever the search goes.
    let [left, right] = [Node::leaf(0); 2];
    let by_address = |key: u32, to: Node| key << 1 | u32::from(to == right);
    assert_eq!((by_address(1, left), by_address(1, right)), (3, 3));

    // D-12: levelIndex 2 under the mask 010 at depth 3.
    assert_eq!(7 + swap::fcomp(2_u32, &0b010), 7);
    assert_eq!(8 + 2 - 1, 9);

    // D-13: the address as printed, at depth 7 in 8 bits; the key does not leave the word.
    let (level_start, level_index, swap_mask) = (128_u8, 127_u8, 127_u8);
    assert_eq!(level_start.checked_add(level_index).and_then(|sum| sum.checked_add(swap_mask)), None);
    assert_eq!(level_start | swap::fcomp(level_index, &swap_mask), 128);

    // D-23: three nodes, none of them hashed. D-24: resumed by key alone at 3, the search visits 2 again.
    let tree = Tree::new(&chain(1, false)).expect("a chain");
    assert!(!KeySet::Exact(Reach::ALGORITHM_1).slots(&tree).contains(&true));
    assert_eq!(trail::backtrack(3_u32, 1), (2, 0));

    // D-25: (k + d) mod H overflows in 32 bits. Reducing first gives the right result.
    let (k, d, h) = (u32::MAX, 1_u32, 7_u32);
    assert_eq!(k.wrapping_add(d) % h, 0);
    assert_eq!((k % h + d) % h, ((u64::from(k) + u64::from(d)) % u64::from(h)) as u32);
    assert_ne!((k % h + d) % h, 0);
}

/// D-26: for some trees no table with the printed function exists, and its linear search has no stated limit. [HASH-4]
#[test]
fn chains_without_a_printed_table() {
    let shallowest = |key_set| {
        let fails = |depth: &u32| {
            let tree = Tree::new(&chain(*depth, false)).expect("a chain");
            let table = PerfectHash::build_plain(&tree, Options { key_set, sizing: Sizing::Printed });
            matches!(table, Err(BuildError::NoDisplacement { .. }))
        };
        (1..=31).find(fails)
    };
    assert_eq!(shallowest(KeySet::All), Some(7));
    assert_eq!(shallowest(KeySet::Paper), Some(15));
}

/// D-9: a counter without an end test climbs to the root, one step per level.
#[test]
fn what_the_climb_to_the_root_costs() {
    for depth in 1..=7_u32 {
        let at_the_end = trail::counter(0, 1_u32 << depth);
        assert_eq!((at_the_end + 1).trailing_zeros(), depth);
    }
}
