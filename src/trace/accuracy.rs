//! Triangle tests and box tests, by name.

use glam::Vec3;

use super::KernelShape;
use crate::geom::kernel::{Affine, Exact, ExactFromSingle, Moller32, Moller64, Woop};
use crate::geom::slabs::{Directed, Plain, TwoSided};
use crate::geom::{Kernel, Slabs};
use crate::name::named;

/// Levels of accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accuracy {
    /// The fastest tests in single precision, without guarantees.
    Fast,
    /// The test of Woop et al.: no known leaks; primitive and distance are subject to rounding.
    Watertight,
    /// Double precision: mostly correct to the last bit, with rare leaks at edges.
    Precise,
    /// The answer of rational arithmetic, with distance and weights rounded to the nearest floats. `[EXACT-1]`
    #[default]
    Exact,
}

impl Accuracy {
    /// All levels, the least exact first.
    pub const ALL: [Self; 4] = [Self::Fast, Self::Watertight, Self::Precise, Self::Exact];

    /// Returns the name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Watertight => "watertight",
            Self::Precise => "precise",
            Self::Exact => "exact",
        }
    }

    /// Returns its tests.
    pub const fn tests(self) -> (KernelName, SlabsName) {
        match self {
            Self::Fast => (KernelName::Affine, SlabsName::Plain),
            Self::Watertight => (KernelName::Woop, SlabsName::Directed),
            Self::Precise => (KernelName::Moller64, SlabsName::TwoSided),
            Self::Exact => (KernelName::Exact, SlabsName::Directed),
        }
    }
}

named!(Accuracy);

/// A triangle test, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names are those of the types")]
pub enum KernelName {
    Affine,
    Moller32,
    Woop,
    Moller64,
    ExactFromSingle,
    Exact,
}

impl KernelName {
    /// All triangle tests.
    pub const ALL: [Self; 6] =
        [Self::Affine, Self::Moller32, Self::Woop, Self::Moller64, Self::ExactFromSingle, Self::Exact];

    /// Returns the name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::Moller32 => "moller-32",
            Self::Woop => "woop",
            Self::Moller64 => "moller-64",
            Self::ExactFromSingle => "exact-from-single",
            Self::Exact => "exact",
        }
    }
}

named!(KernelName);

/// A box test, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names are those of the types")]
pub enum SlabsName {
    Plain,
    TwoSided,
    Directed,
}

impl SlabsName {
    /// All box tests of single-precision rays.
    pub const ALL: [Self; 3] = [Self::Plain, Self::TwoSided, Self::Directed];

    /// Returns the name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::TwoSided => "two-sided",
            Self::Directed => "directed",
        }
    }
}

named!(SlabsName);

/// A generic function of tests that are selected at run time.
pub trait WithTests {
    /// The result.
    type Output;

    /// Calls the function with the triangle test `K` and the box test `B`.
    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape> + 'static, B: Slabs<Vector = Vec3> + 'static>(
        self,
    ) -> Self::Output;
}

/// Calls [`with_tests`] for [`Accuracy::tests`]. This compiles the function only for the pairs of the levels.
pub fn with_level<F: WithTests>(level: Accuracy, f: F) -> F::Output {
    match level {
        Accuracy::Fast => f.call::<Affine, Plain>(),
        Accuracy::Watertight => f.call::<Woop, Directed>(),
        Accuracy::Precise => f.call::<Moller64, TwoSided>(),
        Accuracy::Exact => f.call::<Exact, Directed>(),
    }
}

/// Calls a function with the types of the named tests.
pub fn with_tests<F: WithTests>((kernel, slabs): (KernelName, SlabsName), f: F) -> F::Output {
    match kernel {
        KernelName::Affine => with_kernel::<Affine, F>(slabs, f),
        KernelName::Moller32 => with_kernel::<Moller32, F>(slabs, f),
        KernelName::Woop => with_kernel::<Woop, F>(slabs, f),
        KernelName::Moller64 => with_kernel::<Moller64, F>(slabs, f),
        KernelName::ExactFromSingle => with_kernel::<ExactFromSingle, F>(slabs, f),
        KernelName::Exact => with_kernel::<Exact, F>(slabs, f),
    }
}

fn with_kernel<K: Kernel<Vector = Vec3, Shape: KernelShape> + 'static, F: WithTests>(
    slabs: SlabsName,
    f: F,
) -> F::Output {
    match slabs {
        SlabsName::Plain => f.call::<K, Plain>(),
        SlabsName::TwoSided => f.call::<K, TwoSided>(),
        SlabsName::Directed => f.call::<K, Directed>(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct TypeNames;

    impl WithTests for TypeNames {
        type Output = [&'static str; 2];

        fn call<K: Kernel<Vector = Vec3>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
            [std::any::type_name::<K>(), std::any::type_name::<B>()]
        }
    }

    #[test]
    fn a_level_has_the_tests_that_it_names() {
        for level in Accuracy::ALL {
            assert_eq!(with_level(level, TypeNames), with_tests(level.tests(), TypeNames), "{level}");
        }
    }
}
