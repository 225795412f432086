//! Lookup of addresses by keys.
//!
//! A traversal that backtracks in constant time knows the key of the next node and needs its address. [`Lookup`] is its
//! interface. The implicit layout implements it by arithmetic, [`KeyMap`] by an ordinary open-addressing table, and
//! [`PerfectHash`] by the two small tables of Binder & Keller (2016, Section 2.2). These hold only the keys that a
//! traversal can look up ([`KeySet`]), and [`certify()`] checks them for a tree.

pub(crate) mod address;
mod build;
pub(crate) mod bytes;
mod certify;
pub(crate) mod fold;
mod keys;
mod map;
pub(crate) mod modulo;
pub(crate) mod perfect;
mod place;
mod verified;

pub use build::{BuildError, Options};
pub(crate) use bytes::AddressBounds;
pub use bytes::TableError;
pub use certify::{CertificateError, certify};
pub use fold::fold;
pub(crate) use fold::for_each_folded_key;
pub use keys::KeySet;
pub use map::KeyMap;
pub(crate) use modulo::{Modulo, Reciprocal, TableSize};
pub(crate) use perfect::Header;
pub use perfect::{Mix, PerfectHash, Sizing};
pub use verified::Verified;

use crate::key::KeyWord;
use crate::tree::{Implicit, ImplicitCells, Node};

/// Maps the keys of a tree's nodes to their addresses.
pub trait Lookup<W> {
    /// Returns the address of the node with this key, which must be a key of the table.
    ///
    /// For another key the answer is meaningless, as in every perfect hash; debug builds panic.
    fn node(&self, key: &W) -> Node;
}

impl<W, L: Lookup<W>> Lookup<W> for &L {
    #[inline]
    fn node(&self, key: &W) -> Node {
        (**self).node(key)
    }
}

impl<W: KeyWord> Lookup<W> for Implicit {
    #[inline]
    fn node(&self, key: &W) -> Node {
        self.cells().node(key)
    }
}

impl<W: KeyWord> Lookup<W> for ImplicitCells<'_> {
    /// Every node of the tree is present; for a key of no node the answer is meaningless (and a panic in debug builds).
    #[inline]
    fn node(&self, key: &W) -> Node {
        let address = key.to_u64().map_or(usize::MAX, |key| (key as usize).wrapping_sub(1));
        let node = self.at(address);
        debug_assert!(node.is_some(), "no node has the key {key:?}");
        node.unwrap_or(Node::inner(0))
    }
}

/// Applies the finaliser of `SplitMix64` (Steele, Lea & Flood 2014): a bijection in which every input bit changes about
/// half of the output bits.
pub const fn mix(mut x: u64) -> u64 {
    x ^= x >> 30;
    x = x.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x ^= x >> 27;
    x = x.wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

/// Computes a checksum that detects every change of one 64-bit word, and nearly every other change. `[FILE-4]`
pub fn checksum(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks();
    let mut last = [0; 8];
    last.iter_mut().zip(rest).for_each(|(last, byte)| *last = *byte);
    words.iter().chain([&last]).fold(bytes.len() as u64, |sum, word| mix(sum ^ u64::from_le_bytes(*word)))
}
