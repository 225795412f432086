//! Targets of the core: traversals, states, hashes.

use arbitrary::Unstructured;
use stackless_bvh::event::{Event, Trace};
use stackless_bvh::generate::{Family, Kind, Rng, Search, Source, Tape, shape};
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing, certify};
use stackless_bvh::internals::hash::{AddressBounds, Remainder};
use stackless_bvh::internals::traverse::{AuxTables, ByWalk, PieceTable};
use stackless_bvh::key::{self, Grow, KeyWord};
use stackless_bvh::traverse::{Cuts, KeyTrail, Method, Next, Paused, States, Unsupported, WordName};
use stackless_bvh::tree::{Implicit, Keys, Linked, Node, Reach, Topology, Tree};
use stackless_bvh::{oracle, trail};
use stackless_check::{
    Battery, Case, CaseOptions, Disagreement, Pauses, Pieces, Plan, Replay, Tally, Verdict, check_table,
    check_table_bytes, shrink,
};

use super::draw::patched;
use super::{right, said};

/// Checks every traversal in every word on a small tree with a drawn tape. `[CONF-1]`
pub(crate) fn traversals(bytes: &[u8]) {
    let case = small_case(bytes);
    check(&case, &Method::ALL);
    // The oracle's events have the nodes of its visits.
    let (mut trace, mut search) = (Trace::default(), Search::new(&case.tree, &case.tape, case.any));
    oracle::traverse(&case.tree, &mut search, &mut trace);
    let keys = Keys::of(&case.tree);
    let visited = trace.events::<u64>(&case.tree, &keys).filter_map(|event| match event {
        Event::Enter(key) | Event::Leaf(key) => Keys::walk(&case.tree, &key),
        Event::Backtrack(..) | Event::End => None,
    });
    assert!(visited.eq(trace.nodes().iter().copied()), "{case:?}");
}

/// Checks every traversal on a tree with a depth at the limit of a word.
pub(crate) fn deep(bytes: &[u8]) {
    let case = deep_case(&mut Unstructured::new(bytes));
    check(&case, &Method::ALL);
    // The narrowest supported word is sufficient.
    let narrowest = WordName::narrowest(case.tree.depth());
    let mut battery = Battery::new(&case, &[Method::Hashed]);
    let verdict = battery.check(Method::Hashed, narrowest);
    assert!(matches!(verdict, Verdict::Agrees { .. }), "{narrowest}: {verdict:?} {case:?}");
    // Without its tables, or with a word that is too narrow or unsupported, a traversal returns an error.
    for (method, word) in [
        (Method::Hashed, WordName::U32),
        (Method::Glassner, WordName::U32),
        (Method::ImplicitA, WordName::U64),
        (Method::Laine0, WordName::Grow),
        (Method::Complete, WordName::U32),
    ] {
        if let Verdict::Refused(unfit) = battery.check(method, word) {
            said(unfit);
        }
    }
    // If the layout exists, every node is at its key minus one.
    match Implicit::of(&case.tree) {
        Err(refusal) => said(refusal),
        Ok(layout) => {
            let keys = Keys::of(&case.tree);
            for slot in 0..case.tree.node_count() {
                let node = layout.at(keys.key::<u64>(slot) as usize - 1);
                assert_eq!(node.map(|node| case.tree.slot(node)), Some(slot), "{case:?}");
            }
        }
    }
}

/// Checks a deep tree in pieces. `[DEPTH-4]`
pub(crate) fn pieces(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let case = if source.coin() { deep_case(&mut source) } else { Case::draw(&mut source, Case::LEAVES) };
    match source.below(4) {
        0 => in_pieces::<u32>(&case, 1 + source.below(31) as u32),
        1 => in_pieces::<u8>(&case, 1 + source.below(8) as u32),
        2 => in_pieces::<u16>(&case, 1 + source.below(16) as u32),
        _ => in_pieces::<u64>(&case, 60 + source.below(5) as u32),
    }
}

/// Pauses every traversal at every step, and resumes it by every method. `[PAUSE-1]` `[PAUSE-2]` `[PAUSE-4]`
pub(crate) fn pauses(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let word = source.below(4);
    let case = Case::draw(&mut source, 5);
    let pauses = Pauses::new(&case);
    for method in Method::ALL.into_iter().filter(|method| method.can_pause()) {
        let checked = match word {
            0 => pauses.check::<u32>(method),
            1 => pauses.check::<u64>(method),
            2 => pauses.check::<u128>(method),
            _ => pauses.check::<Grow>(method),
        };
        right(checked, format_args!("{case:?}"));
    }
}

