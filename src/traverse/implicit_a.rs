//! Barringer & Akenine-Möller 2013, Algorithm 2: implicit addresses in any order, by a swap mask.

use core::mem::take;

use super::Cursor;
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::swap;
use crate::tree::{Node, Topology};

/// Algorithm 2 as printed: `levelStart`, `levelIndex` of a left-first traversal, and the mask of swapped levels.
/// `[IMPLICIT-1]`
#[derive(Debug)]
pub struct ImplicitA<W, L> {
    layout: L,
    node: Node,
    level_start: W,
    level_index: W,
    swap_mask: W,
}

/// Algorithm 2 with the combined index: `index = levelStart + levelIndex` in one word. `[IMPLICIT-3]`
///
/// At the terminal carry the index has one more bit than the key: it carries one edge less than the other forms.
#[derive(Debug)]
pub struct ImplicitA1<W, L> {
    layout: L,
    node: Node,
    index: W,
    swap_mask: W,
}

impl<W: KeyWord, L: Lookup<W>> ImplicitA<W, L> {
    /// Starts at the root of a tree in the given layout.
    ///
    /// # Errors
    /// [`TooDeep`] if `levelStart` would leave its word: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &impl Topology, layout: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        let (level_start, zero) = (W::one(), W::zero());
        Ok(Self { layout, node: tree.root(), level_start, level_index: zero.clone(), swap_mask: zero })
    }

    #[inline]
    fn current_key(&self) -> W {
        self.level_start.clone().or(&swap::fcomp(self.level_index.clone(), &self.swap_mask))
    }
}

impl<W: KeyWord, L: Lookup<W>> ImplicitA1<W, L> {
    /// Starts at the root of a tree in the given layout.
    ///
    /// # Errors
    /// [`TooDeep`] if the combined index would wrap: for trees deeper than the bits of the word, less two.
    #[inline]
    pub fn new(tree: &impl Topology, layout: L) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 2)?;
        Ok(Self { layout, node: tree.root(), index: W::one(), swap_mask: W::zero() })
    }
}

/// Returns the mask's new bit: whether the children are swapped.
///
/// If both are wanted, they are swapped if the right one comes first. If one is wanted, the index counts it as the
/// second, so they are swapped if it is the left one. (Printed: set if "right child first", toggled if one is rejected,
/// where a rejected left child must count as right first; spec/DEPARTURES.md, D-10.)
#[inline]
fn mask_bit<W: KeyWord>(descent: Descent) -> W {
    descent.first().bit::<W>().xor(&branched(!descent.postpones()))
}

impl<W: KeyWord, L: Lookup<W>> Cursor for ImplicitA<W, L> {
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
        self.level_index = take(&mut self.level_index).shl1().or(&branched(!descent.postpones()));
        self.swap_mask = take(&mut self.swap_mask).shl1().or(&mask_bit(descent));
        self.node = self.layout.node(&self.current_key());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let index = take(&mut self.level_index).wrapping_add(&W::one());
        let up = index.trailing_zeros();
        self.level_start = take(&mut self.level_start).shr(up);
        self.level_index = index.shr(up);
        self.swap_mask = take(&mut self.swap_mask).shr(up);
        if self.level_start == W::one() {
            return false;
        }
        self.node = self.layout.node(&self.current_key());
        true
    }
}

impl<W: KeyWord, L: Lookup<W>> Cursor for ImplicitA1<W, L> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State {
            key: Some(swap::fcomp(self.index.clone(), &self.swap_mask)),
            counter: Some(self.index.clone()),
            ..State::of(self.node)
        }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.index = take(&mut self.index).shl1().or(&branched(!descent.postpones()));
        self.swap_mask = take(&mut self.swap_mask).shl1().or(&mask_bit(descent));
        self.node = self.layout.node(&swap::fcomp(self.index.clone(), &self.swap_mask));
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let index = take(&mut self.index).wrapping_add(&W::one());
        let up = index.trailing_zeros();
        self.index = index.shr(up);
        self.swap_mask = take(&mut self.swap_mask).shr(up);
        if self.index == W::one() {
            return false;
        }
        self.node = self.layout.node(&swap::fcomp(self.index.clone(), &self.swap_mask));
        true
    }
}
