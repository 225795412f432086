//! The certificate of a perfect hash: that it is correct for a tree, in time linear in the sizes of table and tree.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::{KeySet, PerfectHash, Sizing, for_each_folded_key};
use crate::tree::{Node, Reach, Topology, for_each_parent};

/// Errors of [`certify`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CertificateError {
    /// The table is for another key set.
    KeySet {
        /// The key set in the header.
        stated: KeySet,
    },
    /// A number in the header is wrong.
    Header {
        /// Its name.
        field: &'static str,
        /// The expected number.
        expected: u64,
        /// The number in the header.
        stated: u64,
    },
    /// D is not a power of two, or H is even.
    NotCoprime {
        /// D.
        displacements: u32,
        /// H.
        cells: u32,
    },
    /// A word is neither an address nor a displacement below H, or a cell holds a word that is not an address.
    Word {
        /// Whether it is in the hash table, and not in the table of displacements.
        in_cells: bool,
        /// Its index.
        index: usize,
        /// The word.
        word: u32,
    },
    /// A node's key does not lead to it.
    Unresolved {
        /// The node.
        node: Node,
        /// The word of its key.
        word: u32,
    },
}

impl fmt::Display for CertificateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::KeySet { stated } => write!(f, "made for another set of keys: {stated:?}"),
            Self::Header { field, expected, stated } => write!(f, "header: {field} is {stated}, expected {expected}"),
            Self::NotCoprime { displacements, cells } => {
                write!(f, "D = {displacements} is no power of two, or H = {cells} is even")
            }
            Self::Word { in_cells, index, word } => {
                let table = if *in_cells { "cell" } else { "displacement" };
                write!(f, "{table} {index} holds {word:#010x}, which is out of range")
            }
            Self::Unresolved { node, word } => write!(f, "the key of {node:?} leads to {word:#010x}"),
        }
    }
}

impl core::error::Error for CertificateError {}

/// Checks that every hashed key leads to its node, that D and H are coprime and of the stated sizing, that every word
/// is in its range, and that the counts in the header are correct. `[HASH-9]`
///
/// It shares no code with the construction and the lookup, except the bijection and the fold of long keys, which are
/// part of the function's definition. It finds the hashed nodes by the definition of the set, enumerates their keys in
/// another order, and divides where the lookup multiplies. Linear time, no recursion.
///
/// # Errors
/// [`CertificateError`], for the first error found.
pub fn certify(hash: &PerfectHash, tree: &impl Topology, key_set: KeySet) -> Result<(), CertificateError> {
    let header = hash.header();
    if header.key_set != key_set {
        return Err(CertificateError::KeySet { stated: header.key_set });
    }
    let hashed = hashed_slots(tree, key_set);
    let keys = hashed.iter().filter(|&&is| is).count();
    certify_header(hash, tree, keys as u64)?;
    certify_words(hash)?;

    let mut fault = None;
    for_each_folded_key(tree, header.fold_seed, |key, node| {
        let word = resolve(hash, key);
        if hashed[tree.slot(node)] && word != address(node) {
            fault.get_or_insert(CertificateError::Unresolved { node, word });
        }
    });
    fault.map_or(Ok(()), Err)
}

fn certify_header(hash: &PerfectHash, tree: &impl Topology, keys: u64) -> Result<(), CertificateError> {
    let header = hash.header();
    let (d, h) = (header.displacements, header.cells.get());
    if d.count_ones() != 1 || h.is_multiple_of(2) {
        return Err(CertificateError::NotCoprime { displacements: d, cells: h });
    }
    let addresses = |words: &[u32]| words.iter().filter(|&&word| word >= 1 << 31).count() as u64;
    let direct = addresses(hash.displacements());
    let is_narrow = u64::from(tree.depth() < 32);
    let mut fields = vec![
        ("number of displacements", hash.displacements().len() as u64, u64::from(d)),
        ("number of cells", hash.cells().len() as u64, u64::from(h)),
        ("number of keys", keys, u64::from(header.keys)),
        ("number of addresses", keys, direct + addresses(hash.cells())),
        ("number of direct addresses", direct, u64::from(header.direct)),
        ("whether keys fit 32 bits", is_narrow, u64::from(header.mix.narrow)),
        ("whether seeds were tried", u64::from(header.mix.seed.is_some()), u64::from(header.reseeds > 0)),
    ];
    let counted = match header.sizing {
        Sizing::Printed => Some(tree.node_count() as u64),
        Sizing::PrintedHashed => Some(keys),
        Sizing::Tight => None,
    };
    if let Some(n) = counted {
        let powers = (0..32).map(|i| 1_u64 << i);
        let highest_below_half = powers.take_while(|power| 2 * power < n).last();
        fields.extend([("D", highest_below_half.unwrap_or(1), u64::from(d)), ("H", 2 * n + 1, u64::from(h))]);
    }
    match fields.into_iter().find(|&(_, expected, stated)| expected != stated) {
        Some((field, expected, stated)) => Err(CertificateError::Header { field, expected, stated }),
        None => Ok(()),
    }
}

