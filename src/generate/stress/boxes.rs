//! Hard cases for slab tests: planes through the origin, flat boxes, directions close to zero.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, middle, mixed, place, toward, turned, whole, within};
use super::build::{both, grid, of, triangles};
use crate::generate::draw::{Draw, exp2, nudge, one_of};
use crate::geom::{Aabb, Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new(
        "plane-origin",
        "origins on a plane of a box, directions along it with zeros of either sign",
        whole_mesh,
        on_plane,
    ),
    Recipe::new(
        "plane-exit",
        "origins on a plane of a box, directions a subnormal number off it",
        whole_mesh,
        off_plane,
    ),
    Recipe::new("flat-box", "triangles across an axis: their boxes are flat", flat, at_flat),
    Recipe::new("flat-box-ulp", "boxes an ulp thick, far from 0", thin, mixed),
    Recipe::new("point-box", "triangles that are points on edges of others: their boxes are points", dotted, at_dots),
    Recipe::new(
        "signed-zeros",
        "corners with zeros of either sign, origins and directions too (tinybvh #282)",
        zeros,
        at_zeros,
    ),
    Recipe::new(
        "direction-2^-149",
        "subnormal components of the direction, boxes subnormal there",
        subnormal,
        subnormal_ray,
    ),
    Recipe::new(
        "reciprocal-overflow",
        "components of 2^-127 to 2^-130, whose reciprocal may overflow",
        gap,
        across_gap,
    ),
    Recipe::new("box-corner", "rays that touch a corner of a box, and a triangle there, exactly", octants, at_corner),
    Recipe::new("box-edge", "rays that touch an edge of a box within an ulp", wedges, at_wedge),
    Recipe::new("ize", "a ray that 2 ulps of padding lose, where Ize 2013 holds them enough", ize, at_ize),
    Recipe::new("tmax-is-near", "tmax where the ray enters the box, at, before and after", flat, |draw, target, i| {
        ending_at(draw, target, i, false)
    }),
    Recipe::new("tmin-is-far", "tmin where the ray leaves the box, at, before and after", flat, |draw, target, i| {
        ending_at(draw, target, i, true)
    }),
];

fn whole_mesh(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let centre = draw.ints(8);
        [(); 3].map(|()| centre + draw.ints(2))
    })
}

/// A point of the triangle, but on a plane of its box or of the whole, with the axis of the plane.
fn plane_point(draw: &mut Draw, target: &Target<'_>, i: usize) -> (Vec3, usize) {
    let corners = target.triangle(i);
    let aabb = if draw.one_in(4) { target.bounds } else { Aabb::of(&corners) };
    let (axis, plane) = (draw.below(3), one_of([aabb.lo, aabb.hi], draw));
    let mut point = within(draw, corners);
    point[axis] = plane[axis];
    (point, axis)
}

fn on_plane(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (point, axis) = plane_point(draw, target, i);
    let mut direction = one_of([draw.ints(3), draw.direction()], draw);
    direction[axis] = draw.zeros()[axis];
    whole(point - direction * one_of([0.0, 1.0, 4.0], draw), direction)
}

fn off_plane(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (point, axis) = plane_point(draw, target, i);
    let mut direction = one_of([draw.ints(3), draw.direction()], draw);
    direction[axis] = draw.float(-149, -120);
    let mut origin = point - direction * one_of([0.0, 1.0, 4.0], draw);
    origin[axis] = point[axis];
    whole(origin, direction)
}

fn flat(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let (axis, centre) = (draw.below(3), draw.ints(16));
        [(); 3].map(|()| {
            let mut corner = centre + draw.ints(4);
            corner[axis] = centre[axis];
            corner
        })
    })
}

fn at_flat(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let point = place(draw, target.triangle(i));
    let direction = if draw.one_in(2) { draw.axis() } else { draw.ints(2) + draw.zeros() };
    whole(point - direction * one_of([0.0, 1.0, 16.0], draw), direction)
}

fn thin(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let (axis, centre) = (draw.below(3), draw.centred() * 4.0 + 100.0);
        [(); 3].map(|()| {
            let mut corner = centre + draw.centred();
            corner[axis] = nudge(centre[axis], draw.int(1) as i32);
            corner
        })
    })
}

fn dotted(draw: &mut Draw) -> Option<Mesh> {
    let parts = (0..60).flat_map(|_| {
        let corners @ [a, b, _] = [(); 3].map(|()| draw.ints(16) * 2.0);
        [[a; 3], corners, [middle(a, b); 3], [draw.ints(16); 3]]
    });
    of(parts.collect::<Vec<_>>())
}

fn at_dots(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let direction = if draw.one_in(2) { draw.axis() } else { draw.ints(5) };
    whole(one_of([a, middle(a, b)], draw) - direction * one_of([0.0, 1.0, 8.0], draw), direction)
}

