//! Closed meshes with every origin inside: each ray must hit, and crosses the mesh an odd number of times.

use glam::{Vec3, Vec3Swizzles};

use super::Recipe;
use super::aim::{Target, middle, on_edge, turned, unit, whole};
use super::build::{both, circle, cuboid, mapped};
use super::sphere::icosphere;
use crate::generate::draw::{Draw, exp2, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new(
        "sphere",
        "a sphere from inside, at corners and edges (tinybvh #168)",
        |_| sphere(1.0, 0.0),
        from_inside,
    )
    .closed(),
    Recipe::new("sphere-100", "a sphere of radius 100 from inside", |_| sphere(100.0, 0.0), from_inside).closed(),
    Recipe::new("sphere-at-1000", "a sphere of radius 1 at 1,000 from inside", |_| sphere(1.0, 1e3), from_inside)
        .closed(),
    Recipe::new(
        "sphere-100-at-1000",
        "a sphere of radius 100 at 1,000 from inside",
        |_| sphere(100.0, 1e3),
        from_inside,
    )
    .closed(),
    Recipe::new(
        "sphere-at-1e6",
        "a sphere of radius 1 at 1,000,000, 32 floats wide: many triangles have no area",
        |_| sphere(1.0, 1e6),
        from_inside,
    )
    .closed(),
    Recipe::new(
        "sphere-100-at-1e6",
        "a sphere of radius 100 at 1,000,000 from inside",
        |_| sphere(100.0, 1e6),
        from_inside,
    )
    .closed(),
    Recipe::new(
        "sphere-flat",
        "a sphere with y times 0.001 from inside",
        |_| stretched(Vec3::new(1.0, 1e-3, 1.0)),
        from_inside,
    )
    .closed(),
    Recipe::new(
        "sphere-long",
        "a sphere with x times 1e10 from inside",
        |_| stretched(Vec3::new(1e10, 1.0, 1.0)),
        from_inside,
    )
    .closed(),
    Recipe::new("sphere-1e10", "a sphere of radius 1e10 from inside", |_| sphere(1e10, 0.0), from_inside).closed(),
    Recipe::new("sphere-1e-30", "a sphere of radius 1e-30 from inside", |_| sphere(1e-30, 0.0), from_inside).closed(),
    Recipe::new("sphere-1e37", "a sphere of radius 1e37 from inside", |_| sphere(1e37, 0.0), from_inside).closed(),
    Recipe::new(
        "sphere-subnormal",
        "a sphere of radius 1,000 · 2^-149 from inside: many triangles have no area",
        |_| sphere(1000.0 * exp2(-149), 0.0),
        from_inside,
    )
    .closed(),
    Recipe::new("sphere-axis", "rays along axes through corners of a sphere", |_| sphere(1.0, 0.0), along_axis)
        .closed(),
    Recipe::new("sphere-centre", "a sphere, all rays from its centre", |_| sphere(1.0, 0.0), from_centre).closed(),
    Recipe::new("shells", "three spheres around one point, rays from there", shells, from_centre).closed(),
    Recipe::new(
        "tetrahedron",
        "a tetrahedron of whole steps, rays exactly at corners and edges",
        tetrahedron,
        from_whole,
    )
    .closed(),
    Recipe::new(
        "cube",
        "a cube of whole steps, rays exactly at corners and edges and along diagonals",
        cube,
        from_whole,
    )
    .closed(),
    Recipe::new(
        "plate",
        "a plate 128 wide and 2^-20 thick from inside",
        |_| cuboid(Vec3::new(-64.0, -64.0, -exp2(-21)), Vec3::new(64.0, 64.0, exp2(-21))),
        from_inside,
    )
    .closed(),
    Recipe::new("torus", "a torus, rays from within its tube", torus, from_tube).closed(),
    Recipe::new("spindle", "two corners that 400 thin triangles share, from inside", spindle, from_inside).closed(),
];

fn sphere(radius: f32, offset: f32) -> Option<Mesh> {
    icosphere(3, radius, Vec3::new(offset, -offset, offset)).ok()
}

fn stretched(by: Vec3) -> Option<Mesh> {
    mapped(&sphere(1.0, 0.0)?, |v| v * by)
}

/// A corner, the middle of an edge, or another point of it.
fn rim(draw: &mut Draw, target: &Target<'_>, i: usize) -> Vec3 {
    let corners @ [a, b, _] = turned(draw, target.triangle(i));
    one_of([a, middle(a, b), on_edge(draw, corners)], draw)
}

/// Of a convex mesh that holds the inner ellipsoid of its box at half its size, from there.
fn from_inside(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let aim = rim(draw, target, i);
    let inner = (target.bounds.hi * 0.5 - target.bounds.lo * 0.5) * 0.4;
    let origin = target.bounds.centroid() + draw.direction() * draw.unit() * inner;
    whole(origin, if draw.one_in(4) { unit(aim - origin)? } else { aim - origin })
}

