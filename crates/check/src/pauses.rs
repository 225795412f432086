//! The property body of pausing: a traversal that is paused at any step and resumed by any method continues unchanged.

use std::fmt;

use super::Case;
use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::Search;
use stackless_bvh::hash::{KeyMap, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::traverse::{ByTable, ByWalk, WithCursor};
use stackless_bvh::key::{self, KeyWord};
use stackless_bvh::oracle;
use stackless_bvh::order::{Descent, Flow, Pruned, Visitor};
use stackless_bvh::traverse::{
    KeyOnly, KeyTrail, Method, Next, Pause, Paused, States, Tables, resume, revisit, traverse_pruned,
};
use stackless_bvh::tree::{Keys, Node, Topology, Tree};

/// Methods of resuming a traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// From the stored addresses.
    Addresses,
    /// From bytes.
    Bytes,
    /// From key and trail. A walk down from the root finds the addresses.
    Walk,
    /// From key and trail, with addresses from a plain table.
    Map,
    /// From key and trail, with addresses from a perfect hash of all keys.
    Hash,
    /// In another traversal.
    Other(Method),
    /// From the key alone.
    KeyOnly,
}

/// A traversal that resumed wrongly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PauseFault {
    /// The traversal.
    pub method: Method,
    /// The method of resuming.
    pub way: Way,
    /// Number of visits before the pause.
    pub visits: usize,
    /// The next step at the pause.
    pub next: Next,
    /// A description of the fault.
    pub what: String,
}

impl fmt::Display for PauseFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, way, visits, next, what } = self;
        write!(f, "{method}, put aside after {visits} visits ({next:?} next), taken up by {way:?}: {what}")
    }
}

impl std::error::Error for PauseFault {}

/// A case, with the tables for pausing and resuming its traversals.
#[derive(Debug)]
pub struct Pauses<'c> {
    pub(super) case: &'c Case,
    pub(super) tables: Tables<'c, Tree>,
    pub(super) states: States<'c, Tree>,
    pub(super) keys: Keys,
    map: KeyMap,
    hash: Option<PerfectHash>,
}

impl<'c> Pauses<'c> {
    /// Prepares a case.
    pub fn new(case: &'c Case) -> Self {
        let all = Options { key_set: KeySet::All, sizing: Sizing::Tight };
        Self {
            case,
            tables: Tables::new(&case.tree, case.tape.axes(), &methods().collect::<Vec<_>>(), 0),
            states: States::of(&case.tree),
            keys: Keys::of(&case.tree),
            map: KeyMap::of(&case.tree),
            hash: PerfectHash::build(&case.tree, all).ok(),
        }
    }

    /// Pauses one traversal before each visit and after each leaf, and resumes it by every method. Returns the number
    /// of resumed traversals.
    ///
    /// # Errors
    /// The first fault. Returns `Ok(0)` if the traversal does not support this tree with this word.
    pub fn check<W: KeyWord>(&self, method: Method) -> Result<usize, Box<PauseFault>> {
        let (mut whole, mut search) = (Trace::default(), self.search());
        if self.tables.with_cursor::<W, _>(method, Run(&mut search, &mut whole)).is_err() {
            return Ok(0);
        }
        let mut resumes = 0;
        for visits in 0..whole.nodes().len() {
            for next in [Next::Visit, Next::Backtrack] {
                resumes += self.check_at::<W>(method, visits, next, &whole, &search)?;
            }
        }
        Ok(resumes)
    }

