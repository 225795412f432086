//! The fast check of the list: every bug applies and names a clause.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::bug::Bug;
use crate::edit::Source;

/// Returns the faults of the bugs, one line each.
pub(crate) fn faults(root: &Path, bugs: &[Bug]) -> Vec<String> {
    let mut faults = Vec::new();
    let clauses = clauses(&root.join("spec"));
    let mut names = BTreeSet::new();
    for bug in bugs {
        if !names.insert(&bug.name) {
            faults.push(format!("{}: the name occurs twice, expected once", bug.place()));
        }
        if !clauses.contains(&bug.clause) {
            faults.push(format!("{}: clause {} is not in spec/, expected an existing clause", bug.place(), bug.clause));
        }
        if bug.survives.as_ref().is_some_and(|reason| reason.trim().is_empty()) {
            faults.push(format!("{}: survives is empty, expected a reason", bug.place()));
        }
    }
    for (file, numbered) in by_file(bugs) {
        faults.extend(faults_of_file(root, file, &numbered));
    }
    faults
}

/// The bugs of each file with their numbers, which begin at 1.
pub(crate) fn by_file(bugs: &[Bug]) -> BTreeMap<&str, Vec<(usize, &Bug)>> {
    let mut files = BTreeMap::<_, Vec<_>>::new();
    for (number, bug) in (1..).zip(bugs) {
        files.entry(bug.file.as_str()).or_default().push((number, bug));
    }
    files
}

fn faults_of_file(root: &Path, file: &str, bugs: &[(usize, &Bug)]) -> Vec<String> {
    let all = |what: String| bugs.iter().map(|(_, bug)| format!("{}: {file}: {what}", bug.place())).collect();
    if !file.starts_with("src/") {
        return all("expected a file under src/".into());
    }
    let text = match fs::read_to_string(root.join(file)) {
        Ok(text) => text,
        Err(error) => return all(error.to_string()),
    };
    let source = match Source::parse(&text) {
        Ok(source) => source,
        Err(error) => return all(error.to_string()),
    };
    let (mut faults, mut edits) = (Vec::new(), Vec::new());
    for &(number, bug) in bugs {
        match source.edit(number, bug) {
            Ok(edit) if edits.iter().any(|other| edit.overlaps(other)) => {
                faults.push(format!("{}: {file}: the edit is nested in the edit of another bug", bug.place()));
            }
            Ok(edit) => edits.push(edit),
            Err(error) => faults.push(format!("{}: {file}: {error}", bug.place())),
        }
    }
    faults
}

/// The ids of all clauses: paragraphs that begin with `**[ID] Title.**`.
fn clauses(spec: &Path) -> BTreeSet<String> {
    let (mut ids, mut folders) = (BTreeSet::new(), vec![PathBuf::from(spec)]);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                let text = fs::read_to_string(&path).unwrap_or_default();
                let heads = text.lines().filter_map(|line| line.strip_prefix("**[")?.split_once("] "));
                ids.extend(heads.map(|(id, _)| id.to_owned()));
            }
        }
    }
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
    }

    #[test]
    fn every_bug_applies_and_names_a_clause() {
        let bugs = Bug::all(&root()).unwrap();
        let faults = faults(&root(), &bugs);
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }

    #[test]
    fn faults_name_the_bug_and_the_file() {
        let mut bugs = Bug::all(&root()).unwrap();
        bugs.truncate(1);
        let first = bugs[0].clone();
        bugs.push(Bug { clause: "NO-1".into(), ..first.clone() });
        bugs.push(Bug { name: "two".into(), old: "no such text".into(), ..first.clone() });
        bugs.push(Bug { name: "three".into(), file: "README.md".into(), survives: Some(" ".into()), ..first.clone() });
        bugs.push(Bug { name: "four".into(), file: "src/none.rs".into(), ..first });
        let faults = faults(&root(), &bugs).join("\n");
        for text in [
            "the name occurs twice",
            "clause NO-1 is not in spec/",
            "\"two\": src/",
            "old occurs 0 times, expected once",
            "\"three\": README.md: expected a file under src/",
            "survives is empty",
            "\"four\": src/none.rs: No such file",
        ] {
            assert!(faults.contains(text), "{text} is missing in\n{faults}");
        }
    }
}
