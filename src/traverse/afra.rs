//! Áfra & Szirmay-Kalos 2014: a bit trail, and a climb along parent and sibling references.

use super::marks::{self, Marks};
use super::{Cursor, Incomplete, Next, Pause, Paused};
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, ParentLinks, Topology};

/// Climbs while bit 0 of the trail is clear, then goes to the sibling; done when the trail is 0. `[AFRA-1]`
///
/// With [`Disjoint`](super::Disjoint) for `M` it carries a second trail, by which a hit ends what lies behind it (Binder &
/// Keller 2016, Section 2.3).
#[derive(Debug)]
pub struct Afra<'t, W, T, P, M = ()> {
    tree: &'t T,
    parents: P,
    node: Node,
    trail: W,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, P: ParentLinks<T>, M: Marks<W>> Afra<'t, W, T, P, M> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`TooDeep`] beyond as many edges as the word has bits.
    #[inline]
    pub fn new(tree: &'t T, parents: P) -> Result<Self, TooDeep> {
        W::carries(tree.depth(), 0)?;
        Ok(Self { tree, parents, node: tree.root(), trail: W::zero(), marks: M::default() })
    }
}

impl<W: KeyWord, T, P, M: Marks<W>> State for Afra<'_, W, T, P, M> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }

    fn disjoint(&self) -> Option<W> {
        self.marks.get()
    }
}

impl<W: KeyWord, T: Topology, P: ParentLinks<T>, M: Marks<W>> Cursor for Afra<'_, W, T, P, M> {
    const PRUNES: bool = M::PRUNES;

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.node = self.tree.child(self.node, descent.first());
        self.trail = trail::child(core::mem::take(&mut self.trail), branched(descent.postpones()));
        self.marks.descend(descent.is_disjoint());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        let up = trail::levels(&self.trail);
        for _ in 0..up {
            self.node = self.parents.parent(self.tree, self.node);
        }
        self.marks.climb(up);
        self.node = self.parents.sibling(self.tree, self.node);
        self.trail = trail::leave(core::mem::take(&mut self.trail));
        true
    }

    #[inline(always)]
    fn prune(&mut self) {
        self.trail = marks::prune(core::mem::take(&mut self.trail), &self.marks);
    }
}

impl<W: KeyWord, T: Topology, P: ParentLinks<T>, M: Marks<W>> Pause for Afra<'_, W, T, P, M> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let (trail, disjoint) = (self.trail.clone(), self.marks.get());
        Paused { node: self.node, register: None, key: None, trail, disjoint, next }
    }

    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        (self.node, self.trail) = (paused.node, paused.trail);
        self.marks.set(paused.disjoint);
        Ok(())
    }
}
