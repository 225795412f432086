//! Validation of wide hierarchies.

use std::ops::Range;

use super::{MAX_COUNT, WideBvh, WideNode, leaf_parts};
use crate::bvh::cover;
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, Mesh, Region, Triangle};
use crate::tree::Node;

/// Errors of [`WideBvh::validate`], with their location: the index of an inner node, and a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WideBvhError {
    /// There is no root, or there are more nodes or blocks than addresses can represent.
    #[error("{nodes} nodes and {blocks} blocks cannot be addressed")]
    Size {
        /// Number of inner nodes.
        nodes: usize,
        /// Number of blocks.
        blocks: usize,
    },
    /// A child does not exist, does not come after its parent, or is reached twice.
    #[error("node {node}, slot {slot}: {child:?} is no child of it alone")]
    Child {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
        /// Its child.
        child: Node,
    },
    /// An inner node other than the root has no children.
    #[error("node {0} has no children")]
    Childless(usize),
    /// A node is not reached from the root.
    #[error("node {0} is not reached from the root")]
    Unreached(usize),
    /// A block is in no leaf.
    #[error("block {0} is in no leaf")]
    UnreachedBlock(usize),
    /// An empty slot has a box that a ray might meet.
    #[error("node {node}, slot {slot}: a box without a child")]
    EmptySlot {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
    },
    /// A box has a NaN, or its `lo` is above its `hi` on some axis.
    #[error("node {node}, slot {slot}: the box has no points")]
    NoBox {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
    },
    /// A box of a child extends beyond the node's own box.
    #[error("node {node}, slot {slot}: the box is not inside the node's")]
    Nesting {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
    },
    /// A node's ancestors are wrong.
    #[error("node {0} names other ancestors than its own")]
    Ancestors(usize),
    /// A node's set of slots with leaves is wrong.
    #[error("node {0} has its leaves in other slots than it says")]
    Leaves(usize),
    /// A leaf holds no triangle.
    #[error("node {node}, slot {slot}: the leaf is empty")]
    EmptyLeaf {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
    },
    /// A leaf's triangle is not one of the mesh: its index is out of range, or its corners differ.
    #[error("node {node}, slot {slot}: triangle {prim} is not that of the mesh")]
    Triangle {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
        /// Index in the mesh.
        prim: u32,
    },
    /// A corner of a triangle is infinite or not a number.
    #[error("node {node}, slot {slot}: triangle {prim} has a corner that is not finite")]
    NotFinite {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
        /// Index in the mesh.
        prim: u32,
    },
    /// Leaves hold triangles of the same index with different corners.
    #[error("triangle {0} has different corners in different leaves")]
    Differs(u32),
    /// The stored length of a triangle's edges is not that of its corners.
    #[error("node {node}, slot {slot}: triangle {prim} has edges of another length")]
    Edge {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
        /// Index in the mesh.
        prim: u32,
    },
    /// A lane beyond the triangles of a leaf is not empty.
    #[error("node {node}, slot {slot}: a lane beyond its triangles is not empty")]
    Padding {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
    },
    /// A leaf holds a triangle twice.
    #[error("node {node}, slot {slot}: triangle {prim} is there twice")]
    Twice {
        /// The inner node.
        node: usize,
        /// The slot.
        slot: u32,
        /// Index in the mesh.
        prim: u32,
    },
    /// The boxes of all leaves that hold a triangle do not cover it together.
    #[error("triangle {0} is not covered by the boxes of its leaves")]
    Uncovered(u32),
    /// A triangle of the mesh that can be hit is in no leaf.
    #[error("triangle {0} is in no leaf")]
    Missing(u32),
    /// The hierarchy was built over another number of triangles.
    #[error("made over {stored} triangles, not {found}")]
    Triangles {
        /// The number in the hierarchy.
        stored: usize,
        /// Triangles of the mesh.
        found: usize,
    },
    /// The stored number of references beyond the first to each triangle is wrong.
    #[error("{found} references are to triangles of other leaves, not {stored}")]
    Duplicates {
        /// The number in the hierarchy.
        stored: usize,
        /// The actual number.
        found: usize,
    },
    /// The stored level of the deepest inner node is wrong, or above the limit.
    #[error("the deepest inner node is at level {found}, not {stored}")]
    Levels {
        /// The number in the hierarchy.
        stored: u32,
        /// The actual number.
        found: u32,
    },
    /// The region does not contain all triangles.
    #[error("the region does not hold all triangles")]
    Region,
}

