//! The second trail: the postponed nodes that can be skipped once something has been found.

use core::fmt::Debug;
use core::mem::take;

use crate::key::KeyWord;
use crate::trail;

/// The marks that a traversal stores for its descents: none, `()`, or one bit per level, [`Disjoint`].
pub trait Marks<W>: Default + Debug {
    /// Whether it stores marks.
    const PRUNES: bool;

    /// Records on a descent whether the sibling is disjoint.
    fn descend(&mut self, disjoint: bool);

    /// Drops the marks of a number of levels, on backtracking.
    fn climb(&mut self, levels: u32);

    /// Returns the bits, if there are any.
    fn get(&self) -> Option<W>;

    /// Restores the bits of a paused traversal; none if they are unknown.
    fn set(&mut self, bits: Option<W>);
}

impl<W> Marks<W> for () {
    const PRUNES: bool = false;

    #[inline(always)]
    fn descend(&mut self, _: bool) {}

    #[inline(always)]
    fn climb(&mut self, _: u32) {}

    fn get(&self) -> Option<W> {
        None
    }

    fn set(&mut self, _: Option<W>) {}
}

/// One bit per level, shifted with the trail: 1 if all candidates below the node come before all candidates below its
/// sibling. `[DISJOINT-1]`
///
/// This is the complement of Binder & Keller's `disjointIntervalsTrail` (2016, Section 2.3), which has 1 where
/// intervals are *not* disjoint. So the zeros that shift in mean "unknown", and traversals without trail, which count
/// in complements, use the bits unchanged.
#[derive(Clone, Debug, Default)]
pub struct Disjoint<W>(W);

impl<W: KeyWord> Marks<W> for Disjoint<W> {
    const PRUNES: bool = true;

    #[inline(always)]
    fn descend(&mut self, disjoint: bool) {
        // Without a branch: no address depends on it, and it is hard to predict.
        self.0 = trail::child(take(&mut self.0), W::from_bit(disjoint));
    }

    #[inline(always)]
    fn climb(&mut self, levels: u32) {
        self.0 = take(&mut self.0).shr(levels);
    }

    fn get(&self) -> Option<W> {
        Some(self.0.clone())
    }

    fn set(&mut self, bits: Option<W>) {
        self.0 = bits.unwrap_or_default();
    }
}

/// Returns the trail without the postponed nodes that are disjoint from the found candidate. `[DISJOINT-2]`
#[inline(always)]
pub(super) fn prune<W: KeyWord>(trail: W, marks: &impl Marks<W>) -> W {
    match marks.get() {
        Some(disjoint) => trail.or(&disjoint).xor(&disjoint),
        None => trail,
    }
}
