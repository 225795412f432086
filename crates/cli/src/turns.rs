//! Interleaved timing of contestants on one thread.

use std::ops::Range;
use std::time::Duration;

use cpu_time::ThreadTime;

use crate::output::bar;

/// Processor time of each contestant for each chunk of the rays in each round, in seconds.
pub(crate) struct Times {
    /// By contestant, chunk and round.
    seconds: Vec<Vec<Vec<f64>>>,
    /// Rays in each chunk.
    lengths: Vec<usize>,
}

/// Times `contestants` on one thread. `trace` traces the rays of a range with a contestant.
///
/// Contestants alternate after each chunk of up to `chunk` rays, so other work of the machine slows down all of them
/// equally.
pub(crate) fn take_turns(
    contestants: usize,
    rays: usize,
    chunk: usize,
    rounds: usize,
    name: &str,
    mut trace: impl FnMut(usize, Range<usize>),
) -> Times {
    // A small number of rays is also divided into chunks, so that there are other rays to warm up with.
    let length = chunk.min(rays.div_ceil(8)).max(1);
    let chunks: Vec<_> = (0..rays).step_by(length).map(|start| start..rays.min(start + length)).collect();
    // The warm-up traces at least the rays of a full chunk, or all other chunks.
    let half = chunks.len() / 2;
    let warm_up = if rays >= 2 * chunk { half..half + 1 } else { 1..chunks.len() };
    let mut seconds = vec![vec![Vec::with_capacity(rounds); chunks.len()]; contestants];
    let progress = bar((rounds * chunks.len()) as u64, &format!("{name}, times"));
    for turn in 0..rounds * chunks.len() {
        // Each turn starts with a different contestant, so that the predecessors vary.
        for i in 0..contestants {
            let contestant = (turn + i) % contestants;
            // Each contestant traces a different chunk than its predecessor, which would leave the nodes in the caches.
            // Untimed other chunks first bring the caches to the state in the middle of a run.
            let c = (turn + contestant) % chunks.len();
            for ahead in warm_up.clone() {
                trace(contestant, chunks[(c + ahead) % chunks.len()].clone());
            }
            let start = ThreadTime::now();
            trace(contestant, chunks[c].clone());
            // A time of 0 would make ratios undefined.
            let time = start.elapsed().max(Duration::from_nanos(1));
            seconds[contestant][c].push(time.as_secs_f64());
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    Times { seconds, lengths: chunks.iter().map(ExactSizeIterator::len).collect() }
}

impl Times {
    /// Rays in each chunk.
    pub(crate) fn lengths(&self) -> &[usize] {
        &self.lengths
    }

    /// Seconds for each chunk: the least of all rounds, because other work of the machine only adds time.
    pub(crate) fn by_chunk(&self, contestant: usize) -> Vec<f64> {
        let least = |rounds: &Vec<f64>| rounds.iter().copied().fold(f64::INFINITY, f64::min);
        self.seconds[contestant].iter().map(least).collect()
    }

    /// Seconds for each round of all chunks.
    pub(crate) fn by_round(&self, contestant: usize) -> Vec<f64> {
        let chunks = &self.seconds[contestant];
        let rounds = chunks.iter().map(Vec::len).min().unwrap_or(0);
        (0..rounds).map(|round| chunks.iter().map(|chunk| chunk[round]).sum()).collect()
    }
}

/// The median of the quotients of corresponding numbers.
pub(crate) fn median_ratio(numerators: &[f64], denominators: &[f64]) -> f64 {
    median(numerators.iter().zip(denominators).map(|(a, b)| a / b).collect())
}

/// The median, the upper one of two; NaN without values.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The geometric mean; `None` without values.
pub(crate) fn geometric_mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let logarithms: Vec<_> = values.map(f64::ln).collect();
    (!logarithms.is_empty()).then(|| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_time_all_rays_in_each_round_and_none_what_was_timed_before_it() {
        for (contestants, rays, chunk, rounds) in [(3, 1000, 64, 3), (2, 100, 64, 2), (4, 7, 64, 1), (1, 1, 1, 2)] {
            let mut calls = Vec::new();
            let times = take_turns(contestants, rays, chunk, rounds, "", |who, range| calls.push((who, range)));
            let chunks = times.lengths().len();
            assert_eq!(times.lengths().iter().sum::<usize>(), rays);
            // The last call of a turn is timed, after another chunk or all other chunks.
            let turn = if rays >= 2 * chunk { 2 } else { chunks };
            assert_eq!(calls.len(), contestants * chunks * rounds * turn);
            let timed: Vec<_> = calls.chunks(turn).map(|turn| turn[turn.len() - 1].clone()).collect();
            for who in 0..contestants {
                let mut own: Vec<_> = timed.iter().filter(|call| call.0 == who).map(|call| call.1.clone()).collect();
                own.sort_by_key(|range| range.start);
                let all: Vec<_> = own.iter().step_by(rounds).flat_map(|range| vec![range.clone(); rounds]).collect();
                assert_eq!(own, all);
                assert_eq!(
                    own.iter().step_by(rounds).flat_map(Clone::clone).collect::<Vec<_>>(),
                    (0..rays).collect::<Vec<_>>()
                );
                let least: f64 = times.by_chunk(who).iter().sum();
                assert!(least > 0.0 && times.by_round(who).len() == rounds);
                assert!(times.by_round(who).iter().all(|&seconds| seconds >= least * 0.999));
            }
            let within = timed.chunks(contestants).flat_map(|turns| turns.windows(2));
            assert!(within.clone().all(|pair| pair[0].1 != pair[1].1 || chunks == 1));
        }
    }

    #[test]
    fn means() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert!(median(Vec::new()).is_nan());
        assert_eq!(median_ratio(&[2.0, 9.0, 8.0], &[1.0, 3.0, 2.0]), 3.0);
        assert_eq!(geometric_mean([2.0, 8.0].into_iter()).map(f64::round), Some(4.0));
        assert_eq!(geometric_mean(std::iter::empty()), None);
    }
}
