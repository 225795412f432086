//! Scenes of hard queries, and their rays.

use std::error::Error;

use glam::Vec3;
use stackless_bvh::generate::draw::Draw;
use stackless_bvh::generate::{Rng, Source as _, stress};
use stackless_bvh::geom::{Aabb, AffineError, AffineMap, Mesh, Ray};

use super::QUERIES;

/// `sheets` lattices of `n` by `n` squares, of two triangles each. They are one float apart, starting at z = 1.
pub(super) fn lattice(n: u32, sheets: u32) -> Result<Mesh, Box<dyn Error>> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for sheet in 0..sheets {
        let first = sheet * (n + 1) * (n + 1);
        let z = f32::from_bits(1f32.to_bits() + sheet);
        vertices.extend((0..=n).flat_map(|y| (0..=n).map(move |x| Vec3::new(x as f32, y as f32, z))));
        for (x, y) in (0..n).flat_map(|y| (0..n).map(move |x| (x, y))) {
            let a = first + y * (n + 1) + x;
            triangles.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
        }
    }
    Ok(Mesh::new(vertices, triangles)?)
}

/// Rays in z = 1, from x = -1.
pub(super) fn in_plane() -> Vec<Ray> {
    let mut rng = Rng::new(1);
    let mut number = || rng.below(64) as f32;
    (0..QUERIES)
        .filter_map(|_| Ray::new(Vec3::new(-1.0, number(), 1.0), Vec3::new(64.0, number() - 32.0, 0.0)).ok())
        .collect()
}

/// Rays to vertices of the lattice, from below.
pub(super) fn at_vertices() -> Vec<Ray> {
    let mut rng = Rng::new(1);
    let mut point = |z: f32| Vec3::new(rng.below(33) as f32, rng.below(33) as f32, z);
    (0..QUERIES)
        .filter_map(|_| {
            let o = point(0.0);
            Ray::new(o, point(1.0) - o).ok()
        })
        .collect()
}

pub(super) fn sphere() -> Result<Mesh, Box<dyn Error>> {
    Ok(stress::icosphere(6, 1.0, Vec3::ZERO)?)
}

/// Rays to points in the sphere, from up to 2^120 away.
pub(super) fn from_afar() -> Vec<Ray> {
    let mut rng = Rng::new(1);
    let mut number = || rng.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0;
    let mut point = || Vec3::new(number(), number(), number());
    (0..QUERIES)
        .filter_map(|i| {
            let o = point() * 2f32.powi(8 + (i as i32 * 112) / QUERIES as i32);
            Ray::new(o, point() * 0.5 - o).ok()
        })
        .collect()
}

/// Rays through the sphere along axes, from up to 2^120 away.
pub(super) fn along_axes_from_afar() -> Vec<Ray> {
    let mut draw = Draw::new(1);
    (0..QUERIES)
        .filter_map(|i| {
            let axis = draw.axis();
            let beside = (Vec3::ONE - axis.abs()) * draw.centred() * 0.5;
            Ray::new(beside - axis * 2f32.powi(8 + (i as i32 * 112) / QUERIES as i32), axis).ok()
        })
        .collect()
}

/// A sphere of radius 0.00003.
pub(super) fn small_sphere() -> Result<Mesh, Box<dyn Error>> {
    Ok(stress::icosphere(6, 3e-5, Vec3::new(0.097_815_976, -0.001_463_89, 0.0))?)
}

/// Rays at the small sphere along an axis, with directions down to 2^-125.
pub(super) fn short_from_afar() -> Vec<Ray> {
    let origin = Vec3::new(0.097_815_976, -0.001_463_89, 35_184_367_894_528.0);
    (0..QUERIES as i32).filter_map(|i| Ray::new(origin, Vec3::NEG_Z * 2f32.powi(-76 - i)).ok()).collect()
}

/// The end of an edge from the origin. Its halves are exact, and x uses the full mantissa.
const EDGE: Vec3 = Vec3::new(2.999_999_8, 0.0, 1.0);
const CORNER: Vec3 = Vec3::new(0.1, 3.1, 2.7);

/// Coincident triangles that are not on a grid.
pub(super) fn coincident(n: usize) -> Result<Mesh, Box<dyn Error>> {
    let vertices = vec![Vec3::ZERO, EDGE, CORNER];
    Ok(Mesh::new(vertices, vec![[0, 1, 2]; n])?)
}

/// Rays exactly through the first edge of the triangles.
pub(super) fn at_edge() -> Vec<Ray> {
    let o = Vec3::new(0.0, 0.3, -5.0);
    [1.0, 0.5, 0.25, 0.125].into_iter().filter_map(|part| Ray::new(o, EDGE * part - o).ok()).collect()
}

/// Rays through the interior of the triangles.
pub(super) fn inside() -> Vec<Ray> {
    let o = Vec3::new(0.0, 0.3, -5.0);
    (1..8u8).filter_map(|i| Ray::new(o, EDGE * 0.25 + CORNER * (f32::from(i) * 0.0625) - o).ok()).collect()
}

/// The rounded image of a point.
pub(super) fn apply(map: &AffineMap, v: Vec3) -> Vec3 {
    map.image_of_box(&Aabb { lo: v, hi: v }).lo
}

/// A rotation about the z axis.
pub(super) fn turn(cosine: f32, sine: f32) -> Result<AffineMap, AffineError> {
    AffineMap::new([[cosine, -sine, 0.0, 0.0], [sine, cosine, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
}
