//! Barringer & Akenine-Möller 2013, Algorithm 4: the counter, and a climb along parent references.

use super::marks::Marks;
use super::{Cursor, Incomplete, Next, Pause, Paused, Unsupported};
use crate::event::State;
use crate::key::{self, KeyWord, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Recorded, Topology};

/// Counts as if every left child came first; the carries of the increment determine the number of levels to climb.
/// `[SPARSE-1]`
///
/// As printed the counter `levelIndex` overflows its level at the end, and the climb continues to the root, whose
/// sibling is itself. Here the word also has the start of the level, as in Section 2.2 for implicit trees: the
/// traversal ends where `levelStart + levelIndex` is all ones, without the climb (spec/DEPARTURES.md, D-9).
///
/// With [`Disjoint`](super::Disjoint) for `M` it has a second trail, which lets a hit prune the nodes behind it (Binder
/// & Keller 2016, Section 2.3). A pruned node counts as done.
#[derive(Debug)]
pub struct Sparse<'t, W, T, M = ()> {
    tree: &'t T,
    node: Node,
    /// `levelStart + levelIndex`.
    index: W,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, M: Marks<W>> Sparse<'t, W, T, M> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`Unsupported::NoLinks`] if the tree has no parents and siblings, and [`Unsupported::TooDeep`] if the counter
    /// would leave its word: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &'t T) -> Result<Self, Unsupported> {
        Unsupported::unless_linked(tree, Recorded::ParentSibling)?;
        W::carries(tree.depth(), 1)?;
        Ok(Self { tree, node: tree.root(), index: W::one(), marks: M::default() })
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Cursor for Sparse<'_, W, T, M> {
    type Word = W;
    const PRUNES: bool = M::PRUNES;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State { counter: Some(self.index.clone()), disjoint: self.marks.get(), ..State::of(self.node) }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        self.node = self.tree.child(self.node, descent.first());
        let rejected_one = branched(!descent.postpones());
        self.index = core::mem::take(&mut self.index).shl1().or(&rejected_one);
        self.marks.descend(descent.is_disjoint());
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
            self.node = self.tree.parent(self.node);
        }
        self.index = index.shr(up);
        self.marks.climb(up);
        self.node = self.tree.sibling(self.node);
        true
    }

    #[inline(always)]
    fn prune(&mut self) {
        if let Some(disjoint) = self.marks.get() {
            self.index = core::mem::take(&mut self.index).or(&disjoint);
        }
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Pause for Sparse<'_, W, T, M> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let start = key::level_start(&self.index);
        let trail = trail::counter(self.index.clone().xor(&start), start);
        Paused { node: self.node, register: None, key: None, trail, disjoint: self.marks.get(), next }
    }

    /// Climbs to the root to count the levels.
    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        let (mut start, mut ancestor) = (W::one(), paused.node);
        while ancestor != self.tree.root() {
            ancestor = self.tree.parent(ancestor);
            start = start.shl1();
        }
        self.index = trail::counter(paused.trail, start.clone()).or(&start);
        self.node = paused.node;
        self.marks.set(paused.disjoint);
        Ok(())
    }
}
