//! The suite as files. `index.json` lists all of them.

use std::collections::HashSet;
use std::path::Path;
use std::{fs, io};

use serde::{Deserialize, Serialize};
use stackless_scene::read_text;

use super::basis::bases;
use super::text::Shown;
use super::{Feature, Profile, Suite, SuiteCase, VERSION, Withdrawn};

/// Errors of reading a suite.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// A file or folder cannot be read.
    #[error("{path}: {error}")]
    Read {
        /// The path.
        path: String,
        /// The error.
        error: io::Error,
    },
    /// A file of cases or the index is invalid. The message has line and column.
    #[error("{path}: {}", Shown(.error.to_string()))]
    Json {
        /// The path.
        path: String,
        /// The error.
        error: serde_json::Error,
    },
    /// A file has another version.
    #[error("{path}: version {} of the suite, expected {VERSION}", Shown(.found))]
    Version {
        /// The path.
        path: String,
        /// Its version.
        found: String,
    },
    /// The index has a file name that is not valid for its profile.
    #[error(
        "index.json: file '{}' of profile '{}': expected vectors/PROFILE.json, with letters a-z, digits and -",
        Shown(.file),
        Shown(.profile)
    )]
    Name {
        /// The profile.
        profile: String,
        /// The file.
        file: String,
    },
    /// The index lists a profile twice.
    #[error("index.json: profile '{}' stands twice", Shown(.profile))]
    ProfileTwice {
        /// The profile.
        profile: String,
    },
    /// A file differs from its entry in the index.
    #[error("{path}: {cases} cases of profile '{}', expected what index.json says", Shown(.profile))]
    Index {
        /// The file.
        path: String,
        /// The profile in it.
        profile: String,
        /// The number of its cases.
        cases: usize,
    },
    /// The index does not list a file.
    #[error("{}: index.json does not name it", Shown(.path))]
    Stray {
        /// The file.
        path: String,
    },
    /// An id occurs twice.
    #[error("{path}: case '{}' stands twice", Shown(.id))]
    Twice {
        /// The file.
        path: String,
        /// The id.
        id: String,
    },
    /// An id does not match its file.
    #[error("{path}: case '{}': expected an id like '{prefix}/NAME', with letters a-z, digits, - and ^", Shown(.id))]
    Place {
        /// The file.
        path: String,
        /// The id.
        id: String,
        /// Level and profile.
        prefix: String,
    },
    /// The suite has no cases.
    #[error("index.json: no cases")]
    Empty,
}

/// The file that lists all other files.
const INDEX: &str = "index.json";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Index {
    suite: String,
    files: Vec<Row>,
}

/// A file of the index.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    profile: String,
    file: String,
    cases: usize,
    /// More basic profiles, where a mistake shows earlier, the most basic first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    rests_on: Vec<String>,
}

impl Row {
    fn of(profile: &Profile) -> Self {
        let name = profile.name();
        let rests_on = bases(&name).into_iter().map(str::to_owned).collect();
        Self { file: format!("vectors/{name}.json"), profile: name, cases: profile.cases.len(), rests_on }
    }

    /// Returns whether the file name is valid. Other names are never used as paths.
    fn is_in_place(&self) -> bool {
        let parts = self.profile.split_once('/');
        parts.is_some_and(|(level, name)| is_name(level, "") && is_name(name, ""))
            && self.file == format!("vectors/{}.json", self.profile)
    }
}

/// Returns whether a text has only lower-case letters, digits, `-`, and the characters of `more`.
fn is_name(text: &str, more: &str) -> bool {
    let is_plain = |c: char| matches!(c, 'a'..='z' | '0'..='9' | '-') || more.contains(c);
    !text.is_empty() && text.chars().all(is_plain)
}

impl Suite {
    /// Reads a folder like `spec/suite`.
    ///
    /// # Errors
    /// [`SuiteError`], for the first file that is invalid or not listed in `index.json`. Its paths are relative to the
    /// folder.
    pub fn load(folder: &Path) -> Result<Self, SuiteError> {
        let suite = Self::read(|file| read_text(&folder.join(file)))?;
        let mut files = Vec::new();
        collect_json(folder, "vectors", &mut files)?;
        let is_named = |path: &String| suite.profiles.iter().any(|profile| Row::of(profile).file == *path);
        match files.into_iter().find(|path| !is_named(path)) {
            Some(path) => Err(SuiteError::Stray { path }),
            None => Ok(suite),
        }
    }

