//! The input tree of the collapse, with a node for each triangle or for each leaf, and the leaves that result.

use std::ops::Range;

use fearless_simd::Simd;

use super::{BLOCK_BITS, WideBvh, WideNode};
use crate::bvh::build::{Draft, Record, Rounds, filled, merge, room, scale};
use crate::bvh::{BuildError, BuildOptions, Bvh};
use crate::geom::lanes::{Block, Precision, levels, vectorize};
use crate::geom::{Aabb, Mesh, Triangle, Vector};
use crate::order::Side;
use crate::tree::{Node, Topology};

/// The shapes that the leaves of a draft refer to.
pub(super) trait Shapes<V: Precision>: Sync {
    /// Writes a leaf with these shapes, each triangle once, and returns its address. `leaves` then has the shapes in
    /// it.
    fn write(&self, leaves: &mut Vec<u32>, has_parts: bool, blocks: &mut Vec<Block<V>>) -> Node;
}

/// Identified by their index in the mesh.
impl<V: Precision> Shapes<V> for Mesh<V> {
    #[inline(always)]
    fn write(&self, leaves: &mut Vec<u32>, has_parts: bool, blocks: &mut Vec<Block<V>>) -> Node {
        write(leaves, has_parts, blocks, |leaf| leaf, |leaf| Triangle(self.triangle(leaf as usize)))
    }
}

/// Identified by their places in the hierarchy.
impl<V: Precision> Shapes<V> for Bvh<Triangle<V>> {
    fn write(&self, leaves: &mut Vec<u32>, has_parts: bool, blocks: &mut Vec<Block<V>>) -> Node {
        let held = |leaf: u32| &self.triangles()[leaf as usize];
        write(leaves, has_parts, blocks, |leaf| held(leaf).prim, |leaf| held(leaf).shape)
    }
}

/// Leaves of a wide hierarchy, which do not change.
impl<V: Precision> Shapes<V> for Vec<Node> {
    fn write(&self, leaves: &mut Vec<u32>, _: bool, _: &mut Vec<Block<V>>) -> Node {
        self[leaves[0] as usize]
    }
}

#[inline(always)]
fn write<V: Precision>(
    leaves: &mut Vec<u32>,
    has_parts: bool,
    blocks: &mut Vec<Block<V>>,
    prim: impl Fn(u32) -> u32,
    triangle: impl Fn(u32) -> Triangle<V>,
) -> Node {
    if has_parts {
        leaves.sort_by_key(|&leaf| prim(leaf));
        leaves.dedup_by_key(|leaf| prim(*leaf));
    }
    let first = blocks.len();
    for leaves in leaves.chunks(4) {
        let mut block = Block::EMPTY;
        for (lane, &leaf) in leaves.iter().enumerate() {
            block.set(lane, &triangle(leaf), prim(leaf));
        }
        blocks.push(block);
    }
    Node::leaf((leaves.len() as u32) << BLOCK_BITS | first as u32)
}

/// The contents below a node.
enum Below {
    Node(Node),
    /// Triangles of a leaf that is halved.
    Part(Range<usize>),
}

/// Returns the draft of a binary hierarchy, whose leaves are halved until they hold one triangle.
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
                    // A leaf's box may hold only parts of its triangles: then other leaves hold the other parts.
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

/// Returns the draft of a wide hierarchy, with a node for each of its leaves, and these leaves. Children of a node are
/// merged from the bottom up, and then subtrees are moved.
pub(super) fn draft_over_leaves<const A: usize, V: Precision>(
    wide: &WideBvh<A, V>,
) -> Result<(Draft, Vec<Node>), BuildError> {
    let count = wide.leaf_boxes().count();
    let (mut leaves, mut items) = (room(count)?, room(count)?);
    for (leaf, aabb) in wide.leaf_boxes() {
        items.push(Record::item(&aabb, leaves.len() as u32));
        leaves.push(leaf);
    }
    let is_scaled = scale(&mut items);
    let nodes = vectorize!(levels()[0].1, simd => merged(simd, wide, &items))?;
    let draft = Draft::counted(nodes, false).improved(Rounds::SEVERAL, BuildOptions::fine().sah, &|_| ())?;
    let draft = if is_scaled {
        let boxes: Vec<_> = wide.leaf_boxes().map(|(_, aabb)| aabb).collect();
        draft.fitted(|leaf| boxes[leaf as usize])?
    } else {
        draft
    };
    Ok((draft, leaves))
}

/// Returns the nodes of a draft over these leaves, without counts of primitives.
#[inline(always)]
fn merged<S: Simd, const A: usize, V: Precision>(
    simd: S,
    wide: &WideBvh<A, V>,
    leaves: &[Record],
) -> Result<Vec<Record>, BuildError> {
    let count = wide.nodes.len();
    // For each node, first the box, from the bottom up, then the place, from the top down. An item for an inner node
    // has its index, after those of leaves.
    let (mut boxes, mut places) = (filled(Record::NONE, count)?, filled(0, count)?);
    let inner = |index: usize| (leaves.len() + index) as u32;
    let mut next = leaves.len();
    for (index, node) in wide.nodes.iter().enumerate().rev() {
        next -= node.leaves().count_ones() as usize;
        let (children, count) = items(node, &leaves[next..], &boxes);
        boxes[index] = Record::around(&children[..count], inner(index));
    }
    let mut nodes = room(2 * leaves.len() - 1)?;
    nodes.push(Record::NONE);
    for (index, node) in wide.nodes.iter().enumerate() {
        let (children, count) = items(node, &leaves[next..], &boxes);
        next += node.leaves().count_ones() as usize;
        let (place, first) = (places[index] as usize, nodes.len());
        if count == 1 {
            nodes[place] = children[0];
        } else {
            nodes.resize(first + 2 * count - 2, Record::NONE);
            merge(simd, &children[..count], &mut nodes[first..], first as u32);
            nodes[place] = Record::parent([&nodes[first], &nodes[first + 1]], first as u32);
        }
        for place in (first..nodes.len()).chain([place]) {
            let item = &nodes[place];
            if item.is_leaf() && item.first() >= inner(0) {
                places[item.first() as usize - leaves.len()] = place as u32;
            }
        }
    }
    Ok(nodes)
}

/// Returns the children of a node, whose first leaf is the first of `leaves`, and their number.
#[inline(always)]
fn items<const A: usize>(node: &WideNode<A>, mut leaves: &[Record], boxes: &[Record]) -> ([Record; A], usize) {
    let (mut made, mut count) = ([Record::NONE; A], 0);
    for slot in (0..A as u32).filter(|&slot| node.has_child(slot)) {
        made[count] = match (node.child(slot), leaves) {
            (child, [leaf, rest @ ..]) if child.is_leaf() => {
                leaves = rest;
                *leaf
            }
            (child, _) => boxes[child.index()],
        };
        count += 1;
    }
    (made, count)
}
