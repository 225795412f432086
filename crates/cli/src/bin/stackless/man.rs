//! `stackless man`: the manual pages.

use std::path::Path;

use clap_mangen::Man;

use crate::Outcome;
use crate::output::{count, say, write_file};
use crate::places::{self, Output};

/// Write the manual pages: one of the command and one of each subcommand, in section 1.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless man -o man1")]
pub(crate) struct Args {
    /// The folder, which is made where it is missing: one like `share/man/man1`.
    #[arg(short, long, value_name = "DIR", value_parser = places::folder)]
    output: Output,
}

pub(crate) fn run(args: &Args, mut command: clap::Command) -> Outcome {
    let folder: &Path = &args.output;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be made: {error}", folder.display()))?;
    // Subcommands get their whole names and the options of all.
    command.build();
    let mut pages = Vec::new();
    collect(command, &mut pages);
    for page in &pages {
        write_file(&folder.join(page.get_filename()), |file| page.render(&mut &mut *file))?;
    }
    say!("{} in {}", count(pages.len() as u64, "manual page"), folder.display());
    Ok(true)
}

fn collect(command: clap::Command, pages: &mut Vec<Man>) {
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        collect(below.clone(), pages);
    }
    pages.push(Man::new(command));
}
