//! Every work that the source or a text names by author and year is in `spec/BIBLIOGRAPHY.toml`.

use std::path::{Path, PathBuf};

use crate::files::{files, read};

/// Surnames and the year of each work.
fn works(text: &str) -> Vec<(Vec<String>, String)> {
    let field = |entry: &str, name: &str| {
        let line = entry.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" = "));
        line.unwrap_or_else(|| panic!("no {name} in {entry}")).to_owned()
    };
    let entries = text.split("[[work]]\n").skip(1);
    entries
        .map(|entry| {
            for name in ["short", "title", "venue"] {
                let value = field(entry, name);
                assert!(value.len() > 2 && value.starts_with('"') && value.ends_with('"'), "{entry}");
            }
            let authors = field(entry, "authors");
            let names = authors.trim_matches(['[', ']']).split(", ").map(|author| author.trim_matches('"'));
            (names.map(|name| name.rsplit(' ').next().unwrap_or(name).to_owned()).collect(), field(entry, "year"))
        })
        .collect()
}

/// "Name 1999", "Name (1999", "Name et al. 1999" in a text whose lines, comments or not, are read as one.
fn named(text: &str) -> Vec<(String, String)> {
    let lines = text.lines().map(|line| line.trim_start().trim_start_matches(['/', '!']));
    let text = lines.collect::<Vec<_>>().join(" ").replace(" et al.", "");
    let words: Vec<_> = text.split_whitespace().collect();
    let is_name = |word: &&str| {
        word.chars().next().is_some_and(char::is_uppercase) && word.chars().all(|c| c.is_alphabetic() || c == '-')
    };
    let year = |word: &str| {
        let word = word.strip_prefix('(').unwrap_or(word);
        let digits: String = word.chars().take_while(char::is_ascii_digit).collect();
        let is_year = digits.len() == 4 && (digits.starts_with("19") || digits.starts_with("20"));
        is_year.then_some(digits)
    };
    let pairs = words.windows(2).filter(|pair| is_name(&pair[0]));
    pairs.filter_map(|pair| Some((pair[0].to_owned(), year(pair[1])?))).collect()
}

#[test]
fn whatever_is_named_is_listed() {
    let works = works(&read(Path::new("spec/BIBLIOGRAPHY.toml")));
    let mut paths =
        ["README.md", "ARCHITECTURE.md", "benches/README.md", "gpu-check/README.md"].map(PathBuf::from).to_vec();
    for folder in ["src", "spec", "tests", "proofs", "gpu-check/src", "gpu-check/tests", "gpu-check/wgsl"] {
        paths.extend(["rs", "md", "wgsl"].into_iter().flat_map(|ending| files(folder, ending)));
    }
    let mut found = 0;
    for path in paths.iter().filter(|path| !path.ends_with("tests/project/bibliography.rs")) {
        for (name, year) in named(&read(path)) {
            let is_listed = works.iter().any(|(names, of)| names.contains(&name) && *of == year);
            assert!(is_listed, "{}: {name} {year} is not in the bibliography", path.display());
            found += 1;
        }
    }
    assert!(found > 50, "{found}");
}

#[test]
fn names_are_seen_in_every_form() {
    let text = "/// as Wald 2007,\n//! Stich, Friedrich & Dietrich\n/// (2009) by Hapala et al. 2011; in 1985 March 17";
    let names = ["Wald 2007", "Dietrich 2009", "Hapala 2011"];
    assert_eq!(named(text).iter().map(|(name, year)| format!("{name} {year}")).collect::<Vec<_>>(), names);
}
