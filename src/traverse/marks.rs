//! The second trail: which postponed nodes need not be visited once something has been found.

use core::fmt::Debug;
use core::mem::take;

use crate::key::KeyWord;
use crate::trail;

/// What a traversal keeps of the marks of its descents: nothing, `()`, or a bit a level, [`Disjoint`].
pub trait Marks<W>: Default + Debug {
    /// Whether it keeps anything.
    const PRUNES: bool;

    /// On a descent: whether the sibling is disjoint.
    fn descend(&mut self, disjoint: bool);

    /// On backtracking by so many levels.
    fn climb(&mut self, levels: u32);

    /// The bits, if there are any.
    fn get(&self) -> Option<W>;

    /// Takes over the bits of a traversal that was put aside; none where they are not known.
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

/// A bit a level, shifted with the trail: 1 where all that is below the node comes before all that is below its
/// sibling. `[DISJOINT-1]`
///
/// This is the complement of Binder & Keller's `disjointIntervalsTrail` (2016, Section 2.3), which has 1 where
/// intervals are *not* disjoint: so zeros, which shift in, say that nothing is known, and traversals without trail,
/// which count in complements, take the bits as they are.
#[derive(Clone, Debug, Default)]
pub struct Disjoint<W>(W);

impl<W: KeyWord> Marks<W> for Disjoint<W> {
    const PRUNES: bool = true;

    #[inline(always)]
    fn descend(&mut self, disjoint: bool) {
        // Without a branch: no address waits for it, and it is hard to predict.
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

/// The trail without the postponed nodes that are disjoint from what has been found. `[DISJOINT-2]`
#[inline(always)]
pub(super) fn prune<W: KeyWord>(trail: W, marks: &impl Marks<W>) -> W {
    match marks.get() {
        Some(disjoint) => trail.or(&disjoint).xor(&disjoint),
        None => trail,
    }
}
