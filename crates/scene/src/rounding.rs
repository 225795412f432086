//! Rounding of the numbers of a file.

use stackless_bvh::geom::{Mesh, Ray};

use super::float::{Float, Position};
use super::number::Number;

/// Counts of the rounded numbers of a file, with bounds of their errors.
///
/// The numbers are coordinates of vertices, or components of rays. A decimal such as 0.1 is also rounded, because no
/// float equals it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounding {
    /// Numbers read.
    pub numbers: u64,
    /// Numbers that the precision cannot represent.
    pub rounded: u64,
    /// Greatest error of a coordinate.
    pub moved: f64,
    /// Greatest relative error of a ray's direction, or of an end of its interval.
    pub turned: f64,
}

impl Rounding {
    /// Returns a bound of the error of a point, as a fraction of the scene's [`size`]. The point is a vertex, or a
    /// point of a ray at a distance of `size` from its origin.
    pub fn share(&self, size: f64) -> f64 {
        self.turned.max(if self.moved == 0.0 { 0.0 } else { self.moved / size })
    }

    /// Returns the note about rounded numbers, if there are any.
    pub(crate) fn note<F: Float>(&self, size: f64) -> Option<String> {
        let Self { numbers, rounded, moved, .. } = *self;
        let were = if rounded == 1 { "was" } else { "were" };
        let most = match self.share(size) {
            share if share.is_finite() => format!("{} of the scene's size", above(share)),
            _ => above(moved),
        };
        let precision = F::PRECISION;
        (rounded > 0).then(|| {
            format!("{rounded} of {numbers} numbers {were} rounded to {precision} precision, by at most {most}")
        })
    }

    /// Counts a coordinate and returns its value.
    #[inline]
    pub(crate) fn coordinate<F: Float>(&mut self, number: Number<F>) -> F {
        self.moved = self.moved.max(number.error);
        self.count(number)
    }

    /// Counts the numbers of a ray, with or without its interval.
    pub(crate) fn ray<V: Position>(&mut self, numbers: &[Number<V::Real>], ray: &Ray<V>) {
        let [x, y, z] = ray.direction().widen().to_array();
        for (i, &number) in numbers.iter().enumerate() {
            if i < 3 {
                self.coordinate(number);
                continue;
            }
            let length = if i < 6 { x.hypot(y).hypot(z) } else { number.value.into() };
            if number.error > 0.0 {
                self.turned = self.turned.max(number.error / (length + number.error));
            }
            self.count(number);
        }
    }

    #[inline]
    fn count<F: Float>(&mut self, number: Number<F>) -> F {
        self.numbers += 1;
        self.rounded += u64::from(number.error > 0.0);
        number.value
    }
}

/// Returns the size of a mesh: the diagonal of the bounds of its vertices.
pub fn size<V: Position>(mesh: &Mesh<V>) -> f64 {
    let mut vertices = mesh.vertices().iter().map(|vertex| vertex.widen());
    let first = vertices.next().unwrap_or_default();
    let (least, most) = vertices.fold((first, first), |(least, most), vertex| (least.min(vertex), most.max(vertex)));
    // A quarter of the diagonal cannot overflow.
    let [x, y, z] = (most / 4.0 - least / 4.0).to_array();
    (4.0 * x.hypot(y).hypot(z)).min(f64::MAX)
}

/// Formats a number with two digits, rounded up.
fn above(number: f64) -> String {
    let number = number.max(f64::from_bits(1));
    let nearest = format!("{number:.1e}");
    let half = 0.05 * 10_f64.powf(number.log10().floor());
    if nearest.parse().is_ok_and(|nearest: f64| nearest >= number) { nearest } else { format!("{:.1e}", number + half) }
}

#[cfg(test)]
mod tests;
