//! The surface area heuristic, evaluated at the borders of bins.
//!
//! Wald 2007, "On fast construction of SAH-based bounding volume hierarchies": centroids are counted in bins of
//! equal width along each axis; the cheapest border between two bins is where the node is cut.

use super::BuildError;
use super::bins::Plane;
use super::draft::Draft;
use super::item::{Extents, Item};
use super::sweep::{self, Sweep};
use super::top_down::{self, Cut, halve};

/// What the builder by surface area may choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SahOptions {
    /// Bins per axis, 2 to [`MAX_BINS`](Self::MAX_BINS).
    pub bins: u32,
    /// Triangles that a leaf may hold, at least 1. Where fewer are cheaper, leaves are smaller.
    pub max_leaf: u32,
    /// Greatest depth, in edges. It is always kept.
    pub depth_limit: u32,
}

impl SahOptions {
    /// Greatest number of bins.
    pub const MAX_BINS: u32 = 64;
}

impl Default for SahOptions {
    /// 32 bins, leaves of up to 4, and the depth that a 32-bit key carries.
    fn default() -> Self {
        Self { bins: 32, max_leaf: 4, depth_limit: 31 }
    }
}

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    options.check(items.len())?;
    let cut = |range: &mut [Item], extents: &Extents, depth: u32| options.cut(range, extents, depth);
    Ok(top_down::build(items, cut, progress))
}

impl SahOptions {
    /// Whether so many items fit.
    pub(super) fn check(&self, triangles: usize) -> Result<(), BuildError> {
        let Self { max_leaf, depth_limit: limit, .. } = *self;
        let fits = triangles <= capacity(max_leaf, limit);
        if fits { Ok(()) } else { Err(BuildError::DepthLimit { triangles, max_leaf, limit }) }
    }

    /// Cuts a range by its cheapest plane, or where that is not to be, by its middle; `None` for a leaf.
    pub(super) fn cut(&self, range: &mut [Item], extents: &Extents, depth: u32) -> Option<Cut> {
        let n = range.len();
        let levels = self.depth_limit - depth;
        let may_be_leaf = n <= self.max_leaf as usize;
        if n == 1 || levels == 0 || may_be_leaf && n as f32 <= NODE_COST {
            return None;
        }
        let choice = Choice { range, extents, may_be_leaf, most: capacity(self.max_leaf, levels - 1) };
        let bins = self.bins as usize;
        match n {
            ..=4 => choice.take(Sweep::<4>::new),
            5..=8 => choice.take(Sweep::<8>::new),
            9..=sweep::MAX => choice.take(Sweep::<{ sweep::MAX }>::new),
            _ if bins <= 16 => choice.take(|range| Plane::cheapest::<16>(range, extents, bins)),
            _ if bins <= 32 => choice.take(|range| Plane::cheapest::<32>(range, extents, bins)),
            _ => choice.take(|range| Plane::cheapest::<64>(range, extents, bins)),
        }
    }
}

/// A way to cut a range.
pub(super) trait Split {
    /// Sum over both sides of half area times count.
    fn weight(&self) -> f32;

    /// Items on the side that has more.
    fn greater(&self) -> usize;

    /// Cuts the range that it was found for.
    fn part(&self, range: &mut [Item]) -> Cut;
}

/// What to do with a range.
struct Choice<'a> {
    range: &'a mut [Item],
    extents: &'a Extents,
    may_be_leaf: bool,
    /// Items that fit on one side.
    most: usize,
}

impl Choice<'_> {
    /// Takes the cheapest way, which is found by `cheapest`, if it is worth its cost and the sides fit.
    fn take<S: Split>(self, cheapest: impl Fn(&[Item]) -> Option<S>) -> Option<Cut> {
        let Self { range, extents, may_be_leaf, most } = self;
        match cheapest(range) {
            None if may_be_leaf => None,
            Some(s) if may_be_leaf && NODE_COST + s.weight() / extents.boxes.half_area() >= range.len() as f32 => None,
            Some(split) if split.greater() <= most => Some(split.part(range)),
            _ => Some(halve(range, extents)),
        }
    }
}

/// Triangles that fit in a subtree with this many levels below its root.
pub(super) fn capacity(max_leaf: u32, levels: u32) -> usize {
    if levels < 32 { (max_leaf as usize).saturating_mul(1 << levels) } else { usize::MAX }
}

/// Cost of visiting a node, in triangle tests: two boxes are tested, and the next node is waited for.
pub(super) const NODE_COST: f32 = 1.5;
