//! `stackless stress`: counts the errors of each accuracy on hard scenes.

mod counts;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use rayon::prelude::*;
use serde_json::json;
use stackless_bvh::generate::stress;
use stackless_bvh::internals::trace::{Accuracy, KernelName, SlabsName};
use stackless_bvh::traverse::Method;
use stackless_bvh::wide;
use stackless_check::{Shard, Stress};
use stackless_suite::Traversal;

use crate::output::{bar, say};
use crate::places::{self, Output};
use crate::record::Run;
use crate::{Outcome, input};
pub(crate) use counts::StressCounts;
use counts::{DOUBLE, Row, WIDE};

/// Trace the stress suite, and count errors against rational arithmetic.
///
/// Every ray goes through every traversal on three trees, as a closest-hit and as an any-hit query. It counts as wrong
/// if any of its answers is wrong. Wide trees are made from these three trees, and traced with every instruction level
/// of the machine. In double precision each ray is traced twice: in the original scene, and with the scene translated
/// by 6.4e6. max ulp is the greatest error of a distance, in floats. The exit code is 1 if an `exact` answer is wrong,
/// in binary trees, wide trees or double precision.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless stress\n  \
    stackless stress --list\n  \
    stackless stress --method wide-record,afra --brief")]
pub(crate) struct Args {
    /// Run only these cases, separated by commas (`--list` prints them). [default: all]
    #[arg(long, value_delimiter = ',', hide_possible_values = true)]
    #[arg(value_parser = input::names(stress::NAMES, |name| name))]
    cases: Vec<&'static str>,
    /// Number of rays of each case.
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    count: u32,
    /// Run only these traversals, separated by commas (`stackless methods` lists them). [default: all]
    #[arg(long, value_delimiter = ',', value_parser = input::traversal(), hide_possible_values = true)]
    method: Vec<Traversal>,
    /// List the cases with their difficulties, and exit.
    #[arg(long)]
    list: bool,
    /// Print only lines with errors.
    #[arg(long)]
    brief: bool,
    /// Run only part I of N. `stackless merge` adds up the counts.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE, hide_default_value = true)]
    shard: Shard,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

/// Options of `lab stress` only.
#[derive(Clone, Copy, Default, clap::Args)]
pub(crate) struct Extra {
    /// Combine every triangle test with every box test. [default: only the four levels of accuracy]
    #[arg(long)]
    all_tests: bool,
}

/// A triangle test and a box test, with the name of the pair.
struct Tests {
    name: String,
    tests: (KernelName, SlabsName),
}

pub(crate) fn run(args: &Args, extra: Extra) -> Outcome {
    let names = if args.cases.is_empty() { stress::NAMES.to_vec() } else { args.cases.clone() };
    if args.list {
        for case in names.iter().filter_map(|name| stress::case(name, 0)) {
            say!("{:28}  {}", case.name, case.about);
        }
        return Ok(true);
    }
    let (methods, wide_methods) = args.methods();
    // Without traversals of binary trees, their tests are not needed.
    let tests = if methods.is_empty() { Vec::new() } else { tests(extra.all_tests) };
    let mut run = Run::of::<StressCounts>([
        ("cases", json!(names)),
        ("rays", args.count.into()),
        ("methods", args.method.iter().map(|method| method.name()).collect()),
        ("all_tests", extra.all_tests.into()),
    ]);
    let numbers = run.take(args.shard, "rays of each case", args.count.into());
    run.refuse_empty(args.shard)?;
    let numbers = numbers.start as usize..numbers.end as usize;
    let progress = bar(names.len() as u64, "cases");
    let shown = Mutex::new(Shown::new(&names, &tests, args.brief));
    let run_case = |(i, &name): (usize, &&'static str)| {
        // The first rays of a case do not depend on the number of rays.
        let mut case = stress::case(name, numbers.end).ok_or("no such case").map_err(str::to_owned)?;
        case.rays.drain(..numbers.start);
        let prepared = Stress::new(&case).map_err(|error| format!("{name}: {error}"))?;
        let rows = tests.iter().map(|Tests { name: accuracy, tests }| {
            let errors = prepared.run(*tests, &methods).map_err(|unfit| format!("{name}: {unfit}"))?;
            Ok(Row::new(name, accuracy, errors))
        });
        let mut rows = rows.collect::<Result<Vec<_>, String>>()?;
        if !methods.is_empty() {
            let errors = prepared.run_double(&methods).map_err(|error| format!("{name}: {error}"))?;
            rows.push(Row::new(name, DOUBLE, errors));
        }
        if !wide_methods.is_empty() {
            let errors = prepared.run_wide(&wide_methods).map_err(|error| format!("{name}: {error}"))?;
            rows.push(Row::new(name, WIDE, errors));
        }
        progress.inc(1);
        progress.suspend(|| shown.lock().unwrap_or_else(PoisonError::into_inner).take(i, &rows));
        Ok(rows)
    };
    // `par_bridge` starts the cases in order, so that the first rows appear first.
    let cases = names.iter().enumerate().par_bridge().map(|(i, name)| run_case((i, name)).map(|rows| (i, rows)));
    let cases: BTreeMap<usize, Vec<Row>> = cases.collect::<Result<_, String>>()?;
    let rows = cases.into_values().flatten().collect();
    progress.finish_and_clear();
    run.finish(StressCounts { rows, are_shown: true }, args.json.as_deref())
}

impl Args {
    /// Traversals of binary and of wide trees. [default: all]
    fn methods(&self) -> (Vec<Method>, Vec<wide::Method>) {
        if self.method.is_empty() {
            return (Method::ALL.into(), wide::Method::ALL.into());
        }
        Traversal::of_each_kind(&self.method)
    }
}

/// Prints the rows of the cases in order, as soon as possible.
struct Shown {
    start: Instant,
    cases: usize,
    done: usize,
    /// The next case to print, and the rows of later cases.
    next: usize,
    waiting: BTreeMap<usize, Vec<String>>,
    widths: [usize; 2],
    /// Prints only rows with errors.
    is_brief: bool,
}

impl Shown {
    fn new(names: &[&str], tests: &[Tests], is_brief: bool) -> Self {
        let tests = tests.iter().map(|tests| tests.name.len());
        let names_width = names.iter().map(|name| name.len()).max().unwrap_or(0);
        let widths = [names_width, tests.chain([WIDE.len(), DOUBLE.len()]).max().unwrap_or(0)];
        let (cases, waiting) = (names.len(), BTreeMap::new());
        Self { start: Instant::now(), cases, done: 0, next: 0, waiting, widths, is_brief }
    }

    fn take(&mut self, case: usize, rows: &[Row]) {
        self.done += 1;
        // Estimate the time once each thread has finished some cases.
        if self.done == 4 * rayon::current_num_threads() {
            let seconds = self.start.elapsed().as_secs_f64() / self.done as f64 * self.cases as f64;
            if seconds >= 2.0 {
                say!("{} cases, about {seconds:.0} s", self.cases);
            }
        }
        let wanted = rows.iter().filter(|row| !self.is_brief || row.errors() > 0);
        self.waiting.insert(case, wanted.map(|row| row.line(self.widths)).collect());
        while let Some(lines) = self.waiting.remove(&self.next) {
            if self.next == 0 && !self.is_brief {
                say!("{}", Row::header(self.widths));
            }
            for line in lines {
                say!("{line}");
            }
            self.next += 1;
        }
    }
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