/// A triangle in a leaf: its index, the node and the slot, and its place.
type Reference = (u32, u32, u32, usize);

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// Checks that the hierarchy is sound and holds each triangle of the mesh (degenerate triangles may be missing).
    ///
    /// A sound hierarchy has nested boxes, reaches each node and each block once, and has correct ancestors, correct
    /// sets of leaves and the stated level. Lanes beyond the triangles of a leaf are empty. The boxes of the leaves
    /// that hold a triangle cover it: one of them covers all of it or, in exact arithmetic, all of them together do.
    ///
    /// # Errors
    /// The first node error; otherwise the error of the first triangle.
    pub fn validate(&self, mesh: &Mesh<V>) -> Result<(), WideBvhError> {
        self.check(Some(mesh))
    }

    /// Checks the hierarchy, or without a mesh only that it is sound.
    pub(super) fn check(&self, mesh: Option<&Mesh<V>>) -> Result<(), WideBvhError> {
        let (nodes, blocks) = (self.nodes.len(), self.blocks.len());
        if nodes == 0 || nodes > Self::MAX_NODES || blocks > Self::MAX_BLOCKS {
            return Err(WideBvhError::Size { nodes, blocks });
        }
        let found = mesh.map_or(self.triangles, |mesh| mesh.triangles().len());
        if self.triangles != found {
            return Err(WideBvhError::Triangles { stored: self.triangles, found });
        }
        let mut references = Walk::new(self, mesh).all()?;
        references.sort_unstable();
        self.check_references(mesh, &references)
    }

    fn check_references(&self, mesh: Option<&Mesh<V>>, references: &[Reference]) -> Result<(), WideBvhError> {
        for &[(prim, node, slot, _), (next, next_node, next_slot, _)] in references.array_windows() {
            if (next, next_node, next_slot) == (prim, node, slot) {
                return Err(WideBvhError::Twice { node: node as usize, slot, prim });
            }
        }
        let frame = self.region.frame();
        let (mut around, mut duplicates) = (Aabb::EMPTY, 0);
        let mut next = 0;
        for held in references.chunk_by(|a, b| a.0 == b.0) {
            let (prim, _, _, place) = held[0];
            duplicates += held.len() - 1;
            check_left_out(mesh, next..prim)?;
            next = prim + 1;
            let triangle = self.triangle(place);
            if held.iter().any(|&(.., place)| self.triangle(place) != triangle) {
                return Err(WideBvhError::Differs(prim));
            }
            let boxes: Vec<_> =
                held.iter().map(|&(_, node, slot, _)| self.nodes[node as usize].child_box(slot)).collect();
            if !boxes.iter().any(|aabb| aabb.encloses(&frame.aabb(&triangle))) && !cover::hold(frame, &boxes, &triangle)
            {
                return Err(WideBvhError::Uncovered(prim));
            }
            around = around.union(frame.aabb(&triangle));
        }
        check_left_out(mesh, next..self.triangles as u32)?;
        if duplicates != self.duplicates {
            return Err(WideBvhError::Duplicates { stored: self.duplicates, found: duplicates });
        }
        let needed = Region::within(*frame, &around);
        let holds = self.region.reach() >= needed.reach() && self.region.size() >= needed.size();
        if references.is_empty() || holds { Ok(()) } else { Err(WideBvhError::Region) }
    }
}

/// Checks that no ray can hit any of these triangles.
fn check_left_out<V: Precision>(mesh: Option<&Mesh<V>>, prims: Range<u32>) -> Result<(), WideBvhError> {
    let Some(mesh) = mesh else { return Ok(()) };
    let can_be_hit = |&prim: &u32| !Triangle(mesh.triangle(prim as usize)).is_degenerate();
    prims.into_iter().find(can_be_hit).map_or(Ok(()), |prim| Err(WideBvhError::Missing(prim)))
}

/// The state of the check of nodes. A child comes after its parent, so one pass in order reaches all nodes.
struct Walk<'a, V: Precision, const A: usize> {
    wide: &'a WideBvh<A, V>,
    mesh: Option<&'a Mesh<V>>,
    /// For each reached node, its own box and its level.
    reached: Vec<Option<(Aabb, u32)>>,
    in_leaf: Vec<bool>,
    references: Vec<Reference>,
}

impl<'a, V: Precision, const A: usize> Walk<'a, V, A> {
    fn new(wide: &'a WideBvh<A, V>, mesh: Option<&'a Mesh<V>>) -> Self {
        let everything = Aabb { lo: -glam::Vec3::INFINITY, hi: glam::Vec3::INFINITY };
        let mut reached = vec![None; wide.nodes.len()];
        reached[0] = Some((everything, 0));
        Self { wide, mesh, reached, in_leaf: vec![false; wide.blocks.len()], references: Vec::new() }
    }

