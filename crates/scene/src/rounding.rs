//! What rounding did to the numbers of a file.

use stackless_bvh::geom::{Mesh, Ray};

use super::float::{Float, Position};
use super::number::Number;

/// How many numbers of a file were rounded, and by how much.
///
/// Numbers are coordinates of vertices, or those of rays. A decimal such as 0.1 is rounded too: no float is that number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounding {
    /// How many numbers were read.
    pub numbers: u64,
    /// How many of them the precision does not have.
    pub rounded: u64,
    /// At most how far a coordinate was moved.
    pub moved: f64,
    /// At most how far a ray's direction was turned, or an end of its interval moved, as a part of it.
    pub turned: f64,
}

impl Rounding {
    /// At most how far a point is moved, in sizes of a scene: a vertex, or a point of a ray as far from its origin as
    /// the scene is large. `size` is the scene's [`size`].
    pub fn share(&self, size: f64) -> f64 {
        self.turned.max(if self.moved == 0.0 { 0.0 } else { self.moved / size })
    }

    /// Returns the note about it, if a number was rounded.
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

    /// Takes the value of a coordinate.
    #[inline]
    pub(crate) fn coordinate<F: Float>(&mut self, number: Number<F>) -> F {
        self.moved = self.moved.max(number.error);
        self.count(number)
    }

    /// Counts the numbers that became a ray: all of them, or those without its interval.
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

/// The size of a mesh: the diagonal of the box around its vertices.
pub fn size<V: Position>(mesh: &Mesh<V>) -> f64 {
    let mut vertices = mesh.vertices().iter().map(|vertex| vertex.widen());
    let first = vertices.next().unwrap_or_default();
    let (least, most) = vertices.fold((first, first), |(least, most), vertex| (least.min(vertex), most.max(vertex)));
    // A quarter of it is in range.
    let [x, y, z] = (most / 4.0 - least / 4.0).to_array();
    (4.0 * x.hypot(y).hypot(z)).min(f64::MAX)
}

/// Two digits of a number, rounded up.
fn above(number: f64) -> String {
    let number = number.max(f64::from_bits(1));
    let nearest = format!("{number:.1e}");
    let half = 0.05 * 10_f64.powf(number.log10().floor());
    if nearest.parse().is_ok_and(|nearest: f64| nearest >= number) { nearest } else { format!("{:.1e}", number + half) }
}

#[cfg(test)]
mod tests;
