//! Spheres of triangles.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::geom::{Mesh, MeshError};

/// Levels beyond this one have more triangles than a mesh can hold.
const MOST: u32 = 13;

/// A closed sphere: an icosahedron whose triangles are divided in four `level` times (20 · 4^level triangles).
///
/// `radius` in world units. The corners are computed in double precision and rounded to single precision once, after
/// the offset; so an offset that is large against the radius makes some triangles degenerate, but the mesh stays
/// closed. Corners are counterclockwise from outside.
///
/// # Errors
/// [`MeshError::TooMany`] from level 14 on; [`MeshError::NonFinite`] if a coordinate overflows.
///
/// ```
/// use stackless_bvh::{generate::stress::icosphere, glam::Vec3};
/// let sphere = icosphere(3, 100.0, Vec3::splat(1e3))?;
/// assert_eq!((sphere.triangles().len(), sphere.vertices().len()), (1280, 642));
/// # Ok::<(), stackless_bvh::geom::MeshError>(())
/// ```
pub fn icosphere(level: u32, radius: f32, offset: Vec3) -> Result<Mesh, MeshError> {
    if level > MOST {
        return Err(MeshError::TooMany { what: "triangles", count: usize::MAX });
    }
    let (mut vertices, mut triangles) = icosahedron();
    for _ in 0..level {
        triangles = divide(&mut vertices, &triangles);
    }
    let place = |v: DVec3| (v * f64::from(radius) + offset.as_dvec3()).as_vec3();
    Mesh::new(vertices.into_iter().map(place).collect(), triangles)
}

/// The corners are on three rectangles of golden ratio, one across each axis.
fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let corner = |i: usize| {
        let [a, b] = [[1.0, -1.0][i & 1], [golden, -golden][i >> 1 & 1]];
        [DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)][i >> 2].normalize()
    };
    let vertices: Vec<_> = (0..12).map(corner).collect();
    // Neighbours are an edge apart; other pairs are further.
    let near = |a: usize, b: usize| a != b && vertices[a].distance_squared(vertices[b]) < 1.2;
    let outward = |a: usize, b: usize, c: usize| vertices[a].cross(vertices[b]).dot(vertices[c]) > 0.0;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(c, a)) {
                let corners = if outward(a, b, c) { [a, b, c] } else { [a, c, b] };
                triangles.push(corners.map(|corner| corner as u32));
            }
        }
    }
    (vertices, triangles)
}

/// Four triangles for each: one at each corner, and the one between the middles of the edges.
fn divide(vertices: &mut Vec<DVec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
            vertices.len() as u32 - 1
        })
    };
    let mut divided = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        divided.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    divided
}
