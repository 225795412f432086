//! The command `stackless`, run as its users run it.

#[path = "cli/accuracy.rs"]
mod accuracy;
#[path = "cli/bad_input.rs"]
mod bad_input;
#[path = "cli/check.rs"]
mod check;
#[path = "cli/replay.rs"]
mod replay;
#[path = "cli/stress.rs"]
mod stress;
#[path = "cli/support.rs"]
mod support;
#[path = "cli/trace.rs"]
mod trace;

use support::{Folder, data, read_json, stackless};

#[test]
fn usage() {
    let help = stackless("--help", &[]).passes();
    for name in ["check", "trace", "bench"] {
        assert!(help.stdout.contains(name), "{}", help.stdout);
        assert!(stackless(&format!("{name} --help"), &[]).passes().stdout.contains("Usage: stackless"));
    }
    assert!(stackless("--version", &[]).passes().stdout.starts_with("stackless"));
    for (args, what) in [
        ("", "Usage: stackless"),
        ("nosuch", "nosuch"),
        ("check --nosuch", "--nosuch"),
        ("check --methods stack,nosuch", "expected one of: stack, left-first, "),
        ("check --word u16", "expected one of: u32, u64, u128, grow"),
        ("check --family oak", "expected one of: catalan, "),
        ("check --trees many", "many"),
        ("check --depth -1", "-1"),
        ("check --replay a.json --trees 5", "cannot be used with"),
        ("trace soup", "--rays"),
        ("bench", "SCENES"),
    ] {
        let run = stackless(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
}

#[test]
fn bench_measures_and_agrees() {
    let folder = Folder::new();
    let json = folder.path("bench.json");
    let run =
        stackless("bench --rays 500 --rounds 1 --methods sparse,hashed --json", &[&json, &data("cube.ply")]).passes();
    assert!(run.stdout.contains("Mrays/s"), "{}", run.stdout);
    let rows = read_json(&json);
    let methods: Vec<_> = rows.as_array().unwrap().iter().map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(methods, ["stack", "sparse", "hashed"]);
    for row in rows.as_array().unwrap() {
        assert_eq!(row["scene"], "cube");
        assert!(row["mrays"].as_f64().unwrap() > 0.0 && row["ratio"].as_f64().unwrap() > 0.0, "{row}");
        assert_eq!(row["nodes_per_ray"], rows[0]["nodes_per_ray"]);
    }
}
