//! Interleaved timing of the pairs.

use std::hint::black_box;

use stackless_bvh::geom::Ray;

use super::pairs::{Pair, Trees};
use crate::judge::Query;
use crate::turns::{median, median_ratio, take_turns};

/// The time of a pair for the rays of a set.
pub(super) struct Time {
    /// Number of timed rays.
    pub(super) rays: u64,
    /// Per ray: the median over the chunks.
    pub(super) nanoseconds: f64,
    /// Relative to the baseline: the median over the chunks.
    pub(super) ratio: f64,
}

/// Number of rays in a turn: some milliseconds, so that few turns are interrupted.
const CHUNK: usize = 2048;

/// Times all pairs.
pub(super) fn measure(
    pairs: &[Pair],
    trees: &Trees,
    query: Query,
    rays: &[Ray],
    rounds: usize,
    name: &str,
) -> Vec<Time> {
    let mut memory = Vec::new();
    let times = take_turns(pairs.len(), rays.len(), CHUNK, rounds, name, |p, chunk| {
        black_box(pairs[p].trace(query, trees, &rays[chunk], &mut memory));
    });
    let baseline = times.by_chunk(pairs.iter().position(Pair::is_baseline).unwrap_or(0));
    let lengths = times.lengths();
    let time = |p: usize| {
        let own = times.by_chunk(p);
        Time {
            rays: rays.len() as u64,
            nanoseconds: median(own.iter().zip(lengths).map(|(time, &length)| time * 1e9 / length as f64).collect()),
            ratio: median_ratio(&own, &baseline),
        }
    };
    (0..pairs.len()).map(time).collect()
}
