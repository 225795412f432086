//! `stackless trace`: the caller's rays through a scene.

use std::path::PathBuf;

use glam::Vec3;
use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::{Kernel, Ray, Slabs};
use stackless_bvh::trace::{self, Accuracy, BinaryTracer, Form, Hit, Tracer, WithTests};
use stackless_bvh::traverse::{Method, Unfit};
use stackless_bvh::wide;
use stackless_suite::Traversal;

use crate::Outcome;
use crate::build::Build;
use crate::input::{self, Scene};
use crate::output::{bar, say, write_file};
use crate::places::{self, Output};

/// Trace rays through a scene.
///
/// A ray is a line of ox,oy,oz,dx,dy,dz,tmin,tmax; a hit is a line of prim,t,u,v, where prim is the index of the
/// triangle in the file's order (polygons are fanned out in place), or -1 for a miss, with the other columns empty.
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  stackless trace examples/data/torus.ply --rays examples/data/rays.csv --out hits.csv\n  \
    echo 0,0,5,0,0,-1,0,inf | stackless trace soup --rays - --out - --method uncle"
)]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// File of the rays; `-` is the standard input.
    #[arg(long)]
    rays: PathBuf,
    /// File for the hits; written whole or not at all. `-` is the standard output.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    out: Output,
    /// The traversal: of wide trees, which are faster and always exact, or of binary ones.
    /// [default: wide-record; afra where the accuracy is not exact]
    #[arg(long, value_parser = input::TraversalName)]
    method: Option<Traversal>,
    /// How the hierarchy is built: sah, sbvh, lbvh, bounded or median; with `+N`, N rounds of reinsertion follow.
    /// [default: sah, for `complete` median]
    #[arg(long)]
    build: Option<Build>,
    /// How exact the answers are to be: fast, watertight, precise or exact.
    #[arg(long, default_value = "exact", value_parser = input::accuracy)]
    accuracy: Accuracy,
    /// End at the first hit that is met, instead of finding the closest.
    #[arg(long)]
    any: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let rays = if args.rays.as_os_str() == "-" {
        stackless_scene::read_rays_from(std::io::stdin().lock(), "standard input")?
    } else {
        stackless_scene::read_rays(&args.rays)?
    };
    let scene = Scene::load(&args.scene)?;
    let (method, hits) = match args.traversal()? {
        Traversal::Binary(method) => {
            let bvh = Build::chosen(args.build, &[method]).run(&scene)?;
            let traced = trace::with_level(args.accuracy, Binary { method, bvh, any: args.any, rays: &rays });
            (method.name(), traced.map_err(|unfit| format!("{method}: {unfit}"))?)
        }
        Traversal::Wide(method) => {
            let bvh = args.build.unwrap_or_default().run_wide(&scene)?;
            let tracer = Tracer::with_method(&bvh, method).map_err(|unfit| format!("{method}: {unfit}"))?;
            let each = |rays: &[Ray]| if args.any { tracer.any_hit_each(rays) } else { tracer.closest_each(rays) };
            (method.name(), in_chunks(&rays, each))
        }
    };
    let rows = hits.iter().map(|hit| hit.map(|Hit { prim, t, u, v }| (prim, t, u, v)));
    write_file(&args.out, |file| stackless_scene::write_hits(file, rows))?;
    let hit = hits.iter().flatten().count();
    say!("{}: {} rays, {hit} hits, by {method}, {}", scene.name, rays.len(), args.accuracy);
    Ok(true)
}

impl Args {
    fn traversal(&self) -> Result<Traversal, String> {
        match (self.method, self.accuracy) {
            (None, Accuracy::Exact) => Ok(Traversal::Wide(wide::Method::default())),
            (None, _) => Ok(Traversal::Binary(Method::default())),
            (Some(Traversal::Wide(method)), other) if other != Accuracy::Exact => {
                Err(format!("--accuracy {other}: {method} is always exact; choose a traversal of binary trees"))
            }
            (Some(method), _) => Ok(method),
        }
    }
}

/// Rays by a traversal of binary trees.
struct Binary<'a> {
    method: Method,
    bvh: Bvh,
    any: bool,
    rays: &'a [Ray],
}

type Hits = Vec<Option<Hit>>;

impl WithTests for Binary<'_> {
    type Output = Result<Hits, Unfit>;

    fn call<K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        let Self { method, bvh, any, rays } = self;
        let bvh = bvh.with_links(method.wants_recorded()).map(K::Shape::from);
        let tracer = BinaryTracer::<_, K, B>::with_tests(&bvh, method)?;
        Ok(in_chunks(rays, |chunk| if any { tracer.any_hit_each(chunk) } else { tracer.closest_each(chunk) }))
    }
}

/// All answers, on all threads, with a progress bar.
fn in_chunks(rays: &[Ray], each: impl Fn(&[Ray]) -> Hits + Sync + Send) -> Hits {
    let progress = bar(rays.len() as u64, "rays");
    let hits = rays.par_chunks(1024).flat_map_iter(|chunk| {
        progress.inc(chunk.len() as u64);
        each(chunk)
    });
    let hits = hits.collect();
    progress.finish_and_clear();
    hits
}
