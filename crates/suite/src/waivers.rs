//! Cases that an implementation is known to fail.

use std::collections::HashSet;
use std::path::Path;

use serde::{Deserialize, Serialize};
use stackless_scene::read_text;
use wildmatch::WildMatch;

use super::text::Shown;
use super::{Suite, Withdrawn};

/// Cases that fail for a known reason: `[{"id": ..., "reason": ...}, ...]`. In an id, `*` matches any text and `?` any
/// character. Unneeded waivers are reported, so the list stays current.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Waivers {
    list: Vec<Waiver>,
}

/// An entry of the list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waiver {
    /// The id of a case, or a pattern of ids.
    pub id: String,
    /// The reason for the failure.
    pub reason: String,
}

impl Waiver {
    /// Returns whether the id is a pattern. Some of its cases may pass.
    pub fn is_pattern(&self) -> bool {
        self.id.contains(['*', '?'])
    }

    /// Returns whether it applies to this case.
    pub fn is_of(&self, id: &str) -> bool {
        self.id == id || self.is_pattern() && WildMatch::new(&self.id).matches(id)
    }
}

/// Errors of reading a list of waivers.
#[derive(Debug, thiserror::Error)]
pub enum WaiverError {
    /// The file cannot be read.
    #[error("{0}")]
    Read(#[from] std::io::Error),
    /// The text is not a list of waivers. The message has line and column.
    #[error(
        "{}: {}; expected a list of waivers: [{{\"id\": ..., \"reason\": ...}}, ...]",
        if .0.is_data() { "not waivers" } else { "not JSON" },
        Shown(.0.to_string())
    )]
    Json(#[from] serde_json::Error),
    /// An id occurs twice.
    #[error("case '{}' stands twice", Shown(.0))]
    Twice(String),
    /// The suite has no such case.
    #[error("there is no case '{}'", Shown(.0))]
    Unknown(String),
    /// The case was withdrawn.
    #[error("{0}")]
    Withdrawn(&'static Withdrawn),
}

impl Waivers {
    /// Reads a file.
    ///
    /// # Errors
    /// [`WaiverError::Read`], [`WaiverError::Json`] and [`WaiverError::Twice`].
    pub fn load(path: &Path) -> Result<Self, WaiverError> {
        Self::parse(&read_text(path)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`WaiverError::Json`] and [`WaiverError::Twice`].
    pub fn parse(text: &str) -> Result<Self, WaiverError> {
        let list: Vec<Waiver> = serde_json::from_str(text)?;
        let mut ids = HashSet::new();
        if let Some(waiver) = list.iter().find(|waiver| !ids.insert(&waiver.id)) {
            return Err(WaiverError::Twice(waiver.id.clone()));
        }
        Ok(Self { list })
    }

    /// Checks that each waiver applies to a case of the whole suite, even if the case is not run.
    ///
    /// # Errors
    /// [`WaiverError::Withdrawn`] or [`WaiverError::Unknown`], for the first one that does not.
    pub fn check(&self, suite: &Suite) -> Result<(), WaiverError> {
        match self.list.iter().find(|waiver| !suite.cases().any(|(_, case)| waiver.is_of(&case.id))) {
            Some(waiver) => Err(Withdrawn::of(&waiver.id)
                .map_or_else(|| WaiverError::Unknown(waiver.id.clone()), WaiverError::Withdrawn)),
            None => Ok(()),
        }
    }

    /// Returns the waiver of a case: the one with its id, or the first pattern that matches.
    pub fn of(&self, id: &str) -> Option<&Waiver> {
        let own = self.list.iter().find(|waiver| waiver.id == id);
        own.or_else(|| self.list.iter().find(|waiver| waiver.is_of(id)))
    }

    /// Returns all waivers.
    pub fn all(&self) -> &[Waiver] {
        &self.list
    }
}
