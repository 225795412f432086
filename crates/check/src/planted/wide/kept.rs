//! What is kept of the levels above, with a mistake: a trail, and ranks.

use super::Bug;
use stackless_bvh::wide::{Kept, Level, RankedChild};

/// A trail of pending sets in 128 bits.
#[derive(Debug)]
pub(super) struct Trail {
    word: u128,
    stale: u64,
    bug: Bug,
}

impl Trail {
    pub(super) const fn new(bug: Bug) -> Self {
        Self { word: 0, stale: 0, bug }
    }
}

const fn right(word: u128, bits: u32) -> u128 {
    if bits < u128::BITS { word >> bits } else { 0 }
}

impl<const A: usize> Kept<A> for Trail {
    const LEVELS: u32 = u128::BITS / A as u32;
    const NAME: &'static str = "a trail with a mistake";

    fn clear(&mut self) {
        (self.word, self.stale) = (0, 0);
        if self.bug == Bug::PendingAboveRoot {
            self.word = 1;
        }
    }

    fn push(&mut self, pending: u32, _: [RankedChild; 2]) {
        let bits = if self.bug == Bug::GroupShiftShort { A - 1 } else { A };
        let pending = if self.bug == Bug::NothingPushed { 0 } else { pending };
        self.word = self.word << bits | u128::from(pending);
        self.stale <<= if self.bug == Bug::StaleShiftedTwice { 2 } else { 1 };
    }

    fn pop(&mut self, _: u32) -> Option<Level> {
        if self.word == 0 {
            return None;
        }
        let (a, bug) = (A as u32, self.bug);
        let zeros = self.word.trailing_zeros();
        let skipped = match bug {
            Bug::ZerosNotDivided => zeros,
            Bug::ZerosRoundedUp => zeros.div_ceil(a),
            Bug::FarthestGroup => self.word.ilog2() / a,
            _ => zeros / a,
        };
        let low = right(self.word, skipped * a);
        let gone = match bug {
            Bug::RestShort => 0,
            Bug::RestLong => 2,
            _ => 1,
        };
        self.word = right(low, a * gone);
        let mask = (1 << if bug == Bug::GroupNarrow { a - 1 } else { a }) - 1;
        let up = skipped + u32::from(bug != Bug::LevelsShort);
        let stale = if bug == Bug::StaleShiftShort { skipped } else { skipped + 1 };
        self.stale = self.stale.checked_shr(stale).unwrap_or(0);
        Some(Level { up, pending: low as u32 & mask, nexts: [RankedChild::NONE; 2] })
    }

    fn shortened(&mut self) {
        match self.bug {
            Bug::StaleNotSet => {}
            Bug::StaleHereOnly => self.stale |= 1,
            Bug::StaleAboveOnly => self.stale |= !1,
            _ => self.stale = u64::MAX,
        }
    }

    fn asked(&mut self) {
        self.stale &= if self.bug == Bug::StaleAllCleared { 0 } else { !1 };
    }

    fn is_stale(&self) -> bool {
        self.stale & 1 == 1 && self.bug != Bug::StaleIgnored
    }
}

/// For each level a set and the two children that come next, and the summary.
#[derive(Debug)]
pub(super) struct Ranked {
    level: usize,
    summary: u64,
    sets: [u32; LEVELS],
    nexts: [[RankedChild; 2]; LEVELS],
    bug: Bug,
}

const LEVELS: usize = 64;

impl Ranked {
    pub(super) const fn new(bug: Bug) -> Self {
        Self { level: 0, summary: 0, sets: [0; LEVELS], nexts: [[RankedChild::NONE; 2]; LEVELS], bug }
    }
}

impl<const A: usize> Kept<A> for Ranked {
    const LEVELS: u32 = 32;
    const NAME: &'static str = "ranks with a mistake";

    fn clear(&mut self) {
        (self.level, self.summary) = (0, 0);
    }

    fn push(&mut self, pending: u32, nexts: [RankedChild; 2]) {
        let (at, bug) = (self.level & (LEVELS - 1), self.bug);
        self.sets[at] = if bug == Bug::SetsJoined { self.sets[at] | pending } else { pending };
        let (is_known, [next, after]) = (nexts != [RankedChild::NONE; 2], nexts);
        if bug != Bug::RanksOfBefore || is_known {
            self.nexts[at] = if bug == Bug::PushedRankExchanged { [after, next] } else { nexts };
        }
        let is_noted = match bug {
            Bug::SummaryOfEmpty => true,
            Bug::SummaryOfKnown => is_known,
            _ => pending != 0,
        };
        self.summary |= u64::from(is_noted) << at;
        self.level += 1;
    }

    fn pop(&mut self, end: u32) -> Option<Level> {
        let bug = self.bug;
        while self.summary != 0 {
            let level = if bug == Bug::LowestSummary { self.summary.trailing_zeros() } else { self.summary.ilog2() };
            let at = level as usize;
            let nexts = self.nexts[at];
            let kept = nexts[usize::from(bug == Bug::ThirdCompared)].rank();
            let begin = if bug == Bug::KeptRankNotCleared { kept } else { kept & !(A as u32 - 1) };
            let is_beyond = if bug == Bug::KeptEqualDropped { begin >= end } else { begin > end };
            if bug != Bug::SummaryNotCleared || is_beyond {
                self.summary ^= 1 << level;
            }
            if is_beyond {
                if bug == Bug::BeyondEnds {
                    return None;
                }
                if bug == Bug::BeyondDropsTwo {
                    self.summary &= !(1 << level.saturating_sub(1));
                }
                continue;
            }
            let up = self.level.wrapping_sub(at) as u32;
            if bug != Bug::LevelNotRestored {
                self.level = at;
            }
            return Some(Level { up: up.clamp(1, LEVELS as u32), pending: self.sets[at], nexts });
        }
        None
    }
}
