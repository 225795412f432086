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
    assert_eq!(brief.lines().count(), 5, "{brief}");
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
}
