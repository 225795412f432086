//! Traversals of wide trees: compared with their oracle, at the limits of words, and with binary ones for two children.

use arbitrary::Unstructured;
use std::collections::BTreeSet;

use proptest::prelude::*;
use stackless_bvh::event::Trace;
use stackless_bvh::generate::{
    Exhaustive, Kind, Rng, Source, Tape, WideAnswer, WideTape, shape, wide_shape, wide_tree,
};
use stackless_bvh::hash::Lookup;
use stackless_bvh::internals::wide::{StateView, TrailWord, asked_keys};
use stackless_bvh::order::{Flow, Side, Visitor};
use stackless_bvh::traverse::{self, Afra};
use stackless_bvh::tree::{self, Node};
use stackless_bvh::wide::{
    Method, PendingStore, RankedChild, Search, Tables, Topology, Trail, Tree, Unsupported, Wanted, key_level,
};
use stackless_check::WideCase;

fn check<const A: usize>(case: &WideCase<A>) -> u32 {
    match case.check() {
        Ok(count) => count,
        Err(fault) => panic!("{A} children: {fault}\n{case:?}"),
    }
}

fn exhaust<const A: usize>(leaves: u32, chain: u32, distances: u32) -> [u64; 2] {
    let (mut all, mut cases, mut comparisons) = (Exhaustive::new(), 0, 0);
    while all.next_case() {
        comparisons += u64::from(check(&WideCase::<A>::draw(&mut all, leaves, chain, distances)));
        cases += 1;
    }
    [cases, comparisons]
}

/// [WIDE-5] [WIDE-6] [WIDE-7] [WIDE-13] [WIDE-15] [WIDE-17] [WIDE-18] [WIDE-19] [WSTACK-1] [WTRAIL-1] [WRECORD-1]
/// [WHASHED-1] [WRESTART-1]
#[test]
fn all_small_trees_under_all_answers() {
    let counts = [exhaust::<2>(3, 1, 1), exhaust::<4>(3, 0, 2), exhaust::<8>(3, 1, 1)];
    for [cases, comparisons] in counts {
        assert!(cases > 5000 && comparisons > 15 * cases, "{cases} cases, {comparisons} comparisons");
    }
    println!("{counts:?}");
}

fn random<const A: usize>(seed: u64, cases: u32, leaves: u32) {
    let mut rng = Rng::new(seed);
    for _ in 0..cases {
        let distances = 1 + rng.below(40) as u32;
        check(&WideCase::<A>::draw(&mut rng, leaves, leaves / 2, distances));
    }
}

#[test]
fn random_trees_of_all_widths() {
    random::<2>(1, 4000, 24);
    random::<4>(2, 4000, 40);
    random::<8>(3, 4000, 64);
    random::<8>(4, 200, 600);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn trees_from_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let case = WideCase::<8>::draw(&mut Unstructured::new(&bytes), 48, 12, 12);
        prop_assert!(case.check().is_ok(), "{:?}\n{case:?}", case.check());
    }
}

/// Returns a chain whose inner nodes reach exactly this level, each with `A - 1` leaves around the next node.
fn chain<const A: usize>(levels: u32, rng: &mut Rng) -> Tree<A> {
    let mut nodes: Vec<Option<Vec<u32>>> = vec![None];
    let mut last = 0;
    for _ in 0..=levels {
        let first = nodes.len() as u32;
        nodes.extend(vec![None; A]);
        nodes[last] = Some((first..first + A as u32).collect());
        last = (first + rng.below(A as u64) as u32) as usize;
    }
    wide_tree(&nodes)
}

fn at_the_limits<const A: usize>(limits: &[u32]) {
    let mut rng = Rng::new(7);
    for levels in limits.iter().flat_map(|&limit| [limit - 1, limit, limit + 1]) {
        let tree = chain::<A>(levels, &mut rng);
        assert_eq!(tree.levels(), levels);
        let tables = Tables::new(&tree);
        for _ in 0..8 {
            check(&WideCase::with_tree(&mut rng, tree.clone(), 30));
        }
        for method in Method::ALL {
            let limit = match method {
                Method::Stack => u32::MAX,
                Method::Trail => 128 / A as u32,
                Method::Recorded => 32,
                Method::Hashed => 32.min(63 / A.trailing_zeros()),
                _ => 128 / (A.trailing_zeros() + 1) - 1,
            };
            match method.run(&tree, &tables, &mut Nothing, &mut ()) {
                Ok(()) => assert!(levels <= limit, "{method} accepts level {levels}"),
                Err(Unsupported::TooDeep(error)) => {
                    assert_eq!(error.depth, levels);
                    assert!(levels > limit && error.limit < levels, "{method} refuses level {levels}: {error}");
                }
                Err(unfit) => panic!("{method}: {unfit}"),
            }
        }
    }
}

struct Nothing;

impl<const A: usize> Search<A> for Nothing {
    type Ranks = [u32; A];

    fn ask(&mut self, _: Node) -> Wanted<[u32; A]> {
        Wanted { set: 0, ranks: [0; A] }
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }

    fn end(&self) -> u32 {
        u32::MAX
    }
}

