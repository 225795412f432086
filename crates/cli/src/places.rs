//! Checks the inputs and outputs of a command line before the work starts.

use std::io::IsTerminal as _;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::{fs, io};

use clap::ArgMatches;
use clap::builder::{OsStringValueParser, TypedValueParser};
use stackless_scene::{check_writable, resolve};

use crate::output;

/// Destination of output.
#[derive(Clone, Debug)]
pub(crate) enum Output {
    /// A file; `-` is the standard output.
    File(PathBuf),
    /// Files in a folder.
    Folder(PathBuf),
}

impl Deref for Output {
    type Target = Path;

    fn deref(&self) -> &Path {
        let (Self::File(path) | Self::Folder(path)) = self;
        path
    }
}

/// Reads the path of an output file. With `-` the file has the standard output, and messages go to standard error.
pub(crate) fn file() -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new().try_map(|name| named(name.into()))
}

fn named(path: PathBuf) -> Result<Output, String> {
    if path.as_os_str().is_empty() {
        return Err("expected a file name, or - for the standard output".to_owned());
    }
    if path.as_os_str() == "-" {
        output::leave_to_file();
    }
    Ok(Output::File(path))
}

/// Like [`file()`], for a single kind of file. Refuses other extensions.
pub(crate) fn file_as(kind: &'static str) -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new().try_map(move |name| match Path::new(&name).extension() {
        Some(other) if !other.eq_ignore_ascii_case(kind) => {
            Err(format!("extension .{}: expected .{kind}", other.display()))
        }
        _ if kind == "png" => refuse_terminal(Path::new(&name), kind).and_then(|()| named(name.into())),
        _ => named(name.into()),
    })
}

/// Refuses to write a binary file to a terminal.
pub(crate) fn refuse_terminal(path: &Path, kind: &str) -> Result<(), String> {
    if path.as_os_str() == "-" && io::stdout().is_terminal() {
        return Err(format!("the standard output is a terminal, and .{kind} is binary: expected a file or a pipe"));
    }
    Ok(())
}

/// Reads the path of an output folder.
pub(crate) fn folder() -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new()
        .try_map(|name| if name.is_empty() { Err("expected a folder name") } else { Ok(Output::Folder(name.into())) })
}

/// Refuses a command line with two outputs at one place, an output that overwrites an input, or a place that is not
/// writable. Finds the arguments by their types, so new options are included.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let (mut outputs, mut inputs) = (Vec::new(), Vec::new());
    collect(matches, &mut outputs, &mut inputs);
    let mut taken = Vec::new();
    for output in outputs {
        let name = output.display();
        let failed = |error: io::Error| format!("{name}: cannot be written: {error}");
        let place = output.place().map_err(failed)?;
        if taken.contains(&place) {
            return Err(format!("{name}: two outputs have this path, expected different paths"));
        }
        if inputs.iter().any(|input| fs::canonicalize(input).is_ok_and(|input| input == place)) {
            return Err(format!("{name}: this output would overwrite an input, expected another path"));
        }
        output.check_writable().map_err(failed)?;
        taken.push(place);
    }
    Ok(())
}

fn collect(matches: &ArgMatches, outputs: &mut Vec<Output>, inputs: &mut Vec<PathBuf>) {
    for id in matches.ids() {
        // Arguments of other types yield no values.
        outputs.extend(matches.try_get_many(id.as_str()).ok().flatten().into_iter().flatten().cloned());
        inputs.extend(matches.try_get_many(id.as_str()).ok().flatten().into_iter().flatten().cloned());
    }
    if let Some((_, matches)) = matches.subcommand() {
        collect(matches, outputs, inputs);
    }
}

impl Output {
    fn is_stream(&self) -> bool {
        matches!(self, Self::File(path) if path.as_os_str() == "-")
    }

    /// A canonical path, equal for all paths to one place.
    fn place(&self) -> io::Result<PathBuf> {
        match self {
            Self::File(path) if self.is_stream() => Ok(path.clone()),
            Self::File(path) => resolve(path),
            // A missing folder is created before the work starts, with its parents.
            Self::Folder(path) => Ok(fs::canonicalize(path).unwrap_or_else(|_| path.clone())),
        }
    }

    fn check_writable(&self) -> io::Result<()> {
        match self {
            Self::File(_) if self.is_stream() => Ok(()),
            Self::File(path) => check_writable(path),
            Self::Folder(path) if !path.exists() => Ok(()),
            Self::Folder(path) => check_writable(&path.join("index")),
        }
    }
}