    pub(super) fn search(&self) -> Search<'c, Tree> {
        Search::new(&self.case.tree, &self.case.tape, self.case.any)
    }

    fn check_at<W: KeyWord>(
        &self,
        method: Method,
        visits: usize,
        next: Next,
        whole: &Trace,
        found: &Search<'_, Tree>,
    ) -> Result<usize, Box<PauseFault>> {
        let mut before = Before { trace: Trace::default(), search: self.search(), visits, next };
        let Ok(Some(paused)) = self.tables.with_cursor::<W, _>(method, PutAside(&mut before)) else {
            return Ok(0);
        };
        let fault = |way, what: String| Box::new(PauseFault { method, way, visits, next, what });
        let refused = |way| move |error: &dyn fmt::Display| fault(way, error.to_string());
        let mut resumes = 0;
        let mut go_on = |method, way, paused: &Paused<W>, exactly| {
            let mut trace = before.trace.clone();
            let mut search = before.search.clone();
            let resumed = GoOn { from: Start::State(paused.clone()), search: &mut search, trace: &mut trace };
            match self.tables.with_cursor::<W, _>(method, resumed) {
                Ok(ran) => ran.map_err(|what| fault(way, what))?,
                // Supported depths differ between traversals.
                Err(_) if way == Way::Other(method) => return Ok(()),
                Err(unfit) => return Err(refused(way)(&unfit)),
            }
            resumes += 1;
            if exactly && trace != *whole {
                return Err(fault(way, format!("visits {:?}, expected {:?}", trace.nodes(), whole.nodes())));
            }
            if search.outcome.hit != found.outcome.hit {
                let (expected, hit) = (found.outcome.hit, search.outcome.hit);
                return Err(fault(way, format!("finds {hit:?}, expected {expected:?}")));
            }
            Ok(())
        };
        self.states.check(&paused).map_err(|error| refused(Way::Addresses)(&error))?;
        go_on(method, Way::Addresses, &paused, true)?;
        let bytes = self.states.to_bytes(&paused);
        let read = self.states.from_bytes::<W>(&bytes).map_err(|error| refused(Way::Bytes)(&error))?;
        go_on(method, Way::Bytes, &read, true)?;

        // Traversals without a key have the address, from which the check finds the key.
        let slot = self.case.tree.slot(paused.node);
        if W::carries(self.keys.depth(slot), 1).is_err() {
            return Ok(resumes);
        }
        let key: W = self.keys.key(slot);
        let kept = KeyTrail { key: key.clone(), trail: paused.trail.clone(), disjoint: paused.disjoint.clone(), next };
        let walk = ByWalk(&self.case.tree);
        let located = kept.clone().locate(&walk).map_err(|error| refused(Way::Walk)(&error))?;
        go_on(method, Way::Walk, &located, true)?;
        let by_map = kept.clone().locate(&self.map).map_err(|error| refused(Way::Map)(&error))?;
        go_on(method, Way::Map, &by_map, true)?;
        if let Some(hash) = &self.hash {
            let by_hash = kept.locate(&ByTable(hash)).map_err(|error| refused(Way::Hash)(&error))?;
            go_on(method, Way::Hash, &by_hash, true)?;
        }
        for other in methods() {
            // If the second trail is lost, or begins in the middle, only the hits must be equal.
            go_on(other, Way::Other(other), &located, other.test() == method.test())?;
        }
        let from = KeyOnly::locate(key, next, &walk).map_err(|error| refused(Way::KeyOnly)(&error))?;
        self.check_key_only(method, &from, &before, found).map_err(|what| fault(Way::KeyOnly, what))?;
        Ok(resumes + 1)
    }

    /// Checks resuming from the key alone: it visits all nodes except those below earlier nodes, in the order of the
    /// climb along the keys.
    fn check_key_only<W: KeyWord>(
        &self,
        method: Method,
        from: &KeyOnly<W>,
        before: &Before<'_>,
        found: &Search<'_, Tree>,
    ) -> Result<(), String> {
        let (mut trace, mut search) = (Trace::default(), before.search.clone());
        let again = GoOn { from: Start::Key(from.clone()), search: &mut search, trace: &mut trace };
        self.tables.with_cursor::<W, _>(method, again).map_err(|unfit| unfit.to_string())??;
        if search.outcome.hit != found.outcome.hit {
            return Err(format!("finds {:?}, expected {:?}", search.outcome.hit, found.outcome.hit));
        }
        let key: W = from.key().cloned().unwrap_or_default();
        // The node itself, its sibling, its parent's sibling and so on.
        let trail = key::level_start(&key).wrapping_sub(&W::one());
        let expected = self.expected(&key, &trail, before.next, method, &mut before.search.clone())?;
        if trace == expected {
            Ok(())
        } else {
            Err(format!("visits {:?}, expected {:?}", trace.nodes(), expected.nodes()))
        }
    }

    /// Returns the oracle's visits below a node, if it is to be visited, and below all nodes that a trail postpones.
    pub(super) fn expected<W: KeyWord>(
        &self,
        key: &W,
        trail: &W,
        next: Next,
        method: Method,
        search: &mut Search<'_, Tree>,
    ) -> Result<Trace, String> {
        let mut expected = Trace::default();
        let mut subtrees = if next == Next::Visit { vec![key.clone()] } else { Vec::new() };
        let (mut key, mut trail) = (key.clone(), trail.clone());
        while key::depth(&key) > 0 {
            if trail.low_bits() & 1 == 1 {
                subtrees.push(key::sibling(key.clone()));
            }
            (key, trail) = (key::parent(key), trail.shr1());
        }
        for subtree in subtrees {
            let node = Keys::walk(&self.case.tree, &subtree).ok_or("no such node")?;
            let pruning = method.test().pruning();
            if oracle::traverse_pruned(&self.case.tree, node, pruning, search, &mut expected) == Flow::Stop {
                break;
            }
        }
        Ok(expected)
    }
}

