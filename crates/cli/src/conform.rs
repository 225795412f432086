//! `stackless conform`: runs the conformance suite against another implementation.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use stackless_suite::{CaseResult, Hello, Level, Report, Runner, Strength, Suite, VERSION, Waiver, Waivers, Withdrawn};

use crate::output::{bar, detail, grouped, say, table, write_file, write_json};
use crate::places::{self, Output};
use crate::{Outcome, input};

/// Run the conformance suite against another implementation, and report its failures.
///
/// The program reads one JSON object per line and answers with one line (spec/suite/INTERPRETING.md). The exit code is
/// 0 if no case failed and every waiver is still needed, 1 otherwise, 2 if the program could not run.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless conform -- stackless suite serve --method afra --word u32\n  \
    stackless conform --level trace -- python3 spec/suite/adapters/traverse.py")]
pub(crate) struct Args {
    /// Read the suite from a folder like spec/suite. [default: the built-in suite]
    #[arg(long)]
    suite: Option<PathBuf>,
    /// Run only cases of this level.
    #[arg(long, value_parser = input::names(Level::ALL, Level::name))]
    level: Option<Level>,
    /// Run only cases whose id matches; `*` is any text, `?` any character. Repeat the option for several patterns.
    #[arg(long)]
    filter: Vec<String>,
    /// Write the result of each case to this file, as JSON.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
    /// Write the results to this file as `JUnit` XML, for build servers.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    junit: Option<Output>,
    /// Expect the failures in this file: `[{"id": "...", "reason": "..."}]`, with `*` and `?` as in `--filter`.
    #[arg(long)]
    waivers: Option<PathBuf>,
    /// Write waivers for all failures of this run. Waivers of `--waivers` for cases that did not run are kept.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    write_waivers: Option<Output>,
    /// Seconds to wait for an answer.
    #[arg(long, default_value_t = 10.0, value_parser = seconds)]
    timeout: f64,
    /// Seconds for the whole run. The remaining cases then count as not asked.
    #[arg(long, default_value_t = 1800.0, value_parser = seconds)]
    budget: f64,
    /// Show the program's standard error. [default: only its last line, if the program exits]
    #[arg(long)]
    stderr: bool,
    /// Number of cases that are sent before the first answer.
    #[arg(long, default_value_t = 64)]
    window: usize,
    /// Stop at the first failing case.
    #[arg(long)]
    fail_fast: bool,
    /// Number of failures to print.
    #[arg(long, default_value_t = 10)]
    show: usize,
    /// The program and its arguments.
    #[arg(last = true, required = true)]
    command: Vec<String>,
}

fn seconds(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|seconds| (0.001..1e6).contains(seconds))
        .ok_or_else(|| "expected 0.001 to 1000000".to_owned())
}

pub(crate) fn run(args: &Args) -> Outcome {
    let whole = load(args.suite.as_deref())?;
    let named = |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let waivers = match &args.waivers {
        Some(path) => {
            let waivers = Waivers::load(path).map_err(|error| named(path, &error))?;
            waivers.check(&whole).map_err(|error| named(path, &error))?;
            waivers
        }
        None => Waivers::default(),
    };
    let suite = select(whole, args.level, &args.filter)?;
    let is_elsewhere = |waiver: &&Waiver| !suite.cases().any(|(_, case)| waiver.is_of(&case.id));
    let elsewhere: Vec<_> = waivers.all().iter().filter(is_elsewhere).cloned().collect();
    let runner = Runner {
        command: args.command.clone(),
        suite: &suite,
        waivers,
        timeout: Duration::from_secs_f64(args.timeout),
        budget: Duration::from_secs_f64(args.budget),
        window: args.window,
        fail_fast: args.fail_fast,
        passes_errors: args.stderr,
    };
    let start = Instant::now();
    let progress = bar(suite.cases().count() as u64, "cases");
    let report = runner.run(|_| progress.inc(1));
    progress.finish_and_clear();
    let report = report?;
    // Print first: writing the files may fail.
    print(&report, args, start.elapsed());
    if let Some(path) = &args.json {
        write_json(path, &report.to_json())?;
    }
    if let Some(path) = &args.junit {
        write_file(path, |file| file.write_all(report.to_junit().as_bytes()))?;
    }
    if let Some(path) = &args.write_waivers {
        write_json(path, &[elsewhere, report.to_waivers()].concat())?;
    }
    Ok(report.is_conforming())
}

