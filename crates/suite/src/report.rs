//! The report of a run.

use core::fmt::{self, Write as _};

use serde::Serialize;

use super::basis::bases;
use super::{Feature, Flaw, Hello, Strength, VERSION, Waiver};

/// The outcome of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The answer is right.
    Pass,
    /// The answer is wrong.
    Fail(Flaw),
    /// The implementation does not support the profile or a feature, so the case was not run.
    NotAsked,
    /// The reply is not a valid answer to the case.
    Error(String),
    /// The program ended.
    Crash(String),
    /// There was no answer within the time limit.
    Timeout,
}

impl Outcome {
    /// Returns the name.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail(_) => "fail",
            Self::NotAsked => "not-asked",
            Self::Error(_) => "error",
            Self::Crash(_) => "crash",
            Self::Timeout => "timeout",
        }
    }

    /// Returns whether the case was run and not answered correctly.
    pub const fn is_bad(&self) -> bool {
        !matches!(self, Self::Pass | Self::NotAsked)
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fail(flaw) => write!(f, "{flaw}"),
            Self::Error(what) => f.write_str(what),
            Self::Crash(how) => write!(f, "the program ended: {how}"),
            Self::Timeout => f.write_str("no answer in time (is every line flushed?)"),
            Self::Pass | Self::NotAsked => f.write_str(self.name()),
        }
    }
}

/// A case and its outcome.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// The id of the case.
    pub id: String,
    /// The clauses of the case.
    pub clauses: Vec<String>,
    /// The strength of the case.
    pub strength: Strength,
    /// The reason for the case.
    pub why: String,
    /// The size of the case.
    pub size: usize,
    /// The outcome.
    pub outcome: Outcome,
    /// The reason of its waiver, if any.
    pub waived: Option<String>,
}

impl CaseResult {
    /// Returns level and profile of the case.
    pub fn profile(&self) -> &str {
        self.id.rsplit_once('/').map_or("", |(profile, _)| profile)
    }

    /// Returns the clauses in a useful order: those of the differing field first, and those of registers only if the
    /// implementation has declared that feature.
    pub fn clauses_for(&self, hello: &Hello) -> Vec<&str> {
        const OF_REGISTERS: &[&str] = &["REGISTER-", "UNCLE-", "HASHED-"];
        let is_of = |clause: &str, names: &[&str]| names.iter().any(|name| clause.starts_with(name));
        let field = match &self.outcome {
            Outcome::Fail(Flaw::Differs { at, .. } | Flaw::Missing(at)) => at.split('[').next().unwrap_or(at),
            _ => "",
        };
        let first: &[&str] = match field {
            "registers" => OF_REGISTERS,
            "trails" => &["TRAIL-", "WIDE-10"],
            "counters" => &["TRAIL-6"],
            _ => &[],
        };
        let has_registers = hello.features.contains(&Feature::Registers);
        let is_kept = |clause: &&str| has_registers || !is_of(clause, OF_REGISTERS) && *clause != "HASH-3";
        let mut clauses: Vec<_> = self.clauses.iter().map(String::as_str).filter(is_kept).collect();
        if clauses.is_empty() {
            clauses.extend(self.clauses.iter().map(String::as_str));
        }
        clauses.sort_by_key(|clause| !is_of(clause, first));
        clauses
    }

    /// Returns whether the case is one of many random ones. Among cases of equal size, named ones come first.
    fn is_drawn(&self) -> bool {
        self.id.rsplit('-').next().is_some_and(|end| end.bytes().all(|byte| byte.is_ascii_digit()))
    }

    /// Returns the command that explains the case step by step, if there is one.
    pub fn explained_by(&self) -> Option<String> {
        let is_walk = self.id.starts_with("trace/") && !self.profile().ends_with("invalid");
        is_walk.then(|| format!("stackless explain --suite-case '{}' -o case.html", self.id))
    }

    /// Returns whether the case prevents conformance: an unwaived failure of a required case, or a stale waiver.
    pub const fn is_failure(&self) -> bool {
        match self.waived {
            Some(_) => matches!(self.outcome, Outcome::Pass),
            None => self.outcome.is_bad() && matches!(self.strength, Strength::Must),
        }
    }
}

/// The report of a run.
#[derive(Clone, Debug)]
pub struct Report {
    /// The implementation's declarations.
    pub hello: Hello,
    /// The results of all cases, in order.
    pub verdicts: Vec<CaseResult>,
    /// Faults outside the cases.
    pub faults: Vec<String>,
}

impl Report {
    /// Returns whether nothing failed and no waiver is stale.
    pub fn is_conforming(&self) -> bool {
        self.faults.is_empty() && !self.verdicts.iter().any(CaseResult::is_failure)
    }

    /// Returns the failures in the best order for debugging: the smallest case of each profile, basic profiles first;
    /// then the second smallest of each profile, and so on.
    pub fn failures(&self) -> Vec<&CaseResult> {
        let mut failed: Vec<_> = self.verdicts.iter().filter(|verdict| verdict.is_failure()).collect();
        failed.sort_by_key(|it| (bases(it.profile()).len(), it.profile(), it.size, it.is_drawn()));
        let profiles = failed.chunk_by(|a, b| a.profile() == b.profile());
        let mut ranked: Vec<_> = profiles.flat_map(|rows| rows.iter().copied().enumerate()).collect();
        ranked.sort_by_key(|&(rank, _)| rank);
        ranked.into_iter().map(|(_, verdict)| verdict).collect()
    }

