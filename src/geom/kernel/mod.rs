//! Triangle tests: whether a ray meets a triangle, and where.
//!
//! [`Exact`] gives the answer of rational arithmetic. The others are what renderers use, and leak or err in ways that
//! `lab accuracy` measures.

mod affine;
mod bounds;
mod exact;
mod moller;
mod woop;

pub use affine::{Affine, AffineTriangle};
pub use bounds::{DETERMINANT, DISTANCE, EDGE, OFF, OFF_SIGN, QUOTIENT, QUOTIENT_FACTOR, SIGN};
pub(crate) use exact::order_of_lines;
pub use exact::{
    Accumulator, Certainty, EnclosedTest, Exact, Exact64, ExactFromSingle, MAX_COORDINATE, MIN_EDGE, Parity,
};
pub(super) use exact::{Corrected, ExactOnce, FineDeterminants, USUAL, is_degenerate, two_product, two_sum};
pub use moller::{Moller32, Moller64};
pub use woop::Woop;

use std::cmp::Ordering;
use std::fmt::Debug;

use super::{Ray, Real as _, Region, Vector};

/// A triangle test, and what it keeps of a ray.
pub trait Kernel: Copy + Debug {
    /// Positions and directions of the rays.
    type Vector: Vector;
    /// A triangle as the test wants it, or any other shape that rays can meet. Of shapes that are equal, one may be asked
    /// for all.
    type Shape: Copy + Debug + PartialEq + Send + Sync;
    /// What rejects shapes, four at once, before they are tested one by one: `()` rejects none.
    type Filter: Filter<Self::Vector, Self::Shape>;

    /// Prepares a ray. `region` must hold all triangles that it is asked about.
    fn new(ray: &Ray<Self::Vector>, region: &Region) -> Self;

    /// Distance along the ray, in lengths of its direction, at which it meets the triangle: from either side, edges and
    /// corners and both ends of the ray's interval included. Degenerate triangles and those that the ray sees edge-on
    /// are missed.
    ///
    /// A hit that is farther than `limit` may be left out.
    fn distance(&self, shape: &Self::Shape, limit: Real<Self>) -> Option<Real<Self>>;

    /// Whether the ray meets the triangle at all within its interval: [`distance`](Self::distance) without it.
    #[inline]
    fn blocks(&self, shape: &Self::Shape) -> bool {
        self.distance(shape, Real::<Self>::INFINITY).is_some()
    }

    /// Compares the distances of two shapes, both of which the ray meets at one [`distance`](Self::distance): by what that
    /// was rounded from. Equal if the test knows no more, as tests that are not exact. `[EXACT-13]`
    fn compare(&self, _shape: &Self::Shape, _other: &Self::Shape) -> Ordering {
        Ordering::Equal
    }

    /// Compares the distance of a shape that the ray meets at `t` with `t` itself, likewise.
    fn compare_with(&self, _shape: &Self::Shape, _t: Real<Self>) -> Ordering {
        Ordering::Equal
    }

    /// The order of two hits at one [`distance`](Self::distance), each a shape and its index: by what the distance was
    /// rounded from, then by index. `[EXACT-13]`
    #[cold]
    #[inline(never)]
    fn order(&self, (shape, prim): (&Self::Shape, u32), (other, next): (&Self::Shape, u32)) -> Ordering {
        self.compare(shape, other).then(prim.cmp(&next))
    }

    /// The stage that decides about a triangle, if the distance is asked for and nothing is known but the ray's end: a
    /// nearer limit may spare stages, and [`blocks`](Self::blocks) needs the later ones less often. For statistics.
    fn stage(&self, _: &Self::Shape) -> Stage {
        Stage::Scene
    }

    /// Weights of the second and of the third corner in the point where the ray's line meets the triangle, which it
    /// must.
    fn weights(&self, shape: &Self::Shape) -> [Real<Self>; 2];
}

/// A test of four shapes at once, for a search that comes to a leaf: it rejects most of those that a ray misses, and none
/// that it hits.
pub trait Filter<V: Vector, S>: Copy + Debug {
    /// Whether it rejects anything. If not, it is not asked.
    const REJECTS: bool = true;

    /// Prepares a ray. `region` must hold all shapes that it is asked about.
    fn new(ray: &Ray<V>, region: &Region) -> Self;

    /// Those that are not rejected: bit `i` is set if the ray may hit shape `i` at `limit`, which is not negative, or
    /// before.
    fn survivors(&self, shapes: [&S; 4], limit: V::Real) -> u32;
}

impl<V: Vector, S> Filter<V, S> for () {
    const REJECTS: bool = false;

    fn new(_: &Ray<V>, _: &Region) -> Self {}

    fn survivors(&self, _: [&S; 4], _: V::Real) -> u32 {
        0b1111
    }
}

/// What it takes to decide about a ray and a triangle. Tests that are not exact have one stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Error bounds for all triangles of the scene.
    Scene,
    /// Error bounds for this triangle.
    Triangle,
    /// Exact sums.
    Sums,
}

/// The numbers that a kernel takes and gives.
pub type Real<K> = <<K as Kernel>::Vector as Vector>::Real;
