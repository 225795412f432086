//! Perfect hashes and their lookups, for pages.

use serde::Serialize;

use stackless_bvh::hash::{PerfectHash, fold};
use stackless_bvh::internals::hash::{decode, is_address};
use stackless_bvh::key::KeyWord;
use stackless_bvh::tree::Node;

/// The tables of a perfect hash, if they are small enough to draw.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Table {
    /// Number of hashed keys.
    pub keys: u32,
    /// D, the number of displacements.
    pub displacements: usize,
    /// H, the number of cells.
    pub cells: usize,
    /// The entries of the buckets; empty if D or H is more than [`Table::DRAWN`].
    pub buckets: Vec<Entry>,
    /// The nodes in the cells; empty if D or H is more than [`Table::DRAWN`].
    pub nodes: Vec<Option<u32>>,
}

/// The entry of a bucket. `[HASH-5]`
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Entry {
    /// A displacement.
    Displacement(u32),
    /// The address of a node, by its slot.
    Direct(u32),
}

impl Table {
    /// The maximum number of entries of a table that is drawn.
    pub const DRAWN: usize = 128;

    pub(super) fn of(hash: &PerfectHash, slot: impl Fn(Node) -> u32) -> Self {
        let (buckets, cells) = (hash.displacements(), hash.cells());
        let drawn = if buckets.len().max(cells.len()) <= Self::DRAWN { Self::DRAWN } else { 0 };
        Self {
            keys: hash.header().keys,
            displacements: buckets.len(),
            cells: cells.len(),
            buckets: buckets.iter().take(drawn).map(|&word| Entry::of(word, &slot)).collect(),
            nodes: cells.iter().take(drawn).map(|&word| node_of(word, &slot)).collect(),
        }
    }
}

impl Entry {
    fn of(word: u32, slot: &impl Fn(Node) -> u32) -> Self {
        node_of(word, slot).map_or(Self::Displacement(word), Self::Direct)
    }
}

/// Returns the slot of the node whose address a word is.
fn node_of(word: u32, slot: &impl Fn(Node) -> u32) -> Option<u32> {
    is_address(word).then(|| slot(decode(word)))
}

/// A lookup by h(k) = ((k mod H) + d[k mod D]) mod H, or in one load if the bucket has an address. `[HASH-1]`
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct HashLookup {
    /// The key, in binary.
    pub key: String,
    /// The argument of the function, in decimal: the key itself, unless the tree needs the remedy.
    pub number: String,
    /// k mod D.
    pub bucket: usize,
    /// The entry of the bucket.
    pub entry: Entry,
    /// k mod H, if the bucket has a displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remainder: Option<usize>,
    /// h(k), if the bucket has a displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<usize>,
    /// The node found.
    pub node: Option<u32>,
}

impl HashLookup {
    /// Computes each part by the definition, from the words of the tables.
    pub(super) fn of<W: KeyWord>(hash: &PerfectHash, key: &W, slot: impl Fn(Node) -> u32) -> Self {
        let header = hash.header();
        let number = header.mix.apply(fold(key, header.fold_seed));
        let (buckets, cells) = (hash.displacements(), hash.cells());
        let bucket = (number % buckets.len() as u64) as usize;
        let word = buckets[bucket];
        let remainder = (number % cells.len() as u64) as usize;
        let cell = (remainder + word as usize) % cells.len();
        let entry = Entry::of(word, &slot);
        let (remainder, cell, node) = match entry {
            Entry::Direct(node) => (None, None, Some(node)),
            Entry::Displacement(_) => (Some(remainder), Some(cell), node_of(cells[cell], &slot)),
        };
        Self { key: binary(key), number: number.to_string(), bucket, entry, remainder, cell, node }
    }
}

/// Formats a word in binary, without leading zeros.
pub(super) fn binary<W: KeyWord>(word: &W) -> String {
    let (mut rest, mut digits) = (word.clone(), Vec::new());
    while !rest.is_zero() {
        digits.push(if rest.low_bits() & 1 == 1 { '1' } else { '0' });
        rest = rest.shr1();
    }
    if digits.is_empty() { "0".to_owned() } else { digits.into_iter().rev().collect() }
}