/// Loads the suite of a folder, or the built-in suite.
pub(crate) fn load(folder: Option<&Path>) -> Result<Suite, Box<dyn std::error::Error>> {
    Ok(match folder {
        Some(folder) => Suite::load(folder).map_err(|error| format!("{}: {error}", folder.display()))?,
        None => Suite::shipped()?,
    })
}

/// Selects the cases of a level whose ids match a filter.
pub(crate) fn select(mut suite: Suite, level: Option<Level>, filters: &[String]) -> Result<Suite, String> {
    let patterns: Vec<_> = filters.iter().map(|filter| wildmatch::WildMatch::new(filter)).collect();
    let is_wanted = |id: &str| patterns.is_empty() || patterns.iter().any(|pattern| pattern.matches(id));
    suite.profiles.retain(|profile| level.is_none_or(|level| profile.level == level));
    suite.profiles.iter_mut().for_each(|profile| profile.cases.retain(|case| is_wanted(&case.id)));
    suite.profiles.retain(|profile| !profile.cases.is_empty());
    if suite.profiles.is_empty() {
        let withdrawn = filters.iter().find_map(|filter| Withdrawn::of(filter));
        let why = || "no case has this level and a matching id".to_owned();
        return Err(withdrawn.map_or_else(why, ToString::to_string));
    }
    Ok(suite)
}

fn print(report: &Report, args: &Args, took: Duration) {
    let Hello { name, version, .. } = &report.hello;
    let advised =
        report.verdicts.iter().filter(|verdict| verdict.strength == Strength::May && verdict.outcome.is_bad()).count();
    let advised = if advised > 0 { format!("; {advised} of the failed are only advised") } else { String::new() };
    let is_whole = args.level.is_none() && args.filter.is_empty();
    let verdict = match (report.is_conforming(), is_whole) {
        (true, true) => "conforms in what it names",
        // The verdict says nothing about the other cases.
        (true, false) => "passes what was chosen",
        (false, _) => "does not conform",
    };
    say!(
        "{name} {version} {verdict} (suite {VERSION}): {} of {} cases passed, {} failed, {} not asked, {} waived, {:.1} s{advised}",
        grouped(report.count("pass") as u64),
        grouped(report.verdicts.len() as u64),
        grouped((report.verdicts.len() - report.count("pass") - report.count("not-asked") - report.waived()) as u64),
        grouped(report.count("not-asked") as u64),
        report.waived(),
        took.as_secs_f64()
    );
    let bad = report.failures();
    for verdict in bad.iter().take(args.show) {
        let CaseResult { id, outcome, waived, why, .. } = verdict;
        if let Some(reason) = waived {
            say!("{id}: waived ({reason}), but passes: remove the waiver");
        } else {
            say!(
                "{id}: {}: {outcome}\n  why: {why}\n  clauses {}",
                outcome.name(),
                verdict.clauses_for(&report.hello).join(", ")
            );
        }
        say!("  alone: stackless conform --filter '{id}' -- {}", args.command.join(" "));
        if let Some(command) = verdict.explained_by() {
            say!("  step by step: {command}");
        }
        if let Some(hint) = report.look_first(verdict) {
            say!("  {hint}");
        }
    }
    if bad.len() > args.show {
        say!("and {} more (--show {}, --json FILE)", grouped((bad.len() - args.show) as u64), bad.len());
    }
    for fault in &report.faults {
        say!("{fault}");
    }
    let names = ["pass", "fail", "error", "crash", "timeout", "not-asked"];
    let mut rows: Vec<(&str, [u64; 7])> = Vec::new();
    for verdict in &report.verdicts {
        let profile = verdict.profile();
        if rows.last().is_none_or(|&(last, _)| last != profile) {
            rows.push((profile, [0; 7]));
        }
        let column = names.iter().position(|&name| verdict.waived.is_none() && name == verdict.outcome.name());
        if let Some((_, counts)) = rows.last_mut() {
            counts[column.unwrap_or(names.len())] += 1;
        }
    }
    // The summary line counts the cases that were not asked.
    rows.retain(|(_, counts)| counts[..5].iter().chain(&counts[6..]).any(|&count| count > 0));
    let row = |(profile, counts): (&str, [u64; 7])| {
        [profile.to_owned()].into_iter().chain(counts.map(|count| count.to_string())).collect()
    };
    let rows = rows.into_iter().map(row).collect();
    let header = ["profile"].into_iter().chain(names).chain(["waived"]).collect::<Vec<_>>();
    detail(table(&header, 1, rows));
}
