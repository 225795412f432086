//! Numbers that are known within bounds.

use std::ops::{Add, Mul, Neg, Sub};

use super::RANGE;
use super::rough::{self, Rough};
use crate::geom::fine::Fine;
use crate::geom::kernel::two_sum;

/// All numbers within bounds. Sums, differences and products contain the results for all numbers in the operands.
pub(super) trait Enclosure:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Creates one finite number. `None` if products of it may over- or underflow.
    fn of(x: f64) -> Option<Self>;

    /// Returns whether all numbers are below 0.
    fn is_negative(self) -> bool;

    /// Returns whether all numbers are above 0.
    fn is_positive(self) -> bool;

    /// Returns a quotient that is known to be from 0 to 1.
    fn share(self, whole: Self) -> Self;

    /// Returns the hull of the two.
    fn hull(self, other: Self) -> Self;

    /// Returns bounds of all numbers: each end is the sum of a double and its rounding error.
    fn bounds(self) -> [[f64; 2]; 2];
}

impl Enclosure for Rough {
    #[inline]
    fn of(x: f64) -> Option<Self> {
        (x == 0.0 || rough::RANGE.contains(&x.abs())).then_some(Self::exact(x))
    }

    #[inline]
    fn is_negative(self) -> bool {
        self.middle + self.radius < 0.0
    }

    #[inline]
    fn is_positive(self) -> bool {
        self.middle - self.radius > 0.0
    }

    #[inline]
    fn share(self, whole: Self) -> Self {
        let quotient = self.over(whole);
        // False for a NaN.
        if quotient.radius < 0.5 { quotient } else { Self { middle: 0.5, radius: 0.5 } }
    }

    #[inline]
    fn hull(self, other: Self) -> Self {
        let apart = other + Self::exact(-self.middle);
        Self { radius: self.radius.max(apart.reach()), ..self }
    }

    #[inline]
    fn bounds(self) -> [[f64; 2]; 2] {
        [-self.radius, self.radius].map(|radius| two_sum(self.middle, radius).into())
    }
}

impl Enclosure for Fine {
    /// 0, or within 2^-200 to 2^200: products of four of the sums neither over- nor underflow.
    #[inline]
    fn of(x: f64) -> Option<Self> {
        (x == 0.0 || RANGE.contains(&x.abs())).then_some(Self::exact(x))
    }

    #[inline]
    fn is_negative(self) -> bool {
        self.bounds()[1][0] < 0.0
    }

    #[inline]
    fn is_positive(self) -> bool {
        self.bounds()[0][0] > 0.0
    }

    fn share(self, whole: Self) -> Self {
        self.over(whole).filter(Self::is_close).unwrap_or(Self::UNIT)
    }

    #[inline]
    fn hull(self, other: Self) -> Self {
        self.hull(other)
    }

    #[inline]
    fn bounds(self) -> [[f64; 2]; 2] {
        self.bounds()
    }
}
