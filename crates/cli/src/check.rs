//! `stackless check`: compares every traversal with the oracle.

mod scenes;
mod summary;

use std::path::{Path, PathBuf};

use serde_json::json;
use stackless_bvh::generate::Family;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{
    AllCases, CaseOptions, Disagreement, PauseTally, Plan, Replay, Shard, Tally, boundary_cases, check_cases,
    check_numbered, check_pauses, check_random, merge,
};

use crate::Outcome;
use crate::input;
use crate::output::bar;
use crate::places::{self, Output};
use crate::record::Run;
use scenes::{Scenes, Shift};
use summary::SceneFault;
pub(crate) use summary::Summary;

/// Compare every traversal with the oracle.
///
/// Without SCENE, check random and boundary trees, and three generated scenes. With SCENE, check rays through each
/// scene. The exit code is 0 if all traversals agree, 1 on any disagreement, 2 if the check could not run.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless check\n  \
    stackless check examples/data/torus.ply --trees 1000\n  \
    stackless check --leaves 7\n  \
    stackless check soup --double --method uncle,afra\n  \
    stackless check --shard 3/64 --json 3.json\n  \
    stackless check --replay case.json")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj, .stl, .gltf, .glb), or the generated scenes `strands`, `stadium`, `soup`.
    scenes: Vec<PathBuf>,
    /// Number of random trees. [default: 200000, or 0 with SCENE]
    #[arg(long)]
    trees: Option<u64>,
    /// Check every tree of up to this number of leaves under all decisions, instead of random trees: 6 leaves are
    /// 25,897 cases, 9 are 28 million.
    #[arg(long, conflicts_with_all = ["scenes", "trees", "seed"])]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(AllCases::LEAVES)))]
    leaves: Option<u32>,
    /// Seed of trees, tapes and rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Check only these traversals of binary trees, separated by commas (`stackless methods` lists them). [default:
    /// all]
    #[arg(long, value_delimiter = ',', value_parser = input::method(), hide_possible_values = true)]
    method: Vec<Method>,
    /// Number of rays through each scene.
    #[arg(long, default_value_t = 4000, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    /// Read scenes in double precision, and check rays in double precision. Half of the rays are aimed at corners and
    /// at middles of edges.
    #[arg(long, conflicts_with = "replay")]
    double: bool,
    /// Run only part I of N. `stackless merge` adds up the counts.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE, hide_default_value = true)]
    shard: Shard,
    /// Write the counts to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
    /// Run only the case in this file. A failing check prints its smallest case in this format.
    #[arg(long, conflicts_with_all = ["scenes", "trees", "leaves", "shard"])]
    replay: Option<PathBuf>,
}

/// Options of `lab check` only.
#[derive(Default, clap::Args)]
pub(crate) struct Extra {
    /// Check only trees of this family.
    #[arg(long, value_parser = input::names(Family::ALL, Family::name), conflicts_with_all = ["leaves", "replay"])]
    family: Option<Family>,
    /// Depth of the trees, in edges: exact for combs, the maximum for other trees.
    #[arg(long, value_parser = clap::value_parser!(u32).range(..=10_000_000), conflicts_with_all = ["leaves", "replay"])]
    depth: Option<u32>,
    /// Check only this word.
    #[arg(long, value_parser = input::names(WordName::ALL, WordName::name))]
    word: Option<WordName>,
    /// Translate each scene by this vector first.
    #[arg(long, value_name = "X,Y,Z", requires = "double", allow_hyphen_values = true)]
    moved: Option<Shift>,
}

#[derive(Default)]
struct Total {
    trees: u64,
    rays: u64,
    tally: Tally,
    found: Option<Disagreement>,
    pauses: PauseTally,
    scenes: Vec<SceneFault>,
}

/// Number of random trees, of the small ones, on which traversals are paused at every step.
const PAUSED_TREES: u64 = 400;

pub(crate) fn run(args: &Args, extra: &Extra) -> Outcome {
    let shift = extra.moved.unwrap_or_default();
    let scenes = Scenes::load(&args.scenes, args.double, shift)?;
    let methods = if args.method.is_empty() { Method::ALL.to_vec() } else { args.method.clone() };
    let words = extra.word.map_or_else(|| WordName::ALL.to_vec(), |word| vec![word]);
    let options = CaseOptions { family: extra.family, depth: extra.depth };
    let mut plan = Plan { trees: 0, seed: args.seed, options, methods, words };
    if let Some(path) = &args.replay {
        return replay(args, extra, plan, path);
    }
    let abstract_only =
        extra.family.is_some() || extra.depth.is_some() || args.trees.is_some() || args.leaves.is_some();
    plan.trees = args.trees.unwrap_or(if scenes.is_empty() && args.leaves.is_none() { 200_000 } else { 0 });
    if plan.trees == 0 && (extra.family.is_some() || extra.depth.is_some()) {
        return Err("--family and --depth select random trees: expected --trees N".into());
    }
    let want_made = scenes.is_empty() && (args.double || !abstract_only);
    let scenes = if want_made { Scenes::made(args.double, shift)? } else { scenes };
    let (mut total, mut run) = (Total::default(), asked(args, &plan, &scenes));
    if let Some(leaves) = args.leaves {
        check_all(&plan, args.shard, leaves, &mut run, &mut total);
    }
    if plan.trees > 0 {
        check_trees(&plan, args.shard, abstract_only, &mut run, &mut total);
    }
    scenes.check(&plan, args.count.into(), args.shard, &mut run, &mut total)?;
    run.refuse_empty(args.shard)?;
    finish(args, &plan, run, &total)
}

