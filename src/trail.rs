//! The bit trail, and backtracking in constant time.
//!
//! Bit `i` of a trail is set if the sibling of the ancestor `i` levels up is postponed (bit 0: the node's own sibling).
//! Descending shifts the trail with the key. Backtracking drops the trailing zeros, one level each, and toggles the
//! lowest bit of both words. This moves to the postponed sibling and marks it as no longer postponed (Binder & Keller
//! 2016, Section 2.2). A trail of 0 means that no node is postponed.
//!
//! [`backtrack`] is the constant-time form, [`backtrack_climbing`] the loop of Áfra & Szirmay-Kalos (2014); they are
//! equal for every trail but 0. The counter of Barringer & Akenine-Möller (2013) is the trail's complement below the
//! depth, see [`counter`].
//!
//! ```
//! use stackless_bvh::trail;
//! // Fig. 2 of the paper: from node 22 with trail 1000 to node 3.
//! assert_eq!(trail::backtrack(22_u32, 0b1000), (3, 0));
//! ```

use crate::key::{KeyWord, Word};

/// Returns the trail of the child that is entered; `both` is 1 if its sibling is postponed, 0 if not. `[TRAIL-2]`
#[inline]
pub fn child<W: Word>(trail: W, both: W) -> W {
    trail.shl1().or(&both)
}

/// Returns the number of levels between a node and the ancestor whose sibling comes next. The trail must not be 0.
/// `[TRAIL-3]`
#[inline]
pub fn levels<W: Word>(trail: &W) -> W::Shift {
    trail.trailing_zeros()
}

/// Returns key and trail of the most recently postponed node. The trail must not be 0. `[TRAIL-4]`
///
/// Binder & Keller 2016, Algorithm 1, "Backtracking". The lowest bit of the new trail is 0.
#[inline]
pub fn backtrack<W: Word>(key: W, trail: W) -> (W, W) {
    let key = key.shr(levels(&trail)).xor(&W::one());
    (key, leave(trail))
}

/// Computes the trail's half of [`backtrack`], for traversals without a key.
#[inline]
pub fn leave<W: Word>(trail: W) -> W {
    let levels = levels(&trail);
    trail.shr(levels).xor(&W::one())
}

/// Computes [`backtrack`] by the loop that it replaces: climb while bit 0 is clear, then toggle. `[TRAIL-5]`
///
/// A trail of 0 has no target and gives 0 and 0.
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

/// Returns whether the sibling of the current node is postponed: bit 0 of its trail.
#[inline]
pub fn is_pending<W: KeyWord>(trail: &W) -> bool {
    trail.low_bits() & 1 == 1
}

/// Returns Barringer & Akenine-Möller's `levelIndex` of a node, from its trail and `level_start` = two to its depth:
/// the complement of the trail below the depth. It is its own inverse. `[TRAIL-6]`
///
/// So `ctz(counter + 1)` is `ctz(trail)` if the trail is not 0, and the trail is 0 if the counter is all ones: their
/// traversals can stop there, without the printed climb to the root.
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
