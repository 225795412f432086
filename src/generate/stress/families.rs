//! Random triangles at many sizes, places and shapes, with rays at one of them each.

use glam::Vec3;

use super::Recipe;
use super::aim::{Target, at, middle, mixed, on_edge, place, toward, turned, whole, within};
use super::build::{mapped, triangles};
use crate::generate::draw::{Draw, exp2, one_of};
use crate::geom::{Mesh, Ray};

pub(super) const CASES: &[Recipe] = &[
    Recipe::new("uniform", "great triangles in the unit cube, rays into it from near and far", uniform, into_the_box),
    Recipe::new("small-triangles", "triangles of a mesh's size, 0.01, in the unit cube", small, at),
    Recipe::new("sliver", "triangles whose third corner is 2^-10 to 2^-23 off the first edge", sliver, at),
    Recipe::new("offset", "the unit cube at 1,000,000, where coordinates are 1/16 apart", offset, at),
    Recipe::new("offset-fine", "triangles about 30 ulps wide at 1,000,000", offset_fine, at),
    Recipe::new("far-origin", "rays from a million units away", uniform, from_afar),
    Recipe::new(
        "far-and-short",
        "rays from up to 2^60 away, along axes and with directions down to 2^-125",
        small,
        short_from_afar,
    ),
    Recipe::new("scale-1e-20", "the unit cube times 1e-20: squares underflow, f32 determinants are 0", tiny, at),
    Recipe::new("scale-1e20", "the unit cube times 1e20: squares overflow", huge, at),
    Recipe::new("graze", "rays in the plane of a triangle but for a millionth", uniform, graze),
    Recipe::new("graze-ulp", "rays in the plane of a triangle but for an ulp", uniform, graze_ulp),
    Recipe::new("wild", "coordinates and directions from 2^-40 to 2^40", wild, wild_rays),
    Recipe::new("on-surface", "origins on a triangle but for rounding", uniform, from_surface),
    Recipe::new(
        "on-surface-100",
        "rays from triangles at 100, off them as Wächter & Binder 2019 do against self-intersection",
        at_100,
        from_offset_surface,
    ),
    Recipe::new("edge-normalised", "normalised directions at the middles of edges", uniform, normalised),
    Recipe::new("tiny-and-far", "triangles of size 0.0001 at 1,000", tiny_and_far, at),
    Recipe::new("direction-huge", "directions times 2^60 and 2^120", small, |draw, target, i| {
        scaled(draw, target, i, [60, 120])
    }),
    Recipe::new("direction-tiny", "directions times 2^-60 and 2^-120", small, |draw, target, i| {
        scaled(draw, target, i, [-60, -120])
    }),
    Recipe::new("direction-subnormal", "directions of a few subnormal units", small, |draw, target, i| {
        scaled(draw, target, i, [-140, -146])
    }),
    Recipe::new("many-scales", "triangles around one point, each of another power of two in size", onion, at_onion),
    Recipe::new("soup-mixed", "rays of all the kinds that `aimed` knows", uniform, mixed),
];

fn uniform(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 64, |draw| [draw.cube(), draw.cube(), draw.cube()])
}

fn into_the_box(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let origin = draw.cube() * 5.0 - 2.0;
    let point = if i.is_multiple_of(2) { draw.cube() } else { place(draw, target.triangle(i)) };
    whole(origin, point - origin)
}

fn small(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 800, |draw| {
        let centre = draw.cube();
        [(); 3].map(|()| centre + draw.centred() * 0.005)
    })
}

fn sliver(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| {
        let (a, b) = (draw.cube(), draw.cube());
        let power = -10 - draw.below(14) as i32;
        let c = a.lerp(b, draw.unit()) + draw.direction() * exp2(power);
        turned(draw, [a, b, c])
    })
}

fn offset(draw: &mut Draw) -> Option<Mesh> {
    mapped(&uniform(draw)?, |v| v + 1e6)
}

fn offset_fine(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 400, |draw| {
        let centre = draw.centred() * 16.0 + 1e6;
        [(); 3].map(|()| centre + draw.centred())
    })
}

fn from_afar(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (point, away) = (place(draw, target.triangle(i)), draw.direction());
    let origin = point + away * 1e6;
    whole(origin, if draw.one_in(2) { -away } else { point - origin })
}