/// Reads bytes that may be states: valid ones, forged ones with a valid checksum, and any. `[PAUSE-6]`
pub(crate) fn states(bytes: &[u8]) {
    let (head, rest) = bytes.split_at(bytes.len().min(12));
    let mut source = Unstructured::new(head);
    let (word, kind, is_deep) = (source.below(3), source.below(3), source.below(4) == 1);
    let case = if is_deep { deep_case(&mut source) } else { Case::draw(&mut source, 12) };
    let pauses = Pauses::new(&case);
    match word {
        0 => follow::<u32>(&case, &pauses, kind, rest),
        1 => follow::<u64>(&case, &pauses, kind, rest),
        _ => follow::<Grow>(&case, &pauses, kind, rest),
    }
}

/// Checks a perfect hash, of any set of keys and sizing. `[HASH-9]`
pub(crate) fn hash(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let (options, method, tree) = (options(&mut source), any_of(&mut source, &Method::ALL), tree(&mut source));
    let keys = Keys::of(&tree);
    let hash = right(check_table(&tree, &keys, options), format_args!("{options:?} {:?}", tree.to_children()));
    if let Err(refusal) = PerfectHash::build_plain(&tree, options) {
        said(refusal);
    }
    // The header counts direct addresses, and the division equals the reciprocal.
    let (header, division) = (hash.header(), Remainder(hash.header().cells));
    let hashed = options.key_set.slots(&tree);
    let all = (0..tree.node_count()).filter(|&slot| hashed[slot]).map(|slot| keys.key::<Grow>(slot));
    let is_direct: Vec<_> = all
        .map(|key| {
            assert_eq!(hash.probe_by(&division, &key), hash.probe(&key), "{key:?}");
            hash.is_direct(&key)
        })
        .collect();
    let direct = is_direct.iter().filter(|&&is| is).count();
    assert_eq!((direct, is_direct.len()), (header.direct as usize, header.keys as usize), "{header:?}");
    assert!(header.direct_share() <= 1.0, "{header:?}");
    said(header.sizing);
    // Tables for all traversals take at least the memory of those for one.
    let axes = vec![0; tree.node_count()];
    let bytes = |methods: &[Method]| AuxTables::new(&tree, &axes, methods, 13).bytes();
    assert!(bytes(&[method]) <= bytes(&Method::ALL), "{method}");
    for word in WordName::ALL {
        let [narrow, wide] = [1, 60].map(|depth| method.state_bytes_in(word, depth));
        assert!(narrow <= wide && wide > 0, "{method} in {word}");
    }
    let recorded = method.wants_recorded();
    assert_eq!(method.without_pruning().wants_recorded(), recorded);
    let pruning = method.with_second_trail();
    assert!(pruning.is_none_or(|other| other.without_pruning() == method), "{method}");
    assert_eq!(method.name().parse(), Ok(method));
}

/// Reads bytes that may be a table of a tree: valid ones, changed ones, and any.
pub(crate) fn hash_bytes(bytes: &[u8]) {
    let (head, rest) = bytes.split_at(bytes.len().min(16));
    let mut source = Unstructured::new(head);
    let (is_any, options, leaves) = (source.coin(), options(&mut source), 1 + source.below(20) as u32);
    let tree = right(Tree::new(&shape(&mut source, leaves)), "a shape");
    let table = match PerfectHash::build(&tree, options) {
        Ok(hash) if !is_any => patched(&mut Unstructured::new(rest), hash.to_bytes()),
        _ => rest.to_vec(),
    };
    right(check_table_bytes(&table, &tree, &Keys::of(&tree)), format_args!("{table:?} {:?}", tree.to_children()));
    match PerfectHash::from_bytes(&table, AddressBounds::of(&tree)) {
        Err(refusal) => said(refusal),
        Ok(hash) => [options.key_set, hash.header().key_set]
            .into_iter()
            .for_each(|key_set| certify(&hash, &tree, key_set).unwrap_or_else(said)),
    }
}

