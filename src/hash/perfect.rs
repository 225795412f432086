//! The perfect hash of Binder & Keller 2016, Section 2.2.1: two tables, at most two loads, no comparison of keys.

use alloc::boxed::Box;
use core::fmt;

use super::address::{decode, is_address};
use super::fold::fold;
use super::modulo::wrap;
use super::{KeySet, Lookup, Modulo, Reciprocal, TableSize, mix};
use crate::key::KeyWord;
use crate::tree::Node;

/// A perfect hash from the keys of a tree's nodes to their addresses.
///
/// For a key k, a table d of D displacements and H cells, the node is in the cell
///
/// ```text
/// h(k) = ((k mod H) + d[k mod D]) mod H        [HASH-1]
/// ```
///
/// where D is a power of two. (The paper writes (k + d) mod H, which overflows where keys use the full width.) Where
/// one key alone has a displacement, the table holds its node instead, marked by the sign: one load, no remainder.
/// `[HASH-5]`
///
/// Keys of up to 64 bits are hashed as they are, in 32-bit arithmetic where all keys of the tree fit. Longer ones are
/// folded to 64 bits first, under a seed for which the folds of all hashed keys differ. `[HASH-6]`
///
/// The function cannot separate two keys that are equal modulo D and modulo H. Where the tree has such keys, all keys
/// go through a bijection first, chosen by a seed: [`Mix`]. `[HASH-7]`
///
/// The answer for a key that is not in the set is meaningless. Builds with debug assertions compare keys and panic;
/// [`Verified`](super::Verified) counts such lookups instead.
///
/// ```
/// use stackless_bvh::hash::{KeySet, Lookup, Options, PerfectHash, Sizing};
/// use stackless_bvh::tree::Tree;
///
/// let tree = Tree::new(&[Some([1, 2]), None, Some([3, 4]), None, None])?;
/// let hash = PerfectHash::build(&tree, Options { key_set: KeySet::All, sizing: Sizing::Tight })?;
/// assert_eq!(Some(hash.node(&0b111_u32)), tree.node(4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PerfectHash {
    pub(super) header: Header,
    modulus: Reciprocal,
    /// Indexed by the low bits of a key: a displacement below H, or an address.
    pub(super) displacements: Box<[u32]>,
    /// Addresses; 0 in empty cells.
    pub(super) cells: Box<[u32]>,
    #[cfg(debug_assertions)]
    members: Members,
}

/// The parameters of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header {
    /// The hashed nodes.
    pub key_set: KeySet,
    /// The sizing of D and H.
    pub sizing: Sizing,
    /// Number of hashed keys.
    pub keys: u32,
    /// Number of keys with an address in the table of displacements.
    pub direct: u32,
    /// D, the number of displacements: a power of two.
    pub displacements: u32,
    /// H, the number of cells: odd, hence coprime to D.
    pub cells: TableSize,
    /// The bijection before the remainders.
    pub mix: Mix,
    /// Number of tried seeds, including the one in use; 0 for the printed function.
    pub reseeds: u32,
    /// Seed of the fold of keys beyond 64 bits.
    pub fold_seed: u64,
}

/// The sizing of D and H by the numbers of nodes and keys. `[HASH-2]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sizing {
    /// As printed (Section 2.2.2), with all nodes as N: D is the highest power of two below N/2 (at least 1), H the
    /// smallest number above 2N that is coprime to D, which is 2N + 1.
    Printed,
    /// As printed, with the hashed keys as N.
    PrintedHashed,
    /// For direct addresses: D is the power of two nearest to twice the number of keys (1.4 to 2.8 times their number).
    /// H is the smallest odd number above twice the number of keys without a direct address. If two of these keys are
    /// equal modulo D and H, H is an eighth more, and so on.
    Tight,
}

impl Sizing {
    /// All sizings.
    pub const ALL: [Self; 3] = [Self::Printed, Self::PrintedHashed, Self::Tight];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::PrintedHashed => "printed-hashed",
            Self::Tight => "tight",
        }
    }
}

impl fmt::Display for Sizing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Header {
    /// Returns the bytes of both tables.
    pub const fn bytes(&self) -> usize {
        4 * (self.displacements as usize + self.cells.get() as usize)
    }

    /// Returns the fraction of the keys whose lookup is one load: 1 if there are no keys.
    pub fn direct_share(&self) -> f64 {
        if self.keys == 0 { 1.0 } else { f64::from(self.direct) / f64::from(self.keys) }
    }
}

/// A bijection of keys. `[HASH-7]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mix {
    /// Whether all keys fit 32 bits: then they are mixed and reduced in 32-bit arithmetic.
    pub narrow: bool,
    /// `None` is the identity: the printed function, which usually works.
    pub seed: Option<u64>,
}

impl Mix {
    /// Applies the bijection to a key of 32 bits, if all keys have 32 bits.
    #[inline(always)]
    pub(super) const fn narrow(self, key: u32) -> u32 {
        match self.seed {
            None => key,
            Some(seed) => mix_u32(key ^ seed as u32),
        }
    }

    /// Applies the bijection to a key of 64 bits, if not all keys fit 32 bits.
    #[inline(always)]
    pub(super) const fn wide(self, key: u64) -> u64 {
        match self.seed {
            None => key,
            Some(seed) => mix(key ^ seed),
        }
    }

    /// Applies the bijection to any key.
    pub const fn apply(self, key: u64) -> u64 {
        if self.narrow { self.narrow(key as u32) as u64 } else { self.wide(key) }
    }
}

