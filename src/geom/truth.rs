//! The ground truth about lines, triangles and boxes, in rational arithmetic: slow, and without rounding.
//!
//! Finite floats are rational numbers, and are used exactly. [`meet`] intersects a line and a triangle, [`touches`] and
//! [`entry`] a ray's interval and a box, and [`round_f32`] and [`round_f64`] round the true value to a float. Tests
//! compare the kernels and slab tests of this crate with these functions.
//!
//! # Integers
//!
//! All floats of one query are multiplied by one power of two that makes them integers, positions and direction alike.
//! This does not change the signs and the quotients of the answer: the polynomials of the triangle test are all of
//! degree three, and the distances to the planes of a box are quotients of two lengths.

mod nearest;

pub use dashu_ratio::{RBig, Relaxed};
pub(super) use nearest::{nearest_of_integers, round_root_of};
pub use nearest::{nearest_point, nearest_weights, round_root, square_distance, unit_normal};

use dashu_int::{IBig, Sign};

/// A float with its exact value: `f32` or `f64`.
pub trait Number: Copy + Into<f64> + sealed::Sealed {
    /// Returns the number of this type nearest to `x`: [`round_f32`] or [`round_f64`].
    fn nearest(x: &RBig) -> Self {
        Self::nearest_to(x.as_relaxed())
    }

    /// Returns the number nearest to a fraction that may not be in lowest terms.
    fn nearest_to(x: &Relaxed) -> Self;
}

impl Number for f32 {
    fn nearest_to(x: &Relaxed) -> Self {
        x.to_f32().value()
    }
}

impl Number for f64 {
    fn nearest_to(x: &Relaxed) -> Self {
        x.to_f64().value()
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// Intersection of a line and a triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// The line crosses the plane of the triangle outside the triangle.
    Miss,
    /// The line is parallel to the plane, or in it, or the triangle has no area, or the direction is zero: the
    /// determinant is 0. It counts as a miss.
    Coplanar,
    /// The line crosses the triangle, including its edges and corners.
    Hit(Point),
}

impl Meeting {
    /// Returns the point, if it is within an interval `[tmin, tmax]`, by [`holds`].
    pub fn within<S: Number>(self, interval: [S; 2]) -> Option<Point> {
        match self {
            Self::Hit(point) if holds(interval, &point.t) => Some(point),
            _ => None,
        }
    }
}

/// The point at which a line crosses a triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// The part of the triangle.
    pub place: Place,
    /// Distance from the origin in units of the length of the direction, of either sign.
    pub t: RBig,
    /// Weight of the second corner, 0 to 1.
    pub u: RBig,
    /// Weight of the third corner, 0 to 1; with `u` at most 1.
    pub v: RBig,
}

/// The part of a triangle that a point is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// Not on the boundary.
    Interior,
    /// On an edge, between its ends.
    Edge,
    /// At a corner.
    Vertex,
}

/// Intersects the line `origin + t direction` and a triangle, given by its corners; `t` may have either sign.
///
/// The polynomials are those of Möller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", section 2,
/// without culling. If a number is not finite, the answer is a miss.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{Meeting, Place, Point, RBig, meet};
///
/// let triangle = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// let third = RBig::from_parts(1.into(), 3u8.into());
/// let point = Point { place: Place::Interior, t: 2.into(), u: third.clone(), v: third };
/// assert_eq!(meet(triangle, [1.0, 1.0, -2.0], [0.0, 0.0, 1.0]), Meeting::Hit(point));
/// assert_eq!(meet(triangle, [4.0, 1.0, -2.0], [0.0, 0.0, 1.0]), Meeting::Miss);
/// assert_eq!(meet(triangle, [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]), Meeting::Coplanar);
/// ```
pub fn meet<S: Number>(triangle: [[S; 3]; 3], origin: [S; 3], direction: [S; 3]) -> Meeting {
    let [v0, v1, v2] = triangle;
    integers([v0, v1, v2, origin, direction]).map_or(Meeting::Miss, meet_integers)
}

