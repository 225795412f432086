//! `lab accuracy`: run time against error, for every triangle test with every box test.

mod leaks;
mod pairs;
mod rows;
mod secondary;
mod sets;
mod stages;
mod tables;
mod timing;
mod total;

use std::ops::Range;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde_json::json;
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::trace::Truth;
use stackless_check::Shard;

use crate::input::Scene;
use crate::judge::{Counts, Query, Truths, chosen};
use crate::output::{bar, write_file};
use crate::places::{self, Output};
use crate::record::{self, Numbered, Run, add_rows, fingerprint};
use crate::{Outcome, camera};
use pairs::{Pair, Trees};
use rows::Row;
use sets::{Set, sets};
use stages::Stages;
pub(crate) use total::{Found, SecondaryFound};

/// Measure run time against error, for every triangle test with every box test.
///
/// Times are of one thread over one tree, in one run. A ratio is the median over chunks of rays: a pair's time, divided
/// by that of `moller-32` with `plain` boxes. Errors are judged by rational arithmetic. Ordinary rays are camera rays
/// and rays from their hits; adversarial rays are aimed at edges, corners and planes. Both kinds are timed. The exit
/// code is 1 if an exact test with `directed` boxes errs.
///
/// With --shard, all rays are judged and none are timed. The record then has counts of errors and the greatest error of
/// a distance, which add up. Times, means and quantiles need a whole run on one machine.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    lab accuracy examples/data/slivers.ply spheres --plot accuracy.svg --json accuracy.json\n  \
    lab accuracy soup --secondary --count 10000\n  \
    lab accuracy soup --count 1000000 --shard 3/64 --json 3.json")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj, .stl, .gltf, .glb), the generated scenes `strands`, `stadium`, `soup`, or `spheres`:
    /// closed meshes, only for leaks.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Draw time against error, as SVG.
    #[arg(long, value_name = "FILE", value_parser = places::file_as("svg"))]
    plot: Option<Output>,
    /// Write all counts to this file, a record for `lab merge`.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
    /// Number of timed rays of each kind. Up to 20,000 of them are judged. Below 65,536, `spheres` has fewer rays, too.
    #[arg(long, default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    /// Number of rounds. The least time of each chunk counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Measure the errors of rays from surfaces instead, by their start points. Trace --count camera rays, and a ray of
    /// ambient occlusion from each hit. Rational arithmetic judges all answers.
    #[arg(long, conflicts_with_all = ["plot", "rounds"])]
    secondary: bool,
    /// Run only part I of N, and only count errors. `lab merge` adds them up.
    #[arg(long, value_name = "I/N", conflicts_with_all = ["plot", "rounds", "picture"])]
    shard: Option<Shard>,
    /// Draw the pixels with wrong rays, as PNG.
    #[arg(long, value_name = "FILE", requires = "secondary", value_parser = places::file_as("png"))]
    picture: Option<Output>,
}

/// Maximum number of judged rays of a kind.
const JUDGED: u64 = 20_000;

/// The name of the spheres, as a scene.
const SPHERES: &str = "spheres";

/// Number of rays of a part that are generated and judged at once.
const AT_ONCE: u64 = 1 << 16;

pub(crate) fn run(args: &Args) -> Outcome {
    let (spheres, scenes): (Vec<&PathBuf>, Vec<_>) = args.scenes.iter().partition(|path| *path == Path::new(SPHERES));
    let scenes = scenes.into_iter().map(|path| Scene::load(path)).collect::<Result<Vec<_>, _>>()?;
    if args.secondary {
        if !spheres.is_empty() {
            return Err(format!("--secondary: {SPHERES} has no camera, expected other scenes").into());
        }
        if args.picture.is_some() && scenes.len() > 1 {
            return Err("--picture: expected one scene".into());
        }
        return secondary::run(args, &scenes);
    }
    if args.plot.is_some() && scenes.is_empty() {
        return Err(format!("--plot: {SPHERES} is not timed, expected another scene").into());
    }
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let mut run = args.asked::<Found>(&scenes);
    let mut found = Found::default();
    if !scenes.is_empty() {
        let numbers = run.take(shard, "rays of each kind", args.count.into());
        found = measure(args, &scenes, numbers)?;
    }
    if !spheres.is_empty() {
        let share = f64::from(args.count.min(1 << 16)) / f64::from(1 << 16);
        let mut part = |sphere: &str, of: u64| run.take(shard, sphere, of);
        found.rows.extend(leaks::count(&Pair::all(), share, &mut part)?);
    }
    run.refuse_empty(shard)?;
    let svg = args.plot.as_ref().map(|path| (path, found.plot()));
    let is_right = run.finish(found, args.json.as_deref())?;
    if let Some((path, text)) = svg {
        write_file(path, |file| file.write_all(text.as_bytes()))?;
    }
    Ok(is_right)
}

