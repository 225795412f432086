//! Limits on leaves and depth.

use super::BuildError;

/// Leaves and depth of a binary hierarchy. `[BUILD-3]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SahOptions {
    /// Greatest number of triangles in a leaf, at least 1. Leaves are smaller where that is cheaper.
    pub max_leaf: u32,
    /// Greatest depth, in edges. It is always kept.
    pub depth_limit: u32,
}

impl Default for SahOptions {
    /// Leaves of up to 4, and the depth that a 32-bit key carries.
    fn default() -> Self {
        Self { max_leaf: 4, depth_limit: 31 }
    }
}

impl SahOptions {
    /// Checks that this number of items fits.
    pub(super) fn check(self, triangles: usize) -> Result<(), BuildError> {
        let Self { max_leaf, depth_limit: limit } = self;
        let fits = triangles <= self.capacity(limit);
        if fits { Ok(()) } else { Err(BuildError::DepthLimit { triangles, max_leaf, limit }) }
    }

    /// Returns the number of levels that may be below a node at this depth.
    pub(super) fn levels_below(self, depth: u32) -> u32 {
        self.depth_limit.saturating_sub(depth)
    }

    /// Returns the number of triangles that fit in a subtree with this many levels below its root.
    pub(super) fn capacity(self, levels: u32) -> usize {
        if levels < 32 { (self.max_leaf as usize).saturating_mul(1 << levels) } else { usize::MAX }
    }
}

/// Cost of visiting a node, in triangle tests: two box tests, and the wait for the next node.
pub(super) const NODE_COST: f32 = 1.5;
