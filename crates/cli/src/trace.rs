//! `stackless trace`: the caller's rays through a scene.

use std::error::Error;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use stackless_bvh::bvh::{Builder, Bvh};
use stackless_bvh::geom::kernel::Exact64;
use stackless_bvh::geom::lanes::Precision;
use stackless_bvh::geom::{Kernel, Ray, Slabs, Triangle, Vector, slabs};
use stackless_bvh::trace::{self, Accuracy, BinaryTracer, Hit, KernelShape, RayQueries, Tracer, WithTests};
use stackless_bvh::traverse::{Method, Unsupported};
use stackless_bvh::wide;
use stackless_scene::{Float, Format, Position};
use stackless_suite::Traversal;

use crate::Outcome;
use crate::build;
use crate::input::{self, Scene};
use crate::output::{self, bar, count, say, write_file};
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
    override_usage = "stackless trace [OPTIONS] --rays <FILE>\n       --output <FILE> <SCENE>",
    after_help = "Examples:\n  stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.csv\n  \
    stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.npy --single\n  \
    echo 0,0,5,0,0,-1 | stackless trace soup --rays - -o - --method uncle"
)]
#[expect(clippy::struct_excessive_bools, reason = "options that are given or not")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// File of the rays (.csv, .jsonl, .npy), ox,oy,oz,dx,dy,dz,tmin,tmax each; `-` is the standard input.
    #[arg(long, value_name = "FILE")]
    rays: PathBuf,
    /// File for the hits (.csv, .jsonl, .npy), prim,t,u,v each; written whole or not at all. `-` is the standard
    /// output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file())]
    output: Output,
    /// How rays and hits stand in what has no such extension.
    #[arg(long, default_value_t, value_parser = input::names(Format::ALL, Format::name))]
    format: Format,
    /// The traversal: of binary trees, or with --single of wide ones, which are faster and always exact.
    /// [default: afra; with --single wide-record where the accuracy is exact]
    #[arg(long, value_parser = input::traversal())]
    method: Option<Traversal>,
    /// How the hierarchy is built. [default: standard, for `complete`
    /// median]
    #[arg(long, value_parser = build::builder())]
    build: Option<Builder>,
    /// How exact the answers are to be; other than exact only with --single.
    #[arg(long, default_value = "exact", value_parser = input::accuracy())]
    accuracy: Accuracy,
    /// End at the first hit that is met, instead of finding the closest.
    #[arg(long)]
    any: bool,
    /// Write the number of the face that the file has, instead of the triangle's: a polygon is several triangles.
    #[arg(long)]
    faces: bool,
    /// Round scene and rays to single precision, and answer in it, in little more than half of the memory. A note says how
    /// many numbers are rounded and by how much. [default: double precision]
    #[arg(long)]
    single: bool,
    /// Read scene and rays in double precision, and answer in it: the default.
    #[arg(long, hide = true, conflicts_with = "single")]
    double: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    if args.single { args.answer(Args::in_single) } else { args.answer(Args::in_double) }
}

/// Options that do not go together.
#[derive(Debug, thiserror::Error)]
enum Unfitting {
    #[error("--accuracy {0}: double precision is always exact; add --single, or leave --accuracy out")]
    Double(Accuracy),
    #[error("--accuracy {0}: {1} is always exact; choose a traversal of binary trees")]
    Accuracy(Accuracy, wide::Method),
}

/// What was found of a scene's rays.
struct Traced<F> {
    method: &'static str,
    hits: Hits<F>,
}

type Hits<F = f32> = Vec<Option<Hit<F>>>;

impl Args {
    /// Reads scene and rays, and writes what `trace` finds.
    fn answer<V: Position>(
        &self,
        trace: impl FnOnce(&Self, &Scene<V>, &[Ray<V>]) -> Result<Traced<V::Real>, Box<dyn Error>>,
    ) -> Outcome {
        let written_as = self.format_of(&self.output)?;
        if written_as == Format::Npy {
            places::refuse_terminal(&self.output, written_as.name())?;
        }
        let read_as = self.format_of(&self.rays)?;
        let (name, rays) = if self.rays.as_os_str() == "-" {
            let name = Path::new("standard input");
            (name, stackless_scene::read_rays_from(std::io::stdin().lock(), name, read_as)?)
        } else {
            (&*self.rays, stackless_scene::read_rays(&self.rays, read_as)?)
        };
        let scene = Scene::load(&self.scene)?;
        if let Some(note) = rays.note(name, stackless_scene::size(&scene.mesh)) {
            output::warn(&note);
        }
        let Traced { method, hits } = trace(self, &scene, &rays.rays)?;
        let faces: &[u32] = if self.faces { &scene.faces } else { &[] };
        let number = |prim| faces.get(prim as usize).copied().unwrap_or(prim);
        let rows = hits.iter().map(|hit| hit.map(|Hit { prim, t, u, v }| (number(prim), t, u, v)));
        write_file(&self.output, |file| stackless_scene::write_hits(file, rows, written_as))?;
        let counts = [count(hits.len() as u64, "ray"), count(hits.iter().flatten().count() as u64, "hit")].join(", ");
        let precision = <V::Real as Float>::PRECISION;
        say!("{}: {counts}, by {method}, {}, in {precision} precision", scene.name, self.accuracy);
        if let Some(note) = scene.degenerate_note() {
            say!("{note}");
        }
        Ok(true)
    }

