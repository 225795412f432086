//! The two kinds of numbers of rays and triangles.

use std::fmt::Debug;
use std::ops::Sub;

use glam::{DVec3, Vec3};

use super::truth::Number;
use super::{Aabb, Frame, kernel};

/// A position or direction, in single or in double precision.
pub trait Vector:
    Copy + PartialEq + Debug + Send + Sync + From<Vec3> + Sub<Output = Self> + private::Sealed + 'static
{
    /// A coordinate.
    type Real: Real;

    /// Returns whether no component is NaN or infinite.
    fn is_finite(self) -> bool;

    /// Converts the vector to double precision, exactly.
    fn widen(self) -> DVec3;

    /// Returns the components.
    fn components(self) -> [Self::Real; 3];

    /// Creates the vector of these components.
    fn from_components(components: [Self::Real; 3]) -> Self;

    /// Returns the smallest box in single precision, in a frame, that contains these points; infinite beyond the range
    /// of single precision. Points in single precision have no frame.
    fn aabb(points: &[Self; 3], frame: &Frame) -> Aabb;

    /// Returns the [`Frame`] for these points.
    fn frame(points: impl IntoIterator<Item = Self, IntoIter: Clone>) -> Frame;

    /// Returns whether three points lie on a line, exactly.
    fn are_collinear(points: &[Self; 3]) -> bool;
}

/// A coordinate or a distance.
pub trait Real: Number + PartialEq + PartialOrd + Debug + Default + Send + Sync + private::Sealed + 'static {
    /// 0.
    const ZERO: Self;

    /// 1.
    const ONE: Self;

    /// Greater than every number.
    const INFINITY: Self;

    /// Returns the greatest float below this one.
    #[must_use]
    fn next_down(self) -> Self;

    /// Returns the least float above this one.
    #[must_use]
    fn next_up(self) -> Self;

    /// Rounds a double to the nearest float, ties to even.
    fn rounded(x: f64) -> Self;

    /// Returns the float to which all numbers between the two round, if there is one; a zero is positive. The two are
    /// sums of a double and its rounding error.
    fn between(ends: [[f64; 2]; 2]) -> Option<Self>;

    /// Returns numbers in the order of distances (which are not negative), rounded down and up. They are equal only if
    /// the distances are equal or nearly equal.
    fn ranks(self) -> [u32; 2];

    /// Rounds a distance down and up to single precision.
    #[inline]
    fn ends_in_single(self) -> [f32; 2] {
        self.ranks().map(f32::from_bits)
    }
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

    #[inline]
    fn components(self) -> [f32; 3] {
        self.into()
    }

    #[inline]
    fn from_components(components: [f32; 3]) -> Self {
        components.into()
    }

    #[inline]
    fn aabb(points: &[Self; 3], _: &Frame) -> Aabb {
        Aabb::of(points)
    }

    fn frame(_: impl IntoIterator<Item = Self, IntoIter: Clone>) -> Frame {
        Frame::IDENTITY
    }

    fn are_collinear(points: &[Self; 3]) -> bool {
        kernel::is_degenerate(&points.map(Self::widen))
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

    #[inline]
    fn components(self) -> [f64; 3] {
        self.into()
    }

    #[inline]
    fn from_components(components: [f64; 3]) -> Self {
        components.into()
    }

    fn aabb(points: &[Self; 3], frame: &Frame) -> Aabb {
        frame.aabb_of(points)
    }

    fn frame(points: impl IntoIterator<Item = Self, IntoIter: Clone>) -> Frame {
        Frame::around(points)
    }

    fn are_collinear(points: &[Self; 3]) -> bool {
        kernel::is_degenerate(points)
    }
}

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const INFINITY: Self = f32::INFINITY;

    fn next_down(self) -> Self {
        self.next_down()
    }

    fn next_up(self) -> Self {
        self.next_up()
    }

    #[inline]
    fn rounded(x: f64) -> Self {
        x as f32
    }

    #[inline]
    fn between([[lo, below], [hi, above]]: [[f64; 2]; 2]) -> Option<Self> {
        // Rounding a rounded sum might round twice, so the ends are moved outwards first.
        let lo = if below < 0.0 { lo.next_down() } else { lo } as f32 + 0.0;
        let hi = if above > 0.0 { hi.next_up() } else { hi } as f32 + 0.0;
        (lo == hi).then_some(lo)
    }

    /// Returns the bits, with one zero.
    #[inline]
    fn ranks(self) -> [u32; 2] {
        [(self + 0.0).to_bits(); 2]
    }
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const INFINITY: Self = f64::INFINITY;

    fn next_down(self) -> Self {
        self.next_down()
    }

    fn next_up(self) -> Self {
        self.next_up()
    }

    #[inline]
    fn rounded(x: f64) -> Self {
        x
    }

    #[inline]
    fn between([[lo, _], [hi, _]]: [[f64; 2]; 2]) -> Option<Self> {
        (lo == hi).then_some(lo + 0.0)
    }

    #[inline]
    fn ranks(self) -> [u32; 2] {
        let nearest = self as f32;
        let down = if f64::from(nearest) > self { nearest.next_down() } else { nearest };
        let up = if f64::from(nearest) < self { nearest.next_up() } else { nearest };
        [down, up].map(|bound| (bound + 0.0).to_bits())
    }
}

mod private {
    /// Numbers are single or double only: each precision has a separate analysis.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for glam::Vec3 {}
    impl Sealed for glam::DVec3 {}
}
