//! `stackless check`: every traversal against the oracle.

use std::collections::HashSet;
use std::path::PathBuf;

use serde::Serialize;
use stackless_bvh::generate::{Family, procedural};
use stackless_bvh::trace::Truth;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{
    Battery, CaseOptions, Disagreement, PauseFault, Plan, Replay, SceneDisagreement, SceneTree, Tally, Verdict,
    boundary_cases, check_cases, check_pauses, check_random, check_scene, merge, shrink,
};

use crate::Outcome;
use crate::build::Build;
use crate::input::{self, MADE, Scene};
use crate::output::{bar, grouped, say, table, write_json};
use crate::places::{self, Output};

/// Compare every traversal with the oracle.
///
/// Without SCENE: random and boundary trees, and three made scenes. With SCENE: rays through each. The exit code is 0
/// if all agree, 1 on any disagreement, 2 if the check could not run.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless check\n  \
    stackless check bunny.ply --trees 1000\n  \
    stackless check --family comb --depth 100000 --trees 1 --word grow --methods hashed,afra\n  \
    stackless check --replay case.json")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj), or the made scenes `strands`, `stadium`, `soup`.
    scenes: Vec<PathBuf>,
    /// Number of random trees [default: 200000, or 0 with SCENE].
    #[arg(long)]
    trees: Option<u64>,
    /// Only trees of this family: catalan, skew, complete, comb, caterpillar, fibonacci.
    #[arg(long, value_parser = |name: &str| name.parse::<Family>().map_err(|_| families()))]
    family: Option<Family>,
    /// Depth of the trees in edges: combs are that deep, others at most.
    #[arg(long, value_parser = clap::value_parser!(u32).range(..=10_000_000))]
    depth: Option<u32>,
    /// Seed of trees, tapes and rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only these traversals, separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = input::MethodName)]
    methods: Vec<Method>,
    /// Only this word: u32, u64, u128, grow.
    #[arg(long, value_parser = input::word)]
    word: Option<WordName>,
    /// Rays through each scene.
    #[arg(long, default_value_t = 4000, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    rays: u32,
    /// Write the counts to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    json: Option<Output>,
    /// Run the case in this file and nothing else. A disagreement on a tree is printed as such a file.
    #[arg(long, conflicts_with_all = ["scenes", "trees", "family", "depth"])]
    replay: Option<PathBuf>,
}

fn families() -> String {
    format!("expected one of: {}", Family::ALL.map(Family::name).join(", "))
}

/// All that is counted.
#[derive(Default)]
struct Total {
    trees: u64,
    rays: u64,
    tally: Tally,
    /// How often a traversal was put aside and taken up again, and what went wrong then.
    resumes: u64,
    pause_fault: Option<Box<PauseFault>>,
}

/// Random trees, if they are small, on which traversals are put aside at every step.
const PAUSED_TREES: u64 = 400;

