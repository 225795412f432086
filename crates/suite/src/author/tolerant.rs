//! Level `ray`, cases for floating-point tracers: only answers that such tracers can guarantee.
//!
//! Every case has a clear answer. Rays from inside a closed mesh hit it in any direction. Rays that miss it keep a
//! distance. Distances are compared only if rounding has little effect. The exact answer is computed in all cases.

use glam::{DVec3, Vec3};
use serde_json::json;

use super::ray::{asked, from_to};
use super::truth::{Hit, Mesh, Ray};
use super::{Author, result};
use crate::{Ask, Expect, Near, NearHit, Query};
use stackless_bvh::generate::{Rng, Source};

/// Rays per case.
pub(super) const RAYS: usize = 16;

/// The interval of an unlimited ray.
pub(super) const WHOLE: [f32; 2] = [0.0, f32::INFINITY];

/// Closed meshes around the origin that contain all points closer than a quarter: names and scales.
fn closed() -> Vec<(&'static str, Mesh)> {
    vec![
        ("octahedron", sphere(0)),
        ("cube", cube()),
        ("ball-32", sphere(1)),
        ("ball-128", sphere(2)),
        ("ball-512", sphere(3)),
        ("egg", scaled(&sphere(2), Vec3::new(1.0, 3.0, 7.0))),
        ("needle", scaled(&sphere(2), Vec3::new(1.0, 1.0, 1000.0))),
        ("crumb", scaled(&sphere(2), Vec3::splat(1.0 / 1024.0))),
        ("planet", scaled(&sphere(2), Vec3::splat(6_371_000.0))),
    ]
}

pub(super) fn scaled(mesh: &Mesh, by: Vec3) -> Mesh {
    let vertices = mesh.vertices.iter().map(|&vertex| (Vec3::from_array(vertex) * by).to_array()).collect();
    Mesh { vertices, triangles: mesh.triangles.clone() }
}

/// The sides of the cube, as cycles of corners.
pub(super) const SIDES: [[u32; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

pub(super) fn cube() -> Mesh {
    let vertices = (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 })).collect();
    Mesh { vertices, triangles: SIDES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect() }
}

/// Builds an octahedron whose triangles are split into four, `level` times. All corners are on the unit sphere, up to
/// rounding.
pub(super) fn sphere(level: u32) -> Mesh {
    let mut vertices: Vec<Vec3> = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]).collect();
    let mut triangles = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..level {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = vertices[a as usize] + vertices[b as usize];
                vertices.push(sum / sum.dot(sum).sqrt());
                vertices.len() as u32 - 1
            })
        };
        let mut cut = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = cut;
    }
    Mesh { vertices: vertices.iter().map(Vec3::to_array).collect(), triangles }
}

/// Draws a corner, a point of an edge, or the midpoint of an edge, rounded to floats.
fn on_edge(rng: &mut Rng, mesh: &Mesh) -> Vec3 {
    let corners = mesh.triangles[rng.below(mesh.triangles.len() as u64) as usize];
    let [a, b] = [0, 1].map(|i| Vec3::from_array(mesh.vertices[corners[i] as usize]));
    a + (b - a) * (rng.below(9) as f32 / 8.0)
}

pub(super) fn middle_of_face(rng: &mut Rng, mesh: &Mesh) -> Vec3 {
    let corners = mesh.triangles[rng.below(mesh.triangles.len() as u64) as usize];
    let [a, b, c] = corners.map(|corner| Vec3::from_array(mesh.vertices[corner as usize]));
    (a + b + c) / 3.0
}

/// Returns half the extent on each axis.
fn extent(mesh: &Mesh) -> Vec3 {
    mesh.vertices.iter().map(|&vertex| Vec3::from_array(vertex).abs()).fold(Vec3::ZERO, Vec3::max)
}

pub(super) fn inside(rng: &mut Rng, mesh: &Mesh) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| rng.below(9) as f32 / 64.0 - 1.0 / 16.0)) * extent(mesh)
}

