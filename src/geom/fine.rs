//! Numbers of twice the digits of a double, with an error bound.

use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use super::Interval;
use super::frame::power_of_two;
use super::kernel::{two_product, two_sum};

/// All numbers within `radius` of the sum of two doubles. The second double is the rounding error of the first.
/// `[NEAR-5]`
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Fine {
    high: f64,
    low: f64,
    radius: f64,
}

/// Greatest relative error of a sum or a product, 16 u², u = 2^-53; the actual error is at most 8 u².
const ERROR: f64 = power_of_two(-102);

/// Bound of the loss of products, quotients and radii by underflow, with a large margin: 2^-1060.
const UNDERFLOW: f64 = f64::from_bits(1 << 14);

/// The rounding error of a product above this does not underflow.
const EXACT: f64 = power_of_two(-900);

/// Factor for the roundings of a radius, of which there are at most 30.
const UP: f64 = 1.0 + power_of_two(-48);

impl Fine {
    pub(in crate::geom) const ZERO: Self = Self { high: 0.0, low: 0.0, radius: 0.0 };

    /// Creates the sum of two numbers, which may overlap.
    #[inline]
    fn new(high: f64, low: f64, radius: f64) -> Self {
        let (high, low) = two_sum(high, low);
        Self { high, low, radius: radius * UP }
    }

    /// Creates an exact number, at most 2^200 in magnitude: then products of four such numbers and their sums do not
    /// overflow.
    #[inline]
    pub(in crate::geom) const fn exact(x: f64) -> Self {
        Self { high: x, low: 0.0, radius: 0.0 }
    }

    /// Creates the sum of two doubles; the second is the rounding error of the first.
    #[inline]
    pub(in crate::geom) const fn of_two([high, low]: [f64; 2]) -> Self {
        Self { high, low, radius: 0.0 }
    }

    /// All numbers from 0 to 1.
    pub(in crate::geom) const UNIT: Self = Self { high: 0.5, low: 0.0, radius: 0.5 };

    #[inline]
    fn is_exact(&self) -> bool {
        self.radius == 0.0
    }

    /// Returns the first of its two doubles.
    #[inline]
    pub(in crate::geom) const fn middle(self) -> f64 {
        self.high
    }

    /// Returns the greatest distance of a number from the first double.
    #[inline]
    pub(in crate::geom) fn off_middle(&self) -> f64 {
        (self.low.abs() + self.radius) * UP
    }

    /// Returns the least interval of doubles that contains all numbers, or an interval that is slightly larger.
    #[inline]
    pub(in crate::geom) fn interval(&self) -> Interval {
        let off = self.off_middle();
        Interval::exact(self.high) + Interval::between([-off, off])
    }

    /// Returns whether neither the center nor the radius is above `most` in magnitude; then no number is above twice
    /// that, except for rounding.
    #[inline]
    pub(in crate::geom) fn is_within(&self, most: f64) -> bool {
        // False for a NaN.
        self.high.abs() <= most && self.radius <= most
    }

    /// Returns whether all numbers are within a half of each other.
    pub(in crate::geom) fn is_close(&self) -> bool {
        self.radius < 0.25
    }

    /// Returns a number with the common sign of all numbers, 0 if all are 0; `None` if signs differ.
    #[inline]
    pub(in crate::geom) fn sign(self) -> Option<f64> {
        let is_zero = self.is_exact() && self.high == 0.0;
        (is_zero || (self.low.abs() + self.radius) * UP < self.high.abs()).then_some(self.high)
    }

    /// Returns bounds of all numbers: each end is the sum of a double and its rounding error.
    #[inline]
    pub(in crate::geom) fn bounds(self) -> [[f64; 2]; 2] {
        let around = Interval::exact(self.low) + Interval::between([-self.radius, self.radius]);
        around.ends().map(|low| {
            let (high, low) = two_sum(self.high, low);
            [high, low]
        })
    }

    /// Returns the hull of these numbers and those of another.
    #[inline]
    pub(in crate::geom) fn hull(self, other: Self) -> Self {
        let apart = other - Self { radius: 0.0, ..self };
        let reach = (apart.high.abs() + apart.low.abs() + apart.radius) * UP;
        Self { radius: self.radius.max(reach), ..self }
    }

    /// Multiplies by 2 to the power of an exponent from -1022 to 1023.
    #[inline]
    pub(in crate::geom) fn scaled(self, exponent: i32) -> Self {
        let [high, low, radius] = [self.high, self.low, self.radius].map(|x| x * power_of_two(exponent));
        Self { high, low, radius: (radius + UNDERFLOW) * UP }
    }

