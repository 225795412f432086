//! Triangle tests: the intersection of a ray and a triangle.
//!
//! [`Exact`] gives the answer of rational arithmetic. The other tests are common in renderers, and leak or err; `lab
//! accuracy` measures their errors.

#[cfg(any(test, feature = "internals"))]
mod affine;
mod bounds;
mod exact;
#[cfg(any(test, feature = "internals"))]
mod moller;
#[cfg(any(test, feature = "internals"))]
mod woop;

#[cfg(any(test, feature = "internals"))]
pub use affine::{Affine, AffineTriangle};
pub use bounds::{DETERMINANT, DISTANCE, EDGE, OFF, OFF_SIGN, QUOTIENT, QUOTIENT_FACTOR, SIGN};
pub(crate) use exact::order_of_lines;
pub use exact::{
    Accumulator, Certainty, EnclosedTest, Exact, Exact64, ExactFromSingle, MAX_COORDINATE, MIN_EDGE, Parity,
};
pub(super) use exact::{Corrected, ExactOnce, FineDeterminants, Met, USUAL, is_degenerate, two_product, two_sum};
#[cfg(any(test, feature = "internals"))]
pub use moller::{Moller32, Moller64};
#[cfg(any(test, feature = "internals"))]
pub use woop::Woop;

use std::cmp::Ordering;
use std::fmt::Debug;

use super::{Ray, Real as _, Region, Vector};

/// A triangle test, prepared for a ray.
pub trait Kernel: Copy + Debug {
    /// Positions and directions of the rays.
    type Vector: Vector;
    /// The test's form of a triangle, or any other shape that rays can meet. Of equal shapes, a search may test only
    /// one.
    type Shape: Copy + Debug + PartialEq + Send + Sync;
    /// The filter that rejects shapes, four at once, before they are tested one by one: `()` rejects none.
    type Filter: Filter<Self::Vector, Self::Shape>;

    /// Prepares a ray. `region` must contain all triangles of the tests.
    fn new(ray: &Ray<Self::Vector>, region: &Region) -> Self;

    /// Returns the distance along the ray, in units of the length of its direction, at which it meets the triangle:
    /// from either side, including edges, corners and both ends of the ray's interval. Degenerate triangles and those
    /// that the ray sees edge-on are missed.
    ///
    /// It may omit a hit that is farther than `limit`.
    fn distance(&self, shape: &Self::Shape, limit: Real<Self>) -> Option<Real<Self>>;

    /// Returns whether the ray meets the triangle within its interval, without the [`distance`](Self::distance).
    #[inline]
    fn blocks(&self, shape: &Self::Shape) -> bool {
        self.distance(shape, Real::<Self>::INFINITY).is_some()
    }

    /// Compares the unrounded distances of two shapes that the ray meets at one [`distance`](Self::distance). Equal if
    /// the test cannot decide, as for inexact tests. `[EXACT-13]`
    fn compare(&self, _shape: &Self::Shape, _other: &Self::Shape) -> Ordering {
        Ordering::Equal
    }

    /// Compares the unrounded distance of a shape that the ray meets at `t` with `t` itself. Equal if the test cannot
    /// decide.
    fn compare_with(&self, _shape: &Self::Shape, _t: Real<Self>) -> Ordering {
        Ordering::Equal
    }

    /// Orders two hits at one [`distance`](Self::distance), each a shape and its index: by the unrounded distance, then
    /// by index. `[EXACT-13]`
    #[cold]
    #[inline(never)]
    fn order(&self, (shape, prim): (&Self::Shape, u32), (other, next): (&Self::Shape, u32)) -> Ordering {
        self.compare(shape, other).then(prim.cmp(&next))
    }

    /// Returns the stage that decides a triangle's distance, if only the ray's end limits it: a nearer limit may avoid
    /// stages, and [`blocks`](Self::blocks) needs the later ones less often. For statistics.
    fn stage(&self, _: &Self::Shape) -> Stage {
        Stage::Scene
    }

    /// Returns the weights of the second and of the third corner in the point where the ray's line meets the triangle,
    /// which it must.
    fn weights(&self, shape: &Self::Shape) -> [Real<Self>; 2];
}

/// A test of four shapes at once in a leaf: it rejects most shapes that a ray misses, and none that it hits.
pub trait Filter<V: Vector, S>: Copy + Debug {
    /// Whether it rejects anything. If not, it is not called.
    const REJECTS: bool = true;

    /// Prepares a ray. `region` must contain all shapes of the tests.
    fn new(ray: &Ray<V>, region: &Region) -> Self;

    /// Returns the shapes that are not rejected: bit `i` is set if the ray may hit shape `i` at or before `limit`,
    /// which is not negative.
    fn survivors(&self, shapes: [&S; 4], limit: V::Real) -> u32;
}

impl<V: Vector, S> Filter<V, S> for () {
    const REJECTS: bool = false;

    fn new(_: &Ray<V>, _: &Region) -> Self {}

    fn survivors(&self, _: [&S; 4], _: V::Real) -> u32 {
        0b1111
    }
}

/// The stage that decides a ray and a triangle. Inexact tests have one stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Error bounds for all triangles of the scene.
    Scene,
    /// Error bounds for this triangle.
    Triangle,
    /// Exact sums.
    Sums,
}

/// The type of a kernel's numbers.
pub type Real<K> = <<K as Kernel>::Vector as Vector>::Real;
