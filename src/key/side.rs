//! Left and right, and conversions of bits by a branch.

use super::KeyWord;

/// Left or right child. The numeric value is the lowest bit of the child's key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The child with key `2k`.
    Left = 0,
    /// The child with key `2k + 1`.
    Right = 1,
}

impl Side {
    /// `Right` for `true`.
    #[inline]
    pub const fn right_if(right: bool) -> Self {
        if right { Self::Right } else { Self::Left }
    }

    /// Returns the other side.
    #[inline]
    #[must_use]
    pub const fn other(self) -> Self {
        Self::right_if(matches!(self, Self::Left))
    }

    /// Returns whether this is the right side.
    #[inline]
    pub const fn is_right(self) -> bool {
        matches!(self, Self::Right)
    }

    /// Returns the lowest bit of the child's key, by a branch.
    #[inline(always)]
    pub(crate) fn bit<W: KeyWord>(self) -> W {
        branched(self.is_right())
    }

    /// Returns the position in an array of two children.
    #[inline]
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// Returns 0 or 1, by a branch that the compiler must not turn into arithmetic.
///
/// Keys, trails and counters determine the next record. If they were computed from the results of the box tests, the
/// processor could not load that record before the tests are done. After a branch it continues with the predicted
/// value. See [`Topology::child`](crate::tree::Topology::child).
#[inline(always)]
pub(crate) fn branched<W: KeyWord>(bit: bool) -> W {
    if bit {
        core::hint::cold_path();
        W::one()
    } else {
        W::zero()
    }
}
