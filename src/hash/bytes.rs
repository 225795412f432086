//! Encoding of tables as bytes.

use alloc::vec::Vec;
use core::fmt;

use super::address::{decode, is_address};
use super::perfect::Members;
use super::{Header, KeySet, Mix, PerfectHash, Sizing, TableSize};
use crate::tree::{Node, Reach, Topology};

const MAGIC: [u8; 8] = *b"SBVHHASH";
const VERSION: u32 = 1;
/// Magic, 12 words of 32 bits, 2 of 64.
const HEADER_BYTES: usize = 8 + 12 * 4 + 2 * 8;

/// Bounds of the node indices of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AddressBounds {
    /// One more than the highest index of an inner node; 0 if there is none.
    pub inner: usize,
    /// One more than the highest index of a leaf.
    pub leaf: usize,
}

impl AddressBounds {
    /// Returns the bounds of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        let mut bounds = Self::default();
        let mut pending = alloc::vec![tree.root()];
        while let Some(node) = pending.pop() {
            let bound = if node.is_leaf() { &mut bounds.leaf } else { &mut bounds.inner };
            *bound = (*bound).max(node.index() + 1);
            if !node.is_leaf() {
                pending.extend(tree.children(node));
            }
        }
        bounds
    }

    /// Returns whether a node's index is within the bounds.
    pub const fn contains(self, node: Node) -> bool {
        node.index() < if node.is_leaf() { self.leaf } else { self.inner }
    }
}

/// Errors of [`PerfectHash::from_bytes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableError {
    /// The length does not match the header or its sizes.
    Length {
        /// Expected number of bytes.
        expected: u64,
        /// Actual number of bytes.
        found: usize,
    },
    /// The magic number is invalid.
    Magic,
    /// The version of the format is not supported.
    Version {
        /// Its number.
        version: u32,
    },
    /// A field of the header has an invalid value.
    Field {
        /// Its name.
        name: &'static str,
        /// The number.
        value: u32,
    },
    /// D is not a power of two.
    Displacements {
        /// D.
        displacements: u32,
    },
    /// H is even, or above 2^31.
    Cells {
        /// H.
        cells: u32,
    },
    /// A displacement is H or more.
    Displacement {
        /// Its index.
        index: usize,
        /// The displacement.
        displacement: u32,
    },
    /// A word is not an address of the tree where an address is required.
    Address {
        /// Whether it is in the hash table, and not in the table of displacements.
        in_cells: bool,
        /// Its index.
        index: usize,
        /// The word.
        word: u32,
    },
    /// The number of addresses in the tables differs from the header.
    Count {
        /// `"keys"` or `"direct"`.
        name: &'static str,
        /// The number in the header.
        stated: u32,
        /// The actual number.
        found: usize,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { expected, found } => write!(f, "{found} bytes, expected {expected}"),
            Self::Magic => f.write_str("not a hash table: it does not begin with SBVHHASH"),
            Self::Version { version } => write!(f, "version {version} of the format, expected {VERSION}"),
            Self::Field { name, value } => write!(f, "header: {name} is {value}"),
            Self::Displacements { displacements } => write!(f, "header: D is {displacements}, no power of two"),
            Self::Cells { cells } => write!(f, "header: H is {cells}, which is even or above 2^31"),
            Self::Displacement { index, displacement } => {
                write!(f, "displacement {index} is {displacement}, not below H")
            }
            Self::Address { in_cells, index, word } => {
                let table = if *in_cells { "cell" } else { "displacement" };
                write!(f, "{table} {index} is {word:#010x}, no address of the tree")
            }
            Self::Count { name, stated, found } => write!(f, "header: {name} is {stated}, the tables hold {found}"),
        }
    }
}

impl core::error::Error for TableError {}

impl PerfectHash {
    /// Encodes the table: a header of 72 bytes, then both tables, all words little-endian.
    pub fn to_bytes(&self) -> Vec<u8> {
        let header = &self.header;
        let (set, inner, leaf) = match header.key_set {
            KeySet::All => (0, 0, 0),
            KeySet::Paper => (1, 0, 0),
            KeySet::Exact(reach) => (2, reach.of(false), reach.of(true)),
        };
        let flags = u32::from(header.mix.narrow) | u32::from(header.mix.seed.is_some()) << 1;
        let sizes = [header.keys, header.direct, header.displacements, header.cells.get(), header.reseeds];
        let words = [VERSION, set, inner, leaf, header.sizing as u32, flags].into_iter().chain(sizes).chain([0]);
        let seeds = [header.mix.seed.unwrap_or(0), header.fold_seed];

        let mut bytes = Vec::with_capacity(HEADER_BYTES + header.bytes());
        bytes.extend(MAGIC);
        bytes.extend(words.flat_map(u32::to_le_bytes));
        bytes.extend(seeds.into_iter().flat_map(u64::to_le_bytes));
        bytes.extend(self.displacements.iter().chain(&self.cells).flat_map(|word| word.to_le_bytes()));
        bytes
    }

