//! `lab accuracy`: all pairs of tests are measured, exact pairs do not err, and files have the counts.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;
use stackless_bvh::internals::trace::{KernelName, SlabsName};

use super::lab;
use super::support::{Folder, data, read_json};

const PAIRS: usize = KernelName::ALL.len() * SlabsName::ALL.len();
const ERRORS: [&str; 5] = ["false_misses", "false_hits", "wrong_primitives", "order_differences", "leaks"];

fn is_exact(row: &Value) -> bool {
    row["kernel"].as_str().unwrap().starts_with("exact") && row["box"] == "directed"
}

/// Sum of a number over the chosen rows.
fn sum(rows: &[Value], name: &str, choose: impl Fn(&Value) -> bool) -> u64 {
    rows.iter().filter(|row| choose(row)).filter_map(|row| row[name].as_u64()).sum()
}

/// The rows of the table under a title: from its header to the next empty line or title.
fn table<'a>(stdout: &'a str, title: &str) -> Vec<&'a str> {
    stdout.lines().skip_while(|line| !line.starts_with(title)).skip(2).take(PAIRS).collect()
}

#[test]
fn a_mesh_is_timed_and_judged() {
    let folder = Folder::new();
    let [json, svg] = ["rows.json", "picture.svg"].map(|name| folder.path(name));
    let paths = [Path::new("--json"), &json, Path::new("--plot"), &svg, &data("cube.ply")];
    let run = lab("accuracy --count 500 --rounds 1", &paths).passes();
    assert_eq!(folder.names(), ["picture.svg", "rows.json"]);

    let record = read_json(&json);
    let rows = record["rows"].as_array().unwrap();
    assert_eq!(record["run"]["command"], "accuracy");
    assert!(!record["run"]["machines"].as_object().unwrap().is_empty());
    let names = |row: &Value| ["set", "kernel", "box"].map(|name| row[name].as_str().unwrap().to_owned());
    assert_eq!(rows.len(), 5 * PAIRS);
    assert_eq!(rows.iter().map(names).collect::<BTreeSet<_>>().len(), rows.len());
    for row in rows {
        let (rays, hits) = (row["rays"].as_u64().unwrap(), row["hits"].as_u64().unwrap());
        assert_eq!(row["scene"], "cube");
        // No ray bounces back to a cube from outside.
        let leaves = row["kind"] == "ordinary" && row["set"] != "primary";
        assert!((0 < hits) != leaves && hits <= rays && rays <= 500, "{row}");
        assert_eq!(row["kind"] == "adversarial", row["set"].as_str().unwrap().starts_with("aimed"), "{row}");
        assert!(row["ratio"].as_f64().is_some_and(|ratio| ratio > 0.0), "{row}");
        assert!(ERRORS.iter().all(|name| row[*name].as_u64().unwrap_or(0) <= rays), "{row}");
        if (row["kernel"].as_str(), row["box"].as_str()) == (Some("moller-32"), Some("plain")) {
            assert_eq!(row["ratio"], 1.0, "{row}");
        }
        if is_exact(row) {
            assert!(ERRORS.iter().all(|name| row[*name].as_u64().unwrap_or(0) == 0), "{row}");
            assert_eq!(row["max_ulp"].as_u64().unwrap_or(0), 0, "{row}");
        }
    }
    // Inexact tests do err, so the judge detects errors.
    for name in &ERRORS[..4] {
        assert!(sum(rows, name, |row| !is_exact(row)) > 0, "{name}");
    }
    assert!(rows.iter().any(|row| row["max_ulp"].as_u64() > Some(0)));

    for title in ["ordinary rays", "adversarial rays"] {
        let lines = table(&run.stdout, title);
        assert!(lines.iter().any(|line| line.starts_with('*')), "{}", run.stdout);
        let exact = lines.iter().find(|line| line.contains("directed") && line.contains(" exact ")).unwrap();
        assert_eq!(exact.matches('<').count(), 4, "{exact}");
        // How many rays that is worth.
        let is_it =
            |row: &Value| row["kernel"] == "exact" && is_exact(row) && title.starts_with(row["kind"].as_str().unwrap());
        let judged = sum(rows, "rays", is_it);
        let judged = if judged < 1000 { judged.to_string() } else { format!("{},{:03}", judged / 1000, judged % 1000) };
        assert!(exact.split_whitespace().any(|cell| cell == judged), "{judged}: {exact}");
    }
    assert!(run.stdout.contains("stages of exact"), "{}", run.stdout);
    let svg = std::fs::read_to_string(&svg).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    assert!(svg.contains("exact + directed") && svg.contains("adversarial rays"));
}

