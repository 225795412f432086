//! A word of unknown bits, for running the library's generic functions unchanged.

use std::cell::RefCell;
use std::ops::{Add, Mul};

use stackless_bvh::key::Word;
use z3::ast::{BV, Bool};

/// A word of `N` unknown bits.
#[derive(Clone, Debug)]
pub(crate) struct Symbolic<const N: u32>(pub(crate) BV);

thread_local! {
    /// The requirements of the operations so far.
    static REQUIRED: RefCell<Vec<Bool>> = const { RefCell::new(Vec::new()) };
}

/// Records a requirement of an operation. A lemma holds only if all its requirements hold.
pub(crate) fn require(condition: Bool) {
    REQUIRED.with_borrow_mut(|all| all.push(condition));
}

/// Returns the requirements since the last call.
pub(crate) fn take_required() -> Vec<Bool> {
    REQUIRED.take()
}

impl<const N: u32> Symbolic<N> {
    /// Converts a number of at most `u64::MAX`.
    pub(crate) fn number(value: u64) -> Self {
        Self(BV::from_u64(value, N))
    }

    /// Returns the word with only the highest bit set.
    pub(crate) fn highest() -> Self {
        Self(BV::from_u64(1, N).bvshl(BV::from_u64(u64::from(N) - 1, N)))
    }

    /// Returns whether two words are equal.
    pub(crate) fn is(&self, other: &Self) -> Bool {
        self.0.eq(&other.0)
    }

    /// Returns whether it equals a number.
    pub(crate) fn is_number(&self, value: u64) -> Bool {
        self.is(&Self::number(value))
    }

    /// Returns whether it is less, as a number.
    pub(crate) fn less(&self, other: &Self) -> Bool {
        self.0.bvult(&other.0)
    }

    /// Returns whether exactly one bit is set.
    pub(crate) fn is_power(&self) -> Bool {
        let below = Self(self.0.bvsub(BV::from_u64(1, N)));
        Bool::and(&[self.is_number(0).not(), self.clone().and(&below).is_number(0)])
    }

    /// Shifts left by any number of bits.
    pub(crate) fn shl(&self, n: &Self) -> Self {
        Self(self.0.bvshl(&n.0))
    }

    /// Returns the number in twice the bits, where sums do not wrap.
    pub(crate) fn wide(&self) -> BV {
        self.0.zero_ext(N)
    }
}

/// Shift counts are words too. Counting the zeros of 0, or shifting by the width or more, makes a lemma false.
impl<const N: u32> Word for Symbolic<N> {
    type Shift = Self;

    fn zero() -> Self {
        Self::number(0)
    }

    fn one() -> Self {
        Self::number(1)
    }

    fn shl1(self) -> Self {
        self.shl(&Self::one())
    }

    fn shr1(self) -> Self {
        Self(self.0.bvlshr(Self::one().0))
    }

    fn shr(self, n: Self) -> Self {
        require(n.less(&Self::number(N.into())));
        Self(self.0.bvlshr(&n.0))
    }

    fn trailing_zeros(&self) -> Self {
        Self(trailing_zeros(&self.0))
    }

    fn and(self, other: &Self) -> Self {
        Self(self.0.bvand(&other.0))
    }

    fn or(self, other: &Self) -> Self {
        Self(self.0.bvor(&other.0))
    }

    fn xor(self, other: &Self) -> Self {
        Self(self.0.bvxor(&other.0))
    }

    fn wrapping_add(self, other: &Self) -> Self {
        Self(self.0.bvadd(&other.0))
    }

    fn wrapping_sub(self, other: &Self) -> Self {
        Self(self.0.bvsub(&other.0))
    }
}

/// Overflowing sums and products, and lost bits of shifts, make a lemma false.
impl<const N: u32> Add<u32> for Symbolic<N> {
    type Output = Self;

    fn add(self, other: u32) -> Self {
        let sum = Self(self.0.bvadd(BV::from_u64(other.into(), N)));
        require(self.less(&sum));
        sum
    }
}

impl<const N: u32> Mul<u32> for Symbolic<N> {
    type Output = Self;

    fn mul(self, other: u32) -> Self {
        let product = self.wide().bvmul(BV::from_u64(other.into(), 2 * N));
        let kept = Self(product.extract(N - 1, 0));
        require(kept.wide().eq(&product));
        kept
    }
}

impl<const N: u32> std::ops::Shl<u32> for Symbolic<N> {
    type Output = Self;

    fn shl(self, bits: u32) -> Self {
        let shifted = Self::shl(&self, &Self::number(bits.into()));
        require(Self(shifted.0.bvlshr(BV::from_u64(bits.into(), N))).is(&self));
        shifted
    }
}

impl<const N: u32> std::ops::Shr<u32> for Symbolic<N> {
    type Output = Self;

    fn shr(self, bits: u32) -> Self {
        Word::shr(self, Self::number(bits.into()))
    }
}

/// Returns the number of zeros below the lowest one, which must exist. Bit j of the result is set if the position of
/// the lowest one has bit j.
pub(crate) fn trailing_zeros(word: &BV) -> BV {
    let width = word.get_size();
    let number = |value: u32| BV::from_u64(value.into(), width);
    require(word.eq(number(0)).not());
    let lowest = word.bvand(word.bvneg());
    let bit = |j: u32| {
        let positions = (0..width).rev().filter(|position| position >> j & 1 == 1);
        let bits = positions.map(|position| lowest.extract(position, position));
        bits.reduce(|any, bit| any.bvor(bit)).map(|any| any.zero_ext(width - 1).bvshl(number(j)))
    };
    (0..width.ilog2()).filter_map(bit).fold(number(0), |count, bit| count.bvor(bit))
}
