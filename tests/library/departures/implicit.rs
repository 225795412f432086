//! Algorithm 2 of Barringer & Akenine-Möller 2013 in 8-bit words, with natural readings of its unspecified parts.

use stackless_bvh::generate::Tape;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Keys, Node, Topology, Tree};

/// A reading of Algorithm 2 of Barringer & Akenine-Möller 2013.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// The mask's bit is set for "right child first" and toggled if one child is rejected.
    MaskOfRejected,
    /// Start and index of the level are in one word.
    Combined,
    /// A tree of any depth.
    AnyDepth,
}

/// `levelStart`, `levelIndex` and `swapMask`, in words of eight bits.
pub(super) struct Implicit<'t> {
    tree: &'t Tree,
    tape: &'t Tape,
    reading: Reading,
    node: Node,
    level_start: u8,
    level_index: u8,
    swap_mask: u8,
}

impl<'t> Implicit<'t> {
    pub(super) fn new(tree: &'t Tree, tape: &'t Tape, reading: Reading) -> Self {
        let (level_start, level_index) = if reading == Reading::Combined { (0, 1) } else { (1, 0) };
        Self { tree, tape, reading, node: tree.root(), level_start, level_index, swap_mask: 0 }
    }

    fn load(&mut self) {
        let key = u64::from(self.level_start | (self.level_index ^ self.swap_mask));
        self.node = Keys::walk(self.tree, &key).unwrap_or(self.tree.root());
    }
}

impl Cursor for Implicit<'_> {
    type Word = u64;

    fn node(&self) -> Node {
        self.node
    }

    fn descend(&mut self, descent: Descent) -> bool {
        let right_first = match self.reading {
            Reading::MaskOfRejected => self.tape.cells()[self.tree.slot(self.node)].right_first,
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
        // Like processors, shifts by the lowest bits of the number.
        self.level_start = self.level_start.wrapping_shr(up);
        self.level_index = self.level_index.wrapping_shr(up);
        self.swap_mask = self.swap_mask.wrapping_shr(up);
        let is_done = match self.reading {
            Reading::Combined => self.level_index == 1,
            // It is never 1 again once it has left the word. At 0 no address can be computed.
            _ => self.level_start <= 1,
        };
        if !is_done {
            self.load();
        }
        !is_done
    }
}
