//! Binder & Keller 2016, Section 2.2, without register and uncles: every backtrack queries the table.

use core::mem::take;

use super::{Cursor, Incomplete, Next, Pause, Paused};
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology};

/// Finds children by their parent's record, and postponed nodes by their key. "In principle hashing node keys is
/// sufficient for traversal": this is the principle, which needs the keys of all nodes. `[HASHONLY-1]`
#[derive(Debug)]
pub struct HashOnly<'t, W, T, L> {
    tree: &'t T,
    lookup: L,
    node: Node,
    key: W,
    trail: W,
}

impl<'t, W: KeyWord, T: Topology, L: Lookup<W>> HashOnly<'t, W, T, L> {
    /// Starts at the root. The table must have the keys of all nodes but the root.
    ///
    /// # Errors
    /// [`TooDeep`] if the key would lose its leading one: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &'t T, lookup: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, lookup, node: tree.root(), key: key::root(), trail: W::zero() })
    }
}

impl<W: KeyWord, T: Topology, L: Lookup<W>> Cursor for HashOnly<'_, W, T, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State { key: Some(self.key.clone()), trail: Some(self.trail.clone()), ..State::of(self.node) }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
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
        (self.key, self.trail) = trail::backtrack(take(&mut self.key), take(&mut self.trail));
        self.node = self.lookup.node(&self.key);
        true
    }
}

impl<W: KeyWord, T: Topology, L: Lookup<W>> Pause for HashOnly<'_, W, T, L> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let (key, trail) = (Some(self.key.clone()), self.trail.clone());
        Paused { node: self.node, register: None, key, trail, disjoint: None, next }
    }

    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        self.key = paused.key.ok_or(Incomplete::Key)?;
        (self.node, self.trail) = (paused.node, paused.trail);
        Ok(())
    }
}
