//! The register of the most recently postponed node.

use crate::order::Descent;
use crate::tree::{Node, Uncles};

/// Address of the node that comes next, if it is known (`mrpnAddr` of Binder & Keller's Algorithm 1).
///
/// Where it is set, it addresses the node with key `(k >> n) ^ 1`. A pending sibling is always in it: the lowest bit
/// of the trail is set by the very descent that sets the register, and backtracking clears it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Register(pub(super) Option<Node>);

impl Register {
    /// On a visit, if unset: takes the lowest postponed node that the record of `node` names.
    #[inline]
    pub(super) fn fill(&mut self, uncles: &Uncles, node: Node, slot: usize, trail: u32) {
        if self.0.is_none() {
            self.0 = uncles.lowest_pending(node, slot, trail);
        }
    }

    /// On a descent: takes the postponed child, if there is one.
    #[inline]
    pub(super) fn postpone(&mut self, descent: Descent, children: [Node; 2]) {
        if let Descent::Both { first } = descent {
            self.0 = Some(children[first.other().index()]);
        }
    }
}
