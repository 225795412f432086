//! `stackless trace`: traces rays of a file through a scene.

use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use stackless_bvh::bvh::{Builder, Bvh};
use stackless_bvh::geom::{Kernel, Precision, Ray, Triangle, Vector};
use stackless_bvh::internals::geom::kernel::Exact64;
use stackless_bvh::internals::geom::{Slabs, slabs};
use stackless_bvh::internals::trace::{Accuracy, KernelShape, WithTests, with_level};
use stackless_bvh::trace::{BinaryTracer, Hit, MeshQueries as _, RayQueries, Tracer};
use stackless_bvh::traverse::{Method, Unsupported};
use stackless_bvh::wide;
use stackless_scene::{Cell, Column, Float, Format, Position, write_table};
use stackless_suite::Traversal;

use crate::Outcome;
use crate::build;
use crate::input::{self, Scene};
use crate::output::{self, bar, count, say, write_file};
use crate::places::{self, Output};

/// Trace rays through a scene.
///
/// A ray is a line of ox,oy,oz,dx,dy,dz,tmin,tmax; tmin and tmax are optional. A hit is a line of prim,t,u,v. prim is
/// the index of the triangle in the file's order (a polygon of n corners is n - 2 triangles). A miss has prim -1 and
/// empty columns. t is the distance in lengths of the direction. u and v are the weights of the second and the third
/// corner.
///
/// JSON lines (.jsonl) have the same fields: `{"origin":[0,0,5],"direction":[0,0,-1],"tmin":0,"tmax":null}`, and
/// `{"prim":3,"t":1.5,"u":0.25,"v":0.5}`. `NumPy` arrays (.npy) have rows of 6 or 8 floats, and records of prim, t, u,
/// v.
#[derive(clap::Args)]
#[command(
    override_usage = "stackless trace [OPTIONS] --rays <FILE>\n       --output <FILE> <SCENE>",
    after_help = "Examples:\n  stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.csv\n  \
    stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.npy --single\n  \
    stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o - --query all\n  \
    echo 0,0,5,0,0,-1 | stackless trace soup --rays - -o - --method uncle"
)]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Read the rays from this file (.csv, .jsonl, .npy): ox,oy,oz,dx,dy,dz,tmin,tmax each. `-` is the standard input.
    #[arg(long, value_name = "FILE")]
    rays: PathBuf,
    /// Write the hits to this file (.csv, .jsonl, .npy): prim,t,u,v each. `-` is the standard output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file())]
    output: Output,
    /// Format of rays and hits without such an extension.
    #[arg(long, default_value_t, value_parser = input::names(Format::ALL, Format::name))]
    format: Format,
    /// Traversal, of binary trees or of wide trees, which are faster and always exact. [default: wide-record; for
    /// accuracies other than exact, afra]
    #[arg(long, value_parser = input::traversal())]
    method: Option<Traversal>,
    /// Builder of the hierarchy. [default: standard, for `complete` median]
    #[arg(long, value_parser = build::builder())]
    build: Option<Builder>,
    /// Accuracy of the answers. Levels other than exact need --single.
    #[arg(long, default_value = "exact", value_parser = input::accuracy())]
    accuracy: Accuracy,
    /// Query for each ray: `closest` hit; `any` hit, which is faster; `all` hits in order, one line each with the index
    /// of the ray; or the number of `crossings` of a closed mesh.
    #[arg(long, default_value = "closest", value_parser = input::names(Query::ALL, Query::name))]
    query: Query,
    /// Write the index of the face in the file instead of the triangle's index: a polygon is several triangles.
    #[arg(long)]
    faces: bool,
    /// Round scene and rays to single precision, and answer in single precision. Needs little more than half of the
    /// memory. A note reports the number and size of the rounding errors. [default: double precision]
    #[arg(long)]
    single: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    if args.single { args.answer(Args::in_single) } else { args.answer(Args::in_double) }
}

/// A kind of query.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Query {
    Closest,
    Any,
    All,
    Crossings,
}

