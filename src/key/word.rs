//! The words of keys, trails and counters.

use core::fmt::Debug;
use core::hash::Hash;

/// The operations that the bit functions of this crate need, without any branch on a value.
///
/// A symbolic bit-vector can implement it, so that a solver proves the source of [`key`](crate::key),
/// [`trail`](crate::trail) and [`swap`](crate::swap). Callers never shift by the width or more.
pub trait Word: Clone {
    /// A number of bits to shift by.
    type Shift;

    /// 0.
    fn zero() -> Self;
    /// 1.
    fn one() -> Self;
    /// Shift left by one; the top bit is lost.
    #[must_use]
    fn shl1(self) -> Self;
    /// Shift right by one.
    #[must_use]
    fn shr1(self) -> Self;
    /// Shift right by `n`, less than the width.
    #[must_use]
    fn shr(self, n: Self::Shift) -> Self;
    /// Number of zero bits below the lowest set bit. Called only for non-zero words.
    fn trailing_zeros(&self) -> Self::Shift;
    /// Bitwise and.
    #[must_use]
    fn and(self, other: &Self) -> Self;
    /// Bitwise or.
    #[must_use]
    fn or(self, other: &Self) -> Self;
    /// Bitwise exclusive or.
    #[must_use]
    fn xor(self, other: &Self) -> Self;
    /// Addition modulo two to the width.
    #[must_use]
    fn wrapping_add(self, other: &Self) -> Self;
    /// Subtraction modulo two to the width.
    #[must_use]
    fn wrapping_sub(self, other: &Self) -> Self;
}

/// Bits of one piece of a long key: 64 bits less a flag.
pub(crate) const PIECE: u32 = 63;

/// A word with values: the operations that a running traversal needs in addition to [`Word`].
pub trait KeyWord: Word<Shift = u32> + Default + Eq + Hash + Debug + Send + Sync + 'static {
    /// Name on the command line and in tables.
    const NAME: &'static str;
    /// Width in bits; `None` for a word that grows.
    const WIDTH: Option<u32>;

    /// 0 or 1.
    fn from_bit(bit: bool) -> Self;
    /// The highest bit; `None` for a word that grows.
    fn highest() -> Option<Self>;
    /// Returns whether the value is 0.
    fn is_zero(&self) -> bool;
    /// Returns whether the value is one less than a power of two: all bits up to its highest are ones.
    fn is_all_ones(&self) -> bool;
    /// Returns the lowest 32 bits.
    fn low_bits(&self) -> u32;
    /// Returns the position of the highest one, plus one; 0 for 0.
    fn bit_length(&self) -> u32;
    /// Returns the value, if it fits 64 bits.
    fn to_u64(&self) -> Option<u64>;
    /// Returns piece `index` of the value's bits, counted from the highest one down: 63 bits each, the last one
    /// shorter.
    fn piece(&self, index: u32) -> u64;

    /// Returns the number of pieces: 0 for 0.
    fn piece_count(&self) -> u32 {
        self.bit_length().div_ceil(PIECE)
    }

    /// Returns the bytes of one such word in a traversal's state, in a tree of this depth (edges).
    fn bytes(depth: u32) -> usize {
        Self::WIDTH.map_or_else(|| 8 + (depth / PIECE) as usize * 8, |width| width as usize / 8)
    }

    /// Refuses trees that a state of `WIDTH - spare` bits below the leading one cannot carry. `[DEPTH-2]`
    ///
    /// # Errors
    /// [`TooDeep`] with the depth, the limit and the word.
    fn carries(depth: u32, spare: u32) -> Result<(), TooDeep> {
        match Self::WIDTH {
            Some(width) if depth > width - spare => Err(TooDeep { depth, limit: width - spare, word: Self::NAME }),
            _ => Ok(()),
        }
    }
}

/// A tree is too deep for a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooDeep {
    /// Depth of the tree, in edges.
    pub depth: u32,
    /// Greatest depth that this state can carry in this word.
    pub limit: u32,
    /// Name of the word.
    pub word: &'static str,
}

impl core::fmt::Display for TooDeep {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { depth, limit, word } = self;
        write!(f, "the tree is {depth} edges deep, and this state in {word} carries at most {limit}")
    }
}

impl core::error::Error for TooDeep {}

macro_rules! word {
    ($($word:ident),*) => {$(
        impl Word for $word {
            type Shift = u32;

            #[inline]
            fn zero() -> Self {
                0
            }
            #[inline]
            fn one() -> Self {
                1
            }
            #[inline]
            fn shl1(self) -> Self {
                self << 1
            }
            #[inline]
            fn shr1(self) -> Self {
                self >> 1
            }
            #[inline]
            fn shr(self, n: u32) -> Self {
                self >> n
            }
            #[inline]
            fn trailing_zeros(&self) -> u32 {
                $word::trailing_zeros(*self)
            }
            #[inline]
            fn and(self, other: &Self) -> Self {
                self & other
            }
            #[inline]
            fn or(self, other: &Self) -> Self {
                self | other
            }
            #[inline]
            fn xor(self, other: &Self) -> Self {
                self ^ other
            }
            #[inline]
            fn wrapping_add(self, other: &Self) -> Self {
                $word::wrapping_add(self, *other)
            }
            #[inline]
            fn wrapping_sub(self, other: &Self) -> Self {
                $word::wrapping_sub(self, *other)
            }
        }

        impl KeyWord for $word {
            const NAME: &'static str = stringify!($word);
            const WIDTH: Option<u32> = Some($word::BITS);

            #[inline]
            fn from_bit(bit: bool) -> Self {
                Self::from(bit)
            }
            #[inline]
            fn highest() -> Option<Self> {
                Some(1 << ($word::BITS - 1))
            }
            #[inline]
            fn is_zero(&self) -> bool {
                *self == 0
            }
            #[inline]
            fn is_all_ones(&self) -> bool {
                *self & self.wrapping_add(1) == 0
            }
            #[inline]
            #[allow(clippy::cast_lossless, reason = "the same text serves narrower and wider words")]
            fn low_bits(&self) -> u32 {
                *self as u32
            }
            #[inline]
            fn bit_length(&self) -> u32 {
                $word::BITS - self.leading_zeros()
            }
            #[inline]
            fn to_u64(&self) -> Option<u64> {
                u64::try_from(*self).ok()
            }
            #[allow(clippy::cast_lossless, reason = "the same text serves narrower and wider words")]
            fn piece(&self, index: u32) -> u64 {
                let length = self.bit_length();
                let end = length.min(index.saturating_add(1).saturating_mul(PIECE));
                let start = index.saturating_mul(PIECE).min(end);
                let mask = (1_u64 << (end - start)) - 1;
                self.checked_shr(length - end).unwrap_or(0) as u64 & mask
            }
        }
    )*};
}

// u8 and u16 are for exhaustive tests, and for small hardware.
word!(u8, u16, u32, u64, u128);
