//! `stackless stress`, and the levels of accuracy of `stackless trace`.

use std::path::Path;

use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::internals::trace::{Accuracy, Truth};

use crate::support::{Folder, read_json, stackless};

#[test]
fn the_exact_level_has_no_errors_and_the_others_have() {
    let folder = Folder::new();
    let json = folder.path("errors.json");
    let args = "stress --count 40 --cases edge,vertex,t-junction --method stack,hashed --json";
    let run = stackless(args, &[&json]).passes();
    assert!(run.stdout.contains("\npass: 3 cases, 120 rays, exact: 0 errors\n"), "{}", run.stdout);
    let record = read_json(&json);
    let rows = record["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 3 * (Accuracy::ALL.len() + 1));
    let mut errors_of_others = 0;
    for row in rows {
        // In double precision each ray is traced in two places.
        let is_double = row["accuracy"] == "exact, double";
        assert_eq!(row["rays"], if is_double { 80 } else { 40 }, "{row}");
        let counts =
            ["false_misses", "false_hits", "wrong_primitives", "max_ulp"].map(|name| row[name].as_u64().unwrap());
        if is_double || row["accuracy"] == "exact" {
            assert_eq!(counts, [0; 4], "{row}");
        } else {
            errors_of_others += counts.iter().sum::<u64>();
        }
    }
    assert!(errors_of_others > 0);
}

/// [CONF-2]
#[test]
fn wide_traversals_are_stressed_too() {
    let folder = Folder::new();
    let json = folder.path("errors.json");
    let accuracies = |methods: &str| {
        let run = stackless(&format!("stress --count 30 --cases edge,vertex {methods} --json"), &[&json]).passes();
        assert!(run.stdout.contains("\npass: 2 cases, 60 rays, exact: 0 errors\n"), "{}", run.stdout);
        let rows = read_json(&json)["rows"].as_array().unwrap().clone();
        rows.iter().map(|row| row["accuracy"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(accuracies("--method wide-record,wide-hashed"), ["exact, wide"; 2]);
    let both = accuracies("--method wide-trail,stack");
    assert_eq!(both.iter().filter(|accuracy| *accuracy == "exact, wide").count(), 2);
    assert_eq!(both, accuracies(""));
}

#[test]
fn cases_are_listed() {
    let list = stackless("stress --list", &[]).passes().stdout;
    assert_eq!(list.lines().count(), stress::NAMES.len());
    assert!(list.lines().zip(stress::NAMES).all(|(line, name)| line.starts_with(name)), "{list}");
    for (args, what) in [
        ("stress --cases edges", "a similar value exists: 'edge'"),
        ("trace soup --accuracy best --rays a -o b", "possible values: fast, watertight, precise, exact"),
    ] {
        let run = stackless(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
}

/// On ordinary rays, all levels hit equal triangles; only `exact`, the default, has all bits right.
#[test]
fn trace_has_all_levels() {
    let mesh = procedural::soup(1, 20_000);
    let (rays, truth) = (procedural::camera_rays(&mesh, 3, 200), Truth::new(&mesh));
    let expected: Vec<_> = rays.iter().map(|ray| truth.closest(ray).map(|hit| hit.rounded())).collect();
    let prims =
        |hits: &[Option<stackless_bvh::trace::Hit>]| hits.iter().map(|hit| hit.map(|h| h.prim)).collect::<Vec<_>>();
    for level in Accuracy::ALL {
        let hits = crate::trace::trace(Path::new("soup"), &rays, &format!("--accuracy {level}"));
        let differ = prims(&hits).iter().zip(prims(&expected)).filter(|(a, b)| **a != *b).count();
        assert!(differ <= 2, "{level}: {differ}");
        assert!(level != Accuracy::Exact || hits == expected);
        assert!(level != Accuracy::Fast || hits != expected);
    }
    assert_eq!(crate::trace::trace(Path::new("soup"), &rays, ""), expected);
}
