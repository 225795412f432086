//! Generated scenes with small integer coordinates, and their rays. Single precision is exact there, except for
//! divisions, which are rounded once. So kernels must have the hits of rational arithmetic, bit for bit.

use glam::Vec3;
use stackless_bvh::generate::{Rng, Source as _};
use stackless_bvh::geom::{Mesh, Ray};

/// A scene, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// Terrain with integer heights.
    Terrain,
    /// Cubes, adjacent and nested: coplanar faces, boxes without volume.
    City,
    /// Random triangles, some repeated, some degenerate.
    Soup,
}

/// Half of the extent.
const REACH: i32 = 12;

impl Made {
    /// All scenes.
    pub const ALL: [Self; 3] = [Self::Terrain, Self::City, Self::Soup];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Terrain => "terrain",
            Self::City => "city",
            Self::Soup => "soup",
        }
    }

    /// The mesh of a seed.
    ///
    /// # Errors
    /// None: all indices are valid.
    pub fn mesh(self, seed: u64) -> Result<Mesh, stackless_bvh::geom::MeshError> {
        let mut rng = Rng::new(seed);
        let mut triangles: Vec<[[i32; 3]; 3]> = Vec::new();
        match self {
            Self::Terrain => {
                let side = 2 * REACH + 1;
                let heights: Vec<i32> = (0..side * side).map(|_| rng.below(5) as i32 - 2).collect();
                let at = |x: i32, y: i32| [x - REACH, y - REACH, heights[(y * side + x) as usize]];
                for (x, y) in (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| (x, y))) {
                    let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
            Self::City => (0..60).for_each(|_| {
                let lo = [(); 3].map(|()| range(&mut rng, REACH - 4));
                let hi = lo.map(|x| x + 1 + rng.below(4) as i32);
                triangles.extend(cube(lo, hi));
            }),
            Self::Soup => (0..400).for_each(|i| {
                let center = point(&mut rng, REACH - 3);
                let corner = |rng: &mut Rng| center.map(|x| x + range(rng, 3));
                triangles.push([corner(&mut rng), corner(&mut rng), corner(&mut rng)]);
                if i % 16 == 0 {
                    triangles.extend(triangles.last().copied());
                }
            }),
        }
        let corners = triangles.iter().flatten().map(|&corner| vector(corner)).collect();
        let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Mesh::new(corners, indices)
    }
}

/// Rays from integer points: alternately along an axis, towards a corner or the middle of an edge, and in a random
/// direction. Some rays are bounded.
pub fn rays(mesh: &Mesh, count: usize, seed: u64) -> Vec<Ray> {
    let mut rng = Rng::new(seed);
    (0..4 * count)
        .filter_map(|i| {
            let origin = point(&mut rng, REACH + 4);
            let o = vector(origin);
            let triangle = mesh.triangle(rng.below(mesh.triangles().len() as u64) as usize);
            let direction = match i % 4 {
                0 => {
                    let mut along = Vec3::ZERO;
                    along[rng.below(3) as usize] = if rng.coin() { 1.0 } else { -1.0 };
                    along
                }
                1 => triangle[rng.below(3) as usize] - o,
                2 => triangle[0] + triangle[1] - 2.0 * o,
                _ => vector(point(&mut rng, REACH)),
            };
            let tmax = if rng.below(8) == 0 { rng.below(40) as f32 } else { f32::INFINITY };
            Ray::within(o, direction, 0.0, tmax).ok()
        })
        .take(count)
        .collect()
}

/// Rays into any mesh, from a camera outside, in Morton order of the pixels.
pub fn view(mesh: &Mesh, count: usize, seed: u64) -> Vec<Ray> {
    let (mut lo, mut hi) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for &vertex in mesh.vertices() {
        (lo, hi) = (lo.min(vertex), hi.max(vertex));
    }
    let mut rng = Rng::new(seed);
    let (center, size) = ((lo + hi) / 2.0, (hi - lo).max_element());
    let angle = rng.below(360) as f32 / 360.0 * std::f32::consts::TAU;
    let eye = center + Vec3::new(angle.cos(), angle.sin(), 0.4) * size;
    let forward = (center - eye).normalize();
    let right = forward.cross(Vec3::Z).normalize();
    let up = right.cross(forward);
    let side = (count as f32).sqrt().ceil() as u32;
    let at = |i: u32| (i as f32 + 0.5) / side as f32 * 1.2 - 0.6;
    let codes = (0..).map(|code: u64| [even_bits(code), even_bits(code >> 1)]);
    codes
        .filter(|&[x, y]| x < side && y < side)
        .take(count)
        .filter_map(|[x, y]| Ray::new(eye, forward + right * at(x) + up * at(y)).ok())
        .collect()
}

/// Bits 0, 2, 4 and so on: a coordinate of a Morton code.
fn even_bits(code: u64) -> u32 {
    (0..32).map(|i| ((code >> (2 * i) & 1) as u32) << i).sum()
}

fn range(rng: &mut Rng, reach: i32) -> i32 {
    rng.below(2 * reach as u64 + 1) as i32 - reach
}

fn point(rng: &mut Rng, reach: i32) -> [i32; 3] {
    [(); 3].map(|()| range(rng, reach))
}

fn vector(point: [i32; 3]) -> Vec3 {
    Vec3::from_array(point.map(|x| x as f32))
}

/// The twelve triangles of a cube.
fn cube(lo: [i32; 3], hi: [i32; 3]) -> Vec<[[i32; 3]; 3]> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for plane in [lo[axis], hi[axis]] {
            let corner = |at_u: i32, at_v: i32| {
                let mut point = [0; 3];
                (point[axis], point[u], point[v]) = (plane, at_u, at_v);
                point
            };
            let [a, b, c, d] = [corner(lo[u], lo[v]), corner(hi[u], lo[v]), corner(hi[u], hi[v]), corner(lo[u], hi[v])];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}
