//! A growing word: one register, and an extension that is used only when the register's flag is set.
//!
//! Binder & Keller (2016, Section 3) do not widen their words for deep trees: "each value that can overflow gets extra
//! data in the shared memory of the GPU and an overflow is indicated by the most significant bit of the value".
//! [`Grow`] works likewise: 63 bits of payload, a flag, and a stack of full 63-bit pieces above them. A left shift that
//! would lose a bit pushes the register as a piece; a right shift past the register pops pieces. Each step costs
//! amortised constant time at any depth, and no operation on a shallow value reads the extension.

use alloc::vec::Vec;
use core::fmt;
use core::hash::{Hash, Hasher};

use super::word::PIECE;
use super::{KeyWord, Word};

/// An unsigned integer of any length, for the keys, trails and counters of trees deeper than a word. `[DEPTH-3]`
///
/// It does not wrap: sums grow, and a difference below zero (which no bit function here computes) is zero.
///
/// ```
/// use stackless_bvh::key::{self, Grow, KeyWord};
/// let mut k = key::root::<Grow>();
/// for _ in 0..1000 {
///     k = key::child(k, Grow::from_bit(true));
/// }
/// assert_eq!(key::depth(&k), 1000);
/// ```
#[derive(Clone)]
pub struct Grow {
    /// Flag (top bit: the extension is in use) and payload, whose lowest `used` bits belong to the value.
    low: u64,
    /// 1 to 63.
    used: u32,
    /// Full pieces above `low`, the highest first.
    extension: Vec<u64>,
}

const FLAG: u64 = 1 << PIECE;
const PAYLOAD: u64 = FLAG - 1;

impl Grow {
    const fn small(payload: u64, used: u32) -> Self {
        Self { low: payload, used, extension: Vec::new() }
    }

    const fn payload(&self) -> u64 {
        self.low & PAYLOAD
    }

    const fn is_extended(&self) -> bool {
        self.low & FLAG != 0
    }

    /// Returns whether `other` lies within the register of `self`, so an operation need not read further.
    const fn covers(&self, other: &Self) -> bool {
        !other.is_extended() && (other.low >> self.used == 0)
    }

    fn pop(&mut self) {
        if let Some(piece) = self.extension.pop() {
            self.low = piece | if self.extension.is_empty() { 0 } else { FLAG };
            self.used = PIECE;
        }
    }

    /// Returns the number of stored bits, including leading zeros.
    fn stored_bits(&self) -> u32 {
        self.extension.len() as u32 * PIECE + self.used
    }

    /// Returns `count` (at most 63) bits, starting `at` bits above the lowest of the value.
    fn bits_at(&self, at: u32, count: u32) -> u64 {
        let piece = |index: u32| -> u64 {
            let from_top = (self.extension.len() as u32).checked_sub(index);
            from_top.and_then(|i| self.extension.get(i as usize)).copied().unwrap_or(0)
        };
        // Bit `at` is bit `at - used` of the extension, whose lowest piece has index 1 here.
        let value = if at < self.used {
            u128::from(self.payload() >> at) | u128::from(piece(1)) << (self.used - at)
        } else {
            let (skip, within) = ((at - self.used) / PIECE, (at - self.used) % PIECE);
            u128::from(piece(skip + 1) >> within) | u128::from(piece(skip + 2)) << (PIECE - within)
        };
        value as u64 & (FLAG >> (PIECE - count)).wrapping_sub(1)
    }

    /// Computes a bitwise operation. If the operands' pieces are aligned, like those of keys and counters at one node,
    /// it works piece by piece.
    #[inline(never)]
    fn bitwise(mut self, other: &Self, op: impl Fn(u64, u64) -> u64) -> Self {
        if self.used != other.used || self.extension.len() != other.extension.len() {
            return self.zip(other, op);
        }
        self.low = (self.low & FLAG) | op(self.payload(), other.payload());
        for (mine, theirs) in self.extension.iter_mut().zip(&other.extension) {
            *mine = op(*mine, *theirs);
        }
        self
    }

    /// Computes an operation on pieces, lowest first, for operands of any alignment.
    #[inline(never)]
    fn zip(&self, other: &Self, mut op: impl FnMut(u64, u64) -> u64) -> Self {
        let bits = self.stored_bits().max(other.stored_bits()) + 1;
        let pieces = bits.div_ceil(PIECE);
        let low_first = (0..pieces).map(|i| op(self.bits_at(i * PIECE, PIECE), other.bits_at(i * PIECE, PIECE)));
        let mut extension: Vec<u64> = low_first.collect();
        extension.reverse();
        let leading = extension.iter().take_while(|&&piece| piece == 0).count();
        extension.drain(..leading);
        let mut value = Self { low: 0, used: 1, extension };
        value.pop();
        value
    }
}

impl Default for Grow {
    fn default() -> Self {
        Self::zero()
    }
}

impl Word for Grow {
    type Shift = u32;

    #[inline]
    fn zero() -> Self {
        Self::small(0, 1)
    }

    #[inline]
    fn one() -> Self {
        Self::small(1, 1)
    }

