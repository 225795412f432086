//! A lookup that detects wrong results.

use core::borrow::Borrow;
use core::sync::atomic::{AtomicUsize, Ordering};

use super::{Lookup, PerfectHash};
use crate::key::KeyWord;
use crate::tree::{Keys, Node, Topology};

/// A perfect hash that compares the key of each node that it finds with the requested key. `[HASH-10]`
///
/// It counts each miss and answers it by a walk down the tree. So the search continues correctly and every miss is
/// counted.
#[derive(Debug)]
pub struct Verified<'a, T, H = &'a PerfectHash, K = &'a Keys> {
    hash: H,
    tree: &'a T,
    keys: K,
    lookups: AtomicUsize,
    misses: AtomicUsize,
}

impl<'a, T, H, K> Verified<'a, T, H, K> {
    /// Combines the hash of a tree with the tree's keys for verification; each is borrowed or owned.
    pub const fn new(hash: H, tree: &'a T, keys: K) -> Self {
        Self { hash, tree, keys, lookups: AtomicUsize::new(0), misses: AtomicUsize::new(0) }
    }

    /// Returns the number of lookups so far.
    pub fn lookups(&self) -> usize {
        self.lookups.load(Ordering::Relaxed)
    }

    /// Returns the number of lookups that found no node or a wrong one.
    pub fn misses(&self) -> usize {
        self.misses.load(Ordering::Relaxed)
    }
}

impl<W, T, H, K> Lookup<W> for Verified<'_, T, H, K>
where
    W: KeyWord,
    T: Topology,
    H: Borrow<PerfectHash>,
    K: Borrow<Keys>,
{
    fn node(&self, key: &W) -> Node {
        self.lookups.fetch_add(1, Ordering::Relaxed);
        let found = self.hash.borrow().probe(key).filter(|&node| self.keys.borrow().is(self.tree.slot(node), key));
        found.unwrap_or_else(|| {
            self.misses.fetch_add(1, Ordering::Relaxed);
            Keys::walk(self.tree, key).unwrap_or(self.tree.root())
        })
    }
}
