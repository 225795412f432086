//! Whole coordinates: rays that meet corners, edges and planes exactly.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, late, middle, mixed, turned, whole};
use super::build::{both, cuboid, grid, mapped, of, triangles};
use crate::generate::draw::{Draw, exp2, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("edge", "rays exactly through the middles of edges", even, |draw, t, i| at_edge(draw, t, i, 0)),
    Recipe::new("vertex", "rays exactly through corners", even, |draw, t, i| at_vertex(draw, t, i, 0)),
    Recipe::new(
        "edge-2^-149",
        "rays exactly through the middles of edges, coordinates subnormal",
        |draw| shifted(draw, -149),
        |draw, t, i| at_edge(draw, t, i, -149),
    ),
    Recipe::new(
        "edge-2^-132",
        "rays exactly through the middles of edges, coordinates around 2^-126",
        |draw| shifted(draw, -132),
        |draw, t, i| at_edge(draw, t, i, -132),
    ),
    Recipe::new(
        "edge-2^-70",
        "rays exactly through the middles of edges, where products of three underflow",
        |draw| shifted(draw, -70),
        |draw, t, i| at_edge(draw, t, i, -70),
    ),
    Recipe::new(
        "edge-2^60",
        "rays exactly through the middles of edges, where products of three overflow",
        |draw| shifted(draw, 60),
        |draw, t, i| at_edge(draw, t, i, 60),
    ),
    Recipe::new(
        "edge-2^114",
        "rays exactly through the middles of edges, coordinates up to 2^126",
        |draw| shifted(draw, 114),
        |draw, t, i| at_edge(draw, t, i, 114),
    ),
    Recipe::new(
        "edge-at-2^24",
        "rays exactly through the middles of edges, at 2^24, where floats are 2 apart",
        at_2_24,
        edge_at_2_24,
    ),
    Recipe::new("beside-edge", "rays past the middles of edges by a unit in millions", wide, beside_edge),
    Recipe::new("along-edge", "rays along an edge: both of its triangles are seen edge-on", even, along_edge),
    Recipe::new("between-vertices", "rays from a corner to a corner, t exactly 0 and 1", even, between_vertices),
    Recipe::new("axis-grid", "coordinates from -4 to 4, rays along axes with zeros of either sign", small, axis_grid),
    Recipe::new("coplanar", "rays in the plane of many triangles, up to a wall across it", coplanar, in_plane),
    Recipe::new(
        "coplanar-skew",
        "rays in the skew plane of many triangles, up to a wall across it",
        skew,
        in_skew_plane,
    ),
    Recipe::new("cube-diagonal", "rays in the faces of cubes, along diagonals and edges", cubes, cube_diagonal),
    Recipe::new("t-junction", "corners at the middles of longer edges", t_junction, at_t_junction),
    Recipe::new("city", "boxes on a grid, rays along axes and diagonals through their edges", city, through_city),
    Recipe::new("city-thirds", "boxes on a grid of thirds, so that nothing is exact", city_thirds, mixed),
    Recipe::new("nested-boxes", "boxes around one point, rays through it and through the corners", nested, at_nested),
    Recipe::new("folded-edge", "pairs of triangles on the same side of their edge, rays at it", folded, at_fold),
    Recipe::new("fan-thin", "200 thin triangles around a corner, rays at it and at the spokes", fan, at_fan),
];

fn even(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 300, |draw| [(); 3].map(|()| draw.ints(512) * 2.0))
}

fn shifted(draw: &mut Draw, power: i32) -> Option<Mesh> {
    mapped(&even(draw)?, |v| v * exp2(power))
}

/// The middle of an edge and its distance from the origin are whole, in units of this power of two.
fn at_edge(draw: &mut Draw, target: &Target<'_>, i: usize, power: i32) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let origin = draw.ints(2048) * exp2(power);
    // Not `middle`: halves of odd subnormal numbers would be rounded.
    late(draw, origin, (a + b) * 0.5 - origin, 1.0)
}

fn at_vertex(draw: &mut Draw, target: &Target<'_>, i: usize, power: i32) -> Option<Ray> {
    let [a, _, _] = turned(draw, target.triangle(i));
    let origin = draw.ints(2048) * exp2(power);
    late(draw, origin, a - origin, 1.0)
}

