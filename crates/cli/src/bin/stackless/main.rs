//! The command `stackless`: check traversals, trace rays, measure.

#![forbid(unsafe_code)]

mod accuracy;
mod bench;
mod build;
mod camera;
mod check;
mod conform;
mod explain;
mod input;
mod judge;
mod man;
mod merge;
mod output;
mod places;
mod record;
mod render;
mod signals;
mod stats;
mod stress;
mod suite;
mod trace;
mod turns;

use std::any::TypeId;
use std::process::ExitCode;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand, ValueHint};
use stackless_bvh::geom::check_environment;

/// Exact ray tracing on triangle meshes, and stackless traversals that are checked and measured.
#[derive(Parser)]
#[command(name = "stackless", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 all is well; 1 a check found something wrong; 2 it could not run: bad input or usage.\n\
    Where a file is written, `-` is the standard output. Files are written whole or not at all.\n\n\
    Examples:\n  stackless check\n  stackless render examples/data/torus.ply -o torus.png\n  stackless conform -- python3 mine.py\n  \
    stackless completions bash > ~/.local/share/bash-completion/completions/stackless"
)]
struct Command {
    /// Say nothing but errors.
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Threads to use. [default: as `RAYON_NUM_THREADS` says, or one for each core]
    #[arg(long, global = true, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    threads: Option<u32>,
    /// Say the details too: all tables.
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Compare every traversal with the oracle, on abstract trees and on scenes.
    Check(check::Args),
    /// Trace the rays of a file through a scene.
    Trace(trace::Args),
    /// Draw a scene, or what its traversal costs.
    Render(render::Args),
    /// Measure the traversals beside each other on scenes.
    Bench(bench::Args),
    /// Count the errors of each accuracy on hard scenes.
    Stress(stress::Args),
    /// Add up the records of the parts of a run.
    Merge(merge::Args),
    /// Ask another implementation the cases of the conformance suite.
    Conform(conform::Args),
    /// The conformance suite: as files, and as what this library answers.
    Suite(suite::Args),
    /// Measure run time against error, for every triangle test with every box test.
    Accuracy(accuracy::Args),
    /// Write a page that steps through traversals of a small tree.
    Explain(explain::Args),
    /// Say what a scene's hierarchy and hash tables take, and how far backtracking goes.
    Stats(stats::Args),
    /// Write the manual pages.
    Man(man::Args),
    /// Write the completions for a shell to the standard output.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

/// What a subcommand ends with: whether all was well, or why it could not run.
type Outcome = Result<bool, Box<dyn std::error::Error>>;

/// 0 if all is well, 1 if a check found something wrong, 2 if it could not run (bad input or usage).
fn main() -> ExitCode {
    signals::watch();
    let matches = match command_line().try_get_matches() {
        Ok(matches) => matches,
        Err(usage) => return end(show(&usage)),
    };
    let outcome = match Command::from_arg_matches(&matches) {
        Ok(command) => run(command, &matches),
        Err(usage) => show(&usage),
    };
    end(outcome)
}

/// The command line. Completions are told where a file is written, as they know where one is read.
fn command_line() -> clap::Command {
    fn hint(command: clap::Command) -> clap::Command {
        let is_output = |arg: &clap::Arg| arg.get_value_parser().type_id() == TypeId::of::<places::Output>();
        let hinted = |arg: clap::Arg| if is_output(&arg) { arg.value_hint(ValueHint::AnyPath) } else { arg };
        command.mut_args(hinted).mut_subcommands(hint)
    }
    hint(Command::command())
}

fn run(command: Command, matches: &ArgMatches) -> Outcome {
    if command.quiet {
        output::be_quiet();
    }
    if command.verbose {
        output::be_verbose();
    }
    places::check(matches)?;
    start_threads(command.threads)?;
    match command.what {
        What::Check(args) => check::run(args),
        What::Trace(args) => trace::run(&args),
        What::Render(args) => render::run(&args),
        What::Bench(args) => bench::run(&args),
        What::Stress(args) => stress::run(&args),
        What::Merge(args) => merge::run(&args),
        What::Conform(args) => conform::run(&args),
        What::Suite(args) => suite::run(&args),
        What::Accuracy(args) => accuracy::run(&args),
        What::Explain(args) => explain::run(&args),
        What::Stats(args) => stats::run(&args),
        What::Man(args) => man::run(&args, command_line()),
        What::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command_line(), "stackless", &mut script);
            output::write_file("-".as_ref(), |file| file.write_all(&script))?;
            Ok(true)
        }
    }
}

/// Prints the help that was asked for, or what is wrong with the command line.
fn show(usage: &clap::Error) -> Outcome {
    let is_help = usage.exit_code() == 0;
    match usage.print() {
        Err(error) if is_help && error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(format!("standard output: cannot be written: {error}").into())
        }
        _ if is_help => Ok(true),
        // It is said already, as well as it can be.
        _ => Err(Box::new(Said)),
    }
}

/// An error that its reader has been told of.
#[derive(Debug, thiserror::Error)]
#[error("")]
struct Said;

/// More threads than this are a mistake.
const MOST_THREADS: u32 = 1024;

/// Starts as many threads as were asked for, or as `RAYON_NUM_THREADS` says, or one for each core, and asks each how it
/// computes with floats.
fn start_threads(asked: Option<u32>) -> Result<(), String> {
    let told = || std::env::var("RAYON_NUM_THREADS").ok()?.parse().ok();
    let asked = asked.or_else(told).unwrap_or(0);
    if asked > MOST_THREADS {
        return Err(format!("RAYON_NUM_THREADS={asked}: expected up to {MOST_THREADS} threads"));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(asked as usize)
        .build_global()
        .map_err(|error| format!("threads: {error}"))?;
    let mut checks = rayon::broadcast(|_| check_environment());
    checks.push(check_environment());
    checks.into_iter().collect::<Result<(), _>>().map_err(|error| error.to_string())
}

/// The exit code, after all is written. What went wrong with that is an error, also of a command that went well.
fn end(outcome: Outcome) -> ExitCode {
    let written = output::finish();
    if let Err(error) = &outcome
        && !error.is::<Said>()
    {
        output::print_error(error);
    }
    if let Err(error) = &written {
        output::print_error(error);
    }
    match outcome {
        Ok(_) if written.is_err() => ExitCode::from(2),
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(_) => ExitCode::from(2),
    }
}
