//! Equal distances: of several triangles, after rounding, and between two floats.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, middle, mixed, place, turned, whole, within};
use super::build::{both, mapped, of, shuffled, triangles};
use super::sphere::icosphere;
use crate::generate::draw::{Draw, exp2, nudge, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("stack-ulp", "parallel triangles an ulp apart, far ones first: t ties by rounding", stack, down_stack),
    Recipe::new("stack-tilted", "triangles that differ from a plane by an ulp a corner", tilted, down_stack),
    Recipe::new(
        "shells-ulp",
        "spheres 1, 2 and 300 ulps apart, inner ones first, from 10 to 10^5 radii",
        shells,
        at_shells,
    ),
    Recipe::new("overlap-coplanar", "overlapping triangles in a skew plane: t ties exactly", overlap, across_skew),
    Recipe::new("shared-vertex", "300 triangles with a common corner in space, rays at it", shared, at_shared),
    Recipe::new("copies", "64 copies of each triangle, beginning at any corner", copies, mixed),
    Recipe::new("three-times", "a mesh three times, once with turned corners", three_times, mixed),
    Recipe::new("both-sides", "each triangle again with the other orientation", reversed, mixed),
    Recipe::new("midpoint-even", "t exactly in the middle of two floats: it rounds to even", ramps, midpoint),
    Recipe::new("midpoint-near", "t next to such a middle, by 2^-54 to 2^-124 of it", ramps, near_midpoint),
    Recipe::new("midpoint-sheared", "t within 2^-40 of such a middle, from any direction", ramps, slanted_midpoint),
    Recipe::new("tmax-at-hit", "tmax at a hit, an ulp before it and after it", layers, |draw, target, i| {
        at_layer(draw, target, i, 1.0, false)
    }),
    Recipe::new("tmin-at-hit", "tmin at a hit, an ulp before it and after it", layers, |draw, target, i| {
        at_layer(draw, target, i, 1.0, true)
    }),
    Recipe::new("tmax-at-third", "tmax at the float next to t, where t is a third of a whole", layers, |d, t, i| {
        at_layer(d, t, i, 3.0, false)
    }),
    Recipe::new("tmin-at-third", "tmin at the float next to t, where t is a third of a whole", layers, |d, t, i| {
        at_layer(d, t, i, 3.0, true)
    }),
    Recipe::new("interval-at-midpoint", "an end of the interval at one of the floats around t", ramps, midpoint_ends),
    Recipe::new("interval-in-gap", "tmin and tmax are neighbours, and t is between them", ramps, midpoint_gap),
];

const ABOVE: f32 = 1024.0;

fn stack(draw: &mut Draw) -> Option<Mesh> {
    let mut height = 200;
    triangles(draw, 200, |draw| {
        height -= 1;
        around(draw, 64).map(|v| v.with_z(nudge(1.0, height)))
    })
}

fn tilted(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| around(draw, 64).map(|v| v.with_z(nudge(1.0, draw.int(1) as i32))))
}

/// A triangle in the plane z = 0 around the square from `-size / 2` to `size / 2`, with whole corners.
fn around(draw: &mut Draw, size: i32) -> [Vec3; 3] {
    let mut far = || (size + draw.below(size as usize) as i32) as f32;
    let corners =
        [Vec3::new(-far(), -far(), 0.0), Vec3::new(4.0 * far(), -far(), 0.0), Vec3::new(-far(), 4.0 * far(), 0.0)];
    turned(draw, corners)
}

fn down_stack(draw: &mut Draw, _: &Target<'_>, i: usize) -> Option<Ray> {
    let (x, y) = (draw.int(16), draw.int(16));
    let side = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    let tilt = Vec3::new(draw.int(1), draw.int(1), 0.0) * one_of([0.0, exp2(-8)], draw);
    whole(Vec3::new(x, y, ABOVE * side) - tilt * ABOVE, tilt - Vec3::Z * side)
}

fn shells(_: &mut Draw) -> Option<Mesh> {
    let sphere = |ulps| icosphere(2, nudge(1.0, ulps), Vec3::ZERO).ok();
    both(&both(&sphere(0)?, &sphere(1)?)?, &both(&sphere(2)?, &sphere(300)?)?)
}

fn at_shells(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let point = if i.is_multiple_of(4) { place(draw, target.triangle(i)) } else { draw.cube() * 1.6 - 0.8 };
    let origin = draw.direction() * one_of([10.0, 300.0, 3000.0, 1e5], draw);
    whole(origin, point - origin)
}

fn overlap(draw: &mut Draw) -> Option<Mesh> {
    let flat = triangles(draw, 200, |draw| [(); 3].map(|()| draw.ints(16)))?;
    mapped(&flat, |v| Vec3::new(v.x, v.y, 3.0 * v.x - 2.0 * v.y))
}

fn across_skew(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let aim = one_of([a, middle(a, b)], draw);
    let back = draw.ints(100);
    whole(aim - back, back * one_of([1.0, 3.0], draw))
}

const APEX: Vec3 = Vec3::new(3.0, -7.0, 5.0);

fn shared(draw: &mut Draw) -> Option<Mesh> {
    let fan = triangles(draw, 300, |draw| [APEX, APEX + draw.ints(64), APEX + draw.ints(64)].map(|v| v))?;
    let mut turns = fan.triangles().to_vec();
    turns.iter_mut().enumerate().for_each(|(i, corners)| corners.rotate_left(i % 3));
    Mesh::new(fan.vertices().to_vec(), turns).ok()
}

