//! Trees deeper than a word: divided into pieces, and, in ray tracing, with the growing word and in pieces.

mod rays;

use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::{Exhaustive, Family, Kind, Rng, Search, Source, Tape, shape};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Flow;
use stackless_bvh::traverse::{Afra, Cuts, Method, Split, Stack, Unsupported, traverse};
use stackless_bvh::tree::{Linked, Node, Topology, Tree};
use stackless_check::{Battery, Case, CaseOptions, Pieces, Verdict};

fn methods() -> Vec<Method> {
    Pieces::<Tree>::methods().collect()
}

/// Checks a traversal in pieces.
fn check<W: KeyWord>(battery: &mut Battery<'_>, pieces: &Pieces<'_, Linked<'_, Tree>>, method: Method) -> Verdict {
    battery.judge(method.test(), method.restarts(), |search, watch, _, _| pieces.run::<W>(method, search, watch))
}

/// Runs all traversals of a case whose tree is cut every `levels` levels, with one word. Returns the number that
/// agreed. The only permitted refusal is that the tree is too deep for the word.
fn agreeing<W: KeyWord>(case: &Case, levels: u32) -> usize {
    let (linked, mut battery) = (Linked::both(&case.tree), Battery::new(case, &[]));
    let cuts = Cuts::every(levels, &linked);
    let pieces = Pieces::new(&cuts).expect("tables");
    let agrees = |&&method: &&Method| {
        let carried = W::WIDTH.map_or(u32::MAX, |width| match method.without_pruning() {
            Method::Afra | Method::Uncle => width,
            Method::ImplicitA1 => width - 2,
            _ => width - 1,
        });
        let depth = cuts.top().depth();
        match check::<W>(&mut battery, &pieces, method) {
            Verdict::Agrees { .. } => {
                assert!(depth <= carried, "{method} {} carries {depth}", W::NAME);
                true
            }
            Verdict::Refused(Unsupported::TooDeep(error)) => {
                assert_eq!((error.depth, error.limit, error.word), (depth, carried, W::NAME), "{method}");
                assert!(depth > carried, "{method} {} refuses {depth}", W::NAME);
                false
            }
            verdict => panic!("{method} {} cut every {levels} levels: {verdict:?}\n{case:?}", W::NAME),
        }
    };
    methods().iter().filter(agrees).count()
}

/// [DEPTH-4]
#[test]
fn all_small_trees_under_all_scripts() {
    let (mut all, mut count) = (Exhaustive::new(), 0);
    while all.next_case() {
        let leaves = 1 + all.below(5) as u32;
        let tree = Tree::new(&shape(&mut all, leaves)).unwrap();
        let tape = Tape::draw(&mut all, &tree, Kind::Script);
        let case = Case { tree, tape, any: false, octant: 2 };
        for levels in 1..=3 {
            count += agreeing::<u8>(&case, levels);
        }
    }
    assert!(count > 100_000, "{count}");
}

#[test]
fn random_trees_cut_every_1_to_31_levels() {
    for levels in 1..=31 {
        for seed in 0..60 {
            let case = Case::random(1000 * u64::from(levels) + seed, CaseOptions::default());
            // One form of Algorithm 2 supports 30 levels in 32 bits, and all other forms support more.
            let refused = usize::from(levels.min(case.tree.depth()) == 31);
            assert_eq!(agreeing::<u32>(&case, levels), methods().len() - refused);
        }
    }
}

#[test]
fn deep_trees_of_all_families_in_all_words() {
    let mut rng = Rng::new(3);
    for family in [Family::Comb, Family::Caterpillar, Family::Skew, Family::Catalan] {
        for leaves in [32, 65, 129, 201] {
            for kind in Kind::ALL {
                let case = Case::with_tree(family.tree(&mut rng, leaves), kind, &mut rng);
                for around in [0, 1, 2, 3, 4] {
                    agreeing::<u8>(&case, 5 + around);
                    agreeing::<u16>(&case, 13 + around);
                    agreeing::<u32>(&case, 29 + around);
                    agreeing::<u64>(&case, 61 + around);
                }
                assert_eq!(agreeing::<u8>(&case, 6), methods().len());
            }
        }
    }
}

