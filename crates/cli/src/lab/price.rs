//! `lab price`: the cost of the most expensive query of each hard family, relative to an ordinary query.

mod climb;
mod instances;
mod met;
mod scenes;

use std::error::Error;
use std::time::Duration;

use cpu_time::ThreadTime;
use glam::{DVec3, Vec3};
use serde::Serialize;
use serde_json::json;
use stackless_bvh::bvh::{BuildOptions, Builder, WideBvh};
use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::geom::{AffineMap, Ball, Mesh, Ray};
use stackless_bvh::trace::{MeshQueries, RayQueries, Tracer};

use crate::Outcome;
use crate::output::{Block, bar, print, table};
use crate::places::{self, Output};
use crate::record::write_figures;
use climb::{Change, climb};
use instances::{from_afar_into_instance, instances};
use met::Met;
use scenes::{
    at_edge, at_vertices, coincident, from_afar, in_plane, inside, lattice, short_from_afar, small_sphere, sphere, turn,
};

/// Time the most expensive query of each hard family, relative to an ordinary query in its scene. Takes three minutes.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  lab price --json prices.json")]
pub(crate) struct Args {
    /// Seconds of searching for more expensive queries in each family, by small changes of known queries.
    #[arg(long, value_name = "SECONDS", default_value_t = 2, value_parser = clap::value_parser!(u16).range(..=3600))]
    climb: u16,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let prices = prices(Duration::from_secs(args.climb.into()))?;
    print(&blocks(&prices));
    if let Some(path) = &args.json {
        write_figures(path, "price", &[], json!({ "prices": prices }))?;
    }
    Ok(true)
}

/// Families above this ratio are listed.
const LIMIT: f64 = 20.0;

/// Runs of each query. The least time counts.
const ROUNDS: usize = 5;

/// Number of queries of each kind.
const QUERIES: usize = 50;

/// The cost of a family.
#[derive(Serialize)]
struct Price {
    name: &'static str,
    /// Nanoseconds of an ordinary query in the scene, the median.
    ordinary: f64,
    /// Nanoseconds of the most expensive hard query, per answer.
    dearest: f64,
    /// Nanoseconds of the most expensive query after hill climbing, per answer.
    found: f64,
    /// Nodes and triangles of the ordinary query and of the most expensive query, per answer; `None` if they cannot be
    /// counted.
    met: Option<[f64; 2]>,
    /// The most expensive query, with its nodes and triangles.
    query: String,
}

impl Price {
    fn ratio(&self) -> f64 {
        self.found / self.ordinary
    }

    /// The ratio of nodes and triangles, and the ratio of time per node or triangle.
    fn parts(&self) -> Option<[f64; 2]> {
        let asked = self.met.map(|[ordinary, found]| found / ordinary)?;
        Some([asked, self.ratio() / asked])
    }
}

