//! The images of boxes and triangles under nested maps: within bounds, and exactly.

use std::array;

use dashu_int::IBig;
use glam::DVec3;

use super::affine::{images, whole_point};
use super::nearest::{bounds, length_of};
use super::truth::{Number, Relaxed, nearest_of_integers, round_root_of};
use super::{AffineMap, Interval, Real, Triangle, Vector};

/// The composition of maps, within bounds. `[INST-9]`
#[derive(Clone, Copy, Debug)]
pub(crate) struct EnclosedMap([[Interval; 4]; 3]);

impl EnclosedMap {
    /// Creates the identity map.
    pub(crate) fn identity() -> Self {
        let row = |i: usize| array::from_fn(|j| Interval::exact(if i == j { 1.0 } else { 0.0 }));
        Self(array::from_fn(row))
    }

    /// Returns the map that applies another map first.
    pub(crate) fn after<R: Real>(&self, inner: &AffineMap<R>) -> Self {
        Self(self.0.map(|[x, y, z, offset]| {
            let column = |j: usize| {
                let [a, b, c] = inner.rows().map(|row| Interval::exact(row[j].into()));
                x * a + y * b + z * c
            };
            [column(0), column(1), column(2), column(3) + offset]
        }))
    }

    /// Returns bounds of the images of all points within bounds.
    pub(crate) fn image(&self, [x, y, z]: [Interval; 3]) -> [Interval; 3] {
        self.0.map(|[a, b, c, offset]| a * x + b * y + c * z + offset)
    }

    /// Returns bounds of the distance from a point to the image of a triangle.
    pub(crate) fn distance<V: Vector>(&self, triangle: &Triangle<V>, point: DVec3) -> [f64; 2] {
        let corners = triangle.0.map(|corner| self.image(corner.widen().to_array().map(Interval::exact)));
        let relative = corners.map(|corner| array::from_fn(|k| corner[k] - Interval::exact(point[k])));
        let [a, b, c] = relative.each_ref().map(Interval::middles);
        let [near, far] = bounds(&[a.0, b.0, c.0]);
        // Each point of the triangle moves by at most the square root of 3 times this.
        let off = a.1.max(b.1).max(c.1) * 1.75;
        let hull = array::from_fn(|k| {
            let ends = corners.map(|corner| corner[k].ends());
            Interval::between([0, 1].map(|end| {
                let [a, b, c] = ends.map(|ends| ends[end]);
                if end == 0 { a.min(b).min(c) } else { a.max(b).max(c) }
            }))
        });
        // A NaN is no bound.
        let near = (near - off).next_down().max(to_box(&hull, point));
        let far = relative.iter().map(greatest_length).fold((far + off).next_up(), f64::min);
        [near, far]
    }
}

/// Returns a lower bound of the distance from a point to all points within bounds.
pub(crate) fn to_box(bounds: &[Interval; 3], point: DVec3) -> f64 {
    let [lo, hi] = [0, 1].map(|end| DVec3::from(bounds.map(|bounds| bounds.ends()[end])));
    length_of(lo - point, point - hi)
}

/// Returns an upper bound of the length of a vector: the sum of its components' magnitudes.
fn greatest_length(vector: &[Interval; 3]) -> f64 {
    let magnitude = |x: &Interval| x.ends().map(f64::abs).into_iter().fold(0.0, f64::max);
    vector.iter().fold(0.0, |sum: f64, x| (sum + magnitude(x)).next_up())
}

/// Returns the distance from a point to the image of a triangle under maps, the first map applied first, and the
/// nearest point. Each number is rounded once. `None` if the distance is greater than the radius. `[INST-9]`
pub(crate) fn nearest_of_image<V: Vector>(
    triangle: &Triangle<V>,
    maps: &[AffineMap<V::Real>],
    point: V,
    radius: V::Real,
) -> Option<(V::Real, V)> {
    let ((corners, unit), (point, own)) = (images(triangle.0, maps), whole_point(point));
    let common = unit.max(own);
    let corners = corners.map(|corner| corner.map(|x| x << (common - unit)));
    let point = point.map(|x| x << (common - own));
    let (square, nearest) = nearest_of_integers(&corners, &point, &(IBig::ONE << common));
    // An infinite radius is not a rational number.
    let is_within = Relaxed::try_from(radius.into()).map_or(true, |radius| square <= &radius * &radius);
    let coordinate = |x: &Relaxed| V::Real::rounded(V::Real::nearest_to(x).into() + 0.0);
    is_within.then(|| (round_root_of(&square), V::from_components(nearest.each_ref().map(coordinate))))
}
