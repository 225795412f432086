//! Folds of keys of any length to 64 bits.

use alloc::vec;

use super::mix;
use crate::key::{KeyWord, PIECE};
use crate::tree::{Node, Topology};

/// Returns a key as 64 bits. A longer key becomes a seeded fold of its 63-bit pieces from the root down, and of its
/// length.
#[inline]
pub fn fold<W: KeyWord>(key: &W, seed: u64) -> u64 {
    key.to_u64().unwrap_or_else(|| {
        let pieces = (0..key.piece_count()).fold(seed, |folded, i| add_piece(folded, key.piece(i)));
        add_length(pieces, key.bit_length())
    })
}

/// Calls `f` with the folded key of each node: [`fold`] of all keys, in linear time at any depth.
pub fn for_each_folded_key(tree: &impl Topology, seed: u64, mut f: impl FnMut(u64, Node)) {
    let mut pending = vec![(tree.root(), Path::root(seed))];
    while let Some((node, path)) = pending.pop() {
        f(path.key(), node);
        if !node.is_leaf() {
            let [left, right] = tree.children(node);
            pending.extend([(left, path.child(0)), (right, path.child(1))]);
        }
    }
}

/// The state that a walk carries down to compute the key of each node.
pub(super) trait Step: Copy {
    /// Returns the state of the left child (0) or the right one (1).
    #[must_use]
    fn child(self, right: u64) -> Self;
    /// Returns the folded key of the node.
    fn key(self) -> u64;
}

/// For walks without keys.
impl Step for () {
    fn child(self, _: u64) -> Self {}

    fn key(self) -> u64 {
        0
    }
}

/// The key itself, in trees of up to 63 edges.
impl Step for u64 {
    #[inline]
    fn child(self, right: u64) -> Self {
        self << 1 | right
    }

    #[inline]
    fn key(self) -> u64 {
        self
    }
}

/// The state of the fold of a node's key, at any depth.
#[derive(Clone, Copy)]
pub(super) struct Path {
    /// The lowest 64 bits of the key.
    low: u64,
    /// The last piece of the key.
    piece: u64,
    depth: u32,
    /// Fold of the pieces before the last.
    above: u64,
}

impl Path {
    pub(super) const fn root(seed: u64) -> Self {
        Self { low: 1, piece: 1, depth: 0, above: seed }
    }
}

impl Step for Path {
    fn child(self, right: u64) -> Self {
        let (low, depth) = (self.low << 1 | right, self.depth + 1);
        if depth.is_multiple_of(PIECE) {
            Self { low, piece: right, depth, above: add_piece(self.above, self.piece) }
        } else {
            Self { low, piece: self.piece << 1 | right, depth, above: self.above }
        }
    }

    fn key(self) -> u64 {
        if self.depth < u64::BITS { self.low } else { add_length(add_piece(self.above, self.piece), self.depth + 1) }
    }
}

const fn add_piece(folded: u64, piece: u64) -> u64 {
    mix(folded ^ piece)
}

const fn add_length(folded: u64, bits: u32) -> u64 {
    mix(folded ^ bits as u64)
}
