//! `stackless stats`: the figures are consistent, and the plan has reasons for omitted parts.

use serde_json::Value;
use stackless_bvh::trace::Need;

use super::support::{Folder, read_json, stackless};

fn stats(args: &str, folder: &Folder) -> Value {
    let json = folder.path("stats.json");
    stackless(&format!("stats {args} --count 2000 --json"), &[&json]).passes();
    read_json(&json)
}

#[test]
fn which_tracer_serves_is_said_with_its_reason() {
    let folder = Folder::new();
    let json = folder.path("stats.json");
    let brief = stackless("stats soup --count 2000", &[]).passes().stdout;
    assert_eq!(brief.lines().count(), 6, "{brief}");
    let omitted = brief.lines().find(|line| line.starts_with("omitted, ")).unwrap();
    for text in ["any hit: perfect hash ", ", weights ", "; closest hit: ", ", exact tests of all ", "; all hits: "] {
        assert!(omitted.contains(text), "{omitted}");
    }
    let said = stackless("stats soup --count 2000 -v --json", &[&json]).passes().stdout;
    let line = said.lines().find(|line| line.starts_with("default: ")).unwrap();
    assert!(line.starts_with("default: Tracer by wide-record over standard. It is exact"), "{line}");
    let choice = &read_json(&json)["wide"]["choice"];
    let otherwise = choice["otherwise"].as_array().unwrap();
    assert_eq!(otherwise.len(), Need::ALL.len());
    for (row, need) in otherwise.iter().zip(Need::ALL) {
        assert_eq!(*row, serde_json::json!([need.name(), "BinaryTracer", need.reason()]));
        assert!(said.contains(need.reason()), "{said}");
    }
}

#[test]
fn degenerate_triangles_and_parts_are_counted() {
    let folder = Folder::new();
    let flat = folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n");
    let counted = stats(flat.to_str().unwrap(), &folder);
    assert_eq!((&counted["dropped"], &counted["duplicates"]), (&2.into(), &0.into()));
    let split = stats("stadium --build sbvh", &folder);
    assert!(split["duplicates"].as_u64().unwrap() > 0);

    // The plan of the default tracer follows scene and query.
    let far = 3_u128 << 125;
    let huge = folder.file("huge.obj", format!("v 0 0 0\nv {far} 0 0\nv 0 {far} 0\nf 1 2 3\n"));
    let huge = stats(huge.to_str().unwrap(), &folder);
    for query in ["any hit", "closest hit", "all hits"] {
        let is_all = query == "all hits";
        for (stats, part, skipped) in [
            (&counted, "perfect hash", true),
            (&counted, "weights", !is_all),
            (&counted, "degenerate triangles", true),
            (&huge, "degenerate triangles", false),
            (&counted, "watch for repeats", true),
            (&counted, "exact tests of all", true),
            (&huge, "exact tests of all", false),
            (&counted, "entries of all rays", true),
            (&huge, "entries of all rays", false),
        ] {
            let mut rows = stats["wide"]["plan"].as_array().unwrap().iter();
            let row = rows.find(|row| row["query"] == query && row["part"] == part).unwrap();
            assert_eq!(row["skipped"], skipped, "{row}");
            // Only queries for all hits watch for repeats.
            let is_measured = skipped && (part != "watch for repeats" || is_all);
            assert_eq!(row["time_ratio"].as_f64().is_some_and(|ratio| ratio > 0.0), is_measured, "{row}");
            if part == "degenerate triangles" && skipped {
                assert_eq!(row["reason"], "2 triangles have no area");
            }
            if part == "perfect hash" {
                assert!(row["saved_bytes"].as_u64().unwrap() > 0, "{row}");
            }
        }
    }
}
