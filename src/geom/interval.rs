//! Intervals of doubles that contain the numbers they represent.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use super::frame::power_of_two;
use super::kernel::{two_product, two_sum};
use super::truth::{Number as _, Relaxed};

/// All numbers from a least to a greatest. Sums, differences and products contain all sums, differences and products of
/// numbers in the operands: inexact ends are rounded outwards. `[INST-3]`
///
/// Lower ends are never +infinity, upper ends never -infinity, and neither is NaN.
///
/// ```
/// use stackless_bvh::internals::geom::Interval;
///
/// let sum = Interval::exact(1.0) + Interval::exact(1e-30);
/// assert_eq!(sum.ends(), [1.0, 1f64.next_up()]);
/// assert_eq!((Interval::exact(1.0) + Interval::exact(0.5)).ends(), [1.5, 1.5]);
/// assert_eq!((sum * Interval::exact(0.0)).ends(), [0.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl Interval {
    /// Creates an interval of one number, which must be finite.
    pub const fn exact(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// Creates an interval from its ends, in this order.
    pub const fn between([lo, hi]: [f64; 2]) -> Self {
        Self { lo, hi }
    }

    /// Returns the narrowest interval that contains a number.
    pub(super) fn around(x: &Relaxed) -> Self {
        let nearest = f64::nearest_to(x);
        // An infinity is beyond all numbers.
        let order = Relaxed::try_from(nearest).map_or_else(|_| nearest.total_cmp(&0.0), |nearest| nearest.cmp(x));
        Self::between(match order {
            Ordering::Less => [nearest, nearest.next_up()],
            Ordering::Equal => [nearest, nearest],
            Ordering::Greater => [nearest.next_down(), nearest],
        })
    }

    /// Returns the least and the greatest number.
    #[inline]
    pub const fn ends(&self) -> [f64; 2] {
        [self.lo, self.hi]
    }

    /// Returns whether it contains one number only.
    #[inline]
    pub(super) fn is_exact(&self) -> bool {
        self.lo == self.hi
    }

    /// Returns whether 0 is the only number.
    #[inline]
    pub fn is_zero(&self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }

    /// Returns a number, and the greatest distance of the other numbers from it. They are NaN or infinite if an end is.
    #[inline]
    pub fn middle_and_radius(&self) -> [f64; 2] {
        let middle = self.lo * 0.5 + self.hi * 0.5;
        let (below, above) = (middle - self.lo, self.hi - middle);
        let radius = if below > above { below } else { above };
        [middle, if radius == 0.0 { 0.0 } else { radius.next_up() }]
    }

    /// Returns the centers of three intervals, and the greatest distance of the other numbers from each. If an end is
    /// NaN or infinite, so is a center, and the distance is meaningless.
    #[inline(always)]
    pub(super) fn middles([x, y, z]: &[Self; 3]) -> (DVec3, f64) {
        let ([x, off_x], [y, off_y], [z, off_z]) =
            (x.middle_and_radius(), y.middle_and_radius(), z.middle_and_radius());
        (DVec3::new(x, y, z), off_x.max(off_y).max(off_z))
    }

    /// Multiplies by 2 to the power of an exponent from -1000 to 1000: the narrowest interval of doubles that contains
    /// all products. `[INST-3]`
    #[inline]
    pub(super) fn scaled(self, exponent: i32) -> Self {
        let (factor, back) = (power_of_two(exponent), power_of_two(-exponent));
        let (lo, hi) = (self.lo * factor, self.hi * factor);
        // The inverse product restores an end that was not rounded. An end that was rounded inwards becomes too great
        // or too small.
        Self {
            lo: if lo * back > self.lo { lo.next_down() } else { lo },
            hi: if hi * back < self.hi { hi.next_up() } else { hi },
        }
    }

    /// Rounds the ends outwards to single precision.
    #[inline]
    pub fn ends_in_single(&self) -> [f32; 2] {
        let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
        // -down(-x) is x rounded up.
        [down(self.lo), -down(-self.hi)]
    }
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (lo, below) = two_sum(self.lo, other.lo);
        let (hi, above) = two_sum(self.hi, other.hi);
        // The rounding error is NaN after an overflow: then the neighbour is the greatest float.
        Self { lo: if below >= 0.0 { lo } else { lo.next_down() }, hi: if above <= 0.0 { hi } else { hi.next_up() } }
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        // A zero component of a direction must stay zero.
        if self.is_zero() || other.is_zero() {
            return Self::exact(0.0);
        }
        if self.lo == self.hi
            && other.lo == other.hi
            && let Some(product) = exact_product(self.lo, other.lo)
        {
            return Self::exact(product);
        }
        let products = [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi];
        // 0 times infinity is dropped. The other ends then give 0, or infinities of both signs.
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for product in products {
            lo = if product < lo { product } else { lo };
            hi = if product > hi { product } else { hi };
        }
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }
}

/// Returns the product, if it is a double and two-product can prove this.
#[inline]
fn exact_product(a: f64, b: f64) -> Option<f64> {
    let (product, rest) = two_product(a, b);
    let is_safe = a.abs() < power_of_two(500) && b.abs() < power_of_two(500) && product.abs() > power_of_two(-900);
    (is_safe && rest == 0.0).then_some(product)
}

#[cfg(test)]
mod tests;