#[test]
fn counts_repeat() {
    let folder = Folder::new();
    let counts = |seed: u32| {
        let json = folder.path("rows.json");
        lab(&format!("accuracy --count 300 --rounds 1 --seed {seed} --json"), &[&json, &data("cube.ply")]).passes();
        let mut rows = read_json(&json)["rows"].as_array().unwrap().clone();
        for row in &mut rows {
            for time in ["ns_per_ray", "mrays", "ratio"] {
                row.as_object_mut().unwrap().remove(time);
            }
        }
        rows
    };
    assert_eq!(counts(7), counts(7));
    assert_ne!(counts(7), counts(8));
}

#[test]
fn closed_spheres_leak_unless_the_tests_are_exact() {
    let folder = Folder::new();
    let json = folder.path("rows.json");
    let run = lab("accuracy --count 100 --json", &[&json, Path::new("spheres")]).passes();
    let record = read_json(&json);
    let rows = record["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 6 * PAIRS);
    for row in rows {
        assert!(row["rays"].as_u64() > Some(900), "{row}");
        assert!(row["leaks"].as_u64() <= row["misses"].as_u64(), "{row}");
    }
    assert_eq!(sum(rows, "leaks", is_exact), 0);
    assert!(sum(rows, "leaks", |row| row["kernel"] == "moller-32") > 0);
    assert!(run.stdout.contains("leaks"), "{}", run.stdout);
}

/// Rounded points are often on the wrong side of their triangle, exact points never.
#[test]
fn rays_from_surfaces_begin_at_the_exact_point() {
    let folder = Folder::new();
    let (json, png) = (folder.path("rows.json"), folder.path("wrong.png"));
    let run = lab("accuracy soup --secondary --count 2000 --json", &[&json, Path::new("--picture"), &png]).passes();
    let record = read_json(&json);
    let wrong = |start: &str| {
        let row = record["rows"].as_array().unwrap().iter().find(|row| row["start"] == start).unwrap();
        assert!(row["rays"].as_u64() > Some(500), "{row}");
        row["false_shadows"].as_u64().unwrap() + row["false_light"].as_u64().unwrap()
    };
    assert!(wrong("rounded point") > 100);
    assert_eq!(wrong("exact point"), 0);
    assert!(run.stdout.contains("exact rays take"), "{}", run.stdout);
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn what_cannot_be_measured() {
    let folder = Folder::new();
    let svg = folder.path("picture.svg");
    for (args, what) in [
        ("accuracy", "SCENES"),
        ("accuracy soup --count 0", "--count"),
        ("accuracy soup --rounds none", "--rounds"),
        ("accuracy soup --picture a.png", "--secondary"),
    ] {
        let run = lab(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
    lab("accuracy soup spheres --secondary", &[]).fails_naming(&["--secondary", "spheres"]);
    lab("accuracy soup strands --secondary --picture", &[&folder.path("picture.png")])
        .fails_naming(&["--picture", "one scene"]);
    // The good scene is not measured before the bad scene fails.
    let run = lab("accuracy soup --plot", &[&svg, &folder.path("missing.ply")]);
    run.fails_naming(&["missing.ply", "cannot be read"]);
    lab("accuracy spheres --plot", &[&svg]).fails_naming(&["--plot", "spheres"]);
    let run = lab("accuracy --count 20 --rounds 1 --json", &[&folder.path("missing/rows.json"), &data("cube.ply")]);
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.stderr.contains("missing/rows.json: cannot be written"), "{run:?}");
    assert!(folder.names().is_empty());
}
