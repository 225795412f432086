//! Binder & Keller 2016, Algorithm 1: register, uncles, and a table for the rest. Constant time, constant state.

use core::mem::take;

use super::Cursor;
use super::register::Register;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, TooDeep};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology, Uncles};

/// Goes to the register's node where it is set, else to the one that the table has for the key.
#[derive(Debug)]
pub struct Hashed<'t, W, T, L> {
    tree: &'t T,
    uncles: &'t Uncles,
    lookup: L,
    node: Node,
    key: W,
    trail: W,
    register: Register,
}

impl<'t, W: KeyWord, T: Topology, L: Lookup<W>> Hashed<'t, W, T, L> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] where the key would lose its leading one: beyond as many edges as the word has bits, less one.
    #[inline]
    pub fn new(tree: &'t T, uncles: &'t Uncles, lookup: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        let register = Register::default();
        Ok(Self { tree, uncles, lookup, node: tree.root(), key: key::root(), trail: W::zero(), register })
    }

    /// The printed algorithm fills the register when it loads a record. Here it is filled when the visit is over,
    /// which gives the same value (the trail is still that of the visit) and saves it where the visit overwrites it.
    #[inline]
    fn fill_register(&mut self) {
        self.register.fill(self.uncles, self.node, self.tree.slot(self.node), self.trail.low_bits());
    }
}

impl<W: KeyWord, T, L> State for Hashed<'_, W, T, L> {
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
        self.register.0
    }
}

impl<W: KeyWord, T: Topology, L: Lookup<W>> Cursor for Hashed<'_, W, T, L> {
    #[inline]
    fn descend(&mut self, descent: Descent) -> bool {
        let Some(first) = descent.first() else { return false };
        let children = self.tree.children(self.node);
        if !descent.postpones() {
            self.fill_register();
        }
        self.register.postpone(descent, children);
        self.node = children[first.index()];
        self.key = key::child(take(&mut self.key), W::from_bit(first.is_right()));
        self.trail = trail::child(take(&mut self.trail), W::from_bit(descent.postpones()));
        true
    }

    #[inline]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        self.fill_register();
        (self.key, self.trail) = trail::backtrack(take(&mut self.key), take(&mut self.trail));
        self.node = self.register.0.take().unwrap_or_else(|| self.lookup.node(&self.key));
        true
    }
}
