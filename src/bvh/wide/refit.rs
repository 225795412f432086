//! Updates after vertices have moved: new boxes, and better places for subtrees.

use super::{WideBvh, WideError, collapse, leaf_places};
use crate::bvh::least::Least;
use crate::bvh::refit::{RefitError, refuse_revived};
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, Frame, Mesh, Region, Triangle, check_environment};
use crate::threads;
use crate::tree::Node;

/// Nodes or blocks that a thread takes at a time.
const CHUNK: usize = 1 << 10;

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// Replaces the triangles by those of a mesh with the same number, and computes the smallest boxes that contain
    /// them, in the same tree.
    ///
    /// If spatial splits divided triangles, each of their leaves now holds them whole. Queries stay correct, and get
    /// slower the more the triangles move relative to each other.
    ///
    /// ```
    /// use stackless_bvh::{bvh::{Bvh, WideBvh}, generate::procedural, geom::Mesh};
    ///
    /// let mesh = procedural::strands(1, 100);
    /// let mut wide = WideBvh::<8>::of(&Bvh::build(&mesh)?)?;
    /// let doubled = mesh.vertices().iter().map(|corner| corner * 2.0).collect();
    /// let doubled = Mesh::new(doubled, mesh.triangles().to_vec())?;
    /// wide.refit(&doubled)?;
    /// wide.validate(&doubled)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RefitError`], except [`RefitError::NoBox`]; then nothing has changed.
    pub fn refit(&mut self, mesh: &Mesh<V>) -> Result<(), RefitError> {
        check_environment()?;
        let (found, expected) = (mesh.triangles().len(), self.triangles);
        if found != expected {
            return Err(RefitError::Count { found, expected });
        }
        let held: usize = self.leaf_boxes().map(|(leaf, _)| leaf_places(leaf).len()).sum();
        if held - self.duplicates < found {
            refuse_revived(mesh, self.blocks.iter().flat_map(|block| block.prims))?;
        }
        threads::update_anyway(&mut self.blocks, CHUNK, |block| {
            for (lane, prim) in block.prims.into_iter().enumerate() {
                if (prim as usize) < found {
                    block.set(lane, &Triangle(mesh.triangle(prim as usize)), prim);
                }
            }
        });
        let Self { nodes, blocks, .. } = self;
        threads::update_anyway(nodes, CHUNK, |node| {
            for slot in 0..A as u32 {
                if node.leaves() >> slot & 1 == 1 {
                    node.set_child_box(slot, &leaf_box(blocks, node.child(slot), mesh.frame()));
                }
            }
        });
        // Children come after their parents.
        let mut own = vec![Aabb::EMPTY; self.nodes.len()];
        for (index, node) in self.nodes.iter_mut().enumerate().rev() {
            for slot in 0..A as u32 {
                if node.has_inner(slot) {
                    node.set_child_box(slot, &own[node.child(slot).index()]);
                }
            }
            own[index] = node.aabb();
        }
        if !self.blocks.is_empty() {
            self.region = Region::within(*mesh.frame(), &own[0]);
        }
        Ok(())
    }

    /// Moves subtrees to better places, after moved triangles have made the tree worse: all nodes are rebuilt over the
    /// same leaves, by the steps of a [build](crate::bvh::BuildOptions::build_wide), in a quarter of its time.
    /// `[BUILD-7]`
    ///
    /// Leaves do not change: if triangles of one leaf have moved apart, only a new build helps.
    ///
    /// ```
    /// use stackless_bvh::{bvh::WideBvh, generate::procedural, geom::Mesh};
    ///
    /// let mesh = procedural::strands(1, 100);
    /// let mut wide = WideBvh::build(&mesh)?;
    /// let twisted = mesh.vertices().iter().map(|v| v.rotate_y(v.y)).collect();
    /// let twisted = Mesh::new(twisted, mesh.triangles().to_vec())?;
    /// wide.refit(&twisted)?;
    /// wide.optimize()?;
    /// wide.validate(&twisted)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`WideError`], except those of options; then nothing has changed.
    pub fn optimize(&mut self) -> Result<(), WideError> {
        if self.blocks.is_empty() {
            return Ok(());
        }
        (self.nodes, self.levels) = threads::guarded(|| collapse::over_leaves(self))??;
        self.least = Least::default();
        Ok(())
    }
}

fn leaf_box<V: Precision>(blocks: &[Block<V>], leaf: Node, frame: &Frame) -> Aabb {
    let boxes = leaf_places(leaf).map(|place| frame.aabb(&blocks[place / 4].triangle(place & 3)));
    boxes.fold(Aabb::EMPTY, Aabb::union)
}

#[cfg(test)]
mod tests;