impl Args {
    /// The number of judged rays of `of` rays. A part judges all rays.
    fn judged(&self, of: u64) -> u64 {
        if self.shard.is_some() { of } else { of.min(JUDGED) }
    }

    /// The options that determine the counts.
    fn asked<C: record::Counts>(&self, scenes: &[Scene]) -> Run {
        Run::of::<C>([
            ("rays", self.count.into()),
            ("judged", if self.secondary { self.count.into() } else { self.judged(self.count.into()).into() }),
            ("seed", self.seed.into()),
            ("names", json!(scenes.iter().map(|scene| &scene.name).collect::<Vec<_>>())),
            ("views", json!(scenes.iter().map(|scene| camera::numbers(&self.place.of(scene))).collect::<Vec<_>>())),
            ("scenes", scenes.iter().map(|scene| fingerprint(&scene.mesh)).collect()),
            ("spheres", (scenes.len() < self.scenes.len()).into()),
        ])
    }
}

/// Measures the rays with these numbers in all scenes.
fn measure(args: &Args, scenes: &[Scene], numbers: Range<u64>) -> Result<Found, Box<dyn std::error::Error>> {
    let (pairs, mut found) = (Pair::all(), Found::default());
    for scene in scenes {
        measure_scene(scene, &pairs, args, numbers.clone(), &mut found)?;
    }
    Ok(found)
}

fn measure_scene(
    scene: &Scene,
    pairs: &[Pair],
    args: &Args,
    numbers: Range<u64>,
    found: &mut Found,
) -> Result<(), Box<dyn std::error::Error>> {
    let trees = Trees::new(&scene.mesh)?;
    let truth = Truth::new(&scene.mesh);
    let aimed = args.judged(args.count.into());
    if args.shard.is_none() {
        for set in sets(scene, &args.place.of(scene), &trees, args.seed, numbers, args.count.into(), aimed) {
            if set.rays.is_empty() {
                found.notes.push(format!("{}, {}: no rays", scene.name, set.name));
                continue;
            }
            let rows = judge(scene, &trees, &truth, pairs, &set, JUDGED as usize);
            let name = format!("{}, {}", scene.name, set.name);
            let times = timing::measure(pairs, &trees, set.query, &set.rays, args.rounds as usize, &name);
            if set.query == Query::Closest {
                found.stages.push(Stages::count(&scene.name, set.name, trees.by_area(), &set.rays));
            }
            found.rows.extend(rows.into_iter().zip(&times).map(|(row, time)| row.timed(time)));
        }
        return Ok(());
    }
    let mut sum = Vec::new();
    for start in numbers.clone().step_by(AT_ONCE as usize) {
        let some = start..numbers.end.min(start + AT_ONCE);
        let sets = sets(scene, &args.place.of(scene), &trees, args.seed, some, args.count.into(), aimed);
        let rows = sets.iter().flat_map(|set| judge(scene, &trees, &truth, pairs, set, set.rays.len()));
        add_rows(&mut sum, rows.map(Row::counts_alone).collect(), Row::is_same, Row::add);
    }
    found.rows.extend(sum);
    Ok(())
}

/// Judges each pair on at most `most` rays of a set.
fn judge(scene: &Scene, trees: &Trees, truth: &Truth, pairs: &[Pair], set: &Set, most: usize) -> Vec<Row> {
    let name = format!("{}, {}", scene.name, set.name);
    let truths = Truths::new(truth, &set.rays, most, &name);
    let counts = errors(&truths, trees, pairs, set.query, &name);
    let row = |(pair, counts): (&Pair, Counts)| {
        let offence = counts.offence.as_ref().filter(|_| pair.is_exact()).map(|(i, what)| {
            let found = format!("{name}: {} with {}: {what}", pair.kernel, pair.slabs);
            Numbered { number: set.numbers[chosen(*i, truths.rays().len(), set.rays.len())], found }
        });
        Row { offence, ..Row::new(&scene.name, set.name, set.kind, pair).judged(&counts) }
    };
    pairs.iter().zip(counts).map(row).collect()
}

/// The errors of each pair.
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
