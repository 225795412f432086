//! What came of a run.

use core::fmt::{self, Write as _};

use serde::Serialize;

use super::basis::bases;
use super::{Feature, Flaw, Hello, Strength, VERSION, Waiver};

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The answer is right.
    Pass,
    /// The answer is wrong.
    Fail(Flaw),
    /// The implementation has said that it does not have the profile or a feature; it was not asked.
    NotAsked,
    /// What was written is not an answer to the case.
    Error(String),
    /// The program ended.
    Crash(String),
    /// There was no answer in time.
    Timeout,
}

impl Outcome {
    /// The name.
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

    /// Whether the case was asked, and not answered right.
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

/// A case, and what came of it.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// Of the case.
    pub id: String,
    /// Of the case.
    pub clauses: Vec<String>,
    /// Of the case.
    pub strength: Strength,
    /// Of the case: what is special.
    pub why: String,
    /// Of the case: how much there is to look at.
    pub size: usize,
    /// What came of it.
    pub outcome: Outcome,
    /// Why it is known to fail.
    pub waived: Option<String>,
}

impl CaseResult {
    /// Level and profile of the case.
    pub fn profile(&self) -> &str {
        self.id.rsplit_once('/').map_or("", |(profile, _)| profile)
    }

    /// The clauses as a reader needs them: those of the field that differs first, and those of registers only where the
    /// implementation has named that feature.
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

    /// Whether it is one of many that were drawn: of equal size those with a name of their own come first.
    fn is_drawn(&self) -> bool {
        self.id.rsplit('-').next().is_some_and(|end| end.bytes().all(|byte| byte.is_ascii_digit()))
    }

    /// The command that shows the case step by step, where there is one.
    pub fn explained_by(&self) -> Option<String> {
        let is_walk = self.id.starts_with("trace/") && !self.profile().ends_with("invalid");
        is_walk.then(|| format!("stackless explain --suite-case '{}' -o case.html", self.id))
    }

    /// Whether the implementation does not conform for this: a must that is not waived, or a waiver that has grown old.
    pub const fn is_failure(&self) -> bool {
        match self.waived {
            Some(_) => matches!(self.outcome, Outcome::Pass),
            None => self.outcome.is_bad() && matches!(self.strength, Strength::Must),
        }
    }
}

/// A run.
#[derive(Clone, Debug)]
pub struct Report {
    /// What the implementation has said of itself.
    pub hello: Hello,
    /// Of each case, in order.
    pub verdicts: Vec<CaseResult>,
    /// What is wrong beside the cases.
    pub faults: Vec<String>,
}

impl Report {
    /// Whether nothing failed, and every waiver still fails.
    pub fn is_conforming(&self) -> bool {
        self.faults.is_empty() && !self.verdicts.iter().any(CaseResult::is_failure)
    }

    /// What failed, in the order to look at it: the smallest case of each profile, basic profiles first; then the next
    /// smallest of each, and so on.
    pub fn failures(&self) -> Vec<&CaseResult> {
        let mut failed: Vec<_> = self.verdicts.iter().filter(|verdict| verdict.is_failure()).collect();
        failed.sort_by_key(|it| (bases(it.profile()).len(), it.profile(), it.size, it.is_drawn()));
        let profiles = failed.chunk_by(|a, b| a.profile() == b.profile());
        let mut ranked: Vec<_> = profiles.flat_map(|rows| rows.iter().copied().enumerate()).collect();
        ranked.sort_by_key(|&(rank, _)| rank);
        ranked.into_iter().map(|(_, verdict)| verdict).collect()
    }

    /// A more basic profile, in which the mistake of a case shows sooner: one that fails too, or one that was not asked.
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

    /// The list of waivers with which this run succeeds. Those that there were keep their reasons.
    pub fn to_waivers(&self) -> Vec<Waiver> {
        let bad = self.verdicts.iter().filter(|it| it.outcome.is_bad() && it.strength == Strength::Must);
        let waiver = |it: &CaseResult| Waiver {
            id: it.id.clone(),
            reason: it.waived.clone().unwrap_or_else(|| format!("{}: {}", it.outcome.name(), it.outcome)),
        };
        bad.map(waiver).collect()
    }

    /// Number of cases with this outcome, waived ones apart.
    pub fn count(&self, name: &str) -> usize {
        self.verdicts.iter().filter(|verdict| verdict.waived.is_none() && verdict.outcome.name() == name).count()
    }

    /// Number of cases that are waived.
    pub fn waived(&self) -> usize {
        self.verdicts.iter().filter(|verdict| verdict.waived.is_some()).count()
    }

    /// The run as JSON.
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

    /// The run in the format of `JUnit`, which build servers read: a test case each, `skipped` where it was not asked
    /// or is waived.
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

/// Text for an attribute or an element of XML 1.0.
fn escaped(text: &str) -> String {
    let plain = |c: char| match c {
        '\n' => "&#10;".to_owned(),
        '\t' => "&#9;".to_owned(),
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        // XML has no way to write the others.
        c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(plain).collect()
}
