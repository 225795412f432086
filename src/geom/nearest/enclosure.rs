//! Numbers that are known within bounds.

use std::ops::{Add, Mul, Neg, Sub};

use super::RANGE;
use crate::geom::Interval;
use crate::geom::fine::Fine;

/// All numbers within bounds. Sums, differences and products hold those of all numbers that the operands hold.
pub(super) trait Enclosure:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// One finite number. `None` if it is so great or so small that products of it may over- or underflow.
    fn of(x: f64) -> Option<Self>;

    /// Whether all are below 0.
    fn is_negative(self) -> bool;

    /// Whether all are above 0.
    fn is_positive(self) -> bool;

    /// A quotient that is known to be from 0 to 1.
    fn share(self, whole: Self) -> Self;

    /// Both, and all between.
    fn hull(self, other: Self) -> Self;

    /// What bounds all: each end is the sum of a double and of what rounding left out of it.
    fn bounds(self) -> [[f64; 2]; 2];
}

impl Enclosure for Interval {
    #[inline]
    fn of(x: f64) -> Option<Self> {
        Some(Self::exact(x))
    }

    #[inline]
    fn is_negative(self) -> bool {
        self.ends()[1] < 0.0
    }

    #[inline]
    fn is_positive(self) -> bool {
        self.ends()[0] > 0.0
    }

    #[inline]
    fn share(self, whole: Self) -> Self {
        let ([part_lo, part_hi], [whole_lo, whole_hi]) = (self.ends(), whole.ends());
        if whole_lo <= 0.0 {
            return Self::between([0.0, 1.0]);
        }
        let (lo, hi) = ((part_lo.max(0.0) / whole_hi).next_down(), (part_hi / whole_lo).next_up());
        Self::between([lo.max(0.0), hi.min(1.0)])
    }

    #[inline]
    fn hull(self, other: Self) -> Self {
        let ([lo, hi], [other_lo, other_hi]) = (self.ends(), other.ends());
        Self::between([lo.min(other_lo), hi.max(other_hi)])
    }

    #[inline]
    fn bounds(self) -> [[f64; 2]; 2] {
        self.ends().map(|end| [end, 0.0])
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
