//! Every tree of up to 6 leaves under every script of decisions, through every traversal in every word.

use stackless_bvh::generate::{Exhaustive, Kind, Source, Tape, shape};
use stackless_bvh::traverse::{Method, WordName};
use stackless_bvh::tree::{Topology, Tree};
use stackless_check::{AllCases, Battery, Case, Verdict};

/// In this octant the order by sign equals the tape's.
const OCTANT: u8 = 2;

fn check(case: &Case, count: &mut u64) {
    let mut battery = Battery::new(case, &Method::ALL);
    for method in Method::ALL {
        let words = if method.has_words() { &WordName::ALL[..] } else { &WordName::ALL[..1] };
        for &word in words {
            match battery.check(method, word) {
                Verdict::Agrees { .. } => *count += 1,
                Verdict::Refused(_) => {
                    assert!(method == Method::Complete || method.restarts() && word == WordName::Grow, "{method}");
                }
                Verdict::Differs(fault) => panic!("{method} {word}: {fault}\n{case:?}"),
            }
        }
    }
}

/// [TRAVERSE-1] [CONF-1] [STACK-1] [LEFT-1] [IMPLICIT-1] [IMPLICIT-2] [IMPLICIT-3] [SPARSE-1] [AFRA-1] [UNCLE-2]
/// [HASHONLY-1] [HASHED-1] [LAINE-1] [HAPALA-1] [SKIP-1] [COMPLETE-1] [GLASSNER-1]
#[test]
fn all_trees_of_up_to_6_leaves_under_all_scripts() {
    let (all, mut comparisons) = (AllCases::up_to(6), 0);
    for number in 0..all.count() {
        check(&all.case(number), &mut comparisons);
    }
    println!("{} cases, {comparisons} comparisons", all.count());
}

#[test]
fn all_trees_of_up_to_5_leaves_under_all_scripts_with_an_end_at_any_leaf() {
    let (mut all, mut comparisons) = (Exhaustive::new(), 0);
    while all.next_case() {
        let leaves = 1 + all.below(5) as u32;
        let tree = Tree::new(&shape(&mut all, leaves)).unwrap();
        let tape = Tape::draw(&mut all, &tree, Kind::Script);
        let end = all.below(u64::from(leaves)) as usize;
        let mut leaf_slots = (0..tree.node_count()).filter(|&slot| tree.node(slot as u32).unwrap().is_leaf());
        let mut cells = tape.cells().to_vec();
        cells[leaf_slots.nth(end).unwrap()].hit = Some(0);
        let tape = Tape::from_cells(&tree, cells).unwrap();
        check(&Case { tree, tape, any: true, octant: OCTANT }, &mut comparisons);
    }
    assert!(comparisons > 100_000, "{comparisons}");
}
