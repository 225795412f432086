//! Reads the operations of the kernels from their source, and prints them for Rocq.
//!
//! `operations ROOT` reads the files under that root of a copy of the repository. It rejects code that it does not
//! understand.

mod calls;
#[cfg(test)]
mod glam;
mod operators;
mod print;
mod reader;
mod run;
mod shapes;
mod source;
mod targets;
#[cfg(test)]
mod tests;
mod value;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let Some(root) = std::env::args_os().nth(1) else {
        eprintln!("usage: operations ROOT");
        return ExitCode::from(2);
    };
    match source::Source::read(Path::new(&root)).and_then(|source| print::file(&source, &mut std::io::stdout())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("operations: {error}");
            ExitCode::FAILURE
        }
    }
}
