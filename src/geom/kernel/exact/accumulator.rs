//! Sums of products of any floats, without rounding.

use std::cmp::Ordering;

use dashu_int::{IBig, UBig};

use super::sum::Pairs;

/// An exact sum of products of three doubles of any size: a fixed-point number with the range of such products.
/// `[EXACT-8]`
///
/// Kulisch 2008, "Computer arithmetic and validity", chapter 8: the complete register. Added and subtracted products
/// have separate registers, so a carry rarely runs far. Up to 2^64 products may be added.
///
/// ```
/// use std::cmp::Ordering;
/// use stackless_bvh::internals::geom::kernel::Accumulator;
///
/// let mut sum = Accumulator::new();
/// for factors in [[1e300; 3], [5e-324; 3], [-1e300, 1e300, 1e300]] {
///     sum.add_product(factors);
/// }
/// assert_eq!(sum.sign(), Ordering::Greater);
/// sum.add_product([5e-324, -5e-324, 5e-324]);
/// assert_eq!(sum.sign(), Ordering::Equal);
/// ```
#[derive(Clone, Debug)]
pub struct Accumulator {
    /// The sums of added and of subtracted products; the lowest limb first.
    registers: [[u64; LIMBS]; 2],
}

/// Limbs for all products of three doubles: from 2^-3222 to 2^3072, and 64 bits for carries.
const LIMBS: usize = 100;

/// The exponent of the last bit of an accumulator.
const UNIT: i32 = 3 * MIN_EXPONENT;

/// The least exponent: a double is an integer of 53 bits times 2 to the power of this or more.
const MIN_EXPONENT: i32 = -1074;

/// A finite double as an integer and a power of two.
#[derive(Clone, Copy, Debug)]
struct Factor {
    digits: u64,
    exponent: i32,
    is_negative: bool,
}

/// 128 digits of a sum, the first of them not 0, times 2 to the power of an exponent.
pub(super) struct Leading {
    pub(super) is_negative: bool,
    pub(super) digits: u128,
    /// In units that all accumulators share.
    pub(super) exponent: i32,
    /// Whether these are all digits.
    pub(super) is_exact: bool,
}

impl From<f64> for Factor {
    fn from(x: f64) -> Self {
        let (exponent, fraction) = ((x.to_bits() >> 52 & 0x7ff) as i32, x.to_bits() & ((1 << 52) - 1));
        // Subnormal numbers have the exponent of the least normal numbers, and no leading one.
        let digits = fraction | u64::from(exponent > 0) << 52;
        Self { digits, exponent: exponent.max(1) - 1 + MIN_EXPONENT, is_negative: x.is_sign_negative() }
    }
}

impl std::ops::Neg for Factor {
    type Output = Self;

    fn neg(self) -> Self {
        Self { is_negative: !self.is_negative, ..self }
    }
}

impl Accumulator {
    /// Creates the sum zero.
    pub const fn new() -> Self {
        Self { registers: [[0; LIMBS]; 2] }
    }

    /// Adds a product of three finite numbers.
    pub fn add_product(&mut self, factors: [f64; 3]) {
        self.multiply(factors.map(Factor::from));
    }

    /// Returns the sign of the sum.
    pub fn sign(&self) -> Ordering {
        let [plus, minus] = &self.registers;
        plus.iter().rev().cmp(minus.iter().rev())
    }

    /// Computes d . (a x b).
    pub(super) fn volume(d: &Pairs, a: &Pairs, b: &Pairs) -> Self {
        let mut sum = Self::new();
        let [d, a, b] = [d, a, b].map(|v| v.map(|pair| pair.map(Factor::from)));
        for (k, parts) in d.into_iter().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            for part in parts {
                sum.add_pairs(part, a[i], b[j]);
                sum.add_pairs(-part, a[j], b[i]);
            }
        }
        sum
    }

    fn add_pairs(&mut self, x: Factor, ys: [Factor; 2], zs: [Factor; 2]) {
        if x.digits == 0 {
            return;
        }
        for y in ys.into_iter().filter(|y| y.digits != 0) {
            for z in zs.into_iter().filter(|z| z.digits != 0) {
                self.multiply([x, y, z]);
            }
        }
    }

    #[inline]
    fn multiply(&mut self, [a, b, c]: [Factor; 3]) {
        let (low, high) = a.digits.carrying_mul(b.digits, 0);
        let (low, carry) = low.carrying_mul(c.digits, 0);
        let (middle, high) = high.carrying_mul(c.digits, carry);
        // Exponents are MIN_EXPONENT at least.
        let place = (a.exponent + b.exponent + c.exponent - UNIT) as usize;
        self.add([low, middle, high], place, a.is_negative ^ b.is_negative ^ c.is_negative);
    }

    /// Adds or subtracts an integer, the lowest limb first, times 2^place units. There is room for all products.
    #[inline]
    fn add(&mut self, [low, middle, high]: [u64; 3], place: usize, is_negative: bool) {
        let (limb, shift) = (place / 64, place % 64);
        // The bits that move from a limb to the next: 0 for a shift by 0.
        let over = |limb: u64| limb >> 1 >> (63 - shift);
        let shifted = [low << shift, middle << shift | over(low), high << shift | over(middle), over(high)];
        let register = &mut self.registers[usize::from(is_negative)];
        let Some((limbs, above)) = register.get_mut(limb..).and_then(|limbs| limbs.split_first_chunk_mut::<4>()) else {
            return;
        };
        let mut carry = false;
        for (limb, part) in limbs.iter_mut().zip(shifted) {
            (*limb, carry) = limb.carrying_add(part, carry);
        }
        for limb in above {
            if !carry {
                break;
            }
            (*limb, carry) = limb.overflowing_add(1);
        }
    }

    /// Returns the first digits of the sum; `None` if it is 0.
    pub(super) fn leading(&self) -> Option<Leading> {
        let [plus, minus] = &self.registers;
        let (is_negative, [greater, less]) = match self.sign() {
            Ordering::Greater => (false, [plus, minus]),
            Ordering::Less => (true, [minus, plus]),
            Ordering::Equal => return None,
        };
        let mut difference = [0; LIMBS];
        let mut borrow = false;
        for (limb, (x, y)) in difference.iter_mut().zip(greater.iter().zip(less)) {
            (*limb, borrow) = x.borrowing_sub(*y, borrow);
        }
        let top = difference.iter().rposition(|&limb| limb != 0)?;
        let at = |below: usize| top.checked_sub(below).map_or(0, |index| difference[index]);
        let (zeros, low) = (at(0).leading_zeros(), at(2));
        let digits = (u128::from(at(0)) << 64 | u128::from(at(1))) << zeros | u128::from(low >> 1 >> (63 - zeros));
        let is_exact = low << zeros == 0 && difference[..top.saturating_sub(2)].iter().all(|&limb| limb == 0);
        Some(Leading { is_negative, digits, exponent: 64 * (top as i32 - 1) - zeros as i32, is_exact })
    }

    /// Returns the sum in units that all accumulators share.
    pub(super) fn integer(&self) -> IBig {
        let [plus, minus] = self.registers.map(|limbs| UBig::from_le_bytes(limbs.map(u64::to_le_bytes).as_flattened()));
        IBig::from(plus) - IBig::from(minus)
    }
}

impl Default for Accumulator {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests;
