//! Exact affine maps, and the images of points, boxes and rays.

mod inverse;

use dashu_int::IBig;

use inverse::Inverse;

use super::fine::Fine;
use super::truth::{Meeting, RBig, meet_integers};
use super::{Aabb, EnclosedRay, EnvironmentError, Frame, Interval, Real, Vector, check_environment};

/// An invertible affine map x -> A x + b, from an object's space to the space around it. It is in single precision, or
/// with `f64` in double precision.
///
/// The numbers are interpreted as exact rational numbers, including subnormal numbers. So the image of a point is
/// exact, and has more digits than a float: only [`image_of_box`](Self::image_of_box) and
/// [`pull_back`](Self::pull_back) round, outwards. `[INST-1]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineMap<R: Real = f32> {
    rows: [[R; 4]; 3],
    /// The inverse of A.
    inverse: Inverse,
}

/// Errors of the constructors of [`AffineMap`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AffineError {
    /// A number is NaN or infinite.
    #[error("row {row}, column {column}: {value}, expected a finite number")]
    NotFinite {
        /// Row, from 0.
        row: usize,
        /// Column, from 0; 3 is the translation.
        column: usize,
        /// The number.
        value: f64,
    },
    /// The determinant of A is 0, exactly: objects would become flat.
    #[error("the determinant is 0, so the map has no inverse")]
    Singular,
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<R: Real> AffineMap<R> {
    /// The identity map.
    pub const IDENTITY: Self = Self {
        rows: [
            [R::ONE, R::ZERO, R::ZERO, R::ZERO],
            [R::ZERO, R::ONE, R::ZERO, R::ZERO],
            [R::ZERO, R::ZERO, R::ONE, R::ZERO],
        ],
        inverse: Inverse::IDENTITY,
    };

    /// Creates the map with these rows: three numbers of A, then one of b.
    ///
    /// Integer arithmetic decides that the determinant is not 0: neither tiny nor huge numbers under- or overflow.
    ///
    /// # Errors
    /// [`AffineError`].
    ///
    /// ```
    /// use stackless_bvh::geom::{AffineMap, AffineError};
    ///
    /// let tiny = f32::from_bits(1);
    /// assert!(AffineMap::new([[tiny, 0.0, 0.0, 1.0], [0.0, tiny, 0.0, 2.0], [0.0, 0.0, tiny, 3.0]]).is_ok());
    /// let flat = AffineMap::new([[0.1, 0.2, 0.0, 0.0], [0.1, 0.2, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    /// assert_eq!(flat, Err(AffineError::Singular));
    /// ```
    pub fn new(rows: [[R; 4]; 3]) -> Result<Self, AffineError> {
        check_environment()?;
        for (row, numbers) in rows.iter().enumerate() {
            for (column, &x) in numbers.iter().enumerate() {
                let value: f64 = x.into();
                if !value.is_finite() {
                    return Err(AffineError::NotFinite { row, column, value });
                }
            }
        }
        let unit = unit_of(rows.as_flattened());
        let (adjugate, determinant) = adjugate(&rows.map(|row| row.map(|x| multiple(x, unit))));
        if determinant.is_zero() {
            return Err(AffineError::Singular);
        }
        let entry = |x: IBig| RBig::from_parts_signed(x << unit, determinant.clone());
        Ok(Self { rows, inverse: Inverse::new(&adjugate.map(|row| row.map(entry))) })
    }

    /// Creates the map that adds a vector.
    ///
    /// # Errors
    /// [`AffineError::NotFinite`] and [`AffineError::Environment`].
    pub fn translation(by: impl Vector<Real = R>) -> Result<Self, AffineError> {
        let mut rows = Self::IDENTITY.rows;
        for (row, by) in rows.iter_mut().zip(by.components()) {
            row[3] = by;
        }
        Self::new(rows)
    }

    /// Returns three numbers of A, then one of b, for each row.
    pub const fn rows(&self) -> &[[R; 4]; 3] {
        &self.rows
    }

    /// Returns the smallest box in single precision that contains the image of a box, up to a few units in the last
    /// place of doubles. It is never too small, and infinite beyond the range of single precision. `[INST-2]`
    pub fn image_of_box(&self, aabb: &Aabb) -> Aabb {
        Frame::IDENTITY.enter(&self.image(Frame::IDENTITY.leave(aabb)))
    }

    /// Returns bounds of the image of all points whose coordinates are within bounds. `[INST-2]`
    pub(crate) fn image(&self, bounds: [Interval; 3]) -> [Interval; 3] {
        self.rows.map(|[a, b, c, offset]| {
            let [x, y, z] = [(a, bounds[0]), (b, bounds[1]), (c, bounds[2])].map(|(a, x)| times(a.into(), x));
            x + y + z + Interval::exact(offset.into())
        })
    }

    /// Returns the ray in the object's space: bounds of A^-1 (o - b) and A^-1 d for all o and d within the bounds.
    /// Distances along it are the same in every space. `[INST-3]`
    pub fn pull_back(&self, ray: &EnclosedRay) -> EnclosedRay {
        self.inverse.pull_back(ray, self.rows.map(|row| row[3].into()))
    }

    /// Returns a line in the object's space, as integers over a common number, from a line in this form. `[INST-7]`
    pub(super) fn pull_back_exactly(&self, ([o, d], over): ([[IBig; 3]; 2], IBig)) -> ([[IBig; 3]; 2], IBig) {
        let unit = unit_of(self.rows.as_flattened());
        let rows = self.rows.map(|row| row.map(|x| multiple(x, unit)));
        let (adjugate, determinant) = adjugate(&rows);
        let way = [0, 1, 2].map(|k| (&o[k] << unit) - &rows[k][3] * &over);
        let by = |v: &[IBig; 3]| adjugate.each_ref().map(|[x, y, z]| x * &v[0] + y * &v[1] + z * &v[2]);
        ([by(&way), by(&d.map(|x| x << unit))], over * determinant)
    }
}

