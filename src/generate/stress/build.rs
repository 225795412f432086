//! Meshes out of triangles and grids.

use glam::Vec3;

use crate::generate::draw::Draw;
use crate::geom::Mesh;

/// `n` separate triangles.
pub(super) fn triangles(draw: &mut Draw, n: usize, mut corners: impl FnMut(&mut Draw) -> [Vec3; 3]) -> Option<Mesh> {
    of((0..n).map(|_| corners(draw)))
}

/// These triangles, each with separate corners.
pub(super) fn of(triangles: impl IntoIterator<Item = [Vec3; 3]>) -> Option<Mesh> {
    let vertices: Vec<_> = triangles.into_iter().flatten().collect();
    let triangles = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(vertices, triangles).ok()
}

/// The triangles of both meshes, those of `a` first.
pub(super) fn both(a: &Mesh, b: &Mesh) -> Option<Mesh> {
    let first = a.vertices().len() as u32;
    let moved = b.triangles().iter().map(|corners| corners.map(|corner| corner + first));
    Mesh::new([a.vertices(), b.vertices()].concat(), a.triangles().iter().copied().chain(moved).collect()).ok()
}

/// A grid of `columns` times `rows` squares of two triangles each, with the point of column `x` and row `y`.
pub(super) fn grid(columns: usize, rows: usize, point: impl FnMut([usize; 2]) -> Vec3) -> Option<Mesh> {
    let width = columns + 1;
    let vertices = (0..width * (rows + 1)).map(|i| [i % width, i / width]).map(point).collect();
    let cells = (0..width * rows).filter(|i| i % width != columns);
    let triangles = cells.flat_map(|i| {
        let [a, b, c, d] = [i, i + 1, i + width, i + width + 1].map(|i| i as u32);
        [[a, b, c], [b, d, c]]
    });
    Mesh::new(vertices, triangles.collect()).ok()
}

/// The mesh with every vertex moved.
pub(super) fn mapped(mesh: &Mesh, to: impl FnMut(Vec3) -> Vec3) -> Option<Mesh> {
    Mesh::new(mesh.vertices().iter().copied().map(to).collect(), mesh.triangles().to_vec()).ok()
}

/// The mesh with its triangles in random order.
pub(super) fn shuffled(draw: &mut Draw, mesh: &Mesh) -> Option<Mesh> {
    let mut triangles = mesh.triangles().to_vec();
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, draw.below(i + 1));
    }
    Mesh::new(mesh.vertices().to_vec(), triangles).ok()
}

/// A closed box of 12 triangles, outward faces counterclockwise.
pub(super) fn cuboid(lo: Vec3, hi: Vec3) -> Option<Mesh> {
    let corner = |i: u32| Vec3::select(glam::BVec3::new(i & 1 != 0, i & 2 != 0, i & 4 != 0), hi, lo);
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh::new((0..8).map(corner).collect(), triangles.collect()).ok()
}

/// A point of the unit circle, once around while `s` goes from 0 to 4, without a sine.
pub(super) fn circle(s: f64) -> [f64; 2] {
    let quarter = s.floor();
    // In half angles: from 0 to 1 this parameter runs through a quarter.
    let h = s - quarter;
    let [x, y] = [(1.0 - h * h) / (1.0 + h * h), 2.0 * h / (1.0 + h * h)];
    match quarter as i64 & 3 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}
