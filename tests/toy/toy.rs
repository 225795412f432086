//! A toy that nobody needs: key and trail, and every node found by walking down from the root.

use core::mem::take;

use super::Cursor;
use crate::event::State;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Keys, Node, Topology};

/// Finds every node by a walk along its key.
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
    /// [`TooDeep`] beyond as many edges as the word has bits, less one.
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
