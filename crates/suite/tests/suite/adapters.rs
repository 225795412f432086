//! Runs the example adapters of the conformance suite as programs. They pass the profiles that they declare, and
//! planted mistakes in their source are detected. Also checks that the JSON Schemas are complete.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use serde::Deserialize;
use serde_json::Value;
use stackless_suite::{Feature, Report, Runner, Suite, Waivers};

use super::SUITE;

/// The language of an adapter.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
pub(super) enum Language {
    C,
    Python,
}

impl Language {
    const fn file(self) -> &'static str {
        match self {
            Self::C => "traverse.c",
            Self::Python => "traverse.py",
        }
    }

    pub(super) fn source(self) -> String {
        text(&format!("adapters/{}", self.file()))
    }

    /// Returns the command that runs a source; `None`, with a message, if the compiler or interpreter is missing.
    pub(super) fn command(self, name: &str, source: &str) -> Option<Vec<String>> {
        let tool = match self {
            Self::C => "cc",
            Self::Python => "python3",
        };
        if Command::new(tool).arg("--version").output().is_err() {
            println!("SKIPPED: no {tool}");
            return None;
        }
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", self.file()));
        std::fs::write(&path, source).unwrap();
        let path = path.display().to_string();
        if let Self::Python = self {
            return Some(vec![tool.to_owned(), path]);
        }
        let program = path.trim_end_matches(".c").to_owned();
        let flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-O2", "-o", &program, &path];
        let compiled = Command::new(tool).args(flags).output().unwrap();
        assert!(compiled.status.success(), "{name}: {}", String::from_utf8_lossy(&compiled.stderr));
        Some(vec![program])
    }
}

/// Reads a file of `spec/suite`.
pub(super) fn text(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec/suite").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

pub(super) fn ask(command: Vec<String>, suite: &Suite) -> Report {
    let timeout = Duration::from_mins(1);
    let (waivers, budget) = (Waivers::default(), 10 * timeout);
    let runner = Runner { command, suite, waivers, timeout, budget, window: 64, fail_fast: false, passes_errors: true };
    runner.run(|_| {}).unwrap()
}

/// Checks that an adapter passes all its declared profiles, with this number of cases.
fn conforms(language: Language, cases: usize) {
    let Some(command) = language.command("as-it-is", &language.source()) else { return };
    let report = ask(command, &SUITE);
    let bad: Vec<_> = report.verdicts.iter().filter(|verdict| verdict.outcome.is_bad()).collect();
    assert!(bad.is_empty() && report.is_conforming(), "{:?} {bad:#?}", report.faults);
    assert_eq!(report.count("pass"), cases);
}

#[test]
fn the_c_adapter_conforms() {
    conforms(Language::C, 1960);
}

#[test]
fn the_python_adapter_conforms() {
    conforms(Language::Python, 4637);
}

/// Checks the first example of the README, which readers copy.
#[test]
fn the_first_example_of_the_readme_runs() {
    let readme = text("README.md");
    let example = readme.split("```python\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let Some(command) = Language::Python.command("example", example) else { return };
    let mut suite = SUITE.clone();
    suite.profiles.retain(|asked| asked.name() == "key/u32");
    let report = ask(command, &suite);
    let (passed, asked) = (report.count("pass"), report.verdicts.len());
    assert!(readme.contains(&format!("{passed} of {asked} cases pass,")), "{passed} of {asked}");
    let first = report.verdicts.iter().find(|verdict| verdict.outcome.is_bad()).unwrap();
    assert!(readme.contains(&format!("{}: fail: {}\n", first.id, first.outcome)), "{}: {}", first.id, first.outcome);
}

/// Returns the constants of a definition's alternatives.
fn constants<'a>(schema: &'a Value, definition: &str) -> BTreeSet<&'a str> {
    schema["$defs"][definition]["enum"].as_array().into_iter().flatten().filter_map(Value::as_str).collect()
}

#[test]
fn the_schemas_name_all_that_there_is() {
    let suite = &*SUITE;
    let ops: BTreeSet<_> = suite.cases().filter_map(|(_, case)| case.input.get("op")?.as_str()).collect();
    let profiles: Vec<_> = suite.profiles.iter().map(stackless_suite::Profile::name).collect();
    let schema = |name: &str| -> Value {
        let schema: Value = serde_json::from_str(&text(&format!("schema/{name}.json"))).unwrap();
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema", "{name}");
        schema
    };
    let vectors = schema("vectors");
    let inputs = vectors["$defs"]["input"]["oneOf"].as_array().unwrap();
    let named = inputs.iter().filter_map(|input| input["properties"]["op"]["const"].as_str());
    assert_eq!(named.collect::<BTreeSet<_>>(), ops);
    let rejections: BTreeSet<_> = suite.cases().filter_map(|(_, case)| rejection(case)).collect();
    for (schema, is_whole) in [(&vectors, false), (&schema("reply"), true)] {
        // No case exceeds every implementation's limits.
        let codes = constants(schema, "code");
        let missing: Vec<_> = codes.symmetric_difference(&rejections).copied().collect();
        assert_eq!(missing, if is_whole { vec!["too-deep"] } else { vec![] });
    }
    let features: BTreeSet<_> = Feature::ALL.iter().map(|feature| feature.name()).collect();
    for schema in [&vectors, &schema("hello")] {
        assert_eq!(constants(schema, "feature"), features);
    }
    for schema in [&schema("index"), &schema("hello")] {
        assert_eq!(constants(schema, "profile"), profiles.iter().map(String::as_str).collect());
    }
    let named = vectors["properties"]["profile"]["enum"].as_array().unwrap().iter().filter_map(Value::as_str);
    let profiles: BTreeSet<_> = suite.profiles.iter().map(|profile| profile.profile.as_str()).collect();
    assert_eq!(named.collect::<BTreeSet<_>>(), profiles);
    schema("waivers");
    schema("withdrawn");
}

fn rejection(case: &stackless_suite::SuiteCase) -> Option<&str> {
    match &case.expect {
        stackless_suite::Expect::Reject(code) => Some(code),
        _ => None,
    }
}
