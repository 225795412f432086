//! `stackless trace`: the caller's rays through a scene.

use std::path::{Path, PathBuf};

use glam::Vec3;
use rayon::prelude::*;
use stackless_bvh::bvh::{Bvh, WideBvh};
use stackless_bvh::geom::{Kernel, Ray, Slabs};
use stackless_bvh::trace::{self, Accuracy, BinaryTracer, Form, Hit, Tracer, WithTests};
use stackless_bvh::traverse::{Method, Unfit};
use stackless_bvh::wide;
use stackless_scene::Format;
use stackless_suite::Traversal;

use crate::Outcome;
use crate::build::{Build, BuildName};
use crate::input::{self, Scene};
use crate::output::{self, bar, count, grouped, say, write_file};
use crate::places::{self, Output};

/// Trace rays through a scene.
///
/// A ray is a line of ox,oy,oz,dx,dy,dz,tmin,tmax, of which the last two may be missing; a hit is a line of prim,t,u,v,
/// where prim is the index of the triangle in the file's order (polygons are fanned out in place), or -1 for a miss,
/// with the other columns empty. t is the distance in lengths of the direction; u and v are the weights of the second
/// and the third corner.
///
/// JSON lines (.jsonl) have the same: `{"origin":[0,0,5],"direction":[0,0,-1],"tmin":0,"tmax":null}`, and
/// `{"prim":3,"t":1.5,"u":0.25,"v":0.5}`. `NumPy` arrays (.npy) have rows of 6 or 8 floats, and records of prim, t, u, v.
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.csv\n  \
    stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.npy\n  \
    echo 0,0,5,0,0,-1 | stackless trace soup --rays - -o - --method uncle"
)]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// File of the rays (.csv, .jsonl, .npy), ox,oy,oz,dx,dy,dz,tmin,tmax each; `-` is the standard input.
    #[arg(long, value_name = "FILE")]
    rays: PathBuf,
    /// File for the hits (.csv, .jsonl, .npy), prim,t,u,v each; written whole or not at all. `-` is the standard
    /// output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file)]
    output: Output,
    /// How rays and hits stand in what has no such extension.
    #[arg(long, default_value_t, value_parser = input::names(Format::ALL, Format::name))]
    format: Format,
    /// The traversal: of wide trees, which are faster and always exact, or of binary ones.
    /// [default: wide-record; afra where the accuracy is not exact]
    #[arg(long, value_parser = input::traversal())]
    method: Option<Traversal>,
    /// How the hierarchy is built; with `+N` behind a name, N rounds of reinsertion follow. [default: sah, for `complete`
    /// median]
    #[arg(long, value_parser = BuildName)]
    build: Option<Build>,
    /// How exact the answers are to be.
    #[arg(long, default_value = "exact", value_parser = input::accuracy())]
    accuracy: Accuracy,
    /// End at the first hit that is met, instead of finding the closest.
    #[arg(long)]
    any: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let written_as = args.format_of(&args.output)?;
    let read_as = args.format_of(&args.rays)?;
    let (name, rays) = if args.rays.as_os_str() == "-" {
        let name = Path::new("standard input");
        (name, stackless_scene::read_rays_from(std::io::stdin().lock(), name, read_as)?)
    } else {
        (&*args.rays, stackless_scene::read_rays(&args.rays, read_as)?)
    };
    if let Some(note) = rays.note(name) {
        output::warn(&note);
    }
    let rays = rays.rays;
    let scene = Scene::load(&args.scene)?;
    let (method, dropped, hits) = match args.traversal()? {
        Traversal::Binary(method) => {
            let bvh = Build::chosen(args.build, &[method]).run(&scene)?;
            let dropped = bvh.dropped();
            let traced = trace::with_level(args.accuracy, Binary { method, bvh, any: args.any, rays: &rays });
            (method.name(), dropped, traced.map_err(|unfit| format!("{method}: {unfit}"))?)
        }
        Traversal::Wide(method) => {
            let fine = args.build.unwrap_or_default().run_fine(&scene)?;
            let bvh = WideBvh::of(&fine)?;
            let tracer = Tracer::with_method(&bvh, method).map_err(|unfit| format!("{method}: {unfit}"))?;
            let each = |rays: &[Ray]| if args.any { tracer.any_hit_each(rays) } else { tracer.closest_each(rays) };
            (method.name(), fine.dropped(), in_chunks(&rays, each))
        }
    };
    let rows = hits.iter().map(|hit| hit.map(|Hit { prim, t, u, v }| (prim, t, u, v)));
    write_file(&args.output, |file| stackless_scene::write_hits(file, rows, written_as))?;
    let counts = [count(rays.len() as u64, "ray"), count(hits.iter().flatten().count() as u64, "hit")].join(", ");
    say!("{}: {counts}, by {method}, {}", scene.name, args.accuracy);
    if dropped > 0 {
        let of = count(scene.mesh.triangles().len() as u64, "triangle");
        say!("{}: {} of {of} left out: degenerate, so that no ray meets them", scene.name, grouped(dropped as u64));
    }
    Ok(true)
}

impl Args {
    /// What the extension of a file says; without one, what the option says.
    fn format_of(&self, path: &Path) -> Result<Format, String> {
        let told = Format::of(path).map_err(|error| error.to_string())?;
        Ok(told.unwrap_or(self.format))
    }

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
