//! Frames for boxes of single precision in a scene of double precision.

use glam::{DVec3, Vec3};

use super::truth::RBig;
use super::{Aabb, EnclosedRay, Interval, Triangle, Vector};

/// A shift and a scale: a point `p` has the coordinates `(p - origin) / 2^exponent`. Boxes have these coordinates.
///
/// Boxes are in single precision, which is too coarse for a small mesh far from the origin, and too narrow for a tiny
/// or a huge mesh. In a separate frame, each mesh is about as large as its distance from zero. `[FRAME-1]`
///
/// ```
/// use stackless_bvh::geom::{Frame, Triangle};
/// use stackless_bvh::glam::DVec3;
///
/// let earth = Triangle([DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + 6.4e6));
/// let frame = Frame::around(earth.0);
/// assert_eq!(frame.aabb(&earth).extent().to_array(), [1.0, 1.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    origin: DVec3,
    exponent: i32,
}

/// Greatest number of points in a median.
const SAMPLES: usize = 4096;

impl Frame {
    /// The frame that does not change coordinates.
    pub const IDENTITY: Self = Self { origin: DVec3::ZERO, exponent: 0 };

    /// Greatest magnitude of an [`exponent`](Self::exponent).
    pub const MAX_EXPONENT: i32 = 1000;

    /// Returns a frame for these finite points. Its origin is their median, where most of them are and floats are
    /// finest; its greatest coordinate is from 1 to 2. [`IDENTITY`](Self::IDENTITY) if there are none. `[FRAME-1]`
    pub fn around(points: impl IntoIterator<Item = DVec3, IntoIter: Clone>) -> Self {
        let points = points.into_iter();
        let (mut lo, mut hi, mut count) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0_usize);
        for point in points.clone() {
            (lo, hi, count) = (lo.min(point), hi.max(point), count + 1);
        }
        if count == 0 {
            return Self::IDENTITY;
        }
        let samples: Vec<_> = points.step_by(count.div_ceil(SAMPLES)).collect();
        let origin = DVec3::from([0, 1, 2].map(|axis| median(samples.iter().map(|point| point[axis]).collect())));
        let radius = (lo - origin).abs().max((hi - origin).abs()).max_element();
        Self { origin, exponent: scale_of(radius.min(f64::MAX)) }
    }

    /// Creates the frame with this origin and exponent, if they are valid.
    pub fn new(origin: DVec3, exponent: i32) -> Option<Self> {
        let exponents = -Self::MAX_EXPONENT..=Self::MAX_EXPONENT;
        (origin.is_finite() && exponents.contains(&exponent)).then_some(Self { origin, exponent })
    }

    /// Returns the point with the coordinates zero. It is finite.
    #[inline]
    pub const fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Returns the exponent of the unit of length.
    #[inline]
    pub const fn exponent(&self) -> i32 {
        self.exponent
    }

    /// Returns whether the frame leaves coordinates unchanged.
    #[inline]
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// Returns the smallest box in single precision, in this frame, that contains a triangle. Triangles in single
    /// precision have only the frame [`IDENTITY`](Self::IDENTITY).
    #[inline]
    pub fn aabb<V: Vector>(&self, triangle: &Triangle<V>) -> Aabb {
        V::aabb(&triangle.0, self)
    }

    /// Returns the smallest box of points in double precision.
    pub(super) fn aabb_of(&self, [a, b, c]: &[DVec3; 3]) -> Aabb {
        let (lo, hi) = (a.min(*b).min(*c), a.max(*b).max(*c));
        self.enter(&[0, 1, 2].map(|axis| Interval::between([lo[axis], hi[axis]])))
    }

    /// Returns the smallest box in single precision, in this frame, that contains the points whose coordinates are
    /// within bounds.
    pub(crate) fn enter(&self, bounds: &[Interval; 3]) -> Aabb {
        let ends = [0, 1, 2].map(|axis| self.inside(axis, bounds[axis]).ends_in_single());
        Aabb { lo: Vec3::from(ends.map(|[lo, _]| lo)), hi: Vec3::from(ends.map(|[_, hi]| hi)) }
    }

    /// Returns bounds of the points of a box in this frame.
    pub(crate) fn leave(&self, aabb: &Aabb) -> [Interval; 3] {
        [0, 1, 2].map(|axis| {
            let inside = Interval::between([aabb.lo[axis], aabb.hi[axis]].map(f64::from));
            inside.scaled(self.exponent) + Interval::exact(self.origin[axis])
        })
    }

    /// Returns bounds of a ray in this frame. Distances along it do not change.
    pub(super) fn ray(&self, ray: &EnclosedRay) -> EnclosedRay {
        let origin = [0, 1, 2].map(|axis| self.inside(axis, ray.origin[axis]));
        EnclosedRay { origin, direction: ray.direction.map(|x| x.scaled(-self.exponent)), ..*ray }
    }

    /// Returns bounds of the coordinates of a point.
    pub(super) fn ends(&self, point: DVec3) -> [DVec3; 2] {
        let ends = [0, 1, 2].map(|axis| self.coordinate(axis, point[axis]).ends());
        [0, 1].map(|end| DVec3::from(ends.map(|ends| ends[end])))
    }

    /// Returns bounds of a coordinate of a point.
    #[inline]
    pub(super) fn coordinate(&self, axis: usize, x: f64) -> Interval {
        self.inside(axis, Interval::exact(x))
    }

    /// Returns bounds of a coordinate that is within bounds.
    #[inline]
    pub(super) fn inside(&self, axis: usize, x: Interval) -> Interval {
        (x - Interval::exact(self.origin[axis])).scaled(-self.exponent)
    }

    /// Returns the coordinates of a point, each with a relative error of at most 2^-53, except for underflow.
    #[inline]
    pub(crate) fn rounded(&self, point: DVec3) -> DVec3 {
        (point - self.origin) * power_of_two(-self.exponent)
    }

    /// Returns the exact coordinates of a point, if it is finite.
    pub(crate) fn exact(&self, point: DVec3) -> Option<[RBig; 3]> {
        let scale = RBig::try_from(power_of_two(-self.exponent)).ok()?;
        let exact = |axis: usize| {
            let [x, origin] = [point[axis], self.origin[axis]].map(RBig::try_from);
            Some((x.ok()? - origin.ok()?) * &scale)
        };
        Some([exact(0)?, exact(1)?, exact(2)?])
    }
}

/// Returns the median of at least one number.
fn median(mut numbers: Vec<f64>) -> f64 {
    let middle = numbers.len() / 2;
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Returns the exponent of a frame for coordinates up to this one.
fn scale_of(radius: f64) -> i32 {
    if radius == 0.0 { 0 } else { exponent_of(radius).clamp(-Frame::MAX_EXPONENT, Frame::MAX_EXPONENT) }
}

/// Returns the `e` for which a finite magnitude is from 2^e to 2^(e + 1); -1074 for 0.
#[inline]
pub(crate) fn exponent_of(x: f64) -> i32 {
    let exponent = |x: f64| (x.to_bits() >> 52 & 0x7ff) as i32 - 1023;
    if x >= f64::MIN_POSITIVE { exponent(x) } else { (exponent(x * power_of_two(52)) - 52).max(-1074) }
}

/// Returns 2 to the power of an exponent from -1022 to 1023.
pub(crate) const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests;