#[test]
fn a_depth_of_1000_in_narrow_words() {
    let mut rng = Rng::new(4);
    for kind in [Kind::Random, Kind::AllHit, Kind::OnlyOne, Kind::Shrinking, Kind::Intervals] {
        let case = Case::with_tree(Family::Comb.tree(&mut rng, 1001), kind, &mut rng);
        assert_eq!(agreeing::<u8>(&case, 6), methods().len());
        assert_eq!(agreeing::<u32>(&case, 30), methods().len());
        assert_eq!(agreeing::<u64>(&case, 62), methods().len());
    }
}

/// Traversals designed for such depths.
const FOR_ANY_DEPTH: [Method; 5] = [Method::Sparse, Method::Afra, Method::Uncle, Method::HashOnly, Method::Hashed];

/// Records a number of visits, and then stops the traversal.
#[derive(PartialEq)]
struct First(Trace, usize);

impl Recorder for First {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        if self.0.nodes().len() == self.1 { Flow::Stop } else { self.0.visit(node, state) }
    }
}

/// Returns a chain that goes to one side at every level.
fn chain(depth: u32, right: bool) -> Tree {
    let next = |i: u32| if right { [2 * i + 1, 2 * i + 2] } else { [2 * i + 2, 2 * i + 1] };
    let children: Vec<_> = (0..depth).flat_map(|i| [Some(next(i)), None]).chain([None]).collect();
    Tree::new(&children).unwrap()
}

/// [DEPTH-4]
#[test]
fn a_depth_of_100_000_in_narrow_words() {
    let mut rng = Rng::new(5);
    for tree in [Family::Comb.tree(&mut rng, 100_001), chain(100_000, false), chain(100_000, true)] {
        assert_eq!(tree.depth(), 100_000);
        for levels in [6, 30, 62] {
            let linked = Linked::both(&tree);
            let cuts = Cuts::every(levels, &linked);
            assert_eq!(cuts.nesting(), 100_000_u32.div_ceil(levels));
            let pieces = Pieces::new(&cuts).expect("tables");
            for (kind, any) in [(Kind::AllHit, false), (Kind::Shrinking, false), (Kind::OnlyOne, true)] {
                let tape = Tape::hashed(u64::from(levels), &tree, kind);
                let see = |run: &dyn Fn(&mut Search<'_, Tree>, &mut First)| {
                    let (mut search, mut trace) = (Search::new(&tree, &tape, any), First(Trace::default(), 200_002));
                    run(&mut search, &mut trace);
                    (trace, search.outcome)
                };
                let expected = see(&|search, trace| {
                    traverse(Stack::new(&tree, &mut Vec::new()), search, trace);
                });
                for method in FOR_ANY_DEPTH {
                    let found = see(&|search, trace| {
                        let run = match levels {
                            6 => Pieces::run::<u8>,
                            30 => Pieces::run::<u32>,
                            _ => Pieces::run::<u64>,
                        };
                        run(&pieces, method, search, trace).unwrap();
                    });
                    assert!(found == expected, "{method} cut every {levels} levels, {}", kind.name());
                }
            }
        }
    }
}

/// A recorder may stop a traversal anywhere: in a piece, at a cut, and on a backtrack.
#[test]
fn the_memory_of_a_stopped_traversal_serves_the_next() {
    let case = Case::random(8, CaseOptions { family: Some(Family::Comb), depth: Some(40) });
    let tape = &Tape::hashed(2, &case.tree, Kind::AllHit);
    let parents = Linked::parents(&case.tree);
    let (cuts, mut waiting) = (&Cuts::every(3, &parents), Vec::new());
    let mut run = |visits| {
        let mut recorder = First(Trace::default(), visits);
        let split = Split::new(cuts, &mut waiting, Afra::<u8, _>::new).unwrap();
        traverse(split, &mut Search::new(&case.tree, tape, false), &mut recorder);
        recorder.0
    };
    let whole = run(usize::MAX);
    assert_eq!(whole.nodes().len(), 81);
    for visits in 0..81 {
        assert_eq!(run(visits).nodes(), &whole.nodes()[..visits]);
        assert!(run(usize::MAX) == whole, "after {visits} visits");
    }
}
