//! Looks at a traversal's state at every visit.

use std::fmt;

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Descent, Flow};
use stackless_bvh::trail::levels;
use stackless_bvh::tree::{Keys, Node, Parents, Topology, Tree};

/// How a traversal differs from its oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A visit goes to another node than the oracle's.
    Node {
        /// Number of the visit, from 0.
        visit: usize,
        /// Where the oracle goes; `None` if it has ended.
        expected: Option<Node>,
        /// Where the traversal goes.
        found: Node,
    },
    /// It ended before the oracle did.
    Early {
        /// Number of visits that were made.
        visits: usize,
        /// Number of visits that the oracle makes.
        expected: usize,
    },
    /// It calls a visit a restart where it has not been before.
    Restart {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// Its key is not the key of the node that it addresses.
    Key {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// The search decided otherwise.
    Decision {
        /// Number of the visit.
        visit: usize,
        /// What the oracle was told; `None` at a leaf.
        expected: Option<Descent>,
        /// What the traversal was told.
        found: Option<Descent>,
    },
    /// Its trail has bits at or above the depth of the node, or its counter does not start at the node's level; or,
    /// where it is known what is postponed, they do not name just that.
    Trail {
        /// Number of the visit.
        visit: usize,
        /// The node.
        node: Node,
    },
    /// Its register does not address the node that comes next.
    Register {
        /// Number of the visit.
        visit: usize,
        /// What the register holds.
        found: Node,
    },
    /// Its table did not have a key that it looked up, or had another node for it.
    Miss {
        /// Number of such lookups.
        lookups: usize,
    },
    /// Its oracle, which leaves nodes out, visits one that the plain oracle does not.
    Unpruned {
        /// The node.
        node: Node,
    },
    /// It makes more visits than any tree of this size needs.
    Endless {
        /// Number of visits.
        visits: u64,
    },
    /// It found another hit.
    Hit {
        /// Distance and slot of the oracle's hit.
        expected: Option<(u32, usize)>,
        /// Distance and slot of the traversal's.
        found: Option<(u32, usize)>,
    },
    /// It visited the same nodes, and asked the visitor another number of times.
    Visits {
        /// Inner visits and leaf visits of the oracle.
        expected: (u64, u64),
        /// Those of the traversal.
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

/// A visit of an oracle, with all that is known of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visit {
    /// The node.
    pub node: Node,
    /// What the search decides at an inner node.
    pub descent: Option<Descent>,
    /// The postponed nodes, the last one of which comes next.
    pub postponed: Vec<Node>,
}

/// What visits are compared with.
#[derive(Clone, Copy, Debug)]
pub enum Expected<'a> {
    /// Nothing: only what must hold of every state is looked at.
    Nothing,
    /// The nodes of the oracle's visits.
    Nodes(&'a [Node]),
    /// The oracle's visits: decisions, trails and registers have to be theirs. `[TRAIL-1]` `[TRAIL-6]` `[REGISTER-1]`
    Visits(&'a [Visit]),
}

impl<'a> Expected<'a> {
    /// Number of visits, where they are known.
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

/// The comparer: holds each visit to the oracle's, and the state to what must be true of it. `[CONF-1]`
///
/// It records a traversal as it runs, or is shown what was recorded of one.
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
    /// Compares at most so many visits; `restarts` says whether nodes may be passed again.
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

    /// Visits made, restarts included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// What the search has decided at the visit that was seen last; looked at where the oracle's decisions are known.
    pub fn decided(&mut self, found: Option<Descent>) {
        if let Some(visit) = self.visits.checked_sub(1)
            && let Some(expected) = self.expected.visit(visit).map(|visit| visit.descent)
            && expected != found
        {
            self.fault.get_or_insert(Fault::Decision { visit, expected, found });
        }
    }

    /// Number of visits, restarts included.
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

    /// It is compiled into each traversal: what its states never have is not asked for.
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

    /// Whether the bits of a word, as many as the node is deep, are `one` where the sibling on the way up is postponed.
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

    /// Whether `next` is the sibling of the ancestor `levels` above `node`.
    fn comes_next(&self, next: Node, node: Node, levels: u32) -> bool {
        // A climb that would make the check of a very deep tree quadratic is made at one visit of many.
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
        // Written only where there is one: that is never, and this is called at every visit.
        if let Err(fault) = looked {
            self.fault = Some(fault);
            return Flow::Stop;
        }
        Flow::Continue
    }
}
