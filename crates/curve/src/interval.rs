//! Interval arithmetic, rounded outwards.

/// All real numbers from `lo` to `hi`. Results hold every value that the operation has for members of its arguments.
///
/// A correctly rounded result is a float next to the true one or that itself, so one step outwards holds it, also where
/// it is subnormal. Nothing may overflow. `[CURVE-2]`
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Interval {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

impl Interval {
    /// The difference of two floats.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        // Of equals, or from 0, it is exact.
        if a == b || b == 0.0 { Self { lo: a - b, hi: a - b } } else { Self::rounded(a - b, a - b) }
    }

    /// The sum.
    pub(super) fn plus(self, other: Self) -> Self {
        Self::rounded(self.lo + other.lo, self.hi + other.hi)
    }

    /// The mean. Halving is exact where the sum is rounded, and where it is not, the sum is exact.
    pub(super) fn mean(self, other: Self) -> Self {
        Self::rounded((self.lo + other.lo) * 0.5, (self.hi + other.hi) * 0.5)
    }

    /// A multiple, by a number that is not negative.
    pub(super) fn times(self, factor: f64) -> Self {
        Self::rounded(self.lo * factor, self.hi * factor)
    }

    /// A part: divided by a positive number.
    pub(super) fn over(self, divisor: f64) -> Self {
        Self::rounded(self.lo / divisor, self.hi / divisor)
    }

    /// The product.
    pub(super) fn product(self, other: Self) -> Self {
        let [a, b] = [self.lo * other.lo, self.lo * other.hi];
        let [c, d] = [self.hi * other.lo, self.hi * other.hi];
        Self::rounded(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    /// The square: unlike the product with itself never negative.
    pub(super) fn square(self) -> Self {
        let (least, most) = (self.lo.max(-self.hi).max(0.0), self.hi.max(-self.lo));
        let Self { lo, hi } = Self::rounded(least * least, most * most);
        Self { lo: lo.max(0.0), hi }
    }

    /// Between this at 0 and another at 1, which `t` is from; `1 - t` must be a float.
    pub(super) fn toward(self, other: Self, t: f64) -> Self {
        if t == 0.0 {
            return self;
        }
        if t == 1.0 { other } else { self.times(1.0 - t).plus(other.times(t)) }
    }

    fn rounded(lo: f64, hi: f64) -> Self {
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }
}