/// Draws a point on a sphere whose radius is a multiple of the mesh's size.
fn outside(rng: &mut Rng, mesh: &Mesh, times: f32) -> Vec3 {
    let v = Vec3::from_array([(); 3].map(|()| rng.below(1001) as f32 - 500.25));
    v / v.dot(v).sqrt() * (times * radius(mesh))
}

/// Draws rays from inside toward edges and corners.
fn out_to_edges(rng: &mut Rng, mesh: &Mesh) -> Vec<Ray> {
    (0..RAYS).map(|_| from_to(inside(rng, mesh), on_edge(rng, mesh), WHOLE)).collect()
}

fn radius(mesh: &Mesh) -> f32 {
    let e = extent(mesh);
    e.dot(e).sqrt()
}

/// Cases of `watertight`.
pub(super) fn watertight(author: &mut Author) {
    for (i, (name, mesh)) in closed().into_iter().enumerate() {
        let rng = &mut Rng::new(9000 + i as u64);
        let leaks = out_to_edges(rng, &mesh);
        let why = "From within a closed mesh towards edges and corners: whatever is rounded, something is hit.";
        asks(author, &format!("{name}-leaks"), why, &mesh, &leaks, Query::Any, |_| true);
        let through: Vec<Ray> =
            (0..RAYS).map(|_| from_to(outside(rng, &mesh, 2.0), inside(rng, &mesh), WHOLE)).collect();
        let why = "From outside towards the middle of a closed mesh.";
        asks(author, &format!("{name}-through"), why, &mesh, &through, Query::Any, |_| true);
        let ghosts: Vec<Ray> = (0..RAYS).map(|at| ghost(rng, &mesh, at)).collect();
        let why = "Past the mesh, away from it, or ended before it: nothing is hit, and nothing is near.";
        asks(author, &format!("{name}-ghosts"), why, &mesh, &ghosts, Query::Any, |_| false);
    }
}

/// Draws a ray that misses the sphere around the mesh by at least a fiftieth of its size.
pub(super) fn ghost(rng: &mut Rng, mesh: &Mesh, at: usize) -> Ray {
    let from = outside(rng, mesh, 2.0);
    match at % 3 {
        0 => from_to(from, 2.0 * from, WHOLE),
        1 => from_to(from, Vec3::ZERO, [0.0, 0.4375]),
        _ => loop {
            let to = outside(rng, mesh, 2.0);
            let along = to - from;
            let nearest = from - along * (from.dot(along) / along.dot(along));
            if nearest.dot(nearest).sqrt() > 1.02 * radius(mesh) {
                return from_to(from, to, WHOLE);
            }
        },
    }
}

/// Cases of `parity`.
pub(super) fn parity(author: &mut Author) {
    for (i, (name, mesh)) in closed().into_iter().enumerate() {
        let rng = &mut Rng::new(9100 + i as u64);
        let faces: Vec<Ray> = (0..RAYS)
            .map(|at| {
                let from = inside(rng, &mesh);
                if at % 2 == 0 { from_to(from, middle_of_face(rng, &mesh), WHOLE) } else { ghost(rng, &mesh, at) }
            })
            .collect();
        let why = "From within through the middle of faces, or past the mesh: no edge is near.";
        asks(author, &format!("{name}-faces"), why, &mesh, &faces, Query::Parity, |at| at % 2 == 0);
        let within = out_to_edges(rng, &mesh);
        let why = "From within, towards edges and corners: each crossing counts once.";
        asks(author, &format!("{name}-within"), why, &mesh, &within, Query::Parity, |_| true);
        let around: Vec<Ray> =
            (0..RAYS).map(|_| from_to(outside(rng, &mesh, 2.0), on_edge(rng, &mesh), WHOLE)).collect();
        let why = "From outside, towards edges and corners, which may be grazed: in as often as out.";
        asks(author, &format!("{name}-around"), why, &mesh, &around, Query::Parity, |_| false);
        // A hollow mesh, with origins between its walls and in the hollow.
        let hollow = with_hollow(&mesh);
        let between = |rng: &mut Rng| inside(rng, &mesh) + Vec3::X * (0.5 * extent(&mesh).x);
        let mixed: Vec<Ray> = (0..RAYS)
            .map(|at| {
                let from = if at % 2 == 0 { between(rng) } else { inside(rng, &hollow) / 8.0 };
                from_to(from, on_edge(rng, &hollow), WHOLE)
            })
            .collect();
        let why = "A hollow mesh: odd between its walls, even in the hollow.";
        let is_between = |at: usize| at.is_multiple_of(2);
        asks(author, &format!("{name}-hollow"), why, &hollow, &mixed, Query::Parity, is_between);
    }
}

