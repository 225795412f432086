//! The printed algorithms over narrow words, with what is wrong or left open in them as one would read it.

use stackless_bvh::event::State;
use stackless_bvh::generate::Tape;
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Keys, Node, Reach, Topology, Tree, Uncles};

/// A reading of Algorithm 1 of Binder & Keller 2016.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binder {
    /// `closest` is computed from missed boxes too.
    ClosestOfMissed,
    /// The last `else` belongs to the nearest `if`.
    DanglingElse,
    /// `done` is -1, which is also the address of the first leaf.
    DoneIsMinusOne,
    /// A tree of any depth.
    AnyDepth,
}

/// Key, trail and register, the key and the trail in `bits` bits.
pub(super) struct BinderPrinted<'t> {
    tree: &'t Tree,
    tape: &'t Tape,
    reading: Binder,
    bits: u32,
    uncles: Uncles,
    /// None, if there is no table for the tree.
    table: Option<PerfectHash>,
    node: Node,
    key: u64,
    trail: u64,
    register: Option<Node>,
}

impl<'t> BinderPrinted<'t> {
    pub(super) fn new(tree: &'t Tree, tape: &'t Tape, reading: Binder, bits: u32) -> Self {
        let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::PrintedHashed };
        let table = PerfectHash::build(tree, options).ok();
        let (uncles, node) = (Uncles::of(tree), tree.root());
        Self { tree, tape, reading, bits, uncles, table, node, key: 1, trail: 0, register: None }
    }

    fn cut(&self, word: u64) -> u64 {
        word & (u64::MAX >> (64 - self.bits))
    }

    fn load(&mut self) {
        if self.register.is_none() && self.trail & 6 != 0 {
            let [uncle, grand_uncle, _] = self.uncles.row(self.tree, self.node);
            self.register = Some(if self.trail & 2 != 0 { uncle } else { grand_uncle });
        }
    }

    fn first_leaf(&self) -> Option<Node> {
        (0..self.tree.node_count() as u32).filter_map(|index| self.tree.node(index)).find(|node| node.is_leaf())
    }

    fn look_up(&self) -> Node {
        let found = Keys::walk(self.tree, &self.key).unwrap_or(self.tree.root());
        if self.reading != Binder::DanglingElse {
            return found;
        }
        match (self.table.as_ref().is_some_and(|table| table.is_direct(&self.key)), found.is_leaf()) {
            // d < 0 and an inner node: as meant.
            (true, false) => found,
            // d < 0 and a leaf: on to the other table, with the leaf for a displacement.
            (true, true) => self.tree.root(),
            // Not direct: nothing is done, and the address stays what it was.
            (false, _) => self.node,
        }
    }
}

impl Cursor for BinderPrinted<'_> {
    type Word = u64;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<u64> {
        State { key: Some(self.key), trail: Some(self.trail), ..State::of(self.node()) }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.load();
        let closest = Side::right_if(self.tape.cells()[self.tree.slot(self.node)].right_first);
        let first = match self.reading {
            // "if not hitL or closest = R": right whenever the right box is closer, hit or not.
            Binder::ClosestOfMissed if !descent.postpones() && closest.is_right() => Side::Right,
            _ => descent.first(),
        };
        if descent.postpones() {
            self.register = Some(self.tree.child(self.node, first.other()));
        }
        self.node = self.tree.child(self.node, first);
        self.key = self.cut(self.key << 1 | u64::from(first.is_right()));
        self.trail = self.cut(self.trail << 1 | u64::from(descent.postpones()));
        true
    }

    fn backtrack(&mut self) -> bool {
        self.load();
        if self.trail == 0 {
            return false;
        }
        let levels = self.trail.trailing_zeros();
        self.trail = self.trail >> levels ^ 1;
        self.key = self.key >> levels ^ 1;
        self.node = self.register.take().unwrap_or_else(|| self.look_up());
        self.reading != Binder::DoneIsMinusOne || Some(self.node) != self.first_leaf()
    }
}

/// A reading of Algorithm 2 of Barringer & Akenine-Möller 2013.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Barringer {
    /// The mask's bit is set for "right child first" and toggled where one child is rejected.
    MaskOfRejected,
    /// Start and index of the level in one word.
    Combined,
    /// A tree of any depth.
    AnyDepth,
}

/// `levelStart`, `levelIndex` and `swapMask`, in words of eight bits.
pub(super) struct BarringerPrinted<'t> {
    tree: &'t Tree,
    tape: &'t Tape,
    reading: Barringer,
    node: Node,
    level_start: u8,
    level_index: u8,
    swap_mask: u8,
}

impl<'t> BarringerPrinted<'t> {
    pub(super) fn new(tree: &'t Tree, tape: &'t Tape, reading: Barringer) -> Self {
        let (level_start, level_index) = if reading == Barringer::Combined { (0, 1) } else { (1, 0) };
        Self { tree, tape, reading, node: tree.root(), level_start, level_index, swap_mask: 0 }
    }

    fn load(&mut self) {
        let key = u64::from(self.level_start | (self.level_index ^ self.swap_mask));
        self.node = Keys::walk(self.tree, &key).unwrap_or(self.tree.root());
    }
}

impl Cursor for BarringerPrinted<'_> {
    type Word = u64;

    fn node(&self) -> Node {
        self.node
    }

    fn descend(&mut self, descent: Descent) -> bool {
        let right_first = match self.reading {
            Barringer::MaskOfRejected => self.tape.cells()[self.tree.slot(self.node)].right_first,
            _ => descent.first().is_right(),
        };
        let rejected = !descent.postpones();
        self.level_start <<= 1;
        self.level_index = self.level_index << 1 | u8::from(rejected);
        self.swap_mask = self.swap_mask << 1 | u8::from(right_first != rejected);
        self.load();
        true
    }

    fn backtrack(&mut self) -> bool {
        self.level_index = self.level_index.wrapping_add(1);
        let up = self.level_index.trailing_zeros();
        // As processors shift: by the lowest bits of the number.
        self.level_start = self.level_start.wrapping_shr(up);
        self.level_index = self.level_index.wrapping_shr(up);
        self.swap_mask = self.swap_mask.wrapping_shr(up);
        let is_done = match self.reading {
            Barringer::Combined => self.level_index == 1,
            // It never is 1 again once it has left the word: then, at 0, nothing can be addressed any more.
            _ => self.level_start <= 1,
        };
        if !is_done {
            self.load();
        }
        !is_done
    }
}
