//! The visible state of a traversal: at every visit the trail equals the postponed nodes, and the whole state is
//! visible.

mod kept;

use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::{Family, Kind, Rng, Search};
use stackless_bvh::hash::{KeyMap, KeySet, Lookup, Options, PerfectHash, Sizing};
use stackless_bvh::internals::traverse::AuxTables;
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::order::{Descent, Flow, Pruning, Side, Visitor};
use stackless_bvh::traverse::Disjoint;
use stackless_bvh::traverse::{
    Afra, Complete, Cursor, Cuts, Glassner, Hashed, KeyTrail, Method, Next, Pause, Paused, PruningStack, Sparse, Split,
    Stack, Tables, Test, Unsupported, WordName, traverse, traverse_pruned,
};
use stackless_bvh::tree::{Keys, Linked, Node, Parents, Reach, Recorded, Topology, Tree};
use stackless_check::{Case, CaseOptions};

/// One visit.
#[derive(Clone, Copy, Debug)]
struct Seen {
    node: Node,
    key: Option<u64>,
    trail: Option<u64>,
    counter: Option<u64>,
    disjoint: Option<u64>,
    register: Option<Node>,
}

#[derive(Default)]
struct Look(Vec<Seen>);

impl Recorder for Look {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let State { key, trail, counter, disjoint, register, .. } =
            state().map(|word| Some(word.to_u64().expect("64 bits")));
        self.0.push(Seen { node, key, trail, counter, disjoint, register });
        Flow::Continue
    }
}

/// Returns whether it has a key, a trail, a counter, a second trail.
fn has(method: Method) -> [bool; 4] {
    let second = method.test() == Test::Disjoint && method != Method::StackDisjoint;
    let [key, trail, counter] = match method.without_pruning() {
        Method::LeftFirst | Method::ImplicitA | Method::ImplicitA1 | Method::ImplicitB => [true, false, true],
        Method::ImplicitB1 => [true, false, false],
        Method::Sparse => [false, false, true],
        Method::Afra | Method::Uncle => [false, true, false],
        Method::HashOnly | Method::Hashed | Method::Complete | Method::Glassner => [true, true, false],
        _ => [false; 3],
    };
    [key, trail, counter, second]
}

fn visits<W: KeyWord>(case: &Case, method: Method) -> Option<Vec<Seen>> {
    let tables = Tables::new(&case.tree, case.tape.axes(), &[method], 13);
    let mut search = Search::new(&case.tree, &case.tape, case.any);
    let mut look = Look::default();
    tables.run::<W, _>(method, case.octant, &mut Vec::new(), &mut search, &mut look).ok()?;
    Some(look.0)
}

/// Checks all visits. Returns whether a second trail was ever not 0, and whether the register ever had a node.
fn check(case: &Case, method: Method, visits: &[Seen]) -> [bool; 2] {
    let tree = &case.tree;
    let (keys, parents) = (Keys::of(tree), Parents::of(tree));
    for (i, seen) in visits.iter().enumerate() {
        let shown = [seen.key, seen.trail, seen.counter, seen.disjoint].map(|word| word.is_some());
        assert_eq!(shown, has(method), "{method} {case:?}");
        let slot = tree.slot(seen.node);
        let depth = keys.depth(slot);
        assert!(seen.key.is_none_or(|key| key == keys.key::<u64>(slot)), "{method} {case:?}");
        if seen.disjoint.is_some() {
            // A pruned node is not visited, although it is postponed.
            continue;
        }
        // Bit j: the sibling of the ancestor j levels up comes later.
        let (mut trail, mut ancestor) = (0, seen.node);
        for j in 0..depth {
            let sibling = parents.row(tree, ancestor)[1];
            trail |= u64::from(visits[i..].iter().any(|later| later.node == sibling)) << j;
            ancestor = parents.row(tree, ancestor)[0];
        }
        assert!(seen.trail.is_none_or(|shown| shown == trail), "{method} visit {i} {case:?}");
        let counter = 1 << depth | !trail & ((1 << depth) - 1);
        assert!(seen.counter.is_none_or(|shown| shown == counter), "{method} visit {i} {case:?}");
    }
    [visits.iter().any(|seen| seen.disjoint > Some(0)), visits.iter().any(|seen| seen.register.is_some())]
}

/// A search that ends at its first hit may leave postponed nodes. A search for all hits leaves none.
fn whole(case: Case) -> Case {
    Case { any: false, ..case }
}

