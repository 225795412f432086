//! The boundary of a mesh, which is the set of open edges.
//!
//! # Idea
//!
//! The edges of all faces, each with the number of faces that share it, are a chain. A surface is closed if the chain
//! covers each point of each line an even number of times, except the ends of edges, for every position of the vertices:
//! a vertex may lie in the middle of a neighbour's edge (a T-junction). On one line, a bounded chain covers all these
//! points an even number of times if and only if every point is the end of an even number of its edges. So it suffices to visit each vertex, and to
//! sort the edges that end there by their lines. The same holds with signs: a surface is oriented if the edges cover
//! every point equally often in both directions. `[CLOSED-1]`
//!
//! # Cost
//!
//! Two sorts, of vertices by coordinates and of edges by ends. Lines are compared, exactly, only for edges that an odd
//! number of faces share.

mod border_tree;

use std::cmp::Ordering;
use std::sync::OnceLock;

use glam::DVec3;

use crate::geom::{Mesh, Vector, order_of_lines};
use crate::threads;
use border_tree::BorderTree;

/// Topology of the edges of a mesh. Vertices of equal coordinates are one vertex.
///
/// ```
/// use stackless_bvh::geom::Mesh;
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::trace::Boundary;
///
/// // A tetrahedron. A vertex in the middle of an edge divides one face.
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::X * 0.5];
/// let cut = Mesh::new(corners.clone(), vec![[0, 2, 4], [4, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// assert!(Boundary::of(&cut).is_closed() && Boundary::of(&cut).is_oriented());
/// let open = Mesh::new(corners, vec![[4, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let boundary = Boundary::of(&open);
/// assert_eq!((boundary.open, boundary.first.map(|edge| edge.face)), (4, Some(0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Edges with an end at which the covering of their line changes between even and odd.
    pub open: usize,
    /// Edges with an end at which the difference of both directions changes.
    pub unpaired: usize,
    /// Faces with the vertices of an earlier face.
    pub repeated: usize,
    /// An open edge of the first face with one.
    pub first: Option<OpenEdge>,
    /// The edges that more faces traverse in one direction than in the other; none if the mesh is oriented.
    pub borders: Vec<Border>,
    /// The least and the greatest coordinates of all corners of faces; infinite if there are no faces.
    pub bounds: [DVec3; 2],
    /// Built on first use.
    tree: OnceLock<BorderTree>,
}

/// An edge on the border of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Border {
    /// The vertices, in the direction of the faces.
    pub ends: [u32; 2],
    /// Number of faces in this direction less the number in the other, at least 1.
    pub faces: u32,
}

/// An edge at which a surface ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenEdge {
    /// Index of a face.
    pub face: usize,
    /// The vertices, in the direction of the face.
    pub ends: [u32; 2],
    /// Number of faces with these two vertices.
    pub faces: u32,
}

impl Boundary {
    /// Examines all edges of all faces, including faces without an area.
    pub fn of<V: Vector>(mesh: &Mesh<V>) -> Self {
        let welded = welded(mesh.vertices());
        let mut edges: Vec<_> = directed(mesh.triangles(), &welded).collect();
        threads::sort_by(&mut edges, u64::cmp);
        let shares = edges.chunk_by(|a, b| a >> 1 == b >> 1).map(Share::of);
        let odd = shares.clone().filter(|share| share.faces % 2 == 1);
        let odd = uneven(mesh, &odd.collect::<Vec<_>>(), |_| [1, 1], |sum| sum % 2 == 0);
        let one_sided: Vec<_> = shares.filter(|share| share.net != 0).collect();
        let unpaired = uneven(mesh, &one_sided, |share| [-share.net, share.net], |sum| sum == 0).len();
        // If other edges on their line compensate all of them, there is no border.
        let borders = if unpaired > 0 { one_sided.iter().map(Share::border).collect() } else { Vec::new() };
        let first = first(mesh.triangles(), &welded, &odd);
        let corners = mesh.triangles().iter().flatten().map(|&corner| mesh.vertices()[corner as usize].widen());
        let bounds = corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], p| [lo.min(p), hi.max(p)]);
        let repeated = repeated(mesh.triangles(), &welded);
        Self { open: odd.len(), unpaired, repeated, first, borders, bounds, tree: OnceLock::new() }
    }

    /// Returns the hierarchy of the borders. The vertices must be those of the mesh. No thread waits for another thread to
    /// build it: after a fork, the child does not have that thread.
    pub(super) fn tree<V: Vector>(&self, vertices: &[V]) -> &BorderTree {
        self.tree.get().unwrap_or_else(|| {
            let tree = BorderTree::new(&self.borders, |vertex| vertices[vertex as usize].widen());
            self.tree.get_or_init(|| tree)
        })
    }

    /// Returns whether the surface is closed: parity then defines an inside.
    pub const fn is_closed(&self) -> bool {
        self.open == 0
    }

    /// Finds the shortest path along an axis from a point to the outside of the bounds: its length and its direction.
    /// The length is negative outside.
    pub(super) fn exit(&self, point: DVec3) -> (f64, [i8; 3]) {
        let [lo, hi] = self.bounds;
        let lengths = [hi - point, point - lo].map(|lengths| lengths.to_array()).into_iter().flatten();
        let exits = lengths.zip([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]);
        exits.reduce(|least, exit| if exit.0 < least.0 { exit } else { least }).unwrap_or((-1.0, [1, 0, 0]))
    }

    /// Returns whether the faces traverse every edge equally often in both directions: the winding number is an
    /// integer.
    pub const fn is_oriented(&self) -> bool {
        self.unpaired == 0
    }
}

