//! The bit trail, and backtracking in constant time.
//!
//! Bit `i` of a trail says that the sibling of the ancestor `i` levels up has been postponed (bit 0: the node's own
//! sibling). Descending shifts the trail with the key; backtracking drops as many levels as there are trailing
//! zeros and toggles the lowest bit of both, which moves to the postponed sibling and marks it as no longer
//! postponed (Binder & Keller 2016, Section 2.2). A trail of 0 means that nothing is left.
//!
//! [`backtrack`] is the constant-time form, [`backtrack_climbing`] the loop that Áfra & Szirmay-Kalos (2014) run;
//! they are equal for every trail but 0. The counter of Barringer & Akenine-Möller (2013) is the trail's complement
//! below the depth, see [`counter`].
//!
//! ```
//! use stackless_bvh::trail;
//! // Fig. 2 of the paper: from node 22 with trail 1000 to node 3.
//! assert_eq!(trail::backtrack(22_u32, 0b1000), (3, 0));
//! ```

use crate::key::{KeyWord, Word};

/// Trail of the child that is entered; `both` is 1 if its sibling is postponed, else 0. `[TRAIL-2]`
#[inline]
pub fn child<W: Word>(trail: W, both: W) -> W {
    trail.shl1().or(&both)
}

/// Levels between a node and the ancestor whose sibling comes next. The trail must not be 0. `[TRAIL-3]`
#[inline]
pub fn levels<W: Word>(trail: &W) -> W::Shift {
    trail.trailing_zeros()
}

/// Key and trail of the most recently postponed node. The trail must not be 0. `[TRAIL-4]`
///
/// Binder & Keller 2016, Algorithm 1, "Backtracking". The lowest bit of the new trail is 0.
#[inline]
pub fn backtrack<W: Word>(key: W, trail: W) -> (W, W) {
    let key = key.shr(levels(&trail)).xor(&W::one());
    (key, leave(trail))
}

/// The trail's half of [`backtrack`], for traversals that carry no key.
#[inline]
pub fn leave<W: Word>(trail: W) -> W {
    let levels = levels(&trail);
    trail.shr(levels).xor(&W::one())
}

/// [`backtrack`] as the loop that it replaces: climb while bit 0 is clear, then toggle. `[TRAIL-5]`
///
/// A trail of 0 has nothing to climb to and gives 0 and 0.
pub fn backtrack_climbing<W: KeyWord>(mut key: W, mut trail: W) -> (W, W) {
    if trail.is_zero() {
        return (W::zero(), W::zero());
    }
    while !is_pending(&trail) {
        key = key.shr1();
        trail = trail.shr1();
    }
    (key.xor(&W::one()), trail.xor(&W::one()))
}

/// Whether the sibling of the current node is postponed: bit 0 of its trail.
#[inline]
pub fn is_pending<W: KeyWord>(trail: &W) -> bool {
    trail.low_bits() & 1 == 1
}

/// Barringer & Akenine-Möller's `levelIndex` of a node, from its trail and `level_start` = two to its depth:
/// the complement of the trail below the depth. Its own inverse. `[TRAIL-6]`
///
/// So `ctz(counter + 1)` is `ctz(trail)` where the trail is not 0, and the trail is 0 where the counter is all ones:
/// their traversals can stop there, without the climb to the root that they print.
///
/// ```
/// use stackless_bvh::trail;
/// let (depth, t) = (4, 0b1000_u32);
/// let c = trail::counter(t, 1 << depth);
/// assert_eq!(c, 0b0111);
/// assert_eq!((c + 1).trailing_zeros(), t.trailing_zeros());
/// assert_eq!(trail::counter(c, 1 << depth), t);
/// ```
#[inline]
pub fn counter<W: Word>(trail: W, level_start: W) -> W {
    trail.xor(&level_start.wrapping_sub(&W::one()))
}

#[cfg(test)]
mod tests;
