//! Meshes as they occur, with rays of all kinds.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, middle, mixed, on_edge, toward, turned, whole, within};
use super::build::{circle, grid, mapped, shuffled, triangles};
use super::sphere::icosphere;
use crate::generate::draw::{Draw, one_of};
use crate::generate::procedural;
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("terrain", "a rough height field", terrain, mixed),
    Recipe::new("terrain-grazing", "a height field from afar, rays that barely rise or fall", terrain, far_grazing),
    Recipe::new("terrain-far", "a height field at 1,000,000", terrain_far, mixed),
    Recipe::new("half-floats", "coordinates with 11 bits, as of half precision: many are equal", half, mixed),
    Recipe::new("strands", "long thin curved ribbons", |_| Some(procedural::strands(5, 30)), mixed),
    Recipe::new("soup", "triangles of all sizes, some repeated", |_| Some(procedural::soup(5, 600)), mixed),
    Recipe::new("strip", "a strip 1,000 long and 0.01 wide, at an angle to all axes", strip, mixed),
    Recipe::new("disc", "a disc of 360 triangles around one corner (vertex leaks: Embree #181, #381)", disc, at_hub),
    Recipe::new(
        "disc-skew",
        "a disc in a skew plane off 0, its corners rounded, rays at the common one",
        disc_skew,
        at_hub,
    ),
    Recipe::new("shared-edges", "both triangles of an edge count where one should (Embree #188)", terrain, at_edges),
    Recipe::new("silhouette", "rays that touch a sphere from outside at corners and edges", sphere, at_silhouette),
    Recipe::new("bounce", "rays from the surface of a sphere in all directions", sphere, bounce),
    Recipe::new("bounce-far", "rays from the surface of a sphere at 1,000 in all directions", sphere_far, bounce),
    Recipe::new("pinhole", "rays from one point through every corner and edge (parry #444)", sphere, pinhole),
];

fn terrain(draw: &mut Draw) -> Option<Mesh> {
    grid(24, 24, |[x, y]| Vec3::new(x as f32 - 12.0, draw.unit(), y as f32 - 12.0))
}

fn terrain_far(draw: &mut Draw) -> Option<Mesh> {
    mapped(&terrain(draw)?, |v| v + Vec3::new(1e6, 0.0, -1e6))
}

fn far_grazing(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let point = on_edge(draw, corners);
    let away = draw.direction() * Vec3::new(1.0, 1e-4, 1.0);
    let origin = point + away * one_of([1e2, 1e4, 1e6], draw);
    whole(origin, point - origin)
}

fn half(draw: &mut Draw) -> Option<Mesh> {
    // Cuts off the last 13 of the 24 bits.
    let cut = |x: f32| f32::from_bits(x.to_bits() & !0x1fff);
    let mesh = triangles(draw, 400, |draw| {
        let centre = draw.centred() * 4.0;
        [(); 3].map(|()| centre + draw.centred() * 0.05)
    })?;
    mapped(&mesh, |v| Vec3::new(cut(v.x), cut(v.y), cut(v.z)))
}

fn strip(draw: &mut Draw) -> Option<Mesh> {
    let along = Vec3::new(0.36, 0.48, 0.8);
    let across = Vec3::new(0.8, -0.6, 0.0);
    let strip = grid(200, 1, |[x, y]| along * (5.0 * x as f32 - 500.0) + across * (0.01 * y as f32))?;
    shuffled(draw, &strip)
}

fn disc(_: &mut Draw) -> Option<Mesh> {
    let rim = (0..360).map(|i| circle(f64::from(i) / 90.0)).map(|[x, y]| Vec3::new(x as f32, y as f32, 0.0));
    let vertices = [Vec3::ZERO].into_iter().chain(rim).collect();
    Mesh::new(vertices, (0..360).map(|i| [0, 1 + i, 1 + (i + 1) % 360]).collect()).ok()
}

fn disc_skew(draw: &mut Draw) -> Option<Mesh> {
    let (a, b) = (Vec3::new(0.36, 0.48, 0.8), Vec3::new(0.8, -0.6, 0.1));
    mapped(&disc(draw)?, |v| a * v.x + b * v.y + Vec3::new(3.1, -7.3, 12.7))
}

/// At the corner that all triangles of a disc share, or at a spoke.
fn at_hub(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [hub, rim, _] = target.triangle(i);
    let aim = one_of([hub, hub, middle(hub, rim), on_edge(draw, [hub, rim, hub])], draw);
    let origin = aim + draw.direction() * one_of([1.0, 10.0, 100.0], draw);
    whole(origin, aim - origin)
}

fn at_edges(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners @ [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b), on_edge(draw, corners)], draw);
    let origin = aim + Vec3::new(draw.int(3), 4.0, draw.int(3));
    whole(origin, one_of([Vec3::NEG_Y, aim - origin], draw))
}

fn sphere(_: &mut Draw) -> Option<Mesh> {
    icosphere(3, 1.0, Vec3::ZERO).ok()
}

fn sphere_far(_: &mut Draw) -> Option<Mesh> {
    icosphere(3, 1.0, Vec3::splat(1e3)).ok()
}

fn at_silhouette(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b)], draw);
    let along = aim.cross(draw.direction()).try_normalize()?;
    let origin = aim - along * one_of([1.0, 8.0, 100.0], draw);
    whole(origin, one_of([along, aim - origin], draw))
}

fn bounce(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let origin = one_of([corners[0], middle(corners[0], corners[1]), within(draw, corners)], draw);
    let other = target.corners(draw);
    whole(origin, one_of([draw.direction(), toward(origin, on_edge(draw, other))], draw))
}

/// The corners and the middles of the edges in turn.
fn pinhole(_: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let eye = Vec3::new(1.7, -2.3, 0.9);
    let [a, b, c] = target.triangle(i / 6);
    let aim = [a, b, c, middle(a, b), middle(b, c), middle(c, a)][i % 6];
    whole(eye, aim - eye)
}
