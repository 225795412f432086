//! `lab parts`: the cost of the parts of a ray's time, and the savings of omitting a part.

mod plan;
mod state;
mod time;

use std::path::PathBuf;
use std::slice::from_ref;

use serde_json::json;
use stackless_bvh::bvh::Builder;
use stackless_bvh::internals::trace::bounce;

use crate::build;
use crate::input::Scene;
use crate::output::say;
use crate::places::{self, Output};
use crate::record::write_figures;
use crate::{Outcome, camera, savings};

/// Measure the parts of a ray's time, the savings of a query plan, and the benefits of a small state.
///
/// The first table has the times of finding the next node, of box tests and of triangle tests alone. The second has the
/// decisions of the plan of a binary hierarchy, with the time and the bytes that each saves. The third has the nodes that
/// a traversal visits with pruning, continuing after a hit, or starting at the last hit.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  lab parts examples/data/room.obj")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Builder of the hierarchy.
    #[arg(long, default_value_t, value_parser = build::builder())]
    build: Builder,
    /// Number of camera rays.
    #[arg(long, default_value_t = 16_384, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let scene = Scene::load(&args.scene)?;
    let bvh = build::binary(args.build, &scene)?;
    let primary = args.place.of(&scene).rays(args.count as usize);
    let time = time::measure(&bvh, &bounce(&scene.mesh, &bvh, &primary, args.seed))?;
    let plan = plan::measure(&scene.mesh, &bvh, &primary)?;
    let state = state::measure(&scene.mesh, &bvh, &primary, args.seed)?;
    say!("{}", time::to_table(&time));
    say!("{}", savings::to_table(&plan));
    say!("{}", state::to_table(&state));
    if let Some(path) = &args.json {
        write_figures(path, "parts", from_ref(&scene), json!({ "time": time, "plan": plan, "state": state }))?;
    }
    Ok(true)
}