impl Query {
    const ALL: [Self; 4] = [Self::Closest, Self::Any, Self::All, Self::Crossings];

    const fn name(self) -> &'static str {
        match self {
            Self::Closest => "closest",
            Self::Any => "any",
            Self::All => "all",
            Self::Crossings => "crossings",
        }
    }
}

/// Incompatible options.
#[derive(Debug, thiserror::Error)]
enum Unfitting {
    #[error("--accuracy {0}: double precision is always exact; add --single, or remove --accuracy")]
    Double(Accuracy),
    #[error("--accuracy {0}: {1} is always exact; choose a traversal of binary trees")]
    Accuracy(Accuracy, wide::Method),
    #[error("--query crossings: {0} does not count them; choose a traversal of wide trees, or remove --method")]
    Crossings(Method),
}

/// The answers for all rays, and the name of the traversal.
struct Traced<F> {
    method: &'static str,
    answers: Answers<F>,
}

/// One answer per ray.
enum Answers<F = f32> {
    /// Closest hits, or any hits.
    Hits(Vec<Option<Hit<F>>>),
    All(Vec<Vec<Hit<F>>>),
    Crossings(Vec<u32>),
}

impl Args {
    /// Reads scene and rays, and writes the result of `trace`.
    fn answer<V: Position>(
        &self,
        trace: impl FnOnce(&Self, &Scene<V>, &[Ray<V>]) -> Result<Traced<V::Real>, Box<dyn Error>>,
    ) -> Outcome {
        let written_as = input::format_to_write(&self.output, self.format)?;
        let read_as = input::format(&self.rays, self.format)?;
        let (name, rays) = input::rows(&self.rays, read_as)?;
        let scene = Scene::load(&self.scene)?;
        if let Some(note) = rays.note(name, stackless_scene::size(&scene.mesh)) {
            output::warn(&note);
        }
        let Traced { method, answers } = trace(self, &scene, &rays.rows)?;
        let number = |prim| scene.number(prim, self.faces);
        write_file(&self.output, |file| answers.write(file, written_as, number))?;
        let counts = format!("{}, {}", count(rays.rows.len() as u64, "ray"), answers.count());
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
                let traced = with_level(self.accuracy, self.by_binary(method, bvh, rays)?);
                let answers = traced.map_err(|unfit| format!("{method}: {unfit}"))?;
                Ok(Traced { method: method.name(), answers })
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
        let traced = self.by_binary(method, bvh, rays)?.run::<Exact64, slabs::Slabs64>();
        let answers = traced.map_err(|unfit| format!("{method}: {unfit}"))?;
        Ok(Traced { method: method.name(), answers })
    }

    fn by_wide<V: Precision + Position>(
        &self,
        method: wide::Method,
        scene: &Scene<V>,
        rays: &[Ray<V>],
    ) -> Result<Traced<V::Real>, Box<dyn Error>> {
        let bvh = build::wide(self.build.unwrap_or_default(), scene)?;
        let tracer = Tracer::with_method(&bvh, method).map_err(|unfit| format!("{method}: {unfit}"))?;
        let answers = match self.query {
            Query::Crossings => {
                let each = |rays: &[Ray<V>]| rays.iter().map(|ray| tracer.crossings(ray)).collect();
                Answers::Crossings(in_chunks(rays, each))
            }
            query => hits(query, &tracer, rays),
        };
        Ok(Traced { method: method.name(), answers })
    }

    fn by_binary<'a, V: Vector>(
        &self,
        method: Method,
        bvh: Bvh<Triangle<V>>,
        rays: &'a [Ray<V>],
    ) -> Result<Binary<'a, V>, Unfitting> {
        match self.query {
            Query::Crossings => Err(Unfitting::Crossings(method)),
            query => Ok(Binary { method, bvh, query, rays }),
        }
    }

    /// The traversal for single precision.
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

/// Rays for a traversal of binary trees.
struct Binary<'a, V: Vector = Vec3> {
    method: Method,
    bvh: Bvh<Triangle<V>>,
    query: Query,
    rays: &'a [Ray<V>],
}