    #[inline]
    fn shl1(mut self) -> Self {
        if self.used == PIECE {
            self.extension.push(self.payload());
            self.low = FLAG;
            self.used = 1;
        } else {
            self.low = (self.low & FLAG) | self.payload() << 1;
            self.used += 1;
        }
        self
    }

    #[inline]
    fn shr1(self) -> Self {
        self.shr(1)
    }

    #[inline]
    fn shr(mut self, mut n: u32) -> Self {
        while n >= self.used && self.is_extended() {
            n -= self.used;
            self.pop();
        }
        self.low = (self.low & FLAG) | self.payload().checked_shr(n).unwrap_or(0);
        self.used = self.used.saturating_sub(n).max(1);
        self
    }

    #[inline]
    fn trailing_zeros(&self) -> u32 {
        if self.payload() != 0 || !self.is_extended() {
            return self.payload().trailing_zeros();
        }
        let mut zeros = self.used;
        for piece in self.extension.iter().rev() {
            if *piece != 0 {
                return zeros + piece.trailing_zeros();
            }
            zeros += PIECE;
        }
        zeros
    }

    #[inline]
    fn and(self, other: &Self) -> Self {
        if self.covers(other) {
            return Self::small(self.payload() & other.low, self.used);
        }
        self.bitwise(other, |a, b| a & b)
    }

    #[inline]
    fn or(mut self, other: &Self) -> Self {
        if self.covers(other) {
            self.low |= other.low;
            return self;
        }
        self.bitwise(other, |a, b| a | b)
    }

    #[inline]
    fn xor(mut self, other: &Self) -> Self {
        if self.covers(other) {
            self.low ^= other.low;
            return self;
        }
        self.bitwise(other, |a, b| a ^ b)
    }

    #[inline]
    fn wrapping_add(mut self, other: &Self) -> Self {
        if self.covers(other) && (self.payload() + other.low) >> self.used == 0 {
            self.low += other.low;
            return self;
        }
        let mut carry = 0;
        self.zip(other, |a, b| {
            let sum = a + b + carry;
            carry = sum >> PIECE;
            sum & PAYLOAD
        })
    }

    fn wrapping_sub(self, other: &Self) -> Self {
        let mut borrow = 0;
        let difference = self.zip(other, |a, b| {
            let (wide, take) = (a | FLAG, b + borrow);
            borrow = u64::from(a < take);
            (wide - take) & PAYLOAD
        });
        if borrow == 0 { difference } else { Self::zero() }
    }
}

impl KeyWord for Grow {
    const NAME: &'static str = "grow";
    const WIDTH: Option<u32> = None;

    #[inline]
    fn from_bit(bit: bool) -> Self {
        Self::small(u64::from(bit), 1)
    }

    fn highest() -> Option<Self> {
        None
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.payload() == 0 && (!self.is_extended() || self.extension.iter().rev().all(|&piece| piece == 0))
    }

    #[inline]
    fn is_all_ones(&self) -> bool {
        let is_row = |piece: u64| piece & (piece + 1) == 0;
        if self.payload() + 1 != 1 << self.used {
            return is_row(self.payload()) && self.extension.iter().all(|&piece| piece == 0);
        }
        let full = self.extension.iter().rev().take_while(|&&piece| piece == PAYLOAD).count();
        let (above, _) = self.extension.split_at(self.extension.len() - full);
        above.split_last().is_none_or(|(&last, zeros)| is_row(last) && zeros.iter().all(|&piece| piece == 0))
    }

    #[inline]
    fn low_bits(&self) -> u32 {
        if self.used >= 32 || !self.is_extended() {
            return self.payload() as u32;
        }
        self.bits_at(0, 32) as u32
    }

    fn bit_length(&self) -> u32 {
        for (i, &piece) in self.extension.iter().enumerate() {
            if piece != 0 {
                let below = (self.extension.len() - i - 1) as u32 * PIECE + self.used;
                return below + (64 - piece.leading_zeros());
            }
        }
        64 - self.payload().leading_zeros()
    }

    #[inline]
    fn to_u64(&self) -> Option<u64> {
        if !self.is_extended() {
            return Some(self.payload());
        }
        (self.bit_length() <= 64).then(|| self.bits_at(32, 32) << 32 | self.bits_at(0, 32))
    }

    fn piece(&self, index: u32) -> u64 {
        let length = self.bit_length();
        let end = length.min(index.saturating_add(1).saturating_mul(PIECE));
        let start = index.saturating_mul(PIECE).min(end);
        self.bits_at(length - end, end - start)
    }
}

impl PartialEq for Grow {
    fn eq(&self, other: &Self) -> bool {
        if self.used == other.used && self.extension.len() == other.extension.len() {
            return self.low == other.low && self.extension == other.extension;
        }
        self.bit_length() == other.bit_length() && (0..self.piece_count()).all(|i| self.piece(i) == other.piece(i))
    }
}

impl Eq for Grow {}

impl Hash for Grow {
    fn hash<H: Hasher>(&self, state: &mut H) {
        for i in 0..self.piece_count() {
            self.piece(i).hash(state);
        }
    }
}

impl fmt::Debug for Grow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.to_u64() {
            Some(value) => write!(f, "{value}"),
            None => write!(f, "a number of {} bits", self.bit_length()),
        }
    }
}