/// Squares in the three planes through 0, with zeros of random signs.
fn zeros(draw: &mut Draw) -> Option<Mesh> {
    let mut plane = |axis: usize| {
        grid(4, 4, |[x, y]| {
            let mut point = [draw.zeros().x, x as f32 - 2.0, y as f32 - 2.0];
            point.rotate_right(axis);
            // The middle of the grid is 0 in other components, too.
            let point = Vec3::from_array(point);
            Vec3::select(point.cmpeq(Vec3::ZERO), draw.zeros(), point)
        })
    };
    both(&both(&plane(0)?, &plane(1)?)?, &plane(2)?)
}

fn at_zeros(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    let signed = |draw: &mut Draw, v: Vec3| Vec3::select(v.cmpeq(Vec3::ZERO), draw.zeros(), v);
    let (origin, direction) = (draw.ints(3), draw.ints(1));
    whole(signed(draw, origin), signed(draw, direction))
}

/// One axis in subnormal units, the other axes in integers.
fn subnormal(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| [(); 3].map(|()| draw.ints(64) * Vec3::new(exp2(-149), 1.0, 1.0)))
}

fn subnormal_ray(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let point = place(draw, target.triangle(i));
    let direction = draw.ints(3) * Vec3::new(exp2(-149), 1.0, 1.0);
    whole(point - direction * one_of([0.0, 1.0, 8.0, 32.0], draw), direction)
}

/// Boxes whose planes are 2^-116 apart on one axis, about 1e-35, and thousands on the other axes.
fn gap(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| [(); 3].map(|()| draw.ints(16) * Vec3::new(1024.0, exp2(-116), 1024.0)))
}

fn across_gap(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let point = place(draw, target.triangle(i));
    let small = draw.sign() * exp2(-127 - draw.below(4) as i32);
    let direction = Vec3::new(draw.int(1), small, draw.sign());
    whole(point - direction * one_of([8192.0, 16384.0, 1024.0, 4.0], draw), direction)
}

/// Triangles with a corner that is the least or the greatest in all axes, so that it is a corner of the box.
fn octants(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let (corner, side) = (draw.ints(16), Vec3::new(draw.sign(), draw.sign(), draw.sign()));
        [corner, corner + draw.ints(8).abs() * side, corner + draw.ints(8).abs() * side]
    })
}

fn at_corner(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ([corner, _, _], direction) = (target.triangle(i), draw.ints(2047));
    let steps = draw.below(2048) as f32;
    whole(corner - direction * steps, direction)
}

/// Planks on their upper left edge, which is an edge of their box.
fn wedges(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let [x, y] = [draw.between(1.0, 4.0), draw.between(1.0, 4.0)];
        wedge(x, y, x + draw.between(1.0, 8.0), y - draw.between(1.0, 4.0))
    })
}

/// From an edge along z down to a point.
fn wedge(x: f32, y: f32, far_x: f32, far_y: f32) -> [Vec3; 3] {
    [Vec3::new(x, y, -1.0), Vec3::new(x, y, 1.0), Vec3::new(far_x, far_y, 0.0)]
}

fn at_wedge(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [edge, _, _] = target.triangle(i);
    let direction = Vec3::new(draw.between(1.0, 2.0), draw.between(1.0, 2.0), 0.0);
    let origin = edge.with_z(0.0) - direction * draw.between(0.1, 4.0);
    let off = one_of([0, 0, 1], draw);
    whole(draw.nudged(origin, off), direction)
}

/// The box of the known ray first, then boxes that differ from it by ulps.
fn ize(draw: &mut Draw) -> Option<Mesh> {
    let [x, y] = [0x4000_4c97, 0x400a_5221].map(f32::from_bits);
    triangles(draw, 60, |draw| {
        let by = if draw.one_in(2) { Vec3::ZERO } else { draw.ints(2) };
        wedge(nudge(x, by.x as i32), nudge(y, by.y as i32), 9.0, -1.0)
    })
}

fn at_ize(draw: &mut Draw, _: &Target<'_>, i: usize) -> Option<Ray> {
    let origin = Vec3::new(f32::from_bits(0x33fd_9472), f32::from_bits(0xb3f2_3a88), 0.0);
    let direction = Vec3::new(f32::from_bits(0x3feb_b676), f32::from_bits(0x3ffe_1fe8), 0.0);
    let most = if i.is_multiple_of(4) { 0 } else { 2 };
    whole(draw.nudged(origin, 8 * most).with_z(0.0), draw.nudged(direction, most).with_z(0.0))
}

/// A whole distance in whole steps, so that entering the flat box, leaving it and the hit are at the same `t`.
fn ending_at(draw: &mut Draw, target: &Target<'_>, i: usize, first: bool) -> Option<Ray> {
    let [a, b, c] = turned(draw, target.triangle(i));
    let (aim, steps) = (one_of([a, a, b, c], draw), 1.0 + draw.below(16) as f32);
    let direction = draw.ints(4);
    let end = nudge(steps, draw.int(1) as i32);
    let [tmin, tmax] = if first { [end, f32::INFINITY] } else { [0.0, end] };
    Ray::within(aim - direction * steps, toward(aim - direction, aim), tmin, tmax).ok()
}
