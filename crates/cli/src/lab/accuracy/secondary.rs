//! Rays from hits: the errors of start points that are not exact.

use std::ops::Range;
use std::sync::Arc;

use glam::{IVec3, Vec3};
use rayon::prelude::*;
use stackless_bvh::bvh::{Bvh, WideBvh};
use stackless_bvh::geom::{Ends, ExactPoint, Mesh, Ray, Triangle};
use stackless_bvh::internals::trace::{Truth, reflect};
use stackless_bvh::trace::{Assembly, BinaryTracer, Hit, InstanceTracer, RayQueries, Tracer};
use stackless_bvh::traverse::Method;
use stackless_check::Shard;

use super::Args;
use super::sets::rng_of;
use super::total::{EXACT, SecondaryFound, SecondaryRow};
use crate::Outcome;
use crate::camera::Size;
use crate::input::Scene;
use crate::judge::csv_line;
use crate::output::{bar, say, write_file};
use crate::record::Numbered;
use crate::render::heat_maps;
use crate::turns::{median_ratio, take_turns};

/// The length of the rays, in diagonals of the scene.
const REACH: f32 = 0.1;

/// The minimum distance of rays that start at rounded points. Hits at 0 do not count, as in other ray tracers.
const POSITIVE: f32 = f32::from_bits(1);

/// Number of rays in a chunk.
const CHUNK: usize = 4096;

/// The start point of a ray, in floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    /// The origin plus the rounded distance times the direction.
    Rounded,
    /// The rounded point, with a minimum distance of a hundred-thousandth of the scene's diagonal.
    Epsilon,
    /// Moved along the normal by some hundred ulps (Wächter & Binder 2019).
    Ulp,
    /// Moved along the normal by a bound of the point's distance from the plane (after Pharr, Jakob & Humphreys 2023,
    /// Section 6.8).
    Bounded,
}

impl Start {
    const ALL: [Self; 4] = [Self::Rounded, Self::Epsilon, Self::Ulp, Self::Bounded];

    const fn name(self) -> &'static str {
        match self {
            Self::Rounded => "rounded point",
            Self::Epsilon => "fixed epsilon",
            Self::Ulp => "moved by ulps",
            Self::Bounded => "moved by its error bound",
        }
    }

    fn ray(self, bounce: &Bounce, epsilon: f32) -> Option<Ray> {
        let Bounce { primary, hit, corners: [a, b, c], normal, direction, tmax, .. } = bounce;
        let weighted = a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v;
        let (origin, tmin) = match self {
            Self::Rounded => (primary.origin() + primary.direction() * hit.t, POSITIVE),
            Self::Epsilon => (primary.origin() + primary.direction() * hit.t, epsilon / direction.length()),
            Self::Ulp => {
                let by = (normal * 256.0).to_array().map(|x| x as i32);
                let moved = |k: usize| {
                    let (p, by) = (weighted[k], IVec3::from(by)[k]);
                    if p.abs() < 1.0 / 32.0 {
                        return p + normal[k] / 65_536.0;
                    }
                    f32::from_bits(p.to_bits().wrapping_add_signed(if p < 0.0 { -by } else { by }))
                };
                (Vec3::from([0, 1, 2].map(moved)), POSITIVE)
            }
            Self::Bounded => {
                // gamma(7) of the terms of the weighted sum. The first weight is a rounded difference.
                let unit = f32::EPSILON * 0.5 * 7.0;
                let size = (a * (1.0 - hit.u - hit.v)).abs() + (b * hit.u).abs() + (c * hit.v).abs();
                let off = size * (unit / (1.0 - unit)) + a.abs() * f32::EPSILON;
                let by = normal * normal.abs().dot(off);
                let moved = |k: usize| {
                    let moved = weighted[k] + by[k];
                    if by[k] > 0.0 {
                        moved.next_up()
                    } else if by[k] < 0.0 {
                        moved.next_down()
                    } else {
                        moved
                    }
                };
                (Vec3::from([0, 1, 2].map(moved)), POSITIVE)
            }
        };
        Ray::within(origin, *direction, tmin, tmin.max(*tmax)).ok()
    }
}

