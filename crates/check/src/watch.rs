//! Looks at a traversal's state at every visit.

use std::fmt;

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Flow;
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
    /// Its trail has bits at or above the depth of the node, or its counter does not start at the node's level.
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

/// Compares each visit with the oracle's, and the state with what must hold of it.
#[derive(Debug)]
pub struct Watch<'a> {
    tree: &'a Tree,
    keys: &'a Keys,
    parents: &'a Parents,
    /// The oracle's visits; `None` where only the state is looked at.
    expected: Option<&'a [Node]>,
    visits: usize,
    steps: u64,
    step_limit: u64,
    fault: Option<Fault>,
    /// By slot: whether a node has been visited. Only for traversals that restart.
    seen: Vec<bool>,
}

impl<'a> Watch<'a> {
    pub(super) fn new(
        tree: &'a Tree,
        keys: &'a Keys,
        parents: &'a Parents,
        expected: Option<&'a [Node]>,
        step_limit: u64,
        restarts: bool,
    ) -> Self {
        Self {
            tree,
            keys,
            parents,
            expected,
            visits: 0,
            steps: 0,
            step_limit,
            fault: None,
            seen: if restarts { vec![false; tree.node_count()] } else { Vec::new() },
        }
    }

    /// Visits made, restarts included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    pub(super) fn finish(self) -> Result<u64, Fault> {
        match (self.fault, self.expected) {
            (Some(fault), _) => Err(fault),
            (None, Some(expected)) if self.visits < expected.len() => {
                Err(Fault::Early { visits: self.visits, expected: expected.len() })
            }
            _ => Ok(self.steps),
        }
    }

    fn look<W: KeyWord>(&mut self, state: State<W>) -> Result<(), Fault> {
        let State { node, key, trail, counter, disjoint, register, is_restarting } = state;
        let visit = self.visits;
        let slot = self.tree.slot(node);
        let seen = self.seen.get_mut(slot).is_some_and(|seen| std::mem::replace(seen, true));
        if is_restarting && !seen {
            return Err(Fault::Restart { visit, node });
        }
        if let Some(expected) = self.expected
            && !is_restarting
        {
            let expected = expected.get(visit).copied();
            if expected != Some(node) {
                return Err(Fault::Node { visit, expected, found: node });
            }
            self.visits += 1;
        }
        if key.is_some_and(|key| !self.keys.is(slot, &key)) {
            return Err(Fault::Key { visit, node });
        }
        let depth = self.keys.depth(slot);
        if trail.as_ref().is_some_and(|trail| trail.bit_length() > depth)
            || disjoint.is_some_and(|disjoint| disjoint.bit_length() > depth)
            || counter.is_some_and(|counter| counter.bit_length() != depth + 1)
        {
            return Err(Fault::Trail { visit, node });
        }
        match (register, trail) {
            (Some(found), Some(trail)) if trail.is_zero() || !self.comes_next(found, node, levels(&trail)) => {
                Err(Fault::Register { visit, found })
            }
            _ => Ok(()),
        }
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
    fn visit<W: KeyWord>(&mut self, _: Node, state: impl FnOnce() -> State<W>) -> Flow {
        self.steps += 1;
        let looked =
            if self.steps > self.step_limit { Err(Fault::Endless { visits: self.steps }) } else { self.look(state()) };
        match looked {
            Ok(()) => Flow::Continue,
            Err(fault) => {
                self.fault = Some(fault);
                Flow::Stop
            }
        }
    }
}