    fn in_single(&self, scene: &Scene, rays: &[Ray]) -> Result<Traced<f32>, Box<dyn Error>> {
        match self.traversal()? {
            Traversal::Binary(method) => {
                let bvh = build::binary(build::chosen(self.build, &[method]), scene)?;
                let traced = trace::with_level(self.accuracy, Binary { method, bvh, any: self.any, rays });
                let hits = traced.map_err(|unfit| format!("{method}: {unfit}"))?;
                Ok(Traced { method: method.name(), hits })
            }
            Traversal::Wide(method) => self.by_wide(method, scene, rays),
        }
    }

    fn in_double(&self, scene: &Scene<DVec3>, rays: &[Ray<DVec3>]) -> Result<Traced<f64>, Box<dyn Error>> {
        if self.accuracy != Accuracy::Exact {
            return Err(Unfitting::Double(self.accuracy).into());
        }
        let method = match self.method.unwrap_or(Traversal::Wide(wide::Method::default())) {
            Traversal::Wide(method) => return self.by_wide(method, scene, rays),
            Traversal::Binary(method) => method,
        };
        let bvh = build::binary(build::chosen(self.build, &[method]), scene)?;
        let traced = Binary { method, bvh, any: self.any, rays }.run::<Exact64, slabs::Slabs64>();
        let hits = traced.map_err(|unfit| format!("{method}: {unfit}"))?;
        Ok(Traced { method: method.name(), hits })
    }

    fn by_wide<V: Precision + Position>(
        &self,
        method: wide::Method,
        scene: &Scene<V>,
        rays: &[Ray<V>],
    ) -> Result<Traced<V::Real>, Box<dyn Error>> {
        let bvh = build::wide(self.build.unwrap_or_default(), scene)?;
        let tracer = Tracer::with_method(&bvh, method).map_err(|unfit| format!("{method}: {unfit}"))?;
        let each = |rays: &[Ray<V>]| if self.any { tracer.any_hit_each(rays) } else { tracer.closest_each(rays) };
        Ok(Traced { method: method.name(), hits: in_chunks(rays, each) })
    }

    /// What the extension of a file says; without one, what the option says.
    fn format_of(&self, path: &Path) -> Result<Format, String> {
        let told = Format::of(path).map_err(|error| error.to_string())?;
        Ok(told.unwrap_or(self.format))
    }

    /// The traversal in single precision.
    fn traversal(&self) -> Result<Traversal, Unfitting> {
        match (self.method, self.accuracy) {
            (None, Accuracy::Exact) => Ok(Traversal::Wide(wide::Method::default())),
            (None, _) => Ok(Traversal::Binary(Method::default())),
            (Some(Traversal::Wide(method)), other) if other != Accuracy::Exact => {
                Err(Unfitting::Accuracy(other, method))
            }
            (Some(method), _) => Ok(method),
        }
    }
}

/// Rays by a traversal of binary trees.
struct Binary<'a, V: Vector = Vec3> {
    method: Method,
    bvh: Bvh<Triangle<V>>,
    any: bool,
    rays: &'a [Ray<V>],
}

impl<V: Vector> Binary<'_, V> {
    fn run<K, B>(self) -> Result<Hits<V::Real>, Unsupported>
    where
        K: Kernel<Vector = V, Shape: From<Triangle<V>>>,
        B: Slabs<Vector = V>,
    {
        let Self { method, bvh, any, rays } = self;
        let bvh = bvh.with_links(method.wants_recorded()).map(K::Shape::from);
        let tracer = BinaryTracer::<_, K, B>::with_tests(&bvh, method)?;
        Ok(in_chunks(rays, |chunk| if any { tracer.any_hit_each(chunk) } else { tracer.closest_each(chunk) }))
    }
}

impl WithTests for Binary<'_> {
    type Output = Result<Hits, Unsupported>;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        self.run::<K, B>()
    }
}

/// All answers, on all threads, with a progress bar.
fn in_chunks<V: Vector>(rays: &[Ray<V>], each: impl Fn(&[Ray<V>]) -> Hits<V::Real> + Sync + Send) -> Hits<V::Real> {
    let progress = bar(rays.len() as u64, "rays");
    let hits = rays.par_chunks(1024).flat_map_iter(|chunk| {
        progress.inc(chunk.len() as u64);
        each(chunk)
    });
    let hits = hits.collect();
    progress.finish_and_clear();
    hits
}
