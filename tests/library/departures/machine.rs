//! Algorithm 1 of Binder & Keller 2016 by key, trail and register, with one slip of its text at a time.

use stackless_bvh::event::State;
use stackless_bvh::generate::Tape;
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Keys, Node, Reach, Topology, Tree, Uncles};

/// Printed errors, and wrong readings of unspecified parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slip {
    /// `closest` is computed from missed boxes too.
    ClosestOfMissed,
    /// The last `else` belongs to the nearest `if`.
    DanglingElse,
    /// `done` is -1, which is also the address of the first leaf.
    DoneIsMinusOne,
    /// A tree of any depth, in words of 8 bits.
    AnyDepth,
    /// The second trail of Section 2.3 is read as its name suggests.
    MaskInverted,
    /// The register is filled from the leaf's record before the mask is applied.
    FillBeforeMask,
    /// The search is paused before each step and resumed from key and trail alone, as in Section 2.4. The register is
    /// then filled although the sibling is postponed, which comes before the uncle.
    NoGuard,
}

/// Key, trail, mask, register and address of one node. With `PRUNES`, it uses the mask.
pub(super) struct Machine<'t, const PRUNES: bool> {
    tree: &'t Tree,
    tape: &'t Tape,
    slip: Slip,
    uncles: Uncles,
    /// By slot: whether the table has the key.
    known: Vec<bool>,
    node: Node,
    key: u64,
    trail: u64,
    /// 1: not disjoint.
    mask: u64,
    register: Option<Node>,
}

impl<'t, const PRUNES: bool> Machine<'t, PRUNES> {
    pub(super) fn new(tree: &'t Tree, tape: &'t Tape, slip: Slip) -> Self {
        let has_all_keys = !PRUNES || slip == Slip::NoGuard;
        let key_set = if has_all_keys { KeySet::All } else { KeySet::Exact(Reach::ALGORITHM_1) };
        Self {
            tree,
            tape,
            slip,
            uncles: Uncles::of(tree),
            known: key_set.slots(tree),
            node: tree.root(),
            key: 1,
            trail: 0,
            mask: 0,
            register: None,
        }
    }

    /// Fills the register from the node's record.
    fn load(&mut self) {
        if self.slip == Slip::NoGuard {
            self.register = None;
        }
        if self.register.is_none() && self.trail & 6 != 0 {
            let [uncle, grand_uncle, _] = self.uncles.row(self.tree, self.node);
            self.register = Some(if self.trail & 2 != 0 { uncle } else { grand_uncle });
        }
    }

    /// Returns the node of the key, or the root if the table lacks it.
    fn look_up(&self) -> Node {
        let found = Keys::walk(self.tree, &self.key).filter(|&node| self.known[self.tree.slot(node)]);
        let found = found.unwrap_or(self.tree.root());
        if self.slip != Slip::DanglingElse {
            return found;
        }
        let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::PrintedHashed };
        let is_direct = PerfectHash::build(self.tree, options).is_ok_and(|table| table.is_direct(&self.key));
        match (is_direct, found.is_leaf()) {
            // d < 0 and an inner node: as intended.
            (true, false) => found,
            // d < 0 and a leaf: continues with the other table, with the leaf as a displacement.
            (true, true) => self.tree.root(),
            // Not direct: nothing happens, and the address does not change.
            (false, _) => self.node,
        }
    }

    fn is_first_leaf(&self) -> bool {
        let mut nodes = (0..self.tree.node_count() as u32).filter_map(|index| self.tree.node(index));
        nodes.find(|node| node.is_leaf()) == Some(self.node)
    }
}

impl<const PRUNES: bool> Cursor for Machine<'_, PRUNES> {
    type Word = u64;
    const PRUNES: bool = PRUNES;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<u64> {
        State { key: Some(self.key), trail: (!PRUNES).then_some(self.trail), ..State::of(self.node) }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.load();
        let (slip, both) = (self.slip, descent.postpones());
        let is_right_closer = self.tape.cells()[self.tree.slot(self.node)].right_first;
        // "if not hitL or closest = R": right whenever the right box is closer, hit or not.
        let goes_right = slip == Slip::ClosestOfMissed && !both && is_right_closer;
        let first = if goes_right { Side::Right } else { descent.first() };
        let [near, far] = [first, first.other()].map(|side| self.tree.child(self.node, side));
        if both {
            self.register = Some(far);
        }
        let bits = if slip == Slip::AnyDepth { 0xff } else { u64::MAX };
        self.node = near;
        self.key = (self.key << 1 | u64::from(first.is_right())) & bits;
        self.trail = (self.trail << 1 | u64::from(both)) & bits;
        self.mask = self.mask << 1 | u64::from(descent.is_disjoint() == (slip == Slip::MaskInverted));
        true
    }

    fn prune(&mut self) {
        if self.trail & self.trail.wrapping_neg() & self.mask == 0 {
            self.register = None;
        }
        if self.slip == Slip::FillBeforeMask {
            self.load();
        }
        self.trail &= self.mask;
    }

    fn backtrack(&mut self) -> bool {
        self.load();
        if self.trail == 0 {
            return false;
        }
        let levels = self.trail.trailing_zeros();
        self.key = self.key >> levels ^ 1;
        self.trail = self.trail >> levels ^ 1;
        self.mask >>= levels;
        self.node = self.register.take().unwrap_or_else(|| self.look_up());
        self.slip != Slip::DoneIsMinusOne || !self.is_first_leaf()
    }
}
