//! The stackless traversal: a pending set for each level.

use super::links::Link;
use super::pending_store::{PendingStore, StateView};
use super::search::{RankedChild, Ranks, Search, Wanted, is_beyond};
use super::tree::Topology;
use super::{Cursor, Next};
use crate::key::TooDeep;
use crate::tree::Node;

/// A node, its pending children, the [`PendingStore`] of the levels above, and a [`Link`] to the ancestors.
/// `[WTRAIL-1]` `[WRECORD-1]` `[WHASHED-1]`
#[derive(Debug)]
pub struct Pending<K, L> {
    node: Node,
    /// The pending children of the current node; all children, before the first query.
    set: u32,
    /// The next two pending children, in order, if they are known.
    ///
    /// The least rank of a node is never stored here, so no rank here is 0.
    nexts: [RankedChild; 2],
    /// The slot of the last returned child.
    slot: u32,
    kept: K,
    link: L,
}

impl<K, L> Pending<K, L> {
    /// Starts at the root, with nothing stored.
    ///
    /// # Errors
    /// [`TooDeep`] if the tree has more levels than `kept` carries.
    #[inline(always)]
    pub fn new<const A: usize>(tree: &impl Topology<A>, kept: K, link: L) -> Result<Self, TooDeep>
    where
        K: PendingStore<A>,
        L: Link<A>,
    {
        K::carries(tree.levels())?;
        let mut cursor = Self { node: tree.root(), set: 0, nexts: [RankedChild::NONE; 2], slot: 0, kept, link };
        cursor.reset(tree);
        Ok(cursor)
    }

    /// Returns the stored state of the levels above.
    pub const fn kept(&self) -> &K {
        &self.kept
    }

    /// Returns the pending child of the least rank, which must exist; stores the next two.
    #[inline(always)]
    fn first<const A: usize>(&mut self, tree: &impl Topology<A>, ranks: impl Ranks<A>) -> Node {
        let (node, slot) = (self.node, self.set.trailing_zeros());
        let others = self.set & (self.set - 1);
        if others == 0 {
            return self.take(slot, tree.child(node, slot));
        }
        // Computed once: each call would store them.
        let ranks = ranks.all();
        let first = RankedChild::of(tree, node, ranks, slot);
        let second = RankedChild::of(tree, node, ranks, others.trailing_zeros());
        let (first, second) = (first.min(second), first.max(second));
        let more = others & (others - 1);
        if more == 0 {
            self.nexts = [second, RankedChild::NONE];
            return self.take_ranked::<A>(first);
        }
        let third = RankedChild::of(tree, node, ranks, more.trailing_zeros());
        let (second, mut third) = (second.min(third), second.max(third));
        let (mut first, mut second) = (first.min(second), first.max(second));
        let mut more = more & (more - 1);
        while more != 0 {
            let other = RankedChild::of(tree, node, ranks, more.trailing_zeros());
            more &= more - 1;
            third = third.min(second.max(other));
            second = second.min(first.max(other));
            first = first.min(other);
        }
        self.nexts = [second, third];
        self.take_ranked::<A>(first)
    }

    /// Returns a pending child whose rank is known.
    #[inline(always)]
    const fn take_ranked<const A: usize>(&mut self, ranked: RankedChild) -> Node {
        self.take(ranked.rank() & (A as u32 - 1), ranked.child())
    }

    /// Returns the pending child in the lowest slot, which must exist.
    #[inline(always)]
    fn lowest<const A: usize>(&mut self, tree: &impl Topology<A>) -> Node {
        let slot = self.set.trailing_zeros() & (A as u32 - 1);
        self.take(slot, tree.child(self.node, slot))
    }

    /// Returns the child in a slot.
    #[inline(always)]
    const fn take(&mut self, slot: u32, child: Node) -> Node {
        self.slot = slot;
        self.set &= !(1 << slot);
        child
    }
}

impl<const A: usize, K, L> Cursor<A> for Pending<K, L>
where
    K: PendingStore<A>,
    L: Link<A>,
{
    #[inline(always)]
    fn reset(&mut self, tree: &impl Topology<A>) {
        (self.node, self.set) = (tree.root(), u32::MAX);
        self.kept.clear();
        self.link.clear();
    }

    #[inline(always)]
    fn node(&self) -> Node {
        self.node
    }

    #[inline(always)]
    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        // Only a sorted search receives repeated queries.
        self.set = if S::SORTED { self.set & wanted.set } else { wanted.set };
        self.nexts = [RankedChild::NONE; 2];
        if self.set == 0 {
            return self.next(tree, search);
        }
        // Without `next`, which may have climbed: the node's record is available here.
        Next::Child(if S::SORTED { self.first(tree, wanted.ranks) } else { self.lowest(tree) })
    }

    #[inline(always)]
    fn next<T: Topology<A>, S: Search<A>>(&mut self, tree: &T, search: &mut S) -> Next {
        loop {
            if self.set == 0 {
                let Some(level) = self.kept.pop(search.end()) else { return Next::End };
                self.node = self.link.ancestor(tree, self.node, level.up);
                self.set = level.pending;
                // Unsorted searches never know the next children: so no register holds them.
                if S::SORTED {
                    self.nexts = level.nexts;
                }
            }
            if !S::SORTED {
                return Next::Child(self.lowest(tree));
            }
            let [next, after] = self.nexts;
            if next != RankedChild::NONE {
                if !is_beyond::<A>(next.rank(), search.end()) {
                    self.nexts = [after, RankedChild::NONE];
                    return Next::Child(self.take_ranked::<A>(next));
                }
                // So are the children after it.
                self.set = 0;
            } else if self.set.is_power_of_two() && !self.kept.is_stale() {
                return Next::Child(self.lowest(tree));
            } else {
                self.kept.asked();
                return Next::Ask;
            }
        }
    }

    #[inline(always)]
    fn enter(&mut self, node: Node) {
        self.kept.push(self.set, self.nexts);
        self.link.enter(self.slot);
        (self.node, self.set) = (node, u32::MAX);
    }

    #[inline(always)]
    fn shortened(&mut self) {
        self.kept.shortened();
    }

    fn words(&self, up: u32) -> Option<StateView> {
        self.kept.words(up, self.set, self.nexts)
    }

    fn key(&self) -> Option<u64> {
        self.link.key()
    }
}
