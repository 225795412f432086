//! Binder & Keller 2016, Section 2.2.1: register and uncles, and a climb by two levels a step instead of a hash.

use core::mem::take;

use super::Cursor;
use super::register::Register;
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology, UncleLinks};

/// Goes to the register's node where it is set, else climbs along grand uncles, which stand in for the grandparents:
/// they have the same uncles.
#[derive(Debug)]
pub struct Uncle<'t, W, T, U> {
    tree: &'t T,
    uncles: U,
    node: Node,
    trail: W,
    register: Register,
}

impl<'t, W: KeyWord, T: Topology, U: UncleLinks<T>> Uncle<'t, W, T, U> {
    /// Starts at the root. Every record names the grand uncle for the climb, however far it reaches for the register.
    ///
    /// # Errors
    /// [`TooDeep`] beyond as many edges as the word has bits.
    #[inline]
    pub fn new(tree: &'t T, uncles: U) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 0)?;
        Ok(Self { tree, uncles, node: tree.root(), trail: W::zero(), register: Register::empty(tree) })
    }
}

impl<W: KeyWord, T: Topology, U> State for Uncle<'_, W, T, U> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }

    fn register(&self) -> Option<Node> {
        self.register.get(self.tree)
    }
}

impl<W: KeyWord, T: Topology, U: UncleLinks<T>> Cursor for Uncle<'_, W, T, U> {
    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        if descent.postpones() {
            self.register.set(self.tree.child(self.node, first.other()));
        } else {
            self.register.keep(&self.uncles, self.tree, self.node, self.trail.low_bits());
        }
        self.node = self.tree.child(self.node, first);
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        // Over right records the register is filled before the trail runs out; over wrong ones this still ends.
        while !self.trail.is_zero() {
            self.register.fill(&self.uncles, self.tree, self.node, self.trail.low_bits());
            if let Some(next) = self.register.take(self.tree) {
                self.node = next;
                self.trail = trail::leave(take(&mut self.trail));
                return true;
            }
            // Neither uncle nor grand uncle is pending: two levels up.
            let [_, grand_uncle, _] = self.uncles.row(self.tree, self.node);
            self.node = grand_uncle;
            self.trail = take(&mut self.trail).shr1().shr1();
        }
        false
    }
}
