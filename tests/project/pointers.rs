//! Where texts point: what they name of this repository is there.

use std::path::Path;

use crate::files::{read, root};

/// Folders that are named from the root.
const FOLDERS: [&str; 12] = [
    "benches/",
    "campaign/",
    "crates/",
    "docs/",
    "examples/",
    "fuzz/",
    "gpu-check/",
    "proofs/",
    "python/",
    "spec/",
    "src/",
    "tests/",
];

/// The paths in backticks that begin at the root, each with its line.
fn paths(text: &str) -> Vec<(usize, &str)> {
    let is_path = |name: &&str| {
        FOLDERS.iter().any(|folder| name.starts_with(folder))
            && name.chars().all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c))
    };
    let of_line = |(line, text)| str::split(text, '`').skip(1).step_by(2).filter(is_path).map(move |path| (line, path));
    (1..).zip(text.lines()).flat_map(of_line).collect()
}

#[test]
fn every_path_in_a_text_is_there() {
    let mut wrong = Vec::new();
    for folder in [
        "",
        "benches",
        "campaign",
        "docs",
        "fuzz",
        "gpu-check",
        "proofs",
        "python",
        "spec",
        "spec/rocq",
        "spec/suite",
        "tests",
    ] {
        for entry in std::fs::read_dir(root().join(folder)).unwrap() {
            let file = entry.unwrap().path();
            if file.extension().is_none_or(|ending| ending != "md") {
                continue;
            }
            let text = read(&file);
            // A text may name what stands beside it.
            let is_there =
                |path: &str| root().join(path).exists() || file.parent().unwrap_or(Path::new("")).join(path).exists();
            let file = file.strip_prefix(root()).unwrap().display();
            wrong.extend(
                paths(&text)
                    .iter()
                    .filter(|(_, path)| !is_there(path))
                    .map(|(line, path)| format!("{file}:{line}: {path}")),
            );
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn paths_are_those_in_backticks() {
    let text = "see `src/lib.rs` and src/none.rs\n`cargo test`, `tests/none.rs`, `spec/suite/*.json`, `Case`";
    assert_eq!(paths(text), [(1, "src/lib.rs"), (2, "tests/none.rs")]);
}
