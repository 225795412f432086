//! Checks a traversal's state at every visit.

use std::fmt;

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Descent, Flow};
use stackless_bvh::trail::levels;
use stackless_bvh::tree::{Keys, Node, Parents, Topology, Tree};

/// Differences between a traversal and its oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A visit goes to another node than the oracle's visit.
    Node {
        /// Number of the visit, from 0.
        visit: usize,
        /// The oracle's node; `None` if the oracle has ended.
        expected: Option<Node>,
        /// The traversal's node.
        found: Node,
    },
    /// The traversal ends before the oracle.
    Early {
        /// Number of visits made.
        visits: usize,
        /// Number of the oracle's visits.
        expected: usize,
    },
    /// The traversal reports a restart at a node that it has not visited.
    Restart {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// The key is not the key of the addressed node.
    Key {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// The search decides differently.
    Decision {
        /// Number of the visit.
        visit: usize,
        /// The decision in the oracle; `None` at a leaf.
        expected: Option<Descent>,
        /// The decision in the traversal.
        found: Option<Descent>,
    },
    /// The trail has bits at or above the depth of the node, or the counter does not start at the node's level. Or, if
    /// the postponed nodes are known, trail or counter do not describe exactly those nodes.
    Trail {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// The register does not address the next node.
    Register {
        /// Number of the visit.
        visit: usize,
        /// The address in the register.
        found: Node,
    },
    /// The table lacks a key that was looked up, or has another node for it.
    Miss {
        /// Number of such lookups.
        lookups: usize,
    },
    /// The pruning oracle visits a node that the plain oracle does not visit.
    Unpruned {
        /// The node.
        node: Node,
    },
    /// The traversal makes more visits than any tree of this size needs.
    Endless {
        /// Number of visits.
        visits: u64,
    },
    /// The hit differs.
    Hit {
        /// Distance and slot of the oracle's hit.
        expected: Option<(u32, usize)>,
        /// Distance and slot of the traversal's.
        found: Option<(u32, usize)>,
    },
    /// The nodes are equal, but the number of calls of the visitor differs.
    Visits {
        /// Inner visits and leaf visits of the oracle.
        expected: (u64, u64),
        /// Inner visits and leaf visits of the traversal.
        found: (u64, u64),
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node { visit, expected: Some(expected), found } => {
                write!(f, "visit {visit} is {found:?}, the oracle's is {expected:?}")
            }
            Self::Node { visit, expected: None, found } => {
                write!(f, "visit {visit} is {found:?}, the oracle has ended")
            }
            Self::Early { visits, expected } => write!(f, "ends after {visits} visits, the oracle makes {expected}"),
            Self::Restart { visit, node } => {
                write!(f, "after visit {visit} it restarts through {node:?}, where it has not been")
            }
            Self::Key { visit, node } => write!(f, "visit {visit}: the key is not that of {node:?}"),
            Self::Decision { visit, expected, found } => {
                write!(f, "visit {visit} is followed by {found:?}, the oracle's by {expected:?}")
            }
            Self::Trail { visit, node } => {
                write!(f, "visit {visit}: trail or counter do not fit the depth of {node:?}")
            }
            Self::Register { visit, found } => {
                write!(f, "visit {visit}: the register holds {found:?}, which does not come next")
            }
            Self::Miss { lookups } => write!(f, "{lookups} lookups in the perfect hash missed"),
            Self::Unpruned { node } => write!(f, "with pruning {node:?} is visited, without it is not"),
            Self::Endless { visits } => write!(f, "no end after {visits} visits"),
            Self::Hit { expected, found } => write!(f, "found {found:?} (distance, leaf), the oracle {expected:?}"),
            Self::Visits { expected, found } => {
                write!(f, "asked about {found:?} inner nodes and leaves, the oracle about {expected:?}")
            }
        }
    }
}

impl std::error::Error for Fault {}

/// A visit of an oracle, with all data known about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visit {
    /// The node.
    pub node: Node,
    /// The decision of the search at an inner node.
    pub descent: Option<Descent>,
    /// The postponed nodes. The last one is visited next.
    pub postponed: Vec<Node>,
}

/// The reference for comparing visits.
#[derive(Clone, Copy, Debug)]
pub enum Expected<'a> {
    /// None: only invariants of every state are checked.
    Nothing,
    /// The nodes of the oracle's visits.
    Nodes(&'a [Node]),
    /// The oracle's visits, with decisions, trails and registers. `[TRAIL-1]` `[TRAIL-6]` `[REGISTER-1]`
    Visits(&'a [Visit]),
}

impl<'a> Expected<'a> {
    /// Returns the number of visits, if known.
    fn count(self) -> Option<usize> {
        match self {
            Self::Nothing => None,
            Self::Nodes(nodes) => Some(nodes.len()),
            Self::Visits(visits) => Some(visits.len()),
        }
    }

    fn visit(self, visit: usize) -> Option<&'a Visit> {
        if let Self::Visits(visits) = self { visits.get(visit) } else { None }
    }
}

/// Compares each visit with the oracle's, and checks the invariants of the state. `[CONF-1]`
///
/// It records a running traversal, or receives a recorded one.
#[derive(Debug)]
pub struct Watch<'a> {
    tree: &'a Tree,
    keys: &'a Keys,
    parents: &'a Parents,
    expected: Expected<'a>,
    visits: usize,
    steps: u64,
    step_limit: u64,
    fault: Option<Fault>,
    /// By slot: whether a node has been visited. Only for traversals that restart.
    seen: Vec<bool>,
}

