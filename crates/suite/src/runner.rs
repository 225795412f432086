//! Runs the cases against a program, and survives any behaviour of it.

use std::collections::{HashSet, VecDeque};
use std::time::{Duration, Instant};

use super::process::{Heard, Process};
use super::protocol::Request;
use super::text::Shown;
use super::{
    CaseResult, Hello, Outcome, PROTOCOL, Profile, Reply, Report, Strength, Suite, SuiteCase, Waiver, Waivers, judge,
};

/// The settings of a run.
#[derive(Debug)]
pub struct Runner<'s> {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// The cases.
    pub suite: &'s Suite,
    /// Cases that are known to fail. Waivers of cases outside `suite` are ignored.
    pub waivers: Waivers,
    /// The time limit of an answer.
    pub timeout: Duration,
    /// The time limit of the whole run. Later cases are not answered.
    pub budget: Duration,
    /// The maximum number of unanswered cases at a time, at least 1.
    pub window: usize,
    /// Whether to stop at the first failure, without running the remaining cases.
    pub fail_fast: bool,
    /// Whether the program inherits standard error. Otherwise its last line is reported when the program ends.
    pub passes_errors: bool,
}

/// Errors that prevent a run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The program does not start.
    #[error("{command}: {error}")]
    Start {
        /// The command.
        command: String,
        /// The error.
        error: std::io::Error,
    },
    /// The program does not send its declarations.
    #[error("{command}: expected an answer to {{\"cmd\":\"hello\",\"protocol\":{PROTOCOL}}}: {what}")]
    Hello {
        /// The command.
        command: String,
        /// A description of what the program did.
        what: String,
    },
}

/// The maximum number of consecutive starts of a program that only exits or is silent.
const PATIENCE: usize = 20;

impl Runner<'_> {
    /// Runs all cases. `progress` receives each result.
    ///
    /// # Errors
    /// [`RunError`], if there is no run to report.
    pub fn run(&self, mut progress: impl FnMut(&CaseResult)) -> Result<Report, RunError> {
        let deadline = Instant::now() + self.budget;
        let cases: Vec<_> = self.suite.cases().collect();
        let (hello, process) = self.start()?;
        let mut faults = wrong_names(&hello, self.suite);
        let mut outcomes: Vec<Option<Outcome>> =
            cases.iter().map(|(profile, case)| (!hello.asks_for(profile, case)).then_some(Outcome::NotAsked)).collect();
        let to_ask: VecDeque<_> = (0..cases.len()).filter(|&i| outcomes[i].is_none()).collect();
        if to_ask.is_empty() {
            let why = "the program names no profile of these cases, or lacks their features";
            faults.push(format!("nothing was asked: {why}"));
        }
        let verdict = |i: usize, outcome: Outcome| {
            let (_, case) = cases[i];
            let SuiteCase { id, clauses, strength, why, .. } = case.clone();
            // A pattern excuses cases even if some pass, and a case that was not run needs no excuse.
            let is_excused = |waiver: &&Waiver| match outcome {
                Outcome::NotAsked => false,
                Outcome::Pass => !waiver.is_pattern(),
                _ => true,
            };
            let waived = self.waivers.of(&id).filter(is_excused).map(|waiver| waiver.reason.clone());
            CaseResult { id, clauses, strength, why, size: case.size(), outcome, waived }
        };
        let mut told = |i: usize, outcome: &Outcome| progress(&verdict(i, outcome.clone()));
        let mut turn = Turn {
            runner: self,
            cases: &cases,
            hello: &hello,
            outcomes: &mut outcomes,
            to_ask,
            asked: VecDeque::new(),
            alone: 0,
            unclear: None,
            is_over: false,
            faults: &mut faults,
            deadline,
        };
        let mut process = Some(process);
        let mut failed_starts = 0;
        while !turn.to_ask.is_empty() {
            let before = turn.to_ask.len();
            let running = match process.take() {
                Some(process) => process,
                None => match self.start() {
                    Ok((_, process)) => process,
                    Err(error) => {
                        turn.give_up(&error.to_string(), &mut told);
                        break;
                    }
                },
            };
            turn.ask(running, &mut told);
            // Each start settles at least the case that ended the program. If it settles no more than that, the start
            // counts as failed.
            failed_starts = if before - turn.to_ask.len() <= 1 { failed_starts + 1 } else { 0 };
            if failed_starts >= PATIENCE {
                let why = format!("given up: the last {PATIENCE} starts answered nothing");
                turn.give_up(&why, &mut told);
            }
        }
        turn.tell_unclear();
        let is_over = turn.is_over;
        let outcomes = outcomes.into_iter().map(|outcome| outcome.unwrap_or(Outcome::NotAsked));
        let verdicts: Vec<_> = outcomes.enumerate().map(|(i, outcome)| verdict(i, outcome)).collect();
        // After the first failure, the need for other waivers is unknown.
        if !is_over {
            faults.extend(hello.profiles.iter().filter_map(|profile| not_shown(profile, &verdicts)));
            faults.extend(self.waivers.all().iter().filter_map(|waiver| not_needed(waiver, &verdicts)));
        }
        Ok(Report { hello, verdicts, faults })
    }

    fn start(&self) -> Result<(Hello, Process), RunError> {
        let command = || self.command.join(" ");
        let process = Process::start(&self.command, self.passes_errors)
            .map_err(|error| RunError::Start { command: command(), error })?;
        process.say(text(&Request::Hello { protocol: PROTOCOL }));
        let wrong = |what: String| Err(RunError::Hello { command: command(), what });
        let line = match process.hear(self.timeout) {
            Heard::Line(line) => line,
            Heard::Garbage(what) => return wrong(what),
            Heard::End => return wrong(process.end()),
            Heard::Silence => return wrong(format!("nothing in {:?}", self.timeout)),
        };
        match Hello::parse(&line) {
            Ok(Hello { name, version, protocol: PROTOCOL, profiles, features, limits }) => {
                let [name, version] = [name, version].map(|text| Shown(text).to_string());
                Ok((Hello { protocol: PROTOCOL, name, version, profiles, features, limits }, process))
            }
            Ok(hello) => wrong(format!("protocol {}", hello.protocol)),
            Err(error) => wrong(format!("{} in {}", Shown(error.to_string()), Shown(&line))),
        }
    }
}

