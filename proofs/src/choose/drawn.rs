//! Choices case by case: enumerated or random.

use alloc::collections::BTreeMap;

use stackless_bvh::generate::{Exhaustive, Rng, Source};

use super::Choose;

/// The source of numbers.
#[derive(Clone, Debug)]
pub enum Cases {
    /// Every case once.
    All(Exhaustive),
    /// Random cases, with extremes more often.
    Some(Rng),
}

/// Choices for one case after another, with the records of all cases.
#[derive(Clone, Debug)]
pub struct Drawn<const PLANTED: bool> {
    cases: Cases,
    /// Whether each cover has been reached.
    pub covers: BTreeMap<&'static str, bool>,
}

impl<const PLANTED: bool> Drawn<PLANTED> {
    /// Starts before the first case.
    pub const fn new(cases: Cases) -> Self {
        Self { cases, covers: BTreeMap::new() }
    }

    /// Goes to the next case; `false` after the last one.
    pub fn next_case(&mut self) -> bool {
        match &mut self.cases {
            Cases::All(all) => all.next_case(),
            Cases::Some(_) => true,
        }
    }
}

impl<const PLANTED: bool> Choose for Drawn<PLANTED> {
    const PLANTED: bool = PLANTED;

    fn bits(&mut self, count: u32) -> u64 {
        let top = u64::MAX >> (64 - count);
        match &mut self.cases {
            Cases::All(all) => all.below(top.saturating_add(1)),
            Cases::Some(rng) => skewed(rng) & top,
        }
    }

    fn subset(&mut self, of: u64) -> u64 {
        let mut ones = of;
        let mut subset = 0;
        while ones != 0 {
            let lowest = ones & ones.wrapping_neg();
            let taken = match &mut self.cases {
                Cases::All(all) => all.coin(),
                Cases::Some(rng) => rng.below(4) > 0,
            };
            subset |= if taken { lowest } else { 0 };
            ones ^= lowest;
        }
        subset
    }

    /// Each tree occurs once: a node is inner only if its parent is.
    fn inner_keys(&mut self, most: u32) -> Option<u64> {
        let mut keys = 1_u64;
        for key in 1..1 << most {
            let parent: u32 = key >> 1;
            if keys >> parent & 1 == 1 && keys.count_ones() <= most {
                keys |= self.subset(1 << key);
            }
        }
        // The root's parent is not a node.
        Some(keys & !1)
    }

    fn assume(&mut self, condition: bool) -> Option<()> {
        condition.then_some(())
    }

    fn cover(&mut self, condition: bool, name: &'static str) {
        *self.covers.entry(name).or_default() |= condition;
    }
}

/// Draws a number that is often short, a power of two or next to one, or their complement.
fn skewed(rng: &mut Rng) -> u64 {
    let (kind, shift, bits) = (rng.below(8), rng.below(64), rng.bits());
    match kind {
        0 => bits >> shift,
        1 => bits << shift,
        2 => 1 << shift,
        3 => (1 << shift) - 1,
        4 => u64::MAX << shift,
        5 => rng.below(4).wrapping_sub(1),
        _ => bits,
    }
}
