//! Scenes in the page.

use std::path::Path;

use glam::Vec3;
use stackless_bvh::generate::procedural::{self, View};
use stackless_bvh::generate::stress::icosphere;
use stackless_bvh::generate::{Rng, Source as _};
use stackless_bvh::geom::{Mesh, MeshError};
use stackless_scene::read_named;

use crate::scene::{SIDE, SceneFault};

/// A scene by its name.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// The name.
    pub name: &'static str,
    /// A description of one sentence.
    pub about: &'static str,
    pub(crate) make: fn() -> Result<(Mesh, View), SceneFault>,
}

impl Example {
    /// All examples: the hard ones first, then ordinary ones.
    pub const ALL: [Self; 7] = [
        Self {
            name: "corners",
            about: "A hilly surface without a gap. Many rays are aimed at its corners and edges: the inexact tracer slips \
                    through, or meets another triangle than the first.",
            make: corners,
        },
        Self {
            name: "sheets",
            about: "Three parallel sheets, a few roundings apart. The exact tracer finds the one in front, and where sheets \
                    touch the one with the least number.",
            make: sheets,
        },
        Self {
            name: "telescope",
            about: "A fine sphere seen from a hundred thousand radii away, as through a telescope: rounding is as large as the \
                    triangles look.",
            make: telescope,
        },
        Self {
            name: "slivers",
            about: "1,200 needles, each more than a hundred times as long as it is wide.",
            make: || from_file("slivers.ply", include_bytes!("../../../examples/data/slivers.ply")),
        },
        Self {
            name: "torus",
            about: "An ordinary mesh of 2,304 triangles from a PLY file: the two pictures are nearly always the same.",
            make: || from_file("torus.ply", include_bytes!("../../../examples/data/torus.ply")),
        },
        Self {
            name: "strands",
            about: "Hair: 600 thin, curved ribbons on a sphere.",
            make: || Ok(seen(procedural::strands(1, 600))),
        },
        Self {
            name: "soup",
            about: "5,000 triangles of all sizes through one another, some of them twice.",
            make: || Ok(seen(procedural::soup(1, 5000))),
        },
    ];
}

fn from_file(name: &str, bytes: &[u8]) -> Result<(Mesh, View), SceneFault> {
    Ok(seen(read_named(Path::new(name), bytes)?.mesh))
}

fn seen(mesh: Mesh) -> (Mesh, View) {
    let view = View::of(&mesh);
    (mesh, view)
}

/// Straight along z, so that directions have the finest resolution across.
fn along_z(distance: f32, degrees: f32) -> View {
    View { eye: Vec3::Z * distance, target: Vec3::ZERO, up: Vec3::Y, degrees }
}

/// Pixels between neighbouring corners.
const STEP: usize = 8;

/// A hilly grid whose corners are on rays of the picture. Rays between corners meet edges only by chance, so each
/// corner is moved to another ray nearby.
fn corners() -> Result<(Mesh, View), SceneFault> {
    let view = View { eye: Vec3::ZERO, target: Vec3::NEG_Z, up: Vec3::Y, degrees: 50.0 };
    let side = SIDE / STEP;
    let mut rng = Rng::new(1);
    let corners = (0..side * side).filter_map(|i| {
        let [column, row] = [i % side, i / side].map(|i| i * STEP + rng.below(STEP as u64 - 2) as usize);
        let [x, y] = [column, row].map(|i| i as f32 / (SIDE / 2) as f32 - 1.0);
        let depth = 3.0 + (1.0 - x * x) * (1.0 - y * y) * (0.3 + 3.0 * x * y - 1.5 * x);
        Some(view.ray_of(row * SIDE + column, SIDE * SIDE)?.direction() * depth)
    });
    Ok((grid(side, corners.collect())?, view))
}

/// Three sheets, 2e-7 apart.
fn sheets() -> Result<(Mesh, View), SceneFault> {
    let side = 65;
    let sheet = |layer: usize| {
        (0..side * side).map(move |i| {
            let [x, y] = [i % side, i / side].map(|i| i as f32 / 32.0 - 1.0);
            let z = 0.3 * x + 0.2 * y * x + layer as f32 * 2e-7;
            Vec3::new(x, y, z)
        })
    };
    let view = View { eye: Vec3::new(0.3, 0.4, 3.0), target: Vec3::ZERO, up: Vec3::Y, degrees: 45.0 };
    let layers: Vec<_> = (0..3).map(|layer| grid(side, sheet(layer).collect())).collect::<Result<_, _>>()?;
    Ok((joined(&layers)?, view))
}

fn telescope() -> Result<(Mesh, View), SceneFault> {
    let distance = 100_000.0;
    Ok((icosphere(6, 1.0, Vec3::ZERO)?, along_z(distance, (2.2 / distance).to_degrees())))
}

/// A grid of points, two triangles a cell.
fn grid(width: usize, points: Vec<Vec3>) -> Result<Mesh, MeshError> {
    let cells = (0..points.len().saturating_sub(width)).filter(|i| i % width != width - 1);
    let triangles = cells.flat_map(|i| {
        let [a, b, c, d] = [i, i + 1, i + width, i + width + 1].map(|i| i as u32);
        [[a, b, c], [b, d, c]]
    });
    let triangles = triangles.collect();
    Mesh::new(points, triangles)
}

/// Joins meshes.
fn joined(meshes: &[Mesh]) -> Result<Mesh, MeshError> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let first = vertices.len() as u32;
        vertices.extend_from_slice(mesh.vertices());
        triangles.extend(mesh.triangles().iter().map(|corners| corners.map(|corner| corner + first)));
    }
    Mesh::new(vertices, triangles)
}