    /// Returns a more basic profile that failed or was not run, where the mistake shows earlier.
    pub fn look_first(&self, verdict: &CaseResult) -> Option<String> {
        let of = |base: &str| self.verdicts.iter().filter(move |it| it.profile() == base).collect::<Vec<_>>();
        let bases = bases(verdict.profile());
        if let Some(base) = bases.iter().find(|base| of(base).iter().any(|it| it.is_failure())) {
            return Some(format!("{base} fails too: look there first"));
        }
        let is_named = |base: &str| self.hello.profiles.iter().any(|name| name == base);
        let unnamed = bases.iter().rfind(|base| !is_named(base))?;
        Some(format!("{unnamed}, on which this rests, is not named: its cases say more"))
    }

    /// Returns the waivers with which this run would succeed. Existing waivers keep their reasons.
    pub fn to_waivers(&self) -> Vec<Waiver> {
        let bad = self.verdicts.iter().filter(|it| it.outcome.is_bad() && it.strength == Strength::Must);
        let waiver = |it: &CaseResult| Waiver {
            id: it.id.clone(),
            reason: it.waived.clone().unwrap_or_else(|| format!("{}: {}", it.outcome.name(), it.outcome)),
        };
        bad.map(waiver).collect()
    }

    /// Counts the cases with this outcome, except waived ones.
    pub fn count(&self, name: &str) -> usize {
        self.verdicts.iter().filter(|verdict| verdict.waived.is_none() && verdict.outcome.name() == name).count()
    }

    /// Counts the waived cases.
    pub fn waived(&self) -> usize {
        self.verdicts.iter().filter(|verdict| verdict.waived.is_some()).count()
    }

    /// Returns the run as JSON.
    pub fn to_json(&self) -> impl Serialize {
        #[derive(Serialize)]
        struct Row {
            id: String,
            clauses: Vec<String>,
            strength: Strength,
            why: String,
            outcome: &'static str,
            #[serde(skip_serializing_if = "Option::is_none")]
            what: Option<String>,
            #[serde(skip_serializing_if = "Option::is_none")]
            waived: Option<String>,
        }
        #[derive(Serialize)]
        struct Text {
            suite: &'static str,
            implementation: Hello,
            conforms: bool,
            faults: Vec<String>,
            cases: Vec<Row>,
        }
        let row = |verdict: &CaseResult| Row {
            id: verdict.id.clone(),
            clauses: verdict.clauses.clone(),
            strength: verdict.strength,
            why: verdict.why.clone(),
            outcome: verdict.outcome.name(),
            what: verdict.outcome.is_bad().then(|| verdict.outcome.to_string()),
            waived: verdict.waived.clone(),
        };
        Text {
            suite: VERSION,
            implementation: self.hello.clone(),
            conforms: self.is_conforming(),
            faults: self.faults.clone(),
            cases: self.verdicts.iter().map(row).collect(),
        }
    }

    /// Returns the run in the `JUnit` format of build servers. Each case is a test case, `skipped` if it was not run or
    /// is waived.
    pub fn to_junit(&self) -> String {
        let failures = self.verdicts.iter().filter(|verdict| verdict.is_failure()).count() + self.faults.len();
        let is_skipped = |it: &&CaseResult| !it.is_failure() && (it.outcome != Outcome::Pass || it.waived.is_some());
        let skipped = self.verdicts.iter().filter(is_skipped).count();
        let tests = self.verdicts.len() + self.faults.len();
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{tests}\" failures=\"{failures}\" \
             errors=\"0\" skipped=\"{skipped}\">\n<properties><property name=\"suite\" value=\"{VERSION}\"/></properties>\n",
            escaped(&self.hello.name),
        );
        for verdict in &self.verdicts {
            let (group, name) = verdict.id.rsplit_once('/').unwrap_or(("", &verdict.id));
            let inside = match (&verdict.outcome, &verdict.waived) {
                (Outcome::Pass, Some(_)) => "<failure message=\"waived, and passes\"/>".to_owned(),
                (Outcome::Pass, None) => String::new(),
                (outcome, None) if verdict.is_failure() => {
                    let more = format!("{}\nclauses {}", verdict.why, verdict.clauses.join(", "));
                    format!("<failure message=\"{}\">{}</failure>", escaped(&outcome.to_string()), escaped(&more))
                }
                (outcome, waived) => {
                    let why = waived.clone().unwrap_or_else(|| outcome.to_string());
                    format!("<skipped message=\"{}\"/>", escaped(&why))
                }
            };
            let _ = writeln!(
                text,
                "<testcase classname=\"{}\" name=\"{}\">{inside}</testcase>",
                escaped(group),
                escaped(name)
            );
        }
        for (i, fault) in self.faults.iter().enumerate() {
            let fault = escaped(fault);
            let _ = writeln!(
                text,
                "<testcase classname=\"run\" name=\"fault {i}\"><failure message=\"{fault}\"/></testcase>"
            );
        }
        text + "</testsuite>\n"
    }
}

/// Escapes text for an attribute or an element of XML 1.0.
fn escaped(text: &str) -> String {
    let plain = |c: char| match c {
        '\n' => "&#10;".to_owned(),
        '\t' => "&#9;".to_owned(),
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        // XML cannot represent other control characters.
        c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(plain).collect()
}
