//! Mistakes planted in the adapters, from `mistakes.toml`: a case must fail.

use std::collections::BTreeMap;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Deserialize;

use super::adapters::{Language, ask};
use super::suite_of;

static LIST: LazyLock<List> = LazyLock::new(|| toml::from_str(include_str!("mistakes.toml")).unwrap());

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    /// Edits that some mistakes need, by name.
    base: BTreeMap<String, Vec<Edit>>,
    mistake: Vec<Mistake>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    old: String,
    new: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Mistake {
    language: Language,
    base: Option<String>,
    old: String,
    new: String,
    /// The prefix of the cases that run.
    cases: String,
    /// A clause of the first case that fails.
    clause: Option<String>,
}

/// Number of planted mistakes. Each has its own file.
static COUNT: AtomicUsize = AtomicUsize::new(0);

/// Replaces words that must occur once in the source, and runs the cases whose ids have a prefix.
fn plant(language: Language, edits: &[(&str, &str)], cases: &str) -> Option<stackless_suite::Report> {
    let mut source = language.source();
    for (old, new) in edits {
        assert_eq!(source.matches(old).count(), 1, "{old}");
        source = source.replace(old, new);
    }
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let command = language.command(&format!("planted-{number}"), &source)?;
    Some(ask(command, &suite_of(|id| id.starts_with(cases))))
}

fn edits(base: &str) -> Vec<(&'static str, &'static str)> {
    LIST.base[base].iter().map(|Edit { old, new }| (&**old, &**new)).collect()
}

/// Checks the mistakes in one language, with or without a clause.
fn are_caught(language: Language, has_clause: bool) {
    let is_asked = |it: &&Mistake| it.language == language && it.clause.is_some() == has_clause;
    for Mistake { base, old, new, cases, clause, .. } in LIST.mistake.iter().filter(is_asked) {
        let mut edits = base.as_deref().map_or(Vec::new(), edits);
        edits.push((old, new));
        let Some(report) = plant(language, &edits, cases) else { return };
        let caught = report.verdicts.iter().find(|verdict| verdict.outcome.is_bad());
        let caught = caught.unwrap_or_else(|| panic!("'{new}' is not caught by {cases}*"));
        let is_right = clause.as_ref().is_none_or(|clause| caught.clauses.contains(clause));
        assert!(is_right && !report.is_conforming(), "'{new}' is caught, but by {}", caught.id);
    }
}

#[test]
fn a_mistake_in_the_c_adapter_is_caught() {
    are_caught(Language::C, true);
}

#[test]
fn a_mistake_in_the_python_adapter_is_caught() {
    are_caught(Language::Python, true);
}

#[test]
fn a_mistake_of_a_reader_in_c_is_caught() {
    are_caught(Language::C, false);
}

#[test]
fn a_mistake_of_a_reader_in_python_is_caught() {
    are_caught(Language::Python, false);
}

#[test]
fn the_bits_of_levels_that_have_not_changed_are_right() {
    if let Some(report) = plant(Language::Python, &edits("clean"), "trace/wide/") {
        assert!(report.is_conforming(), "the bits of WIDE-18 are right");
    }
}
