//! `stackless render`: pictures of a scene, and heat maps of traversal cost.

mod cost;
mod picture;
mod sample;

use std::path::PathBuf;

use rayon::prelude::*;
use stackless_bvh::bvh::{Builder, Bvh, WideBvh};
use stackless_bvh::trace::{BinaryTracer, Continuation, Tracer};
use stackless_bvh::traverse::Method;

use crate::Outcome;
use crate::build;
use crate::camera::{self, Camera};
use crate::input::{self, Scene};
use crate::output::{bar, say, write_file};
use crate::places::{self, Output};
use cost::Costs;
pub(crate) use cost::Heat;
use picture::Picture;
pub(crate) use picture::heat_maps;
pub(crate) use sample::Rays;
use sample::{Sample, Samples};

/// Draw a scene, or the cost of its traversal, as a PNG file.
///
/// Equal options give equal pictures, for any number of threads. The scene is rounded to single precision; answers
/// are exact.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless render examples/data/torus.ply -o torus.png\n  \
    stackless render examples/data/room.obj --kind ao --view 5.7,1.7,2,0,1.2,2,0,1,0,75 -o ao.png\n  \
    stackless render examples/data/room.obj --heatmap nodes --method stack,skip -o nodes.png")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Write the picture to this .png file; `-` is the standard output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file_as("png"))]
    output: Output,
    #[command(flatten)]
    camera: camera::Options,
    /// Rays of each pixel.
    #[arg(long, value_enum, default_value_t)]
    kind: Rays,
    /// Samples of each pixel. [default: 4, for ao and diffuse 16, for a heat map 1]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    spp: Option<u32>,
    /// Draw a heat map of this cost, the mean of the rays of a pixel.
    #[arg(long, value_enum)]
    heatmap: Option<Heat>,
    /// Traversals of the heat map, separated by commas: a panel for each, with a common scale.
    #[arg(long, value_delimiter = ',', default_value = "afra", value_parser = input::method())]
    #[arg(hide_possible_values = true)]
    method: Vec<Method>,
    /// Builder of the hierarchy. [default: standard, for `complete` median]
    #[arg(long)]
    build: Option<Builder>,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// The share of the pixels that the scale covers, because a few rays are much more expensive than the rest.
const SCALE: f64 = 0.99;

pub(crate) fn run(args: &Args) -> Outcome {
    let scene = Scene::load(&args.scene)?;
    Job::of(args, &scene).run(&scene, args.build, &args.output)
}

/// A picture to draw.
pub(crate) struct Job {
    pub(crate) camera: Camera,
    pub(crate) rays: Rays,
    pub(crate) spp: u32,
    pub(crate) heat: Option<Heat>,
    pub(crate) methods: Vec<Method>,
    /// Also draws the cost of traversals that continue from the last hit.
    pub(crate) continues: bool,
    pub(crate) seed: u64,
}

/// A picture and its messages.
struct Drawn {
    png: Vec<u8>,
    lines: Vec<String>,
}

impl Job {
    fn of(args: &Args, scene: &Scene) -> Self {
        let job = Self::new(args.kind, args.heatmap, args.camera.of(scene), args.seed);
        Self { methods: args.method.clone(), spp: args.spp.unwrap_or(job.spp), ..job }
    }

    /// Draws the picture into a file. The default tree suits the traversals.
    pub(crate) fn run(&self, scene: &Scene, build: Option<Builder>, output: &Output) -> Outcome {
        let build = build::chosen(build, &self.methods);
        let Drawn { png, lines } = self.draw(scene, &build::binary(build, scene)?)?;
        write_file(output, |file| file.write_all(&png))?;
        for line in lines {
            say!("{line}");
        }
        Ok(true)
    }

    /// Prepares a picture, or a heat map, with the default number of samples.
    pub(crate) fn new(rays: Rays, heat: Option<Heat>, camera: Camera, seed: u64) -> Self {
        let spp = match rays {
            Rays::Ao | Rays::Diffuse => 16,
            Rays::Primary | Rays::Normals if heat.is_some() => 1,
            Rays::Primary | Rays::Normals => 4,
        };
        Self { camera, rays, spp, heat, methods: Vec::new(), continues: false, seed }
    }

    fn draw(&self, scene: &Scene, bvh: &Bvh) -> Result<Drawn, Box<dyn std::error::Error>> {
        let tracer = Tracer::new(WideBvh::of(bvh)?);
        let &Self { camera, rays, spp, seed, .. } = self;
        let samples = Samples { scene, bvh, tracer, camera, axes: camera.axes(), rays, spp, seed };
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

/// The cost of a sample, if it is counted.
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

/// The mean of counts; `None` without counts.
fn mean(counts: impl Iterator<Item = u64>) -> Option<f64> {
    let (sum, n) = counts.fold((0, 0_u64), |(sum, n), count| (sum + count, n + 1));
    (n > 0).then(|| sum as f64 / n as f64)
}
