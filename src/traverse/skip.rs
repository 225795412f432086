//! Skip pointers: Smits 1998, and one set for each octant of ray directions, Boulos & Haines 2006.

use alloc::vec;
use alloc::vec::Vec;

use super::Cursor;
use crate::order::{Descent, FixedOrder};
use crate::tree::{Node, Topology, for_each_parent};

/// The node after each node's subtree, in a fixed order of the children (Smits 1998). `[SKIP-1]`
#[derive(Clone, Debug)]
pub struct Skips {
    rows: Vec<Node>,
}

impl Skips {
    /// Computes the skip pointers of a tree for an order.
    pub fn of(tree: &impl Topology, order: &impl FixedOrder) -> Self {
        let mut rows = vec![tree.root(); tree.node_count()];
        for_each_parent(tree, |parent, children| {
            let first = order.first(parent);
            rows[tree.slot(children[first.index()])] = children[first.other().index()];
            rows[tree.slot(children[first.other().index()])] = rows[tree.slot(parent)];
        });
        Self { rows }
    }

    /// Returns the memory of the pointers, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }

    /// Returns the node to visit after the subtree of the node with this slot. The root, which comes after no node,
    /// means none.
    #[inline]
    pub fn after(&self, slot: usize) -> Node {
        self.rows[slot]
    }
}

/// Goes to the first child or follows the skip pointer: the state is one node. The pointers determine the order.
///
/// The visitor tests a node at its visit and wants both children in the order of the pointers
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

impl<T: Topology, O: FixedOrder> Cursor for Skip<'_, T, O> {
    type Word = u64;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::LeftOrder;
    use crate::tree::Tree;

    #[test]
    fn pointers_of_a_small_tree() {
        let leaf = None;
        let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), leaf, Some([7, 8]), leaf, leaf];
        let tree = Tree::new(&children).unwrap();
        let skips = Skips::of(&tree, &LeftOrder);
        let after: Vec<_> = (0..9).map(|slot| skips.after(slot).index()).collect();
        assert_eq!(after, [0, 2, 0, 4, 2, 6, 2, 8, 2]);
    }
}