pub(crate) fn run(args: Args) -> Outcome {
    let scenes = input::scenes(&args.scenes)?;
    let methods = if args.methods.is_empty() { Method::ALL.to_vec() } else { args.methods.clone() };
    let words = args.word.map_or_else(|| WordName::ALL.to_vec(), |word| vec![word]);
    let options = CaseOptions { family: args.family, depth: args.depth };
    let mut plan = Plan { trees: 0, seed: args.seed, options, methods, words };
    let mut total = Total::default();
    if let Some(path) = &args.replay {
        let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let replay = Replay::load(path).map_err(|error| named(&error))?;
        if args.methods.is_empty() {
            plan.methods = replay.methods().map_err(|error| named(&error))?;
        }
        if args.word.is_none() {
            plan.words = replay.words().map_err(|error| named(&error))?;
        }
        let case = replay.case().map_err(|error| named(&error))?;
        total.trees = 1;
        let found = plan.check_case(&case, &mut total.tally);
        return finish(&args, &plan, total, found.as_ref());
    }
    let abstract_only = args.family.is_some() || args.depth.is_some() || args.trees.is_some();
    plan.trees = args.trees.unwrap_or(if scenes.is_empty() { 200_000 } else { 0 });
    if plan.trees == 0 && (args.family.is_some() || args.depth.is_some()) {
        return Err(
            "--family and --depth are of random trees, and none would be checked: expected --trees N too".into()
        );
    }
    let mut found = None;
    if plan.trees > 0 {
        found = check_trees(&plan, abstract_only, &mut total);
        let progress = bar(PAUSED_TREES.min(plan.trees), "trees, putting aside");
        (total.resumes, total.pause_fault) = check_pauses(&plan, PAUSED_TREES, &|done| progress.inc(done));
        progress.finish_and_clear();
    }
    let made = || MADE.iter().map(|name| Scene::load(name.as_ref())).collect::<Result<Vec<_>, _>>();
    let scenes = if scenes.is_empty() && !abstract_only { made()? } else { scenes };
    for scene in &scenes {
        check_one_scene(&plan, scene, args.rays as usize, &mut total)?;
    }
    finish(&args, &plan, total, found.as_ref())
}

/// The random trees and, unless the user has asked for some of his own, those at the depths where words end.
fn check_trees(plan: &Plan, random_only: bool, total: &mut Total) -> Option<Disagreement> {
    let progress = bar(plan.trees, "trees");
    let result = check_random(plan, &|done| progress.inc(done));
    progress.finish_and_clear();
    total.trees += plan.trees;
    let (tally, found) = if random_only {
        result
    } else {
        total.trees += boundary_cases(plan.seed).count() as u64;
        merge(result, check_cases(plan, boundary_cases(plan.seed)))
    };
    total.tally = std::mem::take(&mut total.tally).merge(&tally);
    found
}

/// Rays through the scene under a tree by surface area, a complete one by medians, and one with triangles in parts.
fn check_one_scene(
    plan: &Plan,
    scene: &Scene,
    count: usize,
    total: &mut Total,
) -> Result<(), Box<dyn std::error::Error>> {
    let truth = Truth::new(&scene.mesh);
    let rays = procedural::rays(&scene.mesh, plan.seed, count);
    for build in Build::CHECKED {
        let bvh = &build.run(scene)?;
        let progress = bar(rays.len() as u64, &scene.name);
        let tree = SceneTree::new(&truth, bvh);
        let (tally, found) = check_scene(plan, &tree, &rays, &|done| progress.inc(done));
        progress.finish_and_clear();
        if let Some(found) = found {
            print_scene(&scene.name, build, &found);
        }
        total.tally = std::mem::take(&mut total.tally).merge(&tally);
        total.trees += 1;
        total.rays += rays.len() as u64;
    }
    Ok(())
}

fn print_scene(scene: &str, tree: Build, found: &SceneDisagreement) {
    let SceneDisagreement { ray, any, method, expected, found } = found;
    let who = method.map_or_else(|| "the oracle".to_owned(), |(method, word)| format!("{method} {word}"));
    let query = if *any { "any hit" } else { "closest hit" };
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin().to_array(), ray.direction().to_array());
    say!("{scene}, {tree} tree, {query}: {who} differs for the ray");
    say!("  {ox:?},{oy:?},{oz:?},{dx:?},{dy:?},{dz:?},{:?},{:?}", ray.tmin(), ray.tmax());
    say!("  expected {expected:?}");
    say!("  found    {found:?}");
}

