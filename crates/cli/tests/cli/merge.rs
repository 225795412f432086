//! `--shard` and `stackless merge`: the parts add up to the whole, for every division.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{Folder, Run, data, read_json, stackless};

/// Runs all parts of a command, and returns their records.
fn parts(folder: &Folder, args: &str, scenes: &[&Path], count: u32) -> Vec<PathBuf> {
    let part = |index: u32| {
        let path = folder.path(&format!("{index}.json"));
        let paths: Vec<_> = [path.as_path()].into_iter().chain(scenes.iter().copied()).collect();
        stackless(&format!("{args} --shard {index}/{count} --json"), &paths).passes();
        path
    };
    (1..=count).map(part).collect()
}

fn merge(records: &[PathBuf], json: &Path) -> Run {
    let paths: Vec<_> = [json].into_iter().chain(records.iter().map(PathBuf::as_path)).collect();
    stackless("merge --json", &paths)
}

/// The content of a record, without times.
fn counts(path: &Path) -> Value {
    let mut record = read_json(path);
    assert!(record["run"].as_object_mut().unwrap().remove("machines").is_some());
    record
}

/// The second line of the output of a sum, and the other lines.
fn without_claim(said: &str) -> (&str, String) {
    let (verdict, rest) = said.split_once('\n').unwrap();
    let (claim, rest) = rest.split_once('\n').unwrap();
    (claim, format!("{verdict}\n{rest}"))
}

/// The last part of the output of a run.
fn verdict(said: &str) -> &str {
    &said[said.find("pass: ").unwrap()..]
}

/// The sum is the record of the whole run, with equal output.
fn assert_cut(args: &str, scenes: &[&Path], cuts: &[u32]) {
    let folder = Folder::new();
    let [whole, sum] = ["whole.json", "sum.json"].map(|name| folder.path(name));
    let paths: Vec<_> = [whole.as_path()].into_iter().chain(scenes.iter().copied()).collect();
    let run = stackless(&format!("{args} --json"), &paths).passes();
    for &count in cuts {
        let merged = merge(&parts(&folder, args, scenes, count), &sum).passes();
        let (claim, rest) = without_claim(&merged.stdout);
        assert!(claim.starts_with("claim: 0 of "), "{claim}");
        assert_eq!(
            claim.ends_with("all trees of up to 5 leaves, with all decisions"),
            args.contains("--leaves"),
            "{claim}"
        );
        assert_eq!(rest, verdict(&run.stdout), "{args}, {count} parts");
        assert_eq!(counts(&sum), counts(&whole), "{args}, {count} parts");
    }
}

#[test]
fn parts_of_check_add_up() {
    assert_cut("check --trees 500 --count 100", &[&data("cube.ply"), &data("cube.obj")], &[1, 7, 64]);
    assert_cut("check --leaves 5", &[], &[1, 7]);
    // Includes the trees at the limits of words, and more rays than in a block.
    assert_cut("check --method sparse,hashed --count 5000", &[], &[3]);
}

#[test]
fn parts_of_stress_add_up() {
    assert_cut("stress --count 64 --cases edge,t-junction,torus", &[], &[1, 7, 64]);
}

#[test]
fn what_is_not_one_run_is_refused() {
    let folder = Folder::new();
    let sum = folder.path("sum.json");
    let of = |args: &str, name: &str| {
        let path = folder.path(name);
        stackless(&format!("{args} --json"), &[&path]).passes();
        path
    };
    let check = "check --trees 100 --method stack";
    let [a, b, c] = [1, 2, 3].map(|i| of(&format!("{check} --shard {i}/3"), &format!("{i}.json")));
    let wide = of(&format!("{check} --shard 1/2"), "half.json");
    let seed = of(&format!("{check} --seed 2 --shard 3/3"), "seed.json");
    let stress = of("stress --count 9 --cases edge --shard 1/3", "stress.json");
    let version = folder.path("version.json");
    std::fs::write(&version, std::fs::read_to_string(&c).unwrap().replace("\"version\": \"0", "\"version\": \"7"))
        .unwrap();
    let broken = folder.path("broken.json");
    std::fs::write(&broken, "{\"run\": {\"command\": \"check\"}}").unwrap();
    let refused = |records: &[&PathBuf], what: &[&str]| {
        let records: Vec<_> = records.iter().map(|&path| path.clone()).collect();
        merge(&records, &sum).fails_naming(what);
        assert!(!sum.exists());
    };
    refused(&[&a, &c], &["33 of 100 trees are missing: 33 to 65"]);
    refused(&[&c], &["66 of 100 trees are missing: 0 to 65"]);
    refused(&[&a, &b, &c, &b], &["2.json and ", "both have trees 33 to 65"]);
    refused(&[&b, &wide, &c], &["half.json and ", "2.json both have trees 33 to 49"]);
    refused(&[&a, &b, &seed], &["seed.json: `seed` is 2, another than in ", "1.json"]);
    refused(&[&a, &b, &stress], &["stress.json: "]);
    refused(&[&a, &b, &version], &["version.json: another version of the program than in "]);
    refused(&[&a, &broken], &["broken.json: not a record: missing field `version`"]);
    refused(&[&data("cube.ply")], &["cube.ply: not JSON: ", "; expected a record"]);
    refused(&[&folder.path("none.json")], &["none.json: cannot be read"]);
    merge(&[b, a, c], &sum).passes();
}

