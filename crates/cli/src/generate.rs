//! `stackless generate`: manual pages and completions.

use std::path::Path;

use clap_complete::Shell;
use clap_mangen::Man;

use crate::Outcome;
use crate::output::{count, say, write_file};
use crate::places::{self, Output};

/// Write the manual pages, or completions for a shell.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  stackless generate man -o man1\n  \
    stackless generate bash > ~/.local/share/bash-completion/completions/stackless")]
pub(crate) struct Args {
    /// The output: `man` (a page for the command and one for each subcommand), or completions for this shell.
    what: What,
    /// Folder for the manual pages, such as `share/man/man1`. It is created if it is missing. Completions go to the
    /// standard output.
    #[arg(short, long, value_name = "DIR", required_if_eq("what", "man"), value_parser = places::folder())]
    output: Option<Output>,
}

#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum What {
    Man,
    Bash,
    Elvish,
    Fish,
    Powershell,
    Zsh,
}

/// Writes the pages or the completions of this command.
pub(crate) fn run(args: &Args, mut command: clap::Command) -> Outcome {
    let shell = match args.what {
        What::Man => return pages(command, args.output.as_deref().unwrap_or(Path::new("."))),
        What::Bash => Shell::Bash,
        What::Elvish => Shell::Elvish,
        What::Fish => Shell::Fish,
        What::Powershell => Shell::PowerShell,
        What::Zsh => Shell::Zsh,
    };
    if args.output.is_some() {
        return Err("--output: completions go to the standard output".into());
    }
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command, "stackless", &mut script);
    write_file("-".as_ref(), |file| file.write_all(&script))?;
    Ok(true)
}

/// Writes the pages of section 1.
fn pages(mut command: clap::Command, folder: &Path) -> Outcome {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be created: {error}", folder.display()))?;
    // Subcommands get their full names and the global options.
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