/// [TRAIL-1]
#[test]
fn the_trail_is_what_is_postponed() {
    let methods = Method::ALL.into_iter().filter(|method| !method.restarts() && method.test() != Test::Distance);
    for method in methods {
        let (mut runs, mut any) = (0, [false; 2]);
        for seed in 0..120 {
            let case = if method.test() == Test::Disjoint {
                let mut rng = Rng::new(seed);
                let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 24);
                Case::with_tree(tree, Kind::Intervals, &mut rng)
            } else {
                Case::random(seed, CaseOptions::default())
            };
            let case = whole(case);
            for seen in [visits::<u64>(&case, method), visits::<Grow>(&case, method)].into_iter().flatten() {
                let found = check(&case, method, &seen);
                any = [any[0] | found[0], any[1] | found[1]];
                runs += 1;
            }
        }
        assert!(runs > 9 || method == Method::Complete && runs > 0, "{method}: {runs}");
        let has_register = matches!(method.without_pruning(), Method::Uncle | Method::Hashed);
        assert_eq!(any, [has(method)[3], has_register], "{method}: second trail, register");
    }
}

#[test]
fn a_borrowed_cursor_prunes_as_itself() {
    fn run(case: &Case, cursor: impl Cursor) -> Trace {
        let (mut trace, mut search) = (Trace::default(), Search::new(&case.tree, &case.tape, false));
        traverse_pruned(cursor, &mut search, &mut trace);
        trace
    }
    let mut pruned = [0; 2];
    for seed in 0..200 {
        let mut rng = Rng::new(seed);
        let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 24);
        let case = whole(Case::with_tree(tree, Kind::Intervals, &mut rng));
        let tree = &case.tree;
        let all = run(&case, Stack::new(tree, &mut Vec::new()));
        let disjoint = run(&case, PruningStack::<_, false>::new(tree, &mut Vec::new()));
        assert_eq!(run(&case, &mut PruningStack::<_, false>::new(tree, &mut Vec::new())), disjoint);
        let near = run(&case, PruningStack::<_, true>::new(tree, &mut Vec::new()));
        assert_eq!(run(&case, &mut PruningStack::<_, true>::new(tree, &mut Vec::new())), near);
        pruned = [pruned[0] + u32::from(disjoint != all), pruned[1] + u32::from(near != all)];
    }
    assert!(pruned.iter().all(|&pruned| pruned > 20), "{pruned:?}");
}

#[test]
fn methods_say_what_they_are() {
    let names = "stack stack-disjoint stack-t0 left-first implicit-a implicit-a1 implicit-b implicit-b1 sparse \
                 sparse-disjoint hapala laine-0 laine-1 laine-2 laine-4 laine-8 afra afra-disjoint uncle uncle-disjoint \
                 hash-only hashed hashed-disjoint skip skip-octant complete glassner";
    assert_eq!(Method::ALL.map(Method::name).join(" "), names);
    let those = |which: &dyn Fn(Method) -> bool| {
        Method::ALL.into_iter().filter(|&method| which(method)).map(Method::name).collect::<Vec<_>>().join(" ")
    };
    let recorded = |what| those(&|method| method.wants_recorded() == what);
    assert_eq!(recorded(Recorded::ParentSibling), "sparse sparse-disjoint hapala afra afra-disjoint");
    assert_eq!(recorded(Recorded::Uncles), "uncle uncle-disjoint hashed hashed-disjoint");
    let paused = "sparse sparse-disjoint afra afra-disjoint uncle uncle-disjoint hash-only hashed hashed-disjoint";
    assert_eq!(those(&Method::can_pause), paused);
    assert_eq!(those(&Method::restarts), "laine-0 laine-1 laine-2 laine-4 laine-8");
    let wordless = "stack stack-disjoint stack-t0 hapala skip skip-octant";
    assert_eq!(those(&|method| !method.has_words()), wordless);
    assert_eq!(those(&|method| !method.exists_for::<Grow>()), those(&Method::restarts));
    assert_eq!(those(&|method| !method.exists_for::<u64>()), "");
    let seconds = Method::ALL.into_iter().filter_map(|method| Some((method, method.with_second_trail()?)));
    let seconds: Vec<_> = seconds.map(|(first, second)| format!("{first} {second}")).collect();
    assert_eq!(
        seconds,
        ["sparse sparse-disjoint", "afra afra-disjoint", "uncle uncle-disjoint", "hashed hashed-disjoint"]
    );
    for method in Method::ALL {
        let plain = method.without_pruning();
        let expected = method.name().trim_end_matches("-disjoint").trim_end_matches("-t0");
        assert_eq!((plain.name(), plain.test().pruning()), (expected, Pruning::Never));
    }
}

