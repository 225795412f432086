//! The textbook traversal: a stack of postponed nodes.

use alloc::vec::Vec;

use super::Cursor;
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// Postponed nodes on a stack, popped without a second test (Binder & Keller 2016, Section 1). `[STACK-1]`
#[derive(Debug)]
pub struct Stack<'t, T> {
    tree: &'t T,
    node: Node,
    postponed: &'t mut Vec<Node>,
}

impl<'t, T: Topology> Stack<'t, T> {
    /// Starts at the root. The memory of the stack is the caller's, so that many traversals can share it.
    #[inline]
    pub fn new(tree: &'t T, memory: &'t mut Vec<Node>) -> Self {
        memory.clear();
        Self { tree, node: tree.root(), postponed: memory }
    }
}

impl<T: Topology> Cursor for Stack<'_, T> {
    type Word = u64;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let (node, first) = (self.node, descent.first());
        self.node = self.tree.child(node, first);
        if descent.postpones() {
            self.postponed.push(self.tree.child(node, first.other()));
        }
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        match self.postponed.pop() {
            Some(node) => {
                self.node = node;
                true
            }
            None => false,
        }
    }
}
