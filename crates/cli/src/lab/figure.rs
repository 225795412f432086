//! `lab figure`: figures of Binder & Keller 2016, for any scene.

use std::path::PathBuf;

use stackless_bvh::bvh::Builder;
use stackless_bvh::traverse::Method;

use crate::Outcome;
use crate::camera;
use crate::input::Scene;
use crate::places::{self, Output};
use crate::render::{Heat, Job, Rays};

/// Draw a figure of Binder & Keller 2016 for a scene, as a PNG file.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  lab figure 1 examples/data/slivers.ply -o figure1.png")]
pub(crate) struct Args {
    #[arg(value_enum)]
    figure: Figure,
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Write the picture to this .png file; `-` is the standard output.
    #[arg(short, long, value_name = "FILE", value_parser = places::file_as("png"))]
    output: Output,
    #[command(flatten)]
    camera: camera::Options,
    /// Samples of each pixel. [default: 1, for figure 8 16]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    spp: Option<u32>,
    /// Builder of the hierarchy.
    #[arg(long)]
    build: Option<Builder>,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Figure {
    /// Backtracking steps of three schemes.
    #[value(name = "1")]
    Schemes,
    /// Visited postponed nodes, without and with pruning.
    #[value(name = "7")]
    Pruning,
    /// Nodes that diffuse rays visit, from the root and from the last hit.
    #[value(name = "8")]
    Continuing,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let scene = Scene::load(&args.scene)?;
    let (rays, heat, methods) = match args.figure {
        Figure::Schemes => (Rays::Primary, Heat::Backtrack, vec![Method::Afra, Method::Uncle, Method::Hashed]),
        Figure::Pruning => (Rays::Primary, Heat::Postponed, vec![Method::Hashed, Method::HashedDisjoint]),
        Figure::Continuing => (Rays::Diffuse, Heat::Nodes, vec![Method::Hashed]),
    };
    let job = Job::new(rays, Some(heat), args.camera.of(&scene), args.seed);
    let (spp, continues) = (args.spp.unwrap_or(job.spp), args.figure == Figure::Continuing);
    let job = Job { spp, methods, continues, ..job };
    job.run(&scene, args.build, &args.output)
}
