//! `stackless check`: the options work, and the counts are those of the library.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{CaseOptions, Plan, Tally, check_random};

use super::support::{Folder, data, read_json, stackless};

/// Runs `check`, and returns the first line and the file of `--json`.
fn check(args: &str, scenes: &[&Path]) -> (String, Value) {
    let folder = Folder::new();
    let json = folder.path("counts.json");
    let paths: Vec<_> = [json.as_path()].into_iter().chain(scenes.iter().copied()).collect();
    let run = stackless(&format!("check -v {args} --json"), &paths).passes();
    assert_eq!(folder.names(), ["counts.json"]);
    let mut counts = read_json(&json);
    // Times differ.
    counts["run"].as_object_mut().unwrap().remove("machines").unwrap();
    let said = run.first_line().replace(',', "").replace("tree ", "trees ").replace("method ", "methods ");
    let [trees, rays, methods] = ["trees", "rays", "methods"].map(|name| &counts[name]);
    assert_eq!(said, format!("pass: {trees} trees {rays} rays {methods} methods 0 disagreements"));
    (run.stdout, counts)
}

fn plan(trees: u64) -> Plan {
    let options = CaseOptions::default();
    Plan { trees, seed: 1, options, methods: Method::ALL.to_vec(), words: WordName::ALL.to_vec() }
}

/// The rows of the file are those of a tally, in order.
fn assert_rows(counts: &Value, plan: &Plan, tally: &Tally) {
    let rows = counts["rows"].as_array().unwrap();
    assert_eq!(rows.len(), plan.pairs().len());
    for (row, (method, word)) in rows.iter().zip(plan.pairs()) {
        let count = tally.get(method, word);
        assert_eq!(row["method"], method.name());
        assert_eq!(row["word"], if method.has_words() { word.name() } else { "-" });
        assert_eq!(row["cases"], count.cases, "{method} {word}");
        assert_eq!(row["agree"], count.cases, "{method} {word}");
        assert_eq!(row["refused"], count.refused, "{method} {word}");
        assert_eq!(row["steps"], count.steps, "{method} {word}");
        assert!(row["state_bytes"].as_u64().unwrap() >= 4);
    }
}

fn assert_same(args: &str, plan: &Plan) {
    let (stdout, counts) = check(args, &[]);
    let (tally, found) = check_random(plan, 0..plan.trees, &|_| ());
    assert!(found.is_none());
    assert_eq!(counts["trees"], plan.trees);
    assert_eq!(counts["rays"], 0);
    let methods: BTreeSet<_> = plan.pairs().into_iter().map(|(method, _)| method.name()).collect();
    assert_eq!(counts["methods"], methods.len());
    assert_eq!((&counts["disagreements"], &counts["smallest"]), (&0.into(), &Value::Null));
    assert_rows(&counts, plan, &tally);
    for method in Method::ALL {
        let is_listed = stdout.lines().any(|line| line.split_whitespace().next() == Some(method.name()));
        assert_eq!(is_listed, plan.pairs().iter().any(|&(listed, _)| listed == method), "{method}");
    }
}

#[test]
fn two_thousand_trees() {
    assert_same("--trees 2000", &plan(2000));
    let (stdout, counts) = check("--trees 50 --method hashed,afra-disjoint,stack", &[]);
    assert!(counts["resumes"].as_u64().unwrap() > 10_000, "{}", counts["resumes"]);
    assert!(stdout.contains("paused and resumed: "));
    // Stacks are not paused.
    assert_eq!(check("--trees 50 --method stack", &[]).1["resumes"], 0);
}

/// The number of cases matches the formula, for every traversal and word that supports them.
#[test]
fn all_small_trees() {
    let (_, counts) = check("--leaves 6", &[]);
    assert_eq!((&counts["trees"], &counts["disagreements"]), (&25_897.into(), &0.into()));
    for row in counts["rows"].as_array().unwrap() {
        let [cases, refused] = ["cases", "refused"].map(|name| row[name].as_u64().unwrap());
        assert_eq!(cases + refused, 25_897, "{row}");
        assert!(row["method"] == "complete" || refused == 0, "{row}");
    }
    for (args, what) in
        [("--leaves 0", "1..=18"), ("--leaves 19", "1..=18"), ("--leaves 3 --trees 5", "cannot be used")]
    {
        let run = stackless(&format!("check {args}"), &[]);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.stderr.contains(what), "{run:?}");
    }
}

#[test]
fn methods() {
    let methods = vec![Method::Uncle, Method::Laine4, Method::Stack];
    assert_same("--trees 30 --method uncle,laine-4,stack", &Plan { methods, ..plan(30) });
}

#[test]
fn a_seed_is_repeated_and_another_differs() {
    let (first, counts) = check("--trees 300 --seed 7", &[]);
    let (again, same) = check("--trees 300 --seed 7", &[]);
    assert_eq!((first, &counts), (again, &same));
    let (_, other) = check("--trees 300 --seed 100000", &[]);
    assert_ne!(counts["rows"][0]["steps"], other["rows"][0]["steps"]);
    assert_same("--trees 300 --seed 100000", &Plan { seed: 100_000, ..plan(300) });
}

#[test]
fn scenes() {
    let (cube_ply, cube_obj) = (data("cube.ply"), data("cube.obj"));
    let (_, counts) = check("--count 60", &[&cube_ply, &cube_obj]);
    // Each scene under three trees, each ray as a closest-hit and as an any-hit query.
    assert_eq!(
        (&counts["trees"], &counts["rays"], &counts["methods"]),
        (&6.into(), &360.into(), &Method::ALL.len().into())
    );
    for row in counts["rows"].as_array().unwrap() {
        let all = row["cases"].as_u64().unwrap() + row["refused"].as_u64().unwrap();
        assert_eq!((all, &row["agree"]), (720, &row["cases"]), "{row}");
        // A cube's tree by surface area may be complete. Traversals that prune do not run any-hit rays.
        let method: Method = row["method"].as_str().unwrap().parse().unwrap();
        let prunes = method != method.without_pruning();
        assert!(method == Method::Complete || row["refused"] == if prunes { 360 } else { 0 }, "{row}");
    }
    let (_, more) = check("--count 60 --trees 25 --method hashed", &[&cube_ply]);
    assert_eq!((&more["trees"], &more["rays"], &more["rows"][0]["cases"]), (&28.into(), &180.into(), &385.into()));
    for made in ["strands", "stadium", "soup"] {
        let (_, counts) = check("--count 40 --method stack,hashed,complete", &[Path::new(made)]);
        assert_eq!((&counts["trees"], &counts["rays"], &counts["disagreements"]), (&3.into(), &120.into(), &0.into()));
    }
}

#[test]
fn scenes_in_double_precision() {
    let cube = data("cube.ply");
    let (_, counts) = check("--count 60 --method stack,hashed --double", &[&cube]);
    assert_eq!((&counts["trees"], &counts["rays"], &counts["disagreements"]), (&3.into(), &180.into(), &0.into()));
    assert_eq!(counts["run"]["asked"]["double"], true);
    let run = stackless("check --count 40 --method stack --double --trees 3", &[]);
    assert_eq!(
        run.first_line(),
        "pass: 12 trees, 360 rays, 1 method, 0 disagreements",
        "three trees, and three scenes"
    );
    let run = stackless("check --double --replay case.json", &[]);
    assert!(run.code == Some(2) && run.stderr.contains("cannot be used"), "{run:?}");
}
