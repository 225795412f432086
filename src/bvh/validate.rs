//! Whether a hierarchy is sound.

use rayon::prelude::*;

use super::{Bvh, Leaf, cover};
use crate::geom::{Aabb, Triangle, Vector};
use crate::order::Side;
use crate::scene::Mesh;
use crate::tree::{self, Node, Topology};

/// What is wrong with a hierarchy, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BvhError {
    /// Inner nodes and leaves are not numbered in depth-first order, or a node is reached twice.
    #[error("{found:?} stands where depth-first order wants index {expected}")]
    Order {
        /// Address that was found.
        found: Node,
        /// Index that was to come next.
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
    /// A record names other nodes than the hierarchy says: parent and sibling, or uncle and grand uncle.
    #[error("{0:?} names other relatives than its own")]
    Links(Node),
    /// A child's box sticks out of its parent's own box.
    #[error("the box of {0:?} is not inside its parent's")]
    Nesting(Node),
    /// A triangle sticks out of its leaf's box.
    #[error("triangle {prim} is not inside the box of {leaf:?}")]
    Outside {
        /// The leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// A leaf is empty, or does not start where the leaf before it ends; or the last one does not end with the
    /// triangles.
    #[error("{0:?} does not hold the next range of triangles")]
    Range(Node),
    /// A leaf's triangle is not one of the mesh, or has other corners.
    #[error("triangle {prim} in {leaf:?} is not that of the mesh")]
    Triangle {
        /// The leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// Two leaves hold the same triangle, though there are to be no duplicates, or one leaf holds it twice.
    #[error("triangle {prim} is there again in {leaf:?}")]
    Twice {
        /// The second leaf.
        leaf: Node,
        /// Index in the mesh.
        prim: u32,
    },
    /// A triangle sticks out of the boxes of all leaves that hold it together.
    #[error("triangle {0} is not covered by the boxes of its leaves")]
    Uncovered(u32),
    /// The stored number of duplicates is not that of the references.
    #[error("there are {found} duplicates, not {stored}")]
    Duplicates {
        /// What the hierarchy says.
        stored: usize,
        /// References beyond the first of each triangle.
        found: usize,
    },
    /// A triangle of the mesh that can be hit is in no leaf.
    #[error("triangle {0} is in no leaf")]
    Missing(u32),
    /// The stored depth is not that of the deepest leaf.
    #[error("the depth is {found}, not {stored}")]
    Depth {
        /// What the hierarchy says.
        stored: u32,
        /// Depth of its deepest leaf, in edges.
        found: u32,
    },
}

/// Checks that a hierarchy holds each triangle of the mesh (degenerate ones need not be there), in boxes that contain it and
/// nest, with nodes and leaves in depth-first order, known split axes, the relatives that it says records name, and the
/// depth that it states.
///
/// A triangle is held once, unless there are to be [`duplicates`](Bvh::duplicates): then their number must be right, and
/// where a triangle is not inside of the box of a leaf that holds it, the boxes of all its leaves must cover it, in exact
/// arithmetic.
///
/// # Errors
/// The first fault in depth-first order; of triangles that are not covered the first one.
pub fn validate<V: Vector>(bvh: &Bvh<Triangle<V>>, mesh: &Mesh<V>) -> Result<(), BvhError> {
    let mut walk =
        Walk { bvh, mesh, seen: vec![UNSEEN; mesh.triangles().len()], held: Vec::new(), inner: 0, leaves: 0, end: 0 };
    let mut depth = 0;
    let mut pending = vec![(bvh.root, bvh.bounds, 0)];
    while let Some((node, aabb, level)) = pending.pop() {
        depth = depth.max(level);
        if node.is_leaf() {
            walk.leaf(node, &aabb)?;
        } else {
            let children = walk.inner(node, &aabb)?;
            pending.extend(children.into_iter().rev().map(|(child, aabb)| (child, aabb, level + 1)));
        }
    }
    walk.end()?;
    walk.cover()?;
    // The walk has shown the addresses to be those of a tree.
    for (record, links) in (0..).zip(tree::link_rows(bvh, bvh.recorded())) {
        let inner = bvh.nodes.len() as u32;
        let node = if record < inner { Node::inner(record) } else { Node::leaf(record - inner) };
        if bvh.links(node) != links {
            return Err(BvhError::Links(node));
        }
    }
    if depth == bvh.depth() { Ok(()) } else { Err(BvhError::Depth { stored: bvh.depth(), found: depth }) }
}

/// How far the check has come.
struct Walk<'a, V> {
    bvh: &'a Bvh<Triangle<V>>,
    mesh: &'a Mesh<V>,
    /// The last leaf that holds each triangle.
    seen: Vec<u32>,
    /// With duplicates, each reference with the box of its leaf.
    held: Vec<(u32, Aabb)>,
    inner: usize,
    leaves: usize,
    end: usize,
}

/// In place of a leaf that there is not.
const UNSEEN: u32 = u32::MAX;

impl<V: Vector> Walk<'_, V> {
    fn inner(&mut self, node: Node, aabb: &Aabb) -> Result<[(Node, Aabb); 2], BvhError> {
        // An index that is always the next one is reached once, so the walk ends.
        let record = match self.bvh.nodes.get(node.index()) {
            Some(record) if node.index() == self.inner => record,
            _ => return Err(BvhError::Order { found: node, expected: self.inner }),
        };
        self.inner += 1;
        let axis = self.bvh.axes.get(node.index()).copied();
        if !matches!(axis, Some(0..=2 | 4..=6)) {
            return Err(BvhError::Axis { node, axis });
        }
        let children = [Side::Left, Side::Right].map(|s| (record.children[s.index()], record.child_box(s)));
        match children.iter().find(|(_, child)| !aabb.encloses(child)) {
            Some((child, _)) => Err(BvhError::Nesting(*child)),
            None => Ok(children),
        }
    }

    fn leaf(&mut self, leaf: Node, aabb: &Aabb) -> Result<(), BvhError> {
        let Leaf { first, count, .. } = match self.bvh.leaves.get(leaf.index()) {
            Some(range) if leaf.index() == self.leaves => *range,
            _ => return Err(BvhError::Order { found: leaf, expected: self.leaves }),
        };
        self.leaves += 1;
        let end = first as usize + count as usize;
        if first as usize != self.end || count == 0 || end > self.bvh.triangles.len() {
            return Err(BvhError::Range(leaf));
        }
        self.end = end;
        let may_repeat = self.bvh.duplicates > 0;
        for held in self.bvh.leaf_triangles(leaf) {
            let prim = held.prim;
            match self.seen.get_mut(prim as usize) {
                Some(seen) if held.shape == Triangle(self.mesh.triangle(prim as usize)) => {
                    let last = std::mem::replace(seen, leaf.index() as u32);
                    if last == leaf.index() as u32 || last != UNSEEN && !may_repeat {
                        return Err(BvhError::Twice { leaf, prim });
                    }
                }
                _ => return Err(BvhError::Triangle { leaf, prim }),
            }
            if may_repeat {
                self.held.push((prim, *aabb));
            } else if !aabb.encloses(&held.shape.aabb()) {
                return Err(BvhError::Outside { leaf, prim });
            }
        }
        Ok(())
    }

    /// Whether everything has been seen.
    fn end(&self) -> Result<(), BvhError> {
        if self.inner != self.bvh.nodes.len() {
            return Err(BvhError::Unreached(Node::inner(self.inner as u32)));
        }
        if self.leaves != self.bvh.leaves.len() {
            return Err(BvhError::Unreached(Node::leaf(self.leaves as u32)));
        }
        if self.end != self.bvh.triangles.len() {
            return Err(BvhError::Range(Node::leaf(self.leaves as u32 - 1)));
        }
        let can_be_hit = |prim: usize| !Triangle(self.mesh.triangle(prim)).is_degenerate();
        let missing = (0..self.seen.len()).find(|&prim| self.seen[prim] == UNSEEN && can_be_hit(prim));
        if let Some(prim) = missing {
            return Err(BvhError::Missing(prim as u32));
        }
        let distinct = self.seen.iter().filter(|&&leaf| leaf != UNSEEN).count();
        let (stored, found) = (self.bvh.duplicates, self.bvh.triangles.len() - distinct);
        if stored == found { Ok(()) } else { Err(BvhError::Duplicates { stored, found }) }
    }

    /// Whether the boxes of the leaves that hold a triangle cover it.
    fn cover(mut self) -> Result<(), BvhError> {
        self.held.sort_by_key(|(prim, _)| *prim);
        let by_triangle: Vec<_> = self.held.chunk_by(|(prim, _), (next, _)| prim == next).collect();
        let is_covered = |held: &&&[(u32, Aabb)]| {
            let triangle = held.first().map(|&(prim, _)| Triangle(self.mesh.triangle(prim as usize)));
            let boxes: Vec<_> = held.iter().map(|(_, aabb)| *aabb).collect();
            triangle.is_some_and(|triangle| {
                let whole = triangle.aabb();
                boxes.iter().any(|aabb| aabb.encloses(&whole)) || cover::covers(&boxes, &triangle)
            })
        };
        let uncovered = by_triangle.par_iter().find_first(|held| !is_covered(held));
        match uncovered.and_then(|held| held.first()) {
            Some(&(prim, _)) => Err(BvhError::Uncovered(prim)),
            None => Ok(()),
        }
    }
}
