//! Numbers of a file, with their rounding errors.

use std::ops::{Add, Mul};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::error::Fault;
use super::float::{Float, is_finite};
use super::text::quote;

/// A number, with a bound of its distance from the one in the file. The bound is 0 only if both are equal, and infinite
/// if the number in the file is finite and this one is not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Number<F> {
    pub(crate) value: F,
    pub(crate) error: f64,
}

impl<F: Float> Number<F> {
    pub(crate) fn exact(value: F) -> Self {
        Self { value, error: 0.0 }
    }

    /// Rounds a double.
    #[inline]
    pub(crate) fn of(exact: f64) -> Self {
        let value = F::rounded(exact);
        let rounded: f64 = value.into();
        Self { value, error: if rounded == exact { 0.0 } else { (exact - rounded).abs() } }
    }

    /// Rounds a decimal once; `None` if the word is not a decimal.
    #[inline]
    pub(crate) fn parse(word: &str) -> Option<Self> {
        let near: f64 = word.parse().ok()?;
        let rounded = F::rounded(near);
        let left = near - rounded.into();
        // A double halfway between two floats does not determine which float is closer to the decimal.
        let other = near + left;
        let is_open = left != 0.0 && F::rounded(other).into() == other || !is_finite(rounded);
        let value = if is_open { word.parse().ok()? } else { rounded };
        if !is_finite(value) {
            let has_digits = word.bytes().any(|byte| byte.is_ascii_digit());
            return Some(Self { value, error: if has_digits { f64::INFINITY } else { 0.0 } });
        }
        if value.into() == near && is_decimal(word, near) {
            return Some(Self::exact(value));
        }
        let error = (near - value.into()).abs() + half_unit::<f64>(near);
        Some(Self { value, error: error.min(half_unit::<F>(value.into())) })
    }

    /// Rounds a coordinate, which must be finite.
    #[inline]
    pub(crate) fn coordinate(exact: f64, axis: usize) -> Result<Self, Fault> {
        let number = Self::of(exact);
        if is_finite(number.value) { Ok(number) } else { Err(Fault::non_finite::<F>(axis, exact)) }
    }

    /// Parses and rounds a coordinate, which must be finite.
    #[inline]
    pub(crate) fn coordinate_in(word: &str, axis: usize, expected: &str) -> Result<Self, Fault> {
        match Self::parse(word) {
            Some(number) if is_finite(number.value) => Ok(number),
            Some(_) => Err(Fault::non_finite::<F>(axis, word.parse().unwrap_or(f64::NAN))),
            None => Err(Fault::unexpected(quote(word), expected)),
        }
    }
}

/// Reads a JSON number as a decimal.
impl<'de, F: Float> Deserialize<'de> for Number<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = <&RawValue>::deserialize(deserializer)?.get();
        // serde_json reports values that are not numbers.
        let is_number = word.starts_with(|first: char| first == '-' || first.is_ascii_digit());
        match Self::parse(word).filter(|_| is_number) {
            Some(number) => Ok(number),
            None => serde_json::from_str(word).map(Self::exact).map_err(D::Error::custom),
        }
    }
}

/// The rounding error of the sum is known exactly (Møller 1965; Knuth, TAOCP 4.2.2).
impl Add for Number<f64> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a + b;
        let most_of_b = value - a;
        let left = (a - (value - most_of_b)) + (b - most_of_b);
        Self { value, error: self.error + other.error + left.abs() }
    }
}

/// The rounding error of the product is also known exactly, except for the least products.
impl Mul for Number<f64> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        const LEAST: f64 = 1e-290;
        let (a, b) = (self.value, other.value);
        let value = a * b;
        let is_known = value.abs() > LEAST || a == 0.0 || b == 0.0;
        let left = if is_known { a.mul_add(b, -value).abs() } else { LEAST };
        let error = a.abs() * other.error + self.error * b.abs() + self.error * other.error + left;
        Self { value, error }
    }
}

/// Powers of five below 2^64.
const FIVES: [u64; 28] = {
    let mut fives = [1; 28];
    let mut i = 1;
    while i < fives.len() {
        fives[i] = 5 * fives[i - 1];
        i += 1;
    }
    fives
};

