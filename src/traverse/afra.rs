//! Áfra & Szirmay-Kalos 2014: a bit trail, and a climb along parent and sibling references.

use super::Cursor;
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, ParentLinks, Topology};

/// Climbs while bit 0 of the trail is clear, then goes to the sibling; done when the trail is 0.
#[derive(Debug)]
pub struct Afra<'t, W, T, P> {
    tree: &'t T,
    parents: P,
    node: Node,
    trail: W,
}

impl<'t, W: KeyWord, T: Topology, P: ParentLinks<T>> Afra<'t, W, T, P> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] beyond as many edges as the word has bits.
    #[inline]
    pub fn new(tree: &'t T, parents: P) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 0)?;
        Ok(Self { tree, parents, node: tree.root(), trail: W::zero() })
    }
}

impl<W: KeyWord, T, P> State for Afra<'_, W, T, P> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }
}

impl<W: KeyWord, T: Topology, P: ParentLinks<T>> Cursor for Afra<'_, W, T, P> {
    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.node = self.tree.child(self.node, descent.first());
        self.trail = trail::child(core::mem::take(&mut self.trail), branched(descent.postpones()));
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        for _ in 0..trail::levels(&self.trail) {
            self.node = self.parents.parent(self.tree, self.node);
        }
        self.node = self.parents.sibling(self.tree, self.node);
        self.trail = trail::leave(core::mem::take(&mut self.trail));
        true
    }
}
