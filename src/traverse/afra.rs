//! Áfra & Szirmay-Kalos 2014: a bit trail, and a climb along parent and sibling references.

use super::marks::{self, Marks};
use super::{Cursor, Incomplete, Next, Pause, Paused, Unsupported};
use crate::event::State;
use crate::key::{KeyWord, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Recorded, Topology};

/// Climbs while bit 0 of the trail is clear, then goes to the sibling; done when the trail is 0. `[AFRA-1]`
///
/// With [`Disjoint`](super::Disjoint) for `M` it has a second trail, which lets a hit prune the nodes behind it (Binder
/// & Keller 2016, Section 2.3).
#[derive(Debug)]
pub struct Afra<'t, W, T, M = ()> {
    tree: &'t T,
    node: Node,
    trail: W,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, M: Marks<W>> Afra<'t, W, T, M> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`Unsupported::NoLinks`] if the tree has no parents and siblings, and [`Unsupported::TooDeep`] for trees deeper
    /// than the bits of the word.
    #[inline]
    pub fn new(tree: &'t T) -> Result<Self, Unsupported> {
        Unsupported::unless_linked(tree, Recorded::ParentSibling)?;
        W::carries(tree.depth(), 0)?;
        Ok(Self { tree, node: tree.root(), trail: W::zero(), marks: M::default() })
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Cursor for Afra<'_, W, T, M> {
    type Word = W;
    const PRUNES: bool = M::PRUNES;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State { trail: Some(self.trail.clone()), disjoint: self.marks.get(), ..State::of(self.node) }
    }

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
            self.node = self.tree.parent(self.node);
        }
        self.marks.climb(up);
        self.node = self.tree.sibling(self.node);
        self.trail = trail::leave(core::mem::take(&mut self.trail));
        true
    }

    #[inline(always)]
    fn prune(&mut self) {
        self.trail = marks::prune(core::mem::take(&mut self.trail), &self.marks);
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Pause for Afra<'_, W, T, M> {
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
