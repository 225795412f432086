//! Runs the example adapters of the conformance suite as programs. They pass the profiles that they declare, and
//! planted mistakes in their source are detected. Also checks that the JSON Schemas are complete.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use serde_json::Value;
use stackless_suite::{Feature, Report, Runner, Suite, Waivers};

use super::SUITE;

/// The language of an adapter.
#[derive(Clone, Copy)]
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

/// Replaces words of the source, which must occur once, and runs the cases of a profile. The first failing case must
/// have this clause.
fn is_caught(language: Language, from: &str, to: &str, profile: &str, clause: &str) {
    let source = language.source();
    assert_eq!(source.matches(from).count(), 1, "{from}");
    let name = format!("{clause}-{}", profile.replace('/', "-"));
    let Some(command) = language.command(&name, &source.replace(from, to)) else { return };
    let mut suite = SUITE.clone();
    suite.profiles.retain(|asked| asked.name() == profile);
    let report = ask(command, &suite);
    let caught = report.verdicts.iter().find(|verdict| verdict.outcome.is_bad());
    let caught = caught.unwrap_or_else(|| panic!("'{to}' is not caught"));
    assert!(caught.clauses.iter().any(|it| it == clause), "'{to}' is caught, but by {}", caught.id);
    assert!(!report.is_conforming());
}

#[test]
fn the_c_adapter_conforms() {
    conforms(Language::C, 1960);
}

#[test]
fn the_python_adapter_conforms() {
    conforms(Language::Python, 4637);
}

#[test]
fn a_mistake_in_the_c_adapter_is_caught() {
    for (from, to, profile, clause) in [
        ("*key = *key >> n ^ 1;", "*key = *key >> n;", "key/u64", "TRAIL-4"),
        ("*trail = *trail >> n ^ 1;", "*trail = *trail >> n;", "key/u32", "TRAIL-4"),
        ("at->sibling = node->child[!right];", "at->sibling = node->child[right];", "trace/script", "REGISTER-2"),
        ("postponed = at->grand_uncle;", "postponed = at->uncle;", "trace/script", "REGISTER-2"),
        ("trailing_zeros(trail) == 3", "trailing_zeros(trail) == 4", "trace/script", "REGISTER-2"),
        ("depths[ROOT] = depth = 0;", "depths[ROOT] = 0;", "trace/script", "DEPTH-1"),
        ("return sum <= UINT32_MAX;", "return sum < UINT32_MAX;", "trace/wide", "WIDE-2"),
        ("hit < wide_nodes[best].hit || leaf < best", "true", "trace/wide", "WIDE-5"),
        ("postponed = at->child[!right];", "postponed = at->child[right];", "trace/script", "REGISTER-1"),
        ("trail = trail << 1 | both;", "trail = trail << 1;", "trace/script", "TRAIL-2"),
        ("MAX_DEPTH = 63", "MAX_DEPTH = 64", "trace/script", "CONF-3"),
        ("met_count == node_count", "met_count <= node_count", "trace/invalid", "TREE-2"),
        ("(key % (uint64_t)cells + ", "(key + ", "hash/function", "HASH-1"),
        ("leaf = word >> 30 == 3;", "leaf = word >> 31;", "hash/address", "HASH-5"),
        ("rank - rank % (uint32_t)slots > end", "rank > end", "trace/wide", "WIDE-3"),
        ("slot == NONE && at > 0", "slot == NONE && at > 1", "trace/wide", "WIDE-11"),
        ("node->key << slot_bits", "node->key << 1", "trace/wide", "WIDE-9"),
        ("int above = bit / slots,", "int above = bit / 8,", "trace/wide", "WIDE-10"),
        ("node->rank[slot] < node->rank[next]", "node->rank[slot] > node->rank[next]", "trace/wide", "WIDE-5"),
        ("MAX_LEVELS / slot_bits - 1)", "MAX_LEVELS / slot_bits)", "trace/wide", "CONF-3"),
        ("node->count == slots)", "node->count == MAX_SLOTS)", "trace/wide-invalid", "WIDE-1"),
        ("[level - 1 - bit / slots]", "[bit / slots]", "resume/wide", "WIDE-10"),
        ("[digits - 1 - bit / 4]", "[bit / 4]", "resume/wide", "WIDE-10"),
        ("is_text(next, \"backtrack\")", "false", "resume/wide", "WIDE-13"),
        ("wide_nodes[best].hit = distance;", "best = NONE;", "resume/wide", "WIDE-13"),
        ("!has_inner || node->count == 1", "!has_inner", "hash/wide", "WIDE-16"),
        ("depth > MAX_LEVELS / slot_bits)", "depth > MAX_LEVELS / slot_bits - 1)", "hash/wide", "WIDE-16"),
    ] {
        is_caught(Language::C, from, to, profile, clause);
    }
}

