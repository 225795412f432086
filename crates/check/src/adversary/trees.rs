//! Trees and tapes: what traversals do besides visiting nodes.
//!
//! Tapes have no distances here: a hit that shortens the search on the way only leaves something out.

use serde_json::Value;

use super::{Cost, below};
use crate::{Case, Replay, ReplayError};
use stackless_bvh::event::{Backtracks, Recorder, Source, State};
use stackless_bvh::generate::{Family, Kind, Rng, Search, Source as _, Tape};
use stackless_bvh::hash::{BuildError, KeySet, Options, PerfectHash, Sizing, Verified};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{ByNode, Flow, SignOrder, Visitor};
use stackless_bvh::traverse::{Afra, Cursor, Hapala, Hashed, Laine, Sparse, traverse};
use stackless_bvh::tree::{Keys, Linked, Node, Reach, Recorded, Topology, Tree};

/// Leaves of a tree: 63 nodes, at most 31 edges deep.
const LEAVES: u32 = 32;

/// Parents that `afra` follows, per visit.
pub(super) fn climb_afra(case: &Case) -> Option<Cost> {
    let climbs = Climbs::of(&case.tree);
    climbs.cost(Afra::<u64, _>::new(&climbs).ok()?, &mut Search::new(&case.tree, &case.tape, false))
}

/// The same of `sparse`.
pub(super) fn climb_sparse(case: &Case) -> Option<Cost> {
    let climbs = Climbs::of(&case.tree);
    climbs.cost(Sparse::<u64, _>::new(&climbs).ok()?, &mut Search::new(&case.tree, &case.tape, false))
}

/// The same of `hapala`, which visits nodes that are missed and asks for the parent's parent too.
pub(super) fn climb_hapala(case: &Case) -> Option<Cost> {
    let order = SignOrder { axes: case.tape.axes(), octant: case.octant };
    let climbs = Climbs::of(&case.tree);
    let mut test = Search::new(&case.tree, &case.tape, false);
    climbs.cost(Hapala::new(&climbs, order).ok()?, &mut ByNode { test: &mut test, order })
}

/// Visits of `laine-K` on the way down from the root again, per visit.
pub(super) fn restarts<const K: usize>(case: &Case) -> Option<Cost> {
    let mut visits = Visits::default();
    let cursor = Laine::<K, u64, _>::new(&case.tree).ok()?;
    traverse(cursor, &mut Search::new(&case.tree, &case.tape, false), &mut visits);
    Cost::new(visits.again, visits.first)
}

/// Lookups in the perfect hash by `hashed`, per visit.
pub(super) fn lookups(case: &Case) -> Option<Cost> {
    let Backtracking { lookups, visits, .. } = Backtracking::of(case)?;
    Cost::new(lookups, visits)
}

/// Backtracks of `hashed` for which the register does not hold the address since the node was postponed, per visit.
pub(super) fn register_misses(case: &Case) -> Option<Cost> {
    let Backtracking { misses, visits, .. } = Backtracking::of(case)?;
    Cost::new(misses, visits)
}

/// Bytes of the tables of `hashed`, per node.
pub(super) fn table_hashed(case: &Case) -> Option<Cost> {
    let hash = table(case, REACHED, Sizing::Tight)?;
    Cost::new(hash.header().bytes() as u64, case.size() as u64)
}

/// Bytes of the tables of `hash-only`, per node.
pub(super) fn table_hash_only(case: &Case) -> Option<Cost> {
    let hash = table(case, KeySet::All, Sizing::Tight)?;
    Cost::new(hash.header().bytes() as u64, case.size() as u64)
}

/// Cells of the table of `hashed`, out of as few as it begins with: it grows where two keys are equal modulo D and H.
pub(super) fn cells(case: &Case) -> Option<Cost> {
    let hash = table(case, REACHED, Sizing::Tight)?;
    let shared = hash.header().keys - hash.header().direct;
    Cost::new(hash.header().cells.get().into(), (2 * shared + 1).into())
}

/// Seeds that are tried for a table of all keys in the printed size; one more than there are, if none gives a table.
pub(super) fn reseeds_printed(case: &Case) -> Option<Cost> {
    let options = Options { key_set: KeySet::All, sizing: Sizing::Printed };
    match PerfectHash::build(&case.tree, options) {
        Ok(hash) => Cost::new(hash.header().reseeds.into(), 1),
        Err(BuildError::NoSeed { seeds }) => Cost::new(u64::from(seeds) + 1, 1),
        Err(_) => None,
    }
}

/// A case of a random family.
pub(super) fn draw(rng: &mut Rng) -> Case {
    let family = Family::ALL[below(rng, Family::ALL.len())];
    let tree = family.tree(rng, LEAVES);
    let tape = Tape::draw(rng, &tree, Kind::Random);
    Case { tree, tape, any: false, octant: below(rng, 8) as u8 }
}

/// Moves up to four subtrees, answers or orders; `None` if what comes out is no case.
pub fn change(case: &Case, rng: &mut Rng) -> Option<Case> {
    let (mut children, mut cells) = (case.tree.to_children(), case.tape.cells().to_vec());
    for _ in 0..=below(rng, 4) {
        let node = below(rng, cells.len());
        match below(rng, 6) {
            0..2 => drop(regraft(&mut children, rng)),
            2 => children.get_mut(node)?.iter_mut().for_each(|pair| pair.swap(0, 1)),
            3 => cells.get_mut(node)?.axis = below(rng, 3) as u8,
            4 => cells.get_mut(node)?.right_first ^= true,
            _ => cells.get_mut(node)?.miss ^= node > 0,
        }
    }
    let tree = Tree::new(&children).ok()?;
    let tape = Tape::from_cells(&tree, cells)?;
    Some(Case { tree, tape, ..case.clone() })
}

