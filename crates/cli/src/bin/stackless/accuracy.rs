//! `stackless accuracy`: run time against error.

mod leaks;
mod pairs;
mod rows;
mod secondary;
mod stages;
mod tables;
mod timing;

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::geom::Ray;
use stackless_bvh::trace::{self, Truth};

use crate::Outcome;
use crate::input::Scene;
use crate::judge::{Counts, Query, Truths};
use crate::output::{self, Block, bar, say, write_file, write_json};
use crate::places::{self, Output};
use pairs::{Pair, Trees};
use rows::{Kind, Row};
use stages::Stages;

/// Measure run time against error, for every triangle test with every box test.
///
/// Times are of one thread, over one tree, in one run: a ratio is the median over chunks of rays of a pair's time to
/// that of `moller-32` with `plain` boxes. Errors are told by rational arithmetic, on ordinary rays (a camera's, and
/// from where those hit) and on rays that are aimed at edges, corners and planes. The exit code is 1 if an exact test
/// with `directed` boxes errs at all.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless accuracy bunny.ply spheres --plot accuracy.svg --csv accuracy.csv\n  \
    stackless accuracy soup --secondary --rays 10000")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj), the made scenes `strands`, `stadium`, `soup`, or `spheres`: closed ones, only for
    /// leaks.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Draw time against error, as SVG.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    plot: Option<Output>,
    /// Write all counts to this file, a line for each scene, kind of rays and pair of tests.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    csv: Option<Output>,
    /// The same as JSON.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    json: Option<Output>,
    /// Rays of each kind: so many are timed, and up to 20,000 of them judged. Below 65,536 `spheres` has fewer too.
    #[arg(long, default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    rays: u32,
    /// How often all rays are timed; of a chunk's times the least counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Measure instead what rays from surfaces get wrong, by where they begin. So many camera rays are traced, and from
    /// each hit a ray of ambient occlusion. All answers are judged by rational arithmetic.
    #[arg(long, conflicts_with_all = ["plot", "csv", "rounds"])]
    secondary: bool,
    /// Draw which of these are wrong, as PNG.
    #[arg(long, value_name = "FILE", requires = "secondary", value_parser = places::file)]
    picture: Option<Output>,
}

/// Rays of a kind that are judged.
const JUDGED: usize = 20_000;

/// The name of the scene that is several.
const SPHERES: &str = "spheres";

/// Rays of one kind, for one kind of query.
struct Set {
    name: &'static str,
    kind: Kind,
    query: Query,
    rays: Vec<Ray>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let (spheres, scenes): (Vec<&PathBuf>, Vec<_>) = args.scenes.iter().partition(|path| *path == Path::new(SPHERES));
    let scenes = scenes.into_iter().map(|path| Scene::load(path)).collect::<Result<Vec<_>, _>>()?;
    if args.secondary {
        if !spheres.is_empty() {
            return Err(format!("--secondary needs scenes with a camera, and {SPHERES} has none").into());
        }
        if args.picture.is_some() && scenes.len() > 1 {
            return Err("--picture shows one scene, and several are named".into());
        }
        return secondary::run(args, &scenes);
    }
    if args.plot.is_some() && scenes.is_empty() {
        return Err(format!("--plot needs a scene that is timed, and {SPHERES} is not").into());
    }
    let mut found = measure(args, &scenes)?;
    if !spheres.is_empty() {
        let share = f64::from(args.rays.min(1 << 16)) / f64::from(1 << 16);
        found.rows.extend(leaks::count(&Pair::all(), share, &mut found.offences)?);
    }
    output::print(&found.blocks());
    let Found { rows, offences, .. } = &found;
    for offence in offences {
        say!("{offence}");
    }
    if let Some(path) = &args.csv {
        let csv = rows::csv(rows);
        write_file(path, |file| file.write_all(csv.as_bytes()))?;
    }
    if let Some(path) = &args.json {
        write_json(path, rows)?;
    }
    if let Some(path) = &args.plot {
        let svg = found.plot()?;
        write_file(path, |file| file.write_all(svg.as_bytes()))?;
    }
    Ok(offences.is_empty())
}

/// What was measured.
#[derive(Default)]
pub(crate) struct Found {
    rows: Vec<Row>,
    stages: Vec<Stages>,
    /// Sets without rays.
    notes: Vec<String>,
    /// Errors of pairs that promise none, in words.
    pub(crate) offences: Vec<String>,
}

