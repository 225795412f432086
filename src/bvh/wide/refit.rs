//! New boxes for the same wide hierarchy, after its vertices have moved.

use super::{WideBvh, leaf_parts};
use crate::bvh::RefitError;
use crate::geom::lanes::Precision;
use crate::geom::{Aabb, Frame, Mesh, Region, Triangle, check_environment};

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// Takes on a mesh of as many triangles, and the smallest boxes that hold them, in the same tree.
    ///
    /// Where spatial splits cut triangles in two, each of their leaves now holds them whole. Queries stay right, and
    /// get slower the more the triangles move relative to each other.
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
    /// What [`RefitError`] lists, but for [`RefitError::NoBox`]; then nothing has changed.
    pub fn refit(&mut self, mesh: &Mesh<V>) -> Result<(), RefitError> {
        check_environment()?;
        let (found, expected) = (mesh.triangles().len(), self.triangles);
        if found != expected {
            return Err(RefitError::Count { found, expected });
        }
        let mut is_held = vec![false; found];
        for prim in self.blocks.iter().flat_map(|block| block.prims) {
            if let Some(is_held) = is_held.get_mut(prim as usize) {
                *is_held = true;
            }
        }
        let triangle = |prim: usize| Triangle(mesh.triangle(prim));
        if let Some(prim) = (0..found).find(|&prim| !is_held[prim] && !triangle(prim).is_degenerate()) {
            return Err(RefitError::Revived(prim as u32));
        }
        for block in &mut self.blocks {
            for (lane, prim) in block.prims.into_iter().enumerate() {
                if (prim as usize) < found {
                    block.set(lane, &triangle(prim as usize), prim);
                }
            }
        }
        // Children come after their parents.
        let mut own = vec![Aabb::EMPTY; self.nodes.len()];
        for index in (0..self.nodes.len()).rev() {
            for slot in 0..A as u32 {
                let node = &self.nodes[index];
                if !node.has_child(slot) {
                    continue;
                }
                let child = node.child(slot);
                let aabb =
                    if child.is_leaf() { self.leaf_box(leaf_parts(child), mesh.frame()) } else { own[child.index()] };
                self.nodes[index].set_child_box(slot, &aabb);
                own[index] = own[index].union(aabb);
            }
        }
        if !self.blocks.is_empty() {
            self.region = Region::within(*mesh.frame(), &own[0]);
        }
        Ok(())
    }

    fn leaf_box(&self, (first, count): (usize, u32), frame: &Frame) -> Aabb {
        let lanes = (0..count as usize).map(|i| frame.aabb(&self.blocks[first + i / 4].triangle(i & 3)));
        lanes.fold(Aabb::EMPTY, Aabb::union)
    }
}
