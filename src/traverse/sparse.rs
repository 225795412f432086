//! Barringer & Akenine-Möller 2013, Algorithm 4: the counter, and a climb along parent references.

use super::Cursor;
use crate::event::State;
use crate::key::{KeyWord, TooDeep};
use crate::order::Descent;
use crate::tree::{Node, Parents, Topology};

/// Counts as if every left child came first; the carries of the increment say how far to climb.
///
/// At the end the counter overflows its level, and the climb reaches the root, whose sibling is itself.
#[derive(Debug)]
pub struct Sparse<'t, W, T> {
    tree: &'t T,
    parents: &'t Parents,
    node: Node,
    level_index: W,
}

impl<'t, W: KeyWord, T: Topology> Sparse<'t, W, T> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] where the counter could overflow its word: beyond as many edges as the word has bits, less one.
    #[inline]
    pub fn new(tree: &'t T, parents: &'t Parents) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, parents, node: tree.root(), level_index: W::zero() })
    }
}

impl<W: KeyWord, T> State for Sparse<'_, W, T> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn counter(&self) -> Option<W> {
        Some(self.level_index.clone())
    }
}

impl<W: KeyWord, T: Topology> Cursor for Sparse<'_, W, T> {
    #[inline]
    fn descend(&mut self, descent: Descent) -> bool {
        let Some(first) = descent.first() else { return false };
        self.node = self.tree.children(self.node)[first.index()];
        let rejected_one = W::from_bit(!descent.postpones());
        self.level_index = core::mem::take(&mut self.level_index).shl1().or(&rejected_one);
        true
    }

    #[inline]
    fn backtrack(&mut self) -> bool {
        let index = core::mem::take(&mut self.level_index).wrapping_add(&W::one());
        let up = index.trailing_zeros();
        for _ in 0..up {
            self.node = self.parents.parent(self.tree.slot(self.node));
        }
        self.level_index = index.shr(up);
        self.node = self.parents.sibling(self.tree.slot(self.node));
        self.node != self.tree.root()
    }
}
