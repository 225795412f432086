//! The additional options of `lab` for `check`, `stress`, `explain`, `bench` and figures.

use std::path::Path;

use stackless_bvh::generate::Family;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{CaseOptions, Plan, check_random};

use super::lab;
use super::support::{Folder, data, read_json};

/// The counts of `check` are those of the library.
fn assert_same(args: &str, plan: &Plan) {
    let folder = Folder::new();
    let json = folder.path("counts.json");
    lab(&format!("check {args} --json"), &[&json]).passes();
    let (tally, found) = check_random(plan, 0..plan.trees, &|_| ());
    assert!(found.is_none());
    let counts = read_json(&json);
    let rows = counts["rows"].as_array().unwrap();
    assert_eq!(rows.len(), plan.pairs().len());
    for (row, (method, word)) in rows.iter().zip(plan.pairs()) {
        let count = tally.get(method, word);
        assert_eq!((&row["cases"], &row["steps"]), (&count.cases.into(), &count.steps.into()), "{method} {word}");
        assert_eq!(row["refused"], count.refused, "{method} {word}");
    }
}

fn plan(trees: u64) -> Plan {
    let options = CaseOptions::default();
    Plan { trees, seed: 1, options, methods: Method::ALL.to_vec(), words: WordName::ALL.to_vec() }
}

#[test]
fn families_and_depths() {
    for family in Family::ALL {
        let options = CaseOptions { family: Some(family), depth: Some(9) };
        assert_same(&format!("--trees 40 --family {family} --depth 9"), &Plan { options, ..plan(40) });
    }
    let options = CaseOptions { family: Some(Family::Skew), depth: None };
    assert_same("--trees 40 --family skew", &Plan { options, ..plan(40) });
    let options = CaseOptions { family: None, depth: Some(70) };
    assert_same("--trees 40 --depth 70", &Plan { options, ..plan(40) });
}

#[test]
fn words() {
    for word in WordName::ALL {
        assert_same(&format!("--trees 30 --word {word}"), &Plan { words: vec![word], ..plan(30) });
    }
}

#[test]
fn a_comb_of_depth_100_000() {
    const COMB: &str = "check --family comb --depth 100000 --trees 1";
    let run = lab(&format!("{COMB} --word grow --method sparse,afra,uncle,hashed,stack"), &[]).passes();
    assert_eq!(run.first_line(), "pass: 1 tree, 0 rays, 5 methods, 0 disagreements");
    for (word, width) in [("u32", 32), ("u64", 64), ("u128", 128)] {
        for (methods, limit) in [("sparse", width - 1), ("hashed", width - 1), ("afra", width), ("uncle,sparse", width)]
        {
            let limit = format!("in {word} carries at most {limit}");
            let run = lab(&format!("{COMB} --word {word} --method {methods}"), &[]);
            run.fails_naming(&["the tree is 100000 edges deep", &limit]);
        }
    }
    // Traversals without words run; refusals are printed.
    let run = lab(&format!("{COMB} --word u32 --method stack,sparse"), &[]).passes();
    assert!(run.stdout.contains("refused before the first step, e.g. sparse u32: the tree is 100000 edges deep"));
}

/// Single precision has half a unit there.
#[test]
fn scenes_are_moved() {
    let cube = data("cube.ply");
    for moved in ["6.4e6,-6.4e6,6.4e6", "-3,0,1e10"] {
        let args = format!("check --count 60 --method stack,hashed --word u64 --double --moved {moved}");
        let run = lab(&args, &[&cube]).passes();
        assert_eq!(run.first_line(), "pass: 3 trees, 180 rays, 2 methods, 0 disagreements");
    }
    // So far away that all corners coincide, which is printed.
    let run = lab("check --count 60 --method stack --double --moved 1e20,1e20,1e20", &[&cube]);
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(run.stderr.contains("cube: 12 of 12 triangles have no area: rays miss them"), "{run:?}");
}

#[test]
fn what_cannot_be_is_refused() {
    for (args, what) in [
        ("check --word u16", "possible values: u32, u64, u128, grow"),
        ("check --family oak", "possible values: catalan, "),
        ("check --depth -1", "-1"),
        ("check soup --family comb", "--trees"),
        ("check soup --depth 9", "--trees"),
        ("check --trees 0 --family comb", "--trees"),
        ("check --leaves 3 --depth 2", "cannot be used"),
        ("check --moved 1,2,3", "--double"),
        ("check --double --moved 1,2", "expected X,Y,Z: three finite numbers"),
        ("check --double --moved 1,2,inf", "expected X,Y,Z: three finite numbers"),
        ("boxes many", "many"),
        ("boxes 0", "0 is not in 1.."),
        ("boxes 18446744073709551615", "is not in"),
        ("accuracy soup --count 4294967295", "is not in"),
        ("figure 2 soup -o -", "possible values: 1, 7, 8"),
        ("explain --wide 3 --tape 1 -o -", "--wide 3: expected 2, 4 or 8"),
        ("explain --tape 1 --suite-case a -o -", "cannot be used"),
    ] {
        let run = lab(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
}

#[test]
fn no_box_is_skipped_by_the_directed_test() {
    let boxes = lab("boxes 20000 --seed 3", &[]).passes().stdout;
    let directed = boxes.lines().find(|line| line.starts_with("directed")).unwrap();
    assert_eq!(directed.split_whitespace().nth(1), Some("0"), "{boxes}");
}

#[test]
fn all_pairs_of_tests_are_stressed() {
    let folder = Folder::new();
    let json = folder.path("errors.json");
    lab("stress --count 9 --cases edge --method stack --all-tests --json", &[&json]).passes();
    let rows = read_json(&json)["rows"].as_array().unwrap().clone();
    assert!(rows.iter().any(|row| row["accuracy"] == "moller-32 + plain"), "{rows:?}");
}

#[test]
fn tapes_are_shown() {
    let page = |args: &str| lab(&format!("-q explain {args} -o -"), &[]).passes().stdout;
    assert!(page("--tape 7 --method sparse,hashed").contains("Tape 7"));
    assert!(page("--tape 3 --wide 4 --method wide-trail").contains("Tape 3, up to 4 children"));
}

#[test]
fn figures_are_drawn() {
    let folder = Folder::new();
    for (figure, panels) in [("1", 3), ("7", 2), ("8 --spp 2", 2)] {
        let png = folder.path("figure.png");
        let run = lab(&format!("figure {figure} --size 24"), &[Path::new("strands"), Path::new("-o"), &png]).passes();
        assert_eq!(run.stdout.lines().count(), panels, "{run:?}");
        assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
    }
    let [usual, one, four] = ["", "--spp 1", "--spp 4"].map(|samples| {
        let png = folder.path("figure.png");
        lab(&format!("figure 1 --size 24 {samples}"), &[Path::new("strands"), Path::new("-o"), &png]).passes();
        std::fs::read(&png).unwrap()
    });
    assert!(usual == one && usual != four);
}

#[test]
fn double_precision_is_timed_in_all_places() {
    let folder = Folder::new();
    let json = folder.path("bench.json");
    lab("bench soup --count 100 --rounds 1 --method wide-record --one-by-one --double --json", &[&json]).passes();
    let rows = read_json(&json)["rows"].as_array().unwrap().clone();
    let names: Vec<_> = rows.iter().take(8).map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(names[..4], ["stack", "wide-record", "wide-record-f64", "f64 at 6.4e6"]);
}
