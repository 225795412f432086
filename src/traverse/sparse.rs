//! Barringer & Akenine-Möller 2013, Algorithm 4: the counter, and a climb along parent references.

use super::Cursor;
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::tree::{Node, Parents, Topology};

/// Counts as if every left child came first; the carries of the increment say how far to climb.
///
/// As printed the counter `levelIndex` overflows its level at the end, and the climb goes on to the root, whose sibling
/// is itself. Here the start of the level is kept in the same word, as Section 2.2 does for implicit trees: the end is
/// where `levelStart + levelIndex` is all ones, and is seen without the climb (spec/DEPARTURES.md, D-9).
#[derive(Debug)]
pub struct Sparse<'t, W, T> {
    tree: &'t T,
    parents: &'t Parents,
    node: Node,
    /// `levelStart + levelIndex`.
    index: W,
}

impl<'t, W: KeyWord, T: Topology> Sparse<'t, W, T> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] where the counter would leave its word: beyond as many edges as the word has bits, less one.
    #[inline]
    pub fn new(tree: &'t T, parents: &'t Parents) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, parents, node: tree.root(), index: W::one() })
    }
}

impl<W: KeyWord, T> State for Sparse<'_, W, T> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn counter(&self) -> Option<W> {
        Some(self.index.clone())
    }
}

impl<W: KeyWord, T: Topology> Cursor for Sparse<'_, W, T> {
    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.node = self.tree.child(self.node, descent.first());
        let rejected_one = branched(!descent.postpones());
        self.index = core::mem::take(&mut self.index).shl1().or(&rejected_one);
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        let index = core::mem::take(&mut self.index);
        if index.is_all_ones() {
            return false;
        }
        let index = index.wrapping_add(&W::one());
        let up = index.trailing_zeros();
        for _ in 0..up {
            self.node = self.parents.parent(self.tree, self.node);
        }
        self.index = index.shr(up);
        self.node = self.parents.sibling(self.tree, self.node);
        true
    }
}
