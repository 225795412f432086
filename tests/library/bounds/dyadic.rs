//! Exact numbers m 2^e, with sums and products without rounding, and the correctly rounded quotient by its definition.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::{IBig, Sign};

/// The number `mantissa * 2^exponent`.
#[derive(Clone, Debug)]
pub(crate) struct Dyadic {
    mantissa: IBig,
    exponent: i32,
}

impl Dyadic {
    /// Zero.
    pub(crate) const ZERO: Self = Self { mantissa: IBig::ZERO, exponent: 0 };

    /// This number times `2^shift`.
    pub(crate) fn shifted(&self, shift: i32) -> Self {
        Self { mantissa: self.mantissa.clone(), exponent: self.exponent + shift }
    }

    /// Returns -1, 0 or 1.
    pub(crate) fn sign(&self) -> i32 {
        match self.mantissa.sign() {
            _ if self.mantissa == IBig::ZERO => 0,
            Sign::Positive => 1,
            Sign::Negative => -1,
        }
    }

    /// Returns the magnitude.
    pub(crate) fn abs(&self) -> Self {
        if self.sign() < 0 { -self } else { self.clone() }
    }

    /// Returns both mantissas for the lesser exponent.
    fn aligned(&self, other: &Self) -> (IBig, IBig, i32) {
        let exponent = self.exponent.min(other.exponent);
        let mantissa = |x: &Self| &x.mantissa << (x.exponent - exponent) as usize;
        (mantissa(self), mantissa(other), exponent)
    }
}

impl From<f64> for Dyadic {
    /// Converts a finite number.
    fn from(x: f64) -> Self {
        assert!(x.is_finite());
        let (field, fraction) = ((x.to_bits() >> 52 & 0x7ff) as i32, x.to_bits() & ((1 << 52) - 1));
        let mantissa = IBig::from(if field == 0 { fraction } else { fraction | 1 << 52 });
        Self { mantissa: if x < 0.0 { -mantissa } else { mantissa }, exponent: field.max(1) - 1075 }
    }
}

impl From<f32> for Dyadic {
    /// Converts a finite number.
    fn from(x: f32) -> Self {
        f64::from(x).into()
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;

    fn add(self, other: Self) -> Dyadic {
        let (a, b, exponent) = self.aligned(other);
        Dyadic { mantissa: a + b, exponent }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;

    fn neg(self) -> Dyadic {
        Dyadic { mantissa: -&self.mantissa, exponent: self.exponent }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;

    fn sub(self, other: Self) -> Dyadic {
        self + &-other
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;

    fn mul(self, other: Self) -> Dyadic {
        Dyadic { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign().cmp(&0)
    }
}

/// A float by its bits. Non-negative numbers have the order of their bits.
pub(crate) trait Float: Copy {
    /// The bits of the greatest finite number.
    const GREATEST: u64;
    /// Returns the finite number with these bits, or for one beyond `GREATEST` its successor with a larger exponent.
    fn value(bits: u64) -> Dyadic;
    /// The number with these bits.
    fn of_bits(bits: u64) -> Self;
}

impl Float for f32 {
    const GREATEST: u64 = f32::MAX.to_bits() as u64;

    fn value(bits: u64) -> Dyadic {
        if bits > Self::GREATEST { Dyadic::from(1.0).shifted(128) } else { Self::of_bits(bits).into() }
    }

    fn of_bits(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }
}

impl Float for f64 {
    const GREATEST: u64 = f64::MAX.to_bits();

    fn value(bits: u64) -> Dyadic {
        if bits > Self::GREATEST { Dyadic::from(1.0).shifted(1024) } else { Self::of_bits(bits).into() }
    }

    fn of_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

/// Rounds `dividend / divisor` to the nearest float, ties to even. Both are at least 0, and the divisor is positive.
pub(crate) fn nearest<T: Float>(dividend: &Dyadic, divisor: &Dyadic) -> T {
    assert!(dividend.sign() >= 0 && divisor.sign() > 0);
    // The greatest float that is not above the quotient.
    let (mut below, mut above) = (0, T::GREATEST + 1);
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if &T::value(middle) * divisor <= *dividend { below = middle } else { above = middle }
    }
    let twice_middle = &(&T::value(below) + &T::value(above)) * divisor;
    let up = match dividend.shifted(1).cmp(&twice_middle) {
        Ordering::Less => 0,
        Ordering::Equal => below & 1,
        Ordering::Greater => 1,
    };
    T::of_bits(below + up)
}

#[test]
fn quotients_are_rounded_to_nearest() {
    let quotient = |a: f64, b: f64| nearest::<f64>(&a.into(), &b.into());
    for (a, b) in [(1.0, 3.0), (2.0, 3.0), (0.0, 5.0), (5e-324, 2.0), (1.5e-323, 2.0), (1e300, 7e-9), (f64::MAX, 0.7)] {
        assert_eq!(quotient(a, b), a / b, "{a} / {b}");
    }
    for x in [0.1, 1e-46, 7.006_492_321_624_085e-46, 7.1e-46, 1e-40, 3.4e38, 3.402_823_5e38, 3.402_823_6e38, 1e40] {
        assert_eq!(nearest::<f32>(&x.into(), &1.0.into()), x as f32, "{x}");
    }
}
