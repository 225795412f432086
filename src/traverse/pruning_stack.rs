//! The stack, with data to skip postponed nodes after a hit.

use alloc::vec::Vec;
use core::borrow::BorrowMut;

use super::Cursor;
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// Postponed nodes on a stack, each with the distance at which it begins (`BY_DISTANCE`) or with the mark of its
/// descent. By distance, nodes that begin beyond the end of the search are dropped when they are popped (Dammertz 2011,
/// named by Binder & Keller 2016, Section 2.3). By marks, nodes that are disjoint from a found candidate are dropped
/// when it is found.
#[derive(Debug)]
pub struct PruningStack<'t, T, const BY_DISTANCE: bool, M = &'t mut Vec<Node>> {
    tree: &'t T,
    node: Node,
    /// Two entries for each node: the node, and its distance or mark as the bits of an address.
    postponed: M,
}

impl<'t, T: Topology, const BY_DISTANCE: bool> PruningStack<'t, T, BY_DISTANCE> {
    /// Starts at the root. The caller owns the memory of the stack: traversals can share it.
    #[inline]
    pub fn new(tree: &'t T, memory: &'t mut Vec<Node>) -> Self {
        Self::with(tree, memory)
    }
}

impl<'t, T: Topology, const BY_DISTANCE: bool, M: BorrowMut<Vec<Node>>> PruningStack<'t, T, BY_DISTANCE, M> {
    /// Starts at the root, with memory that is borrowed or owned.
    #[inline]
    pub fn with(tree: &'t T, mut memory: M) -> Self {
        memory.borrow_mut().clear();
        Self { tree, node: tree.root(), postponed: memory }
    }
}

impl<T: Topology, const BY_DISTANCE: bool, M: BorrowMut<Vec<Node>>> Cursor for PruningStack<'_, T, BY_DISTANCE, M> {
    type Word = u64;
    const PRUNES: bool = !BY_DISTANCE;
    const KEEPS_DISTANCES: bool = BY_DISTANCE;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let (node, first) = (self.node, descent.first());
        self.node = self.tree.child(node, first);
        if descent.postpones() {
            let mark = Node::from_bits(u32::from(descent.is_disjoint()));
            self.postponed.borrow_mut().extend([self.tree.child(node, first.other()), mark]);
        }
        true
    }

    #[inline(always)]
    fn keep_distance(&mut self, distance: u32) {
        if let Some(last) = self.postponed.borrow_mut().last_mut() {
            *last = Node::from_bits(distance);
        }
    }

    #[inline(always)]
    fn drop_beyond(&mut self, end: u32) {
        let postponed = self.postponed.borrow_mut();
        while postponed.last().is_some_and(|distance| distance.to_bits() > end) {
            postponed.truncate(postponed.len() - 2);
        }
    }

    fn prune(&mut self) {
        let (postponed, mut kept) = (self.postponed.borrow_mut(), 0);
        for i in (0..postponed.len()).step_by(2) {
            if postponed[i + 1].to_bits() == 0 {
                postponed.copy_within(i..i + 2, kept);
                kept += 2;
            }
        }
        postponed.truncate(kept);
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let postponed = self.postponed.borrow_mut();
        postponed.pop();
        match postponed.pop() {
            Some(node) => {
                self.node = node;
                true
            }
            None => false,
        }
    }
}
