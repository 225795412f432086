//! The register of the most recently postponed node.

use core::hint::select_unpredictable;

use crate::tree::{Node, Topology, Uncles};

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

    /// On a visit, if unset: takes the lowest postponed node that the record of `node` names.
    ///
    /// The printed algorithm fills the register when it loads a record. Here it is filled when the visit is over, which
    /// gives the same value (the trail is still that of the visit).
    #[inline(always)]
    pub(super) fn fill<const INNER: u32, const LEAF: u32>(
        &mut self,
        uncles: &Uncles<INNER, LEAF>,
        tree: &impl Topology,
        node: Node,
        trail: u32,
    ) {
        let named = uncles.lowest_pending(tree, node, trail, self.0);
        self.0 = select_unpredictable(self.0 == tree.root(), named, self.0);
    }

    /// On a descent that postpones a child: it replaces what was there.
    #[inline]
    pub(super) fn set(&mut self, postponed: Node) {
        self.0 = postponed;
    }

    /// On backtracking: the node, if set; it is not set afterwards.
    #[inline(always)]
    pub(super) fn take(&mut self, tree: &impl Topology) -> Option<Node> {
        let node = self.get(tree);
        self.0 = tree.root();
        node
    }
}
