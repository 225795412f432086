//! Which keys are ever looked up.

use alloc::vec;
use alloc::vec::Vec;

use crate::tree::{Node, Reach, Topology, for_each_parent};

/// By slot: whether a traversal with register and uncles can come to look the node up. `[HASH-3]`
///
/// A traversal goes from a visited node to the postponed sibling of one of its ancestors, or its own. It knows the
/// address without a table where the register was set on the way and not used since, or where the record of the last
/// visited node reaches that far. So a node is looked up only from deep below its sibling: from an inner node more than
/// `reach` of inner nodes below it, or from a leaf more than `reach` of leaves below it; and if there is such a node, it
/// is looked up by some search, which on its way postpones and finishes something nearer. Over the printed rule (a
/// grand nephew that is an inner node) this one is exact for every reach.
pub(crate) fn looked_up(tree: &impl Topology, reach: Reach) -> Vec<bool> {
    let mut parents = Vec::new();
    for_each_parent(tree, |parent, children| parents.push((parent, children)));
    // Levels down to the deepest inner node and to the deepest leaf of each subtree.
    let mut heights = vec![(0_u32, 0_u32); tree.node_count()];
    let mut looked_up = vec![false; tree.node_count()];
    for (parent, children) in parents.into_iter().rev() {
        let below = children.map(|child| (child, heights[tree.slot(child)]));
        let [(left, of_left), (right, of_right)] = below;
        looked_up[tree.slot(left)] = reaches_too_far(right, of_right, reach);
        looked_up[tree.slot(right)] = reaches_too_far(left, of_left, reach);
        let inner = below.map(|(child, (inner, _))| if child.is_leaf() { 0 } else { inner + 1 });
        heights[tree.slot(parent)] = (inner[0].max(inner[1]), of_left.1.max(of_right.1) + 1);
    }
    looked_up
}

/// Whether the subtree of `sibling` has a node whose record does not reach up to the sibling of `sibling`.
fn reaches_too_far(sibling: Node, (inner, leaf): (u32, u32), reach: Reach) -> bool {
    !sibling.is_leaf() && (inner > reach.of(false) || leaf > reach.of(true))
}
