//! A toy traversal for tests/toy/run.sh: key and trail, and a walk from the root to find each node.

use core::mem::take;

use super::Cursor;
use crate::event::State;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Keys, Node, Topology};

/// Finds each node by a walk along its key.
#[derive(Debug)]
pub struct Toy<'t, W, T> {
    tree: &'t T,
    node: Node,
    key: W,
    trail: W,
}

impl<'t, W: KeyWord, T: Topology> Toy<'t, W, T> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] if the depth is not below the number of bits of the word.
    pub fn new(tree: &'t T) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, node: tree.root(), key: key::root(), trail: W::zero() })
    }

    fn load(&mut self) {
        self.node = Keys::walk(self.tree, &self.key).unwrap_or(self.tree.root());
    }
}

impl<W: KeyWord, T: Topology> Cursor for Toy<'_, W, T> {
    type Word = W;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State { key: Some(self.key.clone()), trail: Some(self.trail.clone()), ..State::of(self.node) }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.key = key::child(take(&mut self.key), descent.first().bit());
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        self.load();
        true
    }

    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        (self.key, self.trail) = trail::backtrack(take(&mut self.key), take(&mut self.trail));
        self.load();
        true
    }
}