    /// Decodes a table for a tree with these addresses.
    ///
    /// Every lookup then returns an address of the tree. [`certify`](super::certify()) checks that it is the right one.
    /// The decoder allocates nothing before it has checked the length.
    ///
    /// # Errors
    /// [`TableError`].
    pub fn from_bytes(bytes: &[u8], bounds: AddressBounds) -> Result<Self, TableError> {
        let too_short = TableError::Length { expected: HEADER_BYTES as u64, found: bytes.len() };
        let (head, tables) = bytes.split_at_checked(HEADER_BYTES).ok_or(too_short)?;
        let header = read_header(head)?;
        let expected = HEADER_BYTES as u64 + 4 * (u64::from(header.displacements) + u64::from(header.cells.get()));
        if bytes.len() as u64 != expected {
            return Err(TableError::Length { expected, found: bytes.len() });
        }
        let (displacements, cells) = tables.split_at(4 * header.displacements as usize);
        let (displacements, cells) = (words(displacements), words(cells));
        check_words(&header, &displacements, &cells, bounds)?;
        Ok(Self::from_parts(header, displacements.into(), cells.into(), Members::default()))
    }
}

fn words(bytes: &[u8]) -> Vec<u32> {
    bytes.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word)).collect()
}

fn read_header(bytes: &[u8]) -> Result<Header, TableError> {
    let rest = bytes.strip_prefix(&MAGIC).ok_or(TableError::Magic)?;
    let (small, large) = rest.split_at(12 * 4);
    let small = words(small);
    let &[version, set, inner, leaf, sizing, flags, keys, direct, displacements, cells, reseeds, reserved] = &small[..]
    else {
        return Err(TableError::Magic);
    };
    let &[seed, fold_seed] = &large.as_chunks().0.iter().map(|&seed| u64::from_le_bytes(seed)).collect::<Vec<_>>()[..]
    else {
        return Err(TableError::Magic);
    };
    if version != VERSION {
        return Err(TableError::Version { version });
    }
    let key_set = match (set, Reach::new(inner, leaf)) {
        (0, None) if (inner, leaf) == (0, 0) => KeySet::All,
        (1, None) if (inner, leaf) == (0, 0) => KeySet::Paper,
        (2, Some(reach)) => KeySet::Exact(reach),
        _ => return Err(TableError::Field { name: "set of keys", value: set }),
    };
    let field = |name, value| TableError::Field { name, value };
    let sizing = Sizing::ALL.get(sizing as usize).copied().ok_or(field("sizing", sizing))?;
    if flags > 3 {
        return Err(field("flags", flags));
    }
    if reserved != 0 {
        return Err(field("reserved word", reserved));
    }
    let mix = Mix { narrow: flags & 1 != 0, seed: (flags & 2 != 0).then_some(seed) };
    if (reseeds > 0) != mix.seed.is_some() || mix.seed.is_none() && seed != 0 {
        return Err(field("number of seeds", reseeds));
    }
    if !displacements.is_power_of_two() {
        return Err(TableError::Displacements { displacements });
    }
    let size = TableSize::new(cells).filter(|_| !cells.is_multiple_of(2)).ok_or(TableError::Cells { cells })?;
    Ok(Header { key_set, sizing, keys, direct, displacements, cells: size, mix, reseeds, fold_seed })
}

fn check_words(header: &Header, displacements: &[u32], cells: &[u32], bounds: AddressBounds) -> Result<(), TableError> {
    let (mut direct, mut in_cells) = (0, 0);
    for (index, &word) in displacements.iter().enumerate() {
        if !is_address(word) {
            if word >= header.cells.get() {
                return Err(TableError::Displacement { index, displacement: word });
            }
        } else if bounds.contains(decode(word)) {
            direct += 1;
        } else {
            return Err(TableError::Address { in_cells: false, index, word });
        }
    }
    for (index, &word) in cells.iter().enumerate().filter(|&(_, &word)| word != 0) {
        if !is_address(word) || !bounds.contains(decode(word)) {
            return Err(TableError::Address { in_cells: true, index, word });
        }
        in_cells += 1;
    }
    for (name, stated, found) in [("direct", header.direct, direct), ("keys", header.keys, direct + in_cells)] {
        if stated as usize != found {
            return Err(TableError::Count { name, stated, found });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
