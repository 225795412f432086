//! The plain map: open addressing, linear probing.

use alloc::vec;
use alloc::vec::Vec;

use super::fold::{fold, for_each_folded_key};
use super::{Lookup, mix};
use crate::key::KeyWord;
use crate::tree::{Node, Topology};

/// An ordinary hash table from keys to addresses, for comparison with the perfect hash.
///
/// Keys of up to 64 bits are stored directly. Longer keys are stored as a 64-bit fold, under a seed for which the folds
/// of this tree's keys all differ; the construction searches for such a seed.
#[derive(Clone, Debug)]
pub struct KeyMap {
    /// A folded key and the bits of its node plus one, or 0 in an empty cell.
    cells: Vec<(u64, u32)>,
    seed: u64,
}

impl KeyMap {
    /// Builds the map of all nodes of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        let mut seed = 0;
        loop {
            // Among n keys, two folds are equal with probability n^2 / 2^65: a second seed does not occur in practice.
            if let Some(map) = Self::with_seed(tree, mix(seed)) {
                return map;
            }
            seed += 1;
        }
    }

    /// Returns `None` if two keys fold to the same value.
    fn with_seed(tree: &impl Topology, seed: u64) -> Option<Self> {
        let size = (2 * tree.node_count() + 1).next_power_of_two();
        let mut map = Self { cells: vec![(0, 0); size], seed };
        let mut distinct = true;
        for_each_folded_key(tree, seed, |key, node| distinct &= map.insert(key, node).is_some());
        distinct.then_some(map)
    }

    /// Returns `None` if the key is already present.
    fn insert(&mut self, folded: u64, node: Node) -> Option<()> {
        let mask = self.cells.len() - 1;
        let mut at = mix(folded) as usize & mask;
        while self.cells[at].1 != 0 {
            if self.cells[at].0 == folded {
                return None;
            }
            at = (at + 1) & mask;
        }
        self.cells[at] = (folded, node.to_bits() + 1);
        Some(())
    }

    /// Returns the memory of the cells, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.cells)
    }

    /// Returns the node with this key, if the tree has one.
    #[inline]
    pub fn get<W: KeyWord>(&self, key: &W) -> Option<Node> {
        let folded = fold(key, self.seed);
        let mask = self.cells.len() - 1;
        let mut at = mix(folded) as usize & mask;
        loop {
            match self.cells[at] {
                (_, 0) => return None,
                (stored, bits) if stored == folded => return Some(Node::from_bits(bits - 1)),
                _ => at = (at + 1) & mask,
            }
        }
    }
}

impl<W: KeyWord> Lookup<W> for KeyMap {
    /// Every node of the tree is present; for a key of no node the answer is meaningless (and a panic in debug builds).
    #[inline]
    fn node(&self, key: &W) -> Node {
        let node = self.get(key);
        debug_assert!(node.is_some(), "no node has the key {key:?}");
        node.unwrap_or(Node::inner(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Family;
    use crate::key::{self, Grow, Word};
    use crate::tree::{Keys, Tree};

    #[test]
    fn every_node_is_found_and_nothing_else() {
        for depth in [0, 1, 2, 31, 62, 63, 64, 65, 126, 127, 500] {
            let tree = Family::comb(depth, |i| i % 5 < 2);
            let (map, keys) = (KeyMap::of(&tree), Keys::of(&tree));
            for slot in 0..tree.node_count() {
                let node = tree.node(slot as u32);
                let key: Grow = keys.key(slot);
                assert_eq!(map.get(&key), node, "depth {depth}, slot {slot}");
                if keys.depth(slot) < 128 {
                    assert_eq!(map.get(&keys.key::<u128>(slot)), node);
                }
                if keys.depth(slot) < 64 {
                    assert_eq!(map.get(&keys.key::<u64>(slot)), node);
                }
                if node.is_some_and(Node::is_leaf) {
                    assert_eq!(map.get(&key::child(key, Grow::zero())), None);
                }
            }
            assert_eq!(map.get(&0_u32), None);
        }
    }

    #[test]
    fn at_least_half_of_the_cells_are_empty() {
        let bytes = |leaves: u32| {
            let inner = |i: u32| Some([2 * i + 1, 2 * i + 2]);
            let children: Vec<_> = (1..leaves).map(|i| inner(i - 1)).chain((0..leaves).map(|_| None)).collect();
            KeyMap::of(&Tree::new(&children).unwrap()).bytes()
        };
        // The power of two above twice the number of nodes, 16 bytes each.
        assert_eq!([1, 2, 3, 8].map(bytes), [4, 8, 16, 32].map(|cells| 16 * cells));
    }
}
