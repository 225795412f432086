//! The two kinds of numbers that rays and triangles may have.

use std::fmt::Debug;
use std::ops::Sub;

use glam::{DVec3, Vec3};

/// A position or direction, in single or in double precision.
pub trait Vector: Copy + PartialEq + Debug + Sub<Output = Self> + private::Sealed {
    /// A coordinate.
    type Real: Real;

    /// Whether no component is NaN or infinite.
    fn is_finite(self) -> bool;

    /// The same in double precision; exact.
    fn widen(self) -> DVec3;
}

/// A coordinate or a distance.
pub trait Real: Copy + PartialEq + PartialOrd + Debug + Default + Into<f64> + private::Sealed {
    /// Beyond every number.
    const INFINITY: Self;
}

impl Vector for Vec3 {
    type Real = f32;

    #[inline]
    fn is_finite(self) -> bool {
        self.is_finite()
    }

    #[inline]
    fn widen(self) -> DVec3 {
        self.as_dvec3()
    }
}

impl Vector for DVec3 {
    type Real = f64;

    #[inline]
    fn is_finite(self) -> bool {
        self.is_finite()
    }

    #[inline]
    fn widen(self) -> DVec3 {
        self
    }
}

impl Real for f32 {
    const INFINITY: Self = f32::INFINITY;
}

impl Real for f64 {
    const INFINITY: Self = f64::INFINITY;
}

mod private {
    /// Numbers are single or double, nothing else: each has its own analysis.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for glam::Vec3 {}
    impl Sealed for glam::DVec3 {}
}
