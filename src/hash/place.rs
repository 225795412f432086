//! Placement of keys: buckets by decreasing size, and for each the first displacement under which its cells are free.

use alloc::vec;
use alloc::vec::Vec;

use super::address::encode;
use super::keys::HashedKey;
use super::{Modulo, Reciprocal, TableSize};
use crate::threads;

/// The keys, grouped by their displacement.
pub(super) struct Buckets {
    /// Indexed by the low bits of a key: the address of a key that is alone there, otherwise 0.
    displacements: Vec<u32>,
    /// Keys that share a displacement, bucket by bucket.
    shared: Vec<HashedKey>,
    /// Their buckets, the largest first; of equal sizes the lower index first.
    by_size: Vec<Bucket>,
    direct: u32,
}

/// Keys with the same displacement, two or more.
#[derive(Clone, Copy)]
pub(super) struct Bucket {
    pub(super) index: u32,
    start: u32,
    pub(super) keys: u32,
}

/// The two tables, with the addresses in place.
pub(super) struct Tables {
    pub(super) displacements: Vec<u32>,
    pub(super) cells: Vec<u32>,
    /// Number of keys whose address is in the table of displacements.
    pub(super) direct: u32,
}

/// Two keys of a bucket that are equal modulo H.
pub(super) enum Clash {
    /// They are the same number.
    Same,
    Inseparable(Bucket),
}

impl Buckets {
    /// Groups keys by their low bits; `size` is a power of two. Two passes of counting sort: linear in keys and
    /// buckets.
    pub(super) fn of(keys: &[HashedKey], size: usize) -> Self {
        let index = |key: &HashedKey| key.key as usize & (size - 1);
        let mut counts = vec![0_u32; size];
        for key in keys {
            counts[index(key)] += 1;
        }
        let largest = counts.iter().copied().fold(1, u32::max);
        let mut by_count = vec![0_u32; largest as usize + 1];
        for &count in &counts {
            by_count[count as usize] += 1;
        }
        let direct = by_count[1];
        // The number of larger buckets is the start of the buckets of a size.
        let mut larger = 0;
        for count in by_count[2..].iter_mut().rev() {
            larger += core::mem::replace(count, larger);
        }
        let mut buckets = vec![Bucket { index: 0, start: 0, keys: 0 }; larger as usize];
        let mut next = counts;
        let mut start = 0;
        for (index, place) in (0..).zip(&mut next) {
            let keys = *place;
            if keys > 1 {
                let at = &mut by_count[keys as usize];
                buckets[*at as usize] = Bucket { index, start, keys };
                *at += 1;
                *place = start + 2;
                start += keys;
            }
        }
        // Now 1 for a lone key; for other keys two more than the place of the next.
        let mut displacements = vec![0; size];
        let mut shared = vec![HashedKey::NONE; keys.len() - direct as usize];
        for key in keys {
            let place = &mut next[index(key)];
            if *place == 1 {
                displacements[index(key)] = encode(key.node);
            } else {
                shared[*place as usize - 2] = *key;
                *place += 1;
            }
        }
        Self { displacements, shared, by_size: buckets, direct }
    }

    /// Returns D.
    pub(super) const fn size(&self) -> usize {
        self.displacements.len()
    }

    /// Returns the number of keys that share a displacement.
    pub(super) fn shared(&self) -> usize {
        self.shared.len()
    }

    /// Refuses an H modulo which two keys of a bucket are equal.
    pub(super) fn separate(&self, size: TableSize) -> Result<(), Clash> {
        let modulo = Reciprocal::of(size);
        let mut remainders = Vec::new();
        for &bucket in &self.by_size {
            remainders.clear();
            remainders.extend(self.shared[bucket.range()].iter().map(|key| (modulo.of_u64(key.key), key.key)));
            remainders.sort_unstable();
            for pair in remainders.windows(2) {
                if pair[0] == pair[1] {
                    return Err(Clash::Same);
                }
                if pair[0].0 == pair[1].0 {
                    return Err(Clash::Inseparable(bucket));
                }
            }
        }
        Ok(())
    }