fn short_from_afar(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (point, away) = (place(draw, target.triangle(i)), draw.axis());
    let far = point * (Vec3::ONE - away.abs()) + away * exp2(10 + draw.below(51) as i32);
    whole(far, -away * exp2(-60 - draw.below(66) as i32))
}

fn tiny(draw: &mut Draw) -> Option<Mesh> {
    mapped(&uniform(draw)?, |v| v * 1e-20)
}

fn huge(draw: &mut Draw) -> Option<Mesh> {
    mapped(&uniform(draw)?, |v| v * 1e20)
}

/// Two unit vectors in the plane of a triangle's normal and one of its edges: the edge and the normal.
fn frame([a, b, c]: [Vec3; 3]) -> Option<[Vec3; 2]> {
    Some([(b - a).try_normalize()?, (b - a).cross(c - a).try_normalize()?])
}

fn graze(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let ([along, normal], point) = (frame(corners)?, within(draw, corners));
    let (back, off) = (draw.between(0.1, 4.0), draw.between(-1e-6, 1e-6));
    let direction = along + normal * off;
    whole(point - direction * back, direction)
}

fn graze_ulp(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let ([along, _], point) = (frame(corners)?, within(draw, corners));
    let origin = point - along * draw.between(0.1, 4.0);
    whole(draw.nudged(origin, 1), point - origin)
}

fn wild(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 200, |draw| [draw.floats(-40, 40), draw.floats(-40, 40), draw.floats(-40, 40)])
}

fn wild_rays(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (origin, point) = (draw.floats(-40, 40), place(draw, target.triangle(i)));
    whole(origin, if draw.one_in(4) { draw.floats(-40, 40) } else { point - origin })
}

fn from_surface(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let origin = within(draw, target.triangle(i));
    let other = target.corners(draw);
    whole(origin, if draw.one_in(2) { draw.direction() } else { toward(origin, place(draw, other)) })
}

fn at_100(draw: &mut Draw) -> Option<Mesh> {
    mapped(&uniform(draw)?, |v| (v * 2.0 - 1.0) * 100.0)
}

fn from_offset_surface(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = target.triangle(i);
    let (point, [_, normal]) = (within(draw, corners), frame(corners)?);
    let away = normal * draw.sign();
    // The paper's constants: offsets of 256 ulps, and of 1/65536 near the origin of the scene.
    let ulps = (away * 256.0).to_array().map(|ulps| ulps as i32);
    let offset = |axis: usize| {
        let x = point[axis];
        let moved = f32::from_bits(x.to_bits().wrapping_add_signed(if x < 0.0 { -ulps[axis] } else { ulps[axis] }));
        if x.abs() < 1.0 / 32.0 { x + away[axis] / 65536.0 } else { moved }
    };
    let origin = one_of([point, Vec3::new(offset(0), offset(1), offset(2)), point + away * 1e-5], draw);
    whole(origin, draw.direction())
}

fn normalised(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let [a, b, _] = turned(draw, target.triangle(i));
    let origin = draw.cube() * 5.0 - 2.0;
    whole(origin, (middle(a, b) - origin).try_normalize()?)
}

fn tiny_and_far(draw: &mut Draw) -> Option<Mesh> {
    triangles(draw, 400, |draw| {
        // A cluster, so that a ray has more than one triangle in its way.
        let centre = draw.centred() * 0.004 + 1e3;
        [(); 3].map(|()| centre + draw.centred() * 1e-4)
    })
}

fn scaled(draw: &mut Draw, target: &Target<'_>, i: usize, powers: [i32; 2]) -> Option<Ray> {
    let (origin, point) = (draw.cube() * 5.0 - 2.0, place(draw, target.triangle(i)));
    let direction = (point - origin) * exp2(one_of(powers, draw));
    whole(origin, direction)
}

fn onion(draw: &mut Draw) -> Option<Mesh> {
    let mut power = -60;
    triangles(draw, 121, |draw| {
        let corners = [(); 3].map(|()| (draw.centred() + 0.25) * exp2(power));
        power += 1;
        corners
    })
}

fn at_onion(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let corners = turned(draw, target.triangle(i));
    let other = target.corners(draw);
    let origin = within(draw, other) * one_of([1.0, 4.0, -2.0], draw);
    whole(origin, toward(origin, on_edge(draw, corners)))
}
