//! The median builder: a complete tree.

use super::{BuildError, build, halve, items};
use crate::bvh::Bvh;
use crate::geom::{Triangle, Vector};
use crate::scene::Mesh;

impl<V: Vector> Bvh<Triangle<V>> {
    /// A complete tree: all leaves at the same depth, and their counts differ by at most 1.
    ///
    /// Each node is cut at the exact middle of its count, along the axis on which the centroids spread most. The
    /// depth is the least with which leaves hold at most `leaf_size` triangles. No leaf is empty: so with a
    /// `leaf_size` of 1, some leaves hold 2 unless the number of triangles is a power of two.
    ///
    /// # Errors
    /// Any but [`BuildError::Bins`] and [`BuildError::DepthLimit`].
    pub fn median(mesh: &Mesh<V>, leaf_size: u32) -> Result<Self, BuildError> {
        if leaf_size == 0 {
            return Err(BuildError::ZeroLeafSize);
        }
        let items = items(mesh)?;
        let leaves_wanted = items.len().div_ceil(leaf_size as usize);
        let full = leaves_wanted.next_power_of_two().ilog2().min(items.len().ilog2());
        Ok(build(mesh, items, |range, depth| (depth < full).then(|| halve(range))))
    }
}
