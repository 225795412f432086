//! The textbook traversal: postponed children on a stack, each with its rank.

use alloc::vec::Vec;

use super::search::{RankedChild, Ranks, Search, Wanted, is_beyond};
use super::tree::Topology;
use super::{Cursor, Next};
use crate::tree::Node;

/// Memory of a [`Stack`].
pub type Memory = Vec<RankedChild>;

/// Pushes all wanted children except the first, the greatest rank first. A child that is beyond the end when it is
/// popped is dropped. `[WSTACK-1]`
#[derive(Debug)]
pub struct Stack<'m> {
    node: Node,
    memory: &'m mut [RankedChild],
    /// Number of entries. Memory above it holds old entries.
    height: usize,
}

impl<'m> Stack<'m> {
    /// Starts at the root.
    #[inline(always)]
    pub fn new<const A: usize>(tree: &impl Topology<A>, memory: &'m mut Memory) -> Self {
        let most = (A - 1) * (tree.levels() as usize + 1) + 1;
        if memory.len() < most {
            memory.resize(most, RankedChild::NONE);
        }
        Self { node: tree.root(), memory, height: 0 }
    }

    #[inline(always)]
    fn push(&mut self, entry: RankedChild) {
        // There is room for all entries; a failed check means that the tree's number of levels is wrong.
        if let Some(place) = self.memory.get_mut(self.height) {
            *place = entry;
            self.height += 1;
        }
    }

    /// Pushes all children of a set except the first, which it returns.
    #[inline(always)]
    fn sort<const A: usize>(&mut self, tree: &impl Topology<A>, Wanted { set, ranks }: Wanted<impl Ranks<A>>) -> Node {
        let (slot, others) = (set.trailing_zeros(), set & (set - 1));
        if others == 0 {
            return tree.child(self.node, slot);
        }
        // Computed once: each call would store them.
        let ranks = ranks.all();
        let first = RankedChild::of(tree, self.node, ranks, slot);
        let second = RankedChild::of(tree, self.node, ranks, others.trailing_zeros());
        let (first, second) = (first.min(second), first.max(second));
        let more = others & (others - 1);
        if more == 0 {
            self.push(second);
            return first.child();
        }
        let third = RankedChild::of(tree, self.node, ranks, more.trailing_zeros());
        let (second, third) = (second.min(third), second.max(third));
        let (first, second) = (first.min(second), first.max(second));
        let base = self.height;
        self.push(third);
        self.push(second);
        let mut more = more & (more - 1);
        if more == 0 {
            return first.child();
        }
        self.push(first);
        while more != 0 {
            let entry = RankedChild::of(tree, self.node, ranks, more.trailing_zeros());
            more &= more - 1;
            self.push(entry);
            self.settle(base);
        }
        self.height -= 1;
        self.memory.get(self.height).map_or(self.node, |entry| entry.child())
    }

    /// Moves the last entry down to its place above `base`, where ranks decrease upwards.
    #[inline(always)]
    fn settle(&mut self, base: usize) {
        let Some(entries) = self.memory.get_mut(base..self.height) else { return };
        let mut at = entries.len() - 1;
        while at > 0 && entries[at - 1] < entries[at] {
            entries.swap(at - 1, at);
            at -= 1;
        }
    }
}

impl<const A: usize> Cursor<A> for Stack<'_> {
    #[inline(always)]
    fn reset(&mut self, tree: &impl Topology<A>) {
        (self.node, self.height) = (tree.root(), 0);
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
        if wanted.set == 0 {
            return self.next(tree, search);
        }
        if S::SORTED {
            return Next::Child(self.sort(tree, wanted));
        }
        let mut others = wanted.set & (wanted.set - 1);
        while others != 0 {
            // The last slot first.
            let slot = others.ilog2();
            others ^= 1 << slot;
            self.push(RankedChild::new(slot, tree.child(self.node, slot)));
        }
        Next::Child(tree.child(self.node, wanted.set.trailing_zeros()))
    }

    #[inline(always)]
    fn next<T: Topology<A>, S: Search<A>>(&mut self, _: &T, search: &mut S) -> Next {
        while let Some(height) = self.height.checked_sub(1) {
            self.height = height;
            let Some(&entry) = self.memory.get(height) else { break };
            if !S::SORTED || !is_beyond::<A>(entry.rank(), search.end()) {
                return Next::Child(entry.child());
            }
        }
        Next::End
    }

    #[inline(always)]
    fn enter(&mut self, node: Node) {
        self.node = node;
    }
}
