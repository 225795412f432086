//! Binder & Keller 2016, Section 2.2.1: register and uncles, and a climb by two levels a step instead of a hash.

use core::mem::take;

use super::marks::{self, Marks};
use super::register::Register;
use super::{Cursor, Incomplete, Next, Pause, Paused};
use crate::event::State;
use crate::key::{KeyWord, TooDeep, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Topology, UncleLinks};

/// Goes to the register's node where it is set, else climbs along grand uncles, which stand in for the grandparents:
/// they have the same uncles. `[UNCLE-2]`
///
/// With [`Disjoint`](super::Disjoint) for `M` it carries a second trail, by which a hit ends what lies behind it.
#[derive(Debug)]
pub struct Uncle<'t, W, T, U, M = ()> {
    tree: &'t T,
    uncles: U,
    node: Node,
    trail: W,
    register: Register,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, U: UncleLinks<T>, M: Marks<W>> Uncle<'t, W, T, U, M> {
    /// Starts at the root. Records that name no grand uncle do not compile: the climb by two levels would pass over it.
    ///
    /// # Errors
    /// [`TooDeep`] beyond as many edges as the word has bits.
    #[inline]
    pub fn new(tree: &'t T, uncles: U) -> Result<Self, TooDeep> {
        const { assert!(U::REACH.of(false) >= 2 && U::REACH.of(true) >= 2, "the climb needs grand uncles") };
        W::carries(tree.depth(), 0)?;
        let (register, marks) = (Register::empty(tree), M::default());
        Ok(Self { tree, uncles, node: tree.root(), trail: W::zero(), register, marks })
    }
}

impl<W: KeyWord, T: Topology, U, M: Marks<W>> State for Uncle<'_, W, T, U, M> {
    type Word = W;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn trail(&self) -> Option<W> {
        Some(self.trail.clone())
    }

    fn register(&self) -> Option<Node> {
        self.register.get(self.tree)
    }

    fn disjoint(&self) -> Option<W> {
        self.marks.get()
    }
}

impl<W: KeyWord, T: Topology, U: UncleLinks<T>, M: Marks<W>> Cursor for Uncle<'_, W, T, U, M> {
    const PRUNES: bool = M::PRUNES;

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        if descent.postpones() {
            self.register.set(self.tree.child(self.node, first.other()));
        } else {
            self.register.keep(&self.uncles, self.tree, self.node, self.trail.low_bits());
        }
        self.node = self.tree.child(self.node, first);
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        self.marks.descend(descent.is_disjoint());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        // Over right records the register is filled before the trail runs out; over wrong ones this still ends.
        while !self.trail.is_zero() {
            self.register.fill(&self.uncles, self.tree, self.node, self.trail.low_bits());
            if let Some(next) = self.register.take(self.tree) {
                self.node = next;
                self.marks.climb(trail::levels(&self.trail));
                self.trail = trail::leave(take(&mut self.trail));
                return true;
            }
            // Neither uncle nor grand uncle is pending: two levels up.
            let [_, grand_uncle, _] = self.uncles.row(self.tree, self.node);
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

impl<W: KeyWord, T: Topology, U: UncleLinks<T>, M: Marks<W>> Pause for Uncle<'_, W, T, U, M> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let (trail, disjoint) = (self.trail.clone(), self.marks.get());
        Paused { node: self.node, register: self.register(), key: None, trail, disjoint, next }
    }

    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        self.register = Register::of(self.tree, paused.register, &paused.trail)?;
        (self.node, self.trail) = (paused.node, paused.trail);
        self.marks.set(paused.disjoint);
        Ok(())
    }
}
