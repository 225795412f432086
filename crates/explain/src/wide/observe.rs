//! Observation of a wide-tree traversal: the state of its cursor, the answers of the search, and the records read.

use std::cell::{Cell, RefCell};

use super::places::Places;
use crate::ExplainError;
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::internals::wide::{Context, Scratch, StateView, Supply};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{
    Cursor, Method, Next, Ranks, Search, Tables, Topology, Tree, Unsupported, Wanted, advance, oracle,
};

/// The observations from one visit to the next.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) node: Node,
    /// The visit is a repetition, on the way down after a restart.
    pub(super) is_restarting: bool,
    /// The key of the node, if it is part of the state.
    pub(super) key: Option<u64>,
    /// The state of the nodes above, from the root's on; empty if it is not stored per level.
    pub(super) levels: Vec<LevelState>,
    /// The end of the search, before the visit.
    pub(super) end: u32,
    /// At an inner node: the wanted children with their ranks, the first one first.
    pub(super) wanted: Option<Vec<(Node, u32)>>,
    /// The search finds a hit in this leaf.
    pub(super) is_hit: bool,
    /// The hit ends the search.
    pub(super) stops: bool,
    /// The events before the traversal determines the next node.
    pub(super) backs: Vec<Back>,
}

/// The stored state of a node above the current one.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelState {
    pub(super) words: StateView,
    /// The end has changed since the node was queried.
    pub(super) has_changed: bool,
}

/// A return to an ancestor, or a repeated query of the current node.
#[derive(Clone, Debug)]
pub(super) struct Back {
    pub(super) from: Node,
    pub(super) to: Node,
    /// Nodes whose records were read for it.
    pub(super) read: Vec<Node>,
    /// The key of the lookup.
    pub(super) key: Option<u64>,
    /// The search was queried again there.
    pub(super) is_asked: bool,
}

/// The visits so far. All observers write to it.
#[derive(Debug)]
pub(super) struct Log<'p> {
    places: &'p Places,
    steps: RefCell<Vec<Seen>>,
    /// The current end of the search.
    end: Cell<u32>,
    /// The end at the time of each node's query.
    asked: RefCell<Vec<Option<u32>>>,
    /// Key and stored levels of the last determined child, until it is visited.
    named: RefCell<Option<(Option<u64>, Vec<LevelState>)>>,
    read: RefCell<Vec<Node>>,
}

impl<'p> Log<'p> {
    pub(super) fn new(places: &'p Places) -> Self {
        let asked = RefCell::new(vec![None; places.len()]);
        Self {
            places,
            steps: RefCell::default(),
            end: Cell::default(),
            asked,
            named: RefCell::default(),
            read: RefCell::default(),
        }
    }

    /// Returns the steps, and the end of the search after them.
    pub(super) fn into_steps(self) -> (Vec<Seen>, u32) {
        (self.steps.into_inner(), self.end.get())
    }

    /// Adds an observation to the current visit.
    fn note(&self, add: impl FnOnce(&mut Seen)) {
        if let Some(seen) = self.steps.borrow_mut().last_mut() {
            add(seen);
        }
    }

    fn visited(&self, node: Node, is_restarting: bool) {
        let (key, levels) = self.named.take().unwrap_or_default();
        let (end, wanted, backs) = (self.end.get(), None, Vec::new());
        let seen = Seen { node, is_restarting, key, levels, end, wanted, is_hit: false, stops: false, backs };
        self.steps.borrow_mut().push(seen);
    }

    /// Records a query of a node: at its visit, or again.
    fn was_asked(&self, node: Node, wanted: Vec<(Node, u32)>) {
        self.asked.borrow_mut()[node.index()] = Some(self.end.get());
        self.note(|seen| {
            if seen.node == node && seen.wanted.is_none() {
                seen.wanted = Some(wanted);
                return;
            }
            match seen.backs.last_mut() {
                Some(back) if back.to == node => back.is_asked = true,
                _ => seen.backs.push(Back { from: node, to: node, read: Vec::new(), key: None, is_asked: true }),
            }
        });
    }

