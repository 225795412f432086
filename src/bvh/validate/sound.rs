//! Checks of a hierarchy without a mesh: all properties that queries rely on.

use super::BvhError;
use crate::bvh::{Bvh, Leaf, cover};
use crate::geom::{Aabb, Triangle, Vector};
use crate::order::Side;
use crate::threads;
use crate::tree::{self, Node, Topology};

/// A triangle of a leaf: its index in the mesh, and its place in [`Bvh::triangles`].
type Reference = (u32, u32);

/// Checks the nodes, then the triangles. Returns all references, sorted.
///
/// Memory is proportional to nodes and triangles, for any values in them.
pub(in crate::bvh) fn check<V: Vector>(bvh: &Bvh<Triangle<V>>) -> Result<Vec<Reference>, BvhError> {
    check_nodes(bvh)?;
    check_links(bvh)?;
    let mut references: Vec<_> = bvh.triangles.iter().zip(0..).map(|(held, place)| (held.prim, place)).collect();
    threads::sort_by(&mut references, Ord::cmp);
    check_references(bvh, &references)?;
    if bvh.duplicates > 0 {
        check_cover(bvh, &references)?;
    }
    Ok(references)
}

fn check_nodes<V: Vector>(bvh: &Bvh<Triangle<V>>) -> Result<(), BvhError> {
    let mut walk = Walk { bvh, inner: 0, leaves: 0, end: 0 };
    let mut depth = 0;
    let mut pending = vec![(bvh.tree.root, bvh.bounds, 0)];
    while let Some((node, aabb, level)) = pending.pop() {
        depth = depth.max(level);
        // A comparison with NaN is false.
        if !aabb.lo.cmple(aabb.hi).all() {
            return Err(BvhError::NoBox(node));
        }
        if node.is_leaf() {
            walk.leaf(node, &aabb)?;
        } else {
            let children = walk.inner(node, &aabb)?;
            pending.extend(children.into_iter().rev().map(|(child, aabb)| (child, aabb, level + 1)));
        }
    }
    walk.end()?;
    if depth == bvh.tree.depth { Ok(()) } else { Err(BvhError::Depth { stored: bvh.tree.depth, found: depth }) }
}

/// The state of the check.
struct Walk<'a, V> {
    bvh: &'a Bvh<Triangle<V>>,
    inner: usize,
    leaves: usize,
    end: usize,
}

impl<V: Vector> Walk<'_, V> {
    fn inner(&mut self, node: Node, aabb: &Aabb) -> Result<[(Node, Aabb); 2], BvhError> {
        // Each index must be the next one, so it is reached once and the walk ends.
        let record = match self.bvh.tree.nodes.get(node.index()) {
            Some(record) if node.index() == self.inner => record,
            _ => return Err(BvhError::Order { found: node, expected: self.inner }),
        };
        self.inner += 1;
        let axis = self.bvh.tree.axes.get(node.index()).copied();
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
        let Leaf { first, count, .. } = match self.bvh.tree.leaves.get(leaf.index()) {
            Some(range) if leaf.index() == self.leaves => *range,
            _ => return Err(BvhError::Order { found: leaf, expected: self.leaves }),
        };
        self.leaves += 1;
        let start = std::mem::replace(&mut self.end, (first as usize).saturating_add(count as usize));
        if first as usize != start || count == 0 || self.end > self.bvh.triangles.len() {
            return Err(BvhError::Range(leaf));
        }
        for held in self.bvh.leaf_triangles(leaf) {
            let prim = held.prim;
            if !held.shape.0.iter().all(|corner| corner.is_finite()) {
                return Err(BvhError::NotFinite { leaf, prim });
            }
            // Duplicates are parts of triangles: see `check_cover`.
            if self.bvh.duplicates == 0 && !aabb.encloses(&self.bvh.frame().aabb(&held.shape)) {
                return Err(BvhError::Outside { leaf, prim });
            }
        }
        Ok(())
    }

    /// Checks that everything was reached.
    fn end(&self) -> Result<(), BvhError> {
        if self.inner != self.bvh.tree.nodes.len() {
            return Err(BvhError::Unreached(Node::inner(self.inner as u32)));
        }
        if self.leaves != self.bvh.tree.leaves.len() {
            return Err(BvhError::Unreached(Node::leaf(self.leaves as u32)));
        }
        if self.end != self.bvh.triangles.len() {
            return Err(BvhError::Range(Node::leaf(self.leaves as u32 - 1)));
        }
        Ok(())
    }
}

/// Checks that records have the correct relatives; the nodes must form a tree.
fn check_links<S>(bvh: &Bvh<S>) -> Result<(), BvhError> {
    for (record, links) in (0..).zip(tree::link_rows(bvh, bvh.tree.recorded)) {
        let inner = bvh.tree.nodes.len() as u32;
        let node = if record < inner { Node::inner(record) } else { Node::leaf(record - inner) };
        if bvh.links(node) != links {
            return Err(BvhError::Links(node));
        }
    }
    Ok(())
}

/// Checks that sorted references are to the stated number of triangles, and that those to one triangle have the same
/// corners.
fn check_references<V: Vector>(bvh: &Bvh<Triangle<V>>, references: &[Reference]) -> Result<(), BvhError> {
    let mut repeated = 0;
    for &[(prim, place), (next_prim, next_place)] in references.array_windows() {
        if prim == next_prim {
            repeated += 1;
            let leaf = bvh.leaf_of(next_place as usize);
            if bvh.duplicates == 0 || leaf == bvh.leaf_of(place as usize) {
                return Err(BvhError::Twice { leaf, prim });
            }
            if bvh.triangles[place as usize].shape != bvh.triangles[next_place as usize].shape {
                return Err(BvhError::Corners { leaf, prim });
            }
        }
    }
    if bvh.duplicates != repeated {
        return Err(BvhError::Duplicates { stored: bvh.duplicates, found: repeated });
    }
    let count = bvh.dropped.saturating_add(bvh.triangles.len() - repeated);
    match references.last() {
        Some(&(prim, place)) if prim as usize >= count => {
            Err(BvhError::Triangle { leaf: bvh.leaf_of(place as usize), prim })
        }
        _ => Ok(()),
    }
}

/// Checks that the boxes of the leaves that hold a triangle cover it.
fn check_cover<V: Vector>(bvh: &Bvh<Triangle<V>>, references: &[Reference]) -> Result<(), BvhError> {
    let own_boxes = bvh.own_boxes();
    let is_covered = |held: &[Reference]| {
        let boxes: Vec<_> = held.iter().map(|&(_, place)| own_boxes[bvh.slot(bvh.leaf_of(place as usize))]).collect();
        held.first().is_some_and(|&(_, place)| cover::hold(bvh.frame(), &boxes, &bvh.triangles[place as usize].shape))
    };
    let by_triangle: Vec<_> = references.chunk_by(|(prim, _), (next, _)| prim == next).collect();
    let covered = threads::map(0..by_triangle.len(), 1, |i| is_covered(by_triangle[i]));
    let uncovered = by_triangle.iter().zip(covered).find(|(_, is_covered)| !is_covered);
    match uncovered.and_then(|(held, _)| held.first()) {
        Some(&(prim, _)) => Err(BvhError::Uncovered(prim)),
        None => Ok(()),
    }
}
