//! Key and trail, and only a table from keys to addresses: backtracking in constant time.

use super::Cursor;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology};

/// Finds every node, including children, by its key.
///
/// With [`Complete`](super::Complete) this is the constant-time traversal of complete trees (Binder & Keller 2016,
/// Section 1.1), with [`Glassner`](super::Glassner) the traversal by hashed paths of Glassner (1984).
#[derive(Debug)]
pub struct ByKey<W, L> {
    lookup: L,
    node: Node,
    key: W,
    trail: W,
}

impl<W: KeyWord, L: Lookup<W>> ByKey<W, L> {
    /// Starts at the root of the table's tree.
    ///
    /// # Errors
    /// [`TooDeep`] if the key would lose its leading one: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &impl Topology, lookup: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { lookup, node: tree.root(), key: key::root(), trail: W::zero() })
    }
}

impl<W: KeyWord, L: Lookup<W>> Cursor for ByKey<W, L> {
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
        self.key = key::child(core::mem::take(&mut self.key), first.bit());
        self.trail = trail::child(core::mem::take(&mut self.trail), branched(descent.postpones()));
        self.node = self.lookup.node(&self.key);
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        let (key, trail) = (core::mem::take(&mut self.key), core::mem::take(&mut self.trail));
        (self.key, self.trail) = trail::backtrack(key, trail);
        self.node = self.lookup.node(&self.key);
        true
    }
}
