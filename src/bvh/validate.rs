//! Validation of hierarchies.

mod sound;

pub(super) use sound::check;

use super::Bvh;
use crate::geom::{Mesh, Triangle, Vector};
use crate::tree::Node;

/// Errors of [`validate`], with their location.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BvhError {
    /// Inner nodes and leaves are not numbered in depth-first order, or a node is reached twice.
    #[error("{found:?} stands where depth-first order wants index {expected}")]
    Order {
        /// The address in the hierarchy.
        found: Node,
        /// The expected index.
        expected: usize,
    },
    /// A node or leaf is not reached from the root.
    #[error("{0:?} is not reached from the root")]
    Unreached(Node),
    /// A split axis is not 0, 1 or 2, or is missing.
    #[error("{node:?} is split on axis {axis:?}")]
    Axis {
        /// The inner node.
        node: Node,
        /// Its axis.
        axis: Option<u8>,
    },
    /// A record's references are wrong: they are not parent and sibling, or not uncle and grand uncle.
    #[error("{0:?} names other relatives than its own")]
    Links(Node),
    /// A box has a NaN, or its `lo` is above its `hi` on some axis.
    #[error("the box of {0:?} has no points")]
    NoBox(Node),
    /// A child's box extends beyond its parent's own box.
    #[error("the box of {0:?} is not inside its parent's")]
    Nesting(Node),
    /// A triangle extends beyond its leaf's box.
    #[error("triangle {prim} is not inside the box of {leaf:?}")]
    Outside {
        /// The leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// A leaf is empty, or does not start where the previous leaf ends; or the last leaf does not end with the
    /// triangles.
    #[error("{0:?} does not hold the next range of triangles")]
    Range(Node),
    /// A corner of a triangle is NaN or infinite.
    #[error("triangle {prim} in {leaf:?} has a corner that is not finite")]
    NotFinite {
        /// The leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// A leaf's triangle is not one of the mesh: its index is out of range, or its corners differ.
    #[error("triangle {prim} in {leaf:?} is not that of the mesh")]
    Triangle {
        /// The leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// Two leaves hold the same triangle although the hierarchy states no duplicates, or one leaf holds it twice.
    #[error("triangle {prim} is there again in {leaf:?}")]
    Twice {
        /// The second leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// Two leaves hold the same triangle with different corners.
    #[error("triangle {prim} in {leaf:?} has other corners than in another leaf")]
    Corners {
        /// One of the leaves.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// The boxes of all leaves that hold a triangle do not cover it together.
    #[error("triangle {0} is not covered by the boxes of its leaves")]
    Uncovered(u32),
    /// The stored number of duplicates differs from that of the references.
    #[error("there are {found} duplicates, not {stored}")]
    Duplicates {
        /// The number in the hierarchy.
        stored: usize,
        /// References beyond the first of each triangle.
        found: usize,
    },
    /// A triangle of the mesh that can be hit is in no leaf.
    #[error("triangle {0} is in no leaf")]
    Missing(u32),
    /// The stored number of omitted triangles differs from that of the mesh's triangles in no leaf.
    #[error("{found} triangles were left out, not {stored}")]
    Dropped {
        /// The number in the hierarchy.
        stored: usize,
        /// Triangles of the mesh in no leaf.
        found: usize,
    },
    /// The stored depth is not that of the deepest leaf.
    #[error("the depth is {found}, not {stored}")]
    Depth {
        /// The number in the hierarchy.
        stored: u32,
        /// Depth of its deepest leaf, in edges.
        found: u32,
    },
}

/// Checks that a hierarchy is sound and holds each triangle of the mesh (degenerate triangles may be missing).
///
/// A sound hierarchy has nested boxes, nodes and leaves in depth-first order, valid split axes, records with the
/// correct relatives, the stated depth, and triangles with finite corners, each inside its leaf's box.
///
/// A triangle is held once, unless the hierarchy states [`duplicates`](Bvh::duplicates). Then their number must be
/// correct, and all references to a triangle must have the same corners. If a triangle is not inside the box of one of
/// its leaves, the boxes of all its leaves must cover it, in exact arithmetic.
///
/// # Errors
/// The first node error in depth-first order; otherwise the error of the first triangle.
pub fn validate<V: Vector>(bvh: &Bvh<Triangle<V>>, mesh: &Mesh<V>) -> Result<(), BvhError> {
    let references = sound::check(bvh)?;
    let mut is_held = vec![false; mesh.triangles().len()];
    for (prim, place) in references {
        match is_held.get_mut(prim as usize) {
            Some(is_held) if bvh.triangles[place as usize].shape == Triangle(mesh.triangle(prim as usize)) => {
                *is_held = true;
            }
            _ => return Err(BvhError::Triangle { leaf: bvh.leaf_of(place as usize), prim }),
        }
    }
    let can_be_hit = |prim: usize| !Triangle(mesh.triangle(prim)).is_degenerate();
    if let Some(prim) = (0..is_held.len()).find(|&prim| !is_held[prim] && can_be_hit(prim)) {
        return Err(BvhError::Missing(prim as u32));
    }
    let (stored, found) = (bvh.dropped, is_held.iter().filter(|is_held| !**is_held).count());
    if stored == found { Ok(()) } else { Err(BvhError::Dropped { stored, found }) }
}

#[cfg(test)]
pub(super) mod tests;
