//! The key of every node of a tree, in space linear in the number of nodes at any depth.

use alloc::vec;
use alloc::vec::Vec;

use super::{Node, Topology, for_each_parent};
use crate::key::{self, KeyWord, PIECE, Side};

/// Maps nodes to keys, for every word, to check that address and key stay consistent.
///
/// A key is divided into pieces of 63 bits from the root down. A row holds the last piece of its node's key and the
/// ancestor at which the previous piece is complete. Keys of up to 63 bits need one row.
#[derive(Clone, Debug)]
pub struct Keys {
    rows: Vec<Row>,
}

#[derive(Clone, Copy, Debug)]
struct Row {
    piece: u64,
    depth: u32,
    above: u32,
}

impl Keys {
    /// Computes the keys of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        let root = Row { piece: 1, depth: 0, above: 0 };
        let mut rows = vec![root; tree.node_count()];
        for_each_parent(tree, |parent, children| {
            let slot = tree.slot(parent);
            let row = rows[slot];
            let depth = row.depth + 1;
            for (right, child) in (0..).zip(children) {
                rows[tree.slot(child)] = if depth.is_multiple_of(PIECE) {
                    Row { piece: right, depth, above: slot as u32 }
                } else {
                    Row { piece: row.piece << 1 | right, depth, above: row.above }
                };
            }
        });
        Self { rows }
    }

    /// Returns the memory of the rows, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }

    /// Returns the depth, in edges, of the node with this slot.
    #[inline]
    pub fn depth(&self, slot: usize) -> u32 {
        self.rows[slot].depth
    }

    /// Returns whether `key` is the key of the node with this slot.
    #[inline]
    pub fn is(&self, slot: usize, key: &impl KeyWord) -> bool {
        let row = self.rows[slot];
        if row.depth < PIECE { key.to_u64() == Some(row.piece) } else { self.is_long(row, key) }
    }

    fn is_long(&self, mut row: Row, key: &impl KeyWord) -> bool {
        if key::depth(key) != row.depth {
            return false;
        }
        loop {
            let index = row.depth / PIECE;
            if key.piece(index) != row.piece {
                return false;
            }
            if index == 0 {
                return true;
            }
            row = self.rows[row.above as usize];
        }
    }

    /// Returns the key of the node with this slot, in a word that carries its depth (otherwise its low bits).
    pub fn key<W: KeyWord>(&self, slot: usize) -> W {
        let mut row = self.rows[slot];
        let mut pieces = vec![row];
        while row.depth >= PIECE {
            row = self.rows[row.above as usize];
            pieces.push(row);
        }
        let mut key = W::zero();
        for (i, row) in pieces.iter().rev().enumerate() {
            for bit in (0..=row.depth - i as u32 * PIECE).rev() {
                key = key::child(key, W::from_bit(row.piece >> bit & 1 == 1));
            }
        }
        key
    }

    /// Finds the node with this key: walks down from the root by the key's bits. `None` if there is none.
    pub fn walk<W: KeyWord>(tree: &impl Topology, key: &W) -> Option<Node> {
        let length = key.bit_length();
        let mut node = tree.root();
        for level in 1..length {
            if node.is_leaf() {
                return None;
            }
            let (piece, bit) = (level / PIECE, level % PIECE);
            let bits = PIECE.min(length - piece * PIECE);
            let side = Side::right_if(key.piece(piece) >> (bits - 1 - bit) & 1 == 1);
            node = tree.children(node)[side.index()];
        }
        (length > 0).then_some(node)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Family;
    use crate::key::{Grow, Word};
    use crate::tree::Tree;

    /// Returns a comb that changes sides at every third level.
    fn comb(depth: u32) -> Tree {
        Family::comb(depth, |i| (i / 3).is_multiple_of(2))
    }

    #[test]
    fn keys_and_walks_agree_at_every_depth() {
        for depth in [0, 1, 61, 62, 63, 64, 126, 127, 200] {
            let tree = comb(depth);
            let keys = Keys::of(&tree);
            for slot in 0..tree.node_count() {
                let node = tree.node(slot as u32).unwrap();
                let key: Grow = keys.key(slot);
                assert!(keys.is(slot, &key), "{depth} {slot}");
                assert_eq!(key::depth(&key), keys.depth(slot));
                assert_eq!(Keys::walk(&tree, &key), Some(node));
                if slot > 0 {
                    assert!(!keys.is(slot, &key::sibling(key.clone())));
                    assert!(!keys.is(slot, &key::parent(key.clone())));
                }
                if keys.depth(slot) < 128 {
                    let wide: u128 = keys.key(slot);
                    assert!(keys.is(slot, &wide));
                    assert!((0..3).all(|i| wide.piece(i) == key.piece(i)));
                }
            }
        }
    }

    #[test]
    fn walks_end_where_the_tree_does() {
        let tree = comb(2);
        assert_eq!(Keys::walk(&tree, &0_u32), None);
        assert_eq!(Keys::walk(&tree, &1_u32), Some(tree.root()));
        let beyond: Vec<_> = (2..32_u32).filter(|key| Keys::walk(&tree, key).is_some()).collect();
        assert_eq!(beyond.len(), 4);
    }

    #[test]
    fn a_bit_in_any_piece_makes_another_key() {
        let tree = comb(200);
        let keys = Keys::of(&tree);
        assert_eq!(keys.bytes(), 16 * tree.node_count());
        let slot = tree.node_count() - 1;
        let key: Grow = keys.key(slot);
        for bit in 0..200 {
            let flipped = (0..bit).fold(Grow::one(), |word, _| word.shl1()).xor(&key);
            assert!(!keys.is(slot, &flipped), "{bit}");
        }
        assert!(keys.is(slot, &key) && !keys.is(slot, &0_u32));
    }
}
