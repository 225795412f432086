//! Sums of floats without rounding.

/// The exact sum of up to `N` doubles, kept as doubles of increasing magnitude whose bits neither
/// overlap nor are adjacent. `[EXACT-8]`
///
/// Shewchuk 1997: GROW-EXPANSION with zeros left out. Exact as long as nothing over- or underflows.
///
/// ```
/// use stackless_bvh::geom::kernel::Sum;
///
/// let mut sum = Sum::<3>::new();
/// for x in [1e300, 1.0, -1e300] {
///     sum.add(x);
/// }
/// assert_eq!(sum.value(), 1.0);
/// ```
#[derive(Clone, Debug)]
pub struct Sum<const N: usize> {
    terms: [f64; N],
    len: usize,
}

impl<const N: usize> Sum<N> {
    /// Zero.
    pub const fn new() -> Self {
        Self { terms: [0.0; N], len: 0 }
    }

    /// Adds a number. At most `N` may be added.
    #[inline]
    pub fn add(&mut self, x: f64) {
        let (mut carry, mut kept) = (x, 0);
        for i in 0..self.len {
            let (sum, rest) = two_sum(carry, self.terms[i]);
            if rest != 0.0 {
                self.terms[kept] = rest;
                kept += 1;
            }
            carry = sum;
        }
        if carry != 0.0 {
            self.terms[kept] = carry;
            kept += 1;
        }
        self.len = kept;
    }

    /// Adds another sum.
    pub fn add_sum<const M: usize>(&mut self, other: &Sum<M>) {
        for &term in &other.terms[..other.len] {
            self.add(term);
        }
    }

    /// Adds a b c, where each of a and b is a sum of two numbers and c is one. It takes up to 16 places.
    pub(super) fn add_product(&mut self, a: [f64; 2], b: [f64; 2], c: f64) {
        if c == 0.0 {
            return;
        }
        for a in a.into_iter().filter(|&a| a != 0.0) {
            for b in b.into_iter().filter(|&b| b != 0.0) {
                let (high, low) = two_product(a, b);
                for part in [low, high] {
                    let (high, low) = two_product(part, c);
                    self.add(low);
                    self.add(high);
                }
            }
        }
    }

    /// The sum with a relative error of at most 2^-50, and so with the right sign; 0 only if it is 0.
    pub fn value(&self) -> f64 {
        self.terms[..self.len].iter().sum()
    }
}

impl<const N: usize> Default for Sum<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// The rounded sum, and what rounding left out (Knuth).
#[inline]
pub(in crate::geom) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_of_sum = sum - a;
    (sum, (a - (sum - b_of_sum)) + (b - b_of_sum))
}

/// The exact difference as two numbers, the greater first.
#[inline]
pub(super) fn difference(a: f64, b: f64) -> [f64; 2] {
    let (sum, rest) = two_sum(a, -b);
    [sum, rest]
}

/// The rounded product, and what rounding left out (Dekker, Veltkamp). For magnitudes below 2^995.
#[inline]
pub(in crate::geom) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ([a1, a0], [b1, b0]) = (split(a), split(b));
    (product, a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0))
}

/// The upper 26 bits, and the rest.
#[inline]
fn split(a: f64) -> [f64; 2] {
    let scaled = 134_217_729.0 * a;
    let high = scaled - (scaled - a);
    [high, a - high]
}