/// Checks all traversals in all words. A disagreement is shrunk, and printed as a file for `stackless check`.
pub(crate) fn check(case: &Case, methods: &[Method]) {
    let fails = |case: &Case, methods: &[Method], words: &[WordName]| {
        let plan =
            Plan { trees: 0, seed: 0, options: <_>::default(), methods: methods.to_vec(), words: words.to_vec() };
        plan.check_case(case, &mut Tally::default())
    };
    if let Some(Disagreement { method, word, .. }) = fails(case, methods, &WordName::ALL) {
        let small = shrink(case.clone(), |case| fails(case, &[method], &[word]).is_some());
        let fault = fails(&small, &[method], &[word]).map(|found| found.fault);
        let replay = fault.map(|fault| serde_json::to_string(&Replay::of(&small, method, word, &fault)));
        panic!("{method} in {word}\n{replay:?}");
    }
}

/// Draws a tree of up to 32 leaves and a tape, from bytes or from a seed, so two bytes suffice for nested intervals.
fn small_case(bytes: &[u8]) -> Case {
    let mut source = Unstructured::new(bytes);
    match source.below(4) {
        1 => Case::random(source.below(1 << 16), CaseOptions::default()),
        _ => Case::draw(&mut source, Case::LEAVES),
    }
}

/// Draws a tree with a depth at the limit of a word, and nearly one leaf per level. Shape and tape are drawn from
/// bytes or from a seed, so a few bytes suffice for a deep tree.
fn deep_case(source: &mut impl Source) -> Case {
    let depth = match source.below(3) {
        0 => 30 + source.below(37) as u32,
        1 => 126 + source.below(5) as u32,
        _ => source.below(200) as u32,
    };
    let (family, kind) = (source.below(8), any_of(source, &Kind::ALL));
    let seed = source.below(1 << 16);
    let mut rng = Rng::new(seed);
    let tree = match family {
        0 => chain(depth, |_| false),
        1 => chain(depth, |_| true),
        2 => chain(depth, |level| level % 3 == 1),
        3 => Family::Comb.tree(source, depth + 1),
        4 => Family::Caterpillar.tree(&mut rng, depth + 1),
        5 => Family::Skew.tree(&mut rng, depth + 1),
        6 => Family::Catalan.tree(&mut rng, depth + 1),
        _ => Family::Comb.tree(&mut rng, depth + 1),
    };
    let tape = if source.coin() { Tape::draw(source, &tree, kind) } else { Tape::hashed(seed, &tree, kind) };
    Case { tree, tape, any: source.coin(), octant: source.below(8) as u8 }
}

/// Returns a comb that grows to the right at the selected levels.
fn chain(depth: u32, right_at: impl Fn(u32) -> bool) -> Tree {
    let inner = |i: u32| if right_at(i) { [2 * i + 1, 2 * i + 2] } else { [2 * i + 2, 2 * i + 1] };
    let children: Vec<_> = (0..depth).flat_map(|i| [Some(inner(i)), None]).chain([None]).collect();
    right(Tree::new(&children), "a chain")
}

fn in_pieces<W: KeyWord>(case: &Case, levels: u32) {
    let (linked, mut battery) = (Linked::both(&case.tree), Battery::new(case, &[]));
    let cuts = Cuts::every(levels, &linked);
    let pieces = right(Pieces::new(&cuts), "tables of pieces");
    // The nesting equals the pieces on a path, and each state is as large as in a tree of this number of levels.
    // [STATE-1]
    assert_eq!(cuts.nesting(), case.tree.depth().div_ceil(levels).max(1));
    let one = Method::Hashed.state_bytes::<W>(levels.min(case.tree.depth()));
    assert_eq!(cuts.state_bytes::<W>(Method::Hashed), cuts.nesting() as usize * one);
    let of_pieces = |tables: &[PieceTable<PerfectHash>]| tables.iter().map(PieceTable::bytes).sum::<usize>();
    assert!(of_pieces(pieces.hashes()) <= of_pieces(pieces.full_hashes()) + cuts.bytes());
    for method in Pieces::<Linked<'_, Tree>>::methods() {
        let verdict = battery
            .judge(method.test(), method.restarts(), |search, watch, _, _| pieces.run::<W>(method, search, watch));
        match verdict {
            Verdict::Agrees { .. } | Verdict::Refused(Unsupported::TooDeep(_)) => {}
            _ => panic!("{method} in {}, cut every {levels} levels: {verdict:?}\n{case:?}", W::NAME),
        }
    }
}

