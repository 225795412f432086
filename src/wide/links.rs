//! Three methods to find an ancestor. `[WIDE-15]`

use core::fmt::Debug;

use super::keys::{ancestor_key, child_key};
use super::tree::Topology;
use crate::hash::Lookup;
use crate::tree::Node;

/// A method to find the ancestors of a node.
pub trait Link<const A: usize>: Debug {
    /// Resets to the root.
    fn clear(&mut self) {}

    /// Records the descent to the child in a slot.
    fn enter(&mut self, slot: u32);

    /// Returns the ancestor `up` levels up, at least one, to which the traversal returns.
    fn ancestor<T: Topology<A>>(&mut self, tree: &T, node: Node, up: u32) -> Node;

    /// Returns the key of the current node, if the link has it.
    fn key(&self) -> Option<u64> {
        None
    }
}

/// One level at a time, after Áfra & Szirmay-Kalos 2014.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parents;

impl<const A: usize> Link<A> for Parents {
    #[inline(always)]
    fn enter(&mut self, _: u32) {}

    #[inline(always)]
    fn ancestor<T: Topology<A>>(&mut self, tree: &T, mut node: Node, up: u32) -> Node {
        for _ in 0..up {
            node = tree.parent(node);
        }
        node
    }
}

/// By the ancestors in the node's record.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recorded;

impl<const A: usize> Link<A> for Recorded {
    #[inline(always)]
    fn enter(&mut self, _: u32) {}

    #[inline(always)]
    fn ancestor<T: Topology<A>>(&mut self, tree: &T, mut node: Node, mut up: u32) -> Node {
        while up > A as u32 {
            node = tree.ancestor(node, A as u32);
            up -= A as u32;
        }
        tree.ancestor(node, up)
    }
}

/// By its key, from a table with the keys of [WIDE-16].
#[derive(Clone, Copy, Debug)]
pub struct Hashed<L> {
    key: u64,
    table: L,
}

impl<L> Hashed<L> {
    /// Starts at the root.
    #[inline]
    pub const fn new(table: L) -> Self {
        Self { key: 1, table }
    }
}

impl<const A: usize, L: Lookup<u64> + Debug> Link<A> for Hashed<L> {
    #[inline(always)]
    fn clear(&mut self) {
        self.key = 1;
    }

    #[inline(always)]
    fn enter(&mut self, slot: u32) {
        self.key = child_key::<A, u64>(self.key, u64::from(slot));
    }

    #[inline(always)]
    fn ancestor<T: Topology<A>>(&mut self, _: &T, _: Node, up: u32) -> Node {
        self.key = ancestor_key::<A, u64>(self.key, up);
        self.table.node(&self.key)
    }

    fn key(&self) -> Option<u64> {
        Some(self.key)
    }
}
