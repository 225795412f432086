//! Traversals paused at every step and resumed by every method, and invalid states.

use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::{Family, Kind, Rng, Search, Source, procedural};
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::hash::{KeyMap, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::internals::trace::{Any, Closest, Truth};
use stackless_bvh::internals::traverse::{ByTable, ByWalk};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::order::{Descent, Flow, Visitor};
use stackless_bvh::trace::{BinaryTracer, RayQueries};
use stackless_bvh::traverse::Disjoint;
use stackless_bvh::traverse::{
    Afra, Cursor, HashOnly, Hashed, Incomplete, KeyOnly, KeyTrail, Method, Next, NoSuchKey, Pause, Paused, Sparse,
    StateError, States, Uncle, resume, traverse, traverse_pruned,
};
use stackless_bvh::tree::{Linked, Node, Recorded, Topology};
use stackless_check::{Case, CaseOptions, Pauses};

fn methods() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|method| method.can_pause())
}

/// Returns the number of resumed traversals, in all words that are wide enough.
fn check(case: &Case) -> usize {
    let pauses = Pauses::new(case);
    let checked = |result: Result<usize, _>| match result {
        Ok(resumes) => resumes,
        Err(fault) => panic!("{fault}\n{case:?}"),
    };
    let in_each = |method| {
        [
            checked(pauses.check::<u32>(method)),
            checked(pauses.check::<u64>(method)),
            checked(pauses.check::<Grow>(method)),
        ]
        .iter()
        .sum::<usize>()
    };
    methods().map(in_each).sum()
}

/// [PAUSE-1] [PAUSE-2] [PAUSE-4]
#[test]
fn whatever_is_put_aside_goes_on() {
    let resumes: usize = (0..250).map(|seed| check(&Case::random(seed, CaseOptions::default()))).sum();
    assert!(resumes > 1_000_000, "{resumes}");
}

#[test]
fn at_the_depths_where_words_end() {
    for (depth, least) in [(30, 1), (31, 1), (32, 1), (33, 1), (62, 1), (63, 1), (64, 1), (65, 1), (130, 1)] {
        let mut rng = Rng::new(u64::from(depth));
        let tree = Family::Comb.tree(&mut rng, depth + 1);
        let case = Case::with_tree(tree, Kind::OnlyOne, &mut rng);
        assert!(check(&case) >= least);
    }
}

/// [STATE-1]
#[test]
fn states_are_as_large_in_any_tree() {
    for method in Method::ALL {
        let grows = matches!(method, Method::Stack | Method::StackDisjoint | Method::StackT0);
        assert_eq!(method.state_bytes::<u64>(60) > method.state_bytes::<u64>(1), grows, "{method}");
        assert!(grows || method.state_bytes::<u32>(20) <= 4 * (4 + 8 + 2), "{method}");
    }
}

/// [PAUSE-6]
#[test]
fn other_states_are_refused() {
    let mut rng = Rng::new(9);
    let [case, other] = [(); 2].map(|()| {
        let tree = Family::Catalan.tree(&mut rng, 20);
        Case::with_tree(tree, Kind::AllHit, &mut rng)
    });
    let (states, others) = (States::of(&case.tree), States::of(&other.tree));
    let mut seen = 0;
    for_each_state(&case, |paused| {
        let bytes = states.to_bytes(paused);
        assert_eq!(bytes.len(), states.bytes(paused));
        assert_eq!(states.from_bytes(&bytes).as_ref(), Ok(paused));
        assert_eq!(others.from_bytes::<u32>(&bytes), Err(StateError::Tree));
        assert!(matches!(states.from_bytes::<u64>(&bytes), Err(StateError::WordBytes { expected: 8, found: 4 })));
        // Every bit, every length.
        for i in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[i / 8] ^= 1 << (i % 8);
            assert!(states.from_bytes::<u32>(&damaged).is_err(), "bit {i}");
        }
        for length in 0..bytes.len() {
            assert!(states.from_bytes::<u32>(&bytes[..length]).is_err(), "{length}");
        }
        assert!(states.from_bytes::<u32>(&[&*bytes, &[0]].concat()).is_err());
        seen += 1;
    });
    assert!(seen > 20);
}

