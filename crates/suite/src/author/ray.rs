//! Level `ray`.

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::truth::{Hit, Mesh, Ray};
use super::{Author, result};
use crate::ask::Rays;
use crate::text::{floats, hit};
use crate::{Ask, Level, Profile, Query, Strength, Withdrawn};
use stackless_bvh::generate::{Rng, Source, stress};

pub(super) fn profiles() -> Vec<Profile> {
    vec![grid(), invalid()]
}

/// The maximum number of triangles of a case, so the suite stays small.
const TRIANGLES: usize = 700;
/// Rays per case of the stress scenes.
const RAYS: usize = 12;

/// Meshes of small integers, with rays that need no rounding. One kind hits triangles inside, the other kind hits
/// corners, edges and overlapping triangles.
fn grid() -> Profile {
    let mut author = Author::new(Level::Ray, "grid");
    for (name, why, is_inside) in [
        ("inside", "Nothing is rounded, and no edge is met.", true),
        (
            "edges",
            "Nothing is rounded: corners and edges are hit, and of equal distances the lower number wins.",
            false,
        ),
    ] {
        for seed in 0..40 {
            let mut rng = Rng::new(6000 + seed);
            let mesh = grid_mesh(&mut rng, 1 + 2 * seed as usize, is_inside);
            let mut rays = Vec::new();
            for _ in 0..2000 {
                if rays.len() == 16 {
                    break;
                }
                let Some(ray) = grid_ray(&mut rng, &mesh, is_inside) else { continue };
                let hits = mesh.hits(&ray);
                let fits = |&Hit { t, u, v, .. }: &Hit| {
                    // Rounded numbers differ between devices.
                    [t, u, v].into_iter().all(is_dyadic) && (!is_inside || u > 0.0 && v > 0.0 && u + v < 1.0)
                };
                // Few misses, because they are easy.
                if hits.iter().all(fits) && (!hits.is_empty() || rays.len() % 4 == 0) {
                    rays.push(ray);
                }
            }
            traced(&mut author, &format!("{name}-{seed}"), why, &mesh, &rays);
        }
    }
    boundaries(&mut author);
    author.done()
}

/// Empty meshes, empty lists of rays, and the limits of valid input, for the closest hit and for any hit.
fn boundaries(author: &mut Author) {
    const INFINITE: f32 = f32::INFINITY;
    let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let (triangle, along) = (vec![[0, 1, 2]], Vec3::Z);
    let of = |vertices: &[_], triangles: &[_]| Mesh { vertices: vertices.to_vec(), triangles: triangles.to_vec() };
    let [one, bare, empty] = [of(&corners, &triangle), of(&corners, &[]), of(&[], &[])];
    let [before, on] = [Vec3::new(1.0, 1.0, -4.0), Vec3::new(1.0, 1.0, 0.0)];
    let from = |origins: &[Vec3], ends| origins.iter().map(|&origin| ray(origin, along, ends)).collect::<Vec<_>>();
    let whole = from(&[before, on], [0.0, INFINITE]);
    let at_infinity = from(&[before, on], [INFINITE, INFINITE]);
    let cases = [
        ("no-vertices", "There is no vertex and no triangle: every ray misses.", &empty, whole.clone()),
        ("no-triangles", "There are vertices, and no triangle: every ray misses.", &bare, whole.clone()),
        ("no-rays", "Nobody asks.", &one, vec![]),
        (
            "at-infinity",
            "tmin and tmax are infinite: no distance is, so every such ray misses. The last ones are usual.",
            &one,
            { [at_infinity, whole].concat() },
        ),
        ("tmin-negative-zero", "A tmin of -0 is 0, and no sign.", &one, from(&[before, on], [-0.0, INFINITE])),
        ("tmax-negative-zero", "A tmax of -0 is 0: the interval is one point, where the second ray begins.", &one, {
            [from(&[before, on], [0.0, -0.0]), from(&[before, on], [-0.0, -0.0])].concat()
        }),
    ];
    for (name, why, mesh, rays) in cases {
        closest(author, name, why, mesh, &rays);
        any(author, name, why, mesh, &rays);
    }
}

