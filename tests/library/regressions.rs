//! The findings of the fuzz targets, and their seeds, through the same bodies, without a fuzzer: `fuzz/README.md`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../../fuzz/src/lib.rs"]
#[allow(unreachable_pub, reason = "it is a library of its own")]
mod targets;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz")
}

/// All inputs below a folder, with the name of their target.
fn inputs(of: &str) -> Vec<(&'static str, PathBuf)> {
    let in_folder = |name: &'static str| {
        let files = fs::read_dir(folder().join(of).join(name)).into_iter().flatten();
        files.map(move |file| (name, file.expect("a file").path()))
    };
    let mut inputs: Vec<_> = targets::TARGETS.iter().flat_map(|target| in_folder(target.name)).collect();
    inputs.sort();
    inputs
}

fn run(of: &str) -> usize {
    targets::prepare();
    let inputs = inputs(of);
    for (target, file) in &inputs {
        println!("{target} {}", file.display());
        targets::run(target, &fs::read(file).expect("a file"));
    }
    inputs.len()
}

#[test]
fn what_fuzzing_has_found_stays_mended() {
    run("regressions");
}

#[test]
fn seeds_of_every_target_are_right() {
    assert!(run("seeds") >= targets::TARGETS.len());
    let seeded: BTreeSet<_> = inputs("seeds").into_iter().map(|(target, _)| target).collect();
    assert_eq!(seeded.len(), targets::TARGETS.len());
}

#[test]
#[should_panic(expected = "no target has the name")]
fn other_targets_are_refused() {
    targets::run("nothing", &[]);
}

/// The list of targets, the manifest of cargo-fuzz, its files and the README name the same targets, and the README
/// every finding.
#[test]
fn every_target_is_built_and_told_of() {
    let text = |file: &str| fs::read_to_string(folder().join(file)).expect("a file");
    let (manifest, readme) = (text("Cargo.toml"), text("README.md"));
    for target in targets::TARGETS {
        let name = target.name;
        assert!(manifest.contains(&format!("name = \"{name}\"\npath = \"fuzz_targets/{name}.rs\"")), "{name}");
        assert!(text(&format!("fuzz_targets/{name}.rs")).contains(&format!("run(\"{name}\", bytes)")), "{name}");
        assert!(readme.contains(&format!("| `{name}` |")), "{name}");
    }
    assert_eq!(manifest.matches("[[bin]]").count(), targets::TARGETS.len());
    for (_, file) in inputs("regressions") {
        let name = file.strip_prefix(folder().join("regressions")).expect("below it").display().to_string();
        assert!(readme.contains(&format!("`{name}`")), "{name} has no story");
    }
}
