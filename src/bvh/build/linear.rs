//! The fast builder: clusters along a space-filling curve, then the surface area heuristic over them and in them.
//!
//! Centroids are sorted by their Morton codes (Lauterbach et al. 2009, "Fast BVH construction on GPUs"). Where the codes of
//! few items have the same first bits, these are a cluster. A tree by surface area over the clusters (Garanzha, Pantaleoni &
//! `McAllister` 2011, "Simpler and faster HLBVH with work queues") goes on in each cluster with its items (Ganestam et al. 2015, "Bonsai").

use std::ops::Range;

use glam::Vec3A;
use rayon::prelude::*;

use super::BuildError;
use super::bins::Scale;
use super::draft::Draft;
use super::item::{CHUNK, Extents, Item, Spread};
use super::sah::{self, SahOptions};
use super::sweep::{self, indices};
use super::top_down;

/// Items that a cluster may have.
const CLUSTER: usize = sweep::MAX;

/// Items that a cluster may have if all have the same code.
const CELL: usize = 512;

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    options.check(items.len())?;
    let (mut items, codes) = along_the_curve(&items);
    let mut clusters = Vec::new();
    cluster(&mut items, &codes, 0, &mut clusters);
    // Levels that must be left for each cluster.
    let most = clusters.iter().map(ExactSizeIterator::len).max().unwrap_or(1);
    let below = most.div_ceil(options.max_leaf as usize).next_power_of_two().ilog2();
    let depth_limit = options.depth_limit.saturating_sub(below);
    let above = SahOptions { max_leaf: 1, depth_limit, ..options };
    if options.depth_limit < below || above.check(clusters.len()).is_err() {
        return sah::build(items, options, progress);
    }
    let boxes =
        |(i, range): (usize, &Range<usize>)| Item::new(&Extents::of(&items[range.clone()]).boxes.aabb(), i as u32);
    let as_items = clusters.par_iter().with_min_len(CHUNK).enumerate().map(boxes).collect();
    let top = top_down::build(as_items, |range, extents, depth| above.cut(range, extents, depth), &|_| ());
    // Whether few items are better in two leaves is not asked: it takes longer than it saves.
    let cut = |range: &mut [Item], extents: &Extents, depth| {
        (range.len() > options.max_leaf as usize).then(|| options.cut(range, extents, depth)).flatten()
    };
    Ok(top_down::go_on(top, items, &clusters, cut, progress))
}

/// Bits of a code along each axis.
const BITS: u32 = 11;

/// Bits of the index below a code.
const INDEX_BITS: u32 = 31;

/// The items by the codes of their centroids, and codes with former indices below them.
fn along_the_curve(items: &[Item]) -> (Vec<Item>, Vec<u64>) {
    // Cells are cubes: of flat ones a few far items would make sheets.
    let Spread { lo, hi } = Extents::of(items).centroids;
    let cube = Spread { lo, hi: lo + Vec3A::splat((hi - lo).max_element()) };
    let scale = Scale::new(cube, 1 << BITS);
    let code = |(i, item): (usize, &Item)| {
        let [x, y, z] = indices(scale.bins(item.centroid())).map(spread);
        (x << 2 | y << 1 | z) << INDEX_BITS | i as u64
    };
    let codes: Vec<_> = items.par_iter().with_min_len(CHUNK).enumerate().map(code).collect();
    let codes = sorted(codes);
    let item = |code: &u64| items[(code & ((1 << INDEX_BITS) - 1)) as usize];
    (codes.par_iter().with_min_len(CHUNK).map(item).collect(), codes)
}

/// Puts two zeros between any two of the lowest [`BITS`] bits.
fn spread(bits: u32) -> u64 {
    let bits = u64::from(bits) & ((1 << BITS) - 1);
    let bits = (bits | bits << 16) & 0x0000_0700_00ff;
    let bits = (bits | bits << 8) & 0x0000_0700_f00f;
    let bits = (bits | bits << 4) & 0x0000_430c_30c3;
    (bits | bits << 2) & 0x0002_4924_9249
}

/// Sorts by the codes, [`BITS`] bits at a time; indices are in order already.
fn sorted(mut codes: Vec<u64>) -> Vec<u64> {
    const DIGITS: usize = 1 << BITS;
    if codes.len() < DIGITS {
        codes.sort_unstable();
        return codes;
    }
    let digit = |code: u64, pass: u32| (code >> (INDEX_BITS + pass * BITS)) as usize % DIGITS;
    let mut starts = vec![[0_u32; DIGITS]; 3];
    for &code in &codes {
        for (pass, counts) in (0..).zip(&mut starts) {
            counts[digit(code, pass)] += 1;
        }
    }
    let mut other = vec![0; codes.len()];
    for (pass, starts) in (0..).zip(&mut starts) {
        let mut start = 0;
        for count in &mut *starts {
            start += std::mem::replace(count, start);
        }
        for &code in &codes {
            let place = &mut starts[digit(code, pass)];
            other[*place as usize] = code;
            *place += 1;
        }
        std::mem::swap(&mut codes, &mut other);
    }
    codes
}

/// Adds the clusters of these items, which start at `first` among all.
fn cluster(items: &mut [Item], codes: &[u64], first: usize, clusters: &mut Vec<Range<usize>>) {
    let (Some(lowest), Some(highest)) = (codes.first(), codes.last()) else { return };
    let difference = (lowest ^ highest) >> INDEX_BITS;
    if items.len() <= CLUSTER {
        clusters.push(first..first + items.len());
    } else if difference != 0 {
        // The first bit in which they differ is where all others are divided.
        let bit = INDEX_BITS + difference.ilog2();
        let left = codes.partition_point(|code| code >> bit & 1 == 0);
        let (items, right_items) = items.split_at_mut(left);
        let (codes, right_codes) = codes.split_at(left);
        cluster(items, codes, first, clusters);
        cluster(right_items, right_codes, first + left, clusters);
    } else if items.len() <= CELL {
        clusters.push(first..first + items.len());
    } else {
        // Codes over a smaller region tell more, unless all are equal.
        let (ordered, codes) = along_the_curve(items);
        items.copy_from_slice(&ordered);
        let first_code = codes.first().map(|code| code >> INDEX_BITS);
        if first_code == codes.last().map(|code| code >> INDEX_BITS) {
            let starts = (0..items.len()).step_by(CELL);
            clusters.extend(starts.map(|start| first + start..first + items.len().min(start + CELL)));
        } else {
            cluster(items, &codes, first, clusters);
        }
    }
}

#[cfg(test)]
mod tests;