    fn all(mut self) -> Result<Vec<Reference>, WideBvhError> {
        let mut levels = 0;
        if self.wide.nodes[0].ancestors.map(|bits| bits << 8) != [0; A] {
            return Err(WideBvhError::Ancestors(0));
        }
        for index in 0..self.wide.nodes.len() {
            let (aabb, level) = self.reached[index].ok_or(WideBvhError::Unreached(index))?;
            levels = levels.max(level);
            self.node(index, &aabb, level)?;
        }
        if let Some(block) = self.in_leaf.iter().position(|is_held| !is_held) {
            return Err(WideBvhError::UnreachedBlock(block));
        }
        if levels != self.wide.levels || levels > WideBvh::<A>::MAX_LEVEL {
            return Err(WideBvhError::Levels { stored: self.wide.levels, found: levels });
        }
        Ok(self.references)
    }

    fn node(&mut self, index: usize, aabb: &Aabb, level: u32) -> Result<(), WideBvhError> {
        let (node, mut leaves) = (&self.wide.nodes[index], 0);
        for slot in 0..A as u32 {
            let own = node.child_box(slot);
            if !node.has_child(slot) {
                let is_empty = own == WideNode::<A>::EMPTY.child_box(slot);
                if is_empty {
                    continue;
                }
                return Err(WideBvhError::EmptySlot { node: index, slot });
            }
            if !own.lo.cmple(own.hi).all() {
                return Err(WideBvhError::NoBox { node: index, slot });
            }
            if !aabb.encloses(&own) {
                return Err(WideBvhError::Nesting { node: index, slot });
            }
            let child = node.child(slot);
            if child.is_leaf() {
                leaves |= 1 << slot;
                self.leaf(index, slot)?;
            } else {
                self.inner(index, slot)?;
                self.reached[child.index()] = Some((own, level + 1));
            }
        }
        if node.leaves() != leaves {
            return Err(WideBvhError::Leaves(index));
        }
        if index > 0 && node.children == [0; A] { Err(WideBvhError::Childless(index)) } else { Ok(()) }
    }

    fn inner(&self, index: usize, slot: u32) -> Result<(), WideBvhError> {
        let node = &self.wide.nodes[index];
        let child = node.child(slot);
        let below = match self.reached.get(child.index()) {
            Some(None) if child.index() > index => &self.wide.nodes[child.index()],
            _ => return Err(WideBvhError::Child { node: index, slot, child }),
        };
        let expected = |levels: u32| if levels == 1 { Node::inner(index as u32) } else { node.ancestor(levels - 1) };
        let is_right = (1..=A as u32).all(|levels| below.ancestor(levels) == expected(levels));
        let is_clean = below.ancestors[1..].iter().all(|bits| bits >> super::ANCESTOR_BITS == 0);
        if is_right && is_clean { Ok(()) } else { Err(WideBvhError::Ancestors(child.index())) }
    }

    fn leaf(&mut self, node: usize, slot: u32) -> Result<(), WideBvhError> {
        let child = self.wide.nodes[node].child(slot);
        let (first, count) = leaf_parts(child);
        if !(1..=MAX_COUNT).contains(&count) {
            return Err(WideBvhError::EmptyLeaf { node, slot });
        }
        for (i, left) in (first..).zip((1..=count).rev().step_by(4)) {
            match self.in_leaf.get_mut(i) {
                Some(in_leaf) if !*in_leaf => *in_leaf = true,
                _ => return Err(WideBvhError::Child { node, slot, child }),
            }
            let (block, mut expected) = (&self.wide.blocks[i], Block::EMPTY);
            for lane in 0..left.min(4) as usize {
                let (prim, triangle) = (block.prims[lane], block.triangle(lane));
                let is_other = |mesh: &Mesh<V>| Triangle(mesh.triangle(prim as usize)) != triangle;
                if prim as usize >= self.wide.triangles || self.mesh.is_some_and(is_other) {
                    return Err(WideBvhError::Triangle { node, slot, prim });
                }
                if !triangle.0.iter().all(|corner| corner.is_finite()) {
                    return Err(WideBvhError::NotFinite { node, slot, prim });
                }
                expected.set(lane, &triangle, prim);
                if block.edges[lane] != expected.edges[lane] {
                    return Err(WideBvhError::Edge { node, slot, prim });
                }
                self.references.push((prim, node as u32, slot, 4 * i + lane));
            }
            if *block != expected {
                return Err(WideBvhError::Padding { node, slot });
            }
        }
        Ok(())
    }
}
