//! Records of other programs for `stackless merge`: the fuzz targets, the mutants of the adapters, the extracted
//! machines.

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{Folder, Run, data, read_json, stackless};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn merge(records: &[PathBuf]) -> Run {
    stackless("merge -v", &records.iter().map(PathBuf::as_path).collect::<Vec<_>>())
}

/// Writes a shell script with these lines.
fn script(path: &Path, lines: &str) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, format!("#!/bin/bash\n{lines}\n")).unwrap();
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

/// `fuzz/run.sh` with targets that do not fuzz: one is clean, one has a finding, one runs several processes.
#[test]
fn runs_of_fuzz_targets_add_up() {
    let folder = Folder::new();
    let at = |name: &str| folder.path(name);
    std::fs::create_dir(at("fuzz")).unwrap();
    std::fs::copy(Path::new(ROOT).join("fuzz/run.sh"), at("fuzz/run.sh")).unwrap();
    std::fs::copy(Path::new(ROOT).join("Cargo.toml"), at("Cargo.toml")).unwrap();
    script(&at("bin/cargo"), "exit 0");
    script(&at("bin/rustc"), "echo host: here");
    let says = "echo stat::number_of_executed_units: 4000; echo stat::average_exec_per_sec: 50";
    for (name, lines) in [
        ("clean", format!("touch corpus/clean/{{1,2,3}}; {says}")),
        ("wrong", format!("echo panicked at here; echo x > artifacts/wrong/crash-1; {says}; exit 77")),
        ("forked", "echo '#1234: cov: 5 ft: 6 corp: 7 exec/s: 99 oom/timeout/crash: 0/0/0'".to_owned()),
    ] {
        script(&at(&format!("target/here/release/{name}")), &lines);
        std::fs::create_dir_all(at(&format!("fuzz/seeds/{name}"))).unwrap();
        std::fs::write(at(&format!("fuzz/seeds/{name}/1")), "seed").unwrap();
    }
    let run = |args: &[&str]| {
        let path = format!("{}:{}", at("bin").display(), std::env::var("PATH").unwrap());
        let mut command = Command::new(at("fuzz/run.sh"));
        command.args(args).env("PATH", path).env("CARGO_TARGET_DIR", at("target")).env_remove("STACKLESS_COMMIT");
        command.output().unwrap()
    };
    let records = || -> Vec<PathBuf> {
        let entries = std::fs::read_dir(at("fuzz/records")).unwrap();
        entries.map(|entry| entry.unwrap().path()).collect()
    };

    let smoke = run(&["smoke", "1"]);
    assert!(!smoke.status.success(), "{smoke:?}");
    let said = String::from_utf8_lossy(&smoke.stdout);
    assert!(said.contains("clean: clean, 4000 executions, 50/s") && said.contains("wrong: failed"), "{said}");
    assert_eq!(records().len(), 3);
    let merged = merge(&records());
    assert_eq!(merged.code, Some(1), "{merged:?}");
    assert_eq!(merged.first_line(), "FAIL: 3 targets, 9,234 executions, 1 finding");
    assert!(merged.stdout.contains("\nclaim: none of a rate"), "{merged:?}");

    // Later runs: executions add up, the last corpus counts, and a repeated record counts once.
    std::fs::remove_dir_all(at("fuzz/seeds/wrong")).unwrap();
    let first = records().into_iter().find(|path| path.to_string_lossy().contains("clean")).unwrap();
    std::fs::remove_file(at("fuzz/corpus/clean/1")).unwrap();
    script(&at("target/here/release/clean"), says);
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert!(run(&["long", "clean", "1"]).status.success());
    let of_clean = || records().into_iter().filter(|path| path.to_string_lossy().contains("clean"));
    let merged = merge(&of_clean().chain([first]).collect::<Vec<_>>()).passes();
    let row: Vec<_> = merged.stdout.lines().nth(3).unwrap().split_whitespace().collect();
    assert_eq!([row[0], row[1], row[2], row[4], row[5]], ["clean", "2", "8,000", "2", "0"], "{merged:?}");

    // Runs of another version are not added.
    let other = at("other.json");
    let text = std::fs::read_to_string(of_clean().next().unwrap()).unwrap();
    std::fs::write(&other, text.replace("\"version\": \"0", "\"version\": \"7")).unwrap();
    merge(&of_clean().chain([other]).collect::<Vec<_>>()).fails_naming(&["another version of the program"]);
}

