//! A cost as a fraction: exact, so that a case found on one machine is compared to the last bit on another.

use std::cmp::Ordering;
use std::fmt;

/// So many, out of so many. Ordered by the quotient.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    count: u64,
    of: u64,
}

impl Cost {
    /// `None` out of nothing.
    pub const fn new(count: u64, of: u64) -> Option<Self> {
        if of == 0 { None } else { Some(Self { count, of }) }
    }

    /// The quotient.
    pub fn ratio(self) -> f64 {
        self.count as f64 / self.of as f64
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.count, self.of)
    }
}

impl Ord for Cost {
    fn cmp(&self, other: &Self) -> Ordering {
        let product = |a: u64, b: u64| u128::from(a) * u128::from(b);
        product(self.count, other.of).cmp(&product(other.count, self.of))
    }
}

impl PartialOrd for Cost {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cost {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Cost {}