    /// Returns the quotients. `None` if a divisor may be 0, or if there is no bound.
    #[inline]
    pub(in crate::geom) fn over(self, whole: Self) -> Option<Self> {
        let (part, whole) = if whole.high < 0.0 { (-self, -whole) } else { (self, whole) };
        let [[least, _], _] = whole.bounds();
        // The quotient is that of the first digits, plus the remainder over the divisor.
        let quotient = part.high / whole.high;
        let left = part - Self::exact(quotient) * whole;
        let step = left.high / whole.high;
        let of_whole = whole.radius / whole.high + f64::EPSILON;
        let radius = (left.radius + left.low.abs() + left.high.abs() * of_whole) / least + step.abs() * f64::EPSILON;
        let is_known = least > 0.0 && quotient.is_finite() && radius < f64::INFINITY;
        is_known.then(|| Self::new(quotient, step, radius + UNDERFLOW))
    }

    /// Returns the square roots. `None` if one of the numbers may be 0 and not all are, or may be far from the other
    /// numbers.
    pub(in crate::geom) fn root(self) -> Option<Self> {
        if self.is_exact() && self.high == 0.0 {
            return Some(Self::ZERO);
        }
        // False for a NaN.
        if !(self.high > power_of_two(-800) && self.radius <= self.high / 8.0) {
            return None;
        }
        // For r² + d with |d| <= r² / 4, the error of r + d / 2r is at most d² / 4r³.
        let r = self.high.sqrt();
        let exact = Self::exact(r);
        let d = self - exact * exact;
        let (step, spread) = (d.high / (2.0 * r), d.low.abs() + d.radius);
        let reach = d.high.abs() + spread;
        let radius = spread / (2.0 * r) + reach / r * (reach / r) / (4.0 * r) + step.abs() * f64::EPSILON + UNDERFLOW;
        Some(Self::new(r, step, radius))
    }
}

impl Add for Fine {
    type Output = Self;

    /// The relative error is at most 3 u² + 13 u³ (Joldes, Muller & Popescu 2017, "Tight and rigorous error bounds for
    /// basic building blocks of double-word arithmetic", Theorem 3.1). The sum is exact if nothing remains of the low
    /// parts, so a sum of 0 stays 0.
    #[inline]
    fn add(self, other: Self) -> Self {
        let ((high, rest), (low, least)) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let (middle, left) = two_sum(rest, low);
        let (high, middle) = two_sum(high, middle);
        let radius = self.radius + other.radius;
        if left == 0.0 && least == 0.0 {
            return Self { high, low: middle, radius: radius * UP };
        }
        Self::new(high, middle + least, radius + high.abs() * ERROR)
    }
}

impl Sub for Fine {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Fine {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low, radius: self.radius }
    }
}

impl Mul for Fine {
    type Output = Self;

    /// The relative error is at most 8 u²: the product of the low parts is omitted, and two products and two sums of
    /// the order u are rounded. The product of two doubles is exact, unless it underflows.
    #[inline]
    fn mul(self, other: Self) -> Self {
        // A product of 0 must stay 0.
        if [self, other].iter().any(|x| x.high == 0.0 && x.is_exact()) {
            return Self::ZERO;
        }
        let (high, rest) = two_product(self.high, other.high);
        if self.low == 0.0 && other.low == 0.0 && self.is_exact() && other.is_exact() && high.abs() > EXACT {
            return Self { high, low: rest, radius: 0.0 };
        }
        let low = rest + (self.high * other.low + self.low * other.high);
        // The magnitudes are those of the high parts; the factor covers the low parts.
        let of_radii = self.high.abs() * other.radius + other.high.abs() * self.radius + self.radius * other.radius;
        Self::new(high, low, of_radii * UP + high.abs() * ERROR + UNDERFLOW)
    }
}

/// Subtracts three multiples of a direction from a vector, and returns the multiples. For vectors up to 2^150 times as
/// long as their part across the direction, little more than this part remains. The result represents the vector less
/// exactly those multiples, for every rounding. `[EXACT-12]`
pub(in crate::geom) fn shortened(mut way: [Fine; 3], direction: DVec3) -> ([Fine; 3], [f64; 3]) {
    // Each step leaves the rounding error of the previous step.
    let parts = [(); 3].map(|()| {
        let part = DVec3::from(way.map(Fine::middle)).dot(direction) / direction.length_squared();
        way = [0, 1, 2].map(|k| way[k] - Fine::exact(part) * Fine::exact(direction[k]));
        part
    });
    (way, parts)
}

#[cfg(test)]
mod tests;