    /// Returns the cursor's state of the ancestors of a node at a depth.
    fn kept<const A: usize>(&self, cursor: &impl Cursor<A>, node: Node, own: u32) -> Vec<LevelState> {
        let of_ancestor = |ancestor: Node| {
            let words = cursor.words(own - self.places.depth(ancestor))?;
            let has_changed = self.asked.borrow()[ancestor.index()].is_some_and(|end| end != self.end.get());
            Some(LevelState { words, has_changed })
        };
        self.places.ancestors(node).into_iter().rev().map(of_ancestor).collect::<Option<_>>().unwrap_or_default()
    }
}

/// Runs a traversal to its end, and stops one that does not end.
pub(super) fn run<const A: usize, S: Search<A>>(
    tree: &Tree<A>,
    tables: &Tables,
    method: Method,
    search: S,
    log: &Log<'_>,
) -> Result<(), ExplainError> {
    let (watched, memory) = (WatchedTree { tree, log }, &mut Scratch::default());
    let from = Supply { tree: &watched, tables, memory };
    let ran = method.dispatch(Run { from, search: Deciding::new(tree, search, log), log });
    ran.map_err(|error| ExplainError::UnsupportedWide { method, error })
}

/// Runs the oracle.
pub(super) fn run_oracle<const A: usize, S: Search<A>>(tree: &Tree<A>, search: S, log: &Log<'_>) {
    oracle::traverse(tree, &mut Deciding::new(tree, search, log), &mut Watching(log));
}

struct Run<'t, 'l, 'p, S, T> {
    from: Supply<'t, T>,
    search: S,
    log: &'l Log<'p>,
}

impl<'t, const A: usize, T: Topology<A>, S: Search<A>> Context<'t, A, T> for Run<'t, '_, '_, S, T> {
    type Output = ();

    fn run<C: Cursor<A>>(self, start: impl Fn(Supply<'t, T>) -> Result<C, Unsupported>) -> Result<(), Unsupported> {
        let Self { from, mut search, log } = self;
        let tree = from.tree;
        let mut cursor = Observed { cursor: start(from)?, log };
        *log.named.borrow_mut() = Some((cursor.key(), Vec::new()));
        log.visited(cursor.node(), false);
        // No node is queried more often than it has descendants.
        for _ in 0..(log.places.len() + 2) * (tree.levels() as usize + 2) * A {
            let wanted = search.ask(cursor.node());
            if !advance(tree, &mut cursor, wanted, &mut search, &mut Watching(log)) {
                break;
            }
        }
        Ok(())
    }
}

/// A tree that records whose ancestors are read.
#[derive(Debug)]
struct WatchedTree<'t, 'p, const A: usize> {
    tree: &'t Tree<A>,
    log: &'t Log<'p>,
}

impl<const A: usize> Topology<A> for WatchedTree<'_, '_, A> {
    fn root(&self) -> Node {
        self.tree.root()
    }

    fn children(&self, node: Node) -> u32 {
        self.tree.children(node)
    }

    fn leaves(&self, node: Node) -> u32 {
        self.tree.leaves(node)
    }

    fn child(&self, node: Node, slot: u32) -> Node {
        self.tree.child(node, slot)
    }

    fn levels(&self) -> u32 {
        self.tree.levels()
    }

    fn ancestor(&self, node: Node, up: u32) -> Node {
        self.log.read.borrow_mut().push(node);
        self.tree.ancestor(node, up)
    }
}

/// Observes each visit.
struct Watching<'l, 'p>(&'l Log<'p>);

impl Recorder for Watching<'_, '_> {
    fn visit<W: KeyWord>(&mut self, node: Node, _: impl FnOnce() -> State<W>) -> Flow {
        self.0.visited(node, false);
        Flow::Continue
    }
}

