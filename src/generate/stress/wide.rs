//! Exact incidence of coordinates with all their bits: products of three need more than a double holds.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, late, middle, turned, whole};
use super::build::triangles;
use crate::generate::draw::{Draw, exp2, nudge, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("edge-wide", "rays exactly through the middles of edges, coordinates of 22 bits", wide, at_edge),
    Recipe::new("vertex-wide", "rays exactly through corners, coordinates of 22 bits", wide, at_vertex),
    Recipe::new("edge-from-0", "rays from 0 exactly through edges, of any size and of 23 bits", scattered, edge_from_0),
    Recipe::new(
        "vertex-from-0",
        "rays from 0 exactly through corners, of any size and of 24 bits",
        wild,
        vertex_from_0,
    ),
    Recipe::new("beside-vertex-from-0", "rays from 0 at corners, components an ulp off", wild, beside_vertex_from_0),
    Recipe::new("edge-fraction", "rays exactly through edges and corners at t of 1/3, 1/5 or 1/7", wide, at_fraction),
    Recipe::new("interval-at-fraction", "an end of the interval next to a t of 1/3, 1/5 or 1/7", wide, up_to_fraction),
    Recipe::new("box-corner-fraction", "rays that touch a corner of a box at t of 1/3, 1/5 or 1/7", octants, at_octant),
    Recipe::new("parallel-wide", "rays exactly parallel to a triangle's plane, in it or off it", wide, parallel),
    Recipe::new("parallel-ulp", "rays parallel to a triangle's plane, components an ulp off", wide, nearly_parallel),
    Recipe::new("t-is-0-wide", "origins exactly on a triangle, tmin or tmax 0", wide, on_triangle),
    Recipe::new("t-is-1-wide", "t exactly 1, an end of the interval at 1", wide, up_to_triangle),
    Recipe::new("shared-vertex-wide", "150 triangles with a common corner: t ties exactly", shared, at_shared),
    Recipe::new("needle-wide", "edges in line but for the last of 22 bits, rays at their corners", needles, at_vertex),
];

const MOST: i32 = 1 << 19;

/// Multiples of 4 up to 2^21, so that middles of middles are whole.
fn corner(draw: &mut Draw) -> Vec3 {
    draw.ints(MOST) * 4.0
}

fn wide(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 100, |draw| [corner(draw), corner(draw), corner(draw)])
}

/// Any whole point, so that differences to the corners are whole and have at most 24 bits.
fn origin(draw: &mut Draw) -> Vec3 {
    draw.ints(8 * MOST)
}

fn at_edge(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([a, b, _], origin) = (turned(draw, target.triangle(i)), origin(draw));
    late(draw, origin, middle(a, b) - origin, 1.0)
}

fn at_vertex(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([a, _, _], origin) = (turned(draw, target.triangle(i)), origin(draw));
    late(draw, origin, a - origin, 1.0)
}

/// Corners of 23 bits times a power of two for each triangle.
fn scattered(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 150, |draw| {
        let unit = exp2(draw.int(40) as i32 - 22);
        [(); 3].map(|()| draw.ints((1 << 23) - 1) * unit)
    })
}

/// The sum of two corners has 24 bits.
fn edge_from_0(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let (origin, power) = (draw.zeros(), draw.int(30) as i32);
    late(draw, origin, (a + b) * exp2(power), exp2(-power - 1))
}

fn wild(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 150, |draw| [draw.floats(-30, 30), draw.floats(-30, 30), draw.floats(-30, 30)])
}

fn vertex_from_0(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, _, _] = turned(draw, target.triangle(i));
    let (origin, power) = (draw.zeros(), draw.int(30) as i32);
    late(draw, origin, a * exp2(power), exp2(-power))
}

fn beside_vertex_from_0(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ray = vertex_from_0(draw, target, i)?;
    let direction = draw.nudged(ray.direction(), 1);
    Ray::within(ray.origin(), direction, ray.tmin() * (1.0 - exp2(-16)), ray.tmax()).ok()
}

/// A ray to the point with `speed` times the direction, from an origin for which all products are exact.
fn in_fraction(draw: &mut Draw, point: Vec3, speed: f32) -> (Vec3, Vec3) {
    let away = draw.ints(MOST) * 2.0;
    // At most 24 bits: 2^20 times 7, and the origin is within 2^21 + 2^20.
    (point - away, away * speed)
}

fn at_fraction(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let (point, speed) = (one_of([a, middle(a, b)], draw), one_of([3.0, 5.0, 7.0], draw));
    let (origin, direction) = in_fraction(draw, point, speed);
    late(draw, origin, direction, 1.0 / speed)
}

fn up_to_fraction(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (point, speed) = (point(draw, target, i), one_of([3.0, 5.0, 7.0], draw));
    let (origin, direction) = in_fraction(draw, point, speed);
    let end = nudge(1.0 / speed, draw.int(1) as i32);
    let [tmin, tmax] = one_of([[0.0, end], [end, f32::INFINITY], [end, end], [end, end.next_up()]], draw);
    Ray::within(origin, direction, tmin, tmax).ok()
}

/// Triangles with a corner that is a corner of their box.
fn octants(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 150, |draw| {
        let (apex, side) = (corner(draw), Vec3::new(draw.sign(), draw.sign(), draw.sign()));
        [apex, apex + draw.ints(MOST).abs() * side, apex + draw.ints(MOST).abs() * side]
    })
}

fn at_octant(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([apex, _, _], speed) = (target.triangle(i), one_of([3.0, 5.0, 7.0], draw));
    let (origin, direction) = in_fraction(draw, apex, speed);
    whole(origin, direction)
}

fn parallel(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([a, b, c], off) = (turned(draw, target.triangle(i)), origin(draw));
    let direction = one_of([b - a, middle(b, c) - a, (b - a) * 0.5 + (c - a) * 0.5], draw);
    whole(one_of([a, b, a - direction, off], draw), direction)
}

fn nearly_parallel(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ray = parallel(draw, target, i)?;
    whole(ray.origin(), draw.nudged(ray.direction(), 1))
}

/// A corner, the middle of an edge, or a point inside, which are whole.
fn point(draw: &mut Draw, target: &Target<'_>, i: usize) -> Vec3 {
    let [a, b, c] = turned(draw, target.triangle(i));
    one_of([a, middle(a, b), middle(middle(a, b), c)], draw)
}

fn on_triangle(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let tmax = one_of([0.0, f32::INFINITY, exp2(-149)], draw);
    Ray::within(point(draw, target, i), one_of([draw.direction(), origin(draw)], draw), 0.0, tmax).ok()
}

fn up_to_triangle(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (origin, point) = (origin(draw), point(draw, target, i));
    let ends = [[0.0, 1.0], [1.0, f32::INFINITY], [1.0, 1.0], [0.0, 1_f32.next_down()], [1_f32.next_up(), 2.0]];
    let [tmin, tmax] = one_of(ends, draw);
    Ray::within(origin, point - origin, tmin, tmax).ok()
}

const APEX: Vec3 = Vec3::new(1_234_567.0, -765_432.0, 543_219.0);

fn shared(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 150, |draw| {
        let corners = [APEX, corner(draw), corner(draw)];
        turned(draw, corners)
    })
}

fn at_shared(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    let (origin, tmin) = (origin(draw), one_of([0.0, 0.5, 0.999, 1.0], draw));
    Ray::within(origin, APEX - origin, tmin, f32::INFINITY).ok()
}

fn needles(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 150, |draw| {
        let (a, b) = (corner(draw), corner(draw));
        let corners = [a, b, middle(a, b) + draw.ints(1)];
        turned(draw, corners)
    })
}