/// A ray with a hit, and a ray that continues from the hit.
struct Bounce {
    pixel: usize,
    primary: Ray,
    hit: Hit,
    corners: [Vec3; 3],
    /// Unit normal, on the side of the ray's origin.
    normal: Vec3,
    direction: Vec3,
    tmax: f32,
}

impl Bounce {
    /// Whether the ray is blocked, exactly; and the exact point.
    fn is_blocked(&self, tracer: &InstanceTracer) -> Option<(bool, ExactPoint)> {
        let point = ExactPoint::met(&self.primary, &Triangle(self.corners))?;
        let ray = point.ray(self.direction, self.tmax, Ends::Open).ok()?;
        Some((tracer.any(&ray), point))
    }
}

pub(super) fn run(args: &Args, scenes: &[Scene]) -> Outcome {
    let mut run = args.asked::<SecondaryFound>(scenes);
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let side = f64::from(args.count).sqrt().ceil() as u32;
    let pixels = run.take(shard, "pixels", u64::from(side) * u64::from(side));
    run.refuse_empty(shard)?;
    let mut found = SecondaryFound::default();
    for scene in scenes {
        found.rows.extend(compare(args, scene, side, pixels.clone())?);
    }
    run.finish(found, args.json.as_deref())
}

/// A row for each start point, and a row for exact points.
fn compare(
    args: &Args,
    scene: &Scene,
    side: u32,
    pixels: Range<u64>,
) -> Result<Vec<SecondaryRow>, Box<dyn std::error::Error>> {
    let mut rows = Vec::new();
    let bvh = Bvh::build(&scene.mesh)?;
    let tree = Arc::new(WideBvh::of(&bvh)?);
    let wide = Tracer::new(Arc::clone(&tree));
    let epsilon = bvh.bounds().extent().length() * 1e-5;
    let bounces = bounces(scene, &wide, bvh.bounds().extent().length() * REACH, pixels, side, args);
    // A part of an image may have no hits.
    if bounces.is_empty() && args.shard.is_none() {
        return Err(format!("{}: no camera ray hits", scene.name).into());
    }
    let mut assembly = Assembly::new();
    let objects = [assembly.add_wide(tree), assembly.add_mesh(bvh.clone())];
    let tracer = |object| InstanceTracer::new(&assembly, object, Method::default());
    let exact = [tracer(objects[0])?, tracer(objects[1])?];
    let blocked = |bounce: &Bounce| {
        bounce
            .is_blocked(&exact[0])
            .ok_or_else(|| format!("{}: pixel {}: the exact ray misses the hit", scene.name, bounce.pixel))
    };
    let (answers, points): (Vec<_>, Vec<_>) =
        bounces.par_iter().map(blocked).collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    let truth = judge(&scene.mesh, &bounces, &points, &scene.name);
    let mut panels = Vec::new();
    for start in Start::ALL {
        let is_blocked = |bounce: &Bounce| start.ray(bounce, epsilon).is_some_and(|ray| wide.any(&ray));
        let answers: Vec<_> = bounces.par_iter().map(is_blocked).collect();
        let row = SecondaryRow::new(&scene.name, start.name(), &answers, &truth);
        let mut panel = vec![None; (side * side) as usize];
        for (bounce, (answer, truth)) in bounces.iter().zip(answers.iter().zip(&truth)) {
            panel[bounce.pixel] = Some(f64::from(u8::from(answer != truth)));
        }
        panels.push((
            format!("{}: {:.3} % wrong", row.start, row.wrong() as f64 * 100.0 / row.rays.max(1) as f64),
            panel,
        ));
        rows.push(row);
    }
    let wrong = answers.iter().zip(&truth).position(|(answer, truth)| answer != truth);
    let offence = wrong.map(|i| {
        let Bounce { pixel, primary, hit, direction, tmax, .. } = &bounces[i];
        let found = format!(
            "{}, pixel {pixel}: {} hits triangle {}; from there, {direction:?} up to {tmax:?} is blocked: {}, truly {}",
            scene.name,
            csv_line(primary),
            hit.prim,
            answers[i],
            truth[i]
        );
        Numbered { number: *pixel as u64, found }
    });
    rows.push(SecondaryRow { offence, ..SecondaryRow::new(&scene.name, EXACT, &answers, &truth) });
    if args.shard.is_none() {
        time(&bounces, epsilon, &exact, (&wide, &BinaryTracer::new(&bvh)), &scene.name);
    }
    if let Some(path) = &args.picture {
        let panels: Vec<_> = panels.iter().map(|(name, panel)| (name.clone(), panel)).collect();
        let png = heat_maps(Size { width: side, height: side }, &panels, 1.0, "wrong rays").to_png();
        write_file(path, |file| file.write_all(&png))?;
    }
    Ok(rows)
}

