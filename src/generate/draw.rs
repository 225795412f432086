//! Random numbers, and floats by their bits.

use glam::Vec3;

use crate::generate::{Rng, Source};
use crate::geom::Ray;

/// Random numbers, points and directions.
#[derive(Debug)]
pub struct Draw(Rng);

impl Draw {
    /// Creates the stream of a seed.
    pub const fn new(seed: u64) -> Self {
        Self(Rng::new(seed))
    }

    /// Creates the stream of a name (its FNV-1a hash is the seed).
    pub fn named(name: &str) -> Self {
        let step = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        Self::new(name.bytes().fold(0xcbf2_9ce4_8422_2325, step))
    }

    /// Returns `n` rays, each from the first of a bounded number of tries that is a ray.
    ///
    /// The closure receives the running number of the ray.
    pub fn rays(&mut self, n: usize, mut ray: impl FnMut(&mut Self, usize) -> Option<Ray>) -> Vec<Ray> {
        const TRIES: usize = 64;
        (0..n).filter_map(|i| (0..TRIES).find_map(|_| ray(self, i))).collect()
    }

    /// Returns a number in 0..n; 0 if `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        self.0.below(n as u64) as usize
    }

    /// Returns true with a probability of one in `n`.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Returns 1 or -1.
    pub fn sign(&mut self) -> f32 {
        one_of([1.0, -1.0], self)
    }

    /// Returns a number in 0..1, a multiple of 2^-24.
    pub fn unit(&mut self) -> f32 {
        (self.0.bits() >> 40) as f32 * exp2(-24)
    }

    /// Returns a number in `lo..hi`.
    pub fn between(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.unit()
    }

    /// Returns an integer from `-most` to `most`.
    pub fn int(&mut self, most: i32) -> f32 {
        (self.below(2 * most.unsigned_abs() as usize + 1) as i32 - most) as f32
    }

    /// Returns a vector of integers from `-most` to `most`.
    pub fn ints(&mut self, most: i32) -> Vec3 {
        Vec3::new(self.int(most), self.int(most), self.int(most))
    }

    /// Returns a number of either sign, with the exponent evenly from `lo` to `hi`.
    pub fn float(&mut self, lo: i32, hi: i32) -> f32 {
        let exponent = lo + self.below((hi - lo).unsigned_abs() as usize + 1) as i32;
        self.sign() * (1.0 + self.unit()) * exp2(exponent)
    }

    /// Returns a vector with each component by [`float`](Self::float).
    pub fn floats(&mut self, lo: i32, hi: i32) -> Vec3 {
        Vec3::new(self.float(lo, hi), self.float(lo, hi), self.float(lo, hi))
    }

    /// Returns a double at a threshold of the format, of either sign: up to two floats from 0, from a power of two,
    /// which is often the least normal number or 1, or from the greatest number. One in eight has random digits.
    pub fn threshold(&mut self) -> f64 {
        f64::from_bits(self.threshold_bits(52, 0x7ff) | (self.below(2) as u64) << 63)
    }

    /// Returns a number at a threshold of single precision, as [`threshold`](Self::threshold).
    pub fn threshold_in_single(&mut self) -> f32 {
        f32::from_bits(self.threshold_bits(23, 0xff) as u32 | (self.below(2) as u32) << 31)
    }

    /// Returns the bits of such a magnitude, in a format where infinity has this exponent.
    fn threshold_bits(&mut self, digits: u32, infinity: u64) -> u64 {
        let place = match self.below(8) {
            0 => 0,
            1 | 2 => 1 << digits,
            3 => (infinity << digits) - 3,
            4 => (infinity >> 1) << digits,
            5 => 1 << self.below(digits as usize),
            _ => (1 + self.below(infinity as usize - 1) as u64) << digits,
        };
        if self.one_in(8) {
            return place | self.0.bits() >> (64 - digits);
        }
        (place + self.below(5) as u64).saturating_sub(2)
    }

    /// Returns a point in the cube from 0 to 1.
    pub fn cube(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit())
    }

    /// Returns a point in the cube from -1 to 1.
    pub fn centred(&mut self) -> Vec3 {
        self.cube() * 2.0 - 1.0
    }

    /// Returns a vector of unit length, evenly distributed.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let p = self.centred();
            if (0.01..=1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }

    /// Returns zeros of random signs.
    pub fn zeros(&mut self) -> Vec3 {
        Vec3::new(self.sign(), self.sign(), self.sign()) * 0.0
    }

    /// Returns a direction along or against an axis, with zeros of random signs.
    pub fn axis(&mut self) -> Vec3 {
        let (axis, mut direction) = (self.below(3), self.zeros());
        direction[axis] = self.sign();
        direction
    }

    /// Returns a vector up to `most` floats away, in each component.
    pub fn nudged(&mut self, v: Vec3, most: i32) -> Vec3 {
        let by = self.ints(most);
        Vec3::new(nudge(v.x, by.x as i32), nudge(v.y, by.y as i32), nudge(v.z, by.z as i32))
    }
}

