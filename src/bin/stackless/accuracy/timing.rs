//! Times of the pairs, in turns.

use std::hint::black_box;
use std::time::Instant;

use stackless_bvh::geom::Ray;

use super::pairs::{Pair, Query, Trees};
use crate::output::bar;

/// What a pair takes for the rays of a set.
pub(super) struct Time {
    /// Rays that were timed.
    pub(super) rays: u64,
    /// For one ray: the median over the chunks.
    pub(super) nanoseconds: f64,
    /// To the baseline: the median over the chunks.
    pub(super) ratio: f64,
}

/// Rays that are timed before it is another pair's turn: some milliseconds, so that few chunks are interrupted.
const CHUNK: usize = 2048;

/// Times all pairs on one thread. Of the times of a chunk the least counts: what is added is other work of the machine.
pub(super) fn measure(
    pairs: &[Pair],
    trees: &Trees,
    query: Query,
    rays: &[Ray],
    rounds: usize,
    name: &str,
) -> Vec<Time> {
    // Few rays are cut in some chunks as well, so that there is a median, and other rays to warm up with.
    let chunks: Vec<_> = rays.chunks(CHUNK.min(rays.len().div_ceil(8)).max(1)).collect();
    // As many rays as are in a full chunk, or all others.
    let half = chunks.len() / 2;
    let warm_up = if rays.len() >= 2 * CHUNK { half..half + 1 } else { 1..chunks.len() };
    // times[p][c]: seconds of pair p for chunk c.
    let mut times = vec![vec![f64::INFINITY; chunks.len()]; pairs.len()];
    let mut memory = Vec::new();
    let progress = bar((rounds * chunks.len()) as u64, &format!("{name}, times"));
    for turn in 0..rounds * chunks.len() {
        for i in 0..pairs.len() {
            let p = (turn + i) % pairs.len();
            // Other rays than the pair before, which would leave the nodes of these in the caches; and still others
            // first, untimed, after which the caches hold what they hold in the middle of a run.
            let c = (turn + p) % chunks.len();
            for ahead in warm_up.clone() {
                black_box(pairs[p].trace(query, trees, chunks[(c + ahead) % chunks.len()], &mut memory));
            }
            let start = Instant::now();
            black_box(pairs[p].trace(query, trees, chunks[c], &mut memory));
            times[p][c] = times[p][c].min(start.elapsed().as_secs_f64());
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    let baseline = pairs.iter().position(Pair::is_baseline).unwrap_or(0);
    let time = |own: &Vec<f64>| Time {
        rays: rays.len() as u64,
        nanoseconds: median(own.iter().zip(&chunks).map(|(time, chunk)| time * 1e9 / chunk.len() as f64).collect()),
        ratio: median(own.iter().zip(&times[baseline]).map(|(own, base)| own / base).collect()),
    };
    times.iter().map(time).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
