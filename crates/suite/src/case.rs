//! Cases, and files of them.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use stackless_bvh::name::named;

/// Version of the suite, as in `spec/suite/VERSION`.
pub const VERSION: &str = "1.1.0";

/// What a case is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// Bit functions of keys, trails and counters.
    Key,
    /// The perfect hash.
    Hash,
    /// Traversals of trees, without geometry.
    Trace,
    /// Traversals that are taken up from a state.
    Resume,
    /// Rays and triangles.
    Ray,
}

impl Level {
    /// All levels.
    pub const ALL: [Self; 5] = [Self::Key, Self::Hash, Self::Trace, Self::Resume, Self::Ray];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Key => "key",
            Self::Hash => "hash",
            Self::Trace => "trace",
            Self::Resume => "resume",
            Self::Ray => "ray",
        }
    }
}

named!(Level);

/// What an implementation may have beyond its profiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// It gives the trail at each visit.
    Trails,
    /// It gives J's counter at each visit.
    Counters,
    /// It gives the register at each visit.
    Registers,
    /// It decides once, at the visit, also where decisions change: it never asks again on its way down from the root.
    Changing,
    /// It gives the weights of a hit.
    Weights,
}

impl Feature {
    /// All features.
    pub const ALL: [Self; 5] = [Self::Trails, Self::Counters, Self::Registers, Self::Changing, Self::Weights];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trails => "trails",
            Self::Counters => "counters",
            Self::Registers => "registers",
            Self::Changing => "changing",
            Self::Weights => "weights",
        }
    }

    /// What it means.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Trails => "gives the trail at each visit",
            Self::Counters => "gives J's counter at each visit",
            Self::Registers => "gives the register of the most recently postponed node at each visit",
            Self::Changing => {
                "decides once, at the visit, also where decisions change: never asks again on the way down from \
                 the root"
            }
            Self::Weights => "gives the weights of a hit",
        }
    }
}

named!(Feature);

/// How much a case weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strength {
    /// Who fails it does not conform.
    Must,
    /// It is advised.
    May,
}

/// A case. Its input is an [`Ask`](super::Ask).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteCase {
    /// Permanent: `level/profile/name`.
    pub id: String,
    /// What it is about.
    pub clauses: Vec<String>,
    /// How much it weighs.
    pub strength: Strength,
    /// What it needs beyond its profile.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// One line.
    pub why: String,
    /// What is asked.
    pub input: Map<String, Value>,
    /// What is to be answered.
    pub expect: Expect,
}

/// What is to be answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Expect {
    /// This.
    Result(Map<String, Value>),
    /// A rejection with this code.
    Reject(String),
    /// Anything that is right.
    Valid(bool),
}

/// The cases of one file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Version of the suite.
    pub suite: String,
    /// What its cases are about.
    pub level: Level,
    /// Its name, within the level.
    pub profile: String,
    /// The cases.
    pub cases: Vec<SuiteCase>,
}

impl Profile {
    /// `level/profile`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.level, self.profile)
    }

    /// The text of its file: a line for each case.
    pub fn to_text(&self) -> String {
        let cases: Vec<_> = self.cases.iter().map(|case| serde_json::to_string(case).unwrap_or_default()).collect();
        let Self { suite, level, profile, .. } = self;
        format!(
            "{{\"suite\":\"{suite}\",\"level\":\"{level}\",\"profile\":\"{profile}\",\"cases\":[\n{}\n]}}\n",
            cases.join(",\n")
        )
    }
}

/// All cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite {
    /// Files, in order.
    pub profiles: Vec<Profile>,
}