/// Returns the traversals that can be paused.
pub(super) fn methods() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|method| method.can_pause())
}

/// Runs a traversal to its end.
struct Run<'a, 'c>(&'a mut Search<'c, Tree>, &'a mut Trace);

impl<W> WithCursor<W> for Run<'_, '_> {
    type Output = ();

    fn call(self, cursor: impl Pause<Word = W>) {
        traverse_pruned(cursor, self.0, self.1);
    }
}

/// A traversal up to its pause.
struct Before<'c> {
    trace: Trace,
    search: Search<'c, Tree>,
    visits: usize,
    next: Next,
}

/// Pauses before visit number `visits`, counted from 0, or after it if it is a leaf.
struct PutAside<'a, 'c>(&'a mut Before<'c>);

impl<W: KeyWord> WithCursor<W> for PutAside<'_, '_> {
    type Output = Option<Paused<W>>;

    fn call(self, mut cursor: impl Pause<Word = W>) -> Option<Paused<W>> {
        let Before { trace, search, visits, next } = self.0;
        let mut recorder = Until { trace, visits: *visits };
        let stopped = traverse_pruned(&mut cursor, search, &mut recorder)?;
        if *next == Next::Visit {
            return Some(cursor.put_aside(stopped));
        }
        if !cursor.node().is_leaf() {
            return None;
        }
        recorder.visits += 1;
        let mut visitor = StopAtLeaf { search, flow: Flow::Continue };
        let stopped = traverse_pruned(&mut cursor, &mut visitor, &mut recorder)?;
        // A search that has ended is not paused.
        (visitor.flow == Flow::Continue).then(|| cursor.put_aside(stopped))
    }
}

/// Records visits, and stops after a given number.
struct Until<'a> {
    trace: &'a mut Trace,
    visits: usize,
}

impl Recorder for Until<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        if self.trace.nodes().len() == self.visits { Flow::Stop } else { self.trace.visit(node, state) }
    }
}

/// Stops at a leaf, and stores the answer of the search there.
struct StopAtLeaf<'a, 'c> {
    search: &'a mut Search<'c, Tree>,
    flow: Flow,
}

impl Visitor for StopAtLeaf<'_, '_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.flow = Visitor::leaf(self.search, node);
        Flow::Stop
    }
}

impl Pruned for StopAtLeaf<'_, '_> {
    fn found_at(&self, leaf: Node) -> bool {
        self.search.found_at(leaf)
    }
}

/// Resumes a paused traversal.
#[derive(Debug)]
pub struct GoOn<'a, 'c, W> {
    /// The state to resume from.
    pub from: Start<W>,
    /// The search, with its hits so far.
    pub search: &'a mut Search<'c, Tree>,
    /// Receives the visits.
    pub trace: &'a mut Trace,
}

/// The stored part of a paused traversal.
#[derive(Debug)]
pub enum Start<W> {
    /// Its state.
    State(Paused<W>),
    /// The key of its node.
    Key(KeyOnly<W>),
}

impl<W: KeyWord> WithCursor<W> for GoOn<'_, '_, W> {
    type Output = Result<(), String>;

    fn call(self, cursor: impl Pause<Word = W>) -> Result<(), String> {
        let ran = match self.from {
            Start::State(paused) => resume(cursor, paused, self.search, self.trace),
            Start::Key(key) => revisit(cursor, key, self.search, self.trace),
        };
        ran.map(|_| ()).map_err(|error| error.to_string())
    }
}
