//! The tree with a node for each triangle that is collapsed, and its triangles.

use std::ops::Range;

use crate::bvh::build::{Draft, Record, room};
use crate::bvh::{BuildError, Bvh};
use crate::geom::{Aabb, Mesh, Triangle, Vector};
use crate::order::Side;
use crate::tree::{Node, Topology};

/// What the leaves of a draft stand for.
pub(super) trait Shapes<V: Vector>: Sync {
    /// The index in the mesh.
    fn prim(&self, leaf: u32) -> u32;

    fn triangle(&self, leaf: u32) -> Triangle<V>;
}

impl<V: Vector> Shapes<V> for Mesh<V> {
    #[inline(always)]
    fn prim(&self, leaf: u32) -> u32 {
        leaf
    }

    #[inline(always)]
    fn triangle(&self, leaf: u32) -> Triangle<V> {
        Triangle(Mesh::triangle(self, leaf as usize))
    }
}

/// By their places in the hierarchy.
impl<V: Vector> Shapes<V> for Bvh<Triangle<V>> {
    fn prim(&self, leaf: u32) -> u32 {
        self.triangles()[leaf as usize].prim
    }

    fn triangle(&self, leaf: u32) -> Triangle<V> {
        self.triangles()[leaf as usize].shape
    }
}

/// What is below a node.
enum Below {
    Node(Node),
    /// Triangles of a leaf that is halved.
    Part(Range<usize>),
}

/// That of a binary hierarchy, whose leaves are halved until they hold one triangle.
pub(super) fn draft_of<V: Vector>(bvh: &Bvh<Triangle<V>>) -> Result<Draft, BuildError> {
    let mut nodes = room(2 * bvh.triangles().len() - 1)?;
    nodes.push(Record::NONE);
    let mut pending = vec![(Below::Node(bvh.root()), bvh.bounds(), 0)];
    while let Some((below, aabb, place)) = pending.pop() {
        let halves = match below {
            Below::Node(node) if !node.is_leaf() => {
                let boxes = [Side::Left, Side::Right].map(|side| bvh.node(node.index()).child_box(side));
                let [left, right] = bvh.children(node).map(Below::Node);
                [(left, boxes[0]), (right, boxes[1])]
            }
            Below::Node(leaf) => {
                pending.push((Below::Part(bvh.leaf_range(leaf)), aabb, place));
                continue;
            }
            Below::Part(Range { start, end }) if end == start + 1 => {
                nodes[place] = Record::item(&aabb, start as u32);
                continue;
            }
            Below::Part(Range { start, end }) => {
                let middle = start + (end - start) / 2;
                [start..middle, middle..end].map(|part| {
                    // A leaf's box may hold only parts of its triangles: then other leaves hold the others.
                    let held = bvh.triangles()[part.clone()].iter().map(|held| bvh.frame().aabb(&held.shape));
                    (Below::Part(part), held.fold(Aabb::EMPTY, Aabb::union).intersection(&aabb))
                })
            }
        };
        let first = nodes.len();
        nodes[place] = Record::item(&aabb, first as u32).holding(2);
        nodes.extend([Record::NONE; 2]);
        let [(left, left_box), (right, right_box)] = halves;
        pending.extend([(right, right_box, first + 1), (left, left_box, first)]);
    }
    Ok(Draft::counted(nodes, bvh.duplicates() > 0))
}
