//! Barringer & Akenine-Möller 2013, Algorithm 3: implicit addresses in any order, by an index of the path itself.

use core::mem::take;

use super::Cursor;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// Algorithm 3 as printed: `levelStart`, the counter `levelIndex`, and `levelIndexdynamic`, the path. `[IMPLICIT-2]`
#[derive(Debug)]
pub struct ImplicitB<W, L> {
    layout: L,
    node: Node,
    level_start: W,
    level_index: W,
    dynamic: W,
}

/// Algorithm 3 with `index = levelStart + levelIndexdynamic`, which is the node's key. `[IMPLICIT-3]`
#[derive(Debug)]
pub struct ImplicitB1<W, L> {
    layout: L,
    node: Node,
    level_index: W,
    index: W,
}

impl<W: KeyWord, L: Lookup<W>> ImplicitB<W, L> {
    /// Starts at the root of a tree in the given layout.
    ///
    /// # Errors
    /// [`TooDeep`] if `levelStart` would leave its word: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &impl Topology, layout: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        let (level_start, zero) = (W::one(), W::zero());
        Ok(Self { layout, node: tree.root(), level_start, level_index: zero.clone(), dynamic: zero })
    }

    #[inline]
    fn current_key(&self) -> W {
        self.level_start.clone().or(&self.dynamic)
    }
}

impl<W: KeyWord, L: Lookup<W>> ImplicitB1<W, L> {
    /// Starts at the root of a tree in the given layout.
    ///
    /// # Errors
    /// [`TooDeep`] if the index would leave its word: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &impl Topology, layout: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { layout, node: tree.root(), level_index: W::zero(), index: W::one() })
    }
}

/// Descends one level: the path takes the side, the counter a 1 if a child was rejected.
#[inline]
fn down<W: KeyWord>(path: &mut W, counter: &mut W, descent: Descent) {
    *path = key::child(take(path), descent.first().bit());
    *counter = key::child(take(counter), branched(!descent.postpones()));
}

/// Climbs as far as the counter's increment carries, then goes to the sibling. Returns the number of levels.
///
/// As printed the last step is `x + 1 - 2 (x & 1)`, which is `x ^ 1`.
#[inline]
fn up_and_over<W: KeyWord>(path: &mut W, counter: &mut W) -> u32 {
    let index = take(counter).wrapping_add(&W::one());
    let up = index.trailing_zeros();
    *counter = index.shr(up);
    *path = take(path).shr(up).xor(&W::one());
    up
}

impl<W: KeyWord, L: Lookup<W>> Cursor for ImplicitB<W, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State {
            key: Some(self.current_key()),
            counter: Some(self.level_start.clone().or(&self.level_index)),
            ..State::of(self.node)
        }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.level_start = take(&mut self.level_start).shl1();
        down(&mut self.dynamic, &mut self.level_index, descent);
        self.node = self.layout.node(&self.current_key());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let up = up_and_over(&mut self.dynamic, &mut self.level_index);
        self.level_start = take(&mut self.level_start).shr(up);
        if self.level_start == W::one() {
            return false;
        }
        self.node = self.layout.node(&self.current_key());
        true
    }
}

impl<W: KeyWord, L: Lookup<W>> Cursor for ImplicitB1<W, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State { key: Some(self.index.clone()), ..State::of(self.node) }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        down(&mut self.index, &mut self.level_index, descent);
        self.node = self.layout.node(&self.index);
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        up_and_over(&mut self.index, &mut self.level_index);
        // At the end the climb reaches the root's key, 1, and the last step makes it 0.
        if self.index.is_zero() {
            return false;
        }
        self.node = self.layout.node(&self.index);
        true
    }
}
