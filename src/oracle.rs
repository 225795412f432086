//! The reference: recursion, as short as it can be. Everything else is compared with it.

use crate::event::{Recorder, State};
use crate::order::{Flow, Visitor};
use crate::tree::{Node, Topology};

/// Deepest tree, in edges, that the recursion is used for. Deeper ones are compared with the explicit
/// [`Stack`](crate::traverse::Stack), which is itself compared with this function.
pub const DEPTH_LIMIT: u32 = 2000;

/// Visits the root, then, at each inner node, the wanted children in the wanted order. `[ORACLE-1]`
///
/// The tree must be at most [`DEPTH_LIMIT`] deep; below that depth nothing is visited.
pub fn traverse<T: Topology>(tree: &T, visitor: &mut impl Visitor, recorder: &mut impl Recorder) {
    visit(tree, tree.root(), DEPTH_LIMIT, visitor, recorder);
}

fn visit<T: Topology>(
    tree: &T,
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
    let wanted = [(descent.first(), !descent.is_neither()), (descent.first().other(), descent.postpones())];
    for (side, _) in wanted.into_iter().filter(|&(_, is_wanted)| is_wanted) {
        let child = tree.children(node)[side.index()];
        let Some(left) = depth_left.checked_sub(1) else { return Flow::Continue };
        if visit(tree, child, left, visitor, recorder) == Flow::Stop {
            return Flow::Stop;
        }
    }
    Flow::Continue
}

/// The oracle's state: it has nothing but a node.
struct At(Node);

impl State for At {
    type Word = u64;

    fn node(&self) -> Node {
        self.0
    }
}