/// Applies a bijection of 32-bit words that is not slower on hardware without 64-bit products (Wellons 2018,
/// `lowbias32`).
const fn mix_u32(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

impl PerfectHash {
    /// Combines tables. Their lengths are those of the header, both at least 1, and displacements are below H.
    pub(super) fn from_parts(header: Header, displacements: Box<[u32]>, cells: Box<[u32]>, members: Members) -> Self {
        debug_assert!(displacements.len().is_power_of_two() && cells.len() == header.cells.get() as usize);
        #[cfg(not(debug_assertions))]
        let Members {} = members;
        Self {
            header,
            modulus: Reciprocal::of(header.cells),
            displacements,
            cells,
            #[cfg(debug_assertions)]
            members,
        }
    }

    /// Wraps external tables for lookups of keys of up to 64 bits; `None` if D is not a power of two, H is 0 or too
    /// large, or a displacement is not below it.
    pub fn given(displacements: Box<[u32]>, cells: Box<[u32]>, mix: Mix) -> Option<Self> {
        let size = TableSize::new(u32::try_from(cells.len()).ok()?)?;
        let fits = |&word: &u32| is_address(word) || word < size.get();
        if !displacements.len().is_power_of_two() || !displacements.iter().all(fits) {
            return None;
        }
        let header = Header {
            key_set: KeySet::All,
            sizing: Sizing::Printed,
            keys: 0,
            direct: 0,
            displacements: displacements.len() as u32,
            cells: size,
            mix,
            reseeds: 0,
            fold_seed: 0,
        };
        Some(Self::from_parts(header, displacements, cells, Members::default()))
    }

    /// Returns the parameters of the table.
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// Returns the displacement table d, of D words: displacements below H, or addresses with the sign bit set,
    /// `0x80000000 + a` for the inner node a and `!i` for the leaf i. 0 if no key uses the entry.
    pub fn displacements(&self) -> &[u32] {
        &self.displacements
    }

    /// Returns the hash table, of H words: addresses as in [`displacements`](Self::displacements), 0 in empty cells.
    pub fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// Returns the content of a key's cell, for any key: `None` for an empty cell, otherwise a node that need not be
    /// the key's.
    #[inline(always)]
    pub fn probe<W: KeyWord>(&self, key: &W) -> Option<Node> {
        self.probe_by(&self.modulus, key)
    }

    /// Computes [`probe`](Self::probe) with another remainder by H; `modulo` must be for H.
    ///
    /// The lookup multiplies by a reciprocal. Alone, the multiplication has twice the throughput of a division. In
    /// a lookup on a processor with fast division, the difference is less than a tenth.
    #[inline(always)]
    pub fn probe_by<W: KeyWord>(&self, modulo: &impl Modulo, key: &W) -> Option<Node> {
        let mix = self.header.mix;
        let word = if mix.narrow {
            let key = mix.narrow(key.low_bits());
            self.word(key as usize, || modulo.of_u32(key))
        } else {
            let key = mix.wide(fold(key, self.header.fold_seed));
            self.word(key as usize, || modulo.of_u64(key))
        };
        is_address(word).then(|| decode(word))
    }

    /// Returns whether the lookup of this key takes one load: its bucket holds an address.
    pub fn is_direct<W: KeyWord>(&self, key: &W) -> bool {
        let mix = self.header.mix;
        let mixed =
            if mix.narrow { u64::from(mix.narrow(key.low_bits())) } else { mix.wide(fold(key, self.header.fold_seed)) };
        is_address(self.displacements[mixed as usize & (self.displacements.len() - 1)])
    }

    /// The branch is as printed. Two loads and a select instead take 3.5 ns in place of 6 if half of the keys are
    /// direct, and 3.5 in place of 2.2 if nearly all are. They make no difference to a traversal.
    #[inline(always)]
    fn word(&self, low_bits: usize, remainder: impl FnOnce() -> u32) -> u32 {
        let displacement = self.displacements[low_bits & (self.displacements.len() - 1)];
        if is_address(displacement) {
            return displacement;
        }
        self.cells[wrap(remainder() + displacement, self.modulus.size()) as usize]
    }
}

/// Equal tables, with equal parameters.
impl PartialEq for PerfectHash {
    fn eq(&self, other: &Self) -> bool {
        (self.header, &self.displacements, &self.cells) == (other.header, &other.displacements, &other.cells)
    }
}

impl Eq for PerfectHash {}

impl<W: KeyWord> Lookup<W> for PerfectHash {
    #[inline(always)]
    fn node(&self, key: &W) -> Node {
        let node = self.probe(key);
        #[cfg(debug_assertions)]
        self.members.verify(fold(key, self.header.fold_seed), node);
        node.unwrap_or(Node::inner(0))
    }
}

/// The hashed keys, by which builds with debug assertions verify each lookup. Empty in other builds.
#[derive(Clone, Debug, Default)]
pub(super) struct Members {
    /// Each node with its folded key, by node; `None` for a table from a file.
    #[cfg(debug_assertions)]
    keys: Option<Box<[(Node, u64)]>>,
}

impl Members {
    #[cfg(debug_assertions)]
    pub(super) fn of(keys: &[super::keys::HashedKey]) -> Self {
        let mut keys: Box<[_]> = keys.iter().map(|key| (key.node, key.key)).collect();
        keys.sort_unstable();
        Self { keys: Some(keys) }
    }

    #[cfg(not(debug_assertions))]
    pub(super) const fn of(_: &[super::keys::HashedKey]) -> Self {
        Self {}
    }

    #[cfg(debug_assertions)]
    fn verify(&self, key: u64, node: Option<Node>) {
        if let Some(keys) = &self.keys {
            let is_hashed = node.is_some_and(|node| keys.binary_search(&(node, key)).is_ok());
            assert!(is_hashed, "the key {key:#b} is not one that the table was made for; its cell holds {node:?}");
        }
    }
}