impl<V: Vector> Binary<'_, V> {
    fn run<K, B>(self) -> Result<Answers<V::Real>, Unsupported>
    where
        K: Kernel<Vector = V, Shape: From<Triangle<V>>>,
        B: Slabs<Vector = V>,
    {
        let Self { method, bvh, query, rays } = self;
        let bvh = bvh.with_links(method.wants_recorded()).map(K::Shape::from);
        let tracer = BinaryTracer::<_, K, B>::with_tests(&bvh, method)?;
        Ok(hits(query, &tracer, rays))
    }
}

impl WithTests for Binary<'_> {
    type Output = Result<Answers, Unsupported>;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        self.run::<K, B>()
    }
}

/// Finds the hits of all rays. It does not count crossings.
fn hits<V: Vector>(
    query: Query,
    tracer: &(impl RayQueries<Ray<V>, Hit = Hit<V::Real>> + Sync),
    rays: &[Ray<V>],
) -> Answers<V::Real> {
    match query {
        Query::Any => Answers::Hits(in_chunks(rays, |rays| tracer.any_hit_each(rays))),
        Query::All => Answers::All(in_chunks(rays, |rays| tracer.all_each(rays))),
        Query::Closest | Query::Crossings => Answers::Hits(in_chunks(rays, |rays| tracer.closest_each(rays))),
    }
}

impl<F: Float> Answers<F> {
    /// Writes a table; `number` maps triangles to the written indices.
    fn write(&self, file: impl Write, format: Format, number: impl Fn(u32) -> u32) -> io::Result<()> {
        let [u, v] = ["u", "v"].map(|name| Column::Number(name, f64::NAN));
        let [prim, t] = [Column::Integer("prim"), Column::Number("t", f64::INFINITY)];
        let cells = |hit: &Hit<F>| {
            [Cell::Integer(number(hit.prim).into()), Cell::Number(hit.t), Cell::Number(hit.u), Cell::Number(hit.v)]
        };
        match self {
            Self::Hits(hits) => {
                let miss = [Cell::Integer(-1), Cell::Missing, Cell::Missing, Cell::Missing];
                let rows = hits.iter().map(|hit| hit.as_ref().map_or(miss, cells));
                write_table(file, [prim, t, u, v], rows, format)
            }
            Self::All(all) => {
                let row = |ray: usize, hit| {
                    let [prim, t, u, v] = cells(hit);
                    [Cell::Integer(ray as i64), prim, t, u, v]
                };
                let rows = all.iter().enumerate().flat_map(|(ray, hits)| hits.iter().map(move |hit| (ray, hit)));
                let rows: Vec<_> = rows.map(|(ray, hit)| row(ray, hit)).collect();
                write_table(file, [Column::Integer("ray"), prim, t, u, v], rows.into_iter(), format)
            }
            Self::Crossings(counts) => {
                let rows = counts.iter().map(|&count| [Cell::<F>::Integer(count.into())]);
                write_table(file, [Column::Integer("crossings")], rows, format)
            }
        }
    }

    /// The number of hits or crossings, in words.
    fn count(&self) -> String {
        match self {
            Self::Hits(hits) => count(hits.iter().flatten().count() as u64, "hit"),
            Self::All(all) => count(all.iter().map(Vec::len).sum::<usize>() as u64, "hit"),
            Self::Crossings(counts) => count(counts.iter().map(|&count| u64::from(count)).sum(), "crossing"),
        }
    }
}

/// Answers all rows on all threads, with a progress bar.
pub(crate) fn in_chunks<R: Sync, A: Send>(rows: &[R], each: impl Fn(&[R]) -> Vec<A> + Sync + Send) -> Vec<A> {
    let progress = bar(rows.len() as u64, "rows");
    let answers = rows.par_chunks(1024).flat_map_iter(|chunk| {
        progress.inc(chunk.len() as u64);
        each(chunk)
    });
    let answers = answers.collect();
    progress.finish_and_clear();
    answers
}
