//! New boxes for the same tree, after its primitives have moved.

use super::{Bvh, Primitives};
use crate::geom::{Aabb, EnvironmentError, Region, check_environment};
use crate::order::Side;
use crate::tree::Node;

/// Errors of [`Bvh::refit`]. The hierarchy is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RefitError {
    /// The number of primitives differs from that at the build.
    #[error("{found} primitives, expected {expected} as at the build")]
    Count {
        /// Primitives that were given.
        found: usize,
        /// Primitives that the hierarchy was built over.
        expected: usize,
    },
    /// The box of a primitive is empty or has a NaN.
    #[error("primitive {0} has no box")]
    NoBox(u32),
    /// A primitive that could not be hit was omitted, and now can be hit. The hierarchy must be rebuilt.
    #[error("primitive {0} was degenerate at the build and is no longer")]
    Revived(u32),
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

/// Refuses primitives that can be hit and that the hierarchy does not contain.
pub(super) fn refuse_revived<P: Primitives + ?Sized>(
    primitives: &P,
    held: impl Iterator<Item = u32>,
) -> Result<(), RefitError> {
    let mut is_held = vec![false; primitives.count()];
    for prim in held {
        // Lanes without a triangle have a greater index.
        if let Some(is_held) = is_held.get_mut(prim as usize) {
            *is_held = true;
        }
    }
    let revived = (0..is_held.len()).find(|&prim| !is_held[prim] && primitives.can_be_hit(prim));
    revived.map_or(Ok(()), |prim| Err(RefitError::Revived(prim as u32)))
}

impl<S> Bvh<S> {
    /// Replaces the shapes, and computes the smallest boxes that contain them, in the same tree.
    ///
    /// If spatial splits divided triangles, each of their leaves now holds them whole. A refit takes a fraction of the
    /// time of a build, and queries stay correct. They get slower the more the shapes move relative to each other;
    /// [`axes`](Self::axes) do not change.
    ///
    /// ```
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::{bvh::{self, Bvh, SahOptions}, geom::Mesh};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    /// let mut bvh = Bvh::sah(&Mesh::new(corners.clone(), vec![[0, 1, 2]])?, SahOptions::default())?;
    /// let moved = Mesh::new(corners.into_iter().map(|corner| corner * 2.0).collect(), vec![[0, 1, 2]])?;
    /// bvh.refit(&moved)?;
    /// bvh::validate(&bvh, &moved)?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`RefitError`]; then nothing has changed.
    pub fn refit<P: Primitives<Shape = S> + ?Sized>(&mut self, primitives: &P) -> Result<(), RefitError> {
        check_environment()?;
        let boxes = self.moved_boxes(primitives)?;
        for held in &mut self.triangles {
            held.shape = primitives.shape(held.prim as usize);
        }
        // Children come after their parents.
        for i in (0..self.tree.nodes.len()).rev() {
            let [left, right] = self.tree.nodes[i].children.map(|child| self.box_of(child, &boxes));
            self.tree.nodes[i].set_child_boxes(&left, &right);
        }
        self.bounds = self.box_of(self.tree.root, &boxes);
        self.region = Region::within(primitives.frame(), &self.bounds);
        Ok(())
    }

    /// Returns the new boxes of [`triangles`](Self::triangles), if all checks pass.
    fn moved_boxes<P: Primitives<Shape = S> + ?Sized>(&self, primitives: &P) -> Result<Vec<Aabb>, RefitError> {
        let (found, expected) = (primitives.count(), self.triangles.len() + self.dropped - self.duplicates);
        if found != expected {
            return Err(RefitError::Count { found, expected });
        }
        refuse_revived(primitives, self.triangles.iter().map(|held| held.prim))?;
        let aabb = |prim: u32| {
            let aabb = primitives.aabb(prim as usize);
            aabb.lo.cmple(aabb.hi).all().then_some(aabb).ok_or(RefitError::NoBox(prim))
        };
        self.triangles.iter().map(|held| aabb(held.prim)).collect()
    }

    /// Returns the box of a node whose subtree is complete.
    fn box_of(&self, node: Node, boxes: &[Aabb]) -> Aabb {
        if node.is_leaf() {
            boxes[self.leaf_range(node)].iter().copied().fold(Aabb::EMPTY, Aabb::union)
        } else {
            let node = &self.tree.nodes[node.index()];
            node.child_box(Side::Left).union(node.child_box(Side::Right))
        }
    }
}