/// Mutants of the Python adapter, partly run in parts, by a program that recognises the adapter by its text.
#[test]
fn mutants_of_the_adapters_add_up() {
    if Command::new("python3").arg("--version").output().is_err() {
        println!("SKIPPED: no python3");
        return;
    }
    let folder = Folder::new();
    let program = folder.path("stackless");
    let original = Path::new(ROOT).join("spec/suite/adapters/traverse.py");
    let answer =
        format!("[[ $1 == --version ]] && echo stackless 7.0.0 || cmp -s \"${{@: -1}}\" {}", original.display());
    script(&program, &answer);
    let run = |shard: &str| {
        let path = folder.path(&format!("{}.json", shard.replace('/', "-")));
        let mut command = Command::new("python3");
        command.arg(Path::new(ROOT).join("tests/adapters/mutate.py")).args(["py", "--sample", "10", "--shard", shard]);
        let output = command.arg("--stackless").arg(&program).arg("--json").arg(&path).output().unwrap();
        assert!(path.exists(), "{output:?}");
        path
    };
    let counts = |path: &Path| {
        let mut record = read_json(path);
        record["run"].as_object_mut().unwrap().remove("machines").unwrap();
        record
    };
    let sum = folder.path("sum.json");
    let parts = ["1/2", "2/2"].map(run);
    // Some mutants are listed as equivalent, but caught by this program; then the exit code is 1.
    let code = stackless("merge --json", &[&sum, &parts[0], &parts[1]]).code;
    let whole = run("1/1");
    assert_eq!(counts(&sum), counts(&whole));
    assert_eq!(code == Some(0), counts(&sum)["stale"].as_array().unwrap().is_empty());
    assert!(merge(&[whole]).first_line().contains(": 10 mutants: "));
    merge(&[parts[0].clone()]).fails_naming(&["5 of 10 mutants are missing: 5 to 9"]);

    let with = |stale: &[&str], survivors: &[&str]| {
        let mut record = read_json(&sum);
        (record["stale"], record["survivors"]) = (stale.into(), survivors.into());
        (record["not_compiled"], record["caught"], record["timed_out"]) = (0.into(), 1.into(), 0.into());
        record["equivalent"] = (9 - survivors.len()).into();
        merge(&[folder.file("changed.json", record.to_string())])
    };
    assert!(with(&[], &[]).passes().stdout.contains("\nclaim: every mutant"));
    for (stale, survivors) in [(&["line 7"][..], &[][..]), (&[], &["line 7"])] {
        let merged = with(stale, survivors);
        assert_eq!(merged.code, Some(1), "{merged:?}");
        assert!(merged.stdout.contains("\nclaim: none, 1 of 10 mutants"), "{merged:?}");
        assert!(merged.stdout.contains("line 7"), "{merged:?}");
    }
}

#[test]
fn a_campaign_is_drawn() {
    let folder = Folder::new();
    let svg = folder.path("campaign.svg");
    let parts = [1, 2].map(|i| {
        let path = folder.path(&format!("{i}.json"));
        let args = format!("check --trees 20 --method stack --shard {i}/2 --json");
        stackless(&args, &[&path]).passes();
        path
    });
    stackless("merge --plot", &[&svg, &parts[1], &parts[0]]).passes();
    let text = std::fs::read_to_string(&svg).unwrap();
    assert!(text.starts_with("<svg") && text.contains("stackless check") && !text.contains("#AA1428"), "{text}");
    // Parts that do not fit are not drawn.
    std::fs::remove_file(&svg).unwrap();
    stackless("merge --plot", &[&svg, &parts[0]]).fails_naming(&["10 of 20 trees are missing"]);
    stackless("merge --plot", &[&svg, &data("cube.ply")]).fails_naming(&["cube.ply"]);
    assert!(!svg.exists());
}

/// A record of `differ` of spec/rocq/extract.
#[test]
fn searches_of_the_extracted_machines_add_up() {
    let folder = Folder::new();
    let part = |name: &str, done: [u64; 2], errors: u64| {
        let record = serde_json::json!({
            "run": {
                "command": "differ", "version": "0.1.0", "commit": null, "asked": { "seed": 1 },
                "parts": { "cases": { "of": 5000, "done": [done] } }, "machines": {},
            },
            "cases": done[1] - done[0], "visits": 70_000, "height": 100 + errors, "errors": errors,
            "searches": { "hashed": 4 * (done[1] - done[0]), "stack": done[1] - done[0] },
        });
        folder.file(name, record.to_string())
    };
    let [first, second, wrong] = [part("1", [0, 2000], 0), part("2", [2000, 5000], 0), part("3", [2000, 5000], 2)];
    let merged = merge(&[first.clone(), second]).passes();
    assert_eq!(merged.first_line(), "pass: 5,000 cases to height 100, 25,000 searches, 140,000 visits, 0 differ");
    assert!(merged.stdout.contains("hashed") && merged.stdout.contains("20,000"), "{merged:?}");
    let merged = merge(&[first.clone(), wrong]);
    assert_eq!(merged.code, Some(1), "{merged:?}");
    assert!(merged.first_line().ends_with("140,000 visits, 2 differ"), "{merged:?}");
    merge(&[first]).fails_naming(&["3000 of 5000 cases are missing: 2000 to 4999"]);
}