#[test]
fn a_mistake_in_the_python_adapter_is_caught() {
    for (from, to, profile, clause) in [
        ("return (key >> n) ^ 1,", "return (key >> n + 1) ^ 1,", "key/wide", "TRAIL-4"),
        ("(1 << depth) - 1)", "(1 << depth))", "key/u128", "TRAIL-6"),
        ("min(inner + 2, leaf + 1)", "inner + 2", "hash/keys", "HASH-3"),
        ("min(inner + 2,", "min(inner + 3,", "hash/keys", "HASH-3"),
        ("2 * marks + marked", "(2 * marks + marked) % 2**32", "trace/disjoint", "DISJOINT-1"),
        ("2 * trail + both,", "(2 * trail + both) % 2**32,", "trace/node-left", "LEFT-1"),
        ("2 * trail + both,", "(2 * trail + both) % 2**32,", "trace/node-sign", "HAPALA-1"),
        ("2 * trail + both,", "(2 * trail + both) % 2**32,", "trace/tape", "ORACLE-1"),
        ("trail &= ~marks", "trail &= ~marks % 2**32", "resume/disjoint", "DISJOINT-2"),
        ("and self.best[1] == node and (", "and (", "resume/disjoint", "DISJOINT-2"),
        ("leaves is not None and leaves < self", "(leaves or 0) < self", "trace/disjoint", "ORDER-2"),
        ("key, (1 << depth_of(key)) - 1)", "key, (1 << min(depth_of(key), 32)) - 1)", "resume/key-only", "PAUSE-4"),
        (
            "nodes = nodes_of(children)\n    if key",
            "nodes, key = nodes_of(children), key % 2**32\n    if key",
            "resume/state",
            "PAUSE-2",
        ),
        (
            "[shoot(edges, floats(ray), query) for ray in rays]",
            "[shoot(edges, floats(rays[0]), query)] * len(rays)",
            "ray/invalid",
            "EXACT-1",
        ),
        ("(key % len(cells) + entry)", "(key % len(cells) ^ entry)", "hash/lookup", "HASH-1"),
        ("self.enter(node) <= self.best[0]", "self.enter(node) <= self.best[1]", "trace/tape", "ORACLE-1"),
        (
            "if self.is_wanted(node) else None",
            "if node == 0 or self.is_wanted(node) else None",
            "trace/node-left",
            "LEFT-1",
        ),
        (
            "if self.is_wanted(node) else None",
            "if node == 0 or self.is_wanted(node) else None",
            "trace/node-sign",
            "HAPALA-1",
        ),
        (
            "counts = self.is_wanted(node) if",
            "counts = node == 0 or self.is_wanted(node) if",
            "trace/node-left",
            "SKIP-1",
        ),
        ("cells[node].get(\"enter\", 0)", "cells[node].get(\"enter\", 0) % (2**32 - 1)", "trace/tape", "ORACLE-1"),
        ("if not 0 <= tmin <= tmax:", "if not 0 <= tmin <= tmax or str(tmin) == '-0.0':", "ray/grid", "EXACT-1"),
        ("if not 0 <= tmin <= tmax:", "if not 0 <= tmin <= tmax or tmin == math.inf:", "ray/grid", "EXACT-1"),
        ("tmin <= hit[0] <= tmax:", "(tmin <= hit[0] <= tmax or tmin == math.inf):", "ray/grid", "EXACT-1"),
        (
            "for triangle in triangles for corner in triangle)",
            "for triangle in triangles for corner in triangle) or not triangles",
            "ray/grid",
            "EXACT-1",
        ),
        ("right = self.octant >>", "right = ~self.octant >>", "trace/node-sign", "HAPALA-1"),
        ("leaves < self.enter(second)", "leaves < self.enter(first)", "trace/disjoint", "DISJOINT-1"),
        ("trail &= ~marks", "trail &= marks", "trace/disjoint", "DISJOINT-2"),
        ("marks >>= climbed", "marks >>= 0", "trace/disjoint", "DISJOINT-1"),
        ("visit = next == \"visit\"", "visit = True", "resume/state", "PAUSE-1"),
        ("Reject(\"trail\")", "Reject(\"no-such-node\")", "resume/invalid", "PAUSE-5"),
        ("(1 << depth_of(key)) - 1)", "0)", "resume/key-only", "PAUSE-4"),
        ("min(u, v, w) < 0 < max(u, v, w)", "min(u, v, w) <= 0 <= max(u, v, w)", "ray/grid", "EXACT-1"),
        ("round(x / Fraction", "math.floor(x / Fraction", "ray/exact", "EXACT-1"),
        ("min(hits)  #", "min(hits, key=lambda hit: (nearest(hit[0]), hit[1]))  #", "ray/exact", "EXACT-13"),
        ("min(hits)  #", "min(hits, key=lambda hit: (hit[0], -hit[1]))  #", "ray/exact", "DET-1"),
        ("if hit and tmin <= hit[0] <= tmax", "if hit and tmin <= hit[0] < tmax", "ray/grid", "EXACT-1"),
        ("rank - rank % self.slots > self.end", "rank - rank % self.slots >= self.end", "trace/wide", "WIDE-3"),
        ("else climbed + n + 1", "else climbed + n", "trace/wide", "WIDE-11"),
        (
            "trails.append(word(trail))\n            if",
            "trails.append(word(2 * trail))\n            if",
            "trace/wide",
            "WIDE-10",
        ),
        ("(key * slots + slot, child)", "(key * slots + slot + 1, child)", "hash/wide", "WIDE-9"),
        ("children[children[node][slot]] is not None, slot", "slot, None", "trace/wide", "WIDE-6"),
        ("None if self.is_beyond(self.ranks[node][slot]) else slot", "slot", "trace/wide", "WIDE-3"),
        ("distance is None or distance > self.end", "distance is None", "resume/wide", "WIDE-3"),
        ("is_visited = next == \"backtrack\"", "is_visited = False", "resume/wide", "WIDE-13"),
        ("if inner and len(below) > 1", "if len(inner) > 1", "hash/wide", "WIDE-16"),
        (" or (not below and node != 0)", "", "trace/wide-invalid", "WIDE-1"),
    ] {
        is_caught(Language::Python, from, to, profile, clause);
    }
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
