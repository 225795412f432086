//! The reference: recursion, as short as it can be. Everything else is compared with it.

use crate::event::{Recorder, State};
use crate::order::{Flow, Pruning, Visitor};
use crate::tree::{Node, Topology};

/// Deepest tree, in edges, that the recursion is used for. Deeper ones are compared with the explicit
/// [`Stack`](crate::traverse::Stack), which is itself compared with this function.
pub const DEPTH_LIMIT: u32 = 2000;

/// Visits the root, then, at each inner node, the wanted children in the wanted order. `[ORACLE-1]`
///
/// The tree must be at most [`DEPTH_LIMIT`] deep; below that depth nothing is visited.
pub fn traverse<T: Topology>(tree: &T, visitor: &mut impl Visitor, recorder: &mut impl Recorder) {
    traverse_pruned(tree, tree.root(), Pruning::Never, visitor, recorder);
}

/// The same for the subtree of any node, where some postponed nodes are left out.
pub fn traverse_pruned<T: Topology>(
    tree: &T,
    node: Node,
    pruning: Pruning,
    visitor: &mut impl Visitor,
    recorder: &mut impl Recorder,
) -> Flow {
    visit(&Reference { tree, pruning }, node, DEPTH_LIMIT, visitor, recorder)
}

struct Reference<'t, T> {
    tree: &'t T,
    pruning: Pruning,
}

fn visit<T: Topology>(
    reference: &Reference<'_, T>,
    node: Node,
    depth_left: u32,
    visitor: &mut impl Visitor,
    recorder: &mut impl Recorder,
) -> Flow {
    if recorder.visit(&At(node)) == Flow::Stop {
        return Flow::Stop;
    }
    if node.is_leaf() {
        return visitor.leaf(node);
    }
    let descent = visitor.inner(node);
    let begins = visitor.postponed(node, descent);
    let Some(left) = depth_left.checked_sub(1).filter(|_| !descent.is_neither()) else { return Flow::Continue };
    let [first, second] =
        [descent.first(), descent.first().other()].map(|side| reference.tree.children(node)[side.index()]);
    let flow = visit(reference, first, left, visitor, recorder);
    let is_pruned = match reference.pruning {
        Pruning::Never => false,
        Pruning::Disjoint => descent.is_disjoint() && flow == Flow::Prune,
        Pruning::Distance => begins > visitor.end(),
    };
    if flow == Flow::Stop || !descent.postpones() || is_pruned {
        return flow;
    }
    match visit(reference, second, left, visitor, recorder) {
        Flow::Continue => flow,
        other => other,
    }
}

/// The oracle's state: it has nothing but a node.
struct At(Node);

impl State for At {
    type Word = u64;

    fn node(&self) -> Node {
        self.0
    }
}
