//! Both ends of the range of floats, and all of it at once.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, middle, mixed, place, toward, turned, whole, within};
use super::build::{mapped, triangles};
use crate::generate::draw::{Draw, exp2, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("near-max", "coordinates up to the greatest float: differences overflow", near_max, halved),
    Recipe::new("max-and-tiny", "corners at the greatest float and next to 0 in one triangle", max_and_tiny, halved),
    Recipe::new("scale-1e38", "the unit cube times 1e38", |draw| cube(draw, 1e38), mixed),
    Recipe::new("scale-1e30", "the unit cube times 1e30", |draw| cube(draw, 1e30), mixed),
    Recipe::new("scale-1e-30", "the unit cube times 1e-30", |draw| cube(draw, 1e-30), mixed),
    Recipe::new("scale-1e-38", "the unit cube times 1e-38: around the least normal number", |d| cube(d, 1e-38), mixed),
    Recipe::new("scale-1e-43", "the unit cube times 1e-43: some 70 floats wide", |draw| cube(draw, 1e-43), mixed),
    Recipe::new(
        "axes-apart",
        "axes in units of 1e-30, 1 and 1e30",
        |draw| mapped(&cube(draw, 1.0)?, |v| v * Vec3::new(1e-30, 1.0, 1e30)),
        axes_apart,
    ),
    Recipe::new("t-overflow", "t from 2^120 to 2^140: greater than the greatest float, or just not", far_layers, slow),
    Recipe::new("t-underflow", "t from 2^-133 to 2^-158: subnormal, or rounded to 0", near_layers, fast),
    Recipe::new(
        "t-subnormal-midpoint",
        "t in the middle of two subnormal numbers: it rounds to even",
        near_layers,
        fast_midpoint,
    ),
    Recipe::new("t-is-0", "origins exactly on a triangle, tmin 0", whole_triangles, from_plane),
    Recipe::new(
        "t-above-0",
        "origins a subnormal number in front of a triangle, on it or behind",
        at_zero,
        before_plane,
    ),
];

fn near_max(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 120, |draw| [(); 3].map(|()| draw.centred() * f32::MAX))
}

fn max_and_tiny(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 120, |draw| {
        let corners = [draw.centred() * f32::MAX, draw.floats(-149, 127), draw.floats(-149, -100)];
        turned(draw, corners)
    })
}

fn halved(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners @ [a, b, _] = turned(draw, target.triangle(i));
    let origin = one_of([draw.centred() * f32::MAX, draw.centred(), -a * 0.5], draw);
    let point = one_of([a, middle(a, b), within(draw, corners)], draw);
    whole(origin, toward(origin, point) * one_of([1.0, exp2(-64), exp2(-127)], draw))
}

fn cube(draw: &mut Draw, scale: f32) -> Option<Mesh> {
    triangles(draw, 80, |draw| [(); 3].map(|()| draw.cube() * scale))
}

fn axes_apart(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let origin = (draw.cube() * 3.0 - 1.0) * Vec3::new(1e-30, 1.0, 1e30);
    let point = place(draw, target.triangle(i));
    whole(origin, toward(origin, point))
}

/// Triangles across z, which grow with the distance so that slanted rays meet them.
fn layered(draw: &mut Draw, height: impl Fn(&mut Draw) -> f32) -> Option<Mesh> {
    triangles(draw, 100, |draw| {
        let z = height(draw);
        let corners = [Vec3::new(-64.0, -64.0, z), Vec3::new(192.0, draw.int(8), z), Vec3::new(draw.int(8), 192.0, z)];
        turned(draw, corners)
    })
}

fn far_layers(draw: &mut Draw) -> Option<Mesh> {
    layered(draw, |draw| draw.float(0, 20).abs())
}

fn slow(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let inside = within(draw, target.triangle(i));
    let direction = Vec3::Z * one_of([exp2(-120), exp2(-108), exp2(-128), exp2(-149) * 3.0, exp2(-126)], draw);
    whole(inside.with_z(-draw.unit()), direction)
}

/// At whole multiples of 2^-100.
fn near_layers(draw: &mut Draw) -> Option<Mesh> {
    layered(draw, |draw| draw.int(200) * exp2(-100))
}

fn fast(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = target.triangle(i);
    let inside = within(draw, corners);
    let origin = inside.with_z(corners[0].z - draw.int(200).abs() * exp2(-100));
    let direction = Vec3::Z * one_of([exp2(40), exp2(47), exp2(55), exp2(58), 3.0 * exp2(48)], draw);
    let tmin = one_of([0.0, 0.0, exp2(-149), 3.0 * exp2(-149)], draw);
    Ray::within(origin, direction, tmin, f32::INFINITY).ok()
}

/// Odd multiples of 2^-100 at a speed of 2^50: `t` is an odd multiple of 2^-150.
fn fast_midpoint(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = target.triangle(i);
    let odd = 2.0 * draw.below(100) as f32 + 1.0;
    let origin = within(draw, corners).with_z(corners[0].z - odd * exp2(-100));
    whole(origin, Vec3::Z * exp2(50))
}

fn whole_triangles(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 120, |draw| [(); 3].map(|()| draw.ints(64) * 4.0))
}

/// From a corner, from the middle of an edge, or from a point inside.
fn from_plane(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, c] = turned(draw, target.triangle(i));
    let origin = one_of([a, middle(a, b), middle(middle(a, b), c)], draw);
    let tmax = one_of([0.0, f32::INFINITY, exp2(-149)], draw);
    Ray::within(origin, one_of([draw.ints(9), draw.direction(), draw.axis()], draw), 0.0, tmax).ok()
}

fn at_zero(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 60, |draw| {
        let slope = draw.ints(4);
        let lift = |x: f32, y: f32| Vec3::new(x, y, slope.x * x + slope.y * y);
        turned(draw, [lift(-64.0, -64.0), lift(128.0, 0.0), lift(0.0, 128.0)])
    })
}

fn before_plane(draw: &mut Draw, _: &Target<'_>, _: usize) -> Option<Ray> {
    let origin = draw.ints(3) * exp2(-149);
    whole(origin, one_of([draw.axis(), draw.ints(3), Vec3::Z * exp2(one_of([-149, -100, 100], draw))], draw))
}
