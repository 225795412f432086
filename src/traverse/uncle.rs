//! Binder & Keller 2016, Section 2.2.1: register and uncles, and a climb by two levels a step instead of a hash.

use core::mem::take;

use super::Cursor;
use super::register::Register;
use crate::event::State;
use crate::key::{KeyWord, TooDeep};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology, Uncles};

/// Goes to the register's node where it is set, else climbs along grand uncles, which stand in for the grandparents:
/// they have the same uncles.
#[derive(Debug)]
pub struct Uncle<'t, W, T> {
    tree: &'t T,
    uncles: &'t Uncles,
    node: Node,
    trail: W,
    register: Register,
}

impl<'t, W: KeyWord, T: Topology> Uncle<'t, W, T> {
    /// Starts at the root. The records must name grand uncles: a [`Reach`](crate::tree::Reach) of two or more.
    ///
    /// # Errors
    /// [`TooDeep`] beyond as many edges as the word has bits.
    #[inline]
    pub fn new(tree: &'t T, uncles: &'t Uncles) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 0)?;
        Ok(Self { tree, uncles, node: tree.root(), trail: W::zero(), register: Register::default() })
    }

    #[inline]
    fn fill_register(&mut self) {
        self.register.fill(self.uncles, self.node, self.tree.slot(self.node), self.trail.low_bits());
    }
}

impl<W: KeyWord, T> State for Uncle<'_, W, T> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }

    fn register(&self) -> Option<Node> {
        self.register.0
    }
}

impl<W: KeyWord, T: Topology> Cursor for Uncle<'_, W, T> {
    #[inline]
    fn descend(&mut self, descent: Descent) -> bool {
        let Some(first) = descent.first() else { return false };
        let children = self.tree.children(self.node);
        if !descent.postpones() {
            self.fill_register();
        }
        self.register.postpone(descent, children);
        self.node = children[first.index()];
        self.trail = trail::child(take(&mut self.trail), W::from_bit(descent.postpones()));
        true
    }

    #[inline]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        loop {
            self.fill_register();
            if let Some(next) = self.register.0.take() {
                self.node = next;
                self.trail = trail::leave(take(&mut self.trail));
                return true;
            }
            // Neither uncle nor grand uncle is pending: two levels up.
            let [_, grand_uncle, _] = self.uncles.row(self.tree.slot(self.node));
            self.node = grand_uncle;
            self.trail = take(&mut self.trail).shr1().shr1();
        }
    }
}
