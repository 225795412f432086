//! The nearest point of a triangle, and how far it is.

use dashu_int::ops::{BitTest, DivRem, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, Sign, UBig};
use dashu_ratio::Relaxed;

use super::{Number, RBig, Vector, cross, dot, integers, minus, scale};

/// The square of the distance from a point to a triangle. `None` if a coordinate is not finite.
///
/// The least of the distances to the three edges, and to the plane if the point is above the triangle.
///
/// ```
/// use stackless_bvh::geom::truth::{RBig, square_distance};
///
/// let triangle = [[0.0_f32, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// assert_eq!(square_distance(triangle, [1.0, 1.0, 0.5]), RBig::try_from(0.25).ok());
/// assert_eq!(square_distance(triangle, [-1.0, -2.0, 2.0]), RBig::try_from(9.0).ok());
/// ```
pub fn square_distance<S: Number>(triangle: [[S; 3]; 3], point: [S; 3]) -> Option<RBig> {
    let (Nearest { square, .. }, scale) = nearest(triangle, point)?;
    Some((square / Relaxed::from(&scale * &scale)).canonicalize())
}

/// The point of a triangle that is nearest to a point: there is one, as triangles are convex. `None` if a coordinate is
/// not finite. `[NEAR-3]`
///
/// ```
/// use stackless_bvh::geom::truth::{nearest_point, round_f32};
///
/// let triangle = [[0.0_f32, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
/// let nearest = |point| nearest_point(triangle, point).map(|point| point.each_ref().map(round_f32));
/// assert_eq!(nearest([1.0, 1.0, 0.5]), Some([1.0, 1.0, 0.0]));
/// assert_eq!(nearest([2.0, 2.0, 0.5]), Some([1.5, 1.5, 0.0]));
/// assert_eq!(nearest([f32::NAN, 0.0, 0.0]), None);
/// ```
pub fn nearest_point<S: Number>(triangle: [[S; 3]; 3], point: [S; 3]) -> Option<[RBig; 3]> {
    let (Nearest { numerators, denominator, .. }, scale) = nearest(triangle, point)?;
    let denominator = denominator * scale;
    Some(numerators.map(|numerator| RBig::from_parts_signed(numerator, denominator.clone())))
}

/// The float nearest to the square root of `x`, which must not be negative; of two equally near the one whose last bit
/// is 0.
///
/// ```
/// use stackless_bvh::geom::truth::{RBig, round_root};
///
/// assert_eq!(round_root::<f32>(&RBig::from(2u8)), 2f32.sqrt());
/// assert_eq!(round_root::<f64>(&RBig::from(2u8)), 2f64.sqrt());
/// ```
pub fn round_root<S: Number>(x: &RBig) -> S {
    let square = x.numerator().unsigned_abs();
    // So many bits after the point that the root has more than a double and a middle of two have.
    let places = (2 * ROOT_BITS + x.denominator().bit_len()).saturating_sub(square.bit_len()).div_ceil(2);
    let (whole, rest) = (square << (2 * places)).div_rem(x.denominator());
    let (root, more) = whole.sqrt_rem();
    // An integer and a half stands for all between two integers, where there is neither a float nor a middle of two.
    let is_exact = rest.is_zero() && more.is_zero();
    let twice = (root << 1) + UBig::from(u8::from(!is_exact));
    S::nearest(&RBig::from_parts(twice.into(), UBig::ONE << (places + 1)))
}

/// Bits of a root before it is rounded, at least.
const ROOT_BITS: usize = 64;

/// The nearest point, over one denominator, and the square of its distance.
struct Nearest {
    numerators: Vector,
    denominator: IBig,
    square: Relaxed,
}

/// Of coordinates times a number that makes them integers, and that number.
fn nearest<S: Number>([a, b, c]: [[S; 3]; 3], point: [S; 3]) -> Option<(Nearest, IBig)> {
    let scale = scale([a, b, c, point])?;
    let [a, b, c, p] = integers([a, b, c, point])?;
    let corners = [&a, &b, &c];
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    let area = dot(&normal, &normal);
    let mut of_edges: Option<Nearest> = None;
    let mut is_above = !area.is_zero();
    for i in 0..3 {
        let (edge, to_point) = (minus(corners[(i + 1) % 3], corners[i]), minus(&p, corners[i]));
        let (along, length) = (dot(&edge, &to_point), dot(&edge, &edge));
        is_above &= dot(&cross(&normal, &edge), &to_point).sign() == Sign::Positive;
        // The nearest point of the edge: the start, or the foot of the perpendicular. At the end the next edge starts.
        let square = dot(&to_point, &to_point);
        let near = if along.sign() == Sign::Negative || along.is_zero() {
            Nearest { numerators: corners[i].clone(), denominator: IBig::ONE, square: square.into() }
        } else if along < length {
            let square = Relaxed::from_parts_signed(square * &length - &along * &along, length.clone());
            let numerators = std::array::from_fn(|k| &corners[i][k] * &length + &edge[k] * &along);
            Nearest { numerators, denominator: length, square }
        } else {
            continue;
        };
        of_edges = of_edges.into_iter().chain([near]).min_by(|a, b| a.square.cmp(&b.square));
    }
    if !is_above {
        return of_edges.map(|near| (near, scale));
    }
    let height = dot(&normal, &minus(&p, &a));
    let square = Relaxed::from_parts_signed(&height * &height, area.clone());
    let numerators = std::array::from_fn(|k| &p[k] * &area - &normal[k] * &height);
    Some((Nearest { numerators, denominator: area, square }, scale))
}

#[cfg(test)]
mod tests;