#[test]
fn errors_of_a_part_are_those_of_the_sum() {
    let folder = Folder::new();
    let records = parts(&folder, "check --trees 20 --method stack,hashed", &[], 2);
    let mut bad = read_json(&records[1]);
    bad["disagreements"] = 3.into();
    bad["pause_fault"] = serde_json::json!({"number": 17, "found": "hashed, put aside"});
    std::fs::write(&records[1], bad.to_string()).unwrap();
    let run = merge(&records, &folder.path("sum.json"));
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stdout.contains("\nclaim: none, 3 of 20 cases went wrong\n"), "{run:?}");
    assert!(run.stdout.contains("tree 17: hashed, put aside"), "{run:?}");
    assert_eq!(run.first_line(), "FAIL: 20 trees, 0 rays, 2 methods, 3 disagreements");
}

/// Changes the record of a run in one place. `merge` refuses it, also when drawing.
fn assert_refused(folder: &Folder, record: &Value, pointer: &str, changed: Value) {
    let mut record = record.clone();
    *record.pointer_mut(pointer).unwrap() = changed;
    let file = folder.file("changed.json", record.to_string());
    let run = stackless("merge --plot", &[&folder.path("plot.svg"), &file]);
    assert_eq!(run.code, Some(2), "{pointer} {}: {run:?}", record.pointer(pointer).unwrap());
    run.fails_naming(&["changed.json"]);
}

/// The places of all numbers, except those in `asked`.
fn numbers(value: &Value, at: &str) -> Vec<String> {
    let within = |(key, value): (String, &Value)| numbers(value, &format!("{at}/{key}"));
    match value {
        Value::Number(_) => vec![at.to_owned()],
        Value::Array(values) => values.iter().enumerate().flat_map(|(i, v)| within((i.to_string(), v))).collect(),
        Value::Object(values) => {
            let counted = values.iter().filter(|(key, _)| *key != "asked");
            counted.flat_map(|(key, v)| within((key.replace('/', "~1"), v))).collect()
        }
        _ => Vec::new(),
    }
}

#[test]
fn counts_that_no_run_has_are_refused() {
    let folder = Folder::new();
    let of = |args: &str| {
        let path = folder.path("record.json");
        stackless(&format!("{args} --json"), &[&path]).passes();
        read_json(&path)
    };
    let check = of("check --trees 25 --count 10 --method stack,hashed --shard 1/1");
    let stress = of("stress --count 9 --cases edge,torus --method hashed --shard 1/1");
    for record in [&check, &stress] {
        for pointer in numbers(record, "") {
            assert_refused(&folder, record, &pointer, u64::MAX.into());
            assert_refused(&folder, record, &pointer, (-1).into());
            assert_refused(&folder, record, &pointer, 1e308.into());
        }
    }
    let totals = ["trees", "rays", "methods", "rows/0/cases", "rows/0/agree", "rows/0/refused"];
    let totals = totals.map(|name| (&check, name)).into_iter().chain([(&stress, "rows/0/rays")]);
    for (record, pointer) in totals.map(|(record, name)| (record, format!("/{name}"))) {
        let number = record.pointer(&pointer).unwrap().as_u64().unwrap();
        for changed in [Some(number + 1), number.checked_sub(1)].into_iter().flatten() {
            assert_refused(&folder, record, &pointer, changed.into());
        }
    }
    let rows = |record: &Value, change: fn(&mut Vec<Value>)| {
        let mut rows = record["rows"].as_array().unwrap().clone();
        change(&mut rows);
        assert_refused(&folder, record, "/rows", rows.into());
    };
    for record in [&check, &stress] {
        rows(record, |rows| rows.push(rows[0].clone()));
    }
    rows(&stress, |rows| drop(rows.remove(0)));
    rows(&check, |rows| rows.iter_mut().for_each(|row| row["agree"] = 0.into()));
    assert_refused(&folder, &check, "/pause_fault", serde_json::json!({"number": 17, "found": "hashed"}));
}

#[test]
fn a_key_that_stands_twice_is_refused() {
    let folder = Folder::new();
    let path = folder.path("record.json");
    stackless("check --trees 25 --method stack --json", &[&path]).passes();
    let text = std::fs::read_to_string(path).unwrap();
    for key in ["trees", "run", "seed", "command", "of", "method"] {
        let doubled = text.replacen(&format!("\"{key}\": "), &format!("\"{key}\": null, \"{key}\": "), 1);
        assert_ne!(doubled, text);
        let file = folder.file("doubled.json", doubled);
        stackless("merge", &[&file]).fails_naming(&["doubled.json: ", &format!("the key `{key}` stands twice")]);
    }
}

#[test]
fn parts_that_are_none() {
    for (shard, what) in [("0/3", "I/N"), ("4/3", "I/N"), ("1", "I/N"), ("a/b", "I/N")] {
        let run = stackless(&format!("check --trees 5 --shard {shard}"), &[]);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.stderr.contains(what), "{run:?}");
    }
    stackless("stress --count 2 --cases edge --shard 1/3", &[]).fails_naming(&["part 1/3 of the run is empty"]);
}
