//! The worst cases that `stackless adversary` has found, in `tests/data/adversary`, run again: each costs what was
//! recorded, every traversal agrees with its oracle on it, and the exact tests are exact. Searches repeat, and climb.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use stackless_check::adversary::{AdversaryError, Cost, GOALS, Goal, RayCase, Search, Subject};
use stackless_check::{Case, CaseOptions, Replay};

fn file(goal: &Goal) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("tests/data/adversary")
        .join(goal.name)
        .with_extension("json")
}

fn found(goal: &Goal) -> (Subject, Option<String>) {
    goal.read(&fs::read_to_string(file(goal)).unwrap()).unwrap()
}

fn goal(name: &str) -> &'static Goal {
    Goal::named(name).unwrap()
}

#[test]
fn the_worst_cases_cost_what_was_recorded() {
    for goal in GOALS {
        let (subject, recorded) = found(goal);
        let cost = goal.cost(&subject).unwrap();
        assert_eq!(recorded, Some(format!("{goal}: {cost}")));
    }
}

/// [CONF-1] [CONF-2] [EXACT-1]
#[test]
fn all_traversals_and_exact_tests_are_right_about_the_worst_cases() {
    for goal in GOALS {
        found(goal).0.verify().unwrap_or_else(|error| panic!("{goal}: {error}"));
    }
}

#[test]
fn there_is_one_file_for_each_goal() {
    let folder = file(&GOALS[0]);
    let mut names: Vec<_> =
        fs::read_dir(folder.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path()).collect();
    let mut expected: Vec<_> = GOALS.iter().map(file).collect();
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
}

#[test]
fn a_search_repeats_and_climbs() {
    for (name, steps) in [("climb-afra", 1500), ("restarts-laine-2", 1500), ("ulps-woop", 500), ("box-tests", 300)] {
        let run = |seed| {
            let mut search = Search::new(goal(name), seed);
            let record = |_| search.step().then(|| search.worst().unwrap().cost);
            let costs: Vec<Cost> = (0..steps).filter_map(record).collect();
            (search, costs)
        };
        let (search, costs) = run(7);
        let worst = search.worst().unwrap();
        assert!(costs.is_sorted() && costs.last() == Some(&worst.cost), "{name}");
        // The first 64 are random: after them it was the climb.
        assert!(worst.step > 64 && worst.cost.ratio() > search.random_average(), "{name}");
        assert_eq!(goal(name).cost(&worst.subject), Some(worst.cost));
        let (again, same_costs) = run(7);
        assert_eq!((&again.worst().unwrap().subject, same_costs), (&worst.subject, costs));
        assert_ne!(run(8).0.worst().unwrap().subject, worst.subject);
    }
}

#[test]
fn what_is_found_stays_within_its_limits() {
    for goal in GOALS {
        match found(goal).0 {
            Subject::Tree(case) => assert!(case.size() <= 63 && !case.any, "{goal}"),
            Subject::Rays(RayCase { triangles, rays, .. }) => {
                let numbers = triangles.as_flattened().as_flattened().iter().chain(rays.as_flattened().as_flattened());
                assert!(numbers.clone().all(|x| *x == 0.0 || (2f32.powi(-20)..=1024.0).contains(&x.abs())), "{goal}");
                assert!(triangles.len() <= 16 && rays.len() <= 8, "{goal}");
            }
        }
    }
}

/// Each edge is climbed at most once, after it was descended; Hapala's automaton looks two parents up for each far
/// child. The counter and the trail climb alike.
#[test]
fn climbs_have_a_bound_that_is_nearly_met() {
    for name in ["climb-afra", "climb-sparse", "climb-hapala"] {
        let (subject, _) = found(goal(name));
        let ratio = goal(name).cost(&subject).unwrap().ratio();
        assert!(0.9 < ratio && ratio < 1.0, "{name}: {ratio}");
        assert_eq!(goal("climb-sparse").cost(&subject), goal("climb-afra").cost(&subject), "{name}");
    }
}

#[test]
fn costs_are_compared_as_fractions() {
    let cost = |count, of| Cost::new(count, of).unwrap();
    assert_eq!(Cost::new(1, 0), None);
    assert_eq!(cost(10, 11), cost(30, 33));
    assert!(cost(u64::MAX, u64::MAX - 1) > cost(u64::MAX - 1, u64::MAX - 2).min(cost(1, 1)));
    assert!(cost(u64::MAX - 1, u64::MAX) < cost(u64::MAX, u64::MAX));
    assert_eq!(cost(3, 4).to_string(), "3 of 4");
}

