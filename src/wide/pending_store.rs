//! The stored state of the levels above a node.

use core::fmt::Debug;
use core::ops::{Add, Shl, Shr};

use super::search::{RankedChild, is_beyond};
use super::tree::slot_bits;
use crate::key::{KeyWord, TooDeep, Word};

/// A level to return to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PendingLevel {
    /// The number of levels up to its node.
    pub up: u32,
    /// The pending children of that node. Not empty.
    pub pending: u32,
    /// The next two of them, in order, if they are known.
    pub nexts: [RankedChild; 2],
}

/// The stored state of a node on the path. `[WIDE-20]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateView {
    /// A group of the trail. `[WIDE-18]`
    Trail {
        /// The pending children.
        pending: u32,
        /// The dirty bit: the end has decreased since the query of the node.
        is_dirty: bool,
    },
    /// A set with ranks. `[WIDE-17]`
    Ranked {
        /// The pending children.
        pending: u32,
        /// The bit of the summary. The current node has none.
        is_open: Option<bool>,
        /// The ranks of the next two, in order; 0 if unknown.
        ranks: [u32; 2],
    },
    /// A number of the restart trail. `[WRESTART-1]`
    Number {
        /// The number of the last returned child, in the order of ranks.
        number: u32,
        /// Whether no other child comes after it.
        is_last: bool,
    },
}

/// The pending children of all nodes above the current one.
pub trait PendingStore<const A: usize>: Debug {
    /// Greatest number of levels of inner nodes below the root.
    const LEVELS: u32;

    /// Its name in errors.
    const NAME: &'static str;

    /// Resets to the root, with nothing pending.
    fn clear(&mut self);

    /// Stores the current node before a descent to a child. `nexts` are the next pending children.
    fn push(&mut self, pending: u32, nexts: [RankedChild; 2]);

    /// Returns to the deepest level that has pending children and is not known to be beyond the end; it becomes the
    /// current level. `None` if there is none.
    fn pop(&mut self, end: u32) -> Option<PendingLevel>;

    /// Called when the end of the search has decreased.
    fn shortened(&mut self) {}

    /// Called after a repeated query of the current node.
    fn asked(&mut self) {}

    /// Returns whether the current node must be queried again before its last pending child is visited.
    fn is_stale(&self) -> bool {
        true
    }

    /// Returns the stored state of the node `up` levels above the current one. For the current node itself, 0 levels
    /// above, set and ranks are the cursor's.
    fn words(&self, _up: u32, _pending: u32, _nexts: [RankedChild; 2]) -> Option<StateView> {
        None
    }

    /// Refuses trees of too many levels. `[WIDE-14]`
    ///
    /// # Errors
    /// [`TooDeep`].
    fn carries(levels: u32) -> Result<(), TooDeep> {
        if levels > Self::LEVELS {
            return Err(TooDeep { depth: levels, limit: Self::LEVELS, word: Self::NAME });
        }
        Ok(())
    }
}

impl<const A: usize, K: PendingStore<A>> PendingStore<A> for &mut K {
    const LEVELS: u32 = K::LEVELS;
    const NAME: &'static str = K::NAME;

    #[inline(always)]
    fn clear(&mut self) {
        (**self).clear();
    }

    #[inline(always)]
    fn push(&mut self, pending: u32, nexts: [RankedChild; 2]) {
        (**self).push(pending, nexts);
    }

    #[inline(always)]
    fn pop(&mut self, end: u32) -> Option<PendingLevel> {
        (**self).pop(end)
    }

    #[inline(always)]
    fn shortened(&mut self) {
        (**self).shortened();
    }

    #[inline(always)]
    fn asked(&mut self) {
        (**self).asked();
    }

    #[inline(always)]
    fn is_stale(&self) -> bool {
        (**self).is_stale()
    }

    fn words(&self, up: u32, pending: u32, nexts: [RankedChild; 2]) -> Option<StateView> {
        (**self).words(up, pending, nexts)
    }
}

/// A word for a trail of pending sets.
pub trait TrailWord: KeyWord + Copy + From<u32> {
    /// Its name in errors.
    const TRAIL: &'static str;
}

impl TrailWord for u32 {
    const TRAIL: &'static str = "a trail of 32 bits";
}
impl TrailWord for u64 {
    const TRAIL: &'static str = "a trail of 64 bits";
}
impl TrailWord for u128 {
    const TRAIL: &'static str = "a trail of 128 bits";
}

/// A trail of A bits per level, and one bit per level for a changed end. `[WIDE-10]` `[WIDE-18]`
#[derive(Clone, Copy, Debug, Default)]
pub struct Trail<W> {
    trail: W,
    /// Bit `i`: the end has decreased since the query of the node `i` levels up. A node farther up has no bit and
    /// counts as if it were set: 128 bits carry 64 levels of two children.
    stale: u64,
}

impl<W: TrailWord> Trail<W> {
    /// Returns the trail. `[WIDE-10]`
    pub const fn trail(&self) -> W {
        self.trail
    }

    /// Returns the bits relative to the node this many levels up.
    #[inline(always)]
    fn stale_above(&self, up: u32) -> u64 {
        !(!self.stale).checked_shr(up).unwrap_or(0)
    }
}

/// Returns the trail of a child of a node with these other pending children. `[WIDE-10]`
#[inline(always)]
#[must_use]
pub fn leave<const A: usize, W: Word>(mut trail: W, pending: &W) -> W {
    for _ in 0..A {
        trail = trail.shl1();
    }
    trail.or(pending)
}

