//! Binder & Keller 2016, Algorithm 1: register, uncles, and a table for the rest. Constant time, constant state.

use core::mem::take;

use super::Cursor;
use super::register::Register;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology, UncleLinks};

/// Goes to the register's node where it is set, else to the one that the table has for the key.
#[derive(Debug)]
pub struct Hashed<'t, W, T, U, L> {
    tree: &'t T,
    uncles: U,
    lookup: L,
    node: Node,
    key: W,
    trail: W,
    register: Register,
}

impl<'t, W: KeyWord, T: Topology, U: UncleLinks<T>, L: Lookup<W>> Hashed<'t, W, T, U, L> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] where the key would lose its leading one: beyond as many edges as the word has bits, less one.
    #[inline]
    pub fn new(tree: &'t T, uncles: U, lookup: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        let register = Register::empty(tree);
        Ok(Self { tree, uncles, lookup, node: tree.root(), key: key::root(), trail: W::zero(), register })
    }
}

impl<W: KeyWord, T: Topology, U, L> State for Hashed<'_, W, T, U, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn key(&self) -> Option<W> {
        Some(self.key.clone())
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }

    fn register(&self) -> Option<Node> {
        self.register.get(self.tree)
    }
}

impl<W: KeyWord, T: Topology, U: UncleLinks<T>, L: Lookup<W>> Cursor for Hashed<'_, W, T, U, L> {
    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        if descent.postpones() {
            self.register.set(self.tree.child(self.node, first.other()));
        } else {
            self.register.keep(&self.uncles, self.tree, self.node, self.trail.low_bits());
        }
        self.node = self.tree.child(self.node, first);
        self.key = key::child(take(&mut self.key), first.bit());
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        self.register.fill(&self.uncles, self.tree, self.node, self.trail.low_bits());
        (self.key, self.trail) = trail::backtrack(take(&mut self.key), take(&mut self.trail));
        self.node = self.register.take(self.tree).unwrap_or_else(|| self.lookup.node(&self.key));
        true
    }
}
