//! Skip pointers: Smits 1998, and one set for each octant of ray directions, Boulos & Haines 2006.

use super::Cursor;
use crate::event::State;
use crate::order::{Descent, FixedOrder};
use crate::tree::{Node, Skips, Topology};

/// Goes to the first child or follows the skip pointer: a node is all the state. The order is fixed by the pointers.
///
/// The visitor tests a node at its visit and wants both children in the order that the pointers were made for
/// ([`ByNode`](crate::order::ByNode) does).
#[derive(Debug)]
pub struct Skip<'t, T, O> {
    tree: &'t T,
    skips: &'t Skips,
    order: O,
    node: Node,
}

impl<'t, T: Topology, O: FixedOrder> Skip<'t, T, O> {
    /// Starts at the root. The state does not grow with the depth.
    #[inline]
    pub fn new(tree: &'t T, skips: &'t Skips, order: O) -> Self {
        Self { tree, skips, order, node: tree.root() }
    }
}

impl<T, O> State for Skip<'_, T, O> {
    type Word = u64;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }
}

impl<T: Topology, O: FixedOrder> Cursor for Skip<'_, T, O> {
    #[inline(always)]
    fn descend(&mut self, _: Descent) -> bool {
        self.node = self.tree.child(self.node, self.order.first(self.node));
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        self.node = self.skips.after(self.tree.slot(self.node));
        self.node != self.tree.root()
    }
}
