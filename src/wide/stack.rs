//! The textbook: postponed children on a stack, each with its rank.

use alloc::vec::Vec;

use super::search::{Ranks, Search, Wanted, is_beyond};
use super::tree::Topology;
use super::{Cursor, Next};
use crate::tree::Node;

/// Memory of a [`Stack`]: a rank in the high half, an address in the low one.
pub type Memory = Vec<u64>;

/// Pushes the wanted children but the first, the greatest rank first. What is beyond the end when it is popped is
/// dropped. `[WSTACK-1]`
#[derive(Debug)]
pub struct Stack<'t, T> {
    tree: &'t T,
    node: Node,
    memory: &'t mut [u64],
    /// Number of entries. What is above it in the memory is old.
    height: usize,
}

impl<'t, T> Stack<'t, T> {
    /// Starts at the root.
    #[inline(always)]
    pub fn new<const A: usize>(tree: &'t T, memory: &'t mut Memory) -> Self
    where
        T: Topology<A>,
    {
        let most = (A - 1) * (tree.levels() as usize + 1) + 1;
        if memory.len() < most {
            memory.resize(most, 0);
        }
        Self { tree, node: tree.root(), memory, height: 0 }
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        // There is room for all; a check that fails would show a tree whose number of levels is wrong.
        if let Some(place) = self.memory.get_mut(self.height) {
            *place = entry;
            self.height += 1;
        }
    }

    /// The entry of a child.
    #[inline(always)]
    fn entry<const A: usize>(&self, ranks: impl Ranks<A>, slot: u32) -> u64
    where
        T: Topology<A>,
    {
        u64::from(ranks.rank(slot)) << 32 | u64::from(self.tree.child(self.node, slot).to_bits())
    }

    /// Pushes all children of a set but the first, which it returns.
    #[inline(always)]
    fn sort<const A: usize>(&mut self, Wanted { set, ranks }: Wanted<impl Ranks<A>>) -> Node
    where
        T: Topology<A>,
    {
        let (slot, others) = (set.trailing_zeros(), set & (set - 1));
        if others == 0 {
            return self.tree.child(self.node, slot);
        }
        // Once: each time they would be stored.
        let ranks = ranks.all();
        let first = self.entry::<A>(ranks, slot);
        let second = self.entry::<A>(ranks, others.trailing_zeros());
        let (first, second) = (first.min(second), first.max(second));
        let more = others & (others - 1);
        if more == 0 {
            self.push(second);
            return address(first);
        }
        let third = self.entry::<A>(ranks, more.trailing_zeros());
        let (second, third) = (second.min(third), second.max(third));
        let (first, second) = (first.min(second), first.max(second));
        let base = self.height;
        self.push(third);
        self.push(second);
        let mut more = more & (more - 1);
        if more == 0 {
            return address(first);
        }
        self.push(first);
        while more != 0 {
            let entry = self.entry::<A>(ranks, more.trailing_zeros());
            more &= more - 1;
            self.push(entry);
            self.settle(base);
        }
        self.height -= 1;
        self.memory.get(self.height).map_or(self.node, |&entry| address(entry))
    }

    /// Moves the last entry down to its place above `base`, where ranks become less upwards.
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

#[inline(always)]
const fn address(entry: u64) -> Node {
    Node::from_bits(entry as u32)
}

impl<const A: usize, T: Topology<A>> Cursor<A> for Stack<'_, T> {
    #[inline(always)]
    fn reset(&mut self) {
        (self.node, self.height) = (self.tree.root(), 0);
    }

    #[inline(always)]
    fn node(&self) -> Node {
        self.node
    }

    #[inline(always)]
    fn choose<S: Search<A>>(&mut self, wanted: Wanted<S::Ranks>, search: &mut S) -> Next {
        if wanted.set == 0 {
            return self.next(search);
        }
        if S::SORTED {
            return Next::Child(self.sort::<A>(wanted));
        }
        let mut others = wanted.set & (wanted.set - 1);
        while others != 0 {
            // The last slot first.
            let slot = others.ilog2();
            others ^= 1 << slot;
            self.push(u64::from(self.tree.child(self.node, slot).to_bits()));
        }
        Next::Child(self.tree.child(self.node, wanted.set.trailing_zeros()))
    }

    #[inline(always)]
    fn next<S: Search<A>>(&mut self, search: &mut S) -> Next {
        while let Some(height) = self.height.checked_sub(1) {
            self.height = height;
            let Some(&entry) = self.memory.get(height) else { break };
            if !S::SORTED || !is_beyond::<A>((entry >> 32) as u32, search.end()) {
                return Next::Child(address(entry));
            }
        }
        Next::End
    }

    #[inline(always)]
    fn enter(&mut self, node: Node) {
        self.node = node;
    }
}
