//! The textbook traversal: a stack of postponed nodes.

use alloc::vec::Vec;
use core::borrow::BorrowMut;

use super::Cursor;
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// Postponed nodes on a stack, popped without a second test (Binder & Keller 2016, Section 1). `[STACK-1]`
#[derive(Debug)]
pub struct Stack<'t, T, M = &'t mut Vec<Node>> {
    tree: &'t T,
    node: Node,
    postponed: M,
}

impl<'t, T: Topology> Stack<'t, T> {
    /// Starts at the root. The caller owns the memory of the stack: traversals can share it.
    #[inline]
    pub fn new(tree: &'t T, memory: &'t mut Vec<Node>) -> Self {
        Self::with(tree, memory)
    }
}

impl<'t, T: Topology, M: BorrowMut<Vec<Node>>> Stack<'t, T, M> {
    /// Starts at the root, with memory that is borrowed or owned.
    #[inline]
    pub fn with(tree: &'t T, mut memory: M) -> Self {
        memory.borrow_mut().clear();
        Self { tree, node: tree.root(), postponed: memory }
    }
}

impl<T: Topology, M: BorrowMut<Vec<Node>>> Cursor for Stack<'_, T, M> {
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
            self.postponed.borrow_mut().push(self.tree.child(node, first.other()));
        }
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        match self.postponed.borrow_mut().pop() {
            Some(node) => {
                self.node = node;
                true
            }
            None => false,
        }
    }
}
