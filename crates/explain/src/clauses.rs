//! The clauses that recordings cite, included in each page so that it works offline.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Recording;

/// A clause: its title, its first paragraph, and its page of the specification.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Clause {
    title: String,
    text: String,
    file: String,
}

/// A copy of the specification, which is not part of this crate. A test of the command compares them and updates the
/// copy.
const CLAUSES: &str = include_str!("clauses.json");

/// Returns the clauses that recordings cite, by id.
pub(super) fn named(recordings: &[Recording]) -> BTreeMap<&'static str, Clause> {
    let of_steps =
        |recording: &Recording| recording.steps.iter().flat_map(|step| step.clauses.clone()).collect::<Vec<_>>();
    let ids = recordings.iter().flat_map(|recording| std::iter::once(recording.clause).chain(of_steps(recording)));
    // A test checks that the copy is valid JSON.
    let mut all: BTreeMap<String, Clause> = serde_json::from_str(CLAUSES).unwrap_or_default();
    ids.filter_map(|id| Some((id, all.remove(id)?))).collect()
}
