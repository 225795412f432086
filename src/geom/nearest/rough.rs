//! Doubles with an error bound.
//!
//! # Rounding
//!
//! The rounding error of a sum is a double. The relative rounding error of a product is at most u = 2^-53, unless it
//! underflows. It does not: numbers in [`RANGE`] are multiples of 2^-202. So sums of them and of products of two, and
//! their error bounds, are 0 or at least 2^-460, and products of two such numbers are above 2^-1000.

use std::ops::{Add, Mul, Neg, RangeInclusive, Sub};

use crate::geom::frame::power_of_two;
use crate::geom::kernel::two_sum;

/// All numbers within `radius` of `middle`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rough {
    pub(super) middle: f64,
    pub(super) radius: f64,
}

/// Magnitudes of inputs: 2^-150 to 2^150, which includes all of single precision.
pub(super) const RANGE: RangeInclusive<f64> = power_of_two(-150)..=power_of_two(150);

/// Half of the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Factor for the roundings of a radius, of which there are at most 30.
const UP: f64 = 1.0 + power_of_two(-48);

/// Greater than the loss of a quotient by underflow.
const TINY: f64 = f64::MIN_POSITIVE;

impl Rough {
    #[inline]
    pub(super) const fn exact(x: f64) -> Self {
        Self { middle: x, radius: 0.0 }
    }

    /// Returns an upper bound of the greatest magnitude.
    #[inline]
    pub(super) fn reach(self) -> f64 {
        (self.middle.abs() + self.radius) * UP
    }

    /// Returns the quotients; the radius is infinite or a NaN if the divisor may be 0 or less.
    #[inline]
    pub(super) fn over(self, whole: Self) -> Self {
        let least = (whole.middle - whole.radius).max(0.0);
        let middle = self.middle / whole.middle;
        let radius = (self.radius + middle.abs() * whole.radius) / least + middle.abs() * UNIT + TINY;
        Self { middle, radius: radius * UP }
    }
}

impl Add for Rough {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (middle, left) = two_sum(self.middle, other.middle);
        Self { middle, radius: (self.radius + other.radius + left.abs()) * UP }
    }
}

impl Sub for Rough {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Rough {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { middle: -self.middle, ..self }
    }
}

impl Mul for Rough {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let middle = self.middle * other.middle;
        let of_radii = self.middle.abs() * other.radius + self.radius * (other.middle.abs() + other.radius);
        Self { middle, radius: (of_radii + middle.abs() * UNIT) * UP }
    }
}

#[cfg(test)]
mod tests;
