//! Keys of any length as 64 bits.

use alloc::vec;

use super::mix;
use crate::key::{KeyWord, PIECE};
use crate::tree::{Node, Topology};

/// A key as 64 bits: itself if it has no more, else a seeded fold of its 63-bit pieces from the root down, and of
/// its length.
#[inline]
pub(crate) fn fold<W: KeyWord>(key: &W, seed: u64) -> u64 {
    key.to_u64().unwrap_or_else(|| {
        let pieces = (0..key.piece_count()).fold(seed, |folded, i| add_piece(folded, key.piece(i)));
        add_length(pieces, key.bit_length())
    })
}

/// Calls `f` with the folded key of each node: [`fold`] of all keys, in linear time at any depth.
pub(crate) fn for_each_folded_key(tree: &impl Topology, seed: u64, mut f: impl FnMut(u64, Node)) {
    let mut pending = vec![Path { node: tree.root(), low: 1, piece: 1, depth: 0, above: seed }];
    while let Some(path) = pending.pop() {
        let folded = if path.depth < u64::BITS {
            path.low
        } else {
            add_length(add_piece(path.above, path.piece), path.depth + 1)
        };
        f(folded, path.node);
        if !path.node.is_leaf() {
            let [left, right] = tree.children(path.node);
            pending.extend([path.child(left, 0), path.child(right, 1)]);
        }
    }
}

/// A node on the way down, with what folds its key.
struct Path {
    node: Node,
    /// The lowest 64 bits of the key.
    low: u64,
    /// The last piece of the key.
    piece: u64,
    depth: u32,
    /// Fold of the pieces before the last.
    above: u64,
}

impl Path {
    const fn child(&self, node: Node, right: u64) -> Self {
        let (low, depth) = (self.low << 1 | right, self.depth + 1);
        if depth.is_multiple_of(PIECE) {
            Self { node, low, piece: right, depth, above: add_piece(self.above, self.piece) }
        } else {
            Self { node, low, piece: self.piece << 1 | right, depth, above: self.above }
        }
    }
}

const fn add_piece(folded: u64, piece: u64) -> u64 {
    mix(folded ^ piece)
}

const fn add_length(folded: u64, bits: u32) -> u64 {
    mix(folded ^ bits as u64)
}
