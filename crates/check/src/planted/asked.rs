//! Searches that are asked in a wrong way.

use crate::Case;
use stackless_bvh::generate::Search;
use stackless_bvh::order::{Descent, Flow, Pruned, Visitor};
use stackless_bvh::tree::{Node, Topology, Tree};

/// A search asked in a wrong way.
pub(super) struct Misasked<'a, 't> {
    pub(super) case: &'a Case,
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
    /// Intervals that touch are marked as disjoint.
    TouchingMarked,
    /// The far child comes first, and children are marked as if the near one did.
    FarFirstMarked,
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
        let descent = self.search.inner_marked(node);
        let Case { tree, tape, .. } = self.case;
        let [near, far] = [descent.first(), descent.first().other()].map(|side| tree.child(node, side));
        let starts = tape.cells()[tree.slot(far)].enter;
        match (self.how, tape.cells()[tree.slot(near)].exit) {
            (Misuse::TouchingMarked, exit) => descent.disjoint_if(exit.is_some_and(|exit| exit <= starts)),
            (Misuse::FarFirstMarked, exit) if descent.postpones() => {
                Descent::both(descent.first().other()).disjoint_if(exit.is_some_and(|exit| exit < starts))
            }
            _ => descent,
        }
    }

    fn found_at(&self, leaf: Node) -> bool {
        match self.how {
            Misuse::FoundBeyondEnd => {
                self.search.outcome.hit.is_some_and(|(_, slot)| slot == self.case.tree.slot(leaf))
            }
            _ => self.search.found_at(leaf),
        }
    }
}