#[test]
fn a_file_reads_back_as_the_case() {
    let tree = goal("climb-afra");
    for seed in 0..50 {
        let subject = Subject::Tree(Case::random(seed, CaseOptions::default()));
        let cost = tree.cost(&subject).unwrap();
        let text = tree.write(&subject, cost).unwrap();
        assert_eq!(tree.read(&text).unwrap(), (subject, Some(format!("climb-afra: {cost}"))));
        assert!(serde_json::from_str::<Replay>(&text).unwrap().case().is_ok());
    }
    for goal in GOALS {
        let (subject, _) = found(goal);
        let text = goal.write(&subject, goal.cost(&subject).unwrap()).unwrap();
        assert_eq!(text, fs::read_to_string(file(goal)).unwrap().trim_end(), "{goal}");
    }
}

#[test]
fn what_is_no_case_is_refused_with_its_place() {
    let refusal = |text: &str| goal("sums").read(text).unwrap_err();
    let triangle = "[[0,0,0],[1,0,0],[0,1,0]]";
    assert!(matches!(refusal("{}"), AdversaryError::Json(_)));
    assert!(matches!(refusal(r#"{"triangles": [], "rays": []}"#), AdversaryError::Mesh(_)));
    assert!(matches!(refusal(r#"{"triangles": [], "rays": [], "more": 1}"#), AdversaryError::Json(_)));
    let flat = format!(r#"{{"triangles": [{triangle}, [[0,0,0],[1,1,1],[2,2,2]]], "rays": []}}"#);
    assert!(matches!(refusal(&flat), AdversaryError::Degenerate { triangle: 1 }));
    let still = format!(r#"{{"triangles": [{triangle}], "rays": [[[0,0,-1],[0,0,1]], [[0,0,0],[0,0,0]]]}}"#);
    assert!(matches!(refusal(&still), AdversaryError::Ray { ray: 1, .. }));
    assert!(matches!(goal("climb-afra").read("{}"), Err(AdversaryError::Json(_))));
    let case = r#"{"children": [[1, 7], null, null], "cells": [{}, {}, {}]}"#;
    assert!(matches!(goal("climb-afra").read(case), Err(AdversaryError::Replay(_))));
    // A case of the other kind has no cost.
    let (subject, _) = found(goal("sums"));
    assert_eq!(goal("climb-afra").cost(&subject), None);
}

/// [CONF-2]
#[test]
fn a_case_that_shows_an_error_is_not_verified() {
    // No ray and no triangle errs, so the error is one of the input.
    let case = RayCase { triangles: vec![[[0.0; 3]; 3]], rays: Vec::new(), found: None };
    assert!(matches!(Subject::Rays(case).verify(), Err(AdversaryError::Degenerate { triangle: 0 })));
}

#[test]
fn the_command_searches_writes_and_runs_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("worst.json");
    let run = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_stackless")).arg("adversary").args(args).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let path_text = path.to_str().unwrap();
    let (code, stdout, stderr) = run(&["restarts-laine-1", "--steps", "300", "--seed", "3", "-o", path_text]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    assert!(stdout.starts_with("restarts-laine-1: ") && stdout.contains("300 steps, seed 3"), "{stdout}");
    let written = fs::read_to_string(&path).unwrap();
    let (_, recorded) = goal("restarts-laine-1").read(&written).unwrap();
    let recorded = recorded.unwrap();
    assert!(stdout.starts_with(&recorded), "{stdout}");
    let (code, stdout, _) = run(&["restarts-laine-1", "--replay", path_text]);
    assert!(code == Some(0) && stdout.starts_with(&recorded), "{stdout}");
    // The same file is a case of `check`.
    let output = Command::new(env!("CARGO_BIN_EXE_stackless")).args(["check", "--replay", path_text]).output().unwrap();
    assert!(String::from_utf8(output.stdout).unwrap().starts_with("pass: "));
    // What cannot be run is named in one line.
    for (args, what) in [
        (&["sums", "--replay", path_text][..], "worst.json: unknown field"),
        (&["sums", "--replay", "missing.json"], "missing.json"),
        (&["sums", "--steps", "0"], "no case has a cost"),
    ] {
        let (code, stdout, stderr) = run(args);
        assert_eq!((code, stdout.as_str(), stderr.lines().count()), (Some(2), "", 1), "{stderr}");
        assert!(stderr.contains(what), "{stderr}");
    }
    let (code, _, stderr) = run(&["nosuch"]);
    assert!(code == Some(2) && stderr.contains("possible values: climb-afra"), "{stderr}");
    let (code, stdout, _) = run(&["--list"]);
    assert!(code == Some(0) && GOALS.iter().all(|goal| stdout.contains(goal.about)), "{stdout}");
}
