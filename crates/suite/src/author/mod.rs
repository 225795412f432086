//! The cases and their expectations, computed by references that are as simple as possible.
//!
//! The references share no code with the implementations under test. Words are lists of bits. Traversals are a
//! recursion with a list of postponed nodes (`reference`). Tables are the first that fit (`table`). Rays are integers
//! without limit (`truth`). The library supplies only random choices: the trees, tapes and scenes of `generate`.
//! `[CONF-4]`

mod hash;
mod key;
mod order;
mod ray;
mod reference;
mod resume;
mod table;
mod tolerances;
mod tolerant;
mod trace;
mod trees;
mod truth;
mod wide;

use std::collections::HashSet;

use serde_json::{Map, Value};

pub(super) use hash::{folds, keys_of};
pub(super) use table::mixed;
pub(super) use trees::depth_if_tree;
pub(super) use wide::levels_if_tree;

use super::text::object;
use super::{Ask, Expect, Feature, Level, Profile, Strength, Suite, SuiteCase, VERSION};

/// Generates the whole suite, equal on every machine.
pub fn suite() -> Suite {
    let levels = [
        key::profiles(),
        hash::profiles(),
        trace::profiles(),
        resume::profiles(),
        ray::profiles(),
        tolerances::profiles(),
        wide::profiles(),
    ];
    let mut profiles: Vec<_> = levels.into_iter().flatten().collect();
    profiles.sort_by(|a, b| (a.level, &a.profile).cmp(&(b.level, &b.profile)));
    Suite { profiles }
}

/// Returns the names `level/profile` of all files.
pub(super) fn names() -> Vec<String> {
    let all = |(level, profiles): &(Level, &[&str])| -> Vec<String> {
        profiles.iter().map(|profile| format!("{level}/{profile}")).collect()
    };
    PROFILES.iter().flat_map(all).collect()
}

/// All profiles.
pub(super) const PROFILES: [(Level, &[&str]); 5] = [
    (Level::Key, &["u32", "u64", "u128", "wide"]),
    (Level::Hash, &["function", "fold", "address", "keys", "lookup", "build", "build-deep", "wide", "wide-deep"]),
    (
        Level::Trace,
        &[
            "script",
            "complete",
            "tape",
            "node-left",
            "node-sign",
            "disjoint",
            "distance",
            "invalid",
            "wide",
            "wide-invalid",
        ],
    ),
    (Level::Resume, &["state", "disjoint", "key-only", "invalid", "wide"]),
    (Level::Ray, &["grid", "exact", "watertight", "parity", "ulp-8", "ulp-256", "invalid"]),
];

/// Collects the cases of a profile.
struct Author(Profile);

impl Author {
    fn new(level: Level, profile: &str) -> Self {
        Self(Profile { suite: VERSION.to_owned(), level, profile: profile.to_owned(), cases: Vec::new() })
    }

    fn case(&mut self, name: &str, clauses: &[&str], why: &str, ask: &Ask, expect: Expect) -> &mut SuiteCase {
        let input = match serde_json::to_value(ask) {
            Ok(Value::Object(input)) => input,
            _ => Map::new(),
        };
        let cases = &mut self.0.cases;
        let at = cases.len();
        cases.push(SuiteCase {
            id: format!("{}/{}/{name}", self.0.level, self.0.profile),
            clauses: clauses.iter().map(|&clause| clause.to_owned()).collect(),
            strength: Strength::Must,
            features: Vec::new(),
            why: why.to_owned(),
            input,
            expect,
        });
        &mut cases[at]
    }

    /// Returns the profile without repeated inputs.
    fn done(self) -> Profile {
        let mut seen = HashSet::new();
        let Self(mut profile) = self;
        profile.cases.retain(|case| seen.insert(serde_json::to_string(&case.input).unwrap_or_default()));
        profile
    }

    fn reject(&mut self, name: &str, clauses: &[&str], why: &str, ask: &Ask, code: &str) -> &mut SuiteCase {
        self.case(name, clauses, why, ask, Expect::Reject(code.to_owned()))
    }
}

impl SuiteCase {
    fn needs(&mut self, feature: Feature) {
        self.features.push(feature);
    }
}

/// Builds a result with these fields.
fn result<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Expect {
    Expect::Result(object(fields))
}

#[cfg(test)]
mod tests;
