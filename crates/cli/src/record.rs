//! Records of runs: the options, the finished parts and the counts. Records of parts add up to the record of the whole
//! run.

use std::collections::BTreeMap;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

use cpu_time::ProcessTime;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use stackless_bvh::geom::{Mesh, Ray, Vector};
use stackless_bvh::hash::mix;
use stackless_check::Shard;

use crate::Outcome;
use crate::input::Scene;
use crate::output::{grouped, say, write_json};

/// The counts of a command. A sum does not depend on the order of its terms.
pub(crate) trait Counts: Serialize + DeserializeOwned {
    /// Name of the command in records.
    const COMMAND: &str;

    /// Refuses counts that contradict the parts of the run or each other.
    fn check(&self, run: &Run) -> Result<(), String>;

    /// Adds the counts of another part.
    fn add(&mut self, other: Self);

    /// The sum, as in `3,000 trees, 0 rays, 27 methods, 0 disagreements`.
    fn sum(&self) -> String;

    /// Prints the errors, and with `--verbose` the details.
    fn print(&self);

    /// Number of cases, and number of errors.
    fn cases_and_errors(&self) -> [u64; 2];

    /// Whether anything was compared.
    fn is_empty(&self) -> bool;

    /// Returns the statistical claim about all such cases, from the counts of a whole run.
    fn claim(&self, _: &Run) -> String {
        claim(self.cases_and_errors())
    }
}

/// The file of `--json`.
#[derive(Serialize, Deserialize)]
pub(crate) struct Record<C> {
    pub(crate) run: Run,
    #[serde(flatten)]
    pub(crate) counts: C,
}

/// The command and its options.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Run {
    pub(crate) command: String,
    pub(crate) version: String,
    /// The commit, if `STACKLESS_COMMIT` was set during the build.
    pub(crate) commit: Option<String>,
    /// All options that affect the counts.
    pub(crate) asked: Map<String, Value>,
    /// The finished ranges of each list, by the name of the list.
    pub(crate) parts: BTreeMap<String, Part>,
    /// Seconds of processor time, by machine.
    pub(crate) machines: BTreeMap<String, f64>,
}

/// The finished numbers of a list.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Part {
    /// Length of the list.
    pub(crate) of: u64,
    /// Half-open ranges.
    pub(crate) done: Vec<[u64; 2]>,
}

impl Run {
    /// A run with nothing finished.
    pub(crate) fn of<C: Counts>(asked: impl IntoIterator<Item = (&'static str, Value)>) -> Self {
        Self {
            command: C::COMMAND.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("STACKLESS_COMMIT").map(str::to_owned),
            asked: asked.into_iter().map(|(key, value)| (key.to_owned(), value)).collect(),
            parts: BTreeMap::new(),
            machines: BTreeMap::new(),
        }
    }

    /// Returns the numbers of a list that this part of the run handles, and records them as finished.
    pub(crate) fn take(&mut self, shard: Shard, name: &str, of: u64) -> Range<u64> {
        let range = shard.range(of);
        let done = if range.is_empty() { Vec::new() } else { vec![[range.start, range.end]] };
        self.parts.insert(name.to_owned(), Part { of, done });
        range
    }

    /// Number of finished cases in the lists with these names.
    pub(crate) fn done(&self, is_wanted: impl Fn(&str) -> bool) -> u64 {
        let parts = self.parts.iter().filter(|(name, _)| is_wanted(name));
        parts.flat_map(|(_, part)| &part.done).fold(0, |sum, [from, to]| sum.saturating_add(to - from))
    }

    /// Refuses an empty part.
    pub(crate) fn refuse_empty(&self, shard: Shard) -> Result<(), String> {
        if self.parts.values().all(|part| part.done.is_empty()) {
            return Err(format!("part {shard} of the run is empty, expected fewer parts"));
        }
        Ok(())
    }

    /// Prints the counts and writes the record. Returns whether there are no errors.
    pub(crate) fn finish<C: Counts>(mut self, counts: C, json: Option<&Path>) -> Outcome {
        let is_well = say_verdict(&counts);
        counts.print();
        self.machines.insert(machine(), ProcessTime::now().as_duration().as_secs_f64());
        if let Some(path) = json {
            write_json(path, &Record { run: self, counts })?;
        }
        Ok(is_well)
    }
}

/// Refuses a number of a record outside this range.
pub(crate) fn expect(what: &str, number: u64, within: RangeInclusive<u64>) -> Result<(), String> {
    match (within.start(), within.end()) {
        _ if within.contains(&number) => Ok(()),
        (low, high) if low == high => Err(format!("{what}: {number}, expected {low} by the other numbers")),
        (low, high) => Err(format!("{what}: {number}, expected {low} to {high} by the other numbers")),
    }
}

/// Prints the verdict and the sum of the counts.
pub(crate) fn say_verdict<C: Counts>(counts: &C) -> bool {
    let [_, errors] = counts.cases_and_errors();
    say!("{}: {}", if errors == 0 { "pass" } else { "FAIL" }, counts.sum());
    errors == 0
}

/// The file of `--json` of a measuring command: the figures, their source and the machine.
#[derive(Serialize)]
struct Figures<'a, T> {
    command: &'static str,
    version: &'static str,
    commit: Option<&'static str>,
    machine: String,
    scenes: &'a [Scene],
    #[serde(flatten)]
    found: T,
}