/// [STATE-1]
#[test]
fn states_have_the_bytes_of_their_words() {
    // At a depth of 20 edges, in words of 64 bits; a growing word then has 8 bytes too.
    let expected =
        [88, 168, 168, 16, 24, 16, 24, 16, 12, 20, 8, 28, 40, 44, 52, 68, 12, 20, 16, 24, 20, 24, 32, 4, 4, 16, 20];
    assert_eq!(Method::ALL.map(|method| method.state_bytes::<u64>(20)), expected);
    assert_eq!(Method::ALL.map(|method| method.state_bytes::<Grow>(20)), expected);
    for (word, hashed) in [(WordName::U32, 16), (WordName::U64, 24), (WordName::U128, 40), (WordName::Grow, 24)] {
        assert_eq!(Method::Hashed.state_bytes_in(word, 20), hashed);
    }
    assert_eq!(Method::Hashed.state_bytes_in(WordName::Grow, 63), 40);
}

#[test]
fn a_tree_without_a_node_more_is_complete() {
    let complete = |depth: u32| {
        let leaves = 1 << depth;
        let inner = (1..leaves).map(|i| Some([2 * i - 1, 2 * i]));
        Tree::new(&inner.chain((0..leaves).map(|_| None)).collect::<Vec<_>>()).unwrap()
    };
    for depth in 0..6 {
        let layout = Complete::of(&complete(depth)).unwrap();
        assert_eq!(layout.bytes(), 4 * ((2 << depth) - 1));
    }
    let comb = Tree::new(&[Some([1, 2]), None, Some([3, 4]), None, None]).unwrap();
    let error = Complete::of(&comb).unwrap_err();
    assert_eq!((error.nodes, error.depth), (5, 2));
    assert_eq!(error.to_string(), "the tree is not complete: 5 nodes at a depth of 2 edges");
    let glassner = Glassner::of(&comb);
    // 4 bytes per bucket, 12 per entry, 16 per key.
    assert_eq!(glassner.bytes(), 5 * (4 + 12 + 16));
}

#[test]
fn every_method_runs_by_its_name_in_every_word() {
    for seed in 0..18 {
        let mut rng = Rng::new(seed);
        let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 16);
        let kind = Kind::ALL[seed as usize % Kind::ALL.len()];
        let case = whole(Case::with_tree(tree, kind, &mut rng));
        let tables = Tables::new(&case.tree, case.tape.axes(), &Method::ALL, 13);
        let is_complete = Complete::of(&case.tree).is_ok();
        for (method, word) in Method::ALL.into_iter().flat_map(|method| WordName::ALL.map(|word| (method, word))) {
            let run = |word: Option<WordName>| {
                let (mut trace, mut memory) = (Trace::default(), Vec::new());
                let (search, octant) = (&mut Search::new(&case.tree, &case.tape, false), case.octant);
                let result = match word {
                    Some(word) => tables.run_in(word, method, octant, &mut memory, search, &mut trace),
                    None => tables.run::<u64, _>(method, octant, &mut memory, search, &mut trace),
                };
                (result, trace)
            };
            let (result, trace) = run(None);
            let is_fit = method != Method::Complete || is_complete;
            assert_eq!((result.is_ok(), trace.nodes().is_empty()), (is_fit, !is_fit), "{method}");
            if word == WordName::Grow && method.restarts() {
                assert_eq!(run(Some(word)).0, Err(Unsupported::NoSuchWord { word: "grow" }));
            } else {
                assert_eq!(run(Some(word)), (result, trace), "{method} {word}");
            }
        }
    }
}

#[test]
fn pieces_prune_what_waits_above_them_too() {
    fn run(case: &Case, cursor: impl Cursor) -> Trace {
        let (mut trace, mut search) = (Trace::default(), Search::new(&case.tree, &case.tape, false));
        traverse_pruned(cursor, &mut search, &mut trace);
        trace
    }
    let mut pruned = 0;
    for seed in 0..100 {
        let mut rng = Rng::new(seed);
        let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 24);
        let case = whole(Case::with_tree(tree, Kind::Intervals, &mut rng));
        let parents = Linked::parents(&case.tree);
        let cuts = Cuts::every(2, &parents);
        let whole = run(&case, Afra::<u64, _, Disjoint<u64>>::new(&parents).unwrap());
        let mut waiting = Vec::new();
        let start = Afra::<u64, _, Disjoint<u64>>::new;
        assert_eq!(run(&case, Split::new(&cuts, &mut waiting, start).unwrap()), whole, "{case:?}");
        pruned += u32::from(whole != run(&case, Stack::new(&case.tree, &mut Vec::new())));
    }
    assert!(pruned > 10, "{pruned}");
}

