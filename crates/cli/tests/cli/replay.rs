//! `stackless check --replay`.

use serde_json::{Value, json};
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{Case, CaseOptions, Fault, Replay};

use super::support::{Folder, stackless};

fn cases() -> impl Iterator<Item = Case> {
    (0..5).map(|seed| Case::random(seed, CaseOptions::default()))
}

#[test]
fn a_case_runs_again() {
    let folder = Folder::new();
    for case in cases() {
        let fault = Fault::Early { visits: 1, expected: 2 };
        let replay = Replay::of(&case, Method::Hashed, WordName::U64, &fault);
        let file = folder.file("case.json", serde_json::to_string(&replay).unwrap());
        let run = stackless("check -v --replay", &[&file]).passes();
        assert_eq!(run.first_line(), "pass: 1 tree, 0 rays, 1 method, 0 disagreements");
        assert!(run.stdout.lines().any(|line| line.split_whitespace().take(2).eq(["hashed", "u64"])), "{}", run.stdout);
        // The option overrides the file.
        let run = stackless("check -v --method stack,afra,sparse --replay", &[&file]).passes();
        assert_eq!(run.first_line(), "pass: 1 tree, 0 rays, 3 methods, 0 disagreements");
        assert!(run.stdout.lines().any(|line| line.split_whitespace().take(2).eq(["afra", "u64"])), "{}", run.stdout);
    }
}

#[test]
fn what_is_left_out_has_defaults() {
    let folder = Folder::new();
    let file = folder.file("case.json", r#"{"children": [[1, 2], null, null], "cells": [{}, {}, {}]}"#);
    let run = stackless("check --replay", &[&file]).passes();
    let all = Method::ALL.len();
    assert_eq!(run.first_line(), format!("pass: 1 tree, 0 rays, {all} methods, 0 disagreements"));
}

/// A sound replay with one field replaced.
fn with(field: &str, value: Value) -> String {
    let mut replay = json!({
        "children": [[1, 2], null, [3, 4], null, null],
        "cells": [{}, {}, {"enter": 3}, {"enter": 3, "hit": 7}, {"enter": 4}],
        "any": false, "octant": 3, "methods": ["hashed"], "word": "u32", "fault": "none"
    });
    replay[field] = value;
    replay.to_string()
}

#[test]
fn what_is_not_a_case_is_refused() {
    let folder = Folder::new();
    stackless("check --replay", &[&folder.file("case.json", with("octant", 7.into()))]).passes();
    stackless("check --replay", &[&folder.path("missing.json")]).fails_naming(&["missing.json"]);
    let texts = [
        (String::new(), "not JSON: "),
        ("# A page\n".to_owned(), "not JSON: "),
        ("no json".to_owned(), "line 1 column 2; expected a replay: the line of JSON that `stackless check` prints"),
        ("[1, 2, 3]".to_owned(), "not a replay: "),
        ("{\n\"children\": [null],\n\"cells\": 5}".to_owned(), "line 3"),
        (r#"{"children": [null]}"#.to_owned(), "cells"),
        (with("nosuch", 1.into()), "nosuch"),
        (with("children", json!([])), "a tree has at least one node"),
        (with("children", json!([[1, 9], null, [3, 4], null, null])), "node 0: child 9"),
        (with("children", json!([[1, 2], null, [0, 4], null, null])), "node 0 is reached a second time"),
        (with("children", json!([[1, 2], null, null, null, null])), "node 3 is not reached"),
        (with("children", json!([[1, -2], null, null])), "line 1"),
        (with("cells", json!([{}, {}, {}])), "5 nodes"),
        (with("cells", json!([{}, {}, {"enter": 3}, {"enter": 2}, {"enter": 4}])), "5 nodes"),
        (with("cells", json!([{}, {}, {"axis": 3}, {}, {}])), "5 nodes"),
        (with("cells", json!([{"enter": 1}, {}, {}, {}, {}])), "5 nodes"),
        (with("cells", json!([{}, {"enter": 5, "hit": 4}, {}, {}, {}])), "5 nodes"),
        (with("octant", 9.into()), "octant 9"),
        (with("methods", json!(["stack", "nosuch"])), "'nosuch'"),
        (with("word", "u16".into()), "'u16'"),
    ];
    for (text, what) in texts {
        let file = folder.file("bad.json", &text);
        stackless("check --replay", &[&file]).fails_naming(&["bad.json: ", what]);
    }
}
