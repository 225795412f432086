//! Judges closest hits and ordered lists on thin shells by integers: `shells [CLOSEST [LISTS]]`.
//!
//! The scenes are spheres whose radii differ by 2^-23, and sheets 1e-6 apart, seen from distances of 10 to 10^5. Most
//! rounded distances are equal there, and only the exact order determines the first hit. The oracle tests all triangles
//! in 128-bit integers and shares no code with the library. `[EXACT-1]` `[EXACT-13]`

use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

use dashu_int::IBig;
use glam::{DVec3, Vec3};
use stackless_bvh::generate::{Rng, Source};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::trace::{RayQueries, Tracer};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut counts = std::env::args().skip(1).map(|count| count.parse::<u64>());
    let [closest, lists] = [10_000_000, 1_000_000].map(|usual| counts.next().unwrap_or(Ok(usual)));
    let (closest, lists) = (closest?, lists?);
    let mut rng = Rng::new(1);
    let (mut wrong, mut tied, mut hits) = (0, 0, 0);
    let scenes = 100;
    let [closest, lists] = [closest, lists].map(|count| count.div_ceil(scenes) * scenes);
    for scene in 0..scenes {
        let mesh = if scene % 2 == 0 { spheres(&mut rng)? } else { sheets(&mut rng)? };
        let tracer = Tracer::of(&mesh)?;
        let oracle = Integers::of(&mesh);
        for i in 0..closest / scenes {
            let ray = ray(&mut rng)?;
            let expected = oracle.hits(&ray);
            let found = tracer.closest(&ray);
            hits += u64::from(found.is_some());
            wrong += u64::from(found.map(|hit| hit.prim) != expected.first().copied());
            if i < lists / scenes {
                let all: Vec<_> = tracer.all(&ray);
                tied += all.windows(2).filter(|pair| pair[0].t == pair[1].t).count();
                wrong += u64::from(!all.iter().map(|hit| hit.prim).eq(expected));
            }
        }
        eprint!("\r{}/{scenes} scenes, {hits} hits, {wrong} wrong", scene + 1);
    }
    println!("\n{closest} closest hits ({hits} hit), {lists} lists ({tied} times two at one rounded t): {wrong} wrong");
    if wrong == 0 && hits > 0 && tied > 0 { Ok(()) } else { Err("wrong hits, or none that tell".into()) }
}

/// Builds spheres of radius `1 + k 2^-23`, in random order.
fn spheres(rng: &mut Rng) -> Result<Mesh, Failure> {
    let (around, along) = (8, 4);
    let mut of = Vec::new();
    for _ in 0..4 {
        let radius = 1.0 + rng.below(8) as f64 * f64::powi(2.0, -23);
        let place = |i: u32, j: u32| {
            let (a, b) = (TAU * f64::from(i % around) / f64::from(around), PI * f64::from(j) / f64::from(along));
            (DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos()) * radius).as_vec3()
        };
        for (i, j) in (0..around).flat_map(|i| (0..along).map(move |j| (i, j))) {
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            of.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(of)
}

/// Builds squares that are 1e-6 apart and equally tilted, in random order.
fn sheets(rng: &mut Rng) -> Result<Mesh, Failure> {
    let tilt = [(); 2].map(|()| rng.below(256) as f64 / 256.0 - 0.5);
    let of = (0..8).flat_map(|_| {
        let height = rng.below(8) as f64 * 1e-6;
        let [a, b, c, d] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, x * tilt[0] + y * tilt[1] + height).as_vec3());
        [[a, b, c], [a, c, d]]
    });
    mesh(of.collect())
}

fn mesh(triangles: Vec<[Vec3; 3]>) -> Result<Mesh, Failure> {
    // Coordinates are on a grid of 2^-24. Numbers have at most 42 bits, and the longest product has 115.
    let snapped = triangles.as_flattened().iter().copied().map(on_grid).collect();
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Ok(Mesh::new(snapped, indices)?)
}

const GRID: f32 = (1_u32 << 24) as f32;

/// Draws a ray to a point of the unit ball, from a distance of 10 to 10^5.
fn ray(rng: &mut Rng) -> Result<Ray, Failure> {
    let mut unit = || DVec3::from([(); 3].map(|()| rng.below(1 << 20) as f64 * f64::powi(2.0, -19) - 1.0));
    let (towards, way) = (unit(), unit());
    let distance = 10_f64.powf(1.0 + 4.0 * (rng.below(1 << 20) as f64 * f64::powi(2.0, -20)));
    let origin = (towards + way.normalize_or(DVec3::Z) * distance).as_vec3();
    let direction = towards.as_vec3() - origin;
    Ok(Ray::new(on_grid(origin), on_grid(direction))?)
}

fn on_grid(v: Vec3) -> Vec3 {
    (v * GRID).round() / GRID
}

/// All triangles, with coordinates in units of 2^-24.
struct Integers(Vec<[[i128; 3]; 3]>);

impl Integers {
    fn of(mesh: &Mesh) -> Self {
        Self((0..mesh.triangles().len()).map(|i| mesh.triangle(i).map(whole)).collect())
    }

    /// Returns the triangles that the ray hits, by exact distance, then by index.
    fn hits(&self, ray: &Ray) -> Vec<u32> {
        let (o, d) = (whole(ray.origin()), whole(ray.direction()));
        let mut hits: Vec<_> =
            self.0.iter().zip(0..).filter_map(|(corners, i)| Some((distance(corners, o, d)?, i))).collect();
        hits.sort_by(|((t, det), i), ((u, other), j)| compare(t, det, u, other).then(i.cmp(j)));
        hits.into_iter().map(|(_, i)| i).collect()
    }
}

fn whole(v: Vec3) -> [i128; 3] {
    v.to_array().map(|x| (f64::from(x) * f64::from(GRID)) as i128)
}

/// Returns the numerator and the positive denominator of the distance (Möller and Trumbore).
fn distance(&[a, b, c]: &[[i128; 3]; 3], o: [i128; 3], d: [i128; 3]) -> Option<(i128, i128)> {
    let (e1, e2, s) = (minus(b, a), minus(c, a), minus(o, a));
    let (p, q) = (cross(d, e2), cross(s, e1));
    let det = dot(e1, p);
    let [u, v, t] = [dot(s, p), dot(d, q), dot(e2, q)].map(|x| x * det.signum());
    let is_met = det != 0 && u >= 0 && v >= 0 && u + v <= det.abs() && t >= 0;
    is_met.then_some((t, det.abs()))
}

fn compare(t: &i128, det: &i128, u: &i128, other: &i128) -> Ordering {
    (IBig::from(*t) * IBig::from(*other)).cmp(&(IBig::from(*u) * IBig::from(*det)))
}

fn minus(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [i128; 3], b: [i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
