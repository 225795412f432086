//! The point of a Bézier curve that is closest to another point, with a distance that is proved.
//!
//! Barringer & Akenine-Möller (2013) name interval arithmetic over an implicit tree as another use of traversal in
//! constant state. Here is one. The halves of the parameter interval `[0, 1]`, their halves, and so on, are a complete
//! binary tree of which nothing is stored: a node's key says which interval it is. Each visit bounds the distance of
//! two halves and goes on with the nearer one; a half that cannot hold anything better than what is known is left out.
//! The traversals are those of all other trees, and nothing in them knows about curves.
//!
//! # Two levels
//!
//! Parameters are multiples of 2^-52, so the tree is 52 levels deep, and addresses of nodes have 31 bits. So it is two
//! trees of 26 levels each: a leaf of the upper one is the root of a lower one, as an instance is in a scene. Depth
//! first, the leaf's whole subtree comes before what is postponed above it; so the order is that of one tree of 52
//! levels.
//!
//! # What is proved
//!
//! All arithmetic is in intervals that are rounded outwards, so that [`Closest::distance`] holds the true least
//! distance whatever happens: budgets that run out, cusps, rounding. `[CURVE-1]`

#![forbid(unsafe_code)]

mod bezier;
mod dyadic;
mod family;
mod interval;
mod search;

pub use bezier::Bezier;
pub use family::Family;
pub use search::{Closest, End, Options};

use stackless_bvh::traverse::Method;

/// Why numbers are not a curve or not a search.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// The number of control points is not 2 to 9.
    #[error("{0} control points, not 2 to {max}", max = Bezier::<2>::MAX_DEGREE + 1)]
    Degree(usize),
    /// A coordinate of a control point, by its index, is NaN or beyond [`Bezier::GREATEST`].
    #[error("control point {index}: coordinate {coordinate:e} is not a number or too great")]
    ControlPoint {
        /// Index of the control point.
        index: usize,
        /// The coordinate.
        coordinate: f64,
    },
    /// A coordinate of the point is NaN or beyond [`Bezier::GREATEST`].
    #[error("the point's coordinate {0:e} is not a number or too great")]
    Point(f64),
    /// The tolerance is negative or NaN.
    #[error("tolerance {0} is negative or not a number")]
    Tolerance(f64),
    /// The traversal needs a table of all nodes, or asks about nodes again: `laine-*`, `skip`, `skip-octant`,
    /// `glassner`.
    #[error("{0} does not run on a tree that is not stored")]
    Method(Method),
}

#[cfg(test)]
mod tests;