fn certify_words(hash: &PerfectHash) -> Result<(), CertificateError> {
    let is_address = |word: u32| word >= 1 << 31;
    let size = hash.header().cells.get();
    let displacement = hash.displacements().iter().position(|&word| !is_address(word) && word >= size);
    let cell = hash.cells().iter().position(|&word| !is_address(word) && word != 0);
    match (displacement, cell) {
        (Some(index), _) => Err(CertificateError::Word { in_cells: false, index, word: hash.displacements()[index] }),
        (None, Some(index)) => Err(CertificateError::Word { in_cells: true, index, word: hash.cells()[index] }),
        (None, None) => Ok(()),
    }
}

/// Returns the word of a folded key, by the definition of the function.
fn resolve(hash: &PerfectHash, key: u64) -> u32 {
    let header = hash.header();
    let (d, h) = (u64::from(header.displacements), u64::from(header.cells.get()));
    let key = header.mix.apply(key);
    let word = hash.displacements()[(key % d) as usize];
    if word >= 1 << 31 { word } else { hash.cells()[((key % h + u64::from(word)) % h) as usize] }
}

/// Returns the word of a node, by the definition of the encoding.
fn address(node: Node) -> u32 {
    let index = node.index() as u32;
    if node.is_leaf() { u32::MAX - index } else { 0x8000_0000 + index }
}

/// Returns for each slot whether the node is hashed, by the definitions of the sets.
fn hashed_slots(tree: &impl Topology, key_set: KeySet) -> Vec<bool> {
    let mut hashed = vec![key_set == KeySet::All; tree.node_count()];
    if let KeySet::Exact(reach) = key_set {
        mark(tree, &mut hashed, |levels| levels.exceed(reach));
    } else if key_set == KeySet::Paper {
        // A grand nephew is two levels below the sibling, a grand grand nephew three.
        mark(tree, &mut hashed, |levels| levels.inner >= Some(2) || levels.leaf >= 3);
    }
    hashed
}

/// Levels below a node down to the deepest inner node and to the deepest leaf.
#[derive(Clone, Copy)]
struct Levels {
    /// `None` if the node is a leaf.
    inner: Option<u32>,
    leaf: u32,
}

impl Levels {
    fn exceed(self, reach: Reach) -> bool {
        self.inner > Some(reach.of(false)) || self.leaf > reach.of(true)
    }
}

/// Marks the nodes whose sibling's subtree is of some kind.
fn mark(tree: &impl Topology, hashed: &mut [bool], is_hashed: impl Fn(Levels) -> bool) {
    let mut parents = Vec::new();
    for_each_parent(tree, |parent, children| parents.push((parent, children)));
    let mut levels = vec![Levels { inner: None, leaf: 0 }; tree.node_count()];
    for (parent, children) in parents.into_iter().rev() {
        let [left, right] = children.map(|child| tree.slot(child));
        (hashed[left], hashed[right]) = (is_hashed(levels[right]), is_hashed(levels[left]));
        let below = [levels[left], levels[right]];
        let inner = below.iter().filter_map(|levels| levels.inner).max().map_or(0, |inner| inner + 1);
        levels[tree.slot(parent)] = Levels { inner: Some(inner), leaf: below[0].leaf.max(below[1].leaf) + 1 };
    }
}

#[cfg(test)]
mod tests;
