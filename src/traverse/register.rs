//! The register of the most recently postponed node.

use core::hint::select_unpredictable;

use super::Incomplete;
use crate::key::KeyWord;
use crate::trail::{is_pending, levels};
use crate::tree::{Node, Topology};

/// Address of the node that comes next, if it is known (`mrpnAddr` of Binder & Keller's Algorithm 1).
///
/// Where it is set, it addresses the node with key `(k >> n) ^ 1`. A pending sibling is always in it: the lowest bit
/// of the trail is set by the very descent that sets the register, and backtracking clears it. The root, which is never
/// postponed, stands for "not set".
#[derive(Clone, Copy, Debug)]
pub(super) struct Register(Node);

impl Register {
    /// Not set.
    #[inline]
    pub(super) fn empty(tree: &impl Topology) -> Self {
        Self(tree.root())
    }

    /// The node, if set.
    #[inline]
    pub(super) fn get(self, tree: &impl Topology) -> Option<Node> {
        (self.0 != tree.root()).then_some(self.0)
    }

    /// Before backtracking, if unset: takes the lowest postponed node that the record of `node` names. `[REGISTER-2]`
    ///
    /// The printed algorithm does so whenever it loads a record. What the next record on the way down names as well can
    /// wait for it, and what is postponed on the way down replaces it: so here a node is taken when the search turns
    /// back, and on a descent only where it gets out of reach. The register then holds the same node whenever it is
    /// used.
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

    /// On a descent that postpones a child: it replaces what was there.
    #[inline]
    pub(super) fn set(&mut self, postponed: Node) {
        self.0 = postponed;
    }

    /// After a hit: not set, if the node that it holds is pruned, the lowest of the trail. `[DISJOINT-3]`
    ///
    /// Before the register is filled again, else an uncle could be taken for that node.
    #[inline(always)]
    pub(super) fn prune<W: KeyWord>(&mut self, tree: &impl Topology, trail: &W, pruned: &W) {
        if pruned.is_zero() || levels(trail) != levels(pruned) {
            *self = Self::empty(tree);
        }
    }

    /// That of a traversal that was put aside.
    ///
    /// # Errors
    /// [`Incomplete::Register`] where the sibling is postponed and the register does not say where it is: no record
    /// names its node's sibling, so the next one to be named, the uncle, would be taken for it. `[PAUSE-3]`
    pub(super) fn of<W: KeyWord>(tree: &impl Topology, node: Option<Node>, trail: &W) -> Result<Self, Incomplete> {
        match node {
            Some(node) => Ok(Self(node)),
            None if is_pending(trail) => Err(Incomplete::Register),
            None => Ok(Self::empty(tree)),
        }
    }

    /// On backtracking: the node, if set; it is not set afterwards.
    #[inline(always)]
    pub(super) fn take(&mut self, tree: &impl Topology) -> Option<Node> {
        let node = self.get(tree);
        self.0 = tree.root();
        node
    }
}
