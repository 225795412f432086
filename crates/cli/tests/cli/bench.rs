//! `stackless bench` measures the chosen contestants on the chosen rays, and all exact contestants agree.

use std::path::Path;

use serde_json::Value;

use super::support::{Folder, Run, read_json, stackless};

const METHODS: [&str; 10] = [
    "stack",
    "sparse",
    "afra",
    "uncle",
    "hashed",
    "hash-only",
    "implicit-b1",
    "wide-stack",
    "wide-record",
    "wide-record-f64",
];
const KINDS: [&str; 3] = ["primary", "any", "diffuse"];

/// A run over generated scenes with few rays, and its rows.
fn bench(args: &str) -> (Run, Vec<Value>) {
    let folder = Folder::new();
    let json = folder.path("bench.json");
    let run = stackless(&format!("bench --count 300 {args} --json"), &[&json]).passes();
    assert_eq!(folder.names(), ["bench.json"]);
    (run, read_json(&json)["rows"].as_array().unwrap().clone())
}

/// Scene, rays, method and accuracy.
fn names(row: &Value) -> [&str; 4] {
    ["scene", "rays", "method", "accuracy"].map(|name| row[name].as_str().unwrap())
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name} in {row}"))
}

/// Whether the ratio is to this row. After a single round it is the ratio of the throughputs; above 1 is faster.
fn is_to(row: &Value, base: &Value) -> bool {
    (number(row, "mrays") / number(base, "mrays") / number(row, "ratio") - 1.0).abs() < 1e-9
}

#[test]
fn a_handful_is_measured_on_three_kinds_of_rays() {
    let (run, rows) = bench("soup strands --rounds 2");
    let kinds = ["soup", "strands"].into_iter().flat_map(|scene| KINDS.map(|kind| (scene, kind)));
    let expected: Vec<_> =
        kinds.flat_map(|(scene, kind)| METHODS.map(|method| [scene, kind, method, "exact"])).collect();
    assert_eq!(rows.iter().map(names).collect::<Vec<_>>(), expected);
    for rows in rows.chunks(METHODS.len()) {
        assert_eq!(rows[0]["ratio"], 1.0);
        for row in rows {
            assert!(number(row, "mrays") > 0.0 && number(row, "ratio") > 0.0, "{row}");
            assert!(number(row, "build_mtriangles") > 0.0 && number(row, "state_bytes") > 0.0, "{row}");
            // All traversals of binary trees visit equal nodes.
            let is_wide = names(row)[2].starts_with("wide");
            assert!(is_wide || row["nodes_per_ray"] == rows[0]["nodes_per_ray"], "{row}");
            assert_eq!((&row["count"], &row["judged"]), (&rows[0]["count"], &rows[0]["count"]), "{row}");
            let errors = ["false_misses", "false_hits", "wrong_primitives", "max_ulp"];
            assert!(errors.iter().all(|name| row[name].as_u64().unwrap_or(0) == 0), "{row}");
        }
    }
    // One ray for each hit of a camera ray. An occlusion ray is shorter than a diffuse ray.
    let of = |kind: &str| rows.iter().find(|row| names(row)[..2] == ["soup", kind]).unwrap();
    assert_eq!(number(of("primary"), "count"), 300.0);
    assert!(number(of("any"), "count") == number(of("diffuse"), "count") && number(of("any"), "count") < 300.0);
    assert!(number(of("any"), "nodes_per_ray") < number(of("diffuse"), "nodes_per_ray"));
    let lines: Vec<_> = run.stdout.lines().collect();
    let means = lines.iter().position(|line| line.starts_with("geometric means of")).unwrap();
    assert_eq!(lines.len() - means - 1, METHODS.len(), "{}", run.stdout);
    for (line, method) in lines[means + 1..].iter().zip(METHODS) {
        assert!(line.starts_with(method), "{line}");
    }
}

#[test]
fn what_is_asked_for_is_measured_once_each() {
    let (_, rows) = bench("soup --rounds 1 --method hashed,skip,hashed --kinds any,any --accuracy watertight,exact");
    let expected = ["watertight", "exact"].map(|accuracy| ["stack", "hashed", "skip"].map(|method| (method, accuracy)));
    let found: Vec<_> = rows.iter().map(|row| (names(row)[2], names(row)[3])).collect();
    assert_eq!(found, expected.concat());
    assert!(rows.iter().all(|row| row["rays"] == "any"));
    // All ratios are to `stack` with the first accuracy.
    assert!(rows.iter().all(|row| is_to(row, &rows[0])), "{rows:?}");
    // Fixed order takes more visits.
    assert!(number(&rows[5], "nodes_per_ray") > number(&rows[4], "nodes_per_ray"));
}

