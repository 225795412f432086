//! `stackless stress`: hard scenes, and how often each accuracy errs on them.

use rayon::prelude::*;
use serde::Serialize;
use stackless_bvh::generate::stress;
use stackless_bvh::trace::{Accuracy, KernelName, SlabsName};
use stackless_bvh::traverse::Method;
use stackless_check::{Errors, Stress, check_boxes};

use crate::output::{bar, grouped, say, table, write_json};
use crate::places::{self, Output};
use crate::{Outcome, input};

/// Trace the stress suite and count errors against rational arithmetic.
///
/// Every ray goes through every traversal, as a closest-hit and as an any-hit query, on three trees; it counts as wrong
/// if any of them errs. max ulp is the greatest error of a distance, in floats. The exit code is 1 if `exact` errs.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless stress\n  \
    stackless stress --list\n  \
    stackless stress --boxes 1000000")]
pub(crate) struct Args {
    /// Only these cases, separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = case)]
    cases: Vec<&'static str>,
    /// Rays of each case.
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    rays: u32,
    /// Only these traversals, separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = input::MethodName)]
    methods: Vec<Method>,
    /// Every triangle test with every box test, and not only the four levels.
    #[arg(long)]
    all_tests: bool,
    /// List the cases and what is hard about them, and do nothing else.
    #[arg(long)]
    list: bool,
    /// Print a line only for cases with errors.
    #[arg(long)]
    brief: bool,
    /// Instead, this many rays with a box each through every box test: how often is a box skipped that the ray touches?
    #[arg(long, value_name = "RAYS", conflicts_with_all = ["cases", "all_tests", "list", "json"])]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1 << 40))]
    boxes: Option<u64>,
    /// Seed of those rays.
    #[arg(long, default_value_t = 1, requires = "boxes")]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    json: Option<Output>,
}

fn case(name: &str) -> Result<&'static str, String> {
    let known = stress::NAMES.into_iter().find(|known| *known == name);
    known.ok_or_else(|| "no case of this name; `stackless stress --list` names them".to_owned())
}

#[derive(Serialize)]
struct Row {
    case: &'static str,
    accuracy: String,
    rays: u64,
    false_misses: u64,
    false_hits: u64,
    wrong_primitives: u64,
    max_ulp: u32,
}

/// Triangle test and box test, with the name that they go by.
struct Tests {
    name: String,
    tests: (KernelName, SlabsName),
}

/// The name of the rows of wide trees, which are exact.
const WIDE: &str = "exact, wide";

pub(crate) fn run(args: &Args) -> Outcome {
    if let Some(rays) = args.boxes {
        return Ok(run_boxes(args.seed, rays));
    }
    let names = if args.cases.is_empty() { stress::NAMES.to_vec() } else { args.cases.clone() };
    if args.list {
        for case in names.iter().filter_map(|name| stress::case(name, 0)) {
            say!("{:28}  {}", case.name, case.about);
        }
        return Ok(true);
    }
    let methods = if args.methods.is_empty() { Method::ALL.to_vec() } else { args.methods.clone() };
    let tests = tests(args.all_tests);
    let progress = bar(names.len() as u64, "cases");
    let run_case = |&name: &&'static str| {
        let case = stress::case(name, args.rays as usize).ok_or("no such case").map_err(str::to_owned)?;
        let prepared = Stress::new(&case).map_err(|error| format!("{name}: {error}"))?;
        let rows = tests.iter().map(|Tests { name: accuracy, tests }| {
            let errors = prepared.run(*tests, &methods).map_err(|unfit| format!("{name}: {unfit}"))?;
            Ok(Row::new(name, accuracy.clone(), errors))
        });
        let mut rows = rows.collect::<Result<Vec<_>, String>>()?;
        if args.methods.is_empty() {
            let errors = prepared.run_wide().map_err(|error| format!("{name}: {error}"))?;
            rows.push(Row::new(name, WIDE.to_owned(), errors));
        }
        progress.inc(1);
        Ok(rows)
    };
    let rows: Vec<Row> =
        names.par_iter().map(run_case).collect::<Result<Vec<_>, String>>()?.into_iter().flatten().collect();
    progress.finish_and_clear();
    print(args, &rows, &tests, names.len());
    if let Some(path) = &args.json {
        write_json(path, &rows)?;
    }
    Ok(rows.iter().all(|row| ![Accuracy::Exact.name(), WIDE].contains(&row.accuracy.as_str()) || row.errors() == 0))
}

