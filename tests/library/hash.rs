//! The perfect hash: every table is certified, built equally by one thread and by many, and queried for every key.

use std::cell::RefCell;
use std::collections::HashMap;

use stackless_bvh::generate::{Exhaustive, Family, Kind, Rng, Search, Source, Tape, shape};
use stackless_bvh::hash::Verified;
use stackless_bvh::hash::{BuildError, KeySet, Lookup, Options, PerfectHash, Sizing};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::traverse::{ByKey, Hashed, Test, traverse};
use stackless_bvh::tree::{Keys, Linked, Node, Reach, Topology, Tree};
use stackless_check::{Battery, Case, CaseOptions, Verdict, check_table};

/// All reaches. Tables are built for the first four.
const REACHES: [(u32, u32); 9] = [(1, 1), (1, 2), (2, 2), (2, 3), (1, 3), (2, 1), (3, 1), (3, 2), (3, 3)];

fn reach((inner, leaf): (u32, u32)) -> Reach {
    Reach::new(inner, leaf).unwrap()
}

fn key_sets() -> impl Iterator<Item = KeySet> {
    REACHES.into_iter().take(4).map(reach).map(KeySet::Exact).chain([KeySet::All, KeySet::Paper])
}

/// Returns a comb. `right` is its direction at each level, from the root down.
fn comb(depth: u32, right: impl Fn(u32) -> bool) -> Tree {
    let inner = |i: u32| if right(i) { [2 * i + 1, 2 * i + 2] } else { [2 * i + 2, 2 * i + 1] };
    let children: Vec<_> = (0..depth).flat_map(|i| [Some(inner(i)), None]).chain([None]).collect();
    Tree::new(&children).unwrap()
}

/// A complete tree of `width` (a power of two) ends, each with a chain of `length` inner nodes to the left.
fn chains(width: u32, length: u32) -> Tree {
    let mut children: Vec<Option<[u32; 2]>> = (0..width - 1).map(|i| Some([2 * i + 1, 2 * i + 2])).collect();
    children.extend((0..width).map(|_| None));
    for end in width - 1..2 * width - 1 {
        let mut node = end;
        for _ in 0..length {
            let next = children.len() as u32;
            children[node as usize] = Some([next, next + 1]);
            children.extend([None, None]);
            node = next;
        }
    }
    Tree::new(&children).unwrap()
}

fn check(tree: &Tree, keys: &Keys, options: Options) -> PerfectHash {
    check_table(tree, keys, options).unwrap_or_else(|fault| panic!("{options:?}: {fault}\n{:?}", tree.to_children()))
}

fn check_all(tree: &Tree) -> u32 {
    let keys = Keys::of(tree);
    let options = key_sets().flat_map(|key_set| Sizing::ALL.map(|sizing| Options { key_set, sizing }));
    options.map(|options| check(tree, &keys, options).header().reseeds).sum()
}

/// [HASH-9]
#[test]
fn every_family_at_every_size() {
    let mut rng = Rng::new(1);
    for family in Family::ALL {
        for leaves in (1..20).chain([31, 32, 33, 64, 100, 1000, 20_000]) {
            check_all(&family.tree(&mut rng, leaves));
        }
    }
}

/// [HASH-7]
#[test]
fn combs_of_every_depth() {
    for depth in (0..130).chain([1000]) {
        check_all(&comb(depth, |_| false));
        check_all(&comb(depth, |_| true));
        check_all(&comb(depth, |i| i % 3 == 1));
    }
    let tree = comb(100_000, |i| i % 5 < 2);
    let keys = Keys::of(&tree);
    for sizing in Sizing::ALL {
        let hash = check(&tree, &keys, Options { key_set: KeySet::All, sizing });
        // The longest keys, and some between.
        for slot in (0..tree.node_count()).rev().step_by(20_001) {
            assert_eq!(Some(hash.node(&keys.key::<Grow>(slot))), tree.node(slot as u32));
        }
    }
}