/// Returns whether a decimal equals the float that it was rounded to.
#[inline]
fn is_decimal(word: &str, value: f64) -> bool {
    !has_other_places(word, value) && is_equal(word, value)
}

/// Returns whether the float has more or fewer decimal places than the decimal. With n places and no trailing 0, both
/// are odd multiples of 2^-n if they are equal. This rejects most decimals that differ from their float.
#[inline]
fn has_other_places(word: &str, value: f64) -> bool {
    let bytes = word.as_bytes();
    let end = bytes.iter().rposition(|&byte| byte != b'0').unwrap_or(0);
    let Some(point) = bytes[..=end].iter().rposition(|byte| !byte.is_ascii_digit()) else { return false };
    let places = end - point;
    if bytes[point] != b'.' || !(1..=52).contains(&places) {
        return false;
    }
    let scaled = value.abs() * (1_u64 << places) as f64;
    let whole = scaled as i64;
    scaled < (1_u64 << 62) as f64 && (whole as f64 != scaled || whole % 2 == 0)
}

/// Compares like [`is_decimal`], by all digits.
fn is_equal(word: &str, value: f64) -> bool {
    match scan(word) {
        Some((0, _)) => true,
        Some((digits, exponent @ 0..=19)) => {
            u128::from(digits) * 10_u128.pow(exponent.unsigned_abs()) == value.abs() as u128
        }
        // The decimal is a multiple of a power of two if the digits are divisible by five as often as there are places.
        Some((digits, exponent @ -27..=-1)) => {
            let places = exponent.unsigned_abs();
            let fives = FIVES[places as usize];
            digits % fives == 0 && (value.abs() * (1_u64 << places) as f64) as u128 == u128::from(digits / fives)
        }
        _ => is_long_decimal(word, value),
    }
}

/// Returns the digits of a decimal as an integer, and its power of ten; `None` beyond 64 bits.
#[inline]
fn scan(word: &str) -> Option<(u64, i32)> {
    let (mut digits, mut exponent, mut is_fraction) = (0_u64, 0, false);
    for (at, byte) in word.bytes().enumerate() {
        match byte {
            b'0'..=b'9' => {
                digits = digits.checked_mul(10)?.checked_add(u64::from(byte - b'0'))?;
                exponent -= i32::from(is_fraction);
            }
            b'.' => is_fraction = true,
            b'e' | b'E' => return Some((digits, word[at + 1..].parse::<i32>().ok()?.checked_add(exponent)?)),
            _ => {}
        }
    }
    Some((digits, exponent))
}

/// Compares like [`is_equal`], for decimals of any length, by all digits of the float.
#[cold]
fn is_long_decimal(word: &str, value: f64) -> bool {
    let (mantissa, power) = word.split_once(['e', 'E']).unwrap_or((word, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let all = [whole.trim_start_matches(['+', '-']), fraction].concat();
    let digits = all.trim_end_matches('0');
    let power =
        power.parse::<i64>().ok().map(|power| power + (all.len() - digits.len()) as i64 - fraction.len() as i64);
    let digits = digits.trim_start_matches('0');
    let places = places(value);
    // The last place of the float is not zero.
    let zeros = match power.and_then(|power| power.checked_add(places as i64)) {
        _ if digits.is_empty() => return true,
        Some(zeros @ 0..=400) if places == 0 || zeros == 0 => zeros as usize,
        _ => return false,
    };
    let exact = format!("{:.places$}", value.abs()).replace('.', "");
    exact.trim_start_matches('0').strip_prefix(digits).is_some_and(|rest| rest == "0".repeat(zeros))
}

/// Returns the number of decimal places of a float.
fn places(value: f64) -> usize {
    let bits = value.to_bits();
    let (fraction, exponent) = (bits & ((1 << 52) - 1), bits >> 52 & 0x7ff);
    let significand = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    let unit = exponent.max(1) as i64 - 1075;
    if significand == 0 { 0 } else { (-unit - i64::from(significand.trailing_zeros())).max(0) as usize }
}

/// Returns half the distance to the next greater float.
fn half_unit<F: Float>(value: f64) -> f64 {
    let next: f64 = F::rounded(value.abs()).next_up().into();
    let unit = if next.is_finite() { next - value.abs() } else { value.abs() };
    (unit / 2.0).max(f64::from_bits(1))
}

#[cfg(test)]
mod tests;