/// Writes such a file. `found` must be an object.
pub(crate) fn write_figures(
    path: &Path,
    command: &'static str,
    scenes: &[Scene],
    found: impl Serialize,
) -> Result<(), String> {
    let (version, commit) = (env!("CARGO_PKG_VERSION"), option_env!("STACKLESS_COMMIT"));
    write_json(path, &Figures { command, version, commit, machine: machine(), scenes, found })
}

/// The machine, in words.
pub(crate) fn machine() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{} {}, {threads} threads", std::env::consts::OS, std::env::consts::ARCH)
}

/// Adds rows to the rows that differ only in their counts. Rows have one order in all parts; a missing row is searched.
pub(crate) fn add_rows<R>(
    rows: &mut Vec<R>,
    others: Vec<R>,
    is_same: impl Fn(&R, &R) -> bool,
    add: impl Fn(&mut R, R),
) {
    for (i, other) in others.into_iter().enumerate() {
        let here = rows.get(i).is_some_and(|row| is_same(row, &other)).then_some(i);
        match here.or_else(|| rows.iter().position(|row| is_same(row, &other))) {
            Some(at) => add(&mut rows[at], other),
            None => rows.push(other),
        }
    }
}

/// A finding in a case or for a ray.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Numbered<T> {
    pub(crate) number: u64,
    pub(crate) found: T,
}

impl<T> Numbered<T> {
    /// The finding with the lower number.
    pub(crate) fn first(one: Option<Self>, other: Option<Self>) -> Option<Self> {
        one.into_iter().chain(other).min_by_key(|found| found.number)
    }
}

/// The rays of `of` rays with these numbers. Blocks of rays are made separately, so a part need not make all rays.
/// `make` receives the seed of a block and its number of rays.
pub(crate) fn in_blocks(
    numbers: Range<u64>,
    of: u64,
    seed: u64,
    make: impl Fn(u64, usize) -> Vec<Ray>,
) -> impl Iterator<Item = (u64, Ray)> {
    const BLOCK: u64 = 4096;
    (numbers.start / BLOCK..numbers.end.div_ceil(BLOCK)).flat_map(move |block| {
        let seed = if block == 0 { seed } else { mix(seed.wrapping_add(block)) };
        let all = block * BLOCK..of.min((block + 1) * BLOCK);
        let rays = make(seed, (all.end - all.start) as usize);
        let wanted = numbers.start.max(all.start)..numbers.end.min(all.end);
        all.zip(rays).filter(move |(number, _)| wanted.contains(number))
    })
}

/// Identifies a scene, independent of its file name.
pub(crate) fn fingerprint<V: Vector>(mesh: &Mesh<V>) -> Value {
    let corners = mesh.vertices().iter().flat_map(|vertex| vertex.widen().to_array()).map(f64::to_bits);
    let indices = mesh.triangles().iter().flatten().map(|&index| u64::from(index));
    let hash = corners.chain(indices).fold(mesh.vertices().len() as u64, |hash, word| mix(hash ^ word));
    format!("{} triangles, {hash:016x}", mesh.triangles().len()).into()
}

/// The claim about all such cases from a sample: no error in n cases bounds the rate by 3/n at 95 % (1 - 0.05^(1/n)).
pub(crate) fn claim([cases, errors]: [u64; 2]) -> String {
    if errors > 0 {
        return format!("claim: none, {} of {} cases went wrong", grouped(errors), grouped(cases));
    }
    let cases_shown = grouped(cases);
    format!(
        "claim: 0 of {cases_shown} cases went wrong; at 95 % fewer than {:.1e} of such cases do",
        3.0 / cases as f64
    )
}