fn text(request: &Request) -> String {
    serde_json::to_string(request).unwrap_or_default()
}

/// Lists unknown profiles and duplicate names.
fn wrong_names(hello: &Hello, suite: &Suite) -> Vec<String> {
    let known = super::author::names();
    let is_known = |name: &String| known.contains(name) || suite.profiles.iter().any(|profile| profile.name() == *name);
    let unknown = hello.profiles.iter().filter(|name| !is_known(name));
    let unknown = unknown.map(|name| format!("there is no profile '{}'", Shown(name)));
    let (mut profiles, mut features) = (HashSet::new(), HashSet::new());
    let twice = hello.profiles.iter().filter(|name| !profiles.insert(*name)).map(|name| Shown(name).to_string());
    let twice_too = hello.features.iter().filter(|feature| !features.insert(**feature)).map(ToString::to_string);
    unknown.chain(twice.chain(twice_too).map(|name| format!("'{name}' is named twice"))).collect()
}

/// Explains why a declared profile has no evidence: none of its cases was run, or only recommended cases were, and they
/// failed.
fn not_shown(profile: &str, verdicts: &[CaseResult]) -> Option<String> {
    let mut of = verdicts.iter().filter(|verdict| verdict.profile() == profile).peekable();
    of.peek()?;
    let asked: Vec<_> = of.filter(|verdict| verdict.outcome != Outcome::NotAsked).collect();
    let says_nothing = |it: &&CaseResult| it.outcome.is_bad() && it.strength == Strength::May && it.waived.is_none();
    let name = Shown(profile);
    if asked.is_empty() {
        let why = "they need features or limits that were not";
        Some(format!("{name} is named, and none of its cases was asked: {why}"))
    } else if asked.iter().all(says_nothing) {
        Some(format!("{name} is named, and all that was asked of it is only advised, and failed"))
    } else {
        None
    }
}

/// Describes a stale waiver of cases that were run, except for a single case that passes.
fn not_needed(waiver: &Waiver, verdicts: &[CaseResult]) -> Option<String> {
    let of: Vec<_> = verdicts.iter().filter(|verdict| waiver.is_of(&verdict.id)).collect();
    let id = Shown(&waiver.id);
    if of.is_empty() {
        None
    } else if of.iter().all(|verdict| verdict.outcome == Outcome::NotAsked) {
        Some(format!("the waiver of '{id}' is not needed: the case was not asked"))
    } else if waiver.is_pattern() && !of.iter().any(|verdict| verdict.outcome.is_bad()) {
        Some(format!("the waiver of '{id}' is not needed any more: no such case fails"))
    } else {
        None
    }
}

/// The state shared by consecutive starts of the program.
struct Turn<'a> {
    runner: &'a Runner<'a>,
    cases: &'a [(&'a Profile, &'a SuiteCase)],
    hello: &'a Hello,
    outcomes: &'a mut [Option<Outcome>],
    to_ask: VecDeque<usize>,
    asked: VecDeque<usize>,
    /// Number of cases to run one at a time, because one of them may have ended the program.
    alone: usize,
    /// The exit of the program, until a case reproduces it.
    unclear: Option<String>,
    /// Whether the first failure has ended the run.
    is_over: bool,
    faults: &'a mut Vec<String>,
    /// The time limit of the whole run.
    deadline: Instant,
}

type Told<'a> = &'a mut dyn FnMut(usize, &Outcome);