fn at_shared(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    let back = draw.ints(1000);
    let direction = back * one_of([1.0, 2.0, 0.5], draw);
    let tmin = one_of([0.0, 0.5], draw);
    Ray::within(APEX - back, direction, tmin, f32::INFINITY).ok()
}

fn few(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 24, |draw| [draw.cube(), draw.cube(), draw.cube()])
}

fn copies(draw: &mut Draw) -> Option<Mesh> {
    let mesh = few(draw)?;
    let copies = (0..64).flat_map(|_| (0..mesh.triangles().len()).map(|i| mesh.triangle(i)));
    let turned: Vec<_> = copies.map(|corners| turned(draw, corners)).collect();
    shuffled(draw, &of(turned)?)
}

fn three_times(draw: &mut Draw) -> Option<Mesh> {
    let mesh = few(draw)?;
    let turned = mesh.triangles().iter().map(|&[a, b, c]| [b, c, a]).collect();
    let turned = Mesh::new(mesh.vertices().to_vec(), turned).ok()?;
    let all = both(&both(&turned, &mesh)?, &mesh)?;
    shuffled(draw, &all)
}

fn reversed(draw: &mut Draw) -> Option<Mesh> {
    let mesh = few(draw)?;
    let back = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    let all = both(&mesh, &Mesh::new(mesh.vertices().to_vec(), back).ok()?)?;
    shuffled(draw, &all)
}

/// The height of the ramps: the distance to points at -2^23 and below has 25 bits, so the odd ones are no floats.
const HEIGHT: f32 = exp2(23);

/// Triangles in planes that rise by 1 a unit of x, at whole heights.
fn ramps(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 60, |draw| {
        let height = HEIGHT + draw.below(4096) as f32 + 4096.0;
        around(draw, 512).map(|v| v.with_z(height + v.x))
    })
}

/// The start of a ray along z whose distance to the ramp is whole, odd, and above 2^24.
fn below_ramp(draw: &mut Draw, target: &Target<'_>, i: usize, x: f32, y: f32) -> Vec3 {
    let [a, _, _] = target.triangle(i);
    let height = a.z - a.x + x.trunc();
    let start = -HEIGHT - 4096.0 - draw.below(1 << 20) as f32;
    // Both are whole; their difference is odd if one of them is.
    let odd = (height as i64 - start as i64) & 1 == 1;
    Vec3::new(x, y, if odd { start } else { start - 1.0 })
}

fn midpoint(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (x, y) = (draw.int(256), draw.int(256));
    whole(below_ramp(draw, target, i, x, y), Vec3::Z)
}

fn near_midpoint(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (power, y) = (one_of([-30, -31, -40, -70, -100], draw), draw.int(256));
    let x = draw.sign() * exp2(power);
    whole(below_ramp(draw, target, i, x, y), Vec3::Z)
}

/// The ray drifts by a tiny part of the ramp's slope while it rises.
fn slanted_midpoint(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (x, y) = (draw.int(256), draw.int(256));
    let powers = [-42, -50, -80];
    let drift = Vec3::new(draw.sign() * exp2(one_of(powers, draw)), draw.sign() * exp2(one_of(powers, draw)), 1.0);
    whole(below_ramp(draw, target, i, x, y), drift)
}

fn midpoint_ends(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ray = midpoint(draw, target, i)?;
    let near = nudge(distance(&ray, target, i), draw.int(1) as i32);
    let [tmin, tmax] = one_of([[0.0, near], [near, f32::INFINITY], [near, near]], draw);
    Ray::within(ray.origin(), ray.direction(), tmin, tmax).ok()
}

fn midpoint_gap(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let ray = near_midpoint(draw, target, i)?;
    let near = distance(&ray, target, i);
    let tmin = if draw.one_in(2) { near } else { near.next_down() };
    Ray::within(ray.origin(), ray.direction(), tmin, tmin.next_up()).ok()
}

/// To the ramp, rounded down or up by chance of the operations; a middle has a float on either side.
fn distance(ray: &Ray, target: &Target<'_>, i: usize) -> f32 {
    let [a, _, _] = target.triangle(i);
    (a.z - a.x + ray.origin().x.trunc()) - ray.origin().z
}

/// Triangles across z at whole heights from 1 to 100.
fn layers(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 100, |draw| {
        let height = 1.0 + draw.below(100) as f32;
        around(draw, 8).map(|v| v.with_z(height))
    })
}

/// At a layer, with an end of the interval next to it; `t` is whole over `speed`.
fn at_layer(draw: &mut Draw, target: &Target<'_>, i: usize, speed: f32, first: bool) -> Option<Ray> {
    let [a, b, c] = target.triangle(i);
    let inside = within(draw, [a, b, c]);
    let origin = Vec3::new(inside.x, inside.y, -draw.int(1000).abs());
    let end = nudge((a.z - origin.z) / speed, draw.int(1) as i32);
    let [tmin, tmax] = if first { [end, f32::INFINITY] } else { [0.0, end] };
    Ray::within(origin, Vec3::Z * speed, tmin, tmax).ok()
}