/// [HASH-8]
#[test]
fn parallel_chains() {
    for (width, length) in [(2, 30), (16, 27), (256, 30), (1024, 20), (256, 70)] {
        check_all(&chains(width, length));
    }
}

/// [HASH-9]
#[test]
fn random_trees_with_keys_of_up_to_63_bits() {
    let mut rng = Rng::new(3);
    let mut remedied = [0; 3];
    for i in 0..3_000 {
        let tree = loop {
            let family = Family::ALL[rng.below(6) as usize];
            let leaves = 1 + rng.below(200) as u32;
            let tree = family.tree(&mut rng, leaves);
            if tree.depth() < 63 {
                break tree;
            }
        };
        let keys = Keys::of(&tree);
        for (sizing, remedied) in Sizing::ALL.into_iter().zip(&mut remedied) {
            let key_set = key_sets().nth(i % 6).unwrap();
            let hash = check(&tree, &keys, Options { key_set, sizing });
            *remedied += u32::from(hash.header().mix.seed.is_some());
        }
    }
    println!("tables of 3,000 that need a seed, by sizing: {remedied:?}");
}

/// Returns the depths at which a comb has two keys that no displacement separates.
fn depths_that_fail(options: Options, right: impl Fn(u32) -> bool + Copy) -> Vec<u32> {
    let fails = |&depth: &u32| {
        let plain = PerfectHash::build_plain(&comb(depth, right), options);
        matches!(plain, Err(BuildError::NoDisplacement { inseparable: true, .. }))
    };
    (0..64).filter(fails).collect()
}

/// The hidden failure of the printed function (INVENTORY H9), by the side to which a comb grows and by sizing.
/// [HASH-4] [HASH-7]
#[test]
fn the_printed_function_fails_on_combs_and_the_seed_is_the_remedy() {
    let exact = KeySet::Exact(Reach::ALGORITHM_1);
    let all_nodes = [7, 12, 15, 22, 29, 30, 31, 37, 38, 42, 46, 48, 53, 54, 55, 57, 61, 62, 63];
    let hashed_nodes = [
        10, 13, 18, 19, 20, 22, 24, 25, 27, 28, 30, 31, 34, 35, 37, 39, 40, 41, 45, 46, 47, 48, 49, 50, 52, 55, 57, 58,
        59, 60, 61, 62,
    ];
    for (key_set, sizing, expected) in [
        (KeySet::All, Sizing::Printed, &all_nodes[..]),
        (exact, Sizing::PrintedHashed, &hashed_nodes[..]),
        (KeySet::Paper, Sizing::PrintedHashed, &hashed_nodes[..]),
        (KeySet::All, Sizing::Tight, &[]),
        (exact, Sizing::Tight, &[]),
    ] {
        for right in [false, true] {
            assert_eq!(depths_that_fail(Options { key_set, sizing }, |_| right), expected, "{key_set:?} {sizing}");
        }
    }
    for (depth, key_set, sizing) in [
        (31, KeySet::All, Sizing::Printed),
        (63, KeySet::All, Sizing::Printed),
        (31, exact, Sizing::PrintedHashed),
        (40, exact, Sizing::PrintedHashed),
        (60, exact, Sizing::PrintedHashed),
    ] {
        let (tree, options) = (comb(depth, |_| false), Options { key_set, sizing });
        let error = PerfectHash::build_plain(&tree, options).unwrap_err();
        let hash = check(&tree, &Keys::of(&tree), options);
        assert!(hash.header().mix.seed.is_some());
        println!("comb of depth {depth}, {sizing}: {error}; {} seeds tried", hash.header().reseeds);
    }
    // The first of them in detail: N = 63, D = 16, H = 127. The teeth 2^4 + 1 and 2^11 + 1 are both 1 modulo 16, and 17
    // modulo 127.
    let error =
        PerfectHash::build_plain(&comb(31, |_| false), Options { key_set: KeySet::All, sizing: Sizing::Printed });
    let Err(BuildError::NoDisplacement { bucket: 1, keys: 29, displacements: 16, cells, inseparable: true }) = error
    else {
        panic!("{error:?}");
    };
    assert_eq!(cells.get(), 127);
}