/// Prints the table, the smallest disagreement and the closing line.
fn finish(args: &Args, plan: &Plan, total: Total, found: Option<&Disagreement>) -> Outcome {
    // The state is given for the depth asked for; of trees of many depths, for the depth that a u32 carries.
    let depth = total.tally.depth.min(plan.options.depth.unwrap_or(31));
    let rows =
        plan.pairs().into_iter().map(|(method, word)| Row::of(method, word, &total.tally, depth)).collect::<Vec<_>>();
    if total.tally.comparisons() == 0 {
        let refusal = plan.pairs().into_iter().find_map(|(method, word)| {
            total.tally.get(method, word).refusal.map(|refusal| format!("{method}: {refusal}"))
        });
        return Err(refusal.unwrap_or_else(|| "there is nothing to check".to_owned()).into());
    }
    let header = ["method", "word", "cases", "agree", "refused", "steps", "state bytes"];
    say!("{}", table(&header, 2, rows.iter().map(Row::cells).collect()));
    say!("state bytes: for one ray in a tree {depth} edges deep");
    let refused: Vec<_> = rows.iter().filter_map(|row| row.refusal.as_ref().map(|why| (row, why))).collect();
    if let Some((row, why)) = refused.first() {
        say!("refused before the first step, e.g. {} {}: {why}", row.method, row.word);
    }
    if let Some(found) = found {
        print_disagreement(found);
    }
    if total.resumes > 0 {
        say!("put aside and taken up again: {} times", grouped(total.resumes));
    }
    if let Some(fault) = &total.pause_fault {
        say!("{fault}");
    }
    let disagreements = total.tally.disagreements() + u64::from(total.pause_fault.is_some());
    let summary = Summary {
        trees: total.trees,
        rays: total.rays,
        methods: plan.pairs().into_iter().map(|(method, _)| method).collect::<HashSet<_>>().len(),
        disagreements,
        resumes: total.resumes,
        rows,
        smallest: found.map(smallest),
    };
    say!(
        "checked: {} trees, {} rays, {} methods, {disagreements} disagreements",
        summary.trees,
        summary.rays,
        summary.methods
    );
    if let Some(path) = &args.json {
        write_json(path, &summary)?;
    }
    Ok(disagreements == 0)
}

fn print_disagreement(found: &Disagreement) {
    let replay = smallest(found);
    say!("{} {}: {}", found.method, found.word, replay.fault.as_deref().unwrap_or_default());
    say!("smallest case, for `stackless check --replay FILE`:");
    say!("{}", serde_json::to_string(&replay).unwrap_or_default());
}

/// The case made small, in the form of a file.
fn smallest(found: &Disagreement) -> Replay {
    let &Disagreement { method, word, fault, .. } = found;
    let verdict = |case: &_| Battery::new(case, &[method]).check(method, word);
    let case = shrink(found.case.clone(), |case| matches!(verdict(case), Verdict::Differs(_)));
    let fault = if let Verdict::Differs(fault) = verdict(&case) { fault } else { fault };
    Replay::of(&case, method, word, &fault)
}

/// The file of `--json`.
#[derive(Serialize)]
struct Summary {
    trees: u64,
    rays: u64,
    methods: usize,
    disagreements: u64,
    /// How often a traversal was put aside and taken up again.
    resumes: u64,
    rows: Vec<Row>,
    smallest: Option<Replay>,
}

/// One line of the table.
#[derive(Serialize)]
struct Row {
    method: String,
    word: String,
    cases: u64,
    agree: u64,
    refused: u64,
    refusal: Option<String>,
    steps: u64,
    state_bytes: usize,
}

impl Row {
    fn of(method: Method, word: WordName, tally: &Tally, depth: u32) -> Self {
        let count = tally.get(method, word);
        let word_name = if method.has_words() { word.name() } else { "-" };
        Self {
            method: method.to_string(),
            word: word_name.to_owned(),
            cases: count.cases,
            agree: count.agree,
            refused: count.refused,
            refusal: count.refusal.map(|refusal| refusal.to_string()),
            steps: count.steps,
            state_bytes: method.state_bytes_in(word, depth),
        }
    }

    fn cells(&self) -> Vec<String> {
        let numbers = [self.cases, self.agree, self.refused, self.steps, self.state_bytes as u64].map(grouped);
        [self.method.clone(), self.word.clone()].into_iter().chain(numbers).collect()
    }
}