/// Computes [`meet`] for corners, origin and direction that are all multiplied by one positive number.
pub(super) fn meet_integers([v0, v1, v2, o, d]: [Vector; 5]) -> Meeting {
    let (e1, e2, s) = (minus(&v1, &v0), minus(&v2, &v0), minus(&o, &v0));
    let (p, q) = (cross(&d, &e2), cross(&s, &e1));
    let det = dot(&e1, &p);
    if det.is_zero() {
        return Meeting::Coplanar;
    }
    let (u, v, t) = (dot(&s, &p), dot(&d, &q), dot(&e2, &q));
    // Over the determinant, these are the weights of the three corners.
    let weights = [&det - &u - &v, u.clone(), v.clone()];
    if weights.iter().any(|weight| !weight.is_zero() && weight.sign() != det.sign()) {
        return Meeting::Miss;
    }
    let place = match weights.iter().filter(|weight| weight.is_zero()).count() {
        0 => Place::Interior,
        1 => Place::Edge,
        _ => Place::Vertex,
    };
    let over_det = |x| RBig::from_parts_signed(x, det.clone());
    Meeting::Hit(Point { place, t: over_det(t), u: over_det(u), v: over_det(v) })
}

/// Returns whether the line passes through the interior of a triangle after its origin is moved by (ε, ε², ε³), for an
/// ε that is positive and smaller than any number. Corners, origin and direction are all multiplied by one positive
/// number. `[PARITY-1]`
pub(super) fn crosses_integers([v0, v1, v2, o, d]: &[Vector; 5]) -> bool {
    // The sign of the edge function, or if it is 0 that of its first change. `None` for an edge along the line.
    let side = |from: &Vector, to: &Vector| {
        let edge = dot(d, &cross(&minus(to, o), &minus(from, o)));
        [edge].into_iter().chain(cross(&minus(to, from), d)).find(|x| !x.is_zero()).map(|x| x.sign())
    };
    let first = side(v0, v1);
    // Without a determinant, the edge functions add up to 0, so their signs differ.
    first.is_some() && side(v1, v2) == first && side(v2, v0) == first
}

/// Intersects the line `origin + t direction` from a rational point and a triangle. Returns the distance, in units of
/// the length of the direction. It uses the normal of the plane and areas, so it shares no formula with [`meet`].
/// `[SECOND-2]`
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, distance_from};
///
/// let triangle = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// let third = || RBig::from_parts(1.into(), 3u8.into());
/// assert_eq!(distance_from(triangle, &[third(), third(), third()], [0.0, 0.0, -2.0]), Some(third() / RBig::from(2)));
/// assert_eq!(distance_from(triangle, &[-third(), third(), third()], [0.0, 0.0, -2.0]), None);
/// ```
pub fn distance_from<S: Number>(triangle: [[S; 3]; 3], origin: &[RBig; 3], direction: [S; 3]) -> Option<RBig> {
    type Rational = [RBig; 3];
    let minus = |a: &Rational, b: &Rational| -> Rational { std::array::from_fn(|k| &a[k] - &b[k]) };
    let dot = |a: &Rational, b: &Rational| &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2];
    let cross = |a: &Rational, b: &Rational| -> Rational {
        std::array::from_fn(|k| &a[(k + 1) % 3] * &b[(k + 2) % 3] - &a[(k + 2) % 3] * &b[(k + 1) % 3])
    };
    let [a, b, c, d] = [triangle[0], triangle[1], triangle[2], direction].map(|v| v.map(|x| RBig::try_from(x.into())));
    let finite = |v: [Result<RBig, _>; 3]| -> Option<Rational> {
        let [x, y, z] = v.map(Result::ok);
        Some([x?, y?, z?])
    };
    let (a, b, c, d) = (finite(a)?, finite(b)?, finite(c)?, finite(d)?);
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    let speed = dot(&normal, &d);
    if speed.is_zero() {
        return None;
    }
    let t = dot(&normal, &minus(&a, origin)) / speed;
    let point: Rational = std::array::from_fn(|k| &origin[k] + &t * &d[k]);
    let is_inside =
        |from: &Rational, to: &Rational| dot(&normal, &cross(&minus(to, from), &minus(&point, from))) >= RBig::ZERO;
    (is_inside(&a, &b) && is_inside(&b, &c) && is_inside(&c, &a)).then_some(t)
}

