//! Barringer & Akenine-Möller 2013, Algorithm 4: the counter, and a climb along parent references.

use super::Cursor;
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::tree::{Node, ParentLinks, Topology};

/// Counts as if every left child came first; the carries of the increment say how far to climb.
///
/// As printed the counter `levelIndex` overflows its level at the end, and the climb goes on to the root, whose sibling
/// is itself. Here the start of the level is kept in the same word, as Section 2.2 does for implicit trees: the end is
/// where `levelStart + levelIndex` is all ones, and is seen without the climb (spec/DEPARTURES.md, D-9).
#[derive(Debug)]
pub struct Sparse<'t, W, T, P> {
    tree: &'t T,
    parents: P,
    node: Node,
    /// `levelStart + levelIndex`.
    index: W,
}

impl<'t, W: KeyWord, T: Topology, P: ParentLinks<T>> Sparse<'t, W, T, P> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] where the counter would leave its word: beyond as many edges as the word has bits, less one.
    #[inline]
    pub fn new(tree: &'t T, parents: P) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, parents, node: tree.root(), index: W::one() })
    }
}

impl<W: KeyWord, T, P> State for Sparse<'_, W, T, P> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn counter(&self) -> Option<W> {
        Some(self.index.clone())
    }
}

impl<W: KeyWord, T: Topology, P: ParentLinks<T>> Cursor for Sparse<'_, W, T, P> {
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