/// Returns one of these (at least one). The choices come first because they may also be drawn.
pub fn one_of<T: Copy, const N: usize>(choices: [T; N], draw: &mut Draw) -> T {
    choices[draw.below(N)]
}

/// Returns 2 to this power, clamped to the range of a float (-149 to 127).
pub const fn exp2(power: i32) -> f32 {
    match power {
        ..-148 => f32::from_bits(1),
        -148..-126 => f32::from_bits(1 << (power + 149)),
        -126..127 => f32::from_bits(((power + 127) as u32) << 23),
        127.. => f32::from_bits(254 << 23),
    }
}

/// Returns the float this many steps above, or below if negative.
pub fn nudge(x: f32, floats: i32) -> f32 {
    (0..floats.unsigned_abs()).fold(x, |x, _| if floats > 0 { x.next_up() } else { x.next_down() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_and_neighbours_are_those_of_the_format() {
        let mut power = f64::from(f32::MIN_POSITIVE) * f64::from(f32::EPSILON);
        for exponent in -149..=127 {
            assert_eq!(f64::from(exp2(exponent)), power, "{exponent}");
            power *= 2.0;
        }
        assert_eq!((exp2(-200), exp2(200)), (exp2(-149), exp2(127)));
        assert_eq!([nudge(1.0, 2), nudge(1.0, 0), nudge(1.0, -1)], [1.0 + 2.0 * exp2(-23), 1.0, 1.0 - exp2(-24)]);
        assert_eq!([nudge(0.0, 1), nudge(0.0, -2)], [exp2(-149), -exp2(-148)]);
    }

    /// The least normal number, its neighbours, and all other thresholds are drawn, and no number is infinite.
    #[test]
    fn thresholds_are_those_of_the_format() {
        let mut draw = Draw::new(1);
        let numbers: Vec<_> = (0..20_000).map(|_| (draw.threshold().abs(), draw.threshold_in_single().abs())).collect();
        assert!(numbers.iter().all(|(double, single)| double.is_finite() && single.is_finite()));
        let least = f64::MIN_POSITIVE;
        for x in [0.0, 5e-324, least.next_down(), least, least.next_up(), 1.0, f64::MAX] {
            assert!(numbers.iter().any(|(double, _)| *double == x), "{x}");
        }
        let least = f32::MIN_POSITIVE;
        for x in [0.0, 1e-45, least.next_down(), least, least.next_up(), 1.0, f32::MAX] {
            assert!(numbers.iter().any(|(_, single)| *single == x), "{x}");
        }
        let exponents: std::collections::BTreeSet<_> =
            numbers.iter().map(|(double, _)| double.to_bits() >> 52).collect();
        assert!(exponents.len() > 1500, "{}", exponents.len());
    }

    #[test]
    fn numbers_keep_their_range() {
        let mut draw = Draw::new(1);
        for _ in 0..10_000 {
            let (unit, int, float) = (draw.unit(), draw.int(5), draw.float(-149, 120).abs());
            assert!((0.0..1.0).contains(&unit) && int.abs() <= 5.0 && int.fract() == 0.0);
            assert!((exp2(-149)..=exp2(121)).contains(&float));
            assert!((draw.direction().length() - 1.0).abs() < 1e-6);
        }
    }
}
