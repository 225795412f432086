//! The clauses of the specification that pages name, so that a page can show them wherever it lies.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Recording;

/// A clause: its title, its first paragraph, and the text of the specification that has it.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Clause {
    title: String,
    text: String,
    file: String,
}

/// Copied from the specification, which is no part of this crate. A test of the command compares them, and writes the
/// copy.
const CLAUSES: &str = include_str!("clauses.json");

/// The clauses that recordings name, by id.
pub(super) fn named(recordings: &[Recording]) -> BTreeMap<&'static str, Clause> {
    let of_steps =
        |recording: &Recording| recording.steps.iter().flat_map(|step| step.clauses.clone()).collect::<Vec<_>>();
    let ids = recordings.iter().flat_map(|recording| std::iter::once(recording.clause).chain(of_steps(recording)));
    // The copy is valid JSON, as the test sees.
    let mut all: BTreeMap<String, Clause> = serde_json::from_str(CLAUSES).unwrap_or_default();
    ids.filter_map(|id| Some((id, all.remove(id)?))).collect()
}