/// [WIDE-14]
#[test]
fn words_end_at_their_levels_and_no_sooner() {
    at_the_limits::<2>(&[16, 32, 63, 64]);
    at_the_limits::<4>(&[8, 16, 31, 32, 42]);
    at_the_limits::<8>(&[4, 8, 16, 21, 31, 32]);
}

/// A chain of which few leaves are wanted, and whose inner nodes begin one after the other. Where the search ends becomes
/// less far below: then what is pending many levels up is beyond, or a node on the path is.
fn ends_far_below<const A: usize>(limits: &[u32]) {
    let (mut rng, low) = (Rng::new(17), A as u32);
    for &levels in limits {
        for _ in 0..120 {
            let tree = chain::<A>(levels, &mut rng);
            let mut answers = vec![WideAnswer::default(); tree.node_count()];
            let mut node = Some((tree.root(), 0));
            while let Some((parent, level)) = node.take() {
                for slot in 0..low {
                    let child = tree.child(parent, slot);
                    let [steps, wanted] = if child.is_leaf() { [u64::from(levels), 6] } else { [2, 1] };
                    let begin = answers[parent.index()].begin + rng.below(steps) as u32 * low;
                    let end = rng.below(u64::from(levels)) as u32 * low;
                    let is_end = child.is_leaf() && level > levels / 2 && rng.coin();
                    answers[child.index()] =
                        WideAnswer { is_wanted: rng.below(wanted) == 0, begin, end: is_end.then_some(end) };
                    node = if child.is_leaf() { node } else { Some((child, level + 1)) };
                }
            }
            let tape = WideTape::of(&tree, &answers);
            assert!(tape.is_monotone());
            check(&WideCase { tree, tape, is_sorted: true });
        }
    }
}

/// [WIDE-18] [WRESTART-1]
#[test]
fn an_end_far_below_counts_at_all_levels() {
    ends_far_below::<2>(&[40, 63, 64]);
    ends_far_below::<4>(&[30, 32, 41]);
    ends_far_below::<8>(&[16, 30, 31]);
}

/// A trail equals a list of pending sets and dirty bits, up to its depth. A node 64 levels up has no bit and counts as
/// dirty.
fn a_trail_is_a_list<const A: usize, W: TrailWord>(mut trail: Trail<W>) {
    let (mut rng, levels) = (Rng::new(A as u64), <Trail<W> as PendingStore<A>>::LEVELS as usize);
    let nexts = [RankedChild::NONE; 2];
    for walk in 0..90 {
        PendingStore::<A>::clear(&mut trail);
        let (mut above, mut is_dirty) = (Vec::new(), false);
        for _ in 0..2 * levels + 20 {
            match rng.below(16) {
                0 => {
                    is_dirty = true;
                    for (_, is_dirty) in &mut above {
                        *is_dirty = true;
                    }
                    PendingStore::<A>::shortened(&mut trail);
                }
                1 => {
                    is_dirty = false;
                    PendingStore::<A>::asked(&mut trail);
                }
                2 => {
                    let level = above.iter().rposition(|&(pending, _)| pending != 0);
                    let popped = PendingStore::<A>::pop(&mut trail, 0);
                    assert_eq!(popped.map(|popped| above.len() - popped.up as usize), level);
                    let Some(popped) = popped else { continue };
                    let pending;
                    (pending, is_dirty) = above[above.len() - popped.up as usize];
                    assert_eq!(popped.pending, pending);
                    above.truncate(above.len() - popped.up as usize);
                }
                _ if above.len() < levels => {
                    let is_pending = rng.below([2, 10, 80][walk % 3]) == 0;
                    let pending = if is_pending { rng.below(1 << A) as u32 } else { 0 };
                    above.push((pending, is_dirty));
                    is_dirty = false;
                    if let Some(beyond) = above.len().checked_sub(64) {
                        above[beyond].1 = true;
                    }
                    PendingStore::<A>::push(&mut trail, pending, nexts);
                }
                _ => {}
            }
            for (up, &(pending, is_dirty)) in above.iter().chain([&(1, is_dirty)]).rev().enumerate() {
                let found = PendingStore::<A>::words(&trail, up as u32, 1, nexts);
                assert_eq!(found, Some(StateView::Trail { pending, is_dirty }), "{up} of {}", above.len());
            }
            assert_eq!(PendingStore::<A>::is_stale(&trail), is_dirty);
        }
    }
}

/// [WIDE-10] [WIDE-11] [WIDE-18]
#[test]
fn trails_are_lists_of_sets() {
    a_trail_is_a_list::<2, _>(Trail::<u32>::default());
    a_trail_is_a_list::<2, _>(Trail::<u64>::default());
    a_trail_is_a_list::<2, _>(Trail::<u128>::default());
    a_trail_is_a_list::<4, _>(Trail::<u128>::default());
    a_trail_is_a_list::<8, _>(Trail::<u128>::default());
}

/// Wants the children of a binary tape, in its order, in a wide tree with equal addresses.
struct Binary<V>(V);

impl<V: Visitor> Search<2> for Binary<V> {
    type Ranks = [u32; 2];

