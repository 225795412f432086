//! `stackless adversary`: the worst cases that a search finds.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use stackless_check::adversary::{GOALS, Goal, Search};

use crate::output::{bar, grouped, say, table, write_file};
use crate::places::{self, Output};
use crate::{Outcome, input};

/// Search for the case that costs most: trees and tapes, or triangles and rays.
///
/// A hill climb with restarts from random cases. The same seed and number of steps give the same case on every machine.
/// The worst case is checked: all traversals against the oracle, the exact tests against rational arithmetic. The exit
/// code is 1 if anything is wrong with it.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless adversary --list\n  \
    stackless adversary climb-afra --seconds 10 -o worst.json\n  \
    stackless adversary --replay worst.json")]
pub(crate) struct Args {
    /// What to make as great as can be; `--list` names them.
    #[arg(required_unless_present_any = ["list", "replay"], hide_possible_values = true)]
    #[arg(value_parser = input::names(GOALS, |goal| goal.name))]
    goal: Option<&'static Goal>,
    /// Cases to look at.
    #[arg(long, default_value_t = 20_000)]
    steps: u64,
    /// Seconds to search, instead.
    #[arg(long, conflicts_with = "steps")]
    seconds: Option<u32>,
    /// Seed of the search.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the worst case to this file, each time that a worse one is found: the search may be interrupted.
    #[arg(short, long, value_name = "FILE", value_parser = places::file)]
    output: Option<Output>,
    /// Do not search: run the case in this file, for the goal that it was found for unless one is named.
    #[arg(long, conflicts_with_all = ["steps", "seconds", "seed", "output"])]
    replay: Option<PathBuf>,
    /// List the goals and what is counted, and do nothing else.
    #[arg(long)]
    list: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    match (args.goal, &args.replay) {
        (goal, Some(path)) if !args.list => replay(goal, path),
        (Some(goal), None) if !args.list => search(goal, args),
        _ => {
            let rows = GOALS.iter().map(|goal| vec![goal.to_string(), goal.about.to_owned()]);
            say!("{}", table(&["goal", "what is counted"], 2, rows.collect()));
            Ok(true)
        }
    }
}

fn search(goal: &'static Goal, args: &Args) -> Outcome {
    let start = Instant::now();
    let end = args.seconds.map(|seconds| Duration::from_secs(seconds.into()));
    let progress = bar(end.map_or(args.steps, |end| end.as_secs()), goal.name);
    let mut search = Search::new(goal, args.seed);
    while end.map_or(search.steps() < args.steps, |end| start.elapsed() < end) {
        if search.step()
            && let Some(worst) = search.worst()
        {
            progress.set_message(format!("{goal}: {:.3}", worst.cost.ratio()));
            if let Some(path) = &args.output {
                let text = goal.write(&worst.subject, worst.cost)?;
                write_file(path, |file| writeln!(file, "{text}"))?;
            }
        }
        progress.set_position(if end.is_some() { start.elapsed().as_secs() } else { search.steps() });
    }
    progress.finish_and_clear();
    let worst = search.worst().ok_or("no case has a cost: more steps are needed")?;
    let (steps, average) = (grouped(search.steps()), search.random_average());
    say!(
        "{goal}: {} = {:.4} at step {}; random average {average:.4}; {steps} steps, seed {}",
        worst.cost,
        worst.cost.ratio(),
        grouped(worst.step),
        args.seed
    );
    Ok(is_sound(goal, worst.subject.verify()))
}

fn replay(goal: Option<&'static Goal>, path: &Path) -> Outcome {
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = stackless_scene::read_text(path).map_err(|error| named(&error))?;
    let unnamed = "it does not say for which goal it was found, expected a goal before --replay";
    let goal = goal.or_else(|| Goal::of(&text)).ok_or_else(|| named(&unnamed))?;
    let (subject, _) = goal.read(&text).map_err(|error| named(&error))?;
    let cost = goal.cost(&subject).ok_or_else(|| named(&"this case has no such cost"))?;
    say!("{goal}: {cost} = {:.4}", cost.ratio());
    Ok(is_sound(goal, subject.verify()))
}

fn is_sound(goal: &Goal, verified: Result<(), impl std::fmt::Display>) -> bool {
    if let Err(error) = &verified {
        say!("{goal}: {error}");
    }
    verified.is_ok()
}
