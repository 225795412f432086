//! `stackless merge`: adds up records of parts.

mod outside;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::Value;
use stackless_scene::read_text;
use stackless_suite::parse_json;

use crate::Outcome;
use crate::check::Summary;
use crate::output::write_file;
use crate::output::{say, write_json};
use crate::places::{self, Output};
use crate::plots::{Stretch, plot_campaign};
use crate::record::{Counts, Part, Record, Run, say_verdict};
use crate::stress::StressCounts;
use outside::{FuzzCounts, MachineCounts, MutantCounts};

/// Add up the records of all parts of a run.
///
/// Records are the files that `check`, `stress` and `accuracy` write with --json; --shard I/N runs a part. The sum of
/// all parts is the record of the whole run, for every division into parts. Records of different runs or versions,
/// overlapping parts and missing parts are refused. The exit code is 1 if a part has an error.
///
/// The mutants of the adapters (tests/adapters/mutate.py), the extracted machines (spec/rocq/extract) and the fuzz
/// targets (fuzz/run.sh) also write records. Runs of a fuzz target are independent, so they add up without being parts
/// of a whole. A repeated record counts once.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless check --shard 1/2 --json a.json\n  \
    stackless check --shard 2/2 --json b.json\n  \
    stackless merge a.json b.json --json all.json\n  \
    stackless merge records/*.json --plot campaign.svg")]
pub(crate) struct Args {
    /// Records of parts.
    #[arg(required = true)]
    records: Vec<PathBuf>,
    /// Write the sum to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
    /// Draw the cases and the bound on the error rate, over the processor time of the parts, as SVG.
    #[arg(long, value_name = "FILE", value_parser = places::file_as("svg"))]
    plot: Option<Output>,
}

pub(crate) fn run(args: &Args, commands: &[Command]) -> Outcome {
    let read = |path: &PathBuf| {
        let text = read_text(path).map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
        let refused = |error: serde_json::Error| {
            let what = if error.is_data() { "not a record" } else { "not JSON" };
            format!("{}: {what}: {error}; expected a record that --json wrote", path.display())
        };
        Ok((path.display().to_string(), parse_json(&text).map_err(refused)?))
    };
    let records = args.records.iter().map(read).collect::<Result<Vec<(String, Value)>, String>>()?;
    let command_of = |value: &Value| value.pointer("/run/command").and_then(Value::as_str).map(str::to_owned);
    let (path, first) = &records[0];
    let Some(command) = command_of(first) else {
        return Err(format!("{path}: not a record: expected `command` in `run`").into());
    };
    match commands.iter().find(|(name, _)| *name == command) {
        Some((_, merge)) => merge(args, records),
        None => Err(format!("{path}: records of `{command}` cannot be merged by this command").into()),
    }
}

/// The name of a command in records, and the function that merges such records.
pub(crate) type Command = (&'static str, fn(&Args, Vec<(String, Value)>) -> Outcome);

/// The function that merges the records of a command.
pub(crate) const fn command<C: Counts>() -> Command {
    (C::COMMAND, merge::<C>)
}

/// Commands whose records `stackless merge` accepts.
pub(crate) const COMMANDS: [Command; 5] = [
    command::<Summary>(),
    command::<StressCounts>(),
    command::<MutantCounts>(),
    command::<MachineCounts>(),
    command::<FuzzCounts>(),
];

fn merge<C: Counts>(args: &Args, values: Vec<(String, Value)>) -> Outcome {
    let mut records = Vec::new();
    for (path, value) in values {
        check_numbers(&value).map_err(|what| format!("{path}: {what}"))?;
        let record: Record<C> =
            serde_json::from_value(value).map_err(|error| format!("{path}: not a record: {error}"))?;
        record.run.check().and_then(|()| record.counts.check(&record.run)).map_err(|what| format!("{path}: {what}"))?;
        records.push((path, record));
    }
    let plot = args.plot.as_ref().map(|path| (path, draw(&mut records)));
    let Record { run, counts } = add::<C>(records)?;
    let is_well = say_verdict(&counts);
    say!("{}", counts.claim(&run));
    counts.print();
    if let Some(path) = &args.json {
        write_json(path, &Record { run, counts: &counts })?;
    }
    if let Some((path, svg)) = plot {
        write_file(path, |file| file.write_all(svg.as_bytes()))?;
    }
    Ok(is_well)
}

/// Draws the records, in the order of their first cases.
fn draw<C: Counts>(records: &mut [(String, Record<C>)]) -> String {
    let first = |run: &Run| run.parts.values().flat_map(|part| &part.done).map(|[from, _]| *from).min();
    records.sort_by_key(|(_, record)| first(&record.run));
    let stretch = |(_, Record { run, counts }): &(String, Record<C>)| {
        let [cases, errors] = counts.cases_and_errors();
        Stretch { seconds: run.machines.values().sum(), cases, errors }
    };
    let title = records.first().map_or_else(String::new, |(_, record)| format!("stackless {}", record.run.command));
    plot_campaign(&title, &records.iter().map(stretch).collect::<Vec<_>>())
}

/// Returns the sum of the records, if they are the parts of one run.
fn add<C: Counts>(records: Vec<(String, Record<C>)>) -> Result<Record<C>, String> {
    // The ranges with their files: the error of a range that occurs twice names two files.
    let mut done: BTreeMap<String, Vec<([u64; 2], String)>> = BTreeMap::new();
    let mut sum: Option<(String, Record<C>)> = None;
    for (path, record) in records {
        for (name, part) in &record.run.parts {
            done.entry(name.clone()).or_default().extend(part.done.iter().map(|&range| (range, path.clone())));
        }
        sum = Some(match sum {
            None => (path, record),
            Some((first, mut sum)) => {
                sum.run.join(record.run).map_err(|what| format!("{path}: {what} than in {first}"))?;
                sum.counts.add(record.counts);
                (first, sum)
            }
        });
    }
    let (_, mut record) = sum.ok_or("no records")?;
    for (name, part) in &mut record.run.parts {
        cover(name, part.of, done.remove(name).unwrap_or_default())?;
        part.done = if part.of > 0 { vec![[0, part.of]] } else { Vec::new() };
    }
    if record.counts.is_empty() {
        return Err("nothing was compared in any part".to_owned());
    }
    Ok(record)
}

/// Number of missing ranges in an error.
const SHOWN: usize = 10;

/// Refuses ranges that do not cover a list exactly once.
fn cover(name: &str, of: u64, mut ranges: Vec<([u64; 2], String)>) -> Result<(), String> {
    ranges.sort_unstable();
    let (mut next, mut last, mut missing) = (0, None, Vec::new());
    for ([from, to], path) in ranges {
        if let Some(earlier) = last.filter(|_| from < next) {
            return Err(format!("{earlier} and {path} both have {name} {from} to {}", to.min(next) - 1));
        }
        missing.extend((from > next).then(|| [next, from - 1]));
        (next, last) = (to, Some(path));
    }
    missing.extend((next < of).then(|| [next, of - 1]));
    if missing.is_empty() {
        return Ok(());
    }
    let count: u64 = missing.iter().map(|[from, to]| to - from + 1).sum();
    let shown: Vec<_> = missing.iter().take(SHOWN).map(|[from, to]| format!("{from} to {to}")).collect();
    let more = if missing.len() > SHOWN { ", ..." } else { "" };
    Err(format!("{count} of {of} {name} are missing: {}{more}", shown.join(", ")))
}

/// The maximum of a count or of seconds. A float represents every integer up to it.
const MOST: f64 = (1_u64 << 53) as f64;

/// Refuses numbers that no run can count. The field `asked` may have any numbers.
fn check_numbers(value: &Value) -> Result<(), String> {
    match value {
        Value::Number(number) if number.as_f64().is_none_or(|number| !(0.0..=MOST).contains(&number)) => {
            Err(format!("{number}: expected a number from 0 to {MOST}"))
        }
        Value::Array(values) => values.iter().try_for_each(check_numbers),
        Value::Object(values) => values
            .iter()
            .filter(|(key, _)| *key != "asked")
            .try_for_each(|(key, value)| check_numbers(value).map_err(|what| format!("{key}: {what}"))),
        _ => Ok(()),
    }
}

impl Run {
    /// Refuses ranges outside their list.
    fn check(&self) -> Result<(), String> {
        for (name, Part { of, done }) in &self.parts {
            if let Some(range) = done.iter().find(|[from, to]| from >= to || to > of) {
                return Err(format!("{name} {range:?}: expected a range within 0 to {of}"));
            }
        }
        Ok(())
    }

    /// Adds the finished ranges of another part of this run. The error names the difference between the runs.
    fn join(&mut self, other: Self) -> Result<(), String> {
        let named = |what: &str| Err(format!("another {what}"));
        if self.command != other.command {
            return named("command");
        }
        if (&self.version, &self.commit) != (&other.version, &other.commit) {
            return named("version of the program");
        }
        let keys = self.asked.keys().chain(other.asked.keys());
        if let Some(key) = keys.into_iter().find(|&key| self.asked.get(key) != other.asked.get(key)) {
            let shown = |asked: Option<&Value>| asked.map_or_else(|| "none".to_owned(), Value::to_string);
            return Err(format!("`{key}` is {}, another", shown(other.asked.get(key))));
        }
        let lengths = |run: &Self| run.parts.iter().map(|(name, part)| (name.clone(), part.of)).collect::<Vec<_>>();
        if lengths(self) != lengths(&other) {
            return named("list of parts");
        }
        for (part, Part { done, .. }) in self.parts.values_mut().zip(other.parts.into_values()) {
            part.done.extend(done);
        }
        for (machine, seconds) in other.machines {
            *self.machines.entry(machine).or_default() += seconds;
        }
        Ok(())
    }
}
