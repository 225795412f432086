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
        let is_worth = |weight: f32| !may_be_leaf || NODE_COST + weight / extents.boxes.half_area() < n as f32;
        let fits = |greater: usize| greater <= capacity(self.max_leaf, levels - 1);
        if n <= sweep::MAX {
            match Sweep::new(range) {
                Some(sweep) if !is_worth(sweep.weight()) => return None,
                Some(sweep) if fits(sweep.greater(n)) => return Some(sweep.part(range)),
                Some(_) => return Some(halve(range, extents)),
                None => {}
            }
        } else {
            let bins = self.bins as usize;
            let plane = match bins {
                0..=16 => Plane::cheapest::<16>(range, extents, bins),
                17..=32 => Plane::cheapest::<32>(range, extents, bins),
                _ => Plane::cheapest::<64>(range, extents, bins),
            };
            match plane {
                Some(plane) if !is_worth(plane.weight) => return None,
                Some(plane) if fits(plane.greater) => return Some(plane.part(range)),
                Some(_) => return Some(halve(range, extents)),
                None => {}
            }
        }
        (!may_be_leaf).then(|| halve(range, extents))
    }
}

/// Triangles that fit in a subtree with this many levels below its root.
pub(super) fn capacity(max_leaf: u32, levels: u32) -> usize {
    if levels < 32 { (max_leaf as usize).saturating_mul(1 << levels) } else { usize::MAX }
}

/// Cost of visiting a node, in triangle tests: two boxes are tested, and the next node is waited for.
const NODE_COST: f32 = 2.0;
