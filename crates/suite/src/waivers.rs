//! Cases that an implementation is known to fail.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use stackless_scene::read_text;

use super::text::Shown;

/// Cases that fail for a reason that is known: `[{"id": ..., "reason": ...}, ...]`. One that passes is reported, so
/// that the list does not grow old.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Waivers {
    reasons: BTreeMap<String, String>,
}

/// Why a file is not a list of waivers.
#[derive(Debug, thiserror::Error)]
pub enum WaiverError {
    /// It cannot be read.
    #[error("{0}")]
    Read(#[from] std::io::Error),
    /// It is no such list. (The message names line and column.)
    #[error("{}", Shown(.0.to_string()))]
    Json(#[from] serde_json::Error),
    /// An id stands twice.
    #[error("case '{}' stands twice", Shown(.0))]
    Twice(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Waiver {
    id: String,
    reason: String,
}

impl Waivers {
    /// Reads a file.
    ///
    /// # Errors
    /// [`WaiverError`].
    pub fn load(path: &Path) -> Result<Self, WaiverError> {
        Self::parse(&read_text(path)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`WaiverError::Json`] and [`WaiverError::Twice`].
    pub fn parse(text: &str) -> Result<Self, WaiverError> {
        let list: Vec<Waiver> = serde_json::from_str(text)?;
        let mut reasons = BTreeMap::new();
        for Waiver { id, reason } in list {
            if reasons.insert(id.clone(), reason).is_some() {
                return Err(WaiverError::Twice(id));
            }
        }
        Ok(Self { reasons })
    }

    /// Why a case is known to fail.
    pub fn reason(&self, id: &str) -> Option<&str> {
        self.reasons.get(id).map(String::as_str)
    }

    /// All ids.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        self.reasons.keys().map(String::as_str)
    }
}
