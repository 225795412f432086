//! The register of the most recently postponed node.

use core::hint::select_unpredictable;

use super::Incomplete;
use crate::key::KeyWord;
use crate::trail::{is_pending, levels};
use crate::tree::{Node, Topology};

/// Address of the next node, if it is known (`mrpnAddr` of Binder & Keller's Algorithm 1).
///
/// If it is set, it addresses the node with key `(k >> n) ^ 1`. A pending sibling is always in it: the descent that
/// sets the lowest bit of the trail also sets the register, and backtracking clears the bit. The root, which is never
/// postponed, means "not set".
#[derive(Clone, Copy, Debug)]
pub(super) struct Register(Node);

impl Register {
    /// Creates an unset register.
    #[inline]
    pub(super) fn empty(tree: &impl Topology) -> Self {
        Self(tree.root())
    }

    /// Returns the node, if set.
    #[inline]
    pub(super) fn get(self, tree: &impl Topology) -> Option<Node> {
        (self.0 != tree.root()).then_some(self.0)
    }

    /// Before backtracking, if unset: takes the lowest postponed node in the record of `node`. `[REGISTER-2]`
    ///
    /// The printed algorithm fills the register whenever it loads a record. A node that the next record on the way down
    /// also names can wait for that record, and a node postponed on the way down replaces it. So here the register is
    /// filled when the search backtracks, and on a descent only if the node gets out of reach. It then holds the same
    /// node at every use.
    #[inline(always)]
    pub(super) fn fill(&mut self, tree: &impl Topology, node: Node, trail: u32) {
        let named = tree.lowest_pending(node, trail, self.0);
        self.0 = select_unpredictable(self.0 == tree.root(), named, self.0);
    }

    /// On a descent into a single child, if unset: takes the lowest postponed node if only this record names it.
    #[inline(always)]
    pub(super) fn keep(&mut self, tree: &impl Topology, node: Node, trail: u32) {
        let leaving = tree.lowest_leaving(node, trail, self.0);
        self.0 = select_unpredictable(self.0 == tree.root(), leaving, self.0);
    }

    /// On a descent that postpones a child: replaces the content.
    #[inline]
    pub(super) fn set(&mut self, postponed: Node) {
        self.0 = postponed;
    }

    /// After a hit: unset, if its node, the lowest of the trail, is pruned. `[DISJOINT-3]`
    ///
    /// Before the register is filled again; otherwise an uncle could be mistaken for that node.
    #[inline(always)]
    pub(super) fn prune<W: KeyWord>(&mut self, tree: &impl Topology, trail: &W, pruned: &W) {
        if pruned.is_zero() || levels(trail) != levels(pruned) {
            *self = Self::empty(tree);
        }
    }

    /// Restores the register of a paused traversal.
    ///
    /// # Errors
    /// [`Incomplete::Register`] if the sibling is postponed and the register does not have its address. No record has a
    /// node's sibling, so the next recorded node, the uncle, would be mistaken for it. `[PAUSE-3]`
    pub(super) fn of<W: KeyWord>(tree: &impl Topology, node: Option<Node>, trail: &W) -> Result<Self, Incomplete> {
        match node {
            Some(node) => Ok(Self(node)),
            None if is_pending(trail) => Err(Incomplete::Register),
            None => Ok(Self::empty(tree)),
        }
    }

    /// On backtracking: returns the node, if set, and unsets the register.
    #[inline(always)]
    pub(super) fn take(&mut self, tree: &impl Topology) -> Option<Node> {
        let node = self.get(tree);
        self.0 = tree.root();
        node
    }
}
