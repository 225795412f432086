//! Algorithm 1 of Binder & Keller 2016 with the second trail of Section 2.3 and the resuming of Section 2.4, as one would
//! write it from the paper, and the mistakes that it invites.

use stackless_bvh::event::State;
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Keys, Node, Reach, Topology, Tree, Uncles};

/// A mistake in [`Printed`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slip {
    /// None: the control.
    None,
    /// The register is filled from the leaf's record before the mask is applied.
    FillBeforeMask,
    /// The register keeps a node that the mask has taken from the trail.
    RegisterKept,
    /// The register is emptied after every hit: the sibling, which no record names, is lost.
    RegisterLost,
    /// The mask is taken for what its name says.
    MaskInverted,
    /// The mask does not move with the trail on a descent.
    MaskNotShifted,
    /// The mask does not move with the trail on backtracking.
    MaskLeftBehind,
    /// The register is filled after resuming though the sibling is postponed, which comes before the uncle.
    NoGuard,
}

/// Key, trail, mask, register and address of one node; the table has only the keys that Algorithm 1 asks for.
pub(super) struct Printed<'t> {
    tree: &'t Tree,
    uncles: Uncles,
    keys: Keys,
    /// None, if there is no table for the tree: then no key is found.
    table: Option<PerfectHash>,
    slip: Slip,
    /// Put aside and taken up by key and trail alone before each step; then the table must have all keys.
    resumes: bool,
    node: Node,
    key: u64,
    trail: u64,
    /// 1: not disjoint.
    mask: u64,
    register: Option<Node>,
}

impl<'t> Printed<'t> {
    pub(super) fn new(tree: &'t Tree, resumes: bool, slip: Slip) -> Self {
        let key_set = if resumes { KeySet::All } else { KeySet::Exact(Reach::ALGORITHM_1) };
        let table = PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).ok();
        let (uncles, keys) = (Uncles::of(tree), Keys::of(tree));
        Self { tree, uncles, keys, table, slip, resumes, node: tree.root(), key: 1, trail: 0, mask: 0, register: None }
    }

    fn load(&mut self) {
        if self.resumes {
            self.register = None;
            if self.trail & 1 == 1 && self.slip != Slip::NoGuard {
                return;
            }
        }
        if self.register.is_none() && self.trail & 6 != 0 {
            let [uncle, grand_uncle, _] = self.uncles.row(self.tree, self.node);
            self.register = Some(if self.trail & 2 != 0 { uncle } else { grand_uncle });
        }
    }
}

impl Cursor for Printed<'_> {
    type Word = u64;
    const PRUNES: bool = true;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<u64> {
        State { key: Some(self.key), ..State::of(self.node()) }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.load();
        let [near, far] = [descent.first(), descent.first().other()].map(|side| self.tree.child(self.node, side));
        if descent.postpones() {
            self.register = Some(far);
        }
        self.node = near;
        self.key = self.key << 1 | u64::from(descent.first().is_right());
        self.trail = self.trail << 1 | u64::from(descent.postpones());
        let overlap = u64::from(descent.is_disjoint() == (self.slip == Slip::MaskInverted));
        self.mask = if self.slip == Slip::MaskNotShifted { self.mask | overlap } else { self.mask << 1 | overlap };
        true
    }

    fn prune(&mut self) {
        if self.slip == Slip::FillBeforeMask {
            if self.trail & self.trail.wrapping_neg() & self.mask == 0 {
                self.register = None;
            }
            self.load();
            self.trail &= self.mask;
            return;
        }
        let is_lowest_gone = self.trail & self.trail.wrapping_neg() & self.mask == 0;
        if (is_lowest_gone && self.slip != Slip::RegisterKept) || self.slip == Slip::RegisterLost {
            self.register = None;
        }
        self.trail &= self.mask;
    }

    fn backtrack(&mut self) -> bool {
        if self.trail == 0 {
            return false;
        }
        self.load();
        let levels = self.trail.trailing_zeros();
        self.trail = self.trail >> levels ^ 1;
        self.key = self.key >> levels ^ 1;
        if self.slip != Slip::MaskLeftBehind {
            self.mask >>= levels;
        }
        let asked = |key: &u64| {
            let found = self
                .table
                .as_ref()
                .and_then(|table| table.probe(key))
                .filter(|&node| self.keys.is(self.tree.slot(node), key));
            // Another node, as a table answers that does not have the key.
            found.unwrap_or(self.tree.root())
        };
        self.node = self.register.take().unwrap_or_else(|| asked(&self.key));
        true
    }
}