/// A ray from each hit of the camera rays, with the cosine distribution.
fn bounces(
    scene: &Scene,
    tracer: &Tracer<Arc<WideBvh>>,
    reach: f32,
    pixels: Range<u64>,
    side: u32,
    args: &Args,
) -> Vec<Bounce> {
    let view = args.place.of(scene);
    let bounce = |pixel: u64| {
        let (pixel, all) = (pixel as usize, side as usize * side as usize);
        let primary = view.ray_of(pixel, all)?;
        let hit = tracer.closest(&primary)?;
        let corners = scene.mesh.triangle(hit.prim as usize);
        let mut rng = rng_of(args.seed, pixel as u64);
        let direction = reflect(&scene.mesh, &primary, &hit, &mut rng)?.direction();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize()?;
        let normal = if normal.dot(primary.direction()) > 0.0 { -normal } else { normal };
        let tmax = reach / direction.length();
        Some(Bounce { pixel, primary, hit, corners, normal, direction, tmax })
    };
    pixels.into_par_iter().filter_map(bounce).collect()
}

/// Whether rays are blocked, by rational arithmetic.
fn judge(mesh: &Mesh, bounces: &[Bounce], points: &[ExactPoint], name: &str) -> Vec<bool> {
    let truth = Truth::new(mesh);
    let progress = bar(bounces.len() as u64, &format!("{name}, truth"));
    let is_blocked = |(bounce, point): (&Bounce, &ExactPoint)| {
        progress.inc(1);
        truth.any_from(&point.rational(), bounce.direction, bounce.tmax)
    };
    let found = bounces.par_iter().zip(points).map(is_blocked).collect();
    progress.finish_and_clear();
    found
}

/// Prints the time of exact rays from the hit on, relative to rays from rounded points: through wide and through binary
/// trees.
fn time(
    bounces: &[Bounce],
    epsilon: f32,
    exact: &[InstanceTracer; 2],
    (wide, binary): (&Tracer<Arc<WideBvh>>, &BinaryTracer<&Bvh>),
    name: &str,
) {
    let bounces = &bounces[..bounces.len().min(1 << 16)];
    let mut sum = 0;
    let times = take_turns(4, bounces.len(), CHUNK, 3, name, |contestant, range| {
        let ray = |bounce: &Bounce| Start::Ulp.ray(bounce, epsilon);
        sum += match contestant {
            0 => bounces[range].iter().filter(|bounce| ray(bounce).is_some_and(|ray| wide.any(&ray))).count(),
            1 => bounces[range].iter().filter(|bounce| ray(bounce).is_some_and(|ray| binary.any(&ray))).count(),
            _ => {
                let exact = &exact[contestant - 2];
                bounces[range].iter().filter(|bounce| bounce.is_blocked(exact).is_some_and(|found| found.0)).count()
            }
        };
    });
    std::hint::black_box(sum);
    let rate = |contestant: usize| {
        let seconds: f64 = times.by_chunk(contestant).iter().sum();
        times.lengths().iter().sum::<usize>() as f64 / seconds / 1e6
    };
    let ratio = |tree: usize| median_ratio(&times.by_chunk(tree + 2), &times.by_chunk(tree));
    say!(
        "{name}: exact rays take {:.2} of the time of `moved by ulps` by {} ({:.3} and {:.3} million a second), and {:.2} \
         by {} ({:.3} and {:.3})",
        ratio(0),
        wide.method(),
        rate(2),
        rate(0),
        ratio(1),
        binary.method(),
        rate(3),
        rate(1)
    );
}
