//! References in texts: each named file of this repository exists.

use std::path::Path;

use crate::files::{read, root};

/// Folders whose files are named relative to the root.
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

/// The targets of links within the repository, each with its line and heading.
fn links(text: &str) -> Vec<(usize, &str, Option<&str>)> {
    let of_line = |(line, text)| {
        let ends = str::split(text, "](").skip(1).filter_map(|rest| rest.split_once(')'));
        ends.map(move |(to, _)| (line, to))
    };
    let all = (1..).zip(text.lines()).flat_map(of_line);
    let parts =
        all.map(|(line, to)| to.split_once('#').map_or((line, to, None), |(path, name)| (line, path, Some(name))));
    parts.filter(|(_, path, _)| !path.contains(':')).collect()
}

/// The link names of the headings of a text.
fn headings(text: &str) -> Vec<String> {
    let mut is_code = false;
    let lines = text.lines().filter(move |line| {
        is_code ^= line.starts_with("```");
        !is_code
    });
    let titles = lines.filter_map(|line| line.strip_prefix('#')).map(|line| line.trim_start_matches('#').trim());
    let name = |title: &str| {
        let kept = title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.collect::<String>().to_lowercase().replace(' ', "-")
    };
    titles.map(name).collect()
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
            // A text may name files in its own folder.
            let is_there =
                |path: &str| root().join(path).exists() || file.parent().unwrap_or(Path::new("")).join(path).exists();
            let is_linked = |path: &str, heading: Option<&str>| {
                let to = if path.is_empty() { file.clone() } else { file.parent().unwrap_or(Path::new("")).join(path) };
                let is_text = to.extension().is_some_and(|ending| ending == "md");
                to.exists() && heading.is_none_or(|name| !is_text || headings(&read(&to)).iter().any(|it| it == name))
            };
            let named = paths(&text).into_iter().filter(|(_, path)| !is_there(path));
            let linked = links(&text).into_iter().filter(|&(_, path, heading)| !is_linked(path, heading));
            let linked = linked.map(|(line, path, heading)| (line, format!("{path}#{}", heading.unwrap_or_default())));
            let file = file.strip_prefix(root()).unwrap().display();
            let named = named.map(|(line, path)| (line, path.to_owned()));
            wrong.extend(named.chain(linked).map(|(line, to)| format!("{file}:{line}: {to}")));
            // In the book, MkDocs does not accept other fences, and treats the following text as code.
            let fences = (1..).zip(text.lines()).filter_map(|(line, text)| Some((line, text.strip_prefix("```")?)));
            let odd = fences.filter(|(_, label)| folder == "docs" && !label.chars().all(char::is_alphanumeric));
            wrong.extend(odd.map(|(line, label)| format!("{file}:{line}: a fence of {label}")));
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn links_are_those_into_the_repository() {
    let text = "[a](b.md#c), [d](#e)\n[f](https://g) ![h](../i.png) f(x)";
    assert_eq!(links(text), [(1, "b.md", Some("c")), (1, "", Some("e")), (2, "../i.png", None)]);
}

#[test]
fn headings_are_named_as_links_name_them() {
    let text = "# A title\n```sh\n# no title\n```\n## `x`, of 2 _ y-z\n#  Ende";
    assert_eq!(headings(text), ["a-title", "x-of-2-_-y-z", "ende"]);
}

#[test]
fn paths_are_those_in_backticks() {
    let text = "see `src/lib.rs` and src/none.rs\n`cargo test`, `tests/none.rs`, `spec/suite/*.json`, `Case`";
    assert_eq!(paths(text), [(1, "src/lib.rs"), (2, "tests/none.rs")]);
}
