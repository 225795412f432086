//! The planted bugs as data: `tests/planted/*.toml`.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// One mistake in one function of the library.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Bug {
    /// The mistake in a few words. Unique.
    pub(crate) name: String,
    /// The clause of the specification that it breaks.
    pub(crate) clause: String,
    /// The edited file, relative to the repository.
    pub(crate) file: String,
    /// The edited function, as `name` or `Type::name`, if `old` is not unique in the file.
    #[serde(rename = "fn")]
    pub(crate) function: Option<String>,
    /// The text that is replaced.
    pub(crate) old: String,
    /// The text that replaces it.
    pub(crate) new: String,
    /// Why no layer can catch the bug. Other bugs must be caught.
    pub(crate) survives: Option<String>,
    /// The file that lists the bug.
    #[serde(skip)]
    pub(crate) listed_in: PathBuf,
}

/// Reasons why the list of bugs is unusable.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ListError {
    #[error("{path}: cannot be read: {source}")]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{path}: {source}")]
    Parse { path: PathBuf, source: Box<toml::de::Error> },
    #[error("{0}: no bugs, expected at least one [[bug]]")]
    Empty(PathBuf),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Topic {
    bug: Vec<Bug>,
}

impl Bug {
    /// Reads the bugs of all topics, in the order of the files' names.
    pub(crate) fn all(root: &Path) -> Result<Vec<Self>, ListError> {
        let folder = root.join("tests/planted");
        let failed = |path: &Path| {
            let path = path.to_path_buf();
            |source| ListError::Read { path, source }
        };
        let mut files = Vec::new();
        for entry in fs::read_dir(&folder).map_err(failed(&folder))? {
            let path = entry.map_err(failed(&folder))?.path();
            let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
            if !is_manifest && path.extension().is_some_and(|ending| ending == "toml") {
                files.push(path);
            }
        }
        files.sort();
        let mut bugs = Vec::new();
        for path in files {
            let text = fs::read_to_string(&path).map_err(failed(&path))?;
            let topic: Topic = toml::from_str(&text)
                .map_err(|source| ListError::Parse { path: path.clone(), source: source.into() })?;
            bugs.extend(topic.bug.into_iter().map(|bug| Self { listed_in: path.clone(), ..bug }));
        }
        if bugs.is_empty() { Err(ListError::Empty(folder)) } else { Ok(bugs) }
    }

    /// The file and the name, for messages.
    pub(crate) fn place(&self) -> String {
        let topic = self.listed_in.file_name().unwrap_or_default().display();
        format!("{topic}: \"{}\"", self.name)
    }
}