/// An edge, by its two vertices.
#[derive(Clone, Copy)]
struct Share {
    /// The lesser end times 2^31, and the greater end.
    edge: u64,
    /// Number of faces that share it.
    faces: u32,
    /// Number of faces that traverse it from the lesser end to the greater, less the number in the other direction.
    net: i32,
}

impl Share {
    /// Combines edges of faces with the same ends.
    fn of(edges: &[u64]) -> Self {
        let backward = edges.iter().filter(|&edge| edge & 1 == 1).count();
        Self { edge: edges[0] >> 1, faces: edges.len() as u32, net: edges.len() as i32 - 2 * backward as i32 }
    }

    const fn ends(&self) -> [u32; 2] {
        [(self.edge >> 31) as u32, (self.edge & 0x7FFF_FFFF) as u32]
    }

    const fn border(&self) -> Border {
        let [lesser, greater] = self.ends();
        let ends = if self.net > 0 { [lesser, greater] } else { [greater, lesser] };
        Border { ends, faces: self.net.unsigned_abs() }
    }
}

/// An end of an edge: the vertex, the other vertex, the contribution of the edge there, and its index.
type End = (u32, u32, i32, u32);

/// Returns the edges with an end at which the contributions of the edges on their line are not even. `weights` are
/// those at the lesser end and at the greater end.
fn uneven<V: Vector>(
    mesh: &Mesh<V>,
    shares: &[Share],
    weights: impl Fn(&Share) -> [i32; 2],
    is_even: impl Fn(i64) -> bool,
) -> Vec<Share> {
    let at = |vertex: u32| mesh.vertices()[vertex as usize].widen();
    let mut ends: Vec<End> = Vec::with_capacity(2 * shares.len());
    for (share, i) in shares.iter().zip(0..) {
        let ([lesser, greater], [first, second]) = (share.ends(), weights(share));
        ends.extend([(lesser, greater, first, i), (greater, lesser, second, i)]);
    }
    threads::sort_by(&mut ends, Ord::cmp);
    let mut is_uneven = vec![false; shares.len()];
    for fan in ends.chunk_by_mut(|a, b| a.0 == b.0) {
        let vertex = at(fan[0].0);
        let lines = |a: &End, b: &End| order_of_lines(vertex, [at(a.1), at(b.1)]);
        fan.sort_unstable_by(lines);
        for line in fan.chunk_by(|a, b| lines(a, b) == Ordering::Equal) {
            if !is_even(line.iter().map(|end| i64::from(end.2)).sum()) {
                for end in line {
                    is_uneven[end.3 as usize] = true;
                }
            }
        }
    }
    shares.iter().zip(is_uneven).filter_map(|(&share, is_uneven)| is_uneven.then_some(share)).collect()
}

/// Returns for each vertex the first vertex of its coordinates.
fn welded<V: Vector>(vertices: &[V]) -> Vec<u32> {
    // Zeros of both signs are one number. Doubles represent single precision exactly.
    let key = |v: &V| v.widen().to_array().map(|x| (x + 0.0).to_bits());
    let mut order: Vec<_> = vertices.iter().zip(0_u32..).map(|(v, i)| (key(v), i)).collect();
    threads::sort_by(&mut order, Ord::cmp);
    let mut welded = vec![0; vertices.len()];
    for same in order.chunk_by(|(a, _), (b, _)| a == b) {
        for (_, vertex) in same {
            welded[*vertex as usize] = same[0].1;
        }
    }
    welded
}

/// Returns every edge of every face.
fn directed(faces: &[[u32; 3]], welded: &[u32]) -> impl Iterator<Item = u64> {
    faces.iter().flat_map(|&face| ends(face)).filter_map(|ends| packed(ends, welded))
}

/// Packs the lesser end, the greater end and the direction into 31 bits, 31 bits and one bit. `None` if the ends are
/// one point.
fn packed(ends: [u32; 2], welded: &[u32]) -> Option<u64> {
    let [from, to] = ends.map(|vertex| u64::from(welded[vertex as usize]));
    (from != to).then(|| from.min(to) << 32 | from.max(to) << 1 | u64::from(to < from))
}

fn ends([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Returns an open edge of the first face with one.
fn first(faces: &[[u32; 3]], welded: &[u32], open: &[Share]) -> Option<OpenEdge> {
    if open.is_empty() {
        return None;
    }
    faces.iter().enumerate().find_map(|(face, &corners)| {
        ends(corners).into_iter().find_map(|ends| {
            let edge = packed(ends, welded)? >> 1;
            // They are sorted.
            let at = open.binary_search_by_key(&edge, |share| share.edge).ok()?;
            Some(OpenEdge { face, ends, faces: open[at].faces })
        })
    })
}

/// Counts the faces with the vertices of an earlier face, in any order.
fn repeated(faces: &[[u32; 3]], welded: &[u32]) -> usize {
    let mut sorted: Vec<_> = faces.iter().map(|face| face.map(|vertex| welded[vertex as usize])).collect();
    for face in &mut sorted {
        face.sort_unstable();
    }
    threads::sort_by(&mut sorted, Ord::cmp);
    sorted.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

#[cfg(test)]
mod tests;
