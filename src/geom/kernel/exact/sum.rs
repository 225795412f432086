//! Sums and differences of two floats, and products, as two floats without rounding.

/// A vector whose components are sums of two numbers.
pub(super) type Pairs = [[f64; 2]; 3];

/// Returns the rounded sum, and its rounding error (Knuth).
#[inline]
pub(in crate::geom) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_of_sum = sum - a;
    (sum, (a - (sum - b_of_sum)) + (b - b_of_sum))
}

/// Returns the exact difference as two numbers, the greater first.
#[inline]
pub(super) fn difference(a: f64, b: f64) -> [f64; 2] {
    let (sum, rest) = two_sum(a, -b);
    [sum, rest]
}

/// Returns the rounded product, and its rounding error (Dekker, Veltkamp). For magnitudes below 2^995.
#[inline]
pub(in crate::geom) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ([a1, a0], [b1, b0]) = (split(a), split(b));
    (product, a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0))
}

/// Returns the upper 26 bits, and the rest.
#[inline]
fn split(a: f64) -> [f64; 2] {
    let scaled = 134_217_729.0 * a;
    let high = scaled - (scaled - a);
    [high, a - high]
}
