//! The reference of all traversals: a minimal recursion.

use crate::event::{Recorder, State};
use crate::order::{Flow, Pruned, Pruning, Unpruned, Visitor};
use crate::tree::{Node, Topology};

/// Deepest tree, in edges, for the recursion. Deeper trees are compared with the explicit
/// [`Stack`](crate::traverse::Stack), which is itself compared with this function.
pub const DEPTH_LIMIT: u32 = 2000;

/// Visits the root, then, at each inner node, the wanted children in the wanted order. `[ORACLE-1]` `[CONF-4]`
///
/// The tree must be at most [`DEPTH_LIMIT`] deep; nodes below that depth are not visited.
pub fn traverse<T: Topology>(tree: &T, visitor: &mut impl Visitor, recorder: &mut impl Recorder) {
    traverse_pruned(tree, tree.root(), Pruning::Never, &mut Unpruned(visitor), recorder);
}

/// Visits the subtree of any node, without some of the postponed nodes.
pub fn traverse_pruned<T: Topology>(
    tree: &T,
    node: Node,
    pruning: Pruning,
    visitor: &mut impl Pruned,
    recorder: &mut impl Recorder,
) -> Flow {
    Reference { tree, pruning, visitor, recorder, found: false }.visit(node, DEPTH_LIMIT)
}

struct Reference<'a, T, V, R> {
    tree: &'a T,
    pruning: Pruning,
    visitor: &'a mut V,
    recorder: &'a mut R,
    /// Whether something has been found in the current subtree.
    found: bool,
}

impl<T: Topology, V: Pruned, R: Recorder> Reference<'_, T, V, R> {
    fn visit(&mut self, node: Node, depth_left: u32) -> Flow {
        if self.recorder.visit(node, || State::<u64>::of(node)) == Flow::Stop {
            return Flow::Stop;
        }
        if node.is_leaf() {
            let flow = self.visitor.leaf(node);
            self.found |= self.visitor.found_at(node);
            return flow;
        }
        let descent = match self.pruning {
            Pruning::Disjoint => self.visitor.inner_marked(node),
            _ => self.visitor.inner(node),
        };
        let begins = self.visitor.postponed(node, descent);
        let Some(left) = depth_left.checked_sub(1).filter(|_| !descent.is_neither()) else { return Flow::Continue };
        let sides = [descent.first(), descent.first().other()];
        let [first, second] = sides.map(|side| self.tree.children(node)[side.index()]);
        let found_before = core::mem::replace(&mut self.found, false);
        let flow = self.visit(first, left);
        let is_pruned = match self.pruning {
            Pruning::Never => false,
            Pruning::Disjoint => descent.is_disjoint() && self.found,
            Pruning::Distance => begins > self.visitor.end(),
        };
        self.found |= found_before;
        if flow == Flow::Stop || !descent.postpones() || is_pruned { flow } else { self.visit(second, left) }
    }
}
