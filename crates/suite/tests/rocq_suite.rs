//! Compares the expectations of the suite with the models of spec/rocq. The cases of `trace/script` and
//! `trace/complete` with trees of up to 70 nodes become a Rocq example, which `spec/rocq/check.sh` evaluates.
//! `UPDATE=1` rewrites the file. `[ORACLE-1, TRAVERSE-1, TRAIL-4]`

use std::fs;
use std::path::Path;

use stackless_suite::{Ask, Children, Expect, SuiteCase, author};

/// Examples of larger trees would have megabytes and take minutes.
const MOST_NODES: usize = 70;

/// A key as bits.
type Bits = String;

/// Formats a number for Rocq.
fn hex(bits: &Bits) -> String {
    let padded = format!("{}{bits}", "0".repeat(bits.len().next_multiple_of(4) - bits.len()));
    let digits = padded.as_bytes().chunks(4).map(|digit| {
        let digit = digit.iter().fold(0, |digit, bit| 2 * digit + u32::from(*bit == b'1'));
        char::from_digit(digit, 16).unwrap()
    });
    format!("0x{}", digits.collect::<String>().trim_start_matches('0'))
}

/// A script for Rocq, by key.
#[derive(Default)]
struct Script {
    decisions: Vec<String>,
    /// Leaves that end the search.
    ends: Vec<String>,
}

impl Script {
    /// Converts the decisions of a subtree to Rocq.
    fn read(&mut self, children: &Children, script: &[u8], node: usize, key: &Bits) -> String {
        let positive = format!("{}%positive", hex(key));
        let Some(pair) = children[node] else {
            self.ends.extend((script[node] == b'!').then_some(positive));
            return "Leaf".to_owned();
        };
        let descent = match script[node] {
            b'L' => "Both L",
            b'R' => "Both R",
            b'l' => "Only L",
            b'r' => "Only R",
            b'n' => "Neither",
            other => panic!("{}", char::from(other)),
        };
        self.decisions.push(format!("({positive}, {descent})"));
        let [left, right] = [0, 1].map(|i| self.read(children, script, pair[i] as usize, &format!("{key}{i}")));
        format!("(Node {left} {right})")
    }
}

/// Formats the example of a case whose expectation is a trace with trails.
fn example(case: &SuiteCase, number: usize) -> String {
    let Ok(Ask::Trace(walk)) = Ask::of(&case.input) else { panic!("{}", case.id) };
    let Expect::Result(result) = &case.expect else { panic!("{}", case.id) };
    let strings = |field: &str| -> Vec<String> {
        result[field].as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_owned()).collect()
    };
    let (events, trails, mut script) = (strings("events"), strings("trails"), Script::default());
    let tree = script.read(&walk.children, walk.script.unwrap().as_bytes(), 0, &"1".to_owned());
    let visited = events.iter().filter_map(|event| event.strip_prefix("enter ").or(event.strip_prefix("leaf ")));
    let visited: Vec<_> = visited.map(|key| format!("0x{key}%positive")).collect();
    assert_eq!(visited.len(), trails.len(), "{}", case.id);
    let visits: Vec<_> = visited.iter().zip(&trails).map(|(key, trail)| format!("({key}, 0x{trail})")).collect();
    let stopped = visited.last().is_some_and(|last| script.ends.contains(last));
    format!(
        "\n(* {} *)\nExample suite_{number} : suite_seen {tree}\n  [{}]\n  [{}]\n  = suite_expected {stopped}\n  [{}].\n\
         Proof. evaluated. Qed.\n",
        case.id,
        script.decisions.join("; "),
        script.ends.join("; "),
        visits.join("; "),
    )
}

#[test]
fn what_the_suite_expects_is_what_the_models_do() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec/rocq/Suite.v");
    let mut text = String::from(
        "(** Cases of the conformance suite with what it expects. Written by crates/suite/tests/rocq_suite.rs. *)\n\n\
         Require Import List PArith NArith.\nRequire Import Tree Cases.\nImport ListNotations.\nOpen Scope N_scope.\n",
    );
    let suite = author::suite();
    let profiles = suite.cases().filter(|(profile, _)| matches!(&*profile.name(), "trace/script" | "trace/complete"));
    let mut count = 0;
    let nodes = |case: &SuiteCase| case.input["children"].as_array().map_or(0, Vec::len);
    for (_, case) in profiles.filter(|(_, case)| nodes(case) <= MOST_NODES) {
        text += &example(case, count);
        count += 1;
    }
    assert!(count >= 300, "{count}");
    if std::env::var_os("UPDATE").is_some_and(|value| value == "1") {
        fs::write(&path, &text).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap() == text, "run with UPDATE=1, and check that the models agree");
}