/// Draws triangles with corners on a grid. Unless `are_apart`, some overlap.
fn grid_mesh(rng: &mut Rng, triangles: usize, are_apart: bool) -> Mesh {
    let corner = |rng: &mut Rng| Vec3::from_array([(); 3].map(|()| rng.below(17) as f32 - 8.0));
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for i in 0..triangles as u32 {
        if i % 5 == 4 && !are_apart {
            let [a, b, c]: [u32; 3] = indices[rng.below(u64::from(i)) as usize];
            indices.push([b, c, a]);
        } else {
            let first = vertices.len() as u32;
            vertices.extend([corner(rng), corner(rng), corner(rng)].map(|corner| corner.to_array()));
            indices.push([first, first + 1, first + 2]);
        }
    }
    Mesh { vertices, triangles: indices }
}

/// Draws a ray whose direction has powers of two or zeros, toward a point inside a triangle, a corner, the midpoint of
/// two corners, or any point.
fn grid_ray(rng: &mut Rng, mesh: &Mesh, is_inside: bool) -> Option<Ray> {
    let direction = Vec3::from_array([(); 3].map(|()| [0.0, 1.0, -1.0, 0.5, -2.0][rng.below(5) as usize]));
    let at = |corner: usize| Vec3::from_array(mesh.vertices[corner]);
    let corner = |rng: &mut Rng| at(rng.below(mesh.vertices.len() as u64) as usize);
    let target = match rng.below(4) {
        0 => Vec3::from_array([(); 3].map(|()| rng.below(33) as f32 - 16.0)),
        _ if is_inside => {
            let [a, b, c] = mesh.triangles[rng.below(mesh.triangles.len() as u64) as usize].map(|i| at(i as usize));
            (2.0 * a + b + c) / 4.0
        }
        1 => corner(rng),
        _ => (corner(rng) + corner(rng)) / 2.0,
    };
    let (tmin, tmax) = [(0.0, f32::INFINITY), (0.0, 4.0), (4.0, 64.0), (0.0, 64.0)][rng.below(4) as usize];
    (direction != Vec3::ZERO).then(|| ray(target - 4.0 * direction, direction, [tmin, tmax]))
}

pub(super) fn ray(origin: Vec3, direction: Vec3, [tmin, tmax]: [f32; 2]) -> Ray {
    let ([a, b, c], [x, y, z]) = (origin.to_array(), direction.to_array());
    [a, b, c, x, y, z, tmin, tmax]
}

/// Builds a ray from one point to another, whose distance is 1 up to rounding.
pub(super) fn from_to(from: Vec3, to: Vec3, ends: [f32; 2]) -> Ray {
    ray(from, to - from, ends)
}

fn is_dyadic(x: f32) -> bool {
    (x * 4096.0).fract() == 0.0 && x.abs() < 4096.0
}

/// Cases of `exact`: the small stress scenes, and triangles whose hits double precision finds badly.
pub(super) fn scenes(author: &mut Author) {
    for case in stress::cases(RAYS).filter(|case| case.mesh.triangles().len() <= TRIANGLES) {
        let (mesh, rays) = scene(&case);
        traced(author, case.name, case.about, &mesh, &rays);
    }
    for (seed, &(name, why, target)) in ZEROS.iter().enumerate() {
        let (mesh, rays) = zeros(&mut Rng::new(7000 + seed as u64), target);
        traced(author, name, why, &mesh, &rays);
    }
    for (name, why, rows) in FAR_OFF {
        let [o, d, corners @ ..] = rows.map(|v| Vec3::from_array(v.map(f32::from_bits)));
        let mesh = Mesh { vertices: corners.map(|corner| corner.to_array()).to_vec(), triangles: vec![[0, 1, 2]] };
        traced(author, name, why, &mesh, &[ray(o, d, [0.0, f32::INFINITY])]);
    }
}