/// The text of a [`Replay`], without what is left out by default.
pub(super) fn write(case: &Case, found: Option<String>) -> Result<String, ReplayError> {
    let replay = Replay {
        children: case.tree.to_children(),
        cells: case.tape.cells().to_vec(),
        any: case.any,
        octant: case.octant,
        methods: Vec::new(),
        word: None,
        fault: found,
    };
    let mut value = serde_json::to_value(replay)?;
    if let Some(Value::Array(cells)) = value.get_mut("cells") {
        let is_told = |value: &Value| !matches!(value, Value::Null | Value::Bool(false)) && *value != 0;
        cells.iter_mut().filter_map(Value::as_object_mut).for_each(|cell| cell.retain(|_, value| is_told(value)));
    }
    Ok(serde_json::to_string(&value)?)
}

/// Takes a subtree from its parent, whose place its sibling gets, and puts both on another edge. The root and its
/// children stay where they are.
fn regraft(children: &mut [Option<[u32; 2]>], rng: &mut Rng) -> Option<()> {
    let [moved, onto] = [(); 2].map(|()| below(rng, children.len()) as u32);
    let is_child = |pair: &Option<[u32; 2]>, node| pair.is_some_and(|pair| pair.contains(&node));
    let parent_of = |children: &[_], node| children.iter().position(|pair| is_child(pair, node)).map(|i| i as u32);
    let parent = parent_of(children, moved)?;
    let above = parent_of(children, parent)?;
    let mut ancestors = std::iter::successors(Some(onto), |&node| parent_of(children, node));
    if onto == 0 || onto == parent || ancestors.any(|node| node == moved) {
        return None;
    }
    let pair = children.get_mut(parent as usize)?.take()?;
    let sibling = if pair[0] == moved { pair[1] } else { pair[0] };
    replace(children, above, parent, sibling);
    let over = parent_of(children, onto)?;
    replace(children, over, onto, parent);
    *children.get_mut(parent as usize)? = Some(if rng.coin() { [moved, onto] } else { [onto, moved] });
    Some(())
}

/// Gives a node another child in place of one that it has.
fn replace(children: &mut [Option<[u32; 2]>], node: u32, old: u32, new: u32) {
    let pairs = children.get_mut(node as usize).into_iter().flatten();
    pairs.flatten().filter(|child| **child == old).for_each(|child| *child = new);
}

/// A tree whose parents are counted as they are followed.
struct Climbs<'t> {
    tree: Linked<'t, Tree>,
    count: std::cell::Cell<u64>,
}

impl<'t> Climbs<'t> {
    fn of(tree: &'t Tree) -> Self {
        Self { tree: Linked::parents(tree), count: std::cell::Cell::new(0) }
    }

    /// Parents followed by a traversal, per visit.
    fn cost(&self, cursor: impl Cursor, visitor: &mut impl Visitor) -> Option<Cost> {
        let mut visits = Visits::default();
        traverse(cursor, visitor, &mut visits);
        Cost::new(self.count.get(), visits.first)
    }
}

impl Topology for Climbs<'_> {
    stackless_bvh::topology_of!(tree);

    fn names(&self, what: Recorded) -> bool {
        self.tree.names(what)
    }

    fn parent(&self, node: Node) -> Node {
        self.count.set(self.count.get() + 1);
        self.tree.parent(node)
    }

    fn sibling(&self, node: Node) -> Node {
        self.tree.sibling(node)
    }
}

/// Counts visits, and those on the way down again.
#[derive(Default)]
struct Visits {
    first: u64,
    again: u64,
}

impl Recorder for Visits {
    fn visit<W: KeyWord>(&mut self, _: Node, state: impl FnOnce() -> State<W>) -> Flow {
        *(if state().is_restarting { &mut self.again } else { &mut self.first }) += 1;
        Flow::Continue
    }
}

/// How `hashed` has found its way back.
struct Backtracking {
    visits: u64,
    lookups: u64,
    misses: u64,
}

impl Backtracking {
    fn of(case: &Case) -> Option<Self> {
        let tree = &case.tree;
        let (uncles, keys, hash) = (Linked::uncles(tree), Keys::of(tree), table(case, REACHED, Sizing::Tight)?);
        let (hash, mut search) = (Verified::new(&hash, tree, &keys), Search::new(tree, &case.tape, false));
        let mut backtracks = Backtracks::new(REACH);
        traverse(Hashed::<u64, _, _>::new(&uncles, &hash).ok()?, &mut search, &mut backtracks);
        let visits = search.outcome.inner_visits + search.outcome.leaf_visits;
        let misses = backtracks.total() - backtracks.by(Source::Register);
        Some(Self { visits, lookups: hash.lookups() as u64, misses })
    }
}

/// What the records name.
const REACH: Reach = Reach::ALGORITHM_1;

/// The keys that `hashed` looks up.
const REACHED: KeySet = KeySet::Exact(REACH);

fn table(case: &Case, key_set: KeySet, sizing: Sizing) -> Option<PerfectHash> {
    PerfectHash::build(&case.tree, Options { key_set, sizing }).ok()
}
