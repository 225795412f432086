//! Where a harness takes its choices from.

mod drawn;

pub use drawn::{Cases, Drawn};

/// A source of choices, and what a harness tells it.
pub trait Choose {
    /// Whether the body is the twin's: then it makes its mistake.
    const PLANTED: bool;

    /// Any number of so many bits, at most 64.
    fn bits(&mut self, count: u32) -> u64;

    /// Any number whose ones are among those of `of`.
    fn subset(&mut self, of: u64) -> u64;

    /// The inner nodes of any tree with at most so many of them, as a set of keys. (There may be keys in it that no
    /// path leads to; they are no nodes, and only count.)
    fn inner_keys(&mut self, most: u32) -> Option<u64>;

    /// Goes on only where this holds.
    fn assume(&mut self, condition: bool) -> Option<()>;

    /// Notes whether this can be; by way of [`cover!`](crate::cover).
    fn cover(&mut self, condition: bool, name: &'static str);

    /// Any value.
    fn any<T: Any>(&mut self) -> T
    where
        Self: Sized,
    {
        T::any(self)
    }

    /// A value that is wrong in the twin: `mistake` of it where `planted`.
    fn plant<T>(&self, value: T, mistake: impl FnOnce(T) -> T) -> T
    where
        Self: Sized,
    {
        if Self::PLANTED { mistake(value) } else { value }
    }
}

/// A type of which any value can be chosen.
pub trait Any {
    /// Any value.
    fn any(choose: &mut impl Choose) -> Self;
}

macro_rules! any {
    ($($word:ident),*) => {$(
        impl Any for $word {
            fn any(choose: &mut impl Choose) -> Self {
                choose.bits($word::BITS) as $word
            }
        }
    )*};
}

any!(u8, u16, u32, u64);

impl Any for u128 {
    fn any(choose: &mut impl Choose) -> Self {
        u128::from(choose.bits(64)) << 64 | u128::from(choose.bits(64))
    }
}

impl Any for bool {
    fn any(choose: &mut impl Choose) -> Self {
        choose.bits(1) == 1
    }
}

/// A situation that must be possible under what the harness assumes. (Kani reads the name from the macro's call.)
#[macro_export]
macro_rules! cover {
    ($choose:expr, $condition:expr, $name:literal) => {
        #[cfg(kani)]
        kani::cover!($condition, $name);
        #[cfg(not(kani))]
        $crate::Choose::cover($choose, $condition, $name);
    };
}

/// A number for a name (FNV-1a), by which covers are told apart in C.
pub const fn id(name: &str) -> u32 {
    let (bytes, mut hash, mut i) = (name.as_bytes(), 0x811c_9dc5_u32, 0);
    while i < bytes.len() {
        hash = (hash ^ bytes[i] as u32).wrapping_mul(0x0100_0193);
        i += 1;
    }
    hash
}

/// All values at once.
#[cfg(kani)]
pub(crate) struct Symbolic<const PLANTED: bool>;

#[cfg(kani)]
impl<const PLANTED: bool> Choose for Symbolic<PLANTED> {
    const PLANTED: bool = PLANTED;

    fn bits(&mut self, count: u32) -> u64 {
        kani::any::<u64>() >> (64 - count)
    }

    fn subset(&mut self, of: u64) -> u64 {
        kani::any::<u64>() & of
    }

    fn inner_keys(&mut self, most: u32) -> Option<u64> {
        let keys = self.subset((1 << (1 << most)) - 2);
        self.assume(keys.count_ones() <= most)?;
        Some(keys)
    }

    fn assume(&mut self, condition: bool) -> Option<()> {
        kani::assume(condition);
        Some(())
    }

    fn cover(&mut self, _: bool, _: &'static str) {}
}
