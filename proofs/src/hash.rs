//! The perfect hash: remainders, addresses, lookups, bytes, the certificate.

use stackless_bvh::hash::{KeySet, Lookup, PerfectHash, certify};
use stackless_bvh::internals::hash::{AddressBounds, Modulo, Reciprocal, Remainder, TableSize};
use stackless_bvh::tree::{Node, Tree};

use crate::harness::{claim, harnesses};
use crate::{Choose, cover};

harnesses! {
    /// The remainder by multiplication equals the remainder: 5 cells, all keys of 16 bits. `[HASH-1]`
    remainder_u32_5, remainder_u32_5_twin, 2 => remainder_u32::<5, 16>;
    /// 127 cells. `[HASH-1]`
    remainder_u32_127, remainder_u32_127_twin, 2 => remainder_u32::<127, 16>;
    /// 127 cells, with the method for keys of 64 bits. `[HASH-1]`
    remainder_u64_127, remainder_u64_127_twin, 2 => remainder_u64::<127, 16>;
    /// Every address with an index of 30 bits survives encoding as a word. `[HASH-5]`
    addresses, addresses_twin, 13 kani => every_address;
    /// A table that was read returns an address of the tree or none for every key, and does not panic. `[HASH-1]`
    /// `[HASH-5]`
    lookups, lookups_twin, 13 kani => any_lookup;
    /// A certified table returns the right node for every key of its tree: 3 nodes, any words. `[HASH-9]`
    certificate, certificate_twin, 13 kani => small_certificate;
}

/// `[HASH-1]`
pub fn remainder_u32<const H: u32, const BITS: u32>(choose: &mut impl Choose) -> Option<()> {
    let (key, size) = (choose.bits(BITS) as u32, TableSize::new(H)?);
    let last = u32::MAX >> (32 - BITS);
    cover!(choose, key == last, "the greatest key");
    let remainder = Reciprocal::of(size).of_u32(key);
    let remainder = choose.plant(remainder, |remainder| if key == last { remainder + H } else { remainder });
    claim!(remainder == Remainder(size).of_u32(key));
    Some(())
}

/// `[HASH-1]`
pub fn remainder_u64<const H: u32, const BITS: u32>(choose: &mut impl Choose) -> Option<()> {
    let (key, size) = (choose.bits(BITS), TableSize::new(H)?);
    let last = u64::MAX >> (64 - BITS);
    cover!(choose, key == last, "the greatest key");
    let remainder = Reciprocal::of(size).of_u64(key);
    let remainder = choose.plant(remainder, |remainder| if key == last { remainder + H } else { remainder });
    claim!(remainder == Remainder(size).of_u64(key));
    Some(())
}

/// Bytes of a header.
const HEADER: usize = 72;

/// Returns the bytes of a table for all keys of a tree in 32 bits, with the printed function: 72, and 4 for each word.
fn table<const BYTES: usize>(displacements: u32, cells: u32, keys: u32, direct: u32, words: &[u32]) -> [u8; BYTES] {
    let mut bytes = [0; BYTES];
    bytes[..8].copy_from_slice(b"SBVHHASH");
    let header = [1, 0, 0, 0, 2, 1, keys, direct, displacements, cells];
    for (i, word) in header.into_iter().enumerate() {
        bytes[8 + 4 * i..12 + 4 * i].copy_from_slice(&word.to_le_bytes());
    }
    for (i, word) in words.iter().enumerate() {
        bytes[HEADER + 4 * i..HEADER + 4 + 4 * i].copy_from_slice(&word.to_le_bytes());
    }
    bytes
}

/// Indices of 30 bits.
const ALL: AddressBounds = AddressBounds { inner: 1 << 30, leaf: 1 << 30 };

/// `[HASH-5]`
pub fn every_address(choose: &mut impl Choose) -> Option<()> {
    let (index, is_leaf) = (choose.bits(30) as u32, choose.any::<bool>());
    let node = if is_leaf { Node::leaf(index) } else { Node::inner(index) };
    // By the definition of the encoding.
    let word = if is_leaf { !index } else { 0x8000_0000 + index };
    let word = choose.plant(word, |word| if index == (1 << 30) - 1 { word ^ 1 } else { word });
    cover!(choose, is_leaf && index == (1 << 30) - 1, "the last leaf");
    cover!(choose, !is_leaf && index == (1 << 30) - 1, "the last inner node");
    let hash = PerfectHash::from_bytes(&table::<80>(1, 1, 1, 1, &[word, 0]), ALL);
    claim!(hash.is_ok_and(|hash| hash.probe(&1_u32) == Some(node)));
    Some(())
}

/// `[HASH-1]` `[HASH-5]`
pub fn any_lookup(choose: &mut impl Choose) -> Option<()> {
    let words = [(); 5].map(|()| choose.bits(32) as u32);
    let (keys, direct) = (choose.bits(3) as u32, choose.bits(2) as u32);
    let bounds = AddressBounds { inner: choose.bits(4) as usize, leaf: choose.bits(4) as usize };
    let key = choose.bits(32) as u32;
    let Ok(hash) = PerfectHash::from_bytes(&table::<92>(2, 3, keys, direct, &words), bounds) else { return Some(()) };
    let found = hash.probe(&key);
    cover!(choose, found.is_none(), "an empty cell");
    cover!(choose, found.is_some() && keys > direct, "a node in a cell");
    let bounds = choose.plant(bounds, |bounds| AddressBounds { leaf: bounds.leaf.saturating_sub(1), ..bounds });
    claim!(found.is_none_or(|node| bounds.contains(node)));
    Some(())
}

/// `[HASH-9]`
pub fn small_certificate(choose: &mut impl Choose) -> Option<()> {
    // Any words, and the addresses of the tree's nodes more often than by chance.
    let words = [(); 5].map(|()| {
        let (which, any) = (choose.bits(2) as usize, choose.bits(32) as u32);
        [0x8000_0000, !1, !2, any][which]
    });
    let direct = words[..2].iter().filter(|&&word| word >= 0x8000_0000).count() as u32;
    let tree = Tree::new(&[Some([1, 2]), None, None]).ok()?;
    let bounds = AddressBounds { inner: 1, leaf: 3 };
    let Ok(hash) = PerfectHash::from_bytes(&table::<92>(2, 3, 3, direct, &words), bounds) else { return Some(()) };
    let certified = certify(&hash, &tree, KeySet::All).is_ok();
    cover!(choose, certified, "a table that is right");
    cover!(choose, !certified, "a table that is wrong");
    if certified || (choose.plant(false, |_| true) && hash.probe(&2_u32).is_some()) {
        for (key, node) in [(1_u32, tree.node(0)?), (2, tree.node(1)?), (3, tree.node(2)?)] {
            claim!(hash.probe(&key) == Some(node));
            assert!(hash.node(&key) == node);
        }
    }
    Some(())
}