/// Rays and triangles found by hill climbing, whose rounding errors reach the given fraction of the bounds of [EXACT-4]
/// to [EXACT-9]. Rows: origin, direction, corners.
const FAR_OFF: [(&str, &str, [[u32; 3]; 5]); 3] = [
    (
        "far-off",
        "The distance is between two floats, and double precision off by more than half of what can be proved.",
        [
            [0x392f_f724, 0x48fe_b697, 0xb825_8d2f],
            [0x3007_e0de, 0xc6d8_6334, 0x4606_ce34],
            [0x4901_261a, 0x2e32_c451, 0x4901_771a],
            [0x3540_c401, 0xc901_c2ce, 0x43ff_6667],
            [0xaf3f_fffe, 0x4900_3fa4, 0x2f3f_fffa],
        ],
    ),
    (
        "far-off-single",
        "Single precision has an edge on the wrong side, by more than a third of what can be proved.",
        [
            [0xbc8c_4bc4, 0xbc69_28c8, 0xbd69_7e6a],
            [0x4900_574c, 0x4900_74a8, 0x48fe_7b50],
            [0x4880_7324, 0xc886_0436, 0xc87e_ad22],
            [0x4901_deab, 0x3afd_410b, 0xc8ff_fa9a],
            [0xbc6c_b595, 0x3c7c_f8e6, 0xbb45_dbca],
        ],
    ),
    (
        "far-off-double",
        "Double precision has an edge on the wrong side, by more than a quarter of what can be proved.",
        [
            [0xaff6_8a7e, 0xc783_e97e, 0xacf5_ecf3],
            [0x4671_6dce, 0xc671_5f11, 0xb091_cbeb],
            [0x4783_9ba1, 0xa5da_5316, 0x4783_fe00],
            [0x4803_cc96, 0x4783_6509, 0xafbe_d22a],
            [0x2f3c_a7c6, 0xc783_fd93, 0xad03_ea14],
        ],
    ),
];

/// Name, reason, and the hit point as weights of the corners. Some sign test has the value 0 there.
type Zero = (&'static str, &'static str, [f32; 3]);

const ZEROS: [Zero; 2] = [
    ("begins-within", "Rays begin on a triangle: t is 0, and double precision finds it to be less.", [0.5, 0.25, 0.25]),
    ("through-edge", "Rays pass through an edge, and double precision finds them outside.", [0.5, 0.5, 0.0]),
];

