//! Construction of the perfect hash, linear in the number of keys; one thread and many threads build the same table.

use alloc::vec::Vec;
use core::fmt;

use super::address::LIMIT;
use super::fold::Path;
use super::keys::HashedKey;
use super::perfect::Members;
use super::place::{Bucket, Buckets, Clash};
use super::{Header, KeySet, Mix, PerfectHash, Sizing, TableSize, mix};
use crate::tree::{Node, Topology};

/// The hashed keys, and the sizes of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The hashed nodes.
    pub key_set: KeySet,
    /// The sizing of D and H.
    pub sizing: Sizing,
}

/// Errors of the construction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuildError {
    /// A node's index needs more than 30 bits: the tree has more nodes of a kind than a table can address.
    TooManyNodes {
        /// The node.
        node: Node,
    },
    /// H would be more than 2^31.
    TooManyKeys {
        /// Number of nodes or keys that determines the size.
        keys: usize,
    },
    /// The printed function has no displacement for a bucket: two of its keys are equal modulo H, or no displacement
    /// fits the free cells. [`PerfectHash::build`] has a remedy.
    NoDisplacement {
        /// The bucket: its keys modulo D.
        bucket: u32,
        /// Number of its keys.
        keys: u32,
        /// D.
        displacements: u32,
        /// H.
        cells: TableSize,
        /// Whether two keys are equal modulo D and H: then no displacement can separate them.
        inseparable: bool,
    },
    /// None of the tried seeds works. This is not expected to happen by chance for any tree.
    NoSeed {
        /// Number of seeds.
        seeds: u32,
    },
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooManyNodes { node } => write!(f, "{node:?}: tables address at most {LIMIT} nodes of a kind"),
            Self::TooManyKeys { keys } => write!(f, "{keys} keys need more than {} cells", TableSize::MAX),
            Self::NoDisplacement { bucket, keys, displacements, cells, inseparable } => {
                let why = if inseparable { "two of them are equal modulo both" } else { "no cells that are free fit" };
                let cells = cells.get();
                write!(f, "no displacement for the {keys} keys of bucket {bucket} at D = {displacements}, ")?;
                write!(f, "H = {cells}: {why}")
            }
            Self::NoSeed { seeds } => write!(f, "none of {seeds} seeds gives a perfect hash"),
        }
    }
}

impl core::error::Error for BuildError {}

/// Greatest number of seeds. With printed sizes about a third of all seeds work; the probability that none of 100 works
/// is below 10^-15.
const SEEDS: u32 = 100;

impl PerfectHash {
    /// Builds the table of a tree, with the seeded bijection if the printed function fails. `[HASH-7]`
    ///
    /// # Errors
    /// [`BuildError`], except [`NoDisplacement`](BuildError::NoDisplacement).
    pub fn build(tree: &impl Topology, options: Options) -> Result<Self, BuildError> {
        with_fold_seeds(
            Size::of(tree),
            options,
            |seed| hashed_keys(tree, options.key_set, seed),
            |request| remedied(request, false),
        )
    }

    /// Builds the table with the printed function only. `[HASH-1]`
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn build_plain(tree: &impl Topology, options: Options) -> Result<Self, BuildError> {
        with_fold_seeds(
            Size::of(tree),
            options,
            |seed| hashed_keys(tree, options.key_set, seed),
            |request| request.table(0, false),
        )
    }

    /// Builds the table of given distinct keys, each with its address; the header calls them [`All`](KeySet::All).
    /// `[HASH-7]`
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn of_keys(keys: &[(u64, Node)]) -> Result<Self, BuildError> {
        let narrow = keys.iter().all(|&(key, _)| u32::try_from(key).is_ok());
        let keys: Vec<HashedKey> = keys.iter().map(|&(key, node)| HashedKey { key, node }).collect();
        let options = Options { key_set: KeySet::All, sizing: Sizing::Tight };
        let size = Size { nodes: keys.len(), narrow };
        with_fold_seeds(size, options, |_| keys.clone(), |request| remedied(request, false))
    }

    /// Builds the table of [`build`](Self::build) on all threads; without the feature `parallel` on one.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn build_parallel(tree: &(impl Topology + Sync), options: Options) -> Result<Self, BuildError> {
        let keys = |seed| {
            if tree.depth() < u64::BITS {
                options.key_set.keys_parallel(tree, 1_u64)
            } else {
                options.key_set.keys_parallel(tree, Path::root(seed))
            }
        };
        with_fold_seeds(Size::of(tree), options, keys, |request| remedied(request, true))
    }
}

/// The inputs that determine the sizes of tables and words.
#[derive(Clone, Copy)]
struct Size {
    /// Number of nodes.
    nodes: usize,
    /// Whether all keys fit 32 bits.
    narrow: bool,
}

impl Size {
    fn of(tree: &impl Topology) -> Self {
        Self { nodes: tree.node_count(), narrow: tree.depth() < u32::BITS }
    }
}

/// The keys to hash, and the inputs of the first attempt.
struct Request<'k> {
    keys: &'k [HashedKey],
    options: Options,
    nodes: usize,
    narrow: bool,
    fold_seed: u64,
}

/// The failure of an attempt, if another seed may succeed.
enum Failure {
    /// Two keys fold to the same value.
    Fold,
    Final(BuildError),
}

fn hashed_keys(tree: &impl Topology, key_set: KeySet, fold_seed: u64) -> Vec<HashedKey> {
    if tree.depth() < u64::BITS { key_set.keys(tree, 1_u64) } else { key_set.keys(tree, Path::root(fold_seed)) }
}