impl Turn<'_> {
    /// Sends cases until all are answered or the program has become useless. Cases that were not the cause stay to be
    /// repeated.
    fn ask(&mut self, mut process: Process, told: Told<'_>) {
        let mut last = None;
        loop {
            let window = if self.alone > 0 { 1 } else { self.runner.window.max(1) };
            while self.asked.len() < window
                && let Some(i) = self.to_ask.get(self.asked.len()).copied()
            {
                let (profile, case) = self.cases[i];
                let (level, name) = (profile.level, profile.profile.clone());
                process.say(text(&Request::Case { seq: i as u64, level, profile: name, input: case.input.clone() }));
                self.asked.push_back(i);
            }
            let Some(&front) = self.asked.front() else { return self.bye(process, last) };
            let left = self.deadline.saturating_duration_since(Instant::now());
            match process.hear(self.runner.timeout.min(left)) {
                Heard::Silence if left < self.runner.timeout => {
                    let why = format!("given up: the run has taken {:?}", self.runner.budget);
                    self.faults.push(why.clone());
                    return self.give_up(&why, told);
                }
                Heard::Line(line) => match self.judge(front, last, &line) {
                    Ok(outcome) => {
                        self.settle(front, outcome, told);
                        self.asked_alone();
                        last = Some(front);
                        if self.is_over {
                            return;
                        }
                    }
                    Err((blamed, what)) => {
                        self.settle(blamed, Outcome::Error(what), told);
                        return self.asked.clear();
                    }
                },
                Heard::Garbage(what) => {
                    self.settle(front, Outcome::Error(what), told);
                    return self.asked.clear();
                }
                // Any of several unanswered cases may be the cause, so they are repeated one at a time.
                Heard::End if self.asked.len() > 1 => {
                    self.alone = self.asked.len();
                    process.close();
                    self.unclear = Some(process.end());
                    return self.asked.clear();
                }
                Heard::End => {
                    process.close();
                    let how = process.end();
                    self.settle(front, Outcome::Crash(how), told);
                    self.unclear = None;
                    self.asked_alone();
                    return self.asked.clear();
                }
                Heard::Silence => {
                    self.settle(front, Outcome::Timeout, told);
                    return self.asked.clear();
                }
            }
        }
    }

    /// Counts a case that was run alone.
    fn asked_alone(&mut self) {
        self.alone = self.alone.saturating_sub(1);
        if self.alone == 0 {
            self.tell_unclear();
        }
    }

    /// Reports an exit of the program that no case reproduces as a fault.
    fn tell_unclear(&mut self) {
        if let Some(how) = self.unclear.take() {
            self.faults.push(format!("the program ended with cases unanswered, and not again when asked alone: {how}"));
        }
    }

    /// Checks a reply to the first unanswered case, or finds the case that caused an invalid line.
    fn judge(&self, front: usize, last: Option<usize>, line: &str) -> Result<Outcome, (usize, String)> {
        let reply = Reply::parse(line)
            .map_err(|error| (front, format!("not an answer: {} in {}", Shown(error.to_string()), Shown(line))))?;
        if reply.seq != front as u64 {
            return Err(match last {
                Some(last) if reply.seq == last as u64 => (last, "answered twice".to_owned()),
                _ => (front, format!("answered out of order: seq {}, expected {front}", reply.seq)),
            });
        }
        let (_, case) = self.cases[front];
        Ok(match judge(case, self.hello, &reply.answer) {
            Ok(()) => Outcome::Pass,
            Err(flaw) => Outcome::Fail(flaw),
        })
    }

    /// Stores the outcome of a case. A case that already has one gets the new outcome.
    fn settle(&mut self, i: usize, outcome: Outcome, told: Told<'_>) {
        if self.to_ask.front() == Some(&i) {
            self.to_ask.pop_front();
            self.asked.pop_front();
        }
        told(i, &outcome);
        let (_, SuiteCase { id, strength, .. }) = self.cases[i];
        let is_failure = outcome.is_bad() && *strength == Strength::Must && self.runner.waivers.of(id).is_none();
        if self.runner.fail_fast && is_failure {
            self.is_over = true;
            self.to_ask.clear();
        }
        self.outcomes[i] = Some(outcome);
    }

    /// Ends the protocol. A program that keeps writing is at fault.
    fn bye(&mut self, mut process: Process, last: Option<usize>) {
        process.say(text(&Request::Bye));
        process.close();
        match process.hear(self.runner.timeout) {
            Heard::End => {}
            Heard::Silence => {
                self.faults.push(format!("the program does not end within {:?} after 'bye'", self.runner.timeout));
            }
            Heard::Line(line) => {
                let what = format!("wrote more than was asked: {}", Shown(&line));
                match last {
                    Some(last) => self.outcomes[last] = Some(Outcome::Error(what)),
                    None => self.faults.push(what),
                }
            }
            Heard::Garbage(what) => self.faults.push(what),
        }
    }

    fn give_up(&mut self, why: &str, told: Told<'_>) {
        while let Some(&i) = self.to_ask.front() {
            self.settle(i, Outcome::Error(why.to_owned()), told);
        }
    }
}
