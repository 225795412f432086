//! Tables for lookups, built step by step. Cases only query where each key leads.

/// The maximum number of seeds tried.
const SEEDS: u64 = 100;

/// The sizes of a table: its cells and its displacements. `[HASH-2]`
#[derive(Clone, Copy, Debug)]
pub(super) enum Sizes {
    /// The printed sizes, for a number of nodes or keys.
    Printed(usize),
    /// Sizes for addresses in the table of displacements.
    Tight,
}

/// A table of some keys.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) displacements: Vec<u32>,
    pub(super) cells: Vec<u32>,
    /// The seed of the bijection applied to the keys, if any.
    pub(super) seed: Option<u64>,
}

impl Sizes {
    /// Returns all sizes with their names, for a number of nodes and of hashed keys.
    pub(super) fn of(nodes: usize, keys: usize) -> [(&'static str, Self); 3] {
        [("printed", Self::Printed(nodes)), ("printed-hashed", Self::Printed(keys)), ("tight", Self::Tight)]
    }

    fn displacements(self, keys: usize) -> usize {
        match self {
            Self::Printed(count) => half(count),
            // The power of two whose quotient with twice the number of keys is closest to 1.
            Self::Tight => {
                let (count, power) = (2 * keys, (2 * keys).next_power_of_two());
                if power > 1 && 2 * count * count < power * power { power / 2 } else { power }
            }
        }
    }

    /// Returns numbers of cells to try in order, if `shared` keys share a displacement.
    fn cells(self, shared: usize) -> Vec<usize> {
        match self {
            Self::Printed(count) => vec![2 * count + 1],
            Self::Tight => {
                std::iter::successors(Some(2 * shared + 1), |h| Some(2 * (h * 9 / 16 + 1) + 1)).take(16).collect()
            }
        }
    }
}

/// Returns the highest power of two below half of a number, at least 1.
pub(super) fn half(count: usize) -> usize {
    let powers = std::iter::successors(Some(1), |power| Some(2 * power));
    powers.take_while(|power| 2 * power < count).last().unwrap_or(1)
}

impl Table {
    /// Builds a table for keys with the words of their nodes: with the printed function, or with the first seed that
    /// works. `[HASH-7]`
    pub(super) fn of(keys: &[(u64, u32)], sizes: Sizes, is_narrow: bool) -> Option<Self> {
        let seed = |i: u64| mix_64(i.wrapping_mul(0x9e37_79b9_7f4a_7c15), 0);
        std::iter::once(None).chain((1..=SEEDS).map(seed).map(Some)).find_map(|seed| {
            let key = |key| seed.map_or(key, |seed| mixed(key, seed, is_narrow));
            let keys: Vec<_> = keys.iter().map(|&(plain, word)| (key(plain), word)).collect();
            let (displacements, cells) = tables(&keys, sizes)?;
            Some(Self { displacements, cells, seed })
        })
    }
}

/// Applies the bijection of a seed to a key.
pub(crate) fn mixed(key: u64, seed: u64, narrow: bool) -> u64 {
    if narrow { u64::from(mix_32(key as u32, seed as u32)) } else { mix_64(key, seed) }
}

/// Implements the 64-bit mix of `INTERPRETING.md`.
pub(super) fn mix_64(key: u64, seed: u64) -> u64 {
    let mut k = key ^ seed;
    k ^= k >> 30;
    k = k.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    k ^= k >> 27;
    k = k.wrapping_mul(0x94d0_49bb_1331_11eb);
    k ^ k >> 31
}

/// Implements the 32-bit mix of `INTERPRETING.md`.
fn mix_32(key: u32, seed: u32) -> u32 {
    let mut k = key ^ seed;
    k ^= k >> 16;
    k = k.wrapping_mul(0x7feb_352d);
    k ^= k >> 15;
    k = k.wrapping_mul(0x846c_a68b);
    k ^ k >> 16
}

/// Computes displacements and cells: places the largest buckets first, each at the least displacement that fits.
/// `[HASH-8]`
fn tables(keys: &[(u64, u32)], sizes: Sizes) -> Option<(Vec<u32>, Vec<u32>)> {
    let mut buckets = vec![Vec::new(); sizes.displacements(keys.len())];
    let size = buckets.len() as u64;
    for &(key, word) in keys {
        buckets[(key % size) as usize].push((key, word));
    }
    let mut displacements = vec![0; buckets.len()];
    let mut shared = Vec::new();
    for (index, bucket) in buckets.into_iter().enumerate() {
        match bucket[..] {
            [] => {}
            [(_, word)] => displacements[index] = word,
            _ => shared.push((index, bucket)),
        }
    }
    // Buckets of equal size keep their order.
    shared.sort_by_key(|(_, bucket)| std::cmp::Reverse(bucket.len()));
    let is_apart = |h: &usize| {
        shared.iter().all(|(_, bucket)| {
            let rests: std::collections::BTreeSet<_> = bucket.iter().map(|(key, _)| key % *h as u64).collect();
            rests.len() == bucket.len()
        })
    };
    let h = sizes.cells(shared.iter().map(|(_, bucket)| bucket.len()).sum()).into_iter().find(is_apart)?;
    let mut cells = vec![0; h];
    for (index, bucket) in shared {
        let cell = |key: u64, displacement: usize| ((key % h as u64) as usize + displacement) % h;
        let is_free = |&displacement: &usize| bucket.iter().all(|&(key, _)| cells[cell(key, displacement)] == 0);
        let displacement = (0..h).find(is_free)?;
        for (key, word) in bucket {
            cells[cell(key, displacement)] = word;
        }
        displacements[index] = displacement as u32;
    }
    Some((displacements, cells))
}
