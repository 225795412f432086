//! The common part of `stackless` and `lab`: options, threads, exit codes.

use std::any::TypeId;
use std::process::ExitCode;
use std::sync::LazyLock;

use clap::{ArgMatches, Args, FromArgMatches, Parser, ValueHint};
use stackless_bvh::geom::check_environment;

use crate::{output, places, signals};

/// A program: a subcommand with its arguments.
pub(crate) trait Program: Parser {
    fn run(self) -> Outcome;
}

// The options of all subcommands. A doc comment here would become the description of the program.
#[derive(Clone, Copy, Args)]
pub(crate) struct Common {
    /// Print only errors.
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Number of threads. [default: `RAYON_NUM_THREADS`, or one for each core]
    #[arg(long, global = true, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    threads: Option<u32>,
    /// Print all tables.
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
}

/// The result of a subcommand: whether all checks passed, or the reason why it could not run.
pub(crate) type Outcome = Result<bool, Box<dyn std::error::Error>>;

/// Runs a program. Returns 0 on success, 1 if a check failed, 2 on bad input or usage.
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

/// The command line. Completions offer files for output options, too.
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

/// Prints the requested help, or the error of the command line.
fn show(usage: &clap::Error) -> Outcome {
    if usage.exit_code() == 0 {
        output::note(output::stdout().and_then(|_| usage.print()));
        return Ok(true);
    }
    // A failed write to standard error cannot be reported.
    let _ = usage.print();
    Err(Box::new(Said))
}

/// An error that is already printed.
#[derive(Debug, thiserror::Error)]
#[error("")]
struct Said;

/// The maximum number of threads.
const MOST_THREADS: u32 = 1024;

/// Starts the threads: the given number, or `RAYON_NUM_THREADS`, or one for each core. Checks the floating-point
/// environment of each thread.
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

/// Returns the exit code after all output is written. A failed write is an error, even of a successful command.
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