/// Returns the adjugate of A, and its determinant.
fn adjugate(a: &[[IBig; 4]; 3]) -> ([[IBig; 3]; 3], IBig) {
    let adjugate = [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let ([p, q], [r, s]) = ([(j + 1) % 3, (j + 2) % 3], [(i + 1) % 3, (i + 2) % 3]);
            &a[p][r] * &a[q][s] - &a[p][s] * &a[q][r]
        })
    });
    let determinant = (0..3).map(|i| &a[0][i] * &adjugate[i][0]).fold(IBig::ZERO, |sum, x| sum + x);
    (adjugate, determinant)
}

/// Returns the products of a number and an interval. An end stays exact if its product is: a product of two floats of
/// single precision has 48 bits.
fn times(a: f64, x: Interval) -> Interval {
    let [first, last] = x.ends().map(|x| (Interval::exact(a) * Interval::exact(x)).ends());
    Interval::between([first[0].min(last[0]), first[1].max(last[1])])
}

/// Intersects the line `origin + t direction` with the exact image of a triangle under maps; the first map is applied
/// first. It is the ground truth about instances, at the speed of rational arithmetic. `[INST-1]`
///
/// ```
/// use stackless_bvh::geom::AffineMap;
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::internals::geom::meet_image;
/// use stackless_bvh::internals::geom::truth::{Meeting, RBig};
///
/// let third = AffineMap::new([[3.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.1, -1.0]])?;
/// let Meeting::Hit(point) = meet_image([Vec3::ZERO, Vec3::X, Vec3::Y], &[third], Vec3::X, Vec3::NEG_Z) else {
///     return Err("a miss".into());
/// };
/// assert_eq!((point.t, point.u), (RBig::ONE, RBig::from_parts(1.into(), 3u8.into())));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn meet_image<'a, V: Vector>(
    triangle: [V; 3],
    maps: impl IntoIterator<Item = &'a AffineMap<V::Real>>,
    origin: V,
    direction: V,
) -> Meeting {
    let line = [origin, direction].map(Vector::components);
    let ((corners, unit), unit_of_line) = (images(triangle, maps), unit_of(line.as_flattened()));
    let common = unit.max(unit_of_line);
    let [v0, v1, v2] = corners.map(|corner| corner.map(|x| x << (common - unit)));
    let [o, d] = line.map(|v| v.map(|x| multiple(x, unit_of_line) << (common - unit_of_line)));
    meet_integers([v0, v1, v2, o, d])
}

