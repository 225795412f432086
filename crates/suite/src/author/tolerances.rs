//! Level `ray`, cases where rounding is easily too coarse: ends of the interval, tiny and huge scenes, edges that are
//! hit exactly, the low bits of coordinates, and boxes that a ray only touches.
//!
//! The profiles with these cases take the others from `ray`, `order` and `tolerant`.

use glam::Vec3;

use super::ray::{any, closest, from_to, ray};
use super::tolerant::{
    RAYS, SIDES, WHOLE, asks, asks_near, clear_rays, cube, doubled, ghost, inside, middle_of_face, scaled, soup, sphere,
};
use super::truth::{Mesh, Ray};
use super::{Author, order, ray, tolerant};
use crate::{Level, Profile, Query};
use stackless_bvh::generate::Rng;

/// Tolerances of the profiles in ulps, with the greatest condition number of their cases.
const ULPS: [(&str, u32, f64); 2] = [("ulp-8", 8, 4.0), ("ulp-256", 256, 64.0)];

pub(super) fn profiles() -> Vec<Profile> {
    let ulps = ULPS.map(|(name, ulps, most)| near(name, ulps, most));
    [exact(), watertight(), parity()].into_iter().chain(ulps).collect()
}

fn exact() -> Profile {
    let mut author = Author::new(Level::Ray, "exact");
    ray::scenes(&mut author);
    order::cases(&mut author);
    touches(&mut author);
    author.done()
}

fn watertight() -> Profile {
    let mut author = Author::new(Level::Ray, "watertight");
    tolerant::watertight(&mut author);
    of_closed(&mut author, Query::Any);
    author.done()
}

fn parity() -> Profile {
    let mut author = Author::new(Level::Ray, "parity");
    tolerant::parity(&mut author);
    of_closed(&mut author, Query::Parity);
    author.done()
}

fn near(profile: &str, ulps: u32, most: f64) -> Profile {
    let mut author = Author::new(Level::Ray, profile);
    tolerant::near(&mut author, ulps, most);
    of_soups(&mut author, ulps, most);
    author.done()
}

/// Scenes in their size, or so small that distances are below every epsilon, or so large that they are beyond every
/// clip.
const SCALES: [(&str, f32); 3] = [("", 1.0), ("-tiny", power(-36)), ("-huge", power(36))];