/// Half way to the axis plane is inside, because the sphere is symmetric.
fn along_axis(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, _, _] = turned(draw, target.triangle(i));
    let (axis, mut origin, mut direction) = (a.abs().max_position(), a, draw.zeros());
    origin[axis] *= 0.5;
    direction[axis] = draw.sign();
    whole(origin, direction)
}

fn from_centre(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    whole(Vec3::ZERO, rim(draw, target, i))
}

fn shells(_: &mut Draw) -> Option<Mesh> {
    let sphere = |radius| icosphere(2, radius, Vec3::ZERO).ok();
    both(&both(&sphere(1.0)?, &sphere(1.5)?)?, &sphere(2.0)?)
}

/// Each triangle in `steps` times `steps`, with corners in whole steps: the edge vectors must be multiples.
fn divided(corners: [Vec3; 3], steps: u32) -> Vec<[Vec3; 3]> {
    let [a, b, c] = corners;
    let at = |x: u32, y: u32| a + (b - a) / steps as f32 * x as f32 + (c - a) / steps as f32 * y as f32;
    let rows = (0..steps).flat_map(|y| (0..steps - y).map(move |x| (x, y)));
    rows.flat_map(|(x, y)| {
        let lower = [at(x, y), at(x + 1, y), at(x, y + 1)];
        let upper = [at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
        [Some(lower), (x + y + 1 < steps).then_some(upper)].into_iter().flatten()
    })
    .collect()
}

/// One vertex for equal corners.
fn welded(triangles: &[[Vec3; 3]]) -> Option<Mesh> {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut index = |v: Vec3| {
        vertices.iter().position(|&other| other == v).unwrap_or_else(|| {
            vertices.push(v);
            vertices.len() - 1
        }) as u32
    };
    let triangles = triangles.iter().map(|corners| corners.map(&mut index)).collect();
    Mesh::new(vertices, triangles).ok()
}

fn tetrahedron(_: &mut Draw) -> Option<Mesh> {
    let [a, b, c, d] = [[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]
        .map(|v| Vec3::from_array(v.map(|sign| 128.0 * (1 - 2 * sign) as f32)));
    let faces = [[a, b, c], [a, c, d], [a, d, b], [b, d, c]];
    welded(&faces.into_iter().flat_map(|face| divided(face, 8)).collect::<Vec<_>>())
}

fn cube(_: &mut Draw) -> Option<Mesh> {
    let plain = cuboid(Vec3::splat(-128.0), Vec3::splat(128.0))?;
    let faces = (0..12).flat_map(|i| divided(plain.triangle(i), 8));
    welded(&faces.collect::<Vec<_>>())
}

/// Whole numbers throughout: the rays meet corners and middles exactly.
fn from_whole(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    // Half of the inner ball's radius of the tetrahedron is 36.
    let origin = draw.ints(20);
    let (aim, axis) = (one_of([a, middle(a, b)], draw), draw.axis());
    whole(origin, one_of([aim - origin, aim - origin, aim - origin, axis, axis + axis.yzx(), draw.ints(1)], draw))
}

const TURNS: u32 = 32;
const SIDES: u32 = 20;

fn torus(_: &mut Draw) -> Option<Mesh> {
    let vertices = (0..TURNS * SIDES).map(|i| {
        let ([x, y], [out, z]) = (around(i / SIDES, TURNS), around(i % SIDES, SIDES));
        let radius = 4.0 + out;
        Vec3::new((x * radius) as f32, (y * radius) as f32, z as f32)
    });
    let index = |turn: u32, side: u32| turn % TURNS * SIDES + side % SIDES;
    let triangles = (0..TURNS * SIDES).flat_map(|i| {
        let (turn, side) = (i / SIDES, i % SIDES);
        let [a, b] = [index(turn, side), index(turn + 1, side)];
        let [c, d] = [index(turn + 1, side + 1), index(turn, side + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh::new(vertices.collect(), triangles.collect()).ok()
}

/// A point of the unit circle, `i` of `n`.
fn around(i: u32, n: u32) -> [f64; 2] {
    circle(4.0 * f64::from(i) / f64::from(n))
}

fn from_tube(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [x, y] = around(draw.below(TURNS as usize) as u32, TURNS);
    let middle = Vec3::new(4.0 * x as f32, 4.0 * y as f32, 0.0);
    let origin = middle + draw.direction() * 0.5 * draw.unit();
    whole(origin, rim(draw, target, i) - origin)
}

/// Two cones, base to base.
fn spindle(_: &mut Draw) -> Option<Mesh> {
    let sides = 400;
    let rim = (0..sides).map(|i| around(i, sides)).map(|[x, y]| Vec3::new(x as f32, y as f32, 0.0));
    let vertices = [Vec3::Z, Vec3::NEG_Z].into_iter().chain(rim).collect();
    let triangles = (0..sides).flat_map(|i| {
        let [a, b] = [2 + i, 2 + (i + 1) % sides];
        [[0, a, b], [1, b, a]]
    });
    Mesh::new(vertices, triangles.collect()).ok()
}
