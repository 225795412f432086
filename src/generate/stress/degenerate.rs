//! Triangles without area, or with almost no area.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, middle, mixed, on_edge, turned, whole, within};
use super::build::{of, triangles};
use crate::generate::draw::{Draw, exp2, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("collinear", "third corners that mirror the first at the second", collinear, mixed),
    Recipe::new("collinear-whole", "the same with whole coordinates: exactly no area", collinear_whole, at_whole),
    Recipe::new("two-equal-corners", "triangles that are segments, among ordinary ones", segments, mixed),
    Recipe::new("three-equal-corners", "triangles that are points, among ordinary ones", points, mixed),
    Recipe::new("needle", "third corners on the first edge but for rounding", needles, mixed),
    Recipe::new("needle-long", "needles a million long and an ulp wide", long_needles, mixed),
    Recipe::new("seam", "triangles without area along the edges of ordinary ones, rays at the edges", seam, at_whole),
    Recipe::new("small-determinant", "legs of 0.0002: a fixed epsilon rejects them (tinybvh #283)", small, at_small),
    Recipe::new("tiny-determinant", "planes 2^-20 to 2^-120 off the direction of the ray", steep, along_steep),
    Recipe::new("u-near-0", "u within 2^-24 to 2^-149 of 0, on either side", right_angles, |draw, _, _| {
        let (x, y) = (hair(draw), draw.unit());
        upright(draw, x, y)
    }),
    Recipe::new("v-near-0", "v within 2^-24 to 2^-149 of 0, on either side", right_angles, |draw, _, _| {
        let (x, y) = (draw.unit(), hair(draw));
        upright(draw, x, y)
    }),
    Recipe::new("w-near-0", "u + v within an ulp of 1, on either side", right_angles, |draw, _, _| {
        let x = draw.unit();
        let y = draw.nudged(Vec3::splat(1.0 - x), 1).x;
        upright(draw, x, y)
    }),
    Recipe::new("corner-near", "all three weights next to 0 or 1", right_angles, |draw, _, _| {
        let (x, y) = (hair(draw), hair(draw));
        let one = draw.nudged(Vec3::ONE, 1).x;
        let [x, y] = one_of([[x, y], [one, y], [x, one]], draw);
        upright(draw, x, y)
    }),
];

fn collinear(draw: &mut Draw) -> Option<Mesh> {
    with_ordinary(draw, |draw| {
        let (a, b) = (draw.cube(), draw.cube());
        [a, b, b * 2.0 - a]
    })
}

/// Half of the triangles by this, the others ordinary.
fn with_ordinary(draw: &mut Draw, mut special: impl FnMut(&mut Draw) -> [Vec3; 3]) -> Option<Mesh> {
    triangles(draw, 120, |draw| {
        let corners = if draw.one_in(2) { special(draw) } else { [draw.cube(), draw.cube(), draw.cube()] };
        turned(draw, corners)
    })
}

fn collinear_whole(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let (a, step) = (draw.ints(64) * 2.0, draw.ints(16) * 2.0);
        let c = if draw.one_in(4) { draw.ints(64) } else { a + step * one_of([2.0, 3.0, -1.0, 0.5], draw) };
        turned(draw, [a, a + step, c])
    })
}

fn at_whole(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let origin = draw.ints(256) * 2.0;
    whole(origin, one_of([a, middle(a, b)], draw) - origin)
}

fn segments(draw: &mut Draw) -> Option<Mesh> {
    with_ordinary(draw, |draw| {
        let (a, b) = (draw.cube(), draw.cube());
        [a, a, b]
    })
}

fn points(draw: &mut Draw) -> Option<Mesh> {
    with_ordinary(draw, |draw| [draw.cube(); 3])
}

fn needles(draw: &mut Draw) -> Option<Mesh> {
    with_ordinary(draw, |draw| {
        let (a, b) = (draw.cube(), draw.cube());
        let point = on_edge(draw, [a, b, a]);
        [a, b, draw.nudged(point, 1)]
    })
}

fn long_needles(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 120, |draw| {
        let (a, b) = (draw.centred() * 1e6, draw.centred() * 1e6);
        let point = on_edge(draw, [a, b, a]);
        [a, b, draw.nudged(point, 1)]
    })
}

/// Each ordinary triangle with the triangles of its edges' ends and middles.
fn seam(draw: &mut Draw) -> Option<Mesh> {
    let parts = (0..60).flat_map(|_| {
        let corners @ [a, b, c] = [(); 3].map(|()| draw.ints(128) * 2.0);
        let thin = |a, b| [a, middle(a, b), b];
        [thin(a, b), corners, thin(b, c), thin(c, a), [a, a, b]]
    });
    of(parts.collect::<Vec<_>>())
}

const LEG: f32 = 2e-4;

fn small(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 400, |draw| {
        let a = Vec3::new(draw.int(10), draw.int(10), draw.int(3)) * LEG;
        turned(draw, [a, a + Vec3::X * LEG, a + Vec3::Y * LEG])
    })
}

fn at_small(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, c] = target.triangle(i);
    let centre = (a + b + c) / 3.0;
    let origin = Vec3::new(centre.x, centre.y, -1.0);
    whole(origin, one_of([Vec3::Z, Vec3::Z * LEG, centre - origin], draw))
}

/// Walls along z that are off by a power of two.
fn steep(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 100, |draw| {
        let off = draw.float(-120, -20);
        let x = one_of([0.0, 0.0, draw.int(4)], draw);
        let corners =
            [Vec3::new(x, -4.0, -4.0), Vec3::new(x + off, draw.int(2), 4.0), Vec3::new(x - off, 4.0, draw.int(3))];
        turned(draw, corners)
    })
}

fn along_steep(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let point = within(draw, corners).with_x(corners[0].x);
    let direction = Vec3::new(one_of([0.0, -0.0, draw.float(-140, -40)], draw), one_of([0.0, 0.25], draw), 1.0);
    whole(point - direction * one_of([8.0, 1.0, 0.0], draw), direction)
}

/// Half of a square from 0 to 1, in planes of different heights and slopes.
fn right_angles(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 60, |draw| {
        let (height, slope) = (draw.int(64), draw.ints(8));
        let lift = |x: f32, y: f32| Vec3::new(x, y, height + slope.x * x + slope.y * y);
        turned(draw, [lift(0.0, 0.0), lift(1.0, 0.0), lift(0.0, 1.0)])
    })
}

/// Zero or next to it.
fn hair(draw: &mut Draw) -> f32 {
    let tiny = exp2(one_of([-24, -30, -60, -126, -149], draw));
    one_of([tiny, -tiny, tiny, -tiny, 0.0, -0.0], draw)
}

fn upright(draw: &mut Draw, x: f32, y: f32) -> Option<Ray> {
    let side = draw.sign();
    let direction = Vec3::Z * side * one_of([1.0, 3.0, exp2(-20)], draw);
    whole(Vec3::new(x, y, -100.0 * side), direction)
}