/// Adds an image of the mesh inside it, an eighth as large.
fn with_hollow(mesh: &Mesh) -> Mesh {
    let within = scaled(mesh, Vec3::splat(0.125));
    let count = mesh.vertices.len() as u32;
    let turned = within.triangles.iter().map(|&[a, b, c]| [a, c, b].map(|corner| corner + count));
    Mesh {
        vertices: mesh.vertices.iter().chain(&within.vertices).copied().collect(),
        triangles: mesh.triangles.iter().copied().chain(turned).collect(),
    }
}

pub(super) fn asks(
    author: &mut Author,
    name: &str,
    why: &str,
    mesh: &Mesh,
    rays: &[Ray],
    query: Query,
    expected: impl Fn(usize) -> bool,
) {
    let hits: Vec<_> = (0..rays.len()).map(expected).collect();
    let ask = Ask::Ray(asked(mesh, rays, query));
    author.case(name, &["EXACT-1", "CONF-2"], why, &ask, result([("hits", json!(hits))]));
}

/// Cases of distances: the hits are away from edges and well conditioned.
pub(super) fn near(author: &mut Author, ulps: u32, most: f64) {
    for seed in 0..24 {
        let rng = &mut Rng::new(9200 + seed);
        let mesh = doubled(&soup(rng, 4 + 2 * seed as usize, 20));
        let rays = clear_rays(rng, &mesh, most);
        let why = "Hits far from edges; each triangle is there twice, and either will do.";
        asks_near(author, &format!("soup-{seed}"), why, &mesh, &rays, ulps);
    }
}

/// Draws rays without close decisions. Four in five hit, because misses are easy.
pub(super) fn clear_rays(rng: &mut Rng, mesh: &Mesh, most: f64) -> Vec<Ray> {
    let mut rays = Vec::new();
    for _ in 0..20_000 {
        if rays.len() == RAYS {
            break;
        }
        let from = Vec3::from_array([(); 3].map(|()| rng.below(1025) as f32 / 128.0 - 4.0));
        let to = Vec3::from_array([(); 3].map(|()| rng.below(1025) as f32 / 512.0 - 1.0));
        let ray = from_to(from, to, WHOLE);
        if is_clear(mesh, &ray, most) && (rays.len() % 5 == 0 || !mesh.hits(&ray).is_empty()) {
            rays.push(ray);
        }
    }
    rays
}

pub(super) fn asks_near(author: &mut Author, name: &str, why: &str, mesh: &Mesh, rays: &[Ray], ulps: u32) {
    let hits = rays.iter().map(|ray| near_hit(&mesh.hits(ray), ulps)).collect();
    let ask = Ask::Ray(asked(mesh, rays, Query::Closest));
    author.case(name, &["EXACT-1", "CONF-2"], why, &ask, Expect::Near(Near { ulps, hits }));
}

/// Returns the first hit, with its alternatives. If distances are wrong by up to `ulps`, a tracer may report another
/// hit that is at most twice `ulps` behind the first.
fn near_hit(all: &[Hit], ulps: u32) -> Option<NearHit> {
    let first = all.first()?.t.to_bits();
    let is_near = |hit: &&Hit| hit.t.to_bits() - first <= 2 * ulps;
    Some(NearHit { t: format!("{first:08x}"), prims: all.iter().filter(is_near).map(|hit| hit.prim).collect() })
}

