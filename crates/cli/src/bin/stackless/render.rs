//! `stackless render`: pictures of a scene, and of what traversal costs in it.

mod cost;
mod picture;
mod sample;

use std::path::PathBuf;

use rayon::prelude::*;
use stackless_bvh::bvh::{Bvh, WideBvh};
use stackless_bvh::trace::{BinaryTracer, Continuation, Tracer};
use stackless_bvh::traverse::Method;

use crate::Outcome;
use crate::build::Build;
use crate::camera::{self, Camera};
use crate::input::{self, Scene};
use crate::output::{bar, say, write_file};
use crate::places::{self, Output};
use cost::{Costs, Heat};
use picture::Picture;
pub(crate) use picture::heat_maps;
use sample::{Rays, Sample, Samples};

/// Draw a scene, or what its traversal costs, as a PNG file.
///
/// The same options give the same picture, for any number of threads. Scenes are rounded to single precision, and rays are
/// exact.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless render examples/data/torus.ply -o torus.png\n  \
    stackless render examples/data/room.obj --kind ao --spp 64 --size 800x600 --view 5.7,1.7,2,0,1.2,2,0,1,0,75 -o ao.png\n  \
    stackless render examples/data/room.obj --heatmap nodes --compare stack,skip -o nodes.png\n  \
    stackless render examples/data/slivers.ply --figure 1 -o figure1.png")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// The picture; `-` is the standard output.
    #[arg(short, long, value_name = "FILE.png", value_parser = places::file_as("png"))]
    output: Output,
    #[command(flatten)]
    camera: camera::Options,
    /// Which rays each pixel stands for.
    #[arg(long, value_enum, default_value_t)]
    kind: Rays,
    /// Samples of each pixel; 1 if it is not given, or 16 for ao and diffuse.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    spp: Option<u32>,
    /// Colours are what the rays of a pixel cost: the mean for one ray.
    #[arg(long, value_enum)]
    heatmap: Option<Heat>,
    /// The traversal whose cost is drawn.
    #[arg(long, default_value = "hashed", value_parser = input::method())]
    method: Method,
    /// Heat maps of these traversals, beside each other, with one scale.
    #[arg(long, value_delimiter = ',', value_parser = input::method())]
    #[arg(requires = "heatmap", conflicts_with = "method")]
    compare: Vec<Method>,
    /// A figure of Binder & Keller 2016: 1, the backtracking steps of three schemes; 7, the postponed nodes that are
    /// visited without and with pruning; 8, the nodes that paths visit from the root and from their last hit.
    #[arg(long, value_enum, conflicts_with_all = ["heatmap", "method", "compare", "kind"])]
    figure: Option<Figure>,
    /// How the hierarchy is built: sah, sbvh, lbvh, bounded or median; with `+N`, N rounds of reinsertion follow.
    /// [default: sah, with `complete` median]
    #[arg(long)]
    build: Option<Build>,
    /// Seed of what is random.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// A figure of Binder & Keller 2016.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Figure {
    /// Backtracking steps of three schemes.
    #[value(name = "1")]
    Schemes,
    /// Postponed nodes that are visited, without and with pruning.
    #[value(name = "7")]
    Pruning,
    /// Nodes that diffuse rays visit, from the root and from the last hit.
    #[value(name = "8")]
    Continuing,
}

/// The share of the pixels that the scale covers: a few rays cost many times what all others do.
const SCALE: f64 = 0.99;

pub(crate) fn run(args: &Args) -> Outcome {
    let scene = Scene::load(&args.scene)?;
    let job = Job::of(args, &scene);
    let build = Build::chosen(args.build, &job.methods);
    let Drawn { png, lines } = job.draw(&scene, &build.run(&scene)?)?;
    write_file(&args.output, |file| file.write_all(&png))?;
    for line in lines {
        say!("{line}");
    }
    Ok(true)
}

/// What is to be drawn.
struct Job {
    camera: Camera,
    rays: Rays,
    spp: u32,
    heat: Option<Heat>,
    methods: Vec<Method>,
    /// Beside the traversal from the root the one from the last hit.
    continues: bool,
    seed: u64,
}

/// A picture, and what is to be said of it.
struct Drawn {
    png: Vec<u8>,
    lines: Vec<String>,
}

impl Job {
    fn of(args: &Args, scene: &Scene) -> Self {
        let (camera, seed) = (args.camera.of(scene), args.seed);
        let job = if let Some(figure) = args.figure {
            Self::figure(figure, camera, seed)
        } else {
            let methods = if args.compare.is_empty() { vec![args.method] } else { args.compare.clone() };
            Self { heat: args.heatmap, methods, ..Self::plain(args.kind, camera, seed) }
        };
        Self { spp: args.spp.unwrap_or(job.spp), ..job }
    }

    fn figure(figure: Figure, camera: Camera, seed: u64) -> Self {
        let job = |rays, heat, methods: &[Method]| Self {
            heat: Some(heat),
            methods: methods.to_vec(),
            ..Self::plain(rays, camera, seed)
        };
        match figure {
            Figure::Schemes => job(Rays::Primary, Heat::Backtrack, &[Method::Afra, Method::Uncle, Method::Hashed]),
            Figure::Pruning => job(Rays::Primary, Heat::Postponed, &[Method::Hashed, Method::HashedDisjoint]),
            Figure::Continuing => Self { continues: true, ..job(Rays::Diffuse, Heat::Nodes, &[Method::Hashed]) },
        }
    }