    fn ask(&mut self, node: Node) -> Wanted<[u32; 2]> {
        let descent = self.0.inner(node);
        let first = u32::from(descent.first() == Side::Right);
        let set = if descent.is_neither() { 0 } else { 1 << first | u32::from(descent.postpones()) << (1 - first) };
        // The first one's remaining bits are 0, the second one's are 1.
        Wanted { set, ranks: std::array::from_fn(|slot| u32::from(slot as u32 != first) << 1 | slot as u32) }
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.0.leaf(leaf)
    }

    fn end(&self) -> u32 {
        u32::MAX
    }
}

/// [WIDE-12]
#[test]
fn with_two_children_it_is_the_binary_traversal() {
    use stackless_bvh::generate::Search as TapeSearch;
    let mut rng = Rng::new(11);
    let mut traces = BTreeSet::new();
    for _ in 0..3000 {
        let leaves = 2 + rng.below(30) as u32;
        let children = shape(&mut rng, leaves);
        let binary = tree::Tree::from_generated(&children).with_links(tree::Recorded::ParentSibling);
        let wide = wide_tree::<2>(&children.iter().map(|pair| pair.map(Vec::from)).collect::<Vec<_>>());
        let tape = Tape::draw(&mut rng, &binary, Kind::Script);
        let mut expected = Trace::default();
        let cursor = Afra::<u64, _>::new(&binary).unwrap();
        traverse::traverse(cursor, &mut TapeSearch::new(&binary, &tape, false), &mut expected);
        let tables = Tables::new(&wide);
        for method in Method::ALL {
            let (mut trace, mut search) = (Trace::default(), Binary(TapeSearch::new(&binary, &tape, false)));
            method.run(&wide, &tables, &mut search, &mut trace).unwrap();
            assert_eq!(trace.nodes(), expected.nodes(), "{method}");
        }
        traces.insert(expected.nodes().len());
    }
    assert!(traces.len() > 25, "{traces:?}");
}

/// Wants all children, inner nodes first, so that each possible return to a node occurs.
struct InnerFirst<'t, const A: usize>(&'t Tree<A>);

impl<const A: usize> Search<A> for InnerFirst<'_, A> {
    type Ranks = [u32; A];

    fn ask(&mut self, node: Node) -> Wanted<[u32; A]> {
        let (set, leaves) = (self.0.children(node), self.0.leaves(node));
        let low = A as u32;
        Wanted { set, ranks: std::array::from_fn(|slot| ((leaves >> slot & 1) * low) | slot as u32) }
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }

    fn end(&self) -> u32 {
        u32::MAX
    }
}

/// Records the keys of lookups.
#[derive(Debug)]
struct Noted<'a>(&'a stackless_bvh::hash::PerfectHash, std::cell::RefCell<BTreeSet<u64>>);

impl Lookup<u64> for &Noted<'_> {
    fn node(&self, key: &u64) -> Node {
        self.1.borrow_mut().insert(*key);
        self.0.node(key)
    }
}

/// [WIDE-9] [WIDE-16]
#[test]
fn the_hash_has_the_keys_that_are_asked_for_and_no_others() {
    use stackless_bvh::internals::wide::Ranked;
    use stackless_bvh::wide::{Hashed, Pending, traverse};
    let mut rng = Rng::new(13);
    let mut hashed = 0;
    for _ in 0..2000 {
        let (leaves, chain) = (1 + rng.below(60) as u32, rng.below(20) as u32);
        let tree = wide_tree::<8>(&wide_shape::<8>(&mut rng, leaves, chain));
        if tree.levels() > 21 {
            continue;
        }
        let keys = asked_keys::<8, u64>(&tree);
        let tables = Tables::new(&tree);
        let noted = Noted(tables.hash().unwrap(), std::cell::RefCell::default());
        let cursor = Pending::new(&tree, Ranked::default(), Hashed::new(&noted)).unwrap();
        traverse(&tree, cursor, &mut InnerFirst(&tree), &mut ());
        let (asked, held): (BTreeSet<u64>, BTreeSet<u64>) =
            (noted.1.into_inner(), keys.iter().map(|(key, _)| *key).collect());
        assert_eq!(asked, held);
        assert!(held.iter().all(|&key| key_level::<8>(key) < tree.levels()));
        hashed += held.len();
    }
    assert!(hashed > 2000, "{hashed}");
}

/// [WIDE-20]
#[test]
fn the_state_is_as_large_as_its_words() {
    let bytes = |method: Method| [4, 8, 16].map(|levels| method.state_bytes::<8>(levels));
    for method in Method::ALL {
        let [few, some, many] = bytes(method);
        match method {
            Method::Stack => assert_eq!([few, some, many], [296, 520, 968]),
            // A set, and two children with their ranks, per level.
            Method::Recorded | Method::Hashed => {
                assert_eq!([some - few, many - some], [4 * 17, 8 * 17], "{method}");
                assert!(many <= 312, "{method}");
            }
            _ => assert_eq!([few, some], [many; 2], "{method}"),
        }
    }
    assert_eq!(bytes(Method::Trail)[0], 32);
}