/// Why files are not a suite.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// A file or folder cannot be read.
    #[error("{path}: {error}")]
    Read {
        /// Which.
        path: String,
        /// Why.
        error: std::io::Error,
    },
    /// A file is not one of cases. (The message names line and column.)
    #[error("{path}: {error}")]
    Json {
        /// Which.
        path: String,
        /// Why.
        error: serde_json::Error,
    },
    /// A file is of another version.
    #[error("{path}: version {found} of the suite, expected {VERSION}")]
    Version {
        /// Which.
        path: String,
        /// Its version.
        found: String,
    },
    /// An id stands twice.
    #[error("{path}: case '{id}' stands twice")]
    Twice {
        /// The file.
        path: String,
        /// The id.
        id: String,
    },
    /// An id is not in its place.
    #[error("{path}: case '{id}': expected an id that begins with '{prefix}/'")]
    Place {
        /// The file.
        path: String,
        /// The id.
        id: String,
        /// Level and profile.
        prefix: String,
    },
    /// There is no case.
    #[error("{path}: no cases: expected files vectors/LEVEL/PROFILE.json")]
    Empty {
        /// The folder.
        path: String,
    },
}

impl Suite {
    /// Reads a folder like `spec/suite`.
    ///
    /// # Errors
    /// [`SuiteError`], for the first file that is not as it must be.
    pub fn load(folder: &Path) -> Result<Self, SuiteError> {
        let mut profiles = Vec::new();
        for level in Level::ALL {
            let folder = folder.join("vectors").join(level.name());
            let Ok(entries) = std::fs::read_dir(&folder) else { continue };
            let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
            // By the name alone: with the dot of the extension `a-b` would come before `a`.
            paths.sort_by(|a, b| a.file_stem().cmp(&b.file_stem()));
            for path in paths.into_iter().filter(|path| path.extension().is_some_and(|end| end == "json")) {
                profiles.push(load_profile(&path)?);
            }
        }
        if profiles.iter().all(|profile: &Profile| profile.cases.is_empty()) {
            return Err(SuiteError::Empty { path: folder.display().to_string() });
        }
        Ok(Self { profiles })
    }

    /// Its files: paths within the folder, and texts.
    pub fn files(&self) -> Vec<(String, String)> {
        let path = |profile: &Profile| format!("vectors/{}.json", profile.name());
        let mut files: Vec<_> = self.profiles.iter().map(|profile| (path(profile), profile.to_text())).collect();
        let rows: Vec<_> = self
            .profiles
            .iter()
            .map(|profile| {
                let (path, cases, name) = (path(profile), profile.cases.len(), profile.name());
                format!("{{\"profile\":\"{name}\",\"file\":\"{path}\",\"cases\":{cases}}}")
            })
            .collect();
        files.push((
            "index.json".to_owned(),
            format!("{{\"suite\":\"{VERSION}\",\"files\":[\n{}\n]}}\n", rows.join(",\n")),
        ));
        let rows: Vec<_> = Feature::ALL.iter().map(|it| format!("\"{it}\":\"{}\"", it.about())).collect();
        files.push(("features.json".to_owned(), format!("{{\n{}\n}}\n", rows.join(",\n"))));
        files.push(("VERSION".to_owned(), format!("{VERSION}\n")));
        files
    }

    /// Each case with its profile.
    pub fn cases(&self) -> impl Iterator<Item = (&Profile, &SuiteCase)> {
        self.profiles.iter().flat_map(|profile| profile.cases.iter().map(move |case| (profile, case)))
    }
}

fn load_profile(path: &Path) -> Result<Profile, SuiteError> {
    let name = || path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| SuiteError::Read { path: name(), error })?;
    let profile: Profile = serde_json::from_str(&text).map_err(|error| SuiteError::Json { path: name(), error })?;
    if profile.suite != VERSION {
        return Err(SuiteError::Version { path: name(), found: profile.suite });
    }
    let (prefix, mut seen) = (profile.name(), std::collections::HashSet::new());
    for SuiteCase { id, .. } in &profile.cases {
        if !id.strip_prefix(&prefix).is_some_and(|rest| rest.starts_with('/')) {
            return Err(SuiteError::Place { path: name(), id: id.clone(), prefix });
        }
        if !seen.insert(id) {
            return Err(SuiteError::Twice { path: name(), id: id.clone() });
        }
    }
    Ok(profile)
}
