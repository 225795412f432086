//! Construction from the top down, without recursion.
//!
//! A builder is a function that cuts a range of triangles in two or makes it a leaf; this file does the rest. The
//! same mesh and options give the same tree.

mod median;
mod sah;

pub use sah::SahOptions;

use glam::Vec3A;

use super::{Bvh, BvhNode, Leaf, LeafTriangle};
use crate::geom::{Aabb, Region, Triangle, Vector};
use crate::scene::Mesh;
use crate::tree::{Node, Recorded};

/// Why a hierarchy cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// There is nothing to build from.
    #[error("the mesh has no triangles")]
    Empty,
    /// More triangles than leaves can be addressed.
    #[error("{0} triangles are more than the {max} that a tree can hold", max = Node::MAX_INDEX)]
    TooManyTriangles(usize),
    /// A leaf must hold a triangle.
    #[error("leaves of 0 triangles were asked for")]
    ZeroLeafSize,
    /// The number of bins is too small to split with, or absurdly great.
    #[error("{0} bins are not between 2 and {max}", max = SahOptions::MAX_BINS)]
    Bins(u32),
    /// A tree within the limit has too few leaves.
    #[error("{triangles} triangles do not fit in leaves of {max_leaf} at a depth of at most {limit}")]
    DepthLimit {
        /// Triangles of the mesh.
        triangles: usize,
        /// Triangles that a leaf may hold.
        max_leaf: u32,
        /// Greatest depth, in edges.
        limit: u32,
    },
}

/// A triangle while it is sorted: its box and its index in the mesh.
#[derive(Clone, Copy, Debug)]
struct Item {
    lo: Vec3A,
    hi: Vec3A,
    prim: u32,
}

impl Item {
    fn new<V: Vector>(corners: [V; 3], prim: u32) -> Self {
        let Aabb { lo, hi } = Triangle(corners).aabb();
        Self { lo: lo.into(), hi: hi.into(), prim }
    }

    /// Middle of the box. It does not overflow.
    #[inline]
    fn centroid(&self) -> Vec3A {
        self.lo * 0.5 + self.hi * 0.5
    }
}

/// A cut of a range that has been reordered: the `left` first items have the smaller centroids on `axis`.
#[derive(Clone, Copy, Debug)]
struct Cut {
    axis: usize,
    left: usize,
}

/// A range of items whose node is still to be made, and the place that waits for its address.
struct Pending {
    first: usize,
    end: usize,
    depth: u32,
    parent: Option<(usize, usize)>,
}

/// All triangles that can be hit. No ray meets a degenerate one, so those are left out.
fn items<V: Vector>(mesh: &Mesh<V>) -> Result<Vec<Item>, BuildError> {
    match mesh.triangles().len() {
        0 => Err(BuildError::Empty),
        n if n > Node::MAX_INDEX as usize => Err(BuildError::TooManyTriangles(n)),
        n => {
            let item = |i: usize| Item::new(mesh.triangle(i), i as u32);
            let items: Vec<_> = (0..n).filter(|&i| !Triangle(mesh.triangle(i)).is_degenerate()).map(item).collect();
            // A tree has at least one leaf, even if nothing can be hit.
            Ok(if items.is_empty() { vec![item(0)] } else { items })
        }
    }
}

/// Builds with `cut`, which gets a range and its depth, and reorders it, or returns `None` for a leaf.
fn build<V: Vector>(
    mesh: &Mesh<V>,
    mut items: Vec<Item>,
    mut cut: impl FnMut(&mut [Item], u32) -> Option<Cut>,
) -> Bvh<Triangle<V>> {
    let mut bvh = Bvh {
        root: Node::leaf(0),
        depth: 0,
        dropped: mesh.triangles().len() - items.len(),
        recorded: Recorded::Nothing,
        bounds: Aabb::EMPTY,
        region: Region::of(&Aabb::EMPTY),
        nodes: Vec::new(),
        axes: Vec::new(),
        leaves: Vec::new(),
        triangles: Vec::with_capacity(items.len()),
    };
    let mut pending = vec![Pending { first: 0, end: items.len(), depth: 0, parent: None }];
    while let Some(Pending { first, end, depth, parent }) = pending.pop() {
        let range = &mut items[first..end];
        let node = if let Some(Cut { axis, left }) = cut(range, depth) {
            let i = bvh.nodes.len();
            bvh.nodes.push(BvhNode { planes: [[0.0; 4]; 3], children: [Node::leaf(0); 2], links: [Node::leaf(0); 2] });
            bvh.axes.push(axis as u8);
            let middle = first + left;
            // The left child is made next.
            pending.push(Pending { first: middle, end, depth: depth + 1, parent: Some((i, 1)) });
            pending.push(Pending { first, end: middle, depth: depth + 1, parent: Some((i, 0)) });
            Node::inner(i as u32)
        } else {
            let first = bvh.triangles.len() as u32;
            let leaf = Leaf { first, count: range.len() as u32, links: [Node::leaf(0); 2] };
            bvh.leaves.push(leaf);
            bvh.triangles.extend(
                range
                    .iter()
                    .map(|item| LeafTriangle { shape: Triangle(mesh.triangle(item.prim as usize)), prim: item.prim }),
            );
            Node::leaf(bvh.leaves.len() as u32 - 1)
        };
        bvh.depth = bvh.depth.max(depth);
        match parent {
            Some((i, side)) => bvh.nodes[i].children[side] = node,
            None => bvh.root = node,
        }
    }
    bvh.fit();
    bvh.with_links(Recorded::Uncles)
}

/// Cuts at the exact middle of the count, along the axis on which the centroids spread most.
///
/// The order is total (centroid, then index), so equal centroids are no trouble. The range needs two items.
fn halve(items: &mut [Item]) -> Cut {
    let axis = widest(spread(items).extent());
    let left = items.len() / 2;
    items.select_nth_unstable_by(left, |a, b| {
        let by_centroid = a.centroid()[axis].total_cmp(&b.centroid()[axis]);
        by_centroid.then(a.prim.cmp(&b.prim))
    });
    Cut { axis, left }
}

/// A box while it grows, in SIMD registers.
#[derive(Clone, Copy, Debug)]
struct Spread {
    lo: Vec3A,
    hi: Vec3A,
}

impl Spread {
    const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    #[inline]
    fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    #[inline]
    fn extent(self) -> Vec3A {
        self.hi - self.lo
    }

    #[inline]
    fn half_area(self) -> f32 {
        Aabb { lo: self.lo.into(), hi: self.hi.into() }.half_area()
    }
}

/// Box of the centroids.
fn spread(items: &[Item]) -> Spread {
    items.iter().map(Item::centroid).fold(Spread::EMPTY, |s, c| s.union(Spread { lo: c, hi: c }))
}

/// Axis of the greatest component, the first of equals.
fn widest(extent: Vec3A) -> usize {
    let later_wins = |best: usize, axis: usize| if extent[axis] > extent[best] { axis } else { best };
    later_wins(later_wins(0, 1), 2)
}
