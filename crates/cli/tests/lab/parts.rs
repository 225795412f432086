//! `lab parts`: omitted parts have reasons, and a small state saves visits.

use serde_json::Value;

use super::lab;
use super::support::{Folder, read_json};

fn parts(scene: &str, folder: &Folder) -> Value {
    let json = folder.path("parts.json");
    lab(&format!("parts {scene} --count 1000 --json"), &[&json]).passes();
    read_json(&json)
}

fn part<'v>(stats: &'v Value, query: &str, part: &str) -> &'v Value {
    let rows = stats["plan"].as_array().unwrap();
    rows.iter().find(|row| row["query"] == query && row["part"] == part).unwrap()
}

#[test]
fn the_plan_says_what_is_left_out_and_why() {
    let folder = Folder::new();
    let stats = parts("strands", &folder);
    let parts = stats["time"].as_array().unwrap();
    let methods: Vec<_> = parts.iter().map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(methods, ["stack", "sparse", "afra", "uncle", "hashed"]);
    for row in parts {
        assert!(
            ["all", "traversal", "boxes", "triangles"].iter().all(|part| row[part].as_f64().unwrap() > 0.0),
            "{row}"
        );
    }
    for query in ["any hit", "closest hit"] {
        let keys = part(&stats, query, "keys of 128 bits");
        assert!(keys["reason"].as_str().unwrap().ends_with(" levels fit in u32"), "{keys}");
        assert!(keys["skipped"] == true && keys["time_ratio"].as_f64().unwrap() > 0.0);
        assert_eq!(part(&stats, query, "perfect hash")["skipped"], false);
        assert_eq!(part(&stats, query, "degenerate triangles")["skipped"], false);
        let all = part(&stats, query, "everything above")["saved_bytes"].as_u64().unwrap();
        let own = part(&stats, query, "own boxes")["saved_bytes"].as_u64().unwrap();
        // A box of 24 bytes for each node.
        assert!(own > 0 && own.is_multiple_of(24));
        assert!(all >= own);
    }
}

#[test]
fn degenerate_triangles_are_left_out() {
    let folder = Folder::new();
    let flat = folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n");
    let counted = parts(flat.to_str().unwrap(), &folder);
    let decision = part(&counted, "any hit", "degenerate triangles");
    assert_eq!(decision["reason"], "2 triangles have no area");
    assert!(decision["saved_bytes"].as_u64().unwrap() >= 2 * 40);
}

#[test]
fn what_a_small_state_saves_is_counted() {
    let folder = Folder::new();
    let stats = parts("stadium", &folder);
    let nodes = |query: &str, way: &str| {
        let rows = stats["state"].as_array().unwrap();
        let row = rows.iter().find(|row| row["query"] == query && row["way"] == way).unwrap();
        assert!(row["boxes"].as_f64().unwrap() > 0.0 && row["triangles"].as_f64().unwrap() > 0.0, "{row}");
        row["nodes"].as_f64().unwrap()
    };
    for query in ["closest, primary", "closest, diffuse"] {
        let [none, disjoint, stored] =
            ["nothing is pruned", "disjoint intervals", "stored distances"].map(|way| nodes(query, way));
        assert!(none > disjoint && disjoint >= stored && stored > 1.0, "{none} {disjoint} {stored}");
    }
    // The traversal of the library and the traversal of the paths have equal visits on equal rays.
    assert_eq!(nodes("closest, diffuse", "nothing is pruned"), nodes("closest, diffuse", "from the root"));
    for query in ["closest, diffuse", "any, diffuse"] {
        assert!(nodes(query, "from the last hit") > 1.0);
    }
    let query = "hits one by one, primary";
    assert!(nodes(query, "from the root again") > nodes(query, "resumed"));
}
