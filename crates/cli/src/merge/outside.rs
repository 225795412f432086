//! Records of other programs: the mutants of the adapters, the fuzz targets, and the extracted machines.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::output::{count, detail, grouped, say, table};
use crate::record::{Counts, Run, expect};

/// The counts of `tests/adapters/mutate.py`.
#[derive(Serialize, Deserialize)]
pub(super) struct MutantCounts {
    mutants: u64,
    /// Mutants that do not compile.
    not_compiled: u64,
    caught: u64,
    /// Caught mutants that did not terminate.
    timed_out: u64,
    /// Mutants that behave like the original, according to a list.
    equivalent: u64,
    survivors: Vec<String>,
    /// Caught mutants that the list calls equivalent.
    stale: Vec<String>,
}

impl Counts for MutantCounts {
    const COMMAND: &str = "mutants";

    fn check(&self, run: &Run) -> Result<(), String> {
        let (survivors, stale) = (self.survivors.len() as u64, self.stale.len() as u64);
        let outcomes = [self.not_compiled, self.caught, self.equivalent, survivors];
        let mutants = outcomes.into_iter().fold(0, u64::saturating_add);
        expect("mutants", self.mutants, mutants..=mutants)?;
        expect("mutants", self.mutants, run.done(|_| true)..=run.done(|_| true))?;
        expect("timed_out", self.timed_out, 0..=self.caught)?;
        expect("stale", stale, 0..=self.caught.saturating_add(self.not_compiled))
    }

    fn add(&mut self, other: Self) {
        self.mutants = self.mutants.saturating_add(other.mutants);
        self.not_compiled = self.not_compiled.saturating_add(other.not_compiled);
        self.caught = self.caught.saturating_add(other.caught);
        self.timed_out = self.timed_out.saturating_add(other.timed_out);
        self.equivalent = self.equivalent.saturating_add(other.equivalent);
        for (mine, theirs) in [(&mut self.survivors, other.survivors), (&mut self.stale, other.stale)] {
            mine.extend(theirs);
            mine.sort();
        }
    }

    fn sum(&self) -> String {
        format!(
            "{}: {} did not compile, {} were caught, {} of them timed out, {} are equivalent, {} survived",
            count(self.mutants, "mutant"),
            self.not_compiled,
            self.caught,
            self.timed_out,
            self.equivalent,
            self.survivors.len()
        )
    }

    fn print(&self) {
        for survivor in &self.survivors {
            say!("survived: {survivor}");
        }
        for stale in &self.stale {
            say!("listed as equivalent, but caught: {stale}");
        }
    }

    fn cases_and_errors(&self) -> [u64; 2] {
        [self.mutants, (self.survivors.len() + self.stale.len()) as u64]
    }

    fn is_empty(&self) -> bool {
        self.mutants == self.not_compiled
    }

    /// The mutants are a complete set and not a sample, so there is no bound.
    fn claim(&self, _: &Run) -> String {
        match self.cases_and_errors() {
            [_, 0] => "claim: every mutant that compiles is caught or listed as equivalent".to_owned(),
            [mutants, wrong] => {
                format!(
                    "claim: none, {wrong} of {} mutants survived or are wrongly listed as equivalent",
                    grouped(mutants)
                )
            }
        }
    }
}

/// The counts of the machines extracted from the proofs (spec/rocq/extract).
#[derive(Serialize, Deserialize)]
pub(super) struct MachineCounts {
    cases: u64,
    visits: u64,
    /// Height of the highest tree, in edges.
    height: u64,
    /// Searches in which a traversal and its machine differ.
    errors: u64,
    /// Number of searches by traversal, over all words.
    searches: BTreeMap<String, u64>,
}

impl MachineCounts {
    fn searches(&self) -> u64 {
        self.searches.values().copied().fold(0, u64::saturating_add)
    }
}

impl Counts for MachineCounts {
    const COMMAND: &str = "differ";

    fn check(&self, run: &Run) -> Result<(), String> {
        expect("cases", self.cases, run.done(|_| true)..=run.done(|_| true))?;
        expect("errors", self.errors, 0..=self.searches())
    }

