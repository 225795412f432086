//! Which places a command line reads and writes, looked at before the work begins.

use std::io::IsTerminal as _;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::{fs, io};

use clap::ArgMatches;
use clap::builder::{OsStringValueParser, TypedValueParser};
use stackless_scene::{check_writable, resolve};

use crate::output;

/// Where a command writes.
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

/// The path of a file to write. `-` is the standard output, which then is the file's alone: what else is said goes to
/// the standard error.
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

/// The same for a file of which we write one kind only: a name that promises another is refused.
pub(crate) fn file_as(kind: &'static str) -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new().try_map(move |name| match Path::new(&name).extension() {
        Some(other) if !other.eq_ignore_ascii_case(kind) => {
            Err(format!("the extension says .{}, expected .{kind}: no other kind is written", other.display()))
        }
        _ if kind == "png" => refuse_terminal(Path::new(&name), kind).and_then(|()| named(name.into())),
        _ => named(name.into()),
    })
}

/// Refuses to write a kind of file that is no text to a terminal.
pub(crate) fn refuse_terminal(path: &Path, kind: &str) -> Result<(), String> {
    if path.as_os_str() == "-" && io::stdout().is_terminal() {
        return Err(format!("the standard output is a terminal, and .{kind} is no text: expected a file or a pipe"));
    }
    Ok(())
}

/// The path of a folder to write to.
pub(crate) fn folder() -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new().try_map(|name| {
        if name.is_empty() { Err("expected the name of a folder") } else { Ok(Output::Folder(name.into())) }
    })
}

/// Refuses a command line that writes to one place twice, that overwrites what it reads, or that names a place where
/// nothing can be written. Arguments are known by their types: a new option is looked at without a word here.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let (mut outputs, mut inputs) = (Vec::new(), Vec::new());
    collect(matches, &mut outputs, &mut inputs);
    let mut taken = Vec::new();
    for output in outputs {
        let name = output.display();
        let failed = |error: io::Error| format!("{name}: cannot be written: {error}");
        let place = output.place().map_err(failed)?;
        if taken.contains(&place) {
            return Err(format!("{name}: two outputs would be written there, expected a place for each"));
        }
        if inputs.iter().any(|input| fs::canonicalize(input).is_ok_and(|input| input == place)) {
            return Err(format!("{name}: the command reads it and would overwrite it, expected another place"));
        }
        output.check_writable().map_err(failed)?;
        taken.push(place);
    }
    Ok(())
}

fn collect(matches: &ArgMatches, outputs: &mut Vec<Output>, inputs: &mut Vec<PathBuf>) {
    for id in matches.ids() {
        // An argument of another type has no such values.
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

    /// What tells places apart, by whatever path they are named.
    fn place(&self) -> io::Result<PathBuf> {
        match self {
            // No path of a file is so short.
            Self::File(path) if self.is_stream() => Ok(path.clone()),
            Self::File(path) => resolve(path),
            // One that is not there yet is made before the work, with all that it is in.
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