/// [PAUSE-6]
#[test]
fn states_that_are_made_up_are_followed_only_where_a_traversal_could_be() {
    let mut rng = Rng::new(4);
    let case = Case::with_tree(Family::Catalan.tree(&mut rng, 12), Kind::Random, &mut rng);
    let (tree, states, map) = (&case.tree, States::of(&case.tree), KeyMap::of(&case.tree));
    let linked = Linked::both(tree);
    let (mut followed, mut refused) = (0, 0);
    for _ in 0..200_000 {
        let node = |rng: &mut Rng| {
            let index = rng.below(14) as u32;
            if rng.coin() { Node::leaf(index) } else { Node::inner(index) }
        };
        let paused = Paused {
            node: node(&mut rng),
            register: rng.coin().then(|| node(&mut rng)),
            key: Some(rng.below(64) as u32),
            trail: rng.below(8) as u32,
            disjoint: rng.coin().then(|| rng.below(8) as u32),
            next: if rng.coin() { Next::Visit } else { Next::Backtrack },
        };
        // As bytes with a valid checksum.
        let Ok(paused) = states.from_bytes::<u32>(&states.to_bytes(&paused)) else {
            refused += 1;
            continue;
        };
        followed += 1;
        let mut search = Search::new(tree, &case.tape, false);
        let cursor = Hashed::<u32, _, _>::new(&linked, &map).expect("not deep");
        let mut steps = Steps(0);
        let _ = resume(cursor, paused.clone(), &mut search, &mut steps);
        let afra = Afra::<u32, _>::new(&linked).expect("not deep");
        assert!(resume(afra, paused, &mut search, &mut steps).is_ok());
        assert!(steps.0 <= 2 * tree.node_count());
    }
    assert!(followed > 20 && refused > 100_000, "{followed} {refused}");
}

/// [PAUSE-3] [PAUSE-5]
#[test]
fn what_is_missing_is_named() {
    let mut rng = Rng::new(1);
    let tree = &Family::Catalan.tree(&mut rng, 6);
    let (linked, map) = (Linked::both(tree), KeyMap::of(tree));
    let [left, right] = tree.children(tree.root());
    let paused = Paused { node: left, register: None, key: None, trail: 1_u32, disjoint: None, next: Next::Visit };
    let mut hashed = Hashed::<u32, _, _>::new(&linked, &map).expect("not deep");
    let mut by_hash = HashOnly::<u32, _, _>::new(tree, &map).expect("not deep");
    let mut uncle = Uncle::<u32, _>::new(&linked).expect("not deep");
    let mut sparse = Sparse::<u32, _>::new(&linked).expect("not deep");
    assert_eq!(hashed.take_up(paused.clone()), Err(Incomplete::Key));
    assert_eq!(by_hash.take_up(paused.clone()), Err(Incomplete::Key));
    assert_eq!(uncle.take_up(paused.clone()), Err(Incomplete::Register));
    let with_key = Paused { key: Some(2), ..paused.clone() };
    assert_eq!(hashed.take_up(with_key.clone()), Err(Incomplete::Register));
    // A rejected state changes nothing.
    assert_eq!((hashed.node(), hashed.state().key), (tree.root(), Some(1)));
    assert_eq!(hashed.take_up(Paused { register: Some(right), ..with_key }), Ok(()));
    assert_eq!(sparse.take_up(paused), Ok(()));
    assert_eq!((sparse.node(), sparse.state().counter), (left, Some(0b10)));

    let walk = ByWalk(tree);
    let kept = |key, trail| KeyTrail { key, trail, disjoint: None, next: Next::Visit };
    assert_eq!(kept(0, 0_u32).locate(&walk), Err(NoSuchKey));
    assert_eq!(kept(1, 1_u32).locate(&walk), Err(NoSuchKey));
    assert_eq!(kept(1 << 20, 0_u32).locate(&walk), Err(NoSuchKey));
    assert!(kept(2, 1_u32).locate(&walk).is_ok());
    // A bit above the root, hidden by a lower one: the next node exists.
    assert_eq!(kept(2, 0b11_u32).locate(&walk), Err(NoSuchKey));
    assert_eq!(KeyTrail { disjoint: Some(0b11), ..kept(2, 1_u32) }.locate(&walk), Err(NoSuchKey));
    let states = States::of(tree);
    let of_left = |trail, disjoint| Paused {
        node: left,
        register: Some(right),
        key: Some(2),
        trail,
        disjoint,
        next: Next::Visit,
    };
    assert_eq!(states.check(&of_left(0b01_u32, Some(0b01))), Ok(()));
    assert_eq!(states.check(&of_left(0b11, None)), Err(StateError::Trail));
    assert_eq!(states.check(&of_left(0b01, Some(0b11))), Err(StateError::Trail));
    assert_eq!(KeyOnly::locate(0_u32, Next::Visit, &walk), Err(NoSuchKey));
    assert_eq!(KeyOnly::locate(1_u32 << 20, Next::Visit, &walk), Err(NoSuchKey));
}

