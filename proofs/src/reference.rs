//! The reference of a traversal: only the postponed nodes, one per level.
//!
//! It is the oracle's recursion with explicit activations, as bounded proofs need it. The tests of this package compare
//! it with [`oracle`](stackless_bvh::oracle).

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Descent, FixedOrder, Flow, Pruned, Pruning, Side, Visitor};
use stackless_bvh::tree::{Node, Topology};

use crate::harness::claim;
use crate::shape::{Script, Shape};

/// A tree of a [`Shape`] with the keys of its nodes.
pub trait Keyed: Topology {
    /// Returns the key of a node.
    fn key(&self, node: Node) -> u32;
}

impl Keyed for Shape {
    fn key(&self, node: Node) -> u32 {
        node.index() as u32
    }
}

/// The search of a script.
#[derive(Clone, Copy, Debug)]
pub struct ScriptedSearch<'t, T> {
    /// The tree.
    pub tree: &'t T,
    /// The decisions.
    pub script: Script,
    /// The twin's mistake: inner nodes with this key or a greater one want no child.
    pub silent_from: u32,
}

impl<T: Keyed> Visitor for ScriptedSearch<'_, T> {
    fn inner(&mut self, node: Node) -> Descent {
        let key = self.tree.key(node);
        if key < self.silent_from { self.script.descent(key) } else { Descent::NEITHER }
    }

    fn leaf(&mut self, node: Node) -> Flow {
        if self.script.ends(self.tree.key(node)) { Flow::Stop } else { Flow::Continue }
    }
}

impl<T: Keyed> Pruned for ScriptedSearch<'_, T> {
    fn allows(&self, pruning: Pruning) -> bool {
        pruning != Pruning::Distance
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let disjoint = self.script.is_disjoint(self.tree.key(node));
        self.inner(node).disjoint_if(disjoint)
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.script.finds(self.tree.key(leaf))
    }
}

impl<T: Keyed> FixedOrder for ScriptedSearch<'_, T> {
    fn first(&self, node: Node) -> Side {
        self.script.first(self.tree.key(node))
    }
}

/// The reference: a key, and the postponed nodes by depth.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    script: Script,
    pruning: Pruning,
    key: u32,
    /// Byte `d`: the key of the postponed node at depth `d`, 0 for none.
    pending: u64,
    /// Byte `d`: ones if it is disjoint from its sibling.
    disjoint: u64,
    is_done: bool,
}

impl Reference {
    /// Starts at the root.
    pub const fn new(script: Script, pruning: Pruning) -> Self {
        Self { script, pruning, key: 1, pending: 0, disjoint: 0, is_done: false }
    }

    /// Returns the key of the next node; `None` at the end.
    pub fn key(&self) -> Option<u32> {
        (!self.is_done).then_some(self.key)
    }

    /// Returns the depth of that node.
    fn depth(&self) -> u32 {
        self.key.ilog2()
    }

    /// Returns the most recently postponed node, which is the deepest.
    fn postponed(&self) -> Option<u32> {
        let depth = self.pending.checked_ilog2()? / 8;
        Some((self.pending >> (8 * depth)) as u32 & 0xff)
    }

    /// Returns a trail: a bit for each level, from the node up, set if the byte of `bytes` is not 0. `[TRAIL-1]`
    fn bits_of(&self, bytes: u64) -> u32 {
        let bit = |depth: u32| u32::from(bytes >> (8 * depth) & 0xff != 0);
        // There is no loop here, so the only nested loops of a proof are those of the cursors.
        const { assert!(Shape::LIMIT == 5) };
        let bits = bit(1) << 4 | bit(2) << 3 | bit(3) << 2 | bit(4) << 1 | bit(5);
        // Nothing is postponed below the node.
        bits >> (Shape::LIMIT - self.depth())
    }

    /// Advances to the next node. `[ORACLE-1]` `[ORACLE-2]`
    pub fn advance(&mut self, is_leaf: bool) {
        if is_leaf {
            if self.pruning == Pruning::Disjoint && self.script.finds(self.key) {
                self.pending &= !self.disjoint;
            }
            if self.script.ends(self.key) {
                self.is_done = true;
                return;
            }
        } else {
            let descent = self.script.descent(self.key);
            if !descent.is_neither() {
                let byte = 8 * (self.depth() + 1);
                let first = 2 * self.key + u32::from(descent.first().is_right());
                let is_disjoint = self.script.is_disjoint(self.key);
                self.pending |= if descent.postpones() { u64::from(first ^ 1) << byte } else { 0 };
                self.disjoint = self.disjoint & !(0xff << byte) | if is_disjoint { 0xff << byte } else { 0 };
                self.key = first;
                return;
            }
        }
        match self.postponed() {
            Some(key) => {
                self.key = key;
                self.pending &= !(0xff << (8 * key.ilog2()));
            }
            None => self.is_done = true,
        }
    }
}

/// Compares the visible state of a traversal with the reference, visit by visit. `[TRACE-1]`
#[derive(Debug)]
pub struct Watch<'t, T> {
    tree: &'t T,
    /// The reference.
    pub reference: Reference,
    /// Visits so far.
    pub visits: u32,
    /// The longest backtrack so far, in levels.
    pub longest: u32,
    /// The least depth that a restart may visit next.
    restarted: u32,
}

impl<'t, T: Keyed> Watch<'t, T> {
    /// Starts before the first visit.
    pub const fn new(tree: &'t T, script: Script, pruning: Pruning) -> Self {
        Self { tree, reference: Reference::new(script, pruning), visits: 0, longest: 0, restarted: 0 }
    }

    /// Checks a node on the way down after a restart: it must be above the next node, and below the previous one.
    fn pass(&mut self, key: u32) {
        assert!(!self.reference.is_done);
        let (depth, to) = (key.ilog2(), self.reference.depth());
        claim!(self.restarted <= depth && depth < to && self.reference.key >> (to - depth) == key);
        self.restarted = depth + 1;
    }
}

impl<T: Keyed> Recorder for Watch<'_, T> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let (state, reference) = (state(), &self.reference);
        let key = self.tree.key(node);
        if state.is_restarting {
            self.pass(key);
            return Flow::Continue;
        }
        claim!(reference.key() == Some(key));
        let trail = || reference.bits_of(reference.pending);
        if let Some(shown) = state.key {
            assert!(shown.to_u64() == Some(u64::from(key)));
        }
        if let Some(shown) = state.trail {
            assert!(shown.to_u64() == Some(u64::from(trail())));
        }
        if let Some(shown) = state.counter {
            let start = 1 << reference.depth();
            assert!(shown.to_u64() == Some(u64::from(start | (start - 1) ^ trail())));
        }
        if let Some(shown) = state.disjoint {
            assert!(shown.low_bits() & trail() == reference.bits_of(reference.disjoint) & trail());
        }
        if let Some(shown) = state.register {
            assert!(reference.postponed() == Some(self.tree.key(shown)));
        }
        (self.visits, self.restarted) = (self.visits + 1, 0);
        let from = reference.depth();
        self.reference.advance(node.is_leaf());
        if !self.reference.is_done {
            self.longest = self.longest.max(from.saturating_sub(self.reference.depth()));
        }
        Flow::Continue
    }
}