fn at_2_24(draw: &mut Draw) -> Option<Mesh> {
    mapped(&even(draw)?, |v| v * 2.0 + exp2(24))
}

fn edge_at_2_24(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let origin = draw.ints(2048) * 2.0 + exp2(24);
    late(draw, origin, middle(a, b) - origin, 1.0)
}

fn wide(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 64, |draw| [(); 3].map(|()| draw.ints(1 << 20) * 2.0))
}

fn beside_edge(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let origin = draw.ints(1 << 21);
    let direction = middle(a, b) - origin + draw.axis();
    late(draw, origin, direction, 1.0 - exp2(-16))
}

fn along_edge(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    whole(a + (a - b) * one_of([0.0, 1.0, 2.0, -0.5], draw), b - a)
}

fn between_vertices(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([a, _, _], [b, _, _]) = (turned(draw, target.triangle(i)), target.corners(draw));
    let [tmin, tmax] = one_of([[0.0, 1.0], [0.0, 0.0], [1.0, 1.0], [0.0, f32::INFINITY], [1.0, 2.0]], draw);
    Ray::within(a, b - a, tmin, tmax).ok()
}

fn small(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 120, |draw| [(); 3].map(|()| draw.ints(4)))
}

fn axis_grid(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    whole(draw.ints(4), draw.axis())
}

/// Squares in the plane z = 0, and a wall at x = 9.
fn coplanar(_: &mut Draw) -> Option<Mesh> {
    let floor = grid(8, 8, |[x, y]| Vec3::new(x as f32, y as f32, 0.0))?;
    both(&floor, &grid(8, 4, |[y, z]| Vec3::new(9.0, y as f32, z as f32 - 2.0))?)
}

fn in_plane(draw: &mut Draw, _: &Target<'_>, i: usize) -> Option<Ray> {
    let y = draw.below(33) as f32 * 0.25;
    let direction = one_of([Vec3::X, Vec3::new(1.0, 0.5, -0.0), Vec3::new(2.0, -1.0, 0.0)], draw);
    let origin = Vec3::new(one_of([-1.0, 0.25, 3.0], draw), y, 0.0);
    if i.is_multiple_of(8) { whole(Vec3::new(9.0, y, 0.0), Vec3::NEG_X) } else { whole(origin, direction) }
}

/// The plane of these two directions, with this third one across it.
const SKEW: [Vec3; 3] = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-3.0, 1.0, 2.0), Vec3::new(2.0, -5.0, 1.0)];

fn skew(draw: &mut Draw) -> Option<Mesh> {
    let [a, b, c] = SKEW;
    let straight = coplanar(draw)?;
    mapped(&straight, |v| a * v.x + b * v.y + c * v.z)
}

fn in_skew_plane(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    let [a, b, _] = SKEW;
    let (x, y) = (one_of([-3.0, -1.0, 0.25, 3.0, 12.0], draw), draw.below(33) as f32 * 0.25);
    whole(a * x + b * y, a * one_of([1.0, 1.0, -1.0], draw) + b * one_of([0.0, 0.5, -0.5], draw))
}

fn cubes(_: &mut Draw) -> Option<Mesh> {
    (0..8).try_fold(cuboid(Vec3::NEG_ONE, Vec3::ONE)?, |mesh, i| {
        let centre = Vec3::new([4.0, -4.0][i & 1], [4.0, -4.0][i >> 1 & 1], [4.0, -4.0][i >> 2]);
        both(&mesh, &cuboid(centre - 1.0, centre + 1.0)?)
    })
}

fn cube_diagonal(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    // Faces are at 1, 3 and 5 with either sign; diagonals and edges run through these points.
    let face = |draw: &mut Draw| draw.sign() * one_of([1.0, 3.0, 5.0, 0.0], draw);
    let through = Vec3::new(face(draw), face(draw), face(draw));
    let direction = Vec3::new(draw.int(1), draw.int(1), draw.int(1));
    whole(through - direction * one_of([0.0, 1.0, 3.0, 12.0], draw), direction)
}