/// Records the lookups of a search, and answers them by a walk.
struct Asked<'a> {
    tree: &'a Tree,
    slots: RefCell<&'a mut [bool]>,
}

impl<W: KeyWord> Lookup<W> for Asked<'_> {
    fn node(&self, key: &W) -> Node {
        let node = Keys::walk(self.tree, key).unwrap();
        self.slots.borrow_mut()[self.tree.slot(node)] = true;
        node
    }
}

fn ask<const INNER: u32, const LEAF: u32>(tree: &Tree, tape: &Tape, slots: &mut [bool]) {
    let uncles = Linked::<_, INNER, LEAF>::reaching(tree);
    let cursor = Hashed::<u32, _, _>::new(&uncles, Asked { tree, slots: RefCell::new(slots) });
    traverse(cursor.unwrap(), &mut Search::new(tree, tape, false), &mut ());
}

/// Every tree of up to 7 leaves under every script of decisions. The nodes looked up by some search are exactly those
/// of the set. A missing key would fail a search, and a superfluous key would be detected here. [HASH-3]
#[test]
fn the_exact_sets_are_what_is_looked_up_and_nothing_else() {
    type Asked = [Vec<bool>; REACHES.len()];
    let (mut all, mut trees, mut scripts) = (Exhaustive::new(), HashMap::<_, (Tree, Asked)>::new(), 0_u64);
    while all.next_case() {
        let leaves = 1 + all.below(7) as u32;
        let children = shape(&mut all, leaves);
        let tree = Tree::new(&children).unwrap();
        let tape = Tape::draw(&mut all, &tree, Kind::Script);
        let nothing = REACHES.map(|_| vec![false; tree.node_count()]);
        let (tree, asked) = trees.entry(children).or_insert((tree, nothing));
        ask::<1, 1>(tree, &tape, &mut asked[0]);
        ask::<1, 2>(tree, &tape, &mut asked[1]);
        ask::<2, 2>(tree, &tape, &mut asked[2]);
        ask::<2, 3>(tree, &tape, &mut asked[3]);
        ask::<1, 3>(tree, &tape, &mut asked[4]);
        ask::<2, 1>(tree, &tape, &mut asked[5]);
        ask::<3, 1>(tree, &tape, &mut asked[6]);
        ask::<3, 2>(tree, &tape, &mut asked[7]);
        ask::<3, 3>(tree, &tape, &mut asked[8]);
        scripts += 1;
    }
    let (mut unsound, mut conservative) = (0, 0);
    for (tree, asked) in trees.values() {
        for (i, asked) in asked.iter().enumerate() {
            assert_eq!(
                *asked,
                KeySet::Exact(reach(REACHES[i])).slots(tree),
                "{:?} {:?}",
                REACHES[i],
                tree.to_children()
            );
        }
        // The printed rule is exact for (1, 2) and (2, 2), lacks keys for (1, 1), and has too many for (2, 3).
        let paper = KeySet::Paper.slots(tree);
        assert_eq!((&paper, &paper), (&asked[1], &asked[2]));
        unsound += paper.iter().zip(&asked[0]).filter(|&(&printed, &asked)| asked && !printed).count();
        conservative += paper.iter().zip(&asked[3]).filter(|&(&printed, &asked)| printed && !asked).count();
        assert!(paper.iter().zip(&asked[0]).all(|(&printed, &asked)| asked || !printed));
        assert!(paper.iter().zip(&asked[3]).all(|(&printed, &asked)| printed || !asked));
    }
    assert!(unsound > 0 && conservative > 0);
    println!(
        "{} trees, {scripts} scripts; printed rule: {unsound} keys missing for (1, 1), {conservative} too many for (2, 3)",
        trees.len()
    );
}