/// Runs the case in a file.
fn replay(args: &Args, extra: &Extra, mut plan: Plan, path: &Path) -> Outcome {
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let replay = Replay::load(path).map_err(|error| named(&error))?;
    if args.method.is_empty() {
        plan.methods = replay.methods().map_err(|error| named(&error))?;
    }
    if extra.word.is_none() {
        plan.words = replay.words().map_err(|error| named(&error))?;
    }
    let case = replay.case().map_err(|error| named(&error))?;
    let mut total = Total { trees: 1, ..Total::default() };
    total.found = plan.check_case(&case, &mut total.tally);
    let mut run = Run::of::<Summary>([("replay", json!(replay))]);
    run.take(Shard::WHOLE, "trees", 1);
    finish(args, &plan, run, &total)
}

fn asked(args: &Args, plan: &Plan, scenes: &Scenes) -> Run {
    Run::of::<Summary>([
        ("trees", plan.trees.into()),
        ("leaves", args.leaves.into()),
        ("seed", plan.seed.into()),
        ("family", plan.options.family.map(Family::name).into()),
        ("depth", plan.options.depth.into()),
        ("methods", plan.methods.iter().map(|method| method.name()).collect()),
        ("words", plan.words.iter().map(|word| word.name()).collect()),
        ("rays", args.count.into()),
        ("double", args.double.into()),
        ("scenes", scenes.fingerprints().into()),
    ])
}

fn finish(args: &Args, plan: &Plan, run: Run, total: &Total) -> Outcome {
    // A part of a run may have no comparisons. `merge` then checks the sum.
    let is_whole = args.shard == Shard::WHOLE;
    if total.tally.comparisons() == 0 && is_whole {
        let refusal = plan.pairs().into_iter().find_map(|(method, word)| {
            total.tally.get(method, word).refusal.map(|refusal| format!("{method}: {refusal}"))
        });
        return Err(refusal.unwrap_or_else(|| "no case was checked".to_owned()).into());
    }
    run.finish(Summary::new(plan, total), args.json.as_deref())
}

/// Checks every small tree under all decisions.
fn check_all(plan: &Plan, shard: Shard, leaves: u32, run: &mut Run, total: &mut Total) {
    let all = AllCases::up_to(leaves);
    let numbers = run.take(shard, "cases", all.count());
    let count = numbers.end - numbers.start;
    let progress = bar(count, "cases");
    (total.tally, total.found) = check_numbered(plan, numbers, &|number| all.case(number), &|done| progress.inc(done));
    progress.finish_and_clear();
    total.trees += count;
}

/// Checks the random trees. Unless the user selects random trees, also checks the trees at the maximum depth of each
/// word.
fn check_trees(plan: &Plan, shard: Shard, random_only: bool, run: &mut Run, total: &mut Total) {
    let numbers = run.take(shard, "trees", plan.trees);
    let progress = bar(numbers.end - numbers.start, "trees");
    let mut result = check_random(plan, numbers.clone(), &|done| progress.inc(done));
    progress.finish_and_clear();
    total.trees += numbers.end - numbers.start;
    if !random_only {
        let boundary = boundary_cases(plan.seed).count() as u64;
        let numbers = run.take(shard, "trees at limits", boundary);
        // Their numbers follow those of the random trees.
        let cases = (plan.trees..).zip(boundary_cases(plan.seed));
        let cases = cases.skip(numbers.start as usize).take((numbers.end - numbers.start) as usize);
        result = merge(result, check_cases(plan, cases));
        total.trees += numbers.end - numbers.start;
    }
    (total.tally, total.found) = result;
    let numbers = run.take(shard, "trees, putting aside", PAUSED_TREES.min(plan.trees));
    let progress = bar(numbers.end - numbers.start, "trees, putting aside");
    total.pauses = check_pauses(plan, numbers, &|done| progress.inc(done));
    progress.finish_and_clear();
}