#[test]
fn tables_have_the_bytes_of_their_parts() {
    let leaves = 1 << 3;
    let inner = (1..leaves).map(|i| Some([2 * i - 1, 2 * i]));
    let tree = Tree::new(&inner.chain((0..leaves).map(|_| None)).collect::<Vec<_>>()).unwrap();
    let axes = vec![0; 15];
    let bytes = |methods: &[Method]| AuxTables::new(&tree, &axes, methods, 13).bytes();
    let sole = [
        (Method::Stack, 0),
        (Method::Sparse, 8 * 15),
        (Method::Hapala, 8 * 15),
        (Method::Uncle, 12 * 15),
        (Method::LeftFirst, 4096),
        (Method::Complete, 4 * 15),
        (Method::Glassner, 32 * 15),
        (Method::Skip, 4 * 15),
        (Method::SkipOctant, 8 * 4 * 15),
        (Method::HashOnly, table(&tree, KeySet::All)),
        (Method::Hashed, 12 * 15 + table(&tree, KeySet::Exact(Reach::ALGORITHM_1))),
    ];
    for (method, expected) in sole {
        assert_eq!(bytes(&[method]), expected, "{method}");
    }
    // Parents and uncles are shared.
    let shared = 8 * 15 + 12 * 15;
    assert_eq!(bytes(&Method::ALL), sole.iter().map(|(_, bytes)| bytes).sum::<usize>() - shared);
    let deep = AuxTables::new(&tree, &axes, &[Method::LeftFirst], 2).bytes();
    assert_eq!(deep, KeyMap::of(&tree).bytes());
}

fn table(tree: &Tree, key_set: KeySet) -> usize {
    PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).unwrap().header().bytes()
}

#[test]
fn a_state_with_a_key_needs_no_address() {
    let (node, trail, disjoint, next) = (Node::leaf(4), 2_u32, Some(0), Next::Backtrack);
    let paused = |key| Paused { node, register: None, key, trail, disjoint, next };
    assert_eq!(paused(Some(5)).key_trail(), Some(KeyTrail { key: 5, trail, disjoint, next }));
    assert_eq!(paused(None).key_trail(), None);
}

#[test]
fn words_by_name_and_depth() {
    assert_eq!(WordName::ALL.map(WordName::name), ["u32", "u64", "u128", "grow"]);
    let narrowest = [0, 30, 31, 62, 63, 126, 127, u32::MAX].map(WordName::narrowest);
    let [a, b, c, d] = WordName::ALL;
    assert_eq!(narrowest, [a, a, b, b, c, c, d, d]);
}

/// Returns a right-leaning chain with a leaf at each inner node.
fn chain(depth: u32) -> Tree {
    let children: Vec<_> = (0..depth).flat_map(|i| [Some([2 * i + 1, 2 * i + 2]), None]).chain([None]).collect();
    Tree::new(&children).unwrap()
}

/// A table without lookups.
struct Never;

impl<W: KeyWord> Lookup<W> for Never {
    fn node(&self, key: &W) -> Node {
        panic!("{key:?} is looked up")
    }
}

/// Wants both children of some nodes, and the left child of all other nodes.
struct LeftDown(&'static [usize]);

impl Visitor for LeftDown {
    fn inner(&mut self, node: Node) -> Descent {
        if self.0.contains(&node.index()) { Descent::both(Side::Left) } else { Descent::only(Side::Left) }
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

/// Node 2 is postponed at the root and named by the records of nodes 4 and 5, but not by that of node 7, two single
/// children down: the register takes it at 5.
#[test]
fn what_the_next_record_does_not_name_is_kept() {
    let leaf = None;
    let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), Some([7, 8]), leaf, leaf, leaf];
    let tree = Tree::new(&children).unwrap();
    let uncles = Linked::uncles(&tree);
    let mut trace = Trace::default();
    let cursor = Hashed::<u32, _, _>::new(&uncles, &Never).unwrap();
    traverse(cursor, &mut LeftDown(&[0, 1]), &mut trace);
    assert_eq!(trace.nodes().iter().map(|node| node.index()).collect::<Vec<_>>(), [0, 1, 3, 4, 5, 7, 2]);
}

#[test]
fn marks_are_taken_up() {
    let tree = chain(8);
    let (node, parents) = (tree.node(9).unwrap(), Linked::parents(&tree));
    let paused = Paused { node, register: None, key: None, trail: 0b101_u32, disjoint: Some(0b100), next: Next::Visit };
    let mut afra = Afra::<u32, _, Disjoint<u32>>::new(&parents).unwrap();
    let mut sparse = Sparse::<u32, _, Disjoint<u32>>::new(&parents).unwrap();
    afra.take_up(paused.clone()).unwrap();
    sparse.take_up(paused).unwrap();
    assert_eq!(afra.state(), State { trail: Some(0b101), disjoint: Some(0b100), ..State::of(node) });
    assert_eq!((sparse.node(), sparse.state().disjoint), (node, Some(0b100)));
}
