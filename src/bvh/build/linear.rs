//! The fast builder: clusters along a space-filling curve, and the surface area heuristic over and in them.
//!
//! Centroids are sorted by their Morton codes (Lauterbach et al. 2009, "Fast BVH construction on GPUs"). Where the
//! codes of some items have the same first bits, these are a cluster. Over the clusters stands a tree by surface area
//! (Garanzha, Pantaleoni & `McAllister` 2011, "Simpler and faster HLBVH with work queues"). In a cluster, many items
//! are cut where their codes first differ, few where it is cheapest by surface area between neighbours on the curve. So
//! no item moves.

mod forest;

use std::ops::Range;

use glam::Vec3A;

use super::bins::Scale;
use super::draft::{Draft, DraftNode};
use super::item::{CHUNK, Item, Spread};
use super::sah::{self, SahOptions};
use super::sweep::indices;
use super::{BuildError, top_down};
use crate::threads;
use forest::{Forest, Growth};

/// Items that a cluster may have.
const CLUSTER: usize = 64;

/// Levels in a cluster beyond those that it needs.
const SPARE_LEVELS: u32 = 2;

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    options.check(items.len())?;
    let mut codes: Vec<_> = (0..items.len() as u64).collect();
    sort(&items, &mut codes);
    let mut clusters = Vec::new();
    cluster(&items, &mut codes, 0, &mut clusters);
    // Levels that must be left for each cluster.
    let most = clusters.iter().map(ExactSizeIterator::len).max().unwrap_or(1);
    let levels = most.div_ceil(options.max_leaf as usize).next_power_of_two().ilog2() + SPARE_LEVELS;
    let above = SahOptions { max_leaf: 1, depth_limit: options.depth_limit.saturating_sub(levels), ..options };
    if options.depth_limit < levels || above.check(clusters.len()).is_err() {
        return sah::build(items, options, progress);
    }
    let growth = Growth { items: &items, codes: &codes, max_leaf: options.max_leaf, levels, progress };
    let share = clusters.len().div_ceil(threads::count());
    let forest = threads::reduce(&clusters, share, |clusters| growth.forest(clusters), Forest::and);
    let Some(Forest { mut nodes, roots, references }) = forest else {
        return Err(BuildError::Empty);
    };
    let as_items = (0..).zip(&roots).map(|(i, root)| Item::new(&root.aabb, i)).collect();
    let top = top_down::build(as_items, |range, extents, depth| above.cut(range, extents, depth), &|_| ());
    let by = nodes.len() - 1;
    let mut above = top.nodes.iter().map(|node| {
        // Its leaves are the clusters.
        if node.is_leaf() { roots[top.references[node.references().start] as usize] } else { node.moved(by) }
    });
    nodes[0] = above.next().unwrap_or(DraftNode::NONE);
    nodes.extend(above);
    Ok(Draft { nodes, references })
}

/// Bits of a code along each axis.
const BITS: u32 = 11;

/// Bits of the index below a code.
const INDEX_BITS: u32 = 31;

/// Where the item of a code is.
fn index(code: u64) -> usize {
    (code & ((1 << INDEX_BITS) - 1)) as usize
}

/// Gives all items that `codes` refers to their codes, relative to each other, and sorts them.
fn sort(items: &[Item], codes: &mut [u64]) {
    let of = |chunk: &[u64]| chunk.iter().fold(Spread::EMPTY, |all, &code| all.add(items[index(code)].centroid()));
    let Spread { lo, hi } = threads::reduce(codes, CHUNK, of, Spread::union).unwrap_or(Spread::EMPTY);
    // Cells are cubes: of flat ones a few far items would make sheets.
    let cube = Spread { lo, hi: lo + Vec3A::splat((hi - lo).max_element()) };
    let scale = Scale::new(cube, 1 << BITS);
    threads::update(codes, CHUNK, |code| {
        let [x, y, z] = indices(scale.bins(items[index(*code)].centroid())).map(spread);
        *code = (x << 2 | y << 1 | z) << INDEX_BITS | index(*code) as u64;
    });
    radix_sort(codes);
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
fn radix_sort(codes: &mut [u64]) {
    const DIGITS: usize = 1 << BITS;
    if codes.len() < DIGITS {
        codes.sort_unstable();
        return;
    }
    let digit = |code: u64, pass: u32| (code >> (INDEX_BITS + pass * BITS)) as usize % DIGITS;
    let mut starts = vec![[0_u32; DIGITS]; 3];
    for &code in &*codes {
        for (pass, counts) in (0..).zip(&mut starts) {
            counts[digit(code, pass)] += 1;
        }
    }
    let mut other = vec![0; codes.len()];
    let (mut from, mut to) = (&mut *codes, &mut *other);
    for (pass, starts) in (0..).zip(&mut starts) {
        let mut start = 0;
        for count in &mut *starts {
            start += std::mem::replace(count, start);
        }
        for &code in &*from {
            let place = &mut starts[digit(code, pass)];
            to[*place as usize] = code;
            *place += 1;
        }
        std::mem::swap(&mut from, &mut to);
    }
    to.copy_from_slice(from);
}

/// Adds the clusters of these codes, which start at `first` among all.
fn cluster(items: &[Item], codes: &mut [u64], first: usize, clusters: &mut Vec<Range<usize>>) {
    if codes.len() <= CLUSTER {
        clusters.push(first..first + codes.len());
    } else if let Some(left) = border(codes) {
        let (codes, right_codes) = codes.split_at_mut(left);
        cluster(items, codes, first, clusters);
        cluster(items, right_codes, first + left, clusters);
    } else {
        // Codes over a smaller region tell more, unless all are equal.
        sort(items, codes);
        if border(codes).is_none() {
            let starts = (0..codes.len()).step_by(CLUSTER);
            clusters.extend(starts.map(|start| first + start..first + codes.len().min(start + CLUSTER)));
        } else {
            cluster(items, codes, first, clusters);
        }
    }
}

/// How many sorted codes have a 0 where some of them first differ: those that have a 1 come after them.
fn border(codes: &[u64]) -> Option<usize> {
    let difference = (codes.first()? ^ codes.last()?) >> INDEX_BITS;
    let bit = INDEX_BITS + difference.checked_ilog2()?;
    Some(codes.partition_point(|code| code >> bit & 1 == 0))
}

#[cfg(test)]
mod tests;
