//! Sources of choices.

use alloc::vec::Vec;

use crate::hash::mix;

/// A stream of choices.
pub trait Source {
    /// Returns a number below `bound`, which is at least 1. 0 is the simplest choice.
    fn below(&mut self, bound: u64) -> u64;

    /// Flips a coin; `false` is the simpler side.
    fn coin(&mut self) -> bool {
        self.below(2) == 1
    }
}

/// `SplitMix64` (Steele, Lea & Flood 2014): the same numbers for the same seed, everywhere.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    /// Creates a stream for this seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns the next 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.0)
    }
}

impl Source for Rng {
    #[inline]
    fn below(&mut self, bound: u64) -> u64 {
        // The high half of the product: no division, and a bias below bound / 2^64.
        ((u128::from(self.bits()) * u128::from(bound)) >> 64) as u64
    }
}

/// Choices from bytes, as a fuzzer or a shrinking test provides them: each choice takes the least number of bytes, and
/// is 0 when they run out.
#[cfg(feature = "arbitrary")]
impl Source for arbitrary::Unstructured<'_> {
    fn below(&mut self, bound: u64) -> u64 {
        self.int_in_range(0..=bound - 1).unwrap_or_default()
    }
}

/// All sequences of choices, one after the other.
///
/// ```
/// use stackless_bvh::generate::{Exhaustive, Source};
/// let mut all = Exhaustive::new();
/// let mut seen = Vec::new();
/// while all.next_case() {
///     let first = all.below(2);
///     seen.push((first, if first == 1 { all.below(3) } else { 0 }));
/// }
/// assert_eq!(seen, [(0, 0), (1, 0), (1, 1), (1, 2)]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Exhaustive {
    /// The choices of the current case, with their bounds.
    choices: Vec<(u64, u64)>,
    /// Number of choices that this run has taken.
    taken: usize,
    started: bool,
}

impl Exhaustive {
    /// Starts before the first case.
    pub fn new() -> Self {
        Self::default()
    }

    /// Goes to the next case; returns `false` after the last one.
    pub fn next_case(&mut self) -> bool {
        self.taken = 0;
        if !self.started {
            self.started = true;
            return true;
        }
        while let Some((choice, bound)) = self.choices.pop() {
            if choice + 1 < bound {
                self.choices.push((choice + 1, bound));
                return true;
            }
        }
        false
    }
}

impl Source for Exhaustive {
    fn below(&mut self, bound: u64) -> u64 {
        if self.taken == self.choices.len() {
            self.choices.push((0, bound));
        }
        let (choice, _) = self.choices[self.taken];
        self.taken += 1;
        choice
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seeded_source_keeps_its_bound() {
        let mut rng = Rng::new(7);
        assert!((1..40).chain([255, 256, 257, 65_537, u64::MAX]).all(|bound| rng.below(bound) < bound));
    }

    #[cfg(feature = "arbitrary")]
    #[test]
    fn bytes_keep_the_bound_and_start_simple() {
        use arbitrary::Unstructured;

        let mut rng = Rng::new(7);
        let bytes: Vec<u8> = (0..200).map(|_| rng.bits() as u8).collect();
        let mut from_bytes = Unstructured::new(&bytes);
        for bound in (1..40).chain([255, 256, 257, 65_537, u64::MAX]) {
            assert!(from_bytes.below(bound) < bound);
            assert_eq!(Unstructured::new(&[]).below(bound), 0);
        }
        assert_eq!(Unstructured::new(&[3]).below(1), 0);
        assert_eq!(Unstructured::new(&[3, 9]).below(256), 3);
    }

    #[test]
    fn all_choices_of_a_seeded_source_appear() {
        let mut rng = Rng::new(1);
        let mut seen = [0_u32; 7];
        for _ in 0..7000 {
            seen[rng.below(7) as usize] += 1;
        }
        assert!(seen.iter().all(|&n| n > 800), "{seen:?}");
    }

    #[test]
    fn the_enumeration_has_every_case_once() {
        let (mut all, mut cases) = (Exhaustive::new(), Vec::new());
        while all.next_case() {
            let n = all.below(3);
            cases.push((0..n).map(|_| all.below(4)).collect::<Vec<_>>());
        }
        assert_eq!(cases.len(), 1 + 4 + 16);
        cases.dedup();
        assert_eq!(cases.len(), 21);
    }
}
