//! The traversal by pending sets, as one would write it from the clauses, with a mistake.

use super::links::Records;
use super::{Bug, sorted};
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Cursor, Kept, Link, Next, RankedChild, Search, Topology, Wanted};

/// Times that a search is asked again, which a mistake could make endless.
const ASKS: u32 = 10_000;

/// A node, its pending children, and the two that come next.
#[derive(Debug)]
pub(super) struct Pending<'t, const A: usize, K, L> {
    tree: &'t Records<'t, A>,
    node: Node,
    set: u32,
    nexts: [RankedChild; 2],
    slot: u32,
    kept: K,
    link: L,
    /// Times that the search was asked again.
    asks: u32,
    bug: Bug,
}

impl<'t, const A: usize, K: Kept<A>, L: Link<A>> Pending<'t, A, K, L> {
    pub(super) fn new(tree: &'t Records<'t, A>, kept: K, link: L) -> Self {
        let (node, nexts) = (tree.root(), [RankedChild::NONE; 2]);
        let mut cursor = Self { tree, node, set: 0, nexts, slot: 0, kept, link, asks: 0, bug: tree.bug };
        cursor.reset(tree);
        cursor
    }

    /// The child that comes first; keeps the two after it.
    fn sort<S: Search<A>>(&mut self, wanted: Wanted<S::Ranks>) -> RankedChild {
        let mut ranks = sorted::<A, S>(wanted);
        match self.bug {
            Bug::OrderOfSlots => ranks.sort_unstable_by_key(|rank| rank & (A as u32 - 1)),
            Bug::GreatestFirst => ranks.reverse(),
            Bug::FirstTwoExchanged if ranks.len() > 1 => ranks.swap(0, 1),
            _ => {}
        }
        let child = |rank: u32| self.tree.child(self.node, rank & (A as u32 - 1));
        let ranked = |i: usize| ranks.get(i).map_or(RankedChild::NONE, |&rank| RankedChild::new(rank, child(rank)));
        let [first, second, third] = [0, 1, 2].map(ranked);
        self.nexts = match self.bug {
            Bug::SecondThirdExchanged if ranks.len() > 2 => [third, second],
            Bug::ThirdForSecond if ranks.len() > 2 => [third, RankedChild::NONE],
            Bug::SecondTwice => [second, second],
            Bug::FirstForSecond if ranks.len() > 1 => [first, third],
            Bug::ChildOfFirstKept if ranks.len() > 1 => [RankedChild::new(second.rank(), first.child()), third],
            Bug::ChildOfSecondKept if ranks.len() > 2 => [second, RankedChild::new(third.rank(), second.child())],
            _ => [second, third],
        };
        first
    }

    /// By its slot, as if its address were not kept: so a wrong ancestor is seen.
    fn take(&mut self, ranked: RankedChild) -> Node {
        let child = self.take_slot(ranked.rank() & (A as u32 - 1));
        match self.bug {
            Bug::ChildOfFirstKept | Bug::ChildOfSecondKept => ranked.child(),
            _ => child,
        }
    }

    fn take_slot(&mut self, slot: u32) -> Node {
        self.slot = slot & (A as u32 - 1);
        if self.bug != Bug::TakenStaysPending {
            self.set &= !(1 << self.slot);
        }
        self.tree.child(self.node, self.slot)
    }

    fn is_beyond(&self, rank: u32, end: u32) -> bool {
        let begin = rank & !(A as u32 - 1);
        match self.bug {
            Bug::EqualIsBeyond => begin >= end,
            Bug::RankNotCleared => rank > end,
            Bug::NotCompared => false,
            _ => begin > end,
        }
    }
}

impl<const A: usize, K: Kept<A>, L: Link<A>> Cursor<A> for Pending<'_, A, K, L> {
    fn reset(&mut self, _: &impl Topology<A>) {
        (self.node, self.set) = (self.tree.root(), u32::MAX);
        self.kept.clear();
        self.link.clear();
    }

    fn node(&self) -> Node {
        self.node
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        let masked = if self.bug == Bug::AnswerNotMasked { u32::MAX } else { self.set };
        self.set = wanted.set & masked;
        if S::SORTED && self.set != 0 {
            let first = self.sort::<S>(Wanted { set: self.set, ..wanted });
            return Next::Child(self.take(first));
        }
        self.next(tree, search)
    }

    fn next<T: Topology<A>, S: Search<A>>(&mut self, _: &T, search: &mut S) -> Next {
        loop {
            if self.set == 0 {
                let Some(level) = self.kept.pop(search.end()) else { return Next::End };
                if self.bug != Bug::NodeLeftBehind {
                    self.node = self.link.ancestor(self.tree, self.node, level.up);
                }
                (self.set, self.nexts) = (level.pending, level.nexts);
            }
            let lowest = self.set.trailing_zeros();
            if !S::SORTED {
                let last = self.set.checked_ilog2().unwrap_or(0);
                return Next::Child(self.take_slot(if self.bug == Bug::LastSlotFirst { last } else { lowest }));
            }
            let [next, after] = self.nexts;
            if next != RankedChild::NONE {
                if !self.is_beyond(next.rank(), search.end()) {
                    if self.bug != Bug::RanksNotMoved {
                        self.nexts = [after, RankedChild::NONE];
                    }
                    return Next::Child(self.take(next));
                }
                self.set = 0;
            } else if self.set.is_power_of_two() && !self.kept.is_stale()
                || self.bug == Bug::NeverAskedAgain && self.set != 0
            {
                return Next::Child(self.take_slot(lowest));
            } else {
                self.kept.asked();
                self.asks += 1;
                return if self.asks > ASKS { Next::End } else { Next::Ask };
            }
        }
    }

    fn enter(&mut self, node: Node) {
        let entered = u32::from(self.bug == Bug::EnteredStaysPending) << self.slot;
        self.kept.push(self.set | entered, self.nexts);
        self.link.enter(self.slot);
        (self.node, self.set) = (node, u32::MAX);
    }

    fn shortened(&mut self) {
        self.kept.shortened();
    }
}
