//! Glassner 1984: nodes are found by hashing their path; stored keys and chains resolve collisions.

use alloc::vec;
use alloc::vec::Vec;

use crate::hash::{Lookup, fold, for_each_folded_key};
use crate::key::KeyWord;
use crate::tree::{Keys, Node, Topology};

/// A chained hash table from keys to nodes: one bucket for each node; the bucket is the key modulo their number.
/// `[GLASSNER-1]`
///
/// Binder & Keller (2016, Section 1.1) name its two costs, which the perfect hash avoids: keys are compared, and a loop
/// walks the chain. Keys longer than 64 bits are folded to select the bucket, and compared in full.
#[derive(Clone, Debug)]
pub struct Glassner {
    /// Number of the first entry of each bucket, plus one; 0 if it is empty.
    buckets: Vec<u32>,
    entries: Vec<Entry>,
    keys: Keys,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    node: Node,
    /// The slot of the node's stored key.
    slot: u32,
    /// Number of the next entry of the bucket, plus one; 0 at the end.
    next: u32,
}

impl Glassner {
    /// Returns the memory of buckets, entries and keys, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.buckets) + size_of_val(&*self.entries) + self.keys.bytes()
    }

    /// Builds the table of all nodes of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        let count = tree.node_count();
        let (mut buckets, mut entries) = (vec![0; count], Vec::with_capacity(count));
        for_each_folded_key(tree, SEED, |key, node| {
            let first = &mut buckets[bucket(key, count)];
            entries.push(Entry { node, slot: tree.slot(node) as u32, next: *first });
            *first = entries.len() as u32;
        });
        Self { buckets, entries, keys: Keys::of(tree) }
    }
}

impl<W: KeyWord> Lookup<W> for Glassner {
    #[inline]
    fn node(&self, key: &W) -> Node {
        let mut at = self.buckets[bucket(fold(key, SEED), self.buckets.len())];
        while let Some(entry) = at.checked_sub(1).map(|i| self.entries[i as usize]) {
            if self.keys.is(entry.slot as usize, key) {
                return entry.node;
            }
            at = entry.next;
        }
        debug_assert!(false, "no node has the key {key:?}");
        Node::inner(0)
    }
}

/// Keys are compared, so any seed is valid.
const SEED: u64 = 0;

#[inline]
const fn bucket(folded: u64, buckets: usize) -> usize {
    (folded % buckets as u64) as usize
}
