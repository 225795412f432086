//! Compares the models of spec/rocq with the library: small cases with the visits and states of the library's
//! traversals, written as Rocq examples, which `spec/rocq/check.sh` evaluates. `UPDATE=1` rewrites the file.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::{Family, Kind, Rng, Search, Source, Tape};
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, Descent, Flow, LeftOrder, NodeTest, Pruned, Side, Visitor};
use stackless_bvh::traverse::{Method, Tables};
use stackless_bvh::tree::{Keys, Node, Topology, Tree};

const CASES: u32 = 150;
const LEAVES: u64 = 8;
const METHODS: [Method; 3] = [Method::Hashed, Method::Sparse, Method::LeftFirst];

/// A search that takes note of what it decides.
struct Scribe<'a> {
    search: Search<'a, Tree>,
    tree: &'a Tree,
    keys: &'a Keys,
    descents: Vec<(u64, Descent)>,
    accepted: Vec<u64>,
    /// The leaf that ended it.
    end: Option<u64>,
}

impl<'a> Scribe<'a> {
    fn new(case: &'a Case) -> Self {
        let search = Search::new(&case.tree, &case.tape, case.any);
        let (descents, accepted) = (Vec::new(), Vec::new());
        Self { search, tree: &case.tree, keys: &case.keys, descents, accepted, end: None }
    }

    fn key(&self, node: Node) -> u64 {
        self.keys.key(self.tree.slot(node))
    }

    fn note_end(&mut self, leaf: Node, flow: Flow) -> Flow {
        self.end = (flow == Flow::Stop).then(|| self.key(leaf));
        flow
    }
}

impl Visitor for Scribe<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let descent = self.search.inner(node);
        self.descents.push((self.key(node), descent));
        descent
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let flow = Visitor::leaf(&mut self.search, node);
        self.note_end(node, flow)
    }
}

impl Pruned for Scribe<'_> {}

impl NodeTest for Scribe<'_> {
    fn accept(&mut self, node: Node) -> bool {
        let accepts = self.search.accept(node);
        self.accepted.extend(accepts.then(|| self.key(node)));
        accepts
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let flow = NodeTest::leaf(&mut self.search, node);
        self.note_end(node, flow)
    }
}

/// A recorded visit: the node's key by its place in the tree, and the traversal's state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Visit {
    key: u64,
    state_key: Option<u64>,
    trail: Option<u64>,
    counter: Option<u64>,
}

struct Visits<'a> {
    tree: &'a Tree,
    keys: &'a Keys,
    all: Vec<Visit>,
}

impl Recorder for Visits<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let State { key: state_key, trail, counter, .. } = state().map(|word| Some(word.to_u64().unwrap()));
        let key = self.keys.key(self.tree.slot(node));
        self.all.push(Visit { key, state_key, trail, counter });
        Flow::Continue
    }
}

struct Case {
    tree: Tree,
    keys: Keys,
    tape: Tape,
    any: bool,
}

impl Case {
    fn draw(rng: &mut Rng, kind: Kind) -> Self {
        let family = Family::ALL[rng.below(Family::ALL.len() as u64) as usize];
        let leaves = 1 + rng.below(LEAVES) as u32;
        let tree = family.tree(rng, leaves);
        let tape = Tape::draw(rng, &tree, kind);
        Self { keys: Keys::of(&tree), any: rng.coin(), tree, tape }
    }

    /// Records the decisions and visits of a run.
    fn record(&self, run: impl FnOnce(&mut Scribe<'_>, &mut Visits<'_>)) -> (Scribe<'_>, Vec<Visit>) {
        let mut visits = Visits { tree: &self.tree, keys: &self.keys, all: Vec::new() };
        let mut scribe = Scribe::new(self);
        run(&mut scribe, &mut visits);
        (scribe, visits.all)
    }

    fn run(&self, tables: &Tables<'_, Tree>, method: Method) -> (Scribe<'_>, Vec<Visit>) {
        self.record(|scribe, visits| {
            tables.run::<u64, _>(method, 0, &mut Vec::new(), scribe, visits).unwrap();
        })
    }
}

