//! Observation of an unmodified traversal: its states, the answers of the search, and its reads of links and tables.

use std::cell::RefCell;

use super::{ExplainError, HashLookup, Table, slot};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::Search;
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::traverse::{AuxTables, Need};
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::{
    ByNode, Descent, FixedOrder, Flow, LeftOrder, NodeTest, Pruned, Pruning, SignOrder, Visitor,
};
use stackless_bvh::traverse::{Method, Tables, Test};
use stackless_bvh::tree::{Linked, Node, Parents, Reach, Recorded, Topology, Tree, Uncles};
use stackless_check::{Case, Watched};

/// The deepest tree that gets the implicit layout.
const IMPLICIT_DEPTH: u32 = 13;

/// The word type of the traversals.
pub(super) type Word = u128;

/// The observations from one visit to the next.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) state: State<Word>,
    /// The decision at an inner node.
    pub(super) descent: Option<Descent>,
    pub(super) found: Found,
    /// Nodes whose links were read, in order.
    pub(super) read: Vec<Node>,
    pub(super) lookup: Option<HashLookup>,
}

/// The result at a leaf.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    /// The search finds a better hit.
    pub(super) hit: bool,
    /// The hit prunes the disjoint nodes.
    pub(super) prunes: bool,
    /// The hit ends the search.
    pub(super) stops: bool,
}

/// The visits so far. All observers write to it.
#[derive(Debug, Default)]
pub(super) struct Log(RefCell<Vec<Seen>>);

impl Log {
    pub(super) fn into_steps(self) -> Vec<Seen> {
        self.0.into_inner()
    }

    /// Adds an observation to the current visit.
    fn note(&self, add: impl FnOnce(&mut Seen)) {
        if let Some(seen) = self.0.borrow_mut().last_mut() {
            add(seen);
        }
    }
}

/// Runs a traversal over a case. The perfect hash has the papers' sizes.
pub(super) fn run(case: &Case, method: Method, log: &Log) -> Result<Option<Table>, ExplainError> {
    let tree = &case.tree;
    let unfit = |error| ExplainError::Unsupported { method, error };
    let hash = key_set(method).map(|key_set| PerfectHash::build(tree, Options { key_set, sizing: Sizing::Printed }));
    let hash = hash.transpose().map_err(|error| ExplainError::Table { method, error })?;
    let linked = Linked::naming(tree, &[method.wants_recorded()]);
    let watched = Watched { tree: &linked, watch: |node| log.note(|seen| seen.read.push(node)) };
    let asked = |_| Asked { hash: hash.as_ref(), tree, log };
    let beside = AuxTables::new(&watched, case.tape.axes(), &[method], IMPLICIT_DEPTH).looked_up_by(asked);
    let tables = Tables::with(&watched, case.tape.axes(), beside);
    let (mut search, mut watching) = (Deciding::new(case, method, log), Watching::new(case, log));
    tables.run::<Word, _>(method, case.octant, &mut Vec::new(), &mut search, &mut watching).map_err(unfit)?;
    Ok(hash.map(|hash| Table::of(&hash, |node| slot(tree, node))))
}

/// Runs the oracle of a traversal.
pub(super) fn run_oracle(case: &Case, method: Method, log: &Log) {
    let (tree, root) = (&case.tree, case.tree.root());
    let (mut search, mut watch) = (Deciding::new(case, method, log), Watching::new(case, log));
    match method.test() {
        Test::NodeLeftFirst => {
            oracle::traverse(tree, &mut ByNode { test: search, order: LeftOrder }, &mut watch);
        }
        Test::NodeBySign => {
            let order = by_sign(case);
            oracle::traverse(tree, &mut ByNode { test: search, order }, &mut watch);
        }
        test => {
            oracle::traverse_pruned(tree, root, test.pruning(), &mut search, &mut watch);
        }
    }
}

/// Returns the names of a traversal's links.
pub(super) const fn link_names(method: Method) -> &'static [&'static str] {
    match method.wants_recorded() {
        Recorded::ParentSibling => &["parent", "sibling"],
        Recorded::Uncles => &["uncle", "grand uncle"],
        Recorded::Nothing => &[],
    }
}

/// The linked nodes, in the order of [`link_names`].
#[derive(Debug)]
pub(super) enum LinkTable {
    Nothing,
    Parents(Parents),
    Uncles(Uncles),
}

impl LinkTable {
    pub(super) fn of(tree: &Tree, method: Method) -> Self {
        match method.wants_recorded() {
            Recorded::ParentSibling => Self::Parents(Parents::of(tree)),
            Recorded::Uncles => Self::Uncles(Uncles::of(tree)),
            Recorded::Nothing => Self::Nothing,
        }
    }

