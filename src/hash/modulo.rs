//! Remainders by the number of cells, in three implementations.

/// The number of cells of a table: 1 to 2^31, so the sign bit of every cell number is clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TableSize(u32);

impl TableSize {
    /// Greatest number of cells of a table.
    pub const MAX: u32 = 1 << 31;

    /// Creates this size; `None` beyond 1 to 2^31.
    #[inline]
    pub const fn new(cells: u32) -> Option<Self> {
        if cells == 0 || cells > Self::MAX { None } else { Some(Self(cells)) }
    }

    /// Returns the number.
    #[inline]
    pub const fn get(self) -> u32 {
        self.0
    }
}

/// The remainder of a key by a fixed [`TableSize`].
pub trait Modulo {
    /// Returns the remainder of a key of 32 bits, in 32-bit arithmetic.
    fn of_u32(&self, key: u32) -> u32;
    /// Returns the remainder of a key of 64 bits.
    fn of_u64(&self, key: u64) -> u32;
}

/// The processor's division: the definition.
#[derive(Clone, Copy, Debug)]
pub struct Remainder(pub TableSize);

impl Modulo for Remainder {
    #[inline(always)]
    fn of_u32(&self, key: u32) -> u32 {
        key % self.0.get()
    }

    #[inline(always)]
    fn of_u64(&self, key: u64) -> u32 {
        (key % u64::from(self.0.get())) as u32
    }
}

/// A size that is known at compile time, as in a kernel compiled for its scene. A number that is not a [`TableSize`]
/// does not compile.
#[derive(Clone, Copy, Debug)]
pub struct Constant<const H: u32>;

impl<const H: u32> Constant<H> {
    const SIZE: TableSize = TableSize::new(H).expect("a table has 1 to 2^31 cells");
}

impl<const H: u32> Modulo for Constant<H> {
    #[inline(always)]
    fn of_u32(&self, key: u32) -> u32 {
        key % const { Self::SIZE.get() }
    }

    #[inline(always)]
    fn of_u64(&self, key: u64) -> u32 {
        (key % const { Self::SIZE.get() as u64 }) as u32
    }
}

/// A multiplication by the reciprocal, exact for every key. `[HASH-1]`
///
/// Let W be 2^32 or 2^64, k < W the key, H the size, and M = floor((W - 1) / H). Then W/H - 1 <= M <= (W - 1)/H: if M
/// were below W/H - 1 by any amount, (M + 1) H <= W - 1 would hold and M would not be the floor. So
///
/// ```text
/// 0 <= k/H - kM/W = (k/W) (W/H - M) <= k/W < 1,
/// ```
///
/// and q = floor(kM/W), the high half of one product, is the quotient floor(k/H) or one less. The remainder is thus k -
/// qH, which is less than 2H <= 2^32 and fits 32 bits, or that minus H. Where `r < H`, `r - H` wraps to more than `r`:
/// the remainder is the smaller one of the two. This is Barrett's reduction (1986) with a quotient that fits a word.
/// The M for 2^32 is the high half of the M for 2^64, so one number serves the two widths.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal {
    size: u32,
    reciprocal: u64,
}

impl Reciprocal {
    /// Returns the reciprocal of a size.
    #[inline]
    pub const fn of(size: TableSize) -> Self {
        Self { size: size.get(), reciprocal: u64::MAX / size.get() as u64 }
    }

    /// Returns the size.
    #[inline]
    pub const fn size(self) -> u32 {
        self.size
    }
}

/// Returns `r` modulo `size`, for `r` below twice the size.
#[inline(always)]
pub fn wrap(r: u32, size: u32) -> u32 {
    r.min(r.wrapping_sub(size))
}

impl Modulo for Reciprocal {
    #[inline(always)]
    fn of_u32(&self, key: u32) -> u32 {
        let quotient = (u64::from(key) * (self.reciprocal >> 32)) >> 32;
        wrap(key.wrapping_sub((quotient as u32).wrapping_mul(self.size)), self.size)
    }

    #[inline(always)]
    fn of_u64(&self, key: u64) -> u32 {
        let quotient = (u128::from(key) * u128::from(self.reciprocal)) >> 64;
        // Less than 2^32, so the low 32 bits suffice.
        wrap((key as u32).wrapping_sub((quotient as u32).wrapping_mul(self.size)), self.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Rng;

    fn check(size: u32, constant: Option<&dyn Modulo>, key: u64) {
        let size = TableSize::new(size).unwrap();
        let (plain, reciprocal) = (Remainder(size), Reciprocal::of(size));
        assert_eq!(reciprocal.of_u64(key), plain.of_u64(key), "{key} mod {size:?}");
        assert_eq!(reciprocal.of_u32(key as u32), plain.of_u32(key as u32), "{} mod {size:?}", key as u32);
        assert_eq!(u64::from(plain.of_u64(key)), key % u64::from(size.get()));
        if let Some(constant) = constant {
            assert_eq!(constant.of_u64(key), plain.of_u64(key));
            assert_eq!(constant.of_u32(key as u32), plain.of_u32(key as u32));
        }
    }

    /// Keys at which a quotient steps, in both widths, and random keys.
    fn check_all(size: u32, constant: Option<&dyn Modulo>) {
        let mut rng = Rng::new(u64::from(size));
        let h = u64::from(size);
        for top in [u64::from(u32::MAX), u64::MAX] {
            let last = top / h * h;
            for base in [0, 1, h, last, top, top / 2, last - last.min(h), last / 2 / h * h, 1 << 31, 1 << 32, 1 << 63] {
                for key in [base.wrapping_sub(1), base, base.wrapping_add(1)] {
                    check(size, constant, key);
                }
            }
        }
        for _ in 0..100 {
            let bits = rng.bits() % 64;
            let key = rng.bits() >> bits;
            check(size, constant, key);
            for near in [(key / h * h).wrapping_sub(1), key / h * h] {
                check(size, constant, near);
            }
        }
    }

    #[test]
    fn the_three_ways_agree_at_the_extremes() {
        let powers = (0..32).map(|i| 1_u32 << i);
        let sizes = powers.flat_map(|p| [p - 1, p, p + 1]).chain([i32::MAX as u32 - 2, TableSize::MAX]);
        let mut rng = Rng::new(3);
        let random = (0..2000).map(move |_| (rng.bits() >> 33) as u32);
        for size in sizes.chain(random).filter(|&size| (1..=TableSize::MAX).contains(&size)) {
            check_all(size, None);
        }
        macro_rules! constants {
            ($($size:literal),*) => { $(check_all($size, Some(&Constant::<$size>));)* };
        }
        constants!(1, 2, 3, 5, 127, 255, 65_537, 1_234_567, 0x7fff_ffff, 0x8000_0000);
    }

    #[test]
    fn sizes_keep_the_sign_clear() {
        assert_eq!(TableSize::new(0), None);
        assert_eq!(TableSize::new(TableSize::MAX + 1), None);
        assert_eq!(TableSize::new(TableSize::MAX).map(TableSize::get), Some(1 << 31));
    }
}