/// Draws many triangles of large integers, each with a ray, and selects those with the greatest errors in double
/// precision.
fn zeros(rng: &mut Rng, [a, b, c]: [f32; 3]) -> (Mesh, Vec<Ray>) {
    let point = |rng: &mut Rng| Vec3::from_array([(); 3].map(|()| (rng.below(1 << 19) as f32 - 262_144.0) * 4.0));
    let mut drawn = Vec::new();
    for _ in 0..10_000 {
        let (corners, d) = ([point(rng), point(rng), point(rng)], point(rng) / 4.0);
        let target = a * corners[0] + b * corners[1] + c * corners[2];
        let o = if c == 0.0 { target - d } else { target };
        drawn.push((off([o, d], corners), corners, ray(o, d, [0.0, f32::INFINITY])));
    }
    drawn.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
    drawn.truncate(RAYS);
    let vertices = drawn.iter().flat_map(|(_, corners, _)| corners.map(|corner| corner.to_array())).collect();
    let triangles = (0..drawn.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    (Mesh { vertices, triangles }, drawn.into_iter().map(|(.., ray)| ray).collect())
}

/// Returns the distance by which a hit seems to be outside the triangle or before the ray in double precision, relative
/// to the factors.
fn off([o, d]: [Vec3; 2], [v0, v1, v2]: [Vec3; 3]) -> f64 {
    let [o, d, v0, v1, v2] = [o, d, v0, v1, v2].map(Vec3::as_dvec3);
    let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
    let (p, q) = (d.cross(e2), s.cross(e1));
    let (determinant, size) = (e1.dot(p), |v: DVec3| v.abs().max_element());
    let (edges, most) = ([s.dot(p), d.dot(q)].map(|edge| edge / determinant.signum()), size(e1).max(size(e2)));
    let least = edges[0].min(edges[1]) / (size(s) * size(d) * most);
    let t = e2.dot(q) / determinant.signum() / (size(s) * most * most);
    -least.min(t)
}

/// Adds cases of the closest hits, and of any hit for the first rays.
fn traced(author: &mut Author, name: &str, why: &str, mesh: &Mesh, rays: &[Ray]) {
    closest(author, name, why, mesh, rays);
    if author.0.cases.len() % 8 == 1 {
        any(author, name, why, mesh, rays);
    }
}

pub(super) fn closest(author: &mut Author, name: &str, why: &str, mesh: &Mesh, rays: &[Ray]) {
    let closest = |ray| mesh.hits(ray).first().map_or(Value::Null, |it| hit(it.prim, [it.t, it.u, it.v]));
    let hits: Vec<Value> = rays.iter().map(closest).collect();
    let ask = Ask::Ray(asked(mesh, rays, Query::Closest));
    // This case replaces an expectation by rounded distances.
    let is_withdrawn = Withdrawn::of(&format!("{}/{}/{name}", author.0.level, author.0.profile)).is_some();
    let name = if is_withdrawn { &format!("{name}-ordered") } else { name };
    let clauses: &[&str] = if name.starts_with("order-") || is_withdrawn {
        &["EXACT-1", "EXACT-13", "DET-1", "CONF-2"]
    } else {
        &["EXACT-1", "DET-1", "CONF-2"]
    };
    author.case(name, clauses, why, &ask, result([("hits", json!(hits))]));
}

pub(super) fn any(author: &mut Author, name: &str, why: &str, mesh: &Mesh, rays: &[Ray]) {
    let hits: Vec<bool> = rays.iter().map(|ray| !mesh.hits(ray).is_empty()).collect();
    let ask = Ask::Ray(asked(mesh, rays, Query::Any));
    author.case(&format!("{name}-any"), &["EXACT-1", "CONF-2"], why, &ask, result([("hits", json!(hits))]));
}

pub(super) fn asked(mesh: &Mesh, rays: &[Ray], query: Query) -> Rays {
    Rays {
        vertices: mesh.vertices.iter().map(|vertex| floats(vertex)).collect(),
        triangles: mesh.triangles.clone(),
        rays: rays.iter().map(|ray| floats(ray)).collect(),
        query,
    }
}

/// Returns the mesh and the rays of a stress scene.
pub(super) fn scene(case: &stress::StressCase) -> (Mesh, Vec<Ray>) {
    let vertices = case.mesh.vertices().iter().map(glam::Vec3::to_array).collect();
    let mesh = Mesh { vertices, triangles: case.mesh.triangles().to_vec() };
    let rays = case.rays.iter().map(|it| ray(it.origin(), it.direction(), [it.tmin(), it.tmax()]));
    (mesh, rays.collect())
}

/// A change of corners, triangle, or ray.
type Spoil = fn(&mut [[f32; 3]; 3], &mut [u32; 3], &mut [f32; 8]);

fn invalid() -> Profile {
    let mut author = Author::new(Level::Ray, "invalid");
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let ray = [0.25, 0.25, -1.0, 0.0, 0.0, 1.0, 0.0, f32::INFINITY];
    // Valid vertices, triangles and rays precede the invalid one.
    let mut fault_after = |right: Rays, name: &str, why: &str, code: &str, change: Spoil| {
        let (mut vertices, mut triangle, mut ray) = (vertices, [0, 1, 2], ray);
        change(&mut vertices, &mut triangle, &mut ray);
        let Rays { vertices: mut all, mut triangles, mut rays, query } = right;
        all.extend(vertices.iter().map(|vertex| floats(vertex)));
        triangles.push(triangle);
        rays.push(floats(&ray));
        let ask = Ask::Ray(Rays { vertices: all, triangles, rays, query });
        let case = author.reject(name, &["EXACT-1"], why, &ask, code);
        if name == "negative-tmin" {
            case.strength = Strength::May;
        }
    };
    let nothing = |query| Rays { vertices: vec![], triangles: vec![], rays: vec![], query };
    let mut fault = |name: &str, why: &str, code: &str, change: Spoil| {
        fault_after(nothing(Query::Closest), name, why, code, change);
    };
    fault("vertex-nan", "No number.", "not-finite", |vertices, _, _| vertices[1][2] = f32::NAN);
    fault("vertex-infinite", "No finite number.", "not-finite", |vertices, _, _| vertices[0][0] = f32::NEG_INFINITY);
    fault("index", "There are three vertices.", "index", |_, triangle, _| triangle[2] = 3);
    fault("index-far", "There are three vertices.", "index", |_, triangle, _| triangle[0] = (1 << 31) - 1);
    fault("origin-nan", "No number.", "not-finite", |_, _, ray| ray[1] = f32::NAN);
    fault("direction-infinite", "No finite number.", "not-finite", |_, _, ray| ray[4] = f32::INFINITY);
    fault("direction-zero", "The ray goes nowhere.", "no-direction", |_, _, ray| ray[5] = 0.0);
    fault("direction-negative-zero", "The ray goes nowhere.", "no-direction", |_, _, ray| ray[5] = -0.0);
    fault("empty-interval", "tmin is above tmax.", "interval", |_, _, ray| (ray[6], ray[7]) = (2.0, 1.0));
    fault("tmax-nan", "No number.", "interval", |_, _, ray| ray[7] = f32::NAN);
    fault("tmin-nan", "No number.", "interval", |_, _, ray| ray[6] = f32::NAN);
    fault("negative-tmin", "A ray begins at its origin.", "interval", |_, _, ray| ray[6] = -1.0);
    fault("tmax-infinite", "tmin is above tmax.", "interval", |_, _, ray| ray[7] = f32::NEG_INFINITY);
    fault("tmin-infinite", "tmin is above tmax.", "interval", |_, _, ray| (ray[6], ray[7]) = (f32::INFINITY, 1.0));
    let later: [(&str, &str, Spoil); 6] = [
        ("origin-nan", "not-finite", |_, _, ray| ray[0] = f32::NAN),
        ("direction-infinite", "not-finite", |_, _, ray| ray[3] = f32::NEG_INFINITY),
        ("direction-zero", "no-direction", |_, _, ray| ray[5] = 0.0),
        ("empty-interval", "interval", |_, _, ray| (ray[6], ray[7]) = (2.0, 1.0)),
        ("tmin-nan", "interval", |_, _, ray| ray[6] = f32::NAN),
        ("tmax-nan", "interval", |_, _, ray| ray[7] = f32::NAN),
    ];
    for (query, label) in [(Query::Closest, ""), (Query::Any, "-any")] {
        for (name, code, change) in later {
            let right = Rays { rays: vec![floats(&ray); 2], ..nothing(query) };
            let why = "The ray that is wrong comes last, after two that hit.";
            fault_after(right, &format!("last-ray-{name}{label}"), why, code, change);
        }
    }
    let right = || Rays {
        vertices: vertices.iter().map(|vertex| floats(vertex)).collect(),
        triangles: vec![[0, 1, 2]],
        ..nothing(Query::Closest)
    };
    let why = "The triangle that is wrong comes last.";
    fault_after(right(), "last-triangle", why, "index", |_, triangle, _| triangle[1] = 6);
    let why = "No triangle names the vertex.";
    fault_after(right(), "unused-vertex", why, "not-finite", |vertices, _, _| vertices[2][1] = f32::NAN);
    let bare = |vertex: [f32; 3], ray: [f32; 8]| {
        Ask::Ray(Rays { vertices: vec![floats(&vertex)], rays: vec![floats(&ray)], ..nothing(Query::Closest) })
    };
    let nowhere = [0.25, 0.25, -1.0, 0.0, 0.0, 0.0, 0.0, f32::INFINITY];
    let at_infinity = [0.25, 0.25, -1.0, 0.0, 0.0, 0.0, f32::INFINITY, f32::INFINITY];
    let why = "There is nothing to hit, and the input is wrong all the same.";
    for (name, ask, code) in [
        ("no-triangles-vertex", bare([0.0, f32::NAN, 0.0], ray), "not-finite"),
        ("no-triangles-direction", bare([0.0; 3], nowhere), "no-direction"),
        ("at-infinity-direction", bare([0.0; 3], at_infinity), "no-direction"),
    ] {
        author.reject(name, &["EXACT-1"], why, &ask, code);
    }
    let (why, mesh) = (
        "This is a ray: not everything is rejected.",
        Mesh { vertices: vertices.to_vec(), triangles: vec![[0, 1, 2]] },
    );
    closest(&mut author, "right", why, &mesh, &[ray]);
    any(&mut author, "right", why, &mesh, &[ray]);
    author.done()
}
