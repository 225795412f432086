//! Hapala et al. 2011: parent references and a three-state automaton; the order is queried again on the way up.

use super::{Cursor, Unsupported};
use crate::order::{Descent, FixedOrder};
use crate::tree::{Node, Recorded, Topology};

/// Climbs until it comes from a near child, then goes to the far one. There is no trail: the order is queried again for
/// the near child, so it must be fixed for the ray (by the sign of its direction). `[HAPALA-1]`
///
/// The visitor tests a node at its visit and wants both children, the near one first ([`ByNode`](crate::order::ByNode)
/// does). The paper starts at the root's near child; here the root is visited too.
#[derive(Debug)]
pub struct Hapala<'t, T, O> {
    tree: &'t T,
    order: O,
    node: Node,
    /// The automaton's state: arrived from the parent (so this is the near child), or from the sibling.
    from_parent: bool,
}

impl<'t, T: Topology, O: FixedOrder> Hapala<'t, T, O> {
    /// Starts at the root. The state does not grow with the depth.
    ///
    /// # Errors
    /// [`Unsupported::NoLinks`] if the tree has no parents and siblings.
    #[inline]
    pub fn new(tree: &'t T, order: O) -> Result<Self, Unsupported> {
        Unsupported::unless_linked(tree, Recorded::ParentSibling)?;
        Ok(Self { tree, order, node: tree.root(), from_parent: false })
    }
}

impl<T: Topology, O: FixedOrder> Cursor for Hapala<'_, T, O> {
    type Word = u64;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    #[inline(always)]
    fn descend(&mut self, _: Descent) -> bool {
        let near = self.order.first(self.node);
        self.node = self.tree.child(self.node, near);
        self.from_parent = true;
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let root = self.tree.root();
        while !self.from_parent {
            // From sibling or from child: this subtree is done, and so is its parent's unless it is a near child.
            if self.node == root {
                return false;
            }
            let parent = self.tree.parent(self.node);
            self.node = parent;
            if parent != root {
                let above = self.tree.parent(parent);
                let near = self.order.first(above);
                self.from_parent = self.tree.child(above, near) == parent;
            }
        }
        self.node = self.tree.sibling(self.node);
        self.from_parent = false;
        true
    }
}