#[test]
fn another_thread_goes_on() {
    let case = Case::random(3, CaseOptions { family: Some(Family::Skew), depth: Some(20) });
    let parents = Linked::parents(&case.tree);
    let mut whole = Search::new(&case.tree, &case.tape, false);
    traverse(Afra::<u64, _>::new(&parents).expect("not deep"), &mut whole, &mut ());
    let mut cursor = Afra::<u64, _>::new(&parents).expect("not deep");
    let mut search = Search::new(&case.tree, &case.tape, false);
    // One visit per thread.
    let mut next = Next::Visit;
    let visits = (1..1000).find(|_| {
        let paused = cursor.put_aside(next);
        let parents = &parents;
        let (ended, found) = std::thread::scope(|scope| {
            let mut search = search.clone();
            let run = move || {
                let mut cursor = Afra::<u64, _>::new(parents).expect("not deep");
                cursor.take_up(paused).expect("complete");
                let stopped = traverse(&mut cursor, &mut search, &mut Steps(usize::MAX - 1));
                (stopped.map(|next| cursor.put_aside(next)), search)
            };
            scope.spawn(run).join().expect("no panic")
        });
        search = found;
        match ended {
            Some(paused) => {
                next = paused.next;
                cursor.take_up(paused).expect("complete");
                false
            }
            None => true,
        }
    });
    assert!(visits.is_some_and(|visits| visits > 10), "{visits:?}");
    assert_eq!(search.outcome, whole.outcome);
}

