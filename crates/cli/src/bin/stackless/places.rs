//! Which places a command line reads and writes, looked at before the work begins.

use std::fs;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::ArgMatches;
use stackless_scene::check_writable;

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
pub(crate) fn file(text: &str) -> Result<Output, String> {
    if text.is_empty() {
        return Err("expected a file name, or - for the standard output".to_owned());
    }
    if text == "-" {
        output::leave_to_file();
    }
    Ok(Output::File(text.into()))
}

/// The path of a folder to write to.
pub(crate) fn folder(text: &str) -> Result<Output, String> {
    if text.is_empty() { Err("expected the name of a folder".to_owned()) } else { Ok(Output::Folder(text.into())) }
}

/// Refuses a command line that writes to one place twice, that overwrites what it reads, or that names a place where
/// nothing can be written. Arguments are known by their types: a new option is looked at without a word here.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let (mut outputs, mut inputs) = (Vec::new(), Vec::new());
    collect(matches, &mut outputs, &mut inputs);
    for (i, output) in outputs.iter().enumerate() {
        let (name, place) = (output.display(), Place::of(output));
        if outputs[..i].iter().any(|other| Place::of(other) == place) {
            return Err(format!("{name}: two outputs would be written there, expected a place for each"));
        }
        if inputs.iter().any(|input| input.exists() && Place::of(input) == place) {
            return Err(format!("{name}: the command reads it and would overwrite it, expected another place"));
        }
        output.check_writable().map_err(|error| format!("{name}: cannot be written: {error}"))?;
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

/// What tells places apart, by whatever path they are named.
#[derive(PartialEq)]
enum Place {
    Stream,
    Path(PathBuf),
}

impl Place {
    fn of(path: &Path) -> Self {
        if path.as_os_str() == "-" {
            return Self::Stream;
        }
        // Of what is not there yet: the folder that it will be in.
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let new = || Some(fs::canonicalize(parent).ok()?.join(path.file_name()?));
        Self::Path(fs::canonicalize(path).ok().or_else(new).unwrap_or_else(|| path.into()))
    }
}

impl Output {
    fn check_writable(&self) -> std::io::Result<()> {
        match self {
            Self::File(path) if path.as_os_str() == "-" => Ok(()),
            Self::File(path) => check_writable(path),
            // One that is not there yet is made before the work.
            Self::Folder(path) if !path.exists() => Ok(()),
            Self::Folder(path) => check_writable(&path.join("index")),
        }
    }
}
