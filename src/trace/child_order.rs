//! Which of two children that a ray meets comes first (Binder & Keller 2016, Section 2).
//!
//! The order decides how soon a search ends, never what it answers.

use std::fmt::Debug;

/// A preference at an inner node, from what the box test has at hand.
pub trait ChildOrder: Copy + Debug {
    /// Whether the right child comes first, if the ray meets both. `planes` are those of the
    /// [node](crate::bvh::BvhNode::planes), `nears` the distances at which the ray enters the children.
    fn prefers_right<R: PartialOrd>(planes: &[[f32; 4]; 3], nears: [R; 2]) -> bool;
}

/// The child that the ray enters first; the left one of equals.
#[derive(Clone, Copy, Debug)]
pub struct Nearest;

/// The child of the larger surface; the left one of equals. For any-hit queries: it holds more to be hit.
#[derive(Clone, Copy, Debug)]
pub struct Largest;

/// The left child.
#[derive(Clone, Copy, Debug)]
pub struct FromLeft;

impl ChildOrder for Nearest {
    #[inline(always)]
    fn prefers_right<R: PartialOrd>(_: &[[f32; 4]; 3], [left, right]: [R; 2]) -> bool {
        right < left
    }
}

impl ChildOrder for Largest {
    #[inline(always)]
    fn prefers_right<R: PartialOrd>(planes: &[[f32; 4]; 3], _: [R; 2]) -> bool {
        let half_area = |lo: usize| {
            let [x, y, z] = planes.map(|axis| axis[lo + 1] - axis[lo]);
            (x + y) * z + x * y
        };
        half_area(2) > half_area(0)
    }
}

impl ChildOrder for FromLeft {
    #[inline(always)]
    fn prefers_right<R: PartialOrd>(_: &[[f32; 4]; 3], _: [R; 2]) -> bool {
        false
    }
}