/// Resumes with shorter rays from every visit, and hit by hit from every leaf.
#[test]
fn rays_are_put_aside() {
    let mesh = procedural::soup(5, 90);
    let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree").with_links(Recorded::Uncles);
    let truth = Truth::new(&mesh);
    let all = Options { key_set: KeySet::All, sizing: Sizing::Tight };
    let hash = PerfectHash::build(&bvh, all).expect("a table");
    let cursor = || Hashed::<u32, _, _>::new(&bvh, &hash).expect("not deep");
    let (mut shortened, mut walked) = (0, 0);
    for ray in procedural::rays(&mesh, 2, 120) {
        let hits: Vec<_> = BinaryTracer::new(&bvh).all(&ray);
        for end in [0.3, 0.7].map(|share| share * hits.last().map_or(1.0, |hit| hit.t)) {
            let shorter = Ray::within(ray.origin(), ray.direction(), ray.tmin(), end.max(ray.tmin())).expect("a ray");
            let expected = truth.closest(&shorter).map(|hit| hit.rounded()).map(|hit| (hit.t, hit.prim));
            for visits in 0.. {
                let (mut before, mut search) = (cursor(), Closest::new(&bvh, &ray));
                let Some(next) = traverse(&mut before, &mut search, &mut Steps(usize::MAX - visits)) else { break };
                let kept = before.put_aside(next).key_trail().expect("a key");
                // An earlier hit counts if the shorter ray reaches it.
                let so_far = search.found().map(|(prim, t)| (t, prim)).filter(|&(t, _)| t <= shorter.tmax());
                let mut search = Closest::new(&bvh, &shorter);
                let paused = kept.locate(&ByTable(&hash)).expect("a node of this tree");
                resume(cursor(), paused, &mut search, &mut ()).expect("complete");
                let found = search.found().map(|(prim, t)| (t, prim));
                let best = [so_far, found].into_iter().flatten().min_by(|a, b| a.partial_cmp(b).expect("no NaN"));
                assert_eq!(best, expected, "{visits} {ray:?}");
                shortened += 1;
            }
        }

        let mut met = Vec::new();
        let (mut cursor, mut search) = (cursor(), LeafByLeaf { bvh: &bvh, ray, met: &mut met });
        let mut next = traverse(&mut cursor, &mut search, &mut ());
        while next == Some(Next::Backtrack) {
            walked += 1;
            // As if from another program.
            let kept = cursor.put_aside(Next::Backtrack).key_trail().expect("a key");
            let paused = kept.locate(&ByWalk(&bvh)).expect("a node of this tree");
            cursor = Hashed::new(&bvh, &hash).expect("not deep");
            cursor.take_up(paused).expect("complete");
            next = if cursor.backtrack() { traverse(&mut cursor, &mut search, &mut ()) } else { None };
        }
        met.sort_unstable();
        let mut expected: Vec<_> = hits.iter().map(|hit| hit.prim).collect();
        expected.sort_unstable();
        assert_eq!(met, expected);
    }
    assert!(shortened > 2000 && walked > 20, "{shortened} {walked}");
}

/// Collects all hits, and stops at each leaf with hits.
struct LeafByLeaf<'a> {
    bvh: &'a Bvh,
    ray: Ray,
    met: &'a mut Vec<u32>,
}

impl Visitor for LeafByLeaf<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        Any::new(self.bvh, &self.ray).inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let (kernel, before) = (Exact::new(&self.ray, self.bvh.region()), self.met.len());
        let held = self.bvh.leaf_triangles(node).iter();
        self.met
            .extend(held.filter(|held| kernel.distance(&held.shape, self.ray.tmax()).is_some()).map(|held| held.prim));
        if self.met.len() > before { Flow::Stop } else { Flow::Continue }
    }
}

/// Counts visits, and stops at the maximum.
struct Steps(usize);

impl Recorder for Steps {
    fn visit<W: KeyWord>(&mut self, _: Node, _: impl FnOnce() -> State<W>) -> Flow {
        if self.0 == usize::MAX {
            return Flow::Stop;
        }
        self.0 += 1;
        Flow::Continue
    }
}

/// Calls `f` with every state before a visit of `hashed` with its second trail.
fn for_each_state(case: &Case, mut f: impl FnMut(&Paused<u32>)) {
    let (uncles, map) = (Linked::uncles(&case.tree), KeyMap::of(&case.tree));
    let mut search = Search::new(&case.tree, &case.tape, false);
    let mut cursor = Hashed::<u32, _, _, Disjoint<u32>>::new(&uncles, &map).expect("not deep");
    let mut visits = Steps(usize::MAX - 1);
    while let Some(next) = traverse_pruned(&mut cursor, &mut search, &mut visits) {
        f(&cursor.put_aside(next));
        visits.0 = usize::MAX - 1;
    }
}