    /// Returns the linked nodes of a node; `None` for links to the root that mean "none".
    pub(super) fn of_node(&self, tree: &Tree, node: Node) -> Vec<Option<Node>> {
        let root = tree.root();
        match self {
            Self::Nothing => Vec::new(),
            Self::Parents(parents) => parents.row(tree, node).map(|link| (node != root).then_some(link)).to_vec(),
            Self::Uncles(uncles) => {
                uncles.row(tree, node).into_iter().take(2).map(|link| (link != root).then_some(link)).collect()
            }
        }
    }
}

const fn key_set(method: Method) -> Option<KeySet> {
    match method.needs() {
        Need::ReachedKeys => Some(KeySet::Exact(Reach::ALGORITHM_1)),
        Need::AllKeys => Some(KeySet::All),
        _ => None,
    }
}

fn by_sign(case: &Case) -> SignOrder<'_> {
    SignOrder { axes: case.tape.axes(), octant: case.octant }
}

/// A table that records its lookups. An unknown key leads to any node, which the comparison detects.
struct Asked<'a> {
    /// The hash with the papers' sizes, in place of the one built with the tables.
    hash: Option<&'a PerfectHash>,
    tree: &'a Tree,
    log: &'a Log,
}

impl stackless_bvh::hash::Lookup<Word> for Asked<'_> {
    fn node(&self, key: &Word) -> Node {
        let lookup = self.hash.map(|hash| HashLookup::of(hash, key, |node| slot(self.tree, node)));
        self.log.note(|seen| seen.lookup = lookup);
        self.hash.and_then(|hash| hash.probe(key)).unwrap_or(self.tree.root())
    }
}

/// Observes each state, and stops a traversal that does not end.
struct Watching<'a> {
    log: &'a Log,
    limit: usize,
}

impl<'a> Watching<'a> {
    /// Restarts visit each level once per visit.
    fn new(case: &Case, log: &'a Log) -> Self {
        Self { log, limit: (case.size() + 1) * (case.tree.depth() as usize + 2) }
    }
}

impl Recorder for Watching<'_> {
    fn visit<W: KeyWord>(&mut self, _: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let state = state().map(|word| wide(&word));
        let mut steps = self.log.0.borrow_mut();
        steps.push(Seen { state, descent: None, found: Found::default(), read: Vec::new(), lookup: None });
        if steps.len() < self.limit { Flow::Continue } else { Flow::Stop }
    }
}

/// Returns the value of a word; `None` if it has more than 128 bits.
fn wide(word: &impl KeyWord) -> Option<Word> {
    let length = word.bit_length();
    let bits = |rest: Word, piece: u32| rest << (length - 63 * piece).min(63) | Word::from(word.piece(piece));
    (length <= Word::BITS).then(|| (0..word.piece_count()).fold(0, bits))
}

/// A search that records its answers.
struct Deciding<'a> {
    search: Search<'a, Tree>,
    log: &'a Log,
    /// The order of children if nodes are tested at their visit: by sign, or left first.
    order: Option<SignOrder<'a>>,
}

impl<'a> Deciding<'a> {
    fn new(case: &'a Case, method: Method, log: &'a Log) -> Self {
        let order = (method.test() == Test::NodeBySign).then(|| by_sign(case));
        Self { search: Search::new(&case.tree, &case.tape, case.any), log, order }
    }

    fn decides(&self, descent: Descent) -> Descent {
        self.log.note(|seen| seen.descent = Some(descent));
        descent
    }

    fn look_into(&mut self, look: impl FnOnce(&mut Search<'a, Tree>) -> Flow) -> Flow {
        let before = self.search.outcome.hit;
        let flow = look(&mut self.search);
        let hit = self.search.outcome.hit != before;
        self.log.note(|seen| (seen.found.hit, seen.found.stops) = (hit, flow == Flow::Stop));
        flow
    }
}

impl Visitor for Deciding<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let descent = self.search.inner(node);
        self.decides(descent)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.look_into(|search| Visitor::leaf(search, node))
    }
}

impl Pruned for Deciding<'_> {
    fn allows(&self, pruning: Pruning) -> bool {
        self.search.allows(pruning)
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let descent = self.search.inner_marked(node);
        self.decides(descent)
    }

    fn found_at(&self, leaf: Node) -> bool {
        let prunes = self.search.found_at(leaf);
        self.log.note(|seen| seen.found.prunes = prunes);
        prunes
    }

    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        self.search.postponed(node, descent)
    }

    fn end(&self) -> u32 {
        self.search.end()
    }
}

impl NodeTest for Deciding<'_> {
    fn accept(&mut self, node: Node) -> bool {
        let accepted = self.search.accept(node);
        let first = self.order.map_or_else(|| LeftOrder.first(node), |order| order.first(node));
        self.decides(if accepted { Descent::both(first) } else { Descent::NEITHER });
        accepted
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.look_into(|search| NodeTest::leaf(search, node))
    }
}
