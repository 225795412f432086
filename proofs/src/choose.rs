//! Sources of a harness's choices.

mod drawn;

pub use drawn::{Cases, Drawn};

/// A source of choices, with the assumptions and covers of a harness.
pub trait Choose {
    /// Whether the body is the twin's, with its mistake.
    const PLANTED: bool;

    /// Returns any number of `count` bits, at most 64.
    fn bits(&mut self, count: u32) -> u64;

    /// Returns any number whose ones are a subset of those of `of`.
    fn subset(&mut self, of: u64) -> u64;

    /// Returns the inner nodes of any tree with at most `most` of them, as a set of keys. (The set may have unreachable
    /// keys, which are no nodes and only count.)
    fn inner_keys(&mut self, most: u32) -> Option<u64>;

    /// Continues only if the condition holds.
    fn assume(&mut self, condition: bool) -> Option<()>;

    /// Records whether the condition is possible; called by [`cover!`](crate::cover).
    fn cover(&mut self, condition: bool, name: &'static str);

    /// Returns any value.
    fn any<T: Any>(&mut self) -> T
    where
        Self: Sized,
    {
        T::any(self)
    }

    /// Returns a value that is wrong in the twin: its `mistake` if `PLANTED`.
    fn plant<T>(&self, value: T, mistake: impl FnOnce(T) -> T) -> T
    where
        Self: Sized,
    {
        if Self::PLANTED { mistake(value) } else { value }
    }
}

/// A type with arbitrary choices.
pub trait Any {
    /// Returns any value.
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

/// A situation that must be possible under the harness's assumptions. (Kani reads the name from the macro's call.)
#[macro_export]
macro_rules! cover {
    ($choose:expr, $condition:expr, $name:literal) => {
        #[cfg(kani)]
        kani::cover!($condition, $name);
        #[cfg(not(kani))]
        $crate::Choose::cover($choose, $condition, $name);
    };
}

/// Returns a number for a name (FNV-1a), which identifies covers in C.
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
