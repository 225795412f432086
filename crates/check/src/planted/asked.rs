//! Searches that are asked in a wrong way.

use stackless_bvh::generate::Search;
use stackless_bvh::order::{Descent, Flow, Pruned, Visitor};
use stackless_bvh::tree::{Node, Topology, Tree};

/// A search asked in a wrong way.
pub(super) struct Misasked<'a, 't> {
    pub(super) tree: &'a Tree,
    pub(super) search: &'a mut Search<'t, Tree>,
    pub(super) how: Misuse,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Misuse {
    /// A closest-hit search ends at its first hit.
    EndsAtFirstHit,
    /// An any-hit search goes on.
    NeverEnds,
    /// The first leaf is visited, and not looked into.
    FirstLeafUnseen,
    /// The decision at an inner node is asked for twice.
    AsksTwice,
    /// A leaf is looked into twice.
    LooksTwice,
    /// *Found* is said wherever the best hit is, also beyond its leaf's end.
    FoundBeyondEnd,
}

impl Visitor for Misasked<'_, '_> {
    fn inner(&mut self, node: Node) -> Descent {
        if self.how == Misuse::AsksTwice {
            self.search.inner(node);
        }
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let before = self.search.outcome.hit;
        if self.how == Misuse::LooksTwice {
            Visitor::leaf(self.search, node);
        }
        if self.how == Misuse::FirstLeafUnseen && self.search.outcome.leaf_visits == 0 {
            self.search.outcome.leaf_visits += 1;
            return Flow::Continue;
        }
        let flow = Visitor::leaf(self.search, node);
        match self.how {
            Misuse::EndsAtFirstHit if self.search.outcome.hit != before => Flow::Stop,
            Misuse::NeverEnds => Flow::Continue,
            _ => flow,
        }
    }
}

impl Pruned for Misasked<'_, '_> {
    fn inner_marked(&mut self, node: Node) -> Descent {
        self.search.inner_marked(node)
    }

    fn found_at(&self, leaf: Node) -> bool {
        match self.how {
            Misuse::FoundBeyondEnd => self.search.outcome.hit.is_some_and(|(_, slot)| slot == self.tree.slot(leaf)),
            _ => self.search.found_at(leaf),
        }
    }
}