/// The children of a node as Rocq has them.
fn term(tree: &Tree, node: Node) -> String {
    if node.is_leaf() {
        return "Leaf".to_owned();
    }
    let [left, right] = tree.children(node).map(|child| term(tree, child));
    format!("(Node {left} {right})")
}

fn side(side: Side) -> char {
    if side == Side::Right { 'R' } else { 'L' }
}

fn descent((key, descent): &(u64, Descent)) -> String {
    match (descent.is_neither(), descent.postpones()) {
        (true, _) => format!("({key}%positive, Neither)"),
        (_, true) => format!("({key}%positive, Both {})", side(descent.first())),
        _ => format!("({key}%positive, Only {})", side(descent.first())),
    }
}

fn list<T>(items: &[T], show: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(show).collect::<Vec<_>>().join("; "))
}

fn optional_key(key: Option<u64>) -> String {
    key.map_or("None".to_owned(), |key| format!("(Some {key}%positive)"))
}

/// Writes the oracle's case, with which the traversals agree, and that of Algorithm 1.
fn write(text: &mut String, index: u32, case: &Case) -> std::fmt::Result {
    let tables = Tables::new(&case.tree, case.tape.axes(), &METHODS, 8);
    let tree = term(&case.tree, case.tree.root());
    let keys = |visits: &[Visit]| visits.iter().map(|visit| visit.key).collect::<Vec<_>>();

    let (said, oracle) = case.record(|scribe, visits| oracle::traverse(&case.tree, scribe, visits));
    let [hashed, sparse] = [Method::Hashed, Method::Sparse].map(|method| case.run(&tables, method).1);
    assert_eq!((keys(&hashed), keys(&sparse)), (keys(&oracle), keys(&oracle)));
    let states: Vec<_> = hashed.iter().zip(&sparse).collect();
    writeln!(
        text,
        "\nExample case_{index} : seen {tree}\n  {}\n  {}\n  = expected {}\n  {}.\nProof. evaluated. Qed.",
        list(&said.descents, descent),
        optional_key(said.end),
        said.end.is_some(),
        list(&states, |(hashed, sparse)| {
            let (key, trail, counter) = (hashed.state_key.unwrap(), hashed.trail.unwrap(), sparse.counter.unwrap());
            format!("({key}%positive, {trail}, {counter})")
        }),
    )?;

    let by_oracle = case.record(|scribe, visits| {
        oracle::traverse(&case.tree, &mut ByNode { test: scribe, order: LeftOrder }, visits);
    });
    let (said, visits) = case.run(&tables, Method::LeftFirst);
    assert_eq!(keys(&visits), keys(&by_oracle.1));
    let key_list = |keys: &[u64]| list(keys, |key| format!("{key}%positive"));
    let state_keys: Vec<_> = visits.iter().map(|visit| visit.state_key.unwrap()).collect();
    writeln!(
        text,
        "\nExample left_{index} : seen_left {tree}\n  {} {}\n  = expected_left {} {}.\nProof. evaluated. Qed.",
        key_list(&said.accepted),
        optional_key(said.end),
        said.end.is_some(),
        key_list(&state_keys),
    )
}

fn vectors() -> String {
    let mut text = String::from(
        "(** Cases with the visits and the states that the library saw. Written by tests/library/rocq_vectors.rs. *)\n\n\
         Require Import List PArith NArith.\nRequire Import Tree Cases.\nImport ListNotations.\nOpen Scope N_scope.\n",
    );
    let mut rng = Rng::new(16);
    for (index, kind) in (0..CASES).zip(Kind::ALL.into_iter().cycle()) {
        write(&mut text, index, &Case::draw(&mut rng, kind)).unwrap();
    }
    text
}

#[test]
fn the_cases_of_the_models_are_what_the_library_does() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../spec/rocq/Vectors.v");
    let text = vectors();
    for word in ["Neither)", "Only L)", "Only R)", "Both L)", "Both R)", "expected true", "expected_left true"] {
        assert!(text.contains(word), "no case has {word}");
    }
    if std::env::var_os("UPDATE").is_some_and(|value| value == "1") {
        fs::write(&path, &text).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap() == text, "run with UPDATE=1, and check that the models agree");
}