const fn power(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

/// Cases of `watertight` and `parity`. Each ray crosses the mesh at most once, so both profiles have one answer.
fn of_closed(author: &mut Author, query: Query) {
    for (i, (name, mesh)) in [("octahedron", sphere(0)), ("cube", cube()), ("ball-32", sphere(1))].iter().enumerate() {
        for (label, scale) in SCALES {
            let rng = &mut Rng::new(9300 + i as u64);
            let rays: Vec<Ray> = (0..RAYS)
                .map(|at| {
                    let ends = [[0.0, 0.5], [0.5, 1.5], [1.5, f32::INFINITY], [0.0, 1.5]][at % 4];
                    let ray = match at {
                        0..12 => from_to(inside(rng, mesh), middle_of_face(rng, mesh), ends),
                        _ => ghost(rng, mesh, at),
                    };
                    enlarged(&ray, scale)
                })
                .collect();
            let why = "From within, through a face at the distance 1 times the scale, which is in the interval or not.";
            let is_met = |at: usize| at < 12 && at % 2 == 1;
            asks(author, &format!("{name}-ends{label}"), why, &scaled(mesh, Vec3::splat(scale)), &rays, query, is_met);
        }
    }
    let rays: Vec<Ray> = (0..RAYS as u32)
        .map(|at| {
            let signs = Vec3::from_array([0, 1, 2].map(|axis| if at >> axis & 1 == 1 { 1.0 } else { -1.0 }));
            ray((if at < 8 { 0.625 } else { 0.875 }) * signs, signs, WHOLE)
        })
        .collect();
    let why = "From outside, but within the box of a face, which lies behind.";
    asks(author, "octahedron-behind", why, &sphere(0), &rays, query, |_| false);
    for turn in 0..3 {
        let mesh = Mesh {
            vertices: cube().vertices,
            // The diagonal of each side is an edge between the same two vertices in both triangles.
            triangles: SIDES
                .iter()
                .flat_map(|&[a, b, c, d]| [turned([a, b, c], turn), turned([c, d, a], turn)])
                .collect(),
        };
        let rays: Vec<Ray> = (0..RAYS)
            .map(|at| {
                let [a, .., c, _] = SIDES[at % 6].map(|corner| Vec3::from_array(mesh.vertices[corner as usize]));
                let from = Vec3::new(0.125, -0.25, 0.0625);
                from_to(from, a + (c - a) * ((1 + at % 7) as f32 / 8.0), WHOLE)
            })
            .collect();
        let why = "Nothing is rounded: from within exactly onto the edge that two triangles of a side share.";
        asks(author, &format!("cube-edges-{turn}"), why, &mesh, &rays, query, |_| true);
    }
}

fn turned(mut corners: [u32; 3], by: usize) -> [u32; 3] {
    corners.rotate_left(by);
    corners
}

/// Scales origin and ends by a power of two, and therefore the distances.
fn enlarged(&[x, y, z, dx, dy, dz, tmin, tmax]: &Ray, scale: f32) -> Ray {
    [x * scale, y * scale, z * scale, dx, dy, dz, tmin * scale, tmax * scale]
}

/// Cases of `ulp-N`.
fn of_soups(author: &mut Author, ulps: u32, most: f64) {
    for (kind, (name, why)) in SOUPS.iter().enumerate() {
        for seed in 0..4 {
            let rng = &mut Rng::new(9400 + 10 * kind as u64 + seed);
            let is_whole = kind == 0;
            let mesh = doubled(&soup(rng, 6 + 4 * seed as usize, if is_whole { 24 } else { 20 }));
            let rays = clear_rays(rng, &mesh, if is_whole { most / 2.0 } else { most });
            let rays: Vec<Ray> =
                if kind == 1 { (0..).zip(rays).map(|(at, ray)| with_ends(&mesh, ray, at)).collect() } else { rays };
            let scale = SCALES[kind.saturating_sub(1)].1;
            let rays: Vec<_> = rays.iter().map(|ray| enlarged(ray, scale)).collect();
            asks_near(author, &format!("{name}-{seed}"), why, &scaled(&mesh, Vec3::splat(scale)), &rays, ulps);
        }
    }
}

const SOUPS: [(&str, &str); 4] = [
    ("full", "Coordinates have all 24 bits: the low ones count."),
    ("ends", "The interval begins or ends between hits, before the first, or behind the last."),
    ("tiny", "Distances around 2^-36, which are no zeros."),
    ("huge", "Distances around 2^36, which are not too far."),
];

/// Changes the interval to exclude the first hit or all hits, or the origin to be behind the last hit.
fn with_ends(mesh: &Mesh, [x, y, z, dx, dy, dz, ..]: Ray, at: usize) -> Ray {
    let hits = mesh.hits(&[x, y, z, dx, dy, dz, 0.0, f32::INFINITY]);
    let (first, last) = (hits.first().map_or(1.0, |hit| hit.t), hits.last().map_or(1.0, |hit| hit.t));
    let second = hits.iter().map(|hit| hit.t).find(|&t| t > 1.01 * first).unwrap_or(3.0 * first);
    let (o, d) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
    match at % 4 {
        0 => ray(o, d, [0.0, 0.5 * first]),
        1 => ray(o, d, [0.5 * (first + second), f32::INFINITY]),
        2 => ray(o, d, [0.5 * first, 0.5 * (first + second)]),
        _ => ray(o + d * (last + 1.0 / 64.0), d, WHOLE),
    }
}

/// Cases of `exact`: boxes that a ray only touches, and triangles and gaps smaller than an epsilon.
fn touches(author: &mut Author) {
    let flat = |corners: [[f32; 3]; 3]| Mesh { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] };
    let mut both = |name: &str, why: &str, mesh: &Mesh, rays: &[Ray]| {
        closest(author, name, why, mesh, rays);
        any(author, name, why, mesh, rays);
    };
    let far = flat([[3e38, -1.0, -1.0], [3e38, 3.0, -1.0], [3e38, -1.0, 3.0]]);
    let why =
        "From one end of the range to the other: the difference of box and origin is no float, the distance is 6.";
    both("slab-overflow", why, &far, &[[-3e38, 0.5, 0.5, 1e38, 0.0, 0.0, 0.0, 10.0]]);
    let corner = flat([[187.0, -1011.0, 459.0], [180.0, -1019.0, 459.0], [187.0, -1019.0, 451.0]]);
    let why = "The interval ends at the nearest corner of the box, which is the triangle's: 3, if it is not rounded.";
    both("slab-at-end", why, &corner, &[[196.0, -1005.0, 471.0, -3.0, -2.0, -4.0, 0.0, 3.0]]);
    let mut vertices = Vec::new();
    let mut rays = Vec::new();
    for (i, k) in (0..RAYS).zip([1, 3, 5, 7, 9, 11, 13, 15, 19, 23, 29, 31, 37, 43, 47, 53]) {
        let (x, y, z) = (k as f32, 41.0 * k as f32, 16.0 * i as f32);
        vertices.extend([[x, y, z], [x + 8.0, y - 8.0, z - 4.0], [x + 8.0, y - 8.0, z + 4.0]]);
        rays.push(ray(Vec3::new(0.0, 0.0, z), Vec3::new(1.0, 41.0, 0.0), WHOLE));
    }
    let triangles = (0..RAYS as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let why =
        "Along (1, 41, 0), of which 1/41 is no float, onto the corner of a triangle and its box, and nowhere else.";
    both("slab-corner", why, &Mesh { vertices, triangles }, &rays);
    let small = flat([[-3.0, -1.0, 0.0], [4.0, -2.0, 1.0], [1.0, 5.0, -1.0]]);
    let down = |x: f32, y: f32| ray(Vec3::new(x, y, 1.0), -Vec3::Z, WHOLE);
    let why = "A triangle of 2^-15 is one: no area is too small.";
    let inside = [[0.0, 0.0], [1.0, 1.0], [-1.0, 0.0]].map(|[x, y]| down(x * power(-18), y * power(-18)));
    both("triangle-2^-15", why, &scaled(&small, Vec3::splat(power(-18))), &inside);
    let unit = flat([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let beside = |by: f32| [down(-by, 0.25), down(0.25, -by), down(0.5 + by, 0.5), down(0.5, 0.5 + by)];
    let why = "Rays 2^-22 outside of each edge miss; those as far inside hit.";
    both("beside-edges", why, &unit, &[beside(power(-22)), beside(-power(-22))].concat());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ask, Expect};
    use stackless_bvh::generate::Source as _;

    /// Returns whether a point is inside, by the parity of crossings along rays away from edges.
    fn is_within(mesh: &Mesh, from: Vec3) -> bool {
        let rng = &mut Rng::new(1);
        loop {
            let way = Vec3::from_array([(); 3].map(|()| rng.below(1001) as f32 - 500.25));
            let [a, b, c] = from.to_array();
            let hits = mesh.hits(&[a, b, c, way.x, way.y, way.z, 0.0, f32::INFINITY]);
            if hits.iter().all(|hit| hit.u > 1e-3 && hit.v > 1e-3 && hit.u + hit.v < 0.999) {
                return hits.len() % 2 == 1;
            }
        }
    }

    /// Returns whether the point of a ray at a distance is inside.
    fn within(mesh: &Mesh, ray: &Ray, t: f32) -> bool {
        let [o, d] = [0, 3].map(|at| Vec3::new(ray[at], ray[at + 1], ray[at + 2]));
        t.is_finite() && is_within(mesh, o + t * d)
    }

    /// The expectations that follow from the construction of rays equal the exact answers.
    #[test]
    fn the_truth_is_as_expected() {
        let (mut asked, mut met) = (0, 0);
        for profile in [watertight(), parity()] {
            for case in &profile.cases {
                let Ok(Ask::Ray(rays)) = Ask::of(&case.input) else { panic!("{}", case.id) };
                let (vertices, origins) = rays.numbers().unwrap();
                let mesh = Mesh { vertices, triangles: rays.triangles.clone() };
                let Expect::Result(expected) = &case.expect else { panic!("{}", case.id) };
                for (ray, expected) in origins.iter().zip(expected["hits"].as_array().unwrap()) {
                    let truth = match rays.query {
                        Query::Any => !mesh.hits(ray).is_empty(),
                        _ => within(&mesh, ray, ray[6]) != within(&mesh, ray, ray[7]),
                    };
                    assert_eq!(truth, expected.as_bool().unwrap(), "{}", case.id);
                    (asked, met) = (asked + 1, met + usize::from(truth));
                }
            }
        }
        assert!(asked > 700 && met > 300 && asked - met > 200, "{met} of {asked}");
    }

    #[test]
    fn rays_of_ulps_are_enough() {
        for (name, ulps, most) in ULPS {
            let profile = near(name, ulps, most);
            let hits = profile.cases.iter().flat_map(|case| match &case.expect {
                Expect::Near(near) => near.hits.clone(),
                _ => panic!("{}", case.id),
            });
            let hits: Vec<_> = hits.collect();
            assert!(hits.len() > 300 && hits.iter().flatten().count() > 200, "{name}: {}", hits.len());
            assert!(hits.iter().flatten().all(|hit| hit.prims.len() >= 2), "{name}");
        }
    }
}