fn follow<W: KeyWord>(case: &Case, pauses: &Pauses<'_>, kind: u64, rest: &[u8]) {
    let mut source = Unstructured::new(rest);
    let states = States::of(&case.tree);
    let state = match kind {
        0 => states.to_bytes(&state::<W>(&case.tree, &mut source)),
        1 => {
            let bytes = states.to_bytes(&state::<W>(&case.tree, &mut source));
            patched(&mut source, bytes)
        }
        _ => rest.to_vec(),
    };
    right(pauses.follow::<W>(&state), format_args!("{state:?} {case:?}"));
    match states.from_bytes::<W>(&state) {
        Err(refusal) => said(refusal),
        // Without addresses, and back.
        Ok(paused) => {
            assert_eq!(states.bytes(&paused), state.len());
            if let Some(kept) = paused.clone().key_trail() {
                let located = right(kept.locate(&ByWalk(&case.tree)), format_args!("{paused:?} {case:?}"));
                assert_eq!(located.node, paused.node, "{paused:?} {case:?}");
            }
        }
    }
    // A key and a trail that may belong to no node.
    let kept =
        KeyTrail { key: bits::<W>(&mut source, 7), trail: bits(&mut source, 7), disjoint: None, next: Next::Visit };
    if let Err(refusal) = kept.locate(&ByWalk(&case.tree)) {
        said(refusal);
    }
}

/// Draws a state that is almost valid: the key is that of the node, and the register that of the trail, unless drawn
/// independently.
fn state<W: KeyWord>(tree: &Tree, source: &mut impl Source) -> Paused<W> {
    let slot = source.below(tree.node_count() as u64) as usize;
    let node = tree.node(slot as u32).unwrap_or(tree.root());
    let depth = Keys::of(tree).depth(slot);
    let fits = W::carries(depth, 1).is_ok();
    let count = if fits { depth } else { 1 };
    let trail: W = bits(source, count);
    let key: W = if fits { Keys::of(tree).key(slot) } else { W::one() };
    let postponed = || key::sibling(key.clone().shr(trail::levels(&trail)));
    let register = if fits && !trail.is_zero() { Keys::walk(tree, &postponed()) } else { None };
    let other = Node::from_bits(source.below(1 << 32) as u32);
    let next = if node.is_leaf() && source.coin() { Next::Backtrack } else { Next::Visit };
    let disjoint = source.coin().then(|| bits(source, count));
    let paused = Paused { node, register, key: Some(key), trail, disjoint, next };
    match source.below(8) {
        1 => Paused { node: other, ..paused },
        2 => Paused { register: Some(other), ..paused },
        3 => Paused { register: None, ..paused },
        4 => Paused { key: None, ..paused },
        5 => Paused { key: Some(bits(source, 6)), ..paused },
        6 => Paused { trail: bits(source, 6), ..paused },
        7 => Paused { next: Next::Backtrack, ..paused },
        _ => paused,
    }
}

fn bits<W: KeyWord>(source: &mut impl Source, count: u32) -> W {
    (0..count).fold(W::zero(), |word, _| word.shl1().or(&W::from_bit(source.coin())))
}

fn any_of<T: Copy>(source: &mut impl Source, all: &[T]) -> T {
    all[source.below(all.len() as u64) as usize]
}

fn options(source: &mut impl Source) -> Options {
    const REACHES: [(u32, u32); 4] = [(1, 1), (1, 2), (2, 2), (2, 3)];
    let key_set = match source.below(6) {
        0 => KeySet::All,
        1 => KeySet::Paper,
        i => {
            let (inner, leaf) = REACHES[i as usize - 2];
            KeySet::Exact(Reach::new(inner, leaf).unwrap_or(Reach::ALGORITHM_1))
        }
    };
    Options { key_set, sizing: any_of(source, &Sizing::ALL) }
}

/// Draws a tree by its shape, or one of a family from a seed, which may be larger.
fn tree(source: &mut impl Source) -> Tree {
    match source.below(3) {
        0 => {
            let leaves = 1 + source.below(Case::LEAVES.into()) as u32;
            right(Tree::new(&shape(source, leaves)), "a shape")
        }
        1 => deep_case(source).tree,
        _ => {
            let family = any_of(source, &Family::ALL);
            let leaves = 1 + source.below(400) as u32;
            family.tree(&mut Rng::new(source.below(1 << 16)), leaves)
        }
    }
}