    /// Finds the displacements for H = `size`, modulo which the buckets are [separate](Self::separate). Returns the
    /// first bucket for which there is none. `[HASH-8]`
    ///
    /// Buckets are placed one after the other, each at the least displacement under which all its cells are free. Many
    /// threads first search for the least displacement of each bucket of a batch, in the table before the batch. Then
    /// each bucket is placed in order, and its search continues from there. The tables are the same: cells only fill,
    /// so a displacement that does not fit before the batch does not fit later, and none is skipped.
    pub(super) fn place(self, size: TableSize, parallel: bool) -> Result<Tables, Bucket> {
        let modulo = Reciprocal::of(size);
        let Self { mut displacements, shared, by_size, direct } = self;
        let remainders: Vec<u32> = shared.iter().map(|key| modulo.of_u64(key.key)).collect();
        let mut cells = vec![0; size.get() as usize];
        let mut taken = Taken::none(size);
        for batch in by_size.chunks(if parallel { BATCH } else { by_size.len().max(1) }) {
            let earliest = if parallel { first_fits(&taken, batch, &remainders) } else { Vec::new() };
            for (i, bucket) in batch.iter().enumerate() {
                let from = earliest.get(i).map_or(Some(0), |&fit| fit);
                let fit = from.and_then(|from| taken.first_fit(&remainders[bucket.range()], from));
                let displacement = fit.ok_or(*bucket)?;
                for i in bucket.range() {
                    let cell = taken.cell(remainders[i], displacement);
                    taken.take(cell);
                    cells[cell] = encode(shared[i].node);
                }
                displacements[bucket.index as usize] = displacement;
            }
        }
        Ok(Tables { displacements, cells, direct })
    }
}

/// Buckets that threads search for in one batch.
const BATCH: usize = 1 << 12;

/// Returns for each bucket of a batch the least displacement under which all its cells are free.
fn first_fits(taken: &Taken, batch: &[Bucket], remainders: &[u32]) -> Vec<Option<u32>> {
    threads::map(0..batch.len(), 64, |i| taken.first_fit(&remainders[batch[i].range()], 0))
}

impl Bucket {
    fn range(&self) -> core::ops::Range<usize> {
        self.start as usize..(self.start + self.keys) as usize
    }
}

/// The taken cells, one bit each. After the last cell the bits repeat, so 64 consecutive cells can be read from any
/// position.
struct Taken {
    words: Vec<u64>,
    size: usize,
}

impl Taken {
    fn none(size: TableSize) -> Self {
        let size = size.get() as usize;
        Self { words: vec![0; size / 64 + 3], size }
    }

    /// Returns the cell of a key with this remainder.
    fn cell(&self, remainder: u32, displacement: u32) -> usize {
        let cell = remainder as usize + displacement as usize;
        if cell < self.size { cell } else { cell - self.size }
    }

    fn take(&mut self, cell: usize) {
        for bit in (cell..self.size + 64).step_by(self.size) {
            self.words[bit / 64] |= 1 << (bit % 64);
        }
    }

    /// Returns a word whose bit `i` is set if the cell `i` after this one is taken.
    fn row(&self, cell: usize) -> u64 {
        let words = u128::from(self.words[cell / 64]) | u128::from(self.words[cell / 64 + 1]) << 64;
        (words >> (cell % 64)) as u64
    }

    /// Returns the least displacement, at least `from`, under which the cells of all remainders are free; no
    /// displacement below `from` may fit. It tests sixty-four at a time.
    fn first_fit(&self, remainders: &[u32], from: u32) -> Option<u32> {
        for displacement in (from..self.size as u32).step_by(64) {
            let mut taken = 0;
            for &remainder in remainders {
                taken |= self.row(self.cell(remainder, displacement));
                if taken == u64::MAX {
                    break;
                }
            }
            if taken != u64::MAX {
                // After H the displacements repeat, with those that do not fit.
                let fit = displacement + taken.trailing_ones();
                return ((fit as usize) < self.size).then_some(fit);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Rng, Source};

    #[test]
    fn sixty_four_at_a_time_is_one_at_a_time() {
        let mut rng = Rng::new(5);
        for size in [1, 2, 3, 5, 31, 63, 64, 65, 127, 128, 129, 1000] {
            let mut taken = Taken::none(TableSize::new(size).unwrap());
            let mut plain = vec![false; size as usize];
            for _ in 0..2 * size {
                let remainders: Vec<u32> = (0..=rng.below(4)).map(|_| rng.below(u64::from(size)) as u32).collect();
                let is_free = |d: &u32| remainders.iter().all(|r| !plain[((r + d) % size) as usize]);
                let expected = (0..size).find(is_free);
                assert_eq!(taken.first_fit(&remainders, 0), expected, "{size}");
                if let Some(fit) = expected {
                    let from = rng.below(u64::from(fit) + 1) as u32;
                    assert_eq!(taken.first_fit(&remainders, from), expected);
                }
                let cell = rng.below(u64::from(size)) as usize;
                taken.take(cell);
                plain[cell] = true;
            }
        }
    }
}
