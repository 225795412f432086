//! A traversal that passes nodes nobody wants, and calls it a restart.

use stackless_bvh::event::State;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{Cursor, Stack};
use stackless_bvh::tree::{Node, Topology, Tree};

/// The stack, with a detour by the last inner node of the array after each backtracking.
pub(super) struct Wanderer<'t> {
    tree: &'t Tree,
    stack: Stack<'t, Tree>,
    detour: Option<Node>,
}

impl<'t> Wanderer<'t> {
    pub(super) fn new(tree: &'t Tree, memory: &'t mut Vec<Node>) -> Self {
        Self { tree, stack: Stack::new(tree, memory), detour: None }
    }
}

impl Cursor for Wanderer<'_> {
    type Word = u64;
    const RESTARTS: bool = true;

    fn node(&self) -> Node {
        self.detour.unwrap_or(self.stack.node())
    }

    fn state(&self) -> State<u64> {
        State { is_restarting: self.detour.is_some(), ..State::of(self.node()) }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.detour.take().is_some() || self.stack.descend(descent)
    }

    fn backtrack(&mut self) -> bool {
        if self.detour.take().is_some() {
            return true;
        }
        let more = self.stack.backtrack();
        let nodes = (0..self.tree.node_count() as u32).rev().filter_map(|index| self.tree.node(index));
        let mut inner = nodes.filter(|node| !node.is_leaf());
        self.detour = if more { inner.next() } else { None };
        more
    }
}
