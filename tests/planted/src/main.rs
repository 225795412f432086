//! Plants bugs in the shipped source of `stackless-bvh`, and reports which layer of checks catches each.
//!
//! The bugs are data: `tests/planted/*.toml`. The results are `tests/planted/table.json` and `README.md` there.

mod bug;
mod check;
mod copy;
mod edit;
mod layers;
mod process;
mod run;
mod table;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use bug::Bug;
use layers::LAYERS;
use run::{Choice, Plan};

/// Plants bugs in the library's source and runs the checks.
#[derive(Debug, Parser)]
#[command(name = "planted")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Check that every bug applies to the source and names a clause. Takes seconds; builds nothing.
    Check,
    /// Copy the tree with all bugs in it, and compile the library of the copy without its tests.
    Compile,
    /// Copy the tree with all bugs in it, build its tests once, and run them for each bug.
    ///
    /// Without --sample and --only all bugs run, and tests/planted/table.json and tests/planted/README.md are written.
    /// Exits with 1 if a bug survives that must be caught, if one is caught that must survive, or if a check fails without a bug.
    Run {
        /// Run N bugs, chosen by the hash of the commit among those that unit tests have caught: only these are built.
        #[arg(long, value_name = "N", conflicts_with = "only")]
        sample: Option<usize>,
        /// Run the bugs with TEXT in their name or file, or with this clause or topic. Repeat the option for several
        /// texts.
        #[arg(long, value_name = "TEXT")]
        only: Vec<String>,
        /// Run these layers only, separated by commas. A bug that none of them catches gets no row.
        #[arg(long, value_delimiter = ',', value_parser = LAYERS.each_ref().map(|layer| layer.name))]
        layers: Vec<String>,
        /// Run all layers for each bug, also after a layer has caught it.
        #[arg(long)]
        every_layer: bool,
        /// End a layer after S seconds; the bug then counts as caught. By default, 10 seconds and four times the
        /// duration without a bug.
        #[arg(long, value_name = "S")]
        seconds: Option<u64>,
        /// Write the table to FILE. Rows of bugs that do not run are kept.
        #[arg(long, value_name = "FILE")]
        json: Option<PathBuf>,
    },
    /// Write tests/planted/README.md from tests/planted/table.json.
    Page,
}

fn main() -> ExitCode {
    match execute(Arguments::parse().command) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn execute(command: Command) -> Result<bool, Box<dyn std::error::Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let bugs = Bug::all(&root)?;
    let faults = check::faults(&root, &bugs);
    for fault in &faults {
        eprintln!("{fault}");
    }
    if !faults.is_empty() {
        eprintln!("{} faults in {} bugs", faults.len(), bugs.len());
        return Ok(false);
    }
    match command {
        Command::Check => {
            println!("{} bugs apply", bugs.len());
            Ok(true)
        }
        Command::Compile => {
            let copy = run::copy_folder(&root);
            copy::write(&root, &copy, &bugs)?;
            layers::compile(&copy)?;
            println!("{} bugs compile", bugs.len());
            Ok(true)
        }
        Command::Run { sample, only, layers, every_layer, seconds, json } => {
            let choice = match sample {
                Some(count) => Choice::Sample(count),
                None if only.is_empty() => Choice::All,
                None => Choice::Only(only),
            };
            Plan { choice, layers, every_layer, seconds, json }.run(&root, &bugs)
        }
        Command::Page => {
            let folder = root.join("tests/planted");
            table::Table::read(&folder.join("table.json"))?.write_page(&folder, &bugs)?;
            Ok(true)
        }
    }
}