impl<'a> Watch<'a> {
    /// Compares at most a given number of visits. `restarts` permits repeated visits of a node.
    pub fn new(
        tree: &'a Tree,
        keys: &'a Keys,
        parents: &'a Parents,
        expected: Expected<'a>,
        step_limit: u64,
        restarts: bool,
    ) -> Self {
        let seen = if restarts { vec![false; tree.node_count()] } else { Vec::new() };
        Self { tree, keys, parents, expected, visits: 0, steps: 0, step_limit, fault: None, seen }
    }

    /// Returns the number of visits, restarts included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Receives the search's decision at the last visit. Used if the oracle's decisions are known.
    pub fn decided(&mut self, found: Option<Descent>) {
        if let Some(visit) = self.visits.checked_sub(1)
            && let Some(expected) = self.expected.visit(visit).map(|visit| visit.descent)
            && expected != found
        {
            self.fault.get_or_insert(Fault::Decision { visit, expected, found });
        }
    }

    /// Returns the number of visits, restarts included.
    ///
    /// # Errors
    /// The first fault.
    pub fn finish(self) -> Result<u64, Fault> {
        match (self.fault, self.expected.count()) {
            (Some(fault), _) => Err(fault),
            (None, Some(expected)) if self.visits < expected => Err(Fault::Early { visits: self.visits, expected }),
            _ => Ok(self.steps),
        }
    }

    /// Compiled for each traversal, so checks that never apply to its states are removed.
    #[inline(always)]
    fn look<W: KeyWord>(&mut self, state: &State<W>) -> Result<(), Fault> {
        let &State { node, ref key, ref trail, ref counter, ref disjoint, register, is_restarting } = state;
        let visit = self.visits;
        let slot = self.tree.slot(node);
        let seen = self.seen.get_mut(slot).is_some_and(|seen| std::mem::replace(seen, true));
        if is_restarting && !seen {
            return Err(Fault::Restart { visit, node });
        }
        let expected = match self.expected {
            Expected::Nothing => None,
            Expected::Nodes(nodes) => Some(nodes.get(visit).copied()),
            Expected::Visits(visits) => Some(visits.get(visit).map(|visit| visit.node)),
        };
        if let Some(expected) = expected.filter(|_| !is_restarting) {
            if expected != Some(node) {
                return Err(Fault::Node { visit, expected, found: node });
            }
            self.visits += 1;
        }
        if key.as_ref().is_some_and(|key| !self.keys.is(slot, key)) {
            return Err(Fault::Key { visit, node });
        }
        let depth = self.keys.depth(slot);
        if trail.as_ref().is_some_and(|trail| trail.bit_length() > depth)
            || disjoint.as_ref().is_some_and(|disjoint| disjoint.bit_length() > depth)
            || counter.as_ref().is_some_and(|counter| counter.bit_length() != depth + 1)
        {
            return Err(Fault::Trail { visit, node });
        }
        let known = self.expected.visit(visit).filter(|_| !is_restarting);
        if let Some(Visit { postponed, .. }) = known
            && [(trail.as_ref(), true), (counter.as_ref(), false)]
                .into_iter()
                .any(|(word, one)| word.is_some_and(|word| !self.names(postponed, word.clone(), node, one)))
        {
            return Err(Fault::Trail { visit, node });
        }
        let is_next = |found: Node| match (known, trail) {
            (Some(visit), _) => visit.postponed.last() == Some(&found),
            (None, Some(trail)) => !trail.is_zero() && self.comes_next(found, node, levels(trail)),
            (None, None) => true,
        };
        match register.filter(|&found| !is_next(found)) {
            Some(found) => Err(Fault::Register { visit, found }),
            None => Ok(()),
        }
    }

    /// Returns whether the lower bits of a word, one per level, equal `one` exactly where the sibling on the path to
    /// the root is postponed.
    fn names<W: KeyWord>(&self, postponed: &[Node], mut word: W, mut node: Node, one: bool) -> bool {
        while node != self.tree.root() {
            let [parent, sibling] = self.parents.row(self.tree, node);
            if (postponed.contains(&sibling) == one) != (word.low_bits() & 1 == 1) {
                return false;
            }
            (word, node) = (word.shr1(), parent);
        }
        true
    }

    /// Returns whether `next` is the sibling of the ancestor `levels` above `node`.
    fn comes_next(&self, next: Node, node: Node, levels: u32) -> bool {
        // Checking every long climb would take quadratic time in a very deep tree. One in 512 visits is checked.
        if levels > 1000 && !self.visits.is_multiple_of(512) {
            return true;
        }
        let ancestor = (0..levels).fold(node, |node, _| self.parents.row(self.tree, node)[0]);
        self.parents.row(self.tree, ancestor)[1] == next
    }
}

impl Recorder for Watch<'_> {
    #[inline]
    fn visit<W: KeyWord>(&mut self, _: Node, state: impl FnOnce() -> State<W>) -> Flow {
        self.steps += 1;
        if self.fault.is_some() {
            return Flow::Stop;
        }
        let is_endless = self.steps > self.step_limit;
        let looked = if is_endless { Err(Fault::Endless { visits: self.steps }) } else { self.look(&state()) };
        // Faults are rare and this runs at every visit, so it writes only in case of a fault.
        if let Err(fault) = looked {
            self.fault = Some(fault);
            return Flow::Stop;
        }
        Flow::Continue
    }
}
