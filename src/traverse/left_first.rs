//! Barringer & Akenine-Möller 2013, Algorithm 1: implicit addresses, left before right, nodes tested at their visit.

use super::Cursor;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{KeyWord, TooDeep};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology};

/// The state is two integers, the start of a level and an index in it. `[LEFT-1]`
///
/// The visitor accepts a node with `Both { first: Left }` or rejects it with `Neither`
/// ([`ByNode`](crate::order::ByNode) with [`order::LeftOrder`](crate::order::LeftOrder) does): there are no other
/// descents here.
#[derive(Debug)]
pub struct LeftFirst<W, L> {
    layout: L,
    node: Node,
    level_start: W,
    level_index: W,
}

impl<W: KeyWord, L: Lookup<W>> LeftFirst<W, L> {
    /// Starts at the root of a tree in the given layout.
    ///
    /// # Errors
    /// [`TooDeep`] if `levelStart` would leave its word: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &impl Topology, layout: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { layout, node: tree.root(), level_start: W::one(), level_index: W::zero() })
    }

    #[inline(always)]
    fn load(&mut self) {
        self.node = self.layout.node(&self.level_start.clone().or(&self.level_index));
    }
}

impl<W: KeyWord, L: Lookup<W>> Cursor for LeftFirst<W, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State {
            key: Some(self.level_start.clone().or(&self.level_index)),
            counter: Some(self.level_start.clone().or(&self.level_index)),
            ..State::of(self.node)
        }
    }

    #[inline(always)]
    fn descend(&mut self, _: Descent) -> bool {
        self.level_start = core::mem::take(&mut self.level_start).shl1();
        self.level_index = core::mem::take(&mut self.level_index).shl1();
        self.load();
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let index = core::mem::take(&mut self.level_index).wrapping_add(&W::one());
        let up = trail::levels(&index);
        self.level_start = core::mem::take(&mut self.level_start).shr(up);
        self.level_index = index.shr(up);
        if self.level_start == W::one() {
            return false;
        }
        self.load();
        true
    }
}