    /// Reads a suite from texts. `text` is called for `index.json` and for the files that it lists.
    ///
    /// # Errors
    /// [`SuiteError`], for the first invalid file.
    pub fn read(mut text: impl FnMut(&str) -> io::Result<String>) -> Result<Self, SuiteError> {
        let mut read = |file: &str| text(file).map_err(|error| SuiteError::Read { path: file.to_owned(), error });
        let index: Index = parse(INDEX, &read(INDEX)?)?;
        check_version(INDEX, index.suite)?;
        let mut profiles = Vec::new();
        let mut names = HashSet::new();
        for row in index.files {
            if !row.is_in_place() {
                return Err(SuiteError::Name { profile: row.profile, file: row.file });
            }
            if !names.insert(row.profile.clone()) {
                return Err(SuiteError::ProfileTwice { profile: row.profile });
            }
            let profile: Profile = parse(&row.file, &read(&row.file)?)?;
            check_version(&row.file, profile.suite.clone())?;
            let (name, cases) = (profile.name(), profile.cases.len());
            if (&name, cases) != (&row.profile, row.cases) {
                return Err(SuiteError::Index { path: row.file, profile: name, cases });
            }
            check_ids(&row.file, &profile)?;
            profiles.push(profile);
        }
        if profiles.iter().all(|profile| profile.cases.is_empty()) {
            return Err(SuiteError::Empty);
        }
        Ok(Self { profiles })
    }

    /// Returns its files: paths relative to the folder, and texts.
    pub fn files(&self) -> Vec<(String, String)> {
        let rows: Vec<_> = self.profiles.iter().map(Row::of).collect();
        let mut files: Vec<_> =
            rows.iter().zip(&self.profiles).map(|(row, profile)| (row.file.clone(), profile.to_text())).collect();
        files.push((INDEX.to_owned(), format!("{{\"suite\":\"{VERSION}\",\"files\":[\n{}\n]}}\n", lines(&rows))));
        let rows: Vec<_> = Feature::ALL.iter().map(|it| format!("\"{it}\":\"{}\"", it.about())).collect();
        files.push(("features.json".to_owned(), format!("{{\n{}\n}}\n", rows.join(",\n"))));
        files.push(("withdrawn.json".to_owned(), format!("[\n{}\n]\n", lines(Withdrawn::ALL))));
        files.push(("VERSION".to_owned(), format!("{VERSION}\n")));
        files
    }
}

impl Profile {
    /// Returns the text of its file, with one line per case.
    pub fn to_text(&self) -> String {
        let Self { suite, level, profile, cases } = self;
        let quoted = |text: &str| serde_json::Value::from(text).to_string();
        let [suite, level, profile] = [suite, level.name(), profile].map(quoted);
        format!("{{\"suite\":{suite},\"level\":{level},\"profile\":{profile},\"cases\":[\n{}\n]}}\n", lines(cases))
    }
}

/// Formats values as lines of JSON.
fn lines(values: &[impl Serialize]) -> String {
    values.iter().map(|value| serde_json::to_string(value).unwrap_or_default()).collect::<Vec<_>>().join(",\n")
}

fn parse<'t, T: Deserialize<'t>>(path: &str, text: &'t str) -> Result<T, SuiteError> {
    serde_json::from_str(text).map_err(|error| SuiteError::Json { path: path.to_owned(), error })
}

fn check_version(path: &str, found: String) -> Result<(), SuiteError> {
    if found == VERSION { Ok(()) } else { Err(SuiteError::Version { path: path.to_owned(), found }) }
}

/// Checks that ids are unique and safe in paths, shells and terminals.
fn check_ids(path: &str, profile: &Profile) -> Result<(), SuiteError> {
    let (prefix, mut seen) = (profile.name(), HashSet::new());
    for SuiteCase { id, .. } in &profile.cases {
        let name = id.strip_prefix(&prefix).and_then(|rest| rest.strip_prefix('/'));
        let (path, id) = (path.to_owned(), id.clone());
        if !name.is_some_and(|name| is_name(name, "^")) {
            return Err(SuiteError::Place { path, id, prefix });
        }
        if !seen.insert(id.clone()) {
            return Err(SuiteError::Twice { path, id });
        }
    }
    Ok(())
}

/// Collects the files with the extension `.json` in a part of a folder, recursively.
fn collect_json(folder: &Path, part: &str, files: &mut Vec<String>) -> Result<(), SuiteError> {
    let failed = |error| SuiteError::Read { path: part.to_owned(), error };
    for entry in fs::read_dir(folder.join(part)).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let path = format!("{part}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            collect_json(folder, &path, files)?;
        } else if entry.path().extension().is_some_and(|end| end == "json") {
            files.push(path);
        }
    }
    Ok(())
}
