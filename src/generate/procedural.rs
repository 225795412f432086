//! Scenes and rays from a seed, identical on every machine.
//!
//! There are four scenes that are hard for hierarchies in different respects, and ordinary and difficult rays.
//! Coordinates are computed with operations that IEEE 754 rounds exactly (no sine).

mod rays;
mod view;

pub use rays::{camera_rays, rays};
pub use view::View;

use glam::Vec3;

use super::draw::Draw;
use crate::geom::Mesh;

/// Segments of a strand, of two triangles each.
const SEGMENTS: usize = 16;
/// Squares along an edge of the stadium's ball, which is an inflated cube.
const SQUARES: usize = 46;
/// Tiers of the stadium.
const TIERS: usize = 32;

/// Returns hair: `n` thin, curved ribbons (at least one) of 32 triangles each, tapering to the tip, on the unit sphere.
pub fn strands(seed: u64, n: usize) -> Mesh {
    let mut random = Draw::new(seed);
    let mut parts = Parts::default();
    for _ in 0..n.max(1) {
        let root = random.direction();
        let side = root.cross(random.direction()).try_normalize().unwrap_or(Vec3::X);
        let (bend, length) = (random.direction() * 0.8, random.between(0.4, 0.7));
        parts.add_grid(
            2,
            (0..=SEGMENTS).flat_map(|i| {
                let s = i as f32 / SEGMENTS as f32;
                let middle = root * (1.0 + length * s) + bend * (length * s * s);
                let half = side * (0.002 - 0.0018 * s);
                [middle - half, middle + half]
            }),
        );
    }
    parts.into_mesh()
}

/// Returns a scene of uneven density, like a teapot in a stadium: a finely divided ball of radius 0.05 on a field 1200
/// wide, with coarse tiers around it. About 27,000 triangles.
pub fn stadium(seed: u64) -> Mesh {
    let mut random = Draw::new(seed);
    let mut parts = Parts::default();
    // The field is the innermost ring of the tiers: rings of squares, each wider or higher than the previous one.
    let rings = (0..=2 * TIERS).map(|i| (600.0 * i.min(1) as f32 + 6.0 * (i / 2) as f32, 4.0 * (i / 2) as f32));
    let around = |i: usize| {
        let corner = |i: usize| [Vec3::new(1.0, 0.0, 1.0), Vec3::new(-1.0, 0.0, 1.0)][i % 2] * [1.0, -1.0][i / 2 % 2];
        corner(i / 4).lerp(corner(i / 4 + 1), (i % 4) as f32 / 4.0)
    };
    parts.add_grid(
        17,
        rings.flat_map(|(radius, height)| {
            (0..17).map(move |i| around(i) * radius + Vec3::Y * height).collect::<Vec<_>>()
        }),
    );
    let centre = Vec3::new(3.0 + random.unit(), 0.05, 5.0 + random.unit());
    for face in 0..6 {
        let side = [1.0, -1.0][face % 2];
        parts.add_grid(
            SQUARES + 1,
            (0..(SQUARES + 1) * (SQUARES + 1)).map(|i| {
                let along = |i: usize| 2.0 * i as f32 / SQUARES as f32 - 1.0;
                let mut p = [along(i % (SQUARES + 1)), along(i / (SQUARES + 1)), side];
                p.rotate_right(face / 2);
                centre + Vec3::from_array(p).normalize() * (0.05 - 0.001 * random.unit())
            }),
        );
    }
    parts.into_mesh()
}

/// Returns `n` random triangles (at least one) in the unit cube, of sizes down to zero; one in 32 repeats the previous
/// one.
pub fn soup(seed: u64, n: usize) -> Mesh {
    let mut random = Draw::new(seed);
    let mut parts = Parts::default();
    let mut corners = [Vec3::ZERO; 3];
    for i in 0..n.max(1) {
        if i % 32 != 31 {
            let centre = random.cube();
            let size = 0.5 * random.unit() * random.unit() * random.unit();
            corners = [(); 3].map(|()| centre + (random.cube() - 0.5) * size);
        }
        parts.add_triangle(corners);
    }
    parts.into_mesh()
}

/// Returns a deep scene: `n` parallel triangles (at least one), each a quarter nearer to a last plane, x = 0, than the
/// previous one.
///
/// They are so near and so wide, 65,536 in y and z, that in single precision all boxes over some of them have one
/// common surface area. So all splits have equal cost, and the surface area heuristic repeatedly separates only the
/// farthest triangle: the depth of the hierarchy is about the number of triangles, if the options allow it. From about
/// 280 triangles on, single precision does not distinguish their planes. The first triangle is offset in y, so a ray
/// can meet its box and, of the other triangles, only the last.
pub fn layers(n: usize) -> Mesh {
    let mut parts = Parts::default();
    let (width, mut x) = (65_536.0, 1.0 / 1024.0);
    for i in 0..n.max(1) {
        let start = if i == 0 { width } else { 0.0 };
        // Alternating halves of one square.
        let [near, far] = if i % 2 == 0 { [0.0, width] } else { [width, 0.0] };
        parts.add_triangle([[near, near], [near, far], [far, near]].map(|[y, z]| Vec3::new(-x, start + y, z)));
        x *= 0.75;
    }
    parts.into_mesh()
}

/// A mesh under construction.
#[derive(Default)]
struct Parts {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Parts {
    fn add_triangle(&mut self, corners: [Vec3; 3]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(corners);
        self.triangles.push([first, first + 1, first + 2]);
    }

    /// A grid with `width` points in a row, two triangles per cell.
    fn add_grid(&mut self, width: usize, points: impl Iterator<Item = Vec3>) {
        let first = self.vertices.len();
        self.vertices.extend(points);
        let cells = (first..self.vertices.len().saturating_sub(width)).filter(|i| (i - first) % width != width - 1);
        self.triangles.extend(cells.flat_map(|i| {
            let [a, b, c, d] = [i, i + 1, i + width, i + width + 1].map(|i| i as u32);
            [[a, b, c], [b, d, c]]
        }));
    }

    fn into_mesh(self) -> Mesh {
        Mesh::new(self.vertices, self.triangles).expect("coordinates are finite and indices in range")
    }
}

#[cfg(test)]
mod tests;