impl Found {
    pub(crate) fn blocks(&self) -> Vec<Block> {
        let notes = self.notes.iter().cloned().map(Block::Line);
        notes.chain(tables::blocks(&self.rows, &self.stages)).collect()
    }

    /// Time against error, as SVG.
    pub(crate) fn plot(&self) -> Result<String, String> {
        tables::plot(&self.rows)
    }
}

impl Args {
    /// So many rays of each kind.
    pub(crate) fn of(rays: u32, rounds: u32, seed: u64) -> Self {
        let (scenes, none) = (Vec::new(), None);
        Self {
            scenes,
            plot: none.clone(),
            csv: none.clone(),
            json: none.clone(),
            picture: none,
            secondary: false,
            rays,
            rounds,
            seed,
        }
    }
}

/// Measures all scenes.
pub(crate) fn measure(args: &Args, scenes: &[Scene]) -> Result<Found, Box<dyn std::error::Error>> {
    let (pairs, mut found) = (Pair::all(), Found::default());
    for scene in scenes {
        measure_scene(scene, &pairs, args, &mut found)?;
    }
    Ok(found)
}

fn measure_scene(
    scene: &Scene,
    pairs: &[Pair],
    args: &Args,
    found: &mut Found,
) -> Result<(), Box<dyn std::error::Error>> {
    let Found { rows, stages, notes, offences } = found;
    let trees = Trees::new(&scene.mesh)?;
    let truth = Truth::new(&scene.mesh);
    for set in sets(scene, &trees, args) {
        if set.rays.is_empty() {
            notes.push(format!("{}, {}: no rays", scene.name, set.name));
            continue;
        }
        let name = format!("{}, {}", scene.name, set.name);
        let truths = Truths::new(&truth, &set.rays, JUDGED, &name);
        let counts = errors(&truths, &trees, pairs, set.query, &name);
        // Rays that are made to be hard come in an order that nobody traces them in, so they are not timed.
        let times = match set.kind {
            Kind::Ordinary => timing::measure(pairs, &trees, set.query, &set.rays, args.rounds as usize, &name),
            Kind::Adversarial | Kind::Closed => Vec::new(),
        };
        if set.query == Query::Closest {
            stages.push(Stages::count(&scene.name, set.name, trees.by_area(), &set.rays));
        }
        for (i, (pair, counts)) in pairs.iter().zip(counts).enumerate() {
            if let Some(what) = counts.offence.as_ref().filter(|_| pair.is_exact()) {
                offences.push(format!("{name}: {} with {}: {what}", pair.kernel, pair.slabs));
            }
            rows.push(Row::new(&scene.name, set.name, set.kind, pair).judged(&counts).timed(times.get(i)));
        }
    }
    Ok(())
}

/// What each pair gets wrong.
fn errors(truths: &Truths, trees: &Trees, pairs: &[Pair], query: Query, name: &str) -> Vec<Counts> {
    let progress = bar(pairs.len() as u64, &format!("{name}, errors"));
    let counts = pairs.iter().map(|pair| {
        let ask = |memory: &mut Vec<_>, ray: &Ray| pair.answers(query, trees, ray, memory);
        let answers: Vec<_> = truths.rays().par_iter().with_min_len(256).map_init(Vec::new, ask).collect();
        progress.inc(1);
        truths.counts(query, &answers)
    });
    let counts = counts.collect();
    progress.finish_and_clear();
    counts
}

fn sets(scene: &Scene, trees: &Trees, args: &Args) -> [Set; 5] {
    let n = args.rays as usize;
    let primary = procedural::view(&scene.name, &scene.mesh).rays(n);
    let progress = bar(1, &format!("{}, bounce", scene.name));
    let diffuse = trace::bounce(&scene.mesh, trees.by_area(), &primary, args.seed);
    progress.finish_and_clear();
    let aimed = stress::aimed(&scene.mesh, args.seed, n.min(JUDGED));
    let set = |name, kind, query, rays: &Vec<Ray>| Set { name, kind, query, rays: rays.clone() };
    [
        set("primary", Kind::Ordinary, Query::Closest, &primary),
        set("any", Kind::Ordinary, Query::Any, &diffuse),
        set("diffuse", Kind::Ordinary, Query::Closest, &diffuse),
        set("aimed", Kind::Adversarial, Query::Closest, &aimed),
        set("aimed-any", Kind::Adversarial, Query::Any, &aimed),
    ]
}