    fn add(&mut self, other: Self) {
        self.cases = self.cases.saturating_add(other.cases);
        self.visits = self.visits.saturating_add(other.visits);
        self.height = self.height.max(other.height);
        self.errors = self.errors.saturating_add(other.errors);
        for (name, searches) in other.searches {
            let sum = self.searches.entry(name).or_default();
            *sum = sum.saturating_add(searches);
        }
    }

    fn print(&self) {
        let row = |(name, &searches): (&String, _)| vec![name.clone(), grouped(searches)];
        detail(table(&["traversal", "searches"], 1, self.searches.iter().map(row).collect()));
    }

    fn sum(&self) -> String {
        let [cases, searches, visits] = [self.cases, self.searches(), self.visits].map(grouped);
        format!("{cases} cases to height {}, {searches} searches, {visits} visits, {} differ", self.height, self.errors)
    }

    fn cases_and_errors(&self) -> [u64; 2] {
        [self.cases, self.errors]
    }

    fn is_empty(&self) -> bool {
        self.searches.is_empty()
    }
}

/// The counts of `fuzz/run.sh`: all runs, by target and time.
#[derive(Serialize, Deserialize)]
pub(super) struct FuzzCounts {
    runs: Vec<FuzzRun>,
}

/// A run of a fuzz target.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FuzzRun {
    target: String,
    /// End time, in seconds since 1970.
    finished: u64,
    sanitizer: String,
    executions: u64,
    /// Wall-clock time.
    seconds: u64,
    /// Size of the corpus at the end of the run.
    corpus: u64,
    findings: u64,
}

/// The sum of the runs of one target.
#[derive(Default)]
struct TargetSum {
    runs: u64,
    executions: u64,
    seconds: u64,
    /// The corpus of the last run.
    corpus: u64,
    findings: u64,
}

impl FuzzCounts {
    fn by_target(&self) -> BTreeMap<&str, TargetSum> {
        let mut sums = BTreeMap::<_, TargetSum>::new();
        for run in &self.runs {
            let sum = sums.entry(&*run.target).or_default();
            *sum = TargetSum {
                runs: sum.runs + 1,
                executions: sum.executions.saturating_add(run.executions),
                seconds: sum.seconds.saturating_add(run.seconds),
                corpus: run.corpus,
                findings: sum.findings.saturating_add(run.findings),
            };
        }
        sums
    }
}

impl Counts for FuzzCounts {
    const COMMAND: &str = "fuzz";

    /// Accepts all counts: a run has no parts, and its counts have no total.
    fn check(&self, _: &Run) -> Result<(), String> {
        Ok(())
    }

    fn add(&mut self, other: Self) {
        self.runs.extend(other.runs);
        self.runs.sort();
        self.runs.dedup();
    }

    fn print(&self) {
        let row = |(target, sum): (&str, TargetSum)| {
            let numbers = [sum.runs, sum.executions, sum.seconds, sum.corpus, sum.findings].map(grouped);
            [target.to_owned()].into_iter().chain(numbers).collect()
        };
        let header = ["target", "runs", "executions", "seconds", "corpus", "findings"];
        detail(table(&header, 1, self.by_target().into_iter().map(row).collect()));
    }

    fn sum(&self) -> String {
        let [executions, findings] = self.cases_and_errors();
        let targets = self.by_target().len() as u64;
        [(targets, "target"), (executions, "execution"), (findings, "finding")]
            .map(|(n, what)| count(n, what))
            .join(", ")
    }

    fn cases_and_errors(&self) -> [u64; 2] {
        let sum = |of: fn(&FuzzRun) -> u64| self.runs.iter().map(of).fold(0, u64::saturating_add);
        [sum(|run| run.executions), sum(|run| run.findings)]
    }

    fn is_empty(&self) -> bool {
        self.runs.iter().all(|run| run.executions == 0)
    }

    /// Inputs of a fuzzer are mutations of each other.
    fn claim(&self, _: &Run) -> String {
        let [executions, findings] = self.cases_and_errors();
        format!(
            "claim: none of a rate, as inputs of a fuzzer are not independent; {findings} findings in {} executions",
            grouped(executions)
        )
    }
}