/// A cursor that is observed after each of its steps.
struct Observed<'l, 'p, C> {
    cursor: C,
    log: &'l Log<'p>,
}

impl<C> Observed<'_, '_, C> {
    /// Records the cursor's actions since it was at a node.
    fn look<const A: usize>(&mut self, from: Node, next: Next) -> Next
    where
        C: Cursor<A>,
    {
        let (log, to, read) = (self.log, self.cursor.node(), self.log.read.take());
        if to != from {
            let back = Back { from, to, read, key: self.cursor.key(), is_asked: false };
            log.note(|seen| seen.backs.push(back));
        }
        if let Next::Child(child) = next
            && !self.cursor.is_restarting()
        {
            let slot = log.places.key(child) as u64 & (A as u64 - 1);
            let key = self.cursor.key().map(|key| key << A.trailing_zeros() | slot);
            let parent = log.places.depth(child) - 1;
            *log.named.borrow_mut() = Some((key, log.kept(&self.cursor, child, parent)));
        }
        next
    }
}

impl<const A: usize, C: Cursor<A>> Cursor<A> for Observed<'_, '_, C> {
    const RESTARTS: bool = C::RESTARTS;

    fn reset(&mut self, tree: &impl Topology<A>) {
        self.cursor.reset(tree);
    }

    fn node(&self) -> Node {
        self.cursor.node()
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        let (from, next) = (self.cursor.node(), self.cursor.choose(tree, wanted, search));
        self.look(from, next)
    }

    fn next<T: Topology<A>, S: Search<A>>(&mut self, tree: &T, search: &mut S) -> Next {
        let (from, next) = (self.cursor.node(), self.cursor.next(tree, search));
        self.look(from, next)
    }

    fn enter(&mut self, node: Node) {
        let is_restarting = self.cursor.is_restarting();
        self.cursor.enter(node);
        if is_restarting {
            self.log.visited(node, true);
        }
        let own = self.log.places.depth(node);
        let (key, levels) = (self.cursor.key(), self.log.kept(&self.cursor, node, own));
        self.log.note(|seen| (seen.key, seen.levels) = (key, levels));
    }

    fn shortened(&mut self) {
        self.cursor.shortened();
    }

    fn is_restarting(&self) -> bool {
        self.cursor.is_restarting()
    }
}

/// A search that records its answers.
struct Deciding<'l, 'p, S, const A: usize> {
    tree: &'l Tree<A>,
    search: S,
    log: &'l Log<'p>,
}

impl<'l, 'p, S: Search<A>, const A: usize> Deciding<'l, 'p, S, A> {
    fn new(tree: &'l Tree<A>, search: S, log: &'l Log<'p>) -> Self {
        log.end.set(search.end());
        Self { tree, search, log }
    }
}

impl<S: Search<A>, const A: usize> Search<A> for Deciding<'_, '_, S, A> {
    const SORTED: bool = S::SORTED;
    type Ranks = S::Ranks;

    fn ask(&mut self, node: Node) -> Wanted<S::Ranks> {
        let wanted = self.search.ask(node);
        let slots = (0..A as u32).filter(|slot| wanted.set >> slot & 1 == 1);
        let mut children: Vec<_> = slots
            .map(|slot| (self.tree.child(node, slot), if S::SORTED { wanted.ranks.rank(slot) } else { slot }))
            .collect();
        children.sort_by_key(|&(child, rank)| (!S::SORTED && !child.is_leaf(), rank));
        self.log.was_asked(node, children);
        wanted
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        let (before, flow) = (self.search.end(), self.search.leaf(leaf));
        let (end, stops) = (self.search.end(), flow == Flow::Stop);
        self.log.end.set(end);
        self.log.note(|seen| (seen.is_hit, seen.stops) = (end < before || stops, stops));
        flow
    }

    fn end(&self) -> u32 {
        self.search.end()
    }
}
