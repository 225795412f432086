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

/// Where links lead within the repository, each with its line; without the heading.
fn links(text: &str) -> Vec<(usize, &str)> {
    let of_line = |(line, text)| {
        let ends = str::split(text, "](").skip(1).filter_map(|rest| rest.split_once(')'));
        ends.map(move |(to, _)| (line, to))
    };
    let all = (1..).zip(text.lines()).flat_map(of_line);
    let paths = all.map(|(line, to)| (line, to.split('#').next().unwrap_or_default()));
    paths.filter(|(_, to)| !to.is_empty() && !to.contains(':')).collect()
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
            let is_linked = |path: &str| file.parent().is_some_and(|folder| folder.join(path).exists());
            let named = paths(&text).into_iter().filter(|(_, path)| !is_there(path));
            let linked = links(&text).into_iter().filter(|(_, path)| !is_linked(path));
            let file = file.strip_prefix(root()).unwrap().display();
            wrong.extend(named.chain(linked).map(|(line, path)| format!("{file}:{line}: {path}")));
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn links_are_those_into_the_repository() {
    let text = "[a](b.md#c), [d](#e)\n[f](https://g) ![h](../i.png) f(x)";
    assert_eq!(links(text), [(1, "b.md"), (2, "../i.png")]);
}

#[test]
fn paths_are_those_in_backticks() {
    let text = "see `src/lib.rs` and src/none.rs\n`cargo test`, `tests/none.rs`, `spec/suite/*.json`, `Case`";
    assert_eq!(paths(text), [(1, "src/lib.rs"), (2, "tests/none.rs")]);
}
