//! What `stackless` and `lab` have in common: options, threads, exit codes.

use std::any::TypeId;
use std::process::ExitCode;
use std::sync::LazyLock;

use clap::{ArgMatches, Args, FromArgMatches, Parser, ValueHint};
use stackless_bvh::geom::check_environment;

use crate::{output, places, signals};

/// A program: one of its subcommands, with arguments.
pub(crate) trait Program: Parser {
    fn run(self) -> Outcome;
}

// The options of all subcommands. No documentation: clap would take it for that of the program.
#[derive(Clone, Copy, Args)]
pub(crate) struct Common {
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
}

/// What a subcommand ends with: whether all was well, or why it could not run.
pub(crate) type Outcome = Result<bool, Box<dyn std::error::Error>>;

/// Runs a program: 0 if all is well, 1 if a check found something wrong, 2 if it could not run (bad input or usage).
pub(crate) fn run<P: Program>() -> ExitCode {
    signals::watch();
    let matches = match command_line::<P>().try_get_matches() {
        Ok(matches) => matches,
        Err(usage) => return end(show(&usage)),
    };
    let read = P::from_arg_matches(&matches).and_then(|program| Ok((program, Common::from_arg_matches(&matches)?)));
    end(match read {
        Ok((program, common)) => run_with(program, common, &matches),
        Err(usage) => show(&usage),
    })
}

/// The command line. Completions are told where a file is written, as they know where one is read.
pub(crate) fn command_line<P: Program>() -> clap::Command {
    fn hint(command: clap::Command) -> clap::Command {
        let is_output = |arg: &clap::Arg| arg.get_value_parser().type_id() == TypeId::of::<places::Output>();
        let hinted = |arg: clap::Arg| if is_output(&arg) { arg.value_hint(ValueHint::AnyPath) } else { arg };
        command.mut_args(hinted).mut_subcommands(hint)
    }
    static VERSION: LazyLock<String> = LazyLock::new(|| {
        let commit = option_env!("STACKLESS_COMMIT").map(|commit| format!(" ({commit})"));
        [env!("CARGO_PKG_VERSION"), &commit.unwrap_or_default()].concat()
    });
    hint(Common::augment_args(P::command())).version(VERSION.as_str())
}

fn run_with(program: impl Program, common: Common, matches: &ArgMatches) -> Outcome {
    if common.quiet {
        output::be_quiet();
    }
    if common.verbose {
        output::be_verbose();
    }
    places::check(matches)?;
    start_threads(common.threads)?;
    program.run()
}

/// Prints the help that was asked for, or what is wrong with the command line.
fn show(usage: &clap::Error) -> Outcome {
    if usage.exit_code() == 0 {
        output::note(output::stdout().and_then(|_| usage.print()));
        return Ok(true);
    }
    // It is said as well as it can be.
    let _ = usage.print();
    Err(Box::new(Said))
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
