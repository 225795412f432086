//! The harness bodies as ordinary tests.

use std::panic::{AssertUnwindSafe, catch_unwind};

use proofs::{ALL, CLAIM, Cases, Drawn, Harness, bits, hash, traversals};
use stackless_bvh::generate::{Exhaustive, Rng};

/// Random cases of one harness.
const CASES: u32 = 20_000;

/// Least number of cases that must satisfy the assumptions.
const ASSUMED: u32 = CASES / 20;

fn all() -> impl Iterator<Item = &'static Harness> {
    ALL.into_iter().flatten()
}

#[test]
fn every_claim_holds_at_random_and_every_cover_is_reached() {
    for harness in all() {
        let mut drawn = Drawn::new(Cases::Some(Rng::new(1)));
        let assumed = (0..CASES).filter(|_| (harness.body)(&mut drawn).is_some()).count();
        assert!(assumed as u32 >= ASSUMED, "{}: only {assumed} cases are as assumed", harness.name);
        let missed: Vec<_> = drawn.covers.iter().filter(|&(_, reached)| !reached).collect();
        assert!(missed.is_empty() && !drawn.covers.is_empty(), "{}: {missed:?}", harness.name);
    }
}

/// Returns whether one of `cases` random cases fails by the claim that the twin breaks. Other panics do not count.
fn is_refuted(body: impl Fn(&mut Drawn<true>) -> Option<()>, cases: u32) -> bool {
    let mut drawn = Drawn::new(Cases::Some(Rng::new(1)));
    (0..cases).any(|_| {
        let died = catch_unwind(AssertUnwindSafe(|| body(&mut drawn))).err();
        died.is_some_and(|said| said.downcast_ref::<String>().is_some_and(|said| said == CLAIM))
    })
}

#[test]
fn every_twin_is_refuted() {
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let missed: Vec<_> = all().filter(|harness| !is_refuted(harness.planted, 50 * CASES)).collect();
    std::panic::set_hook(quiet);
    assert!(missed.is_empty(), "{:?}", missed.iter().map(|harness| harness.twin).collect::<Vec<_>>());
}

#[test]
fn names_are_different_and_claims_name_clauses() {
    let mut names: Vec<_> = all().flat_map(|harness| [harness.name, harness.twin]).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
    for harness in all() {
        assert!(harness.claim.contains("`[") && harness.twin == format!("{}_twin", harness.name), "{harness:?}");
    }
}

/// Runs all cases of a body. Returns the number of cases that satisfy the assumptions.
fn exhaust(body: impl Fn(&mut Drawn<false>) -> Option<()>) -> u64 {
    let mut drawn = Drawn::new(Cases::All(Exhaustive::new()));
    let mut assumed = 0;
    while drawn.next_case() {
        assumed += u64::from(body(&mut drawn).is_some());
    }
    assert!(drawn.covers.values().all(|&reached| reached), "{:?}", drawn.covers);
    assumed
}

#[test]
fn all_keys_and_trails_of_8_bits() {
    assert_eq!(exhaust(bits::backtrack::<u8>), 256 * 255);
    assert_eq!(exhaust(bits::keys::<u8>), 127 * 2);
    assert!(exhaust(bits::trails::<u8>) > 10_000);
    assert!(exhaust(bits::counter::<u8>) > 10_000);
    assert_eq!(exhaust(bits::swaps::<u8>), 1 << 16);
    assert_eq!(exhaust(bits::composition::<u8>), 1 << 16);
    assert!(exhaust(bits::narrow::<u8>) > 10_000);
}

#[test]
fn all_keys_of_16_bits() {
    assert_eq!(exhaust(bits::keys::<u16>), 32_767 * 2);
    assert_eq!(exhaust(hash::remainder_u32::<7, 16>), 1 << 16);
    assert_eq!(exhaust(hash::remainder_u64::<127, 16>), 1 << 16);
}

/// Trees with up to 3 inner nodes: 1, 1, 2 and 5 of 0, 1, 2 and 3, with 8 decisions per node.
#[test]
fn all_trees_of_up_to_7_nodes_and_all_decisions() {
    let cases = 1 + 8 + 2 * 64 + 5 * 512;
    assert_eq!(exhaust(traversals::by_key::<3>), cases);
    assert_eq!(exhaust(traversals::afra::<3>), cases);
    assert_eq!(exhaust(traversals::uncle::<3>), cases);
    assert_eq!(exhaust(traversals::hashed::<3>), cases);
    assert_eq!(exhaust(traversals::sparse::<3>), cases);
    assert_eq!(exhaust(traversals::implicit_a::<3>), cases);
    assert_eq!(exhaust(traversals::implicit_a1::<3>), cases);
    assert_eq!(exhaust(traversals::implicit_b::<3>), cases);
    assert_eq!(exhaust(traversals::implicit_b1::<3>), cases);
    assert_eq!(exhaust(traversals::left_first::<3>), cases);
    assert_eq!(exhaust(traversals::hapala::<3>), cases);
    assert_eq!(exhaust(traversals::stack::<3>), cases);
    assert_eq!(exhaust(traversals::skip::<3>), cases);
    assert_eq!(exhaust(traversals::afra_resumed::<3>), cases);
    assert_eq!(exhaust(traversals::sparse_resumed::<3>), cases);
    assert_eq!(exhaust(traversals::uncle_resumed::<3>), cases);
    assert_eq!(exhaust(traversals::hashed_resumed::<3>), cases);
    assert_eq!(exhaust(traversals::hashed_by_key_and_trail::<3>), cases);
    assert_eq!(exhaust(traversals::laine::<0, 3>), cases);
    assert_eq!(exhaust(traversals::laine::<1, 3>), cases);
    assert_eq!(exhaust(traversals::laine::<2, 3>), cases);
    assert_eq!(exhaust(traversals::laine::<8, 3>), cases);
}

#[test]
fn the_reference_is_the_oracle_on_all_trees_of_up_to_9_nodes() {
    assert!(exhaust(traversals::oracle::<3>) > 40_000);
    assert!(exhaust(traversals::oracle_disjoint::<2>) > 1_000);
    assert!(exhaust(traversals::by_key::<4>) == 1 + 8 + 2 * 64 + 5 * 512 + 14 * 4096);
    assert!(exhaust(traversals::hashed::<4>) == 1 + 8 + 2 * 64 + 5 * 512 + 14 * 4096);
}