/// Returns the images of corners, as integers times 2 to the power of minus the second number, with the least possible
/// number of digits.
pub(super) fn images<'a, V: Vector>(
    triangle: [V; 3],
    maps: impl IntoIterator<Item = &'a AffineMap<V::Real>>,
) -> ([[IBig; 3]; 3], usize) {
    let corners = triangle.map(Vector::components);
    let mut unit = unit_of(corners.as_flattened());
    let mut corners = corners.map(|corner| corner.map(|x| multiple(x, unit)));
    for map in maps {
        // Computed on the calling thread, so no number has digits below its own unit. `[ENV-1]`
        let own = unit_of(map.rows.as_flattened());
        let rows = map.rows.map(|row| row.map(|x| multiple(x, own)));
        corners = corners
            .map(|[x, y, z]| rows.each_ref().map(|[a, b, c, offset]| a * &x + b * &y + c * &z + (offset << unit)));
        unit += own;
    }
    (corners, unit)
}

/// Returns a point as integers, in this form.
pub(super) fn whole_point<V: Vector>(point: V) -> ([IBig; 3], usize) {
    let point = point.components();
    let unit = unit_of(&point);
    (point.map(|x| multiple(x, unit)), unit)
}

/// Returns the images of corners, by twice the digits of a double. `[INST-5]`
pub(super) fn fine_images<'a, V: Vector>(
    triangle: [V; 3],
    maps: impl IntoIterator<Item = &'a AffineMap<V::Real>>,
) -> [[Fine; 3]; 3] {
    let mut corners = triangle.map(|corner| corner.widen().to_array().map(Fine::exact));
    for map in maps {
        let rows = map.rows.map(|row| row.map(|x| Fine::exact(x.into())));
        corners = corners.map(|[x, y, z]| rows.map(|[a, b, c, offset]| a * x + b * y + c * z + offset));
    }
    corners
}

/// Returns a number such that all of these floats are multiples of 2 to the power of minus it. It is at most 149 in
/// single precision and 1074 in double precision.
fn unit_of<R: Real>(numbers: &[R]) -> usize {
    numbers.iter().map(|&x| (-odd_and_exponent(x.into()).1).max(0) as usize).max().unwrap_or(0)
}

/// Returns a float times 2 to the power of its unit, or of a greater number.
fn multiple<R: Real>(x: R, unit: usize) -> IBig {
    let (odd, exponent) = odd_and_exponent(x.into());
    IBig::from(odd) << (unit as i32 + exponent) as usize
}

/// Returns a finite double as an odd number and a power of two; 0 as 0 times 1.
fn odd_and_exponent(x: f64) -> (i64, i32) {
    let (exponent, fraction) = ((x.to_bits() >> 52 & 0x7ff) as i32, (x.to_bits() & ((1 << 52) - 1)) as i64);
    // Subnormal numbers have the exponent of the least normal numbers, and no leading one.
    let (whole, exponent) = if exponent == 0 { (fraction, 1) } else { (fraction | 1 << 52, exponent) };
    if whole == 0 {
        return (0, 0);
    }
    let zeros = whole.trailing_zeros();
    let odd = whole >> zeros;
    (if x.is_sign_negative() { -odd } else { odd }, exponent - 1075 + zeros as i32)
}

#[cfg(test)]
mod tests;
