//! Distances of backtracks, and sources of addresses (Binder & Keller 2016, Fig. 3).

use alloc::vec::Vec;

use crate::event::{Recorder, State};
use crate::key::{self, KeyWord};
use crate::order::Flow;
use crate::trail;
use crate::tree::{Node, Reach};

/// The source of the next node's address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The register, set when the node was postponed.
    Register,
    /// The uncle in a record.
    Uncle,
    /// The grand uncle in a record.
    GrandUncle,
    /// The grand grand uncle in a leaf's record.
    Leaf,
    /// The hash table.
    Hash,
}

impl Source {
    /// All sources.
    pub const ALL: [Self; 5] = [Self::Register, Self::Uncle, Self::GrandUncle, Self::Leaf, Self::Hash];

    /// Returns the name in tables and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Register => "register",
            Self::Uncle => "uncle",
            Self::GrandUncle => "grand_uncle",
            Self::Leaf => "leaf",
            Self::Hash => "hash",
        }
    }

    /// Returns the source in a record for the lowest pending bit of a trail within its reach.
    fn in_record(trail: u32, mask: u32) -> Option<Self> {
        match (trail & mask).trailing_zeros() {
            1 => Some(Self::Uncle),
            2 => Some(Self::GrandUncle),
            3 => Some(Self::Leaf),
            _ => None,
        }
    }
}

/// Counts backtracks by distance and by source. It observes a traversal with key and trail, and simulates the register
/// of Algorithm 1 for any reach of the records.
#[derive(Clone, Debug)]
pub struct Backtracks {
    reach: Reach,
    /// By levels between the previous node and the ancestor whose sibling comes next.
    distances: Vec<u64>,
    /// By [`Source`].
    sources: [u64; Source::ALL.len()],
    /// The register: the source of its address.
    register: Option<Source>,
    last: Option<Last>,
}

/// The previous visit.
#[derive(Clone, Copy, Debug)]
struct Last {
    depth: u32,
    is_leaf: bool,
    /// Low bits of the trail, and its trailing zeros.
    trail: u32,
    zeros: u32,
}

impl Backtracks {
    /// Creates counters for records of this reach.
    pub fn new(reach: Reach) -> Self {
        Self { reach, distances: Vec::new(), sources: [0; Source::ALL.len()], register: None, last: None }
    }

    /// Resets the position and keeps the counts: call it before each traversal.
    pub fn begin(&mut self) {
        self.last = None;
        self.register = None;
    }

    /// Returns the number of backtracks over each distance, in levels; 0 goes to the sibling.
    pub fn distances(&self) -> &[u64] {
        &self.distances
    }

    /// Returns the number of backtracks served by a source.
    pub fn by(&self, source: Source) -> u64 {
        self.sources[source as usize]
    }

    /// Returns the number of backtracks.
    pub fn total(&self) -> u64 {
        self.sources.iter().sum()
    }

    /// Returns the sum with other counts.
    #[must_use]
    pub fn merge(mut self, other: &Self) -> Self {
        self.distances.resize(self.distances.len().max(other.distances.len()), 0);
        for (mine, theirs) in self.distances.iter_mut().zip(&other.distances) {
            *mine += theirs;
        }
        for (mine, theirs) in self.sources.iter_mut().zip(other.sources) {
            *mine += theirs;
        }
        self
    }

    fn count(&mut self, last: Last) {
        let source = self.register.take().unwrap_or(Source::Hash);
        self.sources[source as usize] += 1;
        let distance = last.zeros as usize;
        self.distances.resize(self.distances.len().max(distance + 1), 0);
        self.distances[distance] += 1;
    }
}

impl Recorder for Backtracks {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let State { key: Some(key), trail: Some(trail), .. } = state() else { return Flow::Continue };
        let zeros = if trail.is_zero() { 0 } else { trail::levels(&trail) };
        let now = Last { depth: key::depth(&key), is_leaf: node.is_leaf(), trail: trail.low_bits(), zeros };
        if let Some(last) = self.last.replace(now) {
            let mask = self.reach.mask(last.is_leaf);
            self.register = self.register.or_else(|| Source::in_record(last.trail, mask));
            if now.depth <= last.depth {
                self.count(last);
            } else if now.trail & 1 == 1 {
                self.register = Some(Source::Register);
            }
        }
        Flow::Continue
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Family, Kind, Rng, Search, Tape};
    use crate::hash::{KeySet, Options, PerfectHash, Sizing, Verified};
    use crate::traverse::{Hashed, traverse};
    use crate::tree::{Keys, Linked, Topology};

    #[test]
    fn what_is_said_to_come_from_the_table_was_looked_up() {
        /// Compares the simulated register with the register of the traversal at each visit.
        struct Compare(Backtracks, u64);
        impl Recorder for Compare {
            fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
                // The traversal fills the register as late as possible, the printed algorithm as early as possible.
                let state = state();
                let held = state.register;
                let flow = self.0.visit(node, || state);
                assert!(self.0.register.is_some() || held.is_none());
                self.1 += 1;
                flow
            }
        }
        let mut rng = Rng::new(4);
        let mut visits = 0;
        for kind in Kind::ALL {
            for family in Family::ALL {
                let tree = family.tree(&mut rng, 60);
                let tape = Tape::draw(&mut rng, &tree, kind);
                let (uncles, keys) = (Linked::<_, 2, 3>::reaching(&tree), Keys::of(&tree));
                let options = Options { key_set: KeySet::Exact(Reach::SECTION_2_1), sizing: Sizing::Tight };
                let hash = PerfectHash::build(&tree, options).unwrap();
                let hash = Verified::new(&hash, &tree, &keys);
                let cursor = Hashed::<u64, _, _>::new(&uncles, &hash).unwrap();
                let mut compare = Compare(Backtracks::new(Reach::SECTION_2_1), 0);
                traverse(cursor, &mut Search::new(&tree, &tape, false), &mut compare);
                assert_eq!(compare.0.total(), compare.0.distances().iter().sum::<u64>());
                assert!(compare.0.total() < tree.node_count() as u64);
                assert_eq!((compare.0.by(Source::Hash), hash.misses()), (hash.lookups() as u64, 0));
                visits += compare.1;
            }
        }
        assert!(visits > 1000, "{visits}");
    }
}
