//! The nearest point of a triangle, and its distance.

use dashu_int::ops::{BitTest, DivRem, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, Sign, UBig};
use dashu_ratio::Relaxed;

use super::{Number, RBig, Vector, cross, dot, integers, minus, scale};

/// The square of the distance from a point to a triangle. `None` if a coordinate is not finite.
///
/// The least of the distances to the three edges, and to the plane if the point is above the triangle.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, square_distance};
///
/// let triangle = [[0.0_f32, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// assert_eq!(square_distance(triangle, [1.0, 1.0, 0.5]), RBig::try_from(0.25).ok());
/// assert_eq!(square_distance(triangle, [-1.0, -2.0, 2.0]), RBig::try_from(9.0).ok());
/// ```
pub fn square_distance<S: Number>(triangle: [[S; 3]; 3], point: [S; 3]) -> Option<RBig> {
    let (Nearest { square, .. }, _, scale) = nearest(triangle, point)?;
    Some((square / Relaxed::from(&scale * &scale)).canonicalize())
}

/// The point of a triangle that is nearest to a point: there is one, as triangles are convex. `None` if a coordinate is
/// not finite. `[NEAR-3]`
///
/// ```
/// use stackless_bvh::internals::geom::truth::{nearest_point, round_f32};
///
/// let triangle = [[0.0_f32, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// let nearest = |point| nearest_point(triangle, point).map(|point| point.each_ref().map(round_f32));
/// assert_eq!(nearest([1.0, 1.0, 0.5]), Some([1.0, 1.0, 0.0]));
/// assert_eq!(nearest([2.0, 2.0, 0.5]), Some([1.5, 1.5, 0.0]));
/// assert_eq!(nearest([f32::NAN, 0.0, 0.0]), None);
/// ```
pub fn nearest_point<S: Number>(triangle: [[S; 3]; 3], point: [S; 3]) -> Option<[RBig; 3]> {
    let (Nearest { weights, denominator, .. }, corners, scale) = nearest(triangle, point)?;
    let denominator = denominator * scale;
    let numerator = |k: usize| (0..3).map(|i| &weights[i] * &corners[i][k]).sum();
    Some([0, 1, 2].map(|k| RBig::from_parts_signed(numerator(k), denominator.clone())))
}

/// The weights of the three corners in [`nearest_point`]: none is negative, and their sum is 1. `None` if a coordinate
/// is not finite. A triangle without area has several such weights at some points; then one is a zero. `[NEAR-9]`
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, nearest_weights};
///
/// let triangle = [[0.0_f32, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// let half = RBig::from_parts(1.into(), 2u8.into());
/// assert_eq!(nearest_weights(triangle, [2.0, 2.0, 0.5]), Some([RBig::ZERO, half.clone(), half]));
/// ```
pub fn nearest_weights<S: Number>(triangle: [[S; 3]; 3], point: [S; 3]) -> Option<[RBig; 3]> {
    let (Nearest { weights, denominator, .. }, ..) = nearest(triangle, point)?;
    Some(weights.map(|weight| RBig::from_parts_signed(weight, denominator.clone())))
}

/// The normal of length 1 of a triangle, each component the float nearest to the exact one; a zero is positive. Its
/// corners run counterclockwise seen from where it points. `None` without an area, or if a coordinate is not finite.
///
/// ```
/// use stackless_bvh::internals::geom::truth::unit_normal;
///
/// assert_eq!(unit_normal([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]]), Some([0.0, -0.5f64.sqrt(), 0.5f64.sqrt()]));
/// assert_eq!(unit_normal([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0f32]]), None);
/// ```
pub fn unit_normal<S: Number>(triangle: [[S; 3]; 3]) -> Option<[S; 3]> {
    let [a, b, c] = integers(triangle)?;
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    let area = dot(&normal, &normal);
    if area.is_zero() {
        return None;
    }
    Some(normal.map(|x| {
        let square = RBig::from_parts_signed(&x * &x, area.clone());
        let signed = if x.sign() == Sign::Negative { -1.0 } else { 1.0 };
        S::nearest(&RBig::try_from(signed * round_root::<S>(&square).into() + 0.0).unwrap_or_default())
    }))
}

/// The float nearest to the square root of `x`, which must not be negative; of two equally near the one whose last bit
/// is 0.
///
/// ```
/// use stackless_bvh::internals::geom::truth::{RBig, round_root};
///
/// assert_eq!(round_root::<f32>(&RBig::from(2u8)), 2f32.sqrt());
/// assert_eq!(round_root::<f64>(&RBig::from(2u8)), 2f64.sqrt());
/// ```
pub fn round_root<S: Number>(x: &RBig) -> S {
    round_root_of(x.as_relaxed())
}