#[test]
fn the_geometric_mean_of_all_is_that_of_the_rows() {
    let (run, rows) = bench("soup --rounds 1 --method stack,afra");
    let ratios: Vec<_> = rows.iter().filter(|row| row["method"] == "afra").map(|row| number(row, "ratio")).collect();
    let line = run.stdout.lines().last().unwrap();
    let fields: Vec<_> = line.split_whitespace().collect();
    let expected = ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / 3.0;
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let printed = [3, 4, 5, 6, 7].map(|i| fields[i].parse::<f64>().unwrap());
    for (printed, expected) in printed.into_iter().zip([ratios[0], ratios[1], ratios[2], expected.exp(), least]) {
        assert!((printed - expected).abs() < 1e-3, "{line}: {expected}");
    }
}

/// Inexact contestants err on rays where rounding matters.
#[test]
fn aimed_rays_show_errors() {
    let (_, rows) = bench("soup --rounds 1 --method stack --kinds aimed --accuracy fast,exact");
    let wrong =
        |row: &Value| ["false_misses", "false_hits", "wrong_primitives"].map(|name| number(row, name)).iter().sum();
    let [fast, exact]: [f64; 2] = [wrong(&rows[0]), wrong(&rows[1])];
    assert!(fast > 0.0 && exact == 0.0, "{rows:?}");
}

#[test]
fn trees_are_measured_beside_each_other() {
    let (_, rows) = bench("soup --rounds 1 --method stack,hashed --kinds diffuse --build standard,sbvh,bounded");
    let expected = ["standard", "sbvh", "bounded"].map(|build| ["stack", "hashed"].map(|method| (build, method)));
    let found: Vec<_> = rows.iter().map(|row| (row["build"].as_str().unwrap(), names(row)[2])).collect();
    assert_eq!(found, expected.as_flattened());
    assert!(rows.iter().all(|row| is_to(row, &rows[0])));
    // Better trees are visited less.
    assert!(number(&rows[2], "nodes_per_ray") < number(&rows[4], "nodes_per_ray"));
    let run = stackless("bench soup --build bvh", &[]);
    assert!(run.code == Some(2) && run.stderr.contains("standard, best, sbvh, bounded, median"), "{run:?}");
}

#[test]
fn rays_that_meet_nothing_are_said_to_be_missing() {
    let folder = Folder::new();
    // A single triangle that the camera sees: bounced rays exist, but miss.
    let scene = folder.file("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = stackless("bench --count 100 --rounds 1 --method stack", &[&scene]).passes();
    assert!(run.stdout.contains("diffuse"), "{}", run.stdout);
    // A triangle that cannot be hit.
    let scene = folder.file("none.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    let run = stackless("bench --count 100 --rounds 1 --method stack", &[&scene]).passes();
    assert!(run.stdout.contains("none, diffuse: no rays") && run.stdout.contains("none, any: no rays"), "{run:?}");
}

#[test]
fn peers_are_measured_where_they_are_built_in() {
    if !cfg!(feature = "peers") {
        let run = stackless("bench soup --count 10 --rounds 1 --peers", &[]);
        run.fails_naming(&["--peers", "feature `peers`"]);
        return;
    }
    let run = stackless("bench soup --count 10 --rounds 1 --peers --accuracy fast", &[]);
    run.fails_naming(&["--peers", "exact"]);
    let (_, rows) = bench("soup --rounds 1 --method stack --accuracy fast,exact --peers");
    for kind in KINDS {
        let of_kind: Vec<_> = rows.iter().filter(|row| row["rays"] == kind).collect();
        let peers: Vec<_> = of_kind.iter().filter(|row| row["accuracy"] == "own").collect();
        for name in ["obvhs-bvh2", "obvhs-cwbvh", "bvh", "parry3d"] {
            assert_eq!(peers.iter().filter(|row| row["method"] == name).count(), 1, "{name}");
        }
        let exact_stack = of_kind.iter().find(|row| names(row)[2..] == ["stack", "exact"]).unwrap();
        for row in peers {
            assert!(is_to(row, exact_stack), "{row} {exact_stack}");
            assert_eq!(row["judged"], row["count"], "{row}");
            assert!(row["nodes_per_ray"].is_null() && number(row, "build_mtriangles") > 0.0, "{row}");
            // Peers find most hits, independent of their accuracy.
            let errors = ["false_misses", "false_hits", "wrong_primitives"].map(|name| number(row, name));
            assert!(errors.iter().sum::<f64>() < 0.1 * number(row, "judged"), "{row}");
        }
    }
}

#[test]
fn a_file_that_cannot_be_written() {
    let run = stackless("bench soup --count 10 --rounds 1 --method stack --json", &[Path::new("missing/a.json")]);
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.stderr.starts_with("error: ") && run.stderr.contains("missing/a.json"), "{run:?}");
}
