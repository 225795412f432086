//! Keys of `log2 A` bits per level.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Mul;

use super::tree::{Topology, slot_bits};
use crate::key::Word;
use crate::tree::Node;

/// Returns the key of the child in a slot. `[WIDE-9]`
///
/// ```
/// use stackless_bvh::wide::{ancestor_key, child_key, key_level};
/// let key = child_key::<8, u64>(child_key::<8, u64>(1, 5), 2);
/// assert_eq!(key, 0o152);
/// assert_eq!((ancestor_key::<8, u64>(key, 1), key_level::<8>(key)), (0o15, 2));
/// ```
#[inline(always)]
#[must_use]
pub fn child_key<const A: usize, W: Word>(mut key: W, slot: W) -> W {
    for _ in 0..slot_bits::<A>() {
        key = key.shl1();
    }
    key.or(&slot)
}

/// Returns the key of the ancestor `levels` levels up. `[WIDE-9]`
#[inline(always)]
#[must_use]
pub fn ancestor_key<const A: usize, W: Word>(key: W, levels: W::Shift) -> W
where
    W::Shift: Mul<u32, Output = W::Shift>,
{
    key.shr(levels * slot_bits::<A>())
}

/// Returns the number of levels below the root. `[WIDE-9]`
#[inline]
pub const fn key_level<const A: usize>(key: u64) -> u32 {
    (u64::BITS - 1 - key.leading_zeros()) / slot_bits::<A>()
}

/// Returns the keys that a traversal can look up when it backtracks, with their nodes: those of the nodes with an inner
/// child and at least one other child. `[WIDE-16]`
///
/// Linear time, no recursion. The tree's keys must fit the word: in 64 bits, at most 63 / log2 A levels.
pub fn asked_keys<const A: usize, W: Word>(tree: &impl Topology<A>) -> Vec<(W, Node)> {
    let mut keys = Vec::new();
    let mut open = vec![(W::one(), tree.root())];
    while let Some((key, node)) = open.pop() {
        let (children, leaves) = (tree.children(node), tree.leaves(node));
        let inner = children & !leaves;
        if inner != 0 && children.count_ones() > 1 {
            keys.push((key.clone(), node));
        }
        for slot in (0..A as u32).filter(|slot| inner >> slot & 1 == 1) {
            let word = (0..slot).fold(W::zero(), |word, _| word.wrapping_add(&W::one()));
            open.push((child_key::<A, W>(key.clone(), word), tree.child(node, slot)));
        }
    }
    keys
}