/// Measures the queries of a scene, given the family's name and the time for hill climbing. Returns `None` without
/// queries.
type Queries = Box<dyn FnOnce(&'static str, Duration) -> Option<Price>>;

type Made = Result<Queries, Box<dyn Error>>;

struct Family {
    name: &'static str,
    make: fn() -> Made,
}

const FAMILIES: [Family; 23] = [
    Family { name: "in the plane of a lattice", make: || closest(lattice(64, 1)?, in_plane()) },
    Family { name: "in the plane of a lattice that is not on a grid", make: off_grid },
    Family { name: "in the skew plane of a lattice", make: in_skew_plane },
    Family { name: "at vertices of 16 lattices an ulp apart", make: || closest(lattice(32, 16)?, at_vertices()) },
    Family { name: "at these vertices, double precision", make: || closest_64(&lattice(32, 16)?, &at_vertices()) },
    Family { name: "at a sphere from afar", make: || closest(sphere()?, from_afar()) },
    Family { name: "at a sphere from afar, double precision", make: || closest_64(&sphere()?, &from_afar()) },
    Family {
        name: "through an edge of 1,000,000 coincident triangles",
        make: || closest(coincident(1_000_000)?, at_edge()),
    },
    Family { name: "any of 1,000,000 coincident triangles", make: || any(coincident(1_000_000)?, at_edge()) },
    Family { name: "the next of 1,000 coincident triangles", make: || next(coincident(1_000)?, inside()) },
    Family { name: "all of 1,000 coincident triangles, at an edge", make: || all(coincident(1_000)?, at_edge()) },
    Family { name: "crossings of split triangles", make: crossings_of_split },
    Family { name: "nearest to the pole of a fan of 100,000", make: nearest_to_pole },
    Family { name: "nearest to 100,000 coincident triangles", make: nearest_to_coincident },
    Family { name: "nearest to a sphere from afar", make: || nearest(sphere()?, origins_afar()) },
    Family { name: "nearest to a sphere from afar, double precision", make: nearest_from_afar_64 },
    Family { name: "an instance, not moved, at vertices", make: || instances(1, AffineMap::IDENTITY) },
    Family { name: "instances nested 8 deep, at vertices", make: || instances(8, AffineMap::translation(Vec3::X)?) },
    Family { name: "quarter turns nested 31 deep, at vertices", make: || instances(31, turn(0.0, 1.0)?) },
    Family { name: "turns nested 31 deep, at vertices", make: || instances(31, turn(0.8, 0.6)?) },
    Family { name: "a turned instance from afar", make: || from_afar_into_instance(false) },
    Family { name: "a turned instance of eight children from afar", make: || from_afar_into_instance(true) },
    Family {
        name: "at a sphere from afar, in a short direction",
        make: || closest(small_sphere()?, short_from_afar()),
    },
];

/// Measures all families, with this time for hill climbing in each.
fn prices(climbing: Duration) -> Result<Vec<Price>, Box<dyn Error>> {
    prices_of(&FAMILIES, climbing)
}

fn prices_of(families: &[Family], climbing: Duration) -> Result<Vec<Price>, Box<dyn Error>> {
    let progress = bar(families.len() as u64, "families");
    let price = |&Family { name, make }: &Family| {
        let price = make()?(name, climbing).ok_or("a family without queries")?;
        progress.inc(1);
        Ok(price)
    };
    let prices = families.iter().map(price).collect();
    progress.finish_and_clear();
    prices
}

/// A summary, the table of prices, and the expensive queries.
fn blocks(prices: &[Price]) -> Vec<Block> {
    let dear: Vec<_> = prices.iter().filter(|price| price.ratio() > LIMIT).collect();
    let for_each = dear.iter().filter(|price| price.parts().is_none_or(|[_, each]| each > LIMIT)).count();
    let line = format!(
        "{} of {} families cost more than {LIMIT} ordinary queries, {for_each} of them also per node and triangle",
        dear.len(),
        prices.len()
    );
    let row = |price: &Price| {
        let micro = |nanoseconds: f64| format!("{:.2}", nanoseconds / 1e3);
        let times = [price.ordinary, price.dearest, price.found].map(micro);
        let parts = price.parts().map_or(["-"; 2].map(str::to_owned), |parts| parts.map(|part| format!("{part:.1}")));
        let ratio = format!("{:.1}", price.ratio());
        [vec![price.name.to_owned()], times.to_vec(), vec![ratio], parts.to_vec()].concat()
    };
    let header =
        ["family", "ordinary, us", "most expensive, us", "after hill climbing", "ratio", "work", "time per work"];
    let table = table(&header, 1, prices.iter().map(row).collect());
    let queries = dear.iter().map(|price| Block::Line(format!("{}: {}", price.name, price.query)));
    [Block::Line(line), Block::Table(table)].into_iter().chain(queries).collect()
}

/// Nanoseconds of a query per answer: processor time of the thread, the least of several runs. `None` if the least time
/// is at most `floor`; the first such run decides.
fn nanoseconds(ask: impl Fn() -> usize, floor: f64) -> Option<f64> {
    let time = || {
        // Short queries run repeatedly, because of the cost of the clock.
        let (mut times, start) = (0, ThreadTime::now());
        loop {
            times += ask().max(1);
            let passed = start.elapsed();
            if passed > Duration::from_micros(20) {
                return passed.as_secs_f64() * 1e9 / times as f64;
            }
        }
    };
    let mut least = time();
    // Long queries are rarely disturbed.
    let more = if least > 1e7 { 0 } else { ROUNDS - 1 };
    for _ in 0..more {
        if least <= floor {
            return None;
        }
        least = least.min(time());
    }
    (least > floor).then_some(least)
}

/// Traces rays through a mesh with the default tracer.
fn traced(mesh: Mesh, hard: Vec<Ray>, ask: fn(&Tracer, &Ray) -> usize, met: fn(&Tracer, &Ray) -> Option<Met>) -> Made {
    let ordinary = procedural::rays(&mesh, 1, QUERIES);
    Ok(queries(Tracer::of(&mesh)?, hard, ordinary, ask, met))
}

/// `ask` returns the number of a query's answers, `met` its nodes and triangles.
fn queries<S: 'static, Q: Change + 'static>(
    scene: S,
    hard: Vec<Q>,
    ordinary: Vec<Q>,
    ask: fn(&S, &Q) -> usize,
    met: fn(&S, &Q) -> Option<Met>,
) -> Queries {
    Box::new(move |name, climbing| {
        let ask = |query: &Q| ask(&scene, query);
        let times = |queries: &[Q]| -> Vec<f64> {
            queries.iter().map(|query| nanoseconds(|| ask(query), 0.0).unwrap_or_default()).collect()
        };
        let hardest = times(&hard);
        let mut usual: Vec<_> = times(&ordinary).into_iter().zip(&ordinary).collect();
        usual.sort_by(|(time, _), (other, _)| time.total_cmp(other));
        let &(ordinary, usual) = usual.get(usual.len() / 2)?;
        let dearest = hardest.iter().copied().fold(0.0, f64::max);
        let (query, found) = climb(&hard, &hardest, ask, climbing)?;
        let for_each = |query: &Q| Some(met(&scene, query)?.both() / ask(query).max(1) as f64);
        let told = met(&scene, &query).map_or(String::new(), |met| format!(": {met}"));
        let met = for_each(usual).zip(for_each(&query)).map(<[f64; 2]>::from);
        Some(Price { name, ordinary, dearest, found, met, query: format!("{query:?}{told}") })
    })
}

fn uncounted<S, Q>(_: &S, _: &Q) -> Option<Met> {
    None
}

fn closest(mesh: Mesh, hard: Vec<Ray>) -> Made {
    let ask = |tracer: &Tracer, ray: &Ray| usize::from(tracer.closest(ray).is_some());
    traced(mesh, hard, ask, |tracer, ray| Some(tracer.count_closest(&[*ray]).into()))
}

fn any(mesh: Mesh, hard: Vec<Ray>) -> Made {
    traced(mesh, hard, |tracer, ray| usize::from(tracer.any(ray)), uncounted)
}

fn all(mesh: Mesh, hard: Vec<Ray>) -> Made {
    traced(mesh, hard, |tracer, ray| tracer.all(ray).len(), |tracer, ray| Some(tracer.count_all(&[*ray]).into()))
}

/// Finds hit after hit.
fn next(mesh: Mesh, hard: Vec<Ray>) -> Made {
    let ask = |tracer: &Tracer, ray: &Ray| {
        let (mut count, mut hit) = (0, tracer.closest(ray));
        while let Some(found) = hit {
            count += 1;
            hit = tracer.next(ray, (found.t, found.prim));
        }
        count
    };
    traced(mesh, hard, ask, uncounted)
}

fn closest_64(mesh: &Mesh, hard: &[Ray]) -> Made {
    let wide = |ray: &Ray| Ray::new(ray.origin().as_dvec3(), ray.direction().as_dvec3());
    let rays = |rays: &[Ray]| rays.iter().map(wide).collect::<Result<Vec<_>, _>>();
    let (hard, ordinary) = (rays(hard)?, rays(&procedural::rays(mesh, 1, QUERIES))?);
    let vertices = mesh.vertices().iter().map(|v| v.as_dvec3()).collect();
    let tracer = Tracer::of(&Mesh::<DVec3>::new(vertices, mesh.triangles().to_vec())?)?;
    Ok(queries(
        tracer,
        hard,
        ordinary,
        |tracer, ray| usize::from(tracer.closest(ray).is_some()),
        |tracer, ray| Some(tracer.count_closest(&[*ray]).into()),
    ))
}

/// The plane of a lattice in tenths.
fn off_grid() -> Made {
    let tenth = |v: Vec3| Vec3::new(v.x * 0.1, v.y * 0.1, v.z);
    mapped_lattice(tenth, |v| tenth(v) + Vec3::new(0.0, 0.01, 0.0))
}

/// The plane of a lattice, skewed so that no axis is parallel or perpendicular to it.
fn in_skew_plane() -> Made {
    let skew = |v: Vec3| Vec3::new(v.x, v.y, v.x * 2.0 - v.y * 3.0);
    mapped_lattice(skew, skew)
}

/// Maps the lattice and the rays. A ray connects the images of its end points.
fn mapped_lattice(map: impl Fn(Vec3) -> Vec3, of_ray: impl Fn(Vec3) -> Vec3) -> Made {
    let mesh = lattice(64, 1)?;
    let mesh = Mesh::new(mesh.vertices().iter().map(|&v| map(v)).collect(), mesh.triangles().to_vec())?;
    let ray = |ray: &Ray| {
        let [from, to] = [ray.origin(), ray.origin() + ray.direction()].map(&of_ray);
        Ray::new(from, to - from).ok()
    };
    closest(mesh, in_plane().iter().filter_map(ray).collect())
}

fn crossings_of_split() -> Made {
    // Large triangles among small ones are split often.
    let sphere = stress::icosphere(4, 1.0, Vec3::ZERO)?;
    let (mut vertices, mut triangles) = (sphere.vertices().to_vec(), sphere.triangles().to_vec());
    for i in 0..64u8 {
        let (first, z) = (vertices.len() as u32, f32::from(i) / 32.0 - 1.0);
        vertices.extend([Vec3::new(-9.0, -9.0, z), Vec3::new(9.0, 0.0, z), Vec3::new(0.0, 9.0, z + 0.25)]);
        triangles.push([first, first + 1, first + 2]);
    }
    let mesh = Mesh::new(vertices, triangles)?;
    let hard = (0..QUERIES)
        .filter_map(|i| Ray::new(Vec3::new(0.01, 0.02, -5.0), sphere.vertices()[i] * 0.5 + Vec3::Z * 5.0).ok())
        .collect();
    let ordinary = procedural::rays(&mesh, 1, QUERIES);
    let bvh = BuildOptions { builder: Builder::Spatial, ..BuildOptions::default() }.build(&mesh)?;
    let tracer = Tracer::new(WideBvh::of(&bvh)?);
    // Crossings examine all triangles along the ray, like all-hits queries.
    Ok(queries(
        tracer,
        hard,
        ordinary,
        |tracer, ray| tracer.crossings(ray) as usize,
        |tracer, ray| Some(tracer.count_all(&[*ray]).into()),
    ))
}

fn nearest_to_pole() -> Made {
    const SPOKES: u32 = 100_000;
    let spoke = |i: u32| {
        let angle = f64::from(i) / f64::from(SPOKES) * std::f64::consts::TAU;
        DVec3::new(angle.cos(), angle.sin(), 0.0).as_vec3()
    };
    let vertices: Vec<_> = std::iter::once(Vec3::ZERO).chain((0..SPOKES).map(spoke)).collect();
    let triangles = (0..SPOKES).map(|i| [0, 1 + i, 1 + (i + 1) % SPOKES]).collect();
    nearest(Mesh::new(vertices, triangles)?, (0..8u8).map(|i| Vec3::new(0.0, 0.0, 0.1 + 0.3 * f32::from(i))))
}

fn nearest_to_coincident() -> Made {
    nearest(coincident(100_000)?, (0..8u8).map(|i| Vec3::new(-0.1 * f32::from(i), 5.0, 0.3)))
}

/// Points up to 2^120 away.
fn origins_afar() -> impl Iterator<Item = Vec3> {
    from_afar().into_iter().map(|ray| ray.origin())
}

/// Points up to 2^120, and up to 2^960, away. Nodes and triangles are not counted.
fn nearest_from_afar_64() -> Made {
    let mesh = sphere()?;
    let wide = mesh.vertices().iter().map(|v| v.as_dvec3()).collect();
    let tracer = Tracer::of(&Mesh::new(wide, mesh.triangles().to_vec())?)?;
    let ordinary = procedural::rays(&mesh, 1, QUERIES).iter().map(|ray| ray.origin().as_dvec3()).collect::<Vec<_>>();
    let hard = origins_afar().map(Vec3::as_dvec3).flat_map(|o| [o, o * o.length().powi(7)]);
    let balls = |points: Vec<DVec3>| points.into_iter().map(Ball::around).collect::<Result<_, _>>();
    let (hard, ordinary) = (balls(hard.collect())?, balls(ordinary)?);
    Ok(queries(tracer, hard, ordinary, |tracer, ball| usize::from(tracer.nearest(ball).is_some()), uncounted))
}

/// Compares the points with points in a box around the mesh.
fn nearest(mesh: Mesh, points: impl Iterator<Item = Vec3>) -> Made {
    let tracer = Tracer::of(&mesh)?;
    let ordinary =
        procedural::rays(&mesh, 1, QUERIES).iter().map(|ray| Ball::around(ray.origin())).collect::<Result<_, _>>()?;
    let hard = points.map(Ball::around).collect::<Result<_, _>>()?;
    Ok(queries(
        tracer,
        hard,
        ordinary,
        |tracer, ball| usize::from(tracer.nearest(ball).is_some()),
        |tracer, ball| Some(tracer.count_nearest(&[*ball]).into()),
    ))
}

#[cfg(test)]
mod tests;
