//! Which of two children that a ray meets comes first (Binder & Keller 2016, Section 2).
//!
//! The order decides how soon a search ends, never what it answers; but for one case of [`FromLeft`].

use std::fmt::Debug;

/// A preference at an inner node.
pub trait ChildOrder: Copy + Debug {
    /// Whether the right child comes first, if the ray meets both. `nears` are the distances at which it enters them.
    fn prefers_right<R: PartialOrd>(nears: [R; 2]) -> bool;

    /// Whether it is the order along the ray.
    const IS_BY_DISTANCE: bool;
}

/// The child that the ray enters first; the left one of equals.
#[derive(Clone, Copy, Debug)]
pub struct Nearest;

/// The left child, which in a new [`Bvh`](crate::bvh::Bvh) is the one of the larger surface: it holds more to be hit.
/// For any-hit queries, and faster than it looks: the processor always knows which node comes next. The closest hit it may
/// miss by [`Laine`](crate::traverse::Laine) over triangles in parts: their hits may lie before the box of their leaf, so
/// that a first child is dropped before the second has been visited. `[LAINE-1]`
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