pub(super) fn soup(rng: &mut Rng, triangles: usize, bits: u32) -> Mesh {
    let half = 1 << (bits - 1);
    let corner = |rng: &mut Rng| [(); 3].map(|()| rng.below(2 * half) as f32 / half as f32 - 1.0);
    let vertices = (0..3 * triangles).map(|_| corner(rng)).collect();
    Mesh { vertices, triangles: (0..triangles as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}

/// Duplicates each triangle, with rotated corners.
pub(super) fn doubled(mesh: &Mesh) -> Mesh {
    let again = mesh.triangles.iter().map(|&[a, b, c]| [b, c, a]);
    Mesh { vertices: mesh.vertices.clone(), triangles: mesh.triangles.iter().copied().chain(again).collect() }
}

/// Returns whether no edge is close, no two different triangles are hit at similar distances, and sums are well
/// conditioned: the magnitudes of the terms are at most `most` times the sum.
fn is_clear(mesh: &Mesh, &[x, y, z, dx, dy, dz, ..]: &Ray, most: f64) -> bool {
    let (o, d) = (Vec3::new(x, y, z).as_dvec3(), Vec3::new(dx, dy, dz).as_dvec3());
    let mut distances: Vec<f64> = Vec::new();
    for (i, corners) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|corner| Vec3::from_array(mesh.vertices[corner as usize]).as_dvec3());
        let (e1, e2, s) = (b - a, c - a, o - a);
        let (p, q) = (d.cross(e2), s.cross(e1));
        let det = e1.dot(p);
        let sizes = |a: DVec3, b: DVec3, c: DVec3| a.abs().dot(sum_of_sizes(b, c));
        let (u, v) = (s.dot(p) / det, d.dot(q) / det);
        let t = e2.dot(q) / det;
        let least = u.min(v).min(1.0 - u - v);
        // False for NaN.
        let is_away = least.abs() > 1.0 / 32.0;
        if !is_away {
            return false;
        }
        if least < 0.0 || t < -1e-3 {
            continue;
        }
        let loss = (sizes(e1, d, e2) / det.abs()).max(sizes(e2, s, e1) / e2.dot(q).abs());
        let is_other = i < mesh.triangles.len() / 2;
        let is_well = loss <= most && t > 1e-3;
        if !is_well || is_other && distances.iter().any(|&other| (other - t).abs() < 1e-3 * t) {
            return false;
        }
        distances.push(t);
    }
    true
}

/// Computes the cross product with absolute values and with additions instead of subtractions.
fn sum_of_sizes(a: DVec3, b: DVec3) -> DVec3 {
    let (a, b) = (a.abs(), b.abs());
    DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A thin shell, whose sides only exact arithmetic separates. A floating-point tracer may report either side first.
    #[test]
    fn hits_that_are_near_are_admitted() {
        const ULP_OF_100: f32 = 1.0 / 131_072.0;
        let heights = [-17.0 * ULP_OF_100, -16.0 * ULP_OF_100, 0.0, 1e-6, -ULP_OF_100];
        let sheets = heights.map(|z| [[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 1.0, z]]);
        let triangles = (0..5).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh { vertices: sheets.as_flattened().to_vec(), triangles };
        let hits = mesh.hits(&[0.0, 0.0, 100.0, 0.0, 0.0, -1.0, 0.0, f32::INFINITY]);
        let near = |ulps, prims: &[u32]| {
            let t = format!("{:08x}", 100.0f32.to_bits());
            assert_eq!(near_hit(&hits, ulps), Some(NearHit { t, prims: prims.to_vec() }));
        };
        near(0, &[3, 2]);
        near(8, &[3, 2, 4, 1]);
        near(9, &[3, 2, 4, 1, 0]);
        assert_eq!(near_hit(&[], 8), None);
    }
}