/// Computes [`round_root`] for a fraction that may not be in lowest terms.
pub(in crate::geom) fn round_root_of<S: Number>(x: &Relaxed) -> S {
    let square = x.numerator().unsigned_abs();
    // Bits after the binary point, so that the root has more bits than a double and a midpoint of two doubles.
    let places = (2 * ROOT_BITS + x.denominator().bit_len()).saturating_sub(square.bit_len()).div_ceil(2);
    let (whole, rest) = (square << (2 * places)).div_rem(x.denominator());
    let (root, more) = whole.sqrt_rem();
    // An integer and a half represents all numbers between two integers, where there is neither a float nor a midpoint
    // of two floats.
    let is_exact = rest.is_zero() && more.is_zero();
    let twice = (root << 1) + UBig::from(u8::from(!is_exact));
    S::nearest(&RBig::from_parts(twice.into(), UBig::ONE << (places + 1)))
}

/// Least number of bits of a root before it is rounded.
const ROOT_BITS: usize = 64;

/// The corners' weights in the nearest point, over one denominator, and the square of its distance.
struct Nearest {
    weights: [IBig; 3],
    denominator: IBig,
    square: Relaxed,
}

/// Finds the nearest point for coordinates times the number that makes them integers; and returns the corners times that
/// number, and the number.
fn nearest<S: Number>([a, b, c]: [[S; 3]; 3], point: [S; 3]) -> Option<(Nearest, [Vector; 3], IBig)> {
    let scale = scale([a, b, c, point])?;
    let [a, b, c, p] = integers([a, b, c, point])?;
    let corners = [a, b, c];
    Some((among(&corners, &p)?, corners, scale))
}

/// Returns the square of the distance and the nearest point of a triangle, for integers over `scale`. The fractions may
/// not be in lowest terms: reduction costs most of the time.
pub(in crate::geom) fn nearest_of_integers(
    corners: &[Vector; 3],
    point: &Vector,
    scale: &IBig,
) -> (Relaxed, [Relaxed; 3]) {
    // There is always one.
    let Some(Nearest { weights, denominator, square }) = among(corners, point) else { return Default::default() };
    let denominator = denominator * scale;
    let numerator = |k: usize| (0..3).map(|i| &weights[i] * &corners[i][k]).sum();
    let point = [0, 1, 2].map(|k| Relaxed::from_parts_signed(numerator(k), denominator.clone()));
    (square / Relaxed::from(scale * scale), point)
}

/// Finds the nearest point of a triangle.
fn among(corners @ [a, b, c]: &[Vector; 3], p: &Vector) -> Option<Nearest> {
    let normal = cross(&minus(b, a), &minus(c, a));
    let area = dot(&normal, &normal);
    let mut of_edges: Option<Nearest> = None;
    // Weights of the point on the plane, and of those on edges.
    let mut inside = [IBig::ZERO; 3];
    for i in 0..3 {
        let (edge, to_point) = (minus(&corners[(i + 1) % 3], &corners[i]), minus(p, &corners[i]));
        let (along, length) = (dot(&edge, &to_point), dot(&edge, &edge));
        inside[(i + 2) % 3] = dot(&cross(&normal, &edge), &to_point);
        let on_edge = |start: IBig, end: IBig| {
            let mut weights = [IBig::ZERO; 3];
            (weights[i], weights[(i + 1) % 3]) = (start, end);
            weights
        };
        // The nearest point of the edge: the start, or the foot of the perpendicular. At the end the next edge starts.
        let square = dot(&to_point, &to_point);
        let near = if along.sign() == Sign::Negative || along.is_zero() {
            Nearest { weights: on_edge(IBig::ONE, IBig::ZERO), denominator: IBig::ONE, square: square.into() }
        } else if along < length {
            let square = Relaxed::from_parts_signed(square * &length - &along * &along, length.clone());
            Nearest { weights: on_edge(&length - &along, along), denominator: length, square }
        } else {
            continue;
        };
        of_edges = of_edges.into_iter().chain([near]).min_by(|a, b| a.square.cmp(&b.square));
    }
    if inside.iter().any(|weight| weight.sign() == Sign::Negative || weight.is_zero()) {
        return of_edges;
    }
    let height = dot(&normal, &minus(p, a));
    let square = Relaxed::from_parts_signed(&height * &height, area.clone());
    Some(Nearest { weights: inside, denominator: area, square })
}

#[cfg(test)]
mod tests;