/// Returns whether a closed interval contains `t`. An infinite end is no bound; an interval with a NaN contains
/// nothing.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, holds};
///
/// let tenth = RBig::from_parts(1.into(), 10u8.into());
/// assert!(holds([0.0, f32::INFINITY], &tenth));
/// // The float is above the tenth.
/// assert!(!holds([0.1f32, 1.0], &tenth));
/// ```
pub fn holds<S: Number>(interval: [S; 2], t: &RBig) -> bool {
    holds_fraction(interval, t.as_relaxed())
}

/// Computes [`holds`] for a fraction that may not be in lowest terms.
pub(super) fn holds_fraction<S: Number>([tmin, tmax]: [S; 2], t: &Relaxed) -> bool {
    let (tmin, tmax): (f64, f64) = (tmin.into(), tmax.into());
    let is_above = Relaxed::try_from(tmin).map_or(tmin == f64::NEG_INFINITY, |tmin| tmin <= *t);
    let is_below = Relaxed::try_from(tmax).map_or(tmax == f64::INFINITY, |tmax| *t <= tmax);
    is_above && is_below
}

/// Returns whether the part of the line `origin + t direction` with `tmin <= t <= tmax` meets the box from `lo` to
/// `hi`, including the ends of the interval and the faces of the box.
///
/// `interval` is `[tmin, tmax]`; `tmax` may be infinite. A component of the direction that is 0, of either sign, keeps
/// the line in a plane. A box with `lo > hi` on some axis is empty, and so is an interval with `tmin > tmax`. If
/// another number is not finite, the line touches nothing.
///
/// ```
/// use stackless_bvh::internals::geom::truth::touches;
///
/// let corner = |o, tmax| touches(o, [1.0, 1.0, 0.0], [0.0, tmax], [1.0, 0.0, 0.0], [2.0, 1.0, 1.0]);
/// assert!(corner([0.0, 0.0, 0.0], 1.0));
/// assert!(!corner([0.0, 0.0, 0.0], 1.0 - f64::EPSILON));
/// assert!(!corner([0.0, 1e-300, 0.0], f64::INFINITY));
/// ```
pub fn touches<S: Number>(origin: [S; 3], direction: [S; 3], interval: [S; 2], lo: [S; 3], hi: [S; 3]) -> bool {
    first_touch(origin, direction, interval, lo, hi).is_some()
}

/// Returns the least `t` at which [`touches`] has a common point: the greatest of `tmin` and the distances to the
/// planes at which the line enters. `None` if the line does not touch the box.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, entry};
///
/// let t = |tmin| entry([0.0, 0.5, 0.5], [3.0, 0.0, 0.0], [tmin, f32::INFINITY], [1.0; 3].map(|x| x - 1.0), [2.0; 3]);
/// assert_eq!(t(0.25), Some(RBig::from_parts(1.into(), 4u8.into())));
/// assert_eq!(t(0.75), None);
/// ```
pub fn entry<S: Number>(origin: [S; 3], direction: [S; 3], interval: [S; 2], lo: [S; 3], hi: [S; 3]) -> Option<RBig> {
    first_touch(origin, direction, interval, lo, hi).map(Relaxed::canonicalize)
}

/// Returns the `f32` nearest to `x`, ties to even.
///
/// Subnormal numbers and numbers beyond the greatest float are rounded as in IEEE 754: from the midpoint of the
/// greatest float and 2^128 on, the result is infinite. A result of 0 has the sign of `x`.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, round_f32};
///
/// assert_eq!(round_f32(&RBig::from_parts((-1).into(), 10u8.into())), -0.1);
/// ```
pub fn round_f32(x: &RBig) -> f32 {
    Number::nearest(x)
}

