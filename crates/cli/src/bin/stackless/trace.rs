//! `stackless trace`: the caller's rays through a scene.

use std::path::PathBuf;

use glam::Vec3;
use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::{Kernel, Ray, Slabs};
use stackless_bvh::trace::{self, Accuracy, Form, Hit, Tracer, WithTests};
use stackless_bvh::traverse::{Method, Unfit};

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
#[command(after_help = "Examples:\n  stackless trace bunny.ply --rays rays.csv --out hits.csv\n  \
    echo 0,0,5,0,0,-1,0,inf | stackless trace soup --rays - --out - --method uncle")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// File of the rays; `-` is the standard input.
    #[arg(long)]
    rays: PathBuf,
    /// File for the hits; written whole or not at all. `-` is the standard output.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    out: Output,
    /// The traversal.
    #[arg(long, default_value_t, value_parser = input::MethodName)]
    method: Method,
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
    let bvh = Build::chosen(args.build, &[args.method]).run(&scene)?;
    let hits = trace::with_level(args.accuracy, WithRays { args, bvh, rays: &rays })
        .map_err(|unfit| format!("{}: {unfit}", args.method))?;
    let rows = hits.iter().map(|hit| hit.map(|Hit { prim, t, u, v }| (prim, t, u, v)));
    write_file(&args.out, |file| stackless_scene::write_hits(file, rows))?;
    let hit = hits.iter().flatten().count();
    say!("{}: {} rays, {hit} hits, by {}, {}", scene.name, rays.len(), args.method, args.accuracy);
    Ok(true)
}

struct WithRays<'a> {
    args: &'a Args,
    bvh: Bvh,
    rays: &'a [Ray],
}

type Hits = Result<Vec<Option<Hit>>, Unfit>;

impl WithTests for WithRays<'_> {
    type Output = Hits;

    fn call<K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>>(self) -> Hits {
        let Self { args, bvh, rays } = self;
        let bvh = bvh.with_links(args.method.wants_recorded()).map(K::Shape::from);
        let tracer = Tracer::<_, K, B>::with_tests(&bvh, args.method)?;
        let progress = bar(rays.len() as u64, "rays");
        let hits = rays.par_chunks(1024).flat_map_iter(|chunk| {
            progress.inc(chunk.len() as u64);
            if args.any { tracer.any_hit_each(chunk) } else { tracer.closest_each(chunk) }
        });
        let hits = hits.collect();
        progress.finish_and_clear();
        Ok(hits)
    }
}