/// Returns lookups and misses of a case, with a table for a set of keys.
fn misses<W: KeyWord, const INNER: u32, const LEAF: u32>(case: &Case, key_set: KeySet) -> (usize, usize) {
    let (tree, keys) = (&case.tree, Keys::of(&case.tree));
    let sizing = Sizing::ALL[case.octant as usize % 3];
    let hash = PerfectHash::build(tree, Options { key_set, sizing }).unwrap();
    let uncles = Linked::<_, INNER, LEAF>::reaching(tree);
    let verified = Verified::new(&hash, tree, &keys);
    let verdict = Battery::new(case, &[]).judge(Test::Children, false, |search, watch, _, _| {
        traverse(Hashed::<W, _, _>::new(&uncles, &verified)?, search, watch);
        Ok(())
    });
    assert!(matches!(verdict, Verdict::Agrees { .. } | Verdict::Refused(_)), "{verdict:?}");
    (verified.lookups(), verified.misses())
}

/// [HASH-10] [HASHED-1]
#[test]
fn searches_follow_the_oracle_by_the_tables_and_miss_nothing() {
    let (mut lookups, mut paper, mut by_key) = ([0; 4], [0; 4], 0);
    let (mut hashed, mut nodes) = ([0; 4], 0);
    for seed in 0..20_000 {
        let case = Case::random(seed, CaseOptions::default());
        let exact = |i: usize| KeySet::Exact(reach(REACHES[i]));
        let found = [
            misses::<u32, 1, 1>(&case, exact(0)),
            misses::<u64, 1, 2>(&case, exact(1)),
            misses::<u128, 2, 2>(&case, exact(2)),
            misses::<Grow, 2, 3>(&case, exact(3)),
        ];
        let printed = [
            misses::<u32, 1, 1>(&case, KeySet::Paper).1,
            misses::<u32, 1, 2>(&case, KeySet::Paper).1,
            misses::<u32, 2, 2>(&case, KeySet::Paper).1,
            misses::<u32, 2, 3>(&case, KeySet::Paper).1,
        ];
        for i in 0..4 {
            lookups[i] += found[i].0;
            assert_eq!(found[i].1, 0, "{:?} {case:?}", REACHES[i]);
            paper[i] += printed[i];
            hashed[i] += exact(i).slots(&case.tree).iter().filter(|&&is| is).count();
        }
        nodes += case.size();

        // Without register and uncles, so all keys are needed.
        let hash = PerfectHash::build(&case.tree, Options { key_set: KeySet::All, sizing: Sizing::Tight }).unwrap();
        let verdict = Battery::new(&case, &[]).judge(Test::Children, false, |search, watch, _, _| {
            traverse(ByKey::<u64, _>::new(&case.tree, &hash)?, search, watch);
            Ok(())
        });
        assert!(matches!(verdict, Verdict::Agrees { .. }), "{verdict:?}");
        by_key += 1;
    }
    assert!(lookups.iter().all(|&n| n > 1000) && by_key > 1000);
    assert!(paper[0] > 100 && paper[1..] == [0; 3], "{paper:?}");
    let shares = hashed.map(|n| 100.0 * n as f64 / nodes as f64);
    println!(
        "lookups {lookups:?}, misses under the printed rule {paper:?}, hashed % {shares:.1?} for {:?}",
        &REACHES[..4]
    );
}

#[test]
#[cfg(debug_assertions)]
#[should_panic(expected = "is not one that the table was made for")]
fn debug_builds_refuse_other_keys() {
    let tree = comb(9, |_| true);
    let key_set = KeySet::Exact(Reach::ALGORITHM_1);
    PerfectHash::build(&tree, Options { key_set, sizing: Sizing::Tight }).unwrap().node(&1_u32);
}