/// Returns the `f64` nearest to `x`, as [`round_f32`] does; infinite from the midpoint of the greatest float and 2^1024
/// on.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, round_f64};
///
/// assert_eq!(round_f64(&RBig::from_parts(2.into(), 3u8.into())), 2.0 / 3.0);
/// ```
pub fn round_f64(x: &RBig) -> f64 {
    Number::nearest(x)
}

/// Computes [`entry`] as a fraction that may not be in lowest terms: reduction costs most of the time.
pub(super) fn first_touch<S: Number>(
    origin: [S; 3],
    direction: [S; 3],
    [tmin, tmax]: [S; 2],
    lo: [S; 3],
    hi: [S; 3],
) -> Option<Relaxed> {
    let [o, d, lo, hi] = integers([origin, direction, lo, hi])?;
    let mut enter = Relaxed::try_from(tmin.into()).ok()?;
    let mut leave = match tmax.into() {
        f64::INFINITY => None,
        tmax => Some(Relaxed::try_from(tmax).ok()?),
    };
    for k in 0..3 {
        if lo[k] > hi[k] {
            return None;
        }
        if d[k].is_zero() {
            if o[k] < lo[k] || hi[k] < o[k] {
                return None;
            }
            continue;
        }
        let (near, far) = if d[k].sign() == Sign::Positive { (&lo[k], &hi[k]) } else { (&hi[k], &lo[k]) };
        let distance = |plane: &IBig| Relaxed::from_parts_signed(plane - &o[k], d[k].clone());
        enter = enter.max(distance(near));
        leave = leave.into_iter().chain([distance(far)]).min();
    }
    leave.is_none_or(|leave| enter <= leave).then_some(enter)
}

/// Returns the least `t`, not negative, at which a line of rational numbers has a common point with the box between
/// `lo` and `hi`, which are finite.
pub(super) fn touch(o: &[Relaxed; 3], d: &[Relaxed; 3], [lo, hi]: [[f64; 3]; 2]) -> Option<Relaxed> {
    let (mut enter, mut leave) = (Relaxed::ZERO, None);
    for k in 0..3 {
        let [lo, hi] = [lo[k], hi[k]].map(|side| Relaxed::try_from(side).unwrap_or_default() - &o[k]);
        if d[k].is_zero() {
            if lo > Relaxed::ZERO || hi < Relaxed::ZERO {
                return None;
            }
            continue;
        }
        let [near, far] = if d[k] > Relaxed::ZERO { [lo, hi] } else { [hi, lo] }.map(|way| way / &d[k]);
        enter = enter.max(near);
        leave = leave.into_iter().chain([far]).min();
    }
    leave.is_none_or(|leave| enter <= leave).then_some(enter)
}

type Vector = [IBig; 3];

/// Returns the vectors times [`scale`]. `None` if one is not finite.
fn integers<S: Number, const N: usize>(vectors: [[S; 3]; N]) -> Option<[Vector; N]> {
    let exact = vectors.as_flattened().iter().map(|&x| RBig::try_from(x.into()).ok());
    let exact: Vec<RBig> = exact.collect::<Option<_>>()?;
    let greatest = exact.iter().map(log2_of_denominator).max().unwrap_or(0);
    let integer = |x: &RBig| x.numerator() << (greatest - log2_of_denominator(x));
    Some(std::array::from_fn(|i| std::array::from_fn(|k| integer(&exact[3 * i + k]))))
}

/// Returns the least power of two, at least 1, that makes all components integers. `None` if one is not finite.
fn scale<S: Number, const N: usize>(vectors: [[S; 3]; N]) -> Option<IBig> {
    let logs = vectors.as_flattened().iter().map(|&x| RBig::try_from(x.into()).ok().map(|x| log2_of_denominator(&x)));
    let logs: Option<Vec<usize>> = logs.collect();
    Some(IBig::ONE << logs?.into_iter().max().unwrap_or(0))
}

/// Denominators of floats are powers of two.
fn log2_of_denominator(x: &RBig) -> usize {
    x.denominator().trailing_zeros().unwrap_or(0)
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn dot(a: &Vector, b: &Vector) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    let component = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

#[cfg(test)]
mod tests;