/// Returns levels up, pending set, and trail of the deepest ancestor with pending children, for a trail that is not 0.
/// `[WIDE-11]`
///
/// ```
/// use stackless_bvh::wide::{back, leave};
/// // Below a node with two pending children, at the second child of a node without any.
/// let trail = leave::<4, u32>(leave::<4, u32>(0, &0b1010), &0);
/// assert_eq!(back::<4, u32>(trail), (2, 0b1010, 0));
/// ```
#[inline(always)]
#[must_use]
pub fn back<const A: usize, W: Word>(trail: W) -> (W::Shift, W, W)
where
    W::Shift: Count,
{
    let skipped = trail.trailing_zeros() >> slot_bits::<A>();
    let low = trail.shr(skipped.clone() << slot_bits::<A>());
    let (mut group, mut rest) = (W::one(), low.clone());
    // One by one: the shift may be the full width of the word.
    for _ in 0..A {
        (group, rest) = (group.shl1(), rest.shr1());
    }
    (skipped + 1, low.and(&group.wrapping_sub(&W::one())), rest)
}

/// A number of bits or levels.
pub trait Count: Clone + Add<u32, Output = Self> + Shl<u32, Output = Self> + Shr<u32, Output = Self> {}

impl<N: Clone + Add<u32, Output = Self> + Shl<u32, Output = Self> + Shr<u32, Output = Self>> Count for N {}

impl<const A: usize, W: TrailWord> PendingStore<A> for Trail<W> {
    const LEVELS: u32 = match W::WIDTH {
        Some(width) => width / A as u32,
        None => 0,
    };
    const NAME: &'static str = W::TRAIL;

    #[inline(always)]
    fn clear(&mut self) {
        (self.trail, self.stale) = (W::zero(), 0);
    }

    #[inline(always)]
    fn push(&mut self, pending: u32, _: [RankedChild; 2]) {
        self.trail = leave::<A, W>(self.trail, &W::from(pending));
        self.stale <<= 1;
    }

    #[inline(always)]
    fn pop(&mut self, _: u32) -> Option<PendingLevel> {
        if self.trail.is_zero() {
            return None;
        }
        let (up, pending, rest) = back::<A, W>(self.trail);
        self.trail = rest;
        self.stale = self.stale_above(up);
        Some(PendingLevel { up, pending: pending.low_bits(), nexts: [RankedChild::NONE; 2] })
    }

    #[inline(always)]
    fn shortened(&mut self) {
        self.stale = u64::MAX;
    }

    #[inline(always)]
    fn asked(&mut self) {
        self.stale &= !1;
    }

    #[inline(always)]
    fn is_stale(&self) -> bool {
        self.stale & 1 == 1
    }

    fn words(&self, up: u32, pending: u32, _: [RankedChild; 2]) -> Option<StateView> {
        let above = (0..A as u32 * up.saturating_sub(1)).fold(self.trail, |trail, _| trail.shr1());
        let set = if up == 0 { pending } else { above.low_bits() & ((1 << A) - 1) };
        Some(StateView::Trail { pending: set, is_dirty: self.stale_above(up) & 1 == 1 })
    }
}

/// For each level a set and the next two children, and a word whose bit `i` is set if the set of level `i` is not
/// empty. `[WIDE-17]`
///
/// Each rank is stored with the child's address. The record of the ancestor also has the address, but that record would
/// have to be found first, and the next visit would wait for it.
#[derive(Clone, Debug)]
pub struct Ranked {
    level: u32,
    summary: u32,
    sets: [u8; LEVELS],
    nexts: [[RankedChild; 2]; LEVELS],
}

/// Bits of the summary word.
const LEVELS: usize = 32;

impl Default for Ranked {
    fn default() -> Self {
        Self { level: 0, summary: 0, sets: [0; LEVELS], nexts: [[RankedChild::NONE; 2]; LEVELS] }
    }
}

impl Ranked {
    /// Returns the bytes for a tree with this number of levels.
    pub const fn bytes(levels: usize) -> usize {
        levels * (size_of::<u8>() + size_of::<[RankedChild; 2]>()) + 2 * size_of::<u32>()
    }
}

impl<const A: usize> PendingStore<A> for Ranked {
    const LEVELS: u32 = LEVELS as u32;
    const NAME: &'static str = "a set and ranks for each of 32 levels";

    #[inline(always)]
    fn clear(&mut self) {
        (self.level, self.summary) = (0, 0);
    }

    #[inline(always)]
    fn push(&mut self, pending: u32, nexts: [RankedChild; 2]) {
        let level = self.level as usize & (LEVELS - 1);
        self.sets[level] = pending as u8;
        self.nexts[level] = nexts;
        self.summary |= u32::from(pending != 0) << level;
        self.level += 1;
    }

    #[inline(always)]
    fn pop(&mut self, end: u32) -> Option<PendingLevel> {
        while self.summary != 0 {
            let level = self.summary.ilog2();
            self.summary ^= 1 << level;
            let at = level as usize & (LEVELS - 1);
            let nexts = self.nexts[at];
            if is_beyond::<A>(nexts[0].rank(), end) {
                continue;
            }
            let up = self.level - level;
            self.level = level;
            return Some(PendingLevel { up, pending: u32::from(self.sets[at]), nexts });
        }
        None
    }

    fn words(&self, up: u32, pending: u32, nexts: [RankedChild; 2]) -> Option<StateView> {
        let at = self.level.wrapping_sub(up) as usize & (LEVELS - 1);
        let (pending, is_open, nexts) = match up {
            0 => (pending, None, nexts),
            _ => (u32::from(self.sets[at]), Some(self.summary >> at & 1 == 1), self.nexts[at]),
        };
        Some(StateView::Ranked { pending, is_open, ranks: nexts.map(RankedChild::rank) })
    }
}
