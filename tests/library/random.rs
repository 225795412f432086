//! Random trees and tapes from bytes, shrunk by proptest and then by structure, and the depth limits of words.

use arbitrary::Unstructured;
use proptest::prelude::*;
use stackless_bvh::generate::{Family, Kind, Rng};
use stackless_bvh::traverse::{Method, Unsupported, WordName};
use stackless_bvh::tree::Topology;
use stackless_check::{Battery, Case, CaseOptions, Fault, Plan, Replay, Verdict, boundary_cases, check_random, shrink};

fn everything(trees: u64) -> Plan {
    let options = CaseOptions::default();
    Plan { trees, seed: 1, options, methods: Method::ALL.to_vec(), words: WordName::ALL.to_vec() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// [REGISTER-2] [DISJOINT-3]
    #[test]
    fn every_traversal_follows_its_oracle(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let case = Case::draw(&mut Unstructured::new(&bytes), 64);
        let plan = everything(0);
        let mut battery = Battery::new(&case, &plan.methods);
        for (method, word) in plan.pairs() {
            if let Verdict::Differs(_) = battery.check(method, word) {
                let fails = |case: &Case| matches!(Battery::new(case, &[method]).check(method, word), Verdict::Differs(_));
                let small = shrink(case.clone(), fails);
                let Verdict::Differs(fault) = Battery::new(&small, &[method]).check(method, word) else { unreachable!() };
                let replay = serde_json::to_string(&Replay::of(&small, method, word, &fault)).unwrap();
                prop_assert!(false, "stackless check --replay FILE, with this in FILE:\n{}", replay);
            }
        }
    }
}

#[test]
fn twenty_thousand_random_cases() {
    let (tally, found) = check_random(&everything(20_000), 0..20_000, &|_| ());
    assert!(found.is_none(), "{found:?}");
    for method in Method::ALL {
        let count = tally.get(method, WordName::U32);
        assert_eq!((count.cases + count.refused, count.agree), (20_000, count.cases), "{method}");
        assert!(count.cases > 19_000 || method == Method::Complete && count.cases > 3000, "{method}: {count:?}");
    }
}

/// [DEPTH-1] [DEPTH-2] [CONF-3]
#[test]
fn words_end_at_their_depths_and_no_sooner() {
    let plan = everything(0);
    for case in boundary_cases(5) {
        let depth = case.tree.depth();
        let mut battery = Battery::new(&case, &plan.methods);
        for (method, word) in plan.pairs() {
            let width = match word {
                WordName::U32 => 32,
                WordName::U64 => 64,
                WordName::U128 => 128,
                WordName::Grow => u32::MAX,
            };
            let limit = match method.without_pruning() {
                _ if !method.has_words() => u32::MAX,
                Method::Afra | Method::Uncle => width,
                Method::ImplicitA1 => width - 2,
                _ => width - 1,
            };
            match battery.check(method, word) {
                Verdict::Differs(fault) => panic!("{method} {word} at depth {depth}: {fault}"),
                Verdict::Agrees { .. } => assert!(depth <= limit, "{method} {word} accepts depth {depth}"),
                Verdict::Refused(Unsupported::TooDeep(error)) => {
                    assert_eq!((error.depth, error.limit, error.word), (depth, limit, word.name()), "{method}");
                    assert!(depth > limit, "{method} {word} refuses depth {depth}");
                }
                Verdict::Refused(unfit) => assert_eq!(method, Method::Complete, "{unfit}"),
            }
        }
    }
}

/// [DEPTH-3]
#[test]
fn a_comb_of_depth_100_000() {
    let mut rng = Rng::new(9);
    let case = comb(100_000, &mut rng, |method| !method.restarts());
    // A ray that gets shorter, with the traversals designed for such depths.
    let case = Case { any: false, ..Case::with_tree(case.tree, Kind::Shrinking, &mut rng) };
    let methods = [Method::Stack, Method::Sparse, Method::Afra, Method::Uncle, Method::Hashed];
    let mut battery = Battery::new(&case, &methods);
    for method in methods {
        let verdict = battery.check(method, WordName::Grow);
        assert!(matches!(verdict, Verdict::Agrees { .. }), "{method}: {verdict:?}");
    }
}

/// Each restart walks down from the root, so the time is quadratic in the depth. [DEPTH-3]
#[test]
fn restarts_in_a_comb_of_depth_3_000() {
    comb(3_000, &mut Rng::new(9), Method::restarts);
}

/// Traverses a whole comb with these methods, in every word that supports it.
fn comb(depth: u32, rng: &mut Rng, of: impl Fn(Method) -> bool) -> Case {
    let methods: Vec<_> = Method::ALL.into_iter().filter(|&method| of(method)).collect();
    let plan = Plan { methods, ..everything(0) };
    let tree = Family::Comb.tree(rng, depth + 1);
    let case = Case { any: false, ..Case::with_tree(tree, Kind::AllHit, rng) };
    let mut battery = Battery::new(&case, &plan.methods);
    for (method, word) in plan.pairs() {
        match battery.check(method, word) {
            Verdict::Agrees { steps } => {
                assert!(word == WordName::Grow || !method.has_words(), "{method} {word}");
                assert_eq!(steps, 2 * u64::from(depth) + 1, "{method}");
            }
            Verdict::Refused(Unsupported::TooDeep(error)) => {
                assert!(error.to_string().starts_with(&format!("the tree is {depth} edges deep, ")), "{error}");
                assert_ne!(word, WordName::Grow);
            }
            Verdict::Refused(unfit) => assert_eq!(method, Method::Complete, "{unfit}"),
            Verdict::Differs(fault) => panic!("{method} {word}: {fault}"),
        }
    }
    case
}

/// Climbs of 32 levels and more, past which shifts of narrow counts, and climbs that are cut short, go wrong; and marks that are
/// shifted with them. [SPARSE-1] [AFRA-1] [DISJOINT-1]
#[test]
fn combs_with_long_climbs() {
    let methods: Vec<Method> = Method::ALL.into_iter().filter(|method| !method.restarts()).collect();
    let mut rng = Rng::new(24);
    let mut agree = [0; WordName::ALL.len()];
    for depth in (35..=62).chain(100..=126) {
        for _ in 0..20 {
            let case = Case::chain(&mut rng, depth);
            let mut battery = Battery::new(&case, &methods);
            for &method in &methods {
                for word in [WordName::U64, WordName::U128, WordName::Grow] {
                    match battery.check(method, word) {
                        Verdict::Agrees { .. } => agree[word as usize] += 1,
                        Verdict::Refused(_) => {}
                        Verdict::Differs(fault) => panic!("{method} {word}: {fault}\n{case:?}"),
                    }
                }
            }
        }
    }
    assert!(agree[WordName::U64 as usize] > 10_000 && agree[WordName::U128 as usize] > 20_000, "{agree:?}");
}

#[test]
fn every_case_comes_back_from_a_file() {
    for seed in 0..400 {
        let case = Case::random(seed, CaseOptions::default());
        let fault = Fault::Early { visits: 0, expected: 1 };
        let replay = Replay::of(&case, Method::Stack, WordName::U64, &fault);
        let again = replay.case().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert_eq!(again, case);
    }
}