/// Boxes alone, against rational arithmetic.
fn run_boxes(seed: u64, rays: u64) -> bool {
    let progress = bar(rays, "rays");
    let tally = check_boxes(seed, rays, &|done| progress.inc(done));
    progress.finish_and_clear();
    let rows = SlabsName::ALL.into_iter().zip(tally.skipped).zip(tally.in_vain);
    let rows = rows.map(|((form, skipped), in_vain)| vec![form.to_string(), grouped(skipped), grouped(in_vain)]);
    say!("{}", table(&["box test", "touched and skipped", "not touched and entered"], 1, rows.collect()));
    say!("stressed: {} rays with a box each, {} touched", grouped(tally.rays), grouped(tally.touched));
    tally.skipped[2] == 0
}

fn tests(all: bool) -> Vec<Tests> {
    let mut tests: Vec<_> =
        Accuracy::ALL.iter().map(|level| Tests { name: level.name().to_owned(), tests: level.tests() }).collect();
    if all {
        for kernel in KernelName::ALL {
            let pairs = SlabsName::ALL.map(|slabs| (kernel, slabs));
            tests.extend(pairs.map(|tests| Tests { name: format!("{} + {}", tests.0, tests.1), tests }));
        }
    }
    tests
}

/// The rows, and their sums for each accuracy.
fn print(args: &Args, rows: &[Row], tests: &[Tests], cases: usize) {
    let header = ["case", "accuracy", "rays", "false misses", "false hits", "wrong primitives", "max ulp"];
    let shown = rows.iter().filter(|row| !args.brief || row.errors() > 0);
    say!("{}", table(&header, 2, shown.map(Row::cells).collect()));
    let sum = |name: &str| {
        let mut sum = Row::new("all", name.to_owned(), Errors::default());
        for row in rows.iter().filter(|row| row.accuracy == name) {
            sum.rays += row.rays;
            sum.false_misses += row.false_misses;
            sum.false_hits += row.false_hits;
            sum.wrong_primitives += row.wrong_primitives;
            sum.max_ulp = sum.max_ulp.max(row.max_ulp);
        }
        sum
    };
    let names = tests.iter().map(|Tests { name, .. }| name.as_str()).chain(args.methods.is_empty().then_some(WIDE));
    say!("{}", table(&header, 2, names.map(|name| sum(name).cells()).collect()));
    let exact = sum(Accuracy::Exact.name());
    let errors = exact.errors() + sum(WIDE).errors();
    say!("stressed: {cases} cases, {} rays, exact: {errors} errors", exact.rays);
}

impl Row {
    fn new(case: &'static str, accuracy: String, errors: Errors) -> Self {
        let Errors { rays, false_misses, false_hits, wrong_primitives, max_ulp } = errors;
        Self { case, accuracy, rays, false_misses, false_hits, wrong_primitives, max_ulp }
    }

    /// Wrong answers, and 1 for a wrong distance.
    fn errors(&self) -> u64 {
        self.false_misses + self.false_hits + self.wrong_primitives + u64::from(self.max_ulp > 0)
    }

    fn cells(&self) -> Vec<String> {
        let numbers = [self.rays, self.false_misses, self.false_hits, self.wrong_primitives, self.max_ulp.into()];
        let names = [self.case.to_owned(), self.accuracy.clone()];
        names.into_iter().chain(numbers.map(|number| number.to_string())).collect()
    }
}