/// Rows of squares, each row of twice as many as the one below, so that every other corner is within an edge.
fn t_junction(_: &mut Draw) -> Option<Mesh> {
    (0..6).try_fold(grid(1, 1, |[x, y]| Vec3::new(64.0 * x as f32, y as f32 - 1.0, 0.0))?, |mesh, row| {
        // Bent back and forth, in whole steps along x so that the corners stay on the line.
        let point = |[x, y]: [usize; 2]| Vec3::new((x << (5 - row)) as f32, (row + y) as f32, ((row + y) % 2) as f32);
        both(&mesh, &grid(2 << row, 1, point)?)
    })
}

fn at_t_junction(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b)], draw);
    let back = one_of([Vec3::new(draw.int(64), draw.int(16), draw.sign() * 8.0), Vec3::Z * 8.0], draw);
    whole(aim + back, back * one_of([-1.0, -2.0, -0.5], draw))
}

fn city(draw: &mut Draw) -> Option<Mesh> {
    let ground = grid(8, 8, |[x, y]| Vec3::new(4.0 * x as f32 - 16.0, 4.0 * y as f32 - 16.0, 0.0))?;
    (0..64).try_fold(ground, |mesh, i| {
        let lo = Vec3::new((i % 8) as f32 * 4.0 - 15.0, (i / 8) as f32 * 4.0 - 15.0, 0.0);
        both(&mesh, &cuboid(lo, lo + Vec3::new(2.0, 2.0, (1 + draw.below(8)) as f32))?)
    })
}

fn through_city(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b)], draw);
    let direction = if draw.one_in(2) { draw.axis() } else { draw.ints(1) + draw.zeros() };
    whole(aim - direction * one_of([0.0, 1.0, 5.0, 40.0], draw), direction)
}

fn city_thirds(draw: &mut Draw) -> Option<Mesh> {
    mapped(&city(draw)?, |v| v / 3.0 + 0.1)
}

fn nested(_: &mut Draw) -> Option<Mesh> {
    let cube = |size: f32| cuboid(Vec3::splat(-size), Vec3::splat(size));
    (1..12).try_fold(cube(1.0)?, |mesh, power| both(&mesh, &cube(exp2(power))?))
}

fn at_nested(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b)], draw);
    let origin = one_of([Vec3::ZERO, -aim, aim * 2.0, aim + Vec3::new(1.0, 0.0, 0.0)], draw);
    whole(origin, if draw.one_in(2) { aim - origin } else { -aim })
}

/// Both triangles of a pair are behind or in front of their edge: a ray there hits both or none.
fn folded(draw: &mut Draw) -> Option<Mesh> {
    let pairs = (0..150).flat_map(|_| {
        let (a, b, c) = (draw.ints(512) * 2.0, draw.ints(512) * 2.0, draw.ints(512) * 2.0);
        [[a, b, c], [b, a, c + draw.ints(8)]]
    });
    of(pairs.collect::<Vec<_>>())
}

fn at_fold(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = target.triangle(i);
    let origin = draw.ints(2048);
    let aim = one_of([a, (a + b) * 0.5], draw);
    late(draw, origin, aim - origin, 1.0)
}

/// The spokes end on a square around the apex, at whole points.
fn fan(_: &mut Draw) -> Option<Mesh> {
    let rim = |i: usize| {
        let (side, along) = (i / 50 % 4, (i % 50) as f32 * 2.0 - 50.0);
        let [x, y] = [[along, -50.0], [50.0, along], [-along, 50.0], [-50.0, -along]][side];
        Vec3::new(x, y, -20.0)
    };
    of((0..200).map(|i| [Vec3::ZERO, rim(i), rim(i + 1)]))
}

fn at_fan(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [apex, a, b] = target.triangle(i);
    let aim = one_of([apex, a * 0.5, a * 0.25, middle(a, b)], draw);
    let origin = aim + Vec3::new(draw.int(40), draw.int(40), draw.sign() * (100.0 + draw.int(20)));
    whole(origin, (aim - origin) * one_of([1.0, 2.0, 0.5], draw))
}

#[cfg(test)]
mod tests;