    fn plain(rays: Rays, camera: Camera, seed: u64) -> Self {
        let spp = if matches!(rays, Rays::Ao | Rays::Diffuse) { 16 } else { 1 };
        Self { camera, rays, spp, heat: None, methods: Vec::new(), continues: false, seed }
    }

    fn draw(&self, scene: &Scene, bvh: &Bvh) -> Result<Drawn, Box<dyn std::error::Error>> {
        let tracer = Tracer::new(WideBvh::of(bvh)?);
        let &Self { camera, rays, spp, seed, .. } = self;
        let samples = Samples { scene, bvh, tracer, camera, rays, spp, seed };
        match self.heat {
            Some(heat) => self.heat_map(&samples, heat),
            None => Ok(self.shaded(&samples)),
        }
    }

    fn shaded(&self, samples: &Samples<'_>) -> Drawn {
        let size = self.camera.size;
        let colours = for_pixels(size.pixels(), "pixels", |pixel| samples.colour(pixel));
        let mut picture = Picture::new(size.width, size.height);
        picture.fill([0, 0], size, |pixel| colours[pixel]);
        let line = format!("{}: {}x{} pixels, {} samples each", samples.scene.name, size.width, size.height, self.spp);
        Drawn { png: picture.to_png(), lines: vec![line] }
    }

    fn heat_map(&self, samples: &Samples<'_>, heat: Heat) -> Result<Drawn, Box<dyn std::error::Error>> {
        let (size, any, bvh) = (self.camera.size, self.rays == Rays::Ao, samples.bvh);
        let binary = BinaryTracer::new(bvh);
        let mut counts: Vec<(&str, Box<Count<'_>>)> = Vec::new();
        for &method in &self.methods {
            let costs = Costs::new(bvh, method, heat, any).map_err(|unfit| format!("{method}: {unfit}"))?;
            counts.push((method.name(), Box::new(move |sample| Some(costs.of(sample.traced.as_ref()?)))));
        }
        if self.continues {
            let continuation = Continuation::new(&binary)?;
            counts[0].0 = "from the root";
            let from_hit = move |sample: &Sample| {
                let (_, place) = continuation.closest(&sample.primary, None)?;
                let (ray, place) = (sample.traced.as_ref()?, Some(place));
                let counters =
                    if any { continuation.count_any(ray, place) } else { continuation.count_closest(ray, place) };
                Some(counters.inner + counters.leaves)
            };
            counts.push(("from the last hit", Box::new(from_hit)));
        }
        let means = for_pixels(size.pixels(), &samples.scene.name, |pixel| {
            let samples: Vec<_> = samples.of(pixel).collect();
            counts.iter().map(|(_, count)| mean(samples.iter().filter_map(count))).collect::<Vec<_>>()
        });
        let of_count = |i: usize| means.iter().map(|means| means[i]).collect::<Vec<_>>();
        let panels: Vec<_> = (0..).zip(&counts).map(|(i, (name, _))| (*name, of_count(i))).collect();
        let mut costs: Vec<f64> = panels.iter().flat_map(|(_, costs)| costs).flatten().copied().collect();
        costs.sort_by(f64::total_cmp);
        let end = costs.get((costs.len() as f64 * SCALE) as usize).copied().unwrap_or(1.0).max(1.0);
        let unit = format!("{} a {}", heat.unit(), self.rays.name());
        let (mut labelled, mut lines) = (Vec::new(), Vec::new());
        for (name, costs) in &panels {
            let known: Vec<f64> = costs.iter().flatten().copied().collect();
            let average = known.iter().sum::<f64>() / known.len().max(1) as f64;
            let most = known.iter().copied().fold(0.0, f64::max);
            lines.push(format!("{}: {name}: {average:.2} {unit}, at most {most:.1} in a pixel", samples.scene.name));
            labelled.push((format!("{name}: mean {average:.2}"), costs));
        }
        Ok(Drawn { png: picture::heat_maps(size, &labelled, end, &unit).to_png(), lines })
    }
}

/// What a sample costs, if it is counted at all.
type Count<'a> = dyn Fn(&Sample) -> Option<u64> + Sync + 'a;

/// Answers for each pixel, on all threads, with a progress bar.
fn for_pixels<T: Send>(pixels: usize, name: &str, answer: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let progress = bar(pixels as u64, name);
    let answer = |pixel: usize| {
        if pixel.is_multiple_of(256) {
            progress.inc(256);
        }
        answer(pixel)
    };
    let answers = (0..pixels).into_par_iter().with_min_len(64).map(answer).collect();
    progress.finish_and_clear();
    answers
}

/// The mean of counts; `None` without one.
fn mean(counts: impl Iterator<Item = u64>) -> Option<f64> {
    let (sum, n) = counts.fold((0, 0_u64), |(sum, n), count| (sum + count, n + 1));
    (n > 0).then(|| sum as f64 / n as f64)
}
