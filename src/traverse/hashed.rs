//! Binder & Keller 2016, Algorithm 1: register, uncles, and a table for the rest. Constant time, constant state.

use core::mem::take;

use super::marks::{self, Marks};
use super::register::Register;
use super::{Cursor, Incomplete, Next, Pause, Paused, Unsupported};
use crate::event::State;
use crate::hash::Lookup;
use crate::key::{self, KeyWord, branched};
use crate::order::Descent;
use crate::trail;
use crate::tree::{Node, Recorded, Topology};

/// Goes to the register's node if it is set, otherwise to the node of the key in the table. `[HASHED-1]`
///
/// With [`Disjoint`](super::Disjoint) for `M` it has a second trail, which lets a hit prune the nodes behind it
/// (Section 2.3).
#[derive(Debug)]
pub struct Hashed<'t, W, T, L, M = ()> {
    tree: &'t T,
    lookup: L,
    node: Node,
    key: W,
    trail: W,
    register: Register,
    marks: M,
}

impl<'t, W: KeyWord, T: Topology, L: Lookup<W>, M: Marks<W>> Hashed<'t, W, T, L, M> {
    /// Starts at the root.
    ///
    /// # Errors
    /// [`Unsupported::NoLinks`] if the tree has no uncles, and [`Unsupported::TooDeep`] if the key would lose its
    /// leading one: for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &'t T, lookup: L) -> Result<Self, Unsupported> {
        Unsupported::unless_linked(tree, Recorded::Uncles)?;
        W::carries(tree.depth(), 1)?;
        let register = Register::empty(tree);
        let (key, trail, marks) = (key::root(), W::zero(), M::default());
        Ok(Self { tree, lookup, node: tree.root(), key, trail, register, marks })
    }
}

impl<W: KeyWord, T: Topology, L: Lookup<W>, M: Marks<W>> Cursor for Hashed<'_, W, T, L, M> {
    type Word = W;
    const PRUNES: bool = M::PRUNES;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        State {
            key: Some(self.key.clone()),
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
        self.key = key::child(take(&mut self.key), first.bit());
        self.trail = trail::child(take(&mut self.trail), branched(descent.postpones()));
        self.marks.descend(descent.is_disjoint());
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        if self.trail.is_zero() {
            return false;
        }
        self.register.fill(self.tree, self.node, self.trail.low_bits());
        self.marks.climb(trail::levels(&self.trail));
        (self.key, self.trail) = trail::backtrack(take(&mut self.key), take(&mut self.trail));
        self.node = self.register.take(self.tree).unwrap_or_else(|| self.lookup.node(&self.key));
        true
    }

    #[inline(always)]
    fn prune(&mut self) {
        let trail = marks::prune(self.trail.clone(), &self.marks);
        self.register.prune(self.tree, &self.trail, &trail);
        self.trail = trail;
    }
}

impl<W: KeyWord, T: Topology, L: Lookup<W>, M: Marks<W>> Pause for Hashed<'_, W, T, L, M> {
    fn put_aside(&self, next: Next) -> Paused<W> {
        let (key, disjoint) = (Some(self.key.clone()), self.marks.get());
        Paused {
            node: self.node,
            register: self.register.get(self.tree),
            key,
            trail: self.trail.clone(),
            disjoint,
            next,
        }
    }

    fn take_up(&mut self, paused: Paused<W>) -> Result<(), Incomplete> {
        let key = paused.key.ok_or(Incomplete::Key)?;
        self.register = Register::of(self.tree, paused.register, &paused.trail)?;
        (self.node, self.key, self.trail) = (paused.node, key, paused.trail);
        self.marks.set(paused.disjoint);
        Ok(())
    }
}
