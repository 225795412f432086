//! Whether a mesh is closed, so that it has an inside.

use std::collections::HashMap;

use rayon::prelude::*;
use stackless_bvh::geom::{Mesh, Vector};

/// What the edges of a mesh say. Vertices of equal coordinates are one.
#[derive(Clone, Debug)]
pub(crate) struct Edges {
    /// How many edges are in an odd number of faces.
    pub(crate) open: usize,
    /// How many edges are not run through equally often in both directions.
    pub(crate) unpaired: usize,
    /// The first face that has an open edge, its ends, and in how many faces that is.
    pub(crate) first: Option<OpenEdge>,
}

/// An edge in an odd number of faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OpenEdge {
    pub(crate) face: usize,
    pub(crate) ends: [u32; 2],
    pub(crate) faces: usize,
}

impl Edges {
    /// Looks at all edges of all faces, those of degenerate faces included.
    pub(crate) fn of<V: Vector<Real: Into<f64>>>(mesh: &Mesh<V>) -> Self {
        let welded = welded(mesh.vertices());
        let mut edges = directed(mesh.triangles(), &welded);
        edges.par_sort_unstable();
        let (mut open, mut unpaired, mut odd) = (0, 0, HashMap::new());
        for same in edges.chunk_by(|a, b| a >> 1 == b >> 1) {
            let backward = same.iter().filter(|&edge| edge & 1 == 1).count();
            unpaired += usize::from(2 * backward != same.len());
            if same.len() % 2 == 1 {
                open += 1;
                odd.insert(same[0] >> 1, same.len());
            }
        }
        let first = if open == 0 { None } else { first_open(mesh.triangles(), &welded, &odd) };
        Self { open, unpaired, first }
    }
}

/// For each vertex, the first one of its coordinates.
fn welded<V: Vector<Real: Into<f64>>>(vertices: &[V]) -> Vec<u32> {
    // Zeros of both signs are one number. Doubles hold single precision exactly.
    let key = |v: &V| v.components().map(|x| (Into::<f64>::into(x) + 0.0).to_bits());
    let mut order: Vec<_> = vertices.par_iter().enumerate().map(|(i, v)| (key(v), i as u32)).collect();
    order.par_sort_unstable();
    let mut welded = vec![0; vertices.len()];
    for same in order.chunk_by(|(a, _), (b, _)| a == b) {
        for (_, vertex) in same {
            welded[*vertex as usize] = same[0].1;
        }
    }
    welded
}

/// Every edge of every face.
fn directed(faces: &[[u32; 3]], welded: &[u32]) -> Vec<u64> {
    faces.par_iter().flat_map_iter(|&face| ends(face).into_iter().filter_map(|ends| packed(ends, welded))).collect()
}

/// The lesser end, the greater end and the direction: 31 bits, 31 and one. An edge of one point is none.
fn packed(ends: [u32; 2], welded: &[u32]) -> Option<u64> {
    let [from, to] = ends.map(|vertex| u64::from(welded[vertex as usize]));
    (from != to).then(|| from.min(to) << 32 | from.max(to) << 1 | u64::from(to < from))
}

fn ends([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn first_open(faces: &[[u32; 3]], welded: &[u32], odd: &HashMap<u64, usize>) -> Option<OpenEdge> {
    faces.iter().enumerate().find_map(|(face, &corners)| {
        ends(corners).into_iter().find_map(|ends| {
            let &faces = odd.get(&(packed(ends, welded)? >> 1))?;
            Some(OpenEdge { face, ends, faces })
        })
    })
}