/// Seed number `i`; 0 first.
const fn seed(i: u32) -> u64 {
    mix((i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Attempts the construction, with another fold whenever two folded keys are equal. Among n keys, two are equal with a
/// probability of n^2 / 2^65.
fn with_fold_seeds(
    Size { nodes, narrow }: Size,
    options: Options,
    keys: impl Fn(u64) -> Vec<HashedKey>,
    attempt: impl Fn(&Request<'_>) -> Result<PerfectHash, Failure>,
) -> Result<PerfectHash, BuildError> {
    for fold_seed in (0..SEEDS).map(seed) {
        let keys = keys(fold_seed);
        if let Some(key) = keys.iter().find(|key| key.node.index() >= LIMIT) {
            return Err(BuildError::TooManyNodes { node: key.node });
        }
        match attempt(&Request { keys: &keys, options, nodes, narrow, fold_seed }) {
            Ok(hash) => return Ok(hash),
            Err(Failure::Final(error)) => return Err(error),
            Err(Failure::Fold) => {}
        }
    }
    Err(BuildError::NoSeed { seeds: SEEDS })
}

/// Tries the printed function, then one seed after the other.
fn remedied(request: &Request<'_>, parallel: bool) -> Result<PerfectHash, Failure> {
    for reseeds in 0..=SEEDS {
        match request.table(reseeds, parallel) {
            Err(Failure::Final(BuildError::NoDisplacement { .. })) => {}
            done => return done,
        }
    }
    Err(Failure::Final(BuildError::NoSeed { seeds: SEEDS }))
}

impl Request<'_> {
    /// One attempt, with the printed function or with seed number `reseeds`.
    fn table(&self, reseeds: u32, parallel: bool) -> Result<PerfectHash, Failure> {
        let Self { keys, options: Options { key_set, sizing }, narrow, fold_seed, .. } = *self;
        let mix = Mix { narrow, seed: (reseeds > 0).then(|| seed(reseeds)) };
        let mixed: Vec<HashedKey>;
        let keys = if mix.seed.is_none() {
            keys
        } else {
            mixed = keys.iter().map(|key| HashedKey { key: mix.apply(key.key), ..*key }).collect();
            &mixed
        };
        let (buckets, cells) = self.buckets(keys)?;
        let displacements = buckets.size() as u32;
        let none = |bucket| Failure::Final(no_displacement(bucket, displacements, cells, false));
        let tables = buckets.place(cells, parallel).map_err(none)?;
        let counted = keys.len() as u32;
        let header = Header {
            key_set,
            sizing,
            keys: counted,
            direct: tables.direct,
            displacements,
            cells,
            mix,
            reseeds,
            fold_seed,
        };
        let members = Members::of(self.keys);
        Ok(PerfectHash::from_parts(header, tables.displacements.into(), tables.cells.into(), members))
    }

    /// Groups the keys, and selects D and H. `[HASH-2]`
    fn buckets(&self, keys: &[HashedKey]) -> Result<(Buckets, TableSize), Failure> {
        let count = match self.options.sizing {
            Sizing::Printed => self.nodes,
            Sizing::PrintedHashed => keys.len(),
            Sizing::Tight => return tight(keys),
        };
        let cells = odd_above_twice(count)?;
        let buckets = Buckets::of(keys, highest_power_below_half(count));
        separate(&buckets, cells)?;
        Ok((buckets, cells))
    }
}

/// Returns the highest power of two below half of `count`, at least 1.
const fn highest_power_below_half(count: usize) -> usize {
    if count < 3 { 1 } else { 1 << ((count - 1).ilog2() - 1) }
}

/// Returns the smallest number above `2 count` that is coprime to every power of two.
fn odd_above_twice(count: usize) -> Result<TableSize, Failure> {
    let cells = u32::try_from(2 * count as u64 + 1).ok().and_then(TableSize::new);
    cells.ok_or(Failure::Final(BuildError::TooManyKeys { keys: count }))
}

/// Returns sizes for direct addresses. H grows by an eighth, a limited number of times, if two keys are equal modulo
/// it. With the few cells that remain after direct addresses, this happens by chance, and a bijection would cost many
/// direct addresses.
fn tight(keys: &[HashedKey]) -> Result<(Buckets, TableSize), Failure> {
    const SIZES: usize = 16;
    let buckets = Buckets::of(keys, nearest_power(2 * keys.len()));
    let mut cells = odd_above_twice(buckets.shared())?;
    for _ in 1..SIZES {
        match separate(&buckets, cells) {
            Err(Failure::Final(_)) => cells = odd_above_twice(cells.get() as usize * 9 / 16 + 1)?,
            done => return done.map(|()| (buckets, cells)),
        }
    }
    separate(&buckets, cells).map(|()| (buckets, cells))
}

/// Returns the power of two for which the quotient of the two numbers is nearest to 1: rounded up from sqrt(2) times a
/// power.
const fn nearest_power(count: usize) -> usize {
    let power = count.next_power_of_two();
    if power > 1 && (count as u128).pow(2) < (power as u128).pow(2) / 2 { power / 2 } else { power }
}

fn separate(buckets: &Buckets, cells: TableSize) -> Result<(), Failure> {
    buckets.separate(cells).map_err(|clash| match clash {
        Clash::Same => Failure::Fold,
        Clash::Inseparable(bucket) => Failure::Final(no_displacement(bucket, buckets.size() as u32, cells, true)),
    })
}

const fn no_displacement(bucket: Bucket, displacements: u32, cells: TableSize, inseparable: bool) -> BuildError {
    BuildError::NoDisplacement { bucket: bucket.index, keys: bucket.keys, displacements, cells, inseparable }
}

#[cfg(test)]
mod tests;
