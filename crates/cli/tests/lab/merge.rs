//! Parts of `lab accuracy` and `lab boxes` add up to the whole.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::lab;
use super::support::{Folder, data, read_json};

/// The content of a record, without times.
fn counts(path: &Path) -> Value {
    let mut record = read_json(path);
    assert!(record["run"].as_object_mut().unwrap().remove("machines").is_some());
    record
}

/// The parts add up to a whole of one part. Without --shard, times are also measured.
fn assert_counts_cut(args: &str, scenes: &[&Path], cuts: &[u32]) {
    let folder = Folder::new();
    let [whole, sum] = ["whole.json", "sum.json"].map(|name| folder.path(name));
    let paths: Vec<_> = [whole.as_path()].into_iter().chain(scenes.iter().copied()).collect();
    let run = lab(&format!("{args} --shard 1/1 --json"), &paths).passes();
    for &count in cuts {
        let part = |index: u32| {
            let path = folder.path(&format!("{index}.json"));
            let paths: Vec<_> = [path.as_path()].into_iter().chain(scenes.iter().copied()).collect();
            lab(&format!("{args} --shard {index}/{count} --json"), &paths).passes();
            path
        };
        let records: Vec<PathBuf> = (1..=count).map(part).collect();
        let paths: Vec<_> = [sum.as_path()].into_iter().chain(records.iter().map(PathBuf::as_path)).collect();
        let merged = lab("merge --json", &paths).passes();
        assert!(run.stdout.lines().all(|line| merged.stdout.contains(line)), "{args}, {count} parts");
        assert_eq!(counts(&sum), counts(&whole), "{args}, {count} parts");
    }
}

#[test]
fn parts_add_up() {
    assert_counts_cut("boxes 20000 --seed 5", &[], &[1, 7, 64]);
    let both = [data("cube.ply"), data("cube.obj")];
    let both: Vec<_> = both.iter().map(std::path::PathBuf::as_path).collect();
    assert_counts_cut("accuracy --count 100 --seed 3", &both, &[7, 64]);
    // More rays than in a block.
    assert_counts_cut("accuracy --count 5000", &both[..1], &[3]);
    assert_counts_cut("accuracy --secondary --count 400", &[Path::new("soup")], &[7, 64]);
    assert_counts_cut("accuracy spheres --count 20", &[], &[2]);
}

#[test]
fn counts_that_no_run_has_are_refused() {
    let folder = Folder::new();
    let path = folder.path("record.json");
    for (args, pointers) in [
        ("boxes 500", &["/rays", "/touched", "/skipped/2", "/in_vain/2"][..]),
        ("accuracy soup --count 20", &["/rows/0/rays", "/rows/0/hits", "/rows/0/false_misses"]),
        ("accuracy spheres --count 20", &["/rows/0/rays", "/rows/0/misses", "/rows/0/leaks"]),
        ("accuracy --secondary soup --count 100", &["/rows/0/rays", "/rows/0/false_light"]),
    ] {
        lab(&format!("{args} --shard 1/1 --json"), &[&path]).passes();
        let record = read_json(&path);
        for pointer in pointers {
            let mut changed = record.clone();
            *changed.pointer_mut(pointer).unwrap() = 1_000_000.into();
            let changed = folder.file("changed.json", changed.to_string());
            lab("merge", &[&changed]).fails_naming(&["changed.json: ", ", expected"]);
        }
        lab("merge", &[&path]).passes();
    }
}

#[test]
fn parts_of_accuracy_have_no_times() {
    let folder = Folder::new();
    let [part, whole] = ["part.json", "whole.json"].map(|name| folder.path(name));
    lab("accuracy --count 50 --shard 1/1 --json", &[&part, &data("cube.ply")]).passes();
    lab("accuracy --count 50 --rounds 1 --json", &[&whole, &data("cube.ply")]).passes();
    let [part, whole] = [&part, &whole].map(|path| read_json(path));
    for (part, whole) in part["rows"].as_array().unwrap().iter().zip(whole["rows"].as_array().unwrap()) {
        for name in ["ratio", "ns_per_ray", "mean_ulp", "p999_ulp"] {
            assert!(part[name].is_null(), "{name}: {part}");
        }
        // All rays are judged in each run.
        for name in ["scene", "set", "kernel", "box", "rays", "hits", "false_misses", "wrong_primitives", "max_ulp"] {
            assert_eq!(part[name], whole[name], "{name}");
        }
    }
    for option in ["--plot a.svg", "--rounds 2", "--secondary --picture a.png"] {
        let run = lab(&format!("accuracy soup --shard 1/2 {option}"), &[]);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.stderr.contains("cannot be used with"), "{run:?}");
    }
}
