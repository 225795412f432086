//! Orders of two children that a ray meets (Binder & Keller 2016, Section 2).
//!
//! The order determines how early a search ends, never its answer, with one exception: see [`FromLeft`].

use std::fmt::Debug;

/// A preference at an inner node.
pub trait ChildOrder: Copy + Debug {
    /// Returns whether the right child comes first, if the ray meets both children. `nears` are the distances at which
    /// it enters them.
    fn prefers_right<R: PartialOrd>(nears: [R; 2]) -> bool;

    /// Whether it is the order along the ray.
    const IS_BY_DISTANCE: bool;
}

/// The child that the ray enters first; the left child of equal distances.
#[derive(Clone, Copy, Debug)]
pub struct Nearest;

/// The left child, which in a new [`Bvh`](crate::bvh::Bvh) has the larger surface: it contains more hits. For any-hit
/// queries. It is fast because the processor always knows the next node. With [`Laine`](crate::traverse::Laine) over
/// triangles in parts, it may miss the closest hit: a hit may lie before the box of its leaf, so that a first child is
/// dropped before the second has been visited. `[LAINE-1]`
#[derive(Clone, Copy, Debug)]
pub struct FromLeft;

impl ChildOrder for Nearest {
    const IS_BY_DISTANCE: bool = true;

    #[inline(always)]
    fn prefers_right<R: PartialOrd>([left, right]: [R; 2]) -> bool {
        right < left
    }
}

impl ChildOrder for FromLeft {
    const IS_BY_DISTANCE: bool = false;

    #[inline(always)]
    fn prefers_right<R: PartialOrd>(_: [R; 2]) -> bool {
        false
    }
}
