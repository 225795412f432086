//! Binder & Keller 2016, Section 2.2.1: register and uncles, and a climb of two levels per step instead of a hash.

use core::mem::take;

use super::marks::{self, Marks};
use super::register::Register;
use super::{Cursor, Incomplete, Next, Pause, Paused, Unsupported};
use crate::event::State;
use crate::key::{KeyWord, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Recorded, Topology};

/// Goes to the register's node if it is set. Otherwise it climbs along grand uncles, which represent the grandparents
/// because they have the same uncles. `[UNCLE-2]`
///
/// With [`Disjoint`](super::Disjoint) for `M` it has a second trail, which lets a hit prune the nodes behind it.
#[derive(Debug)]
pub struct Uncle<'t, W, T, M = ()> {
    tree: &'t T,
    node: Node,
    trail: W,
    register: Register,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, M: Marks<W>> Uncle<'t, W, T, M> {
    /// Starts at the root. Records without a grand uncle do not compile: the climb by two levels would pass over it.
    ///
    /// # Errors
    /// [`Unsupported::NoLinks`] if the tree has no uncles, and [`Unsupported::TooDeep`] for trees deeper than the bits
    /// of the word.
    #[inline]
    pub fn new(tree: &'t T) -> Result<Self, Unsupported> {
        const { assert!(T::REACH.of(false) >= 2 && T::REACH.of(true) >= 2, "the climb needs grand uncles") };
        Unsupported::unless_linked(tree, Recorded::Uncles)?;
        W::carries(tree.depth(), 0)?;
        let (register, marks) = (Register::empty(tree), M::default());
        Ok(Self { tree, node: tree.root(), trail: W::zero(), register, marks })
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Cursor for Uncle<'_, W, T, M> {
    type Word = W;
    const PRUNES: bool = M::PRUNES;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State {
            trail: Some(self.trail.clone()),
            register: self.register.get(self.tree),
            disjoint: self.marks.get(),
            ..State::of(self.node)
        }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        if descent.postpones() {
            self.register.set(self.tree.child(self.node, first.other()));
        } else {
            self.register.keep(self.tree, self.node, self.trail.low_bits());
        }
        self.node = self.tree.child(self.node, first);
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        self.marks.descend(descent.is_disjoint());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        // With correct records the register is filled before the trail runs out; with wrong records this loop still
        // ends.
        while !self.trail.is_zero() {
            self.register.fill(self.tree, self.node, self.trail.low_bits());
            if let Some(next) = self.register.take(self.tree) {
                self.node = next;
                self.marks.climb(trail::levels(&self.trail));
                self.trail = trail::leave(take(&mut self.trail));
                return true;
            }
            // Neither uncle nor grand uncle is pending: two levels up.
            let [_, grand_uncle, _] = self.tree.uncles(self.node);
            self.node = grand_uncle;
            self.trail = take(&mut self.trail).shr1().shr1();
            self.marks.climb(2);
        }
        false
    }

    #[inline(always)]
    fn prune(&mut self) {
        let trail = marks::prune(self.trail.clone(), &self.marks);
        self.register.prune(self.tree, &self.trail, &trail);
        self.trail = trail;
    }
}

impl<W: KeyWord, T: Topology, M: Marks<W>> Pause for Uncle<'_, W, T, M> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let (trail, disjoint) = (self.trail.clone(), self.marks.get());
        Paused { node: self.node, register: self.register.get(self.tree), key: None, trail, disjoint, next }
    }

    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        self.register = Register::of(self.tree, paused.register, &paused.trail)?;
        (self.node, self.trail) = (paused.node, paused.trail);
        self.marks.set(paused.disjoint);
        Ok(())
    }
}
