//! The results, as data and as a page.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::bug::Bug;
use crate::layers::{LAYERS, Layer};
use crate::process::End;

/// The results of all bugs that ran.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Table {
    /// Duration of the build, in seconds.
    pub(crate) build_seconds: f64,
    /// Seconds of each layer without a bug.
    pub(crate) control_seconds: BTreeMap<String, f64>,
    pub(crate) rows: Vec<Row>,
}

/// One bug.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    pub(crate) bug: String,
    pub(crate) clause: String,
    pub(crate) file: String,
    /// Why no layer can catch it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) survives: Option<String>,
    /// The layers that ran, in the order in which they did.
    pub(crate) found: Vec<Found>,
}

/// The result of one layer for one bug.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Found {
    pub(crate) layer: String,
    pub(crate) verdict: Verdict,
    /// The first test that failed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) by: Option<String>,
    pub(crate) seconds: f64,
}

/// Whether a layer catches a bug. A test that does not terminate, or exhausts the memory, counts as caught.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Verdict {
    Caught,
    Timeout,
    Memory,
    Survived,
}

impl Found {
    pub(crate) fn new(layer: &Layer, end: End, seconds: f64) -> Self {
        let (verdict, by) = match end {
            End::Passed(_) => (Verdict::Survived, None),
            End::Failed(test) => (Verdict::Caught, Some(test)),
            End::TimedOut => (Verdict::Timeout, None),
            End::OutOfMemory => (Verdict::Memory, None),
        };
        Self { layer: layer.name.to_owned(), verdict, by, seconds: (seconds * 100.0).round() / 100.0 }
    }
}

impl Row {
    pub(crate) fn new(bug: &Bug, found: Vec<Found>) -> Self {
        let Bug { name, clause, file, survives, .. } = bug.clone();
        Self { bug: name, clause, file, survives, found }
    }

    /// The first layer that catches the bug.
    pub(crate) fn caught(&self) -> Option<&Found> {
        self.found.iter().find(|found| found.verdict != Verdict::Survived)
    }

    /// Seconds of all layers that ran.
    pub(crate) fn seconds(&self) -> f64 {
        self.found.iter().map(|found| found.seconds).sum()
    }
}

impl Table {
    /// Reads a table. Without a file it returns an empty table.
    pub(crate) fn read(path: &Path) -> io::Result<Self> {
        match fs::read(path) {
            Ok(bytes) => Ok(serde_json::from_slice(&bytes)?),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(error),
        }
    }

    /// The layer and the test that caught a bug.
    pub(crate) fn caught(&self, bug: &str) -> Option<(&'static Layer, &str)> {
        let found = self.rows.iter().find(|row| row.bug == bug)?.caught()?;
        let layer = LAYERS.iter().find(|layer| layer.name == found.layer)?;
        Some((layer, found.by.as_deref()?))
    }

    pub(crate) fn write(&self, path: &Path) -> io::Result<()> {
        fs::write(path, serde_json::to_string_pretty(self)? + "\n")
    }

    /// Adds rows of an earlier table for bugs that have not run since. Rows have the order of the list.
    pub(crate) fn completed(mut self, earlier: Self, bugs: &[Bug]) -> Self {
        let mut rows: BTreeMap<String, Row> = earlier.rows.into_iter().map(|row| (row.bug.clone(), row)).collect();
        rows.extend(std::mem::take(&mut self.rows).into_iter().map(|row| (row.bug.clone(), row)));
        self.rows = bugs.iter().filter_map(|bug| rows.remove(&bug.name)).collect();
        self
    }

    /// Writes the page of these bugs.
    pub(crate) fn write_page(self, folder: &Path, bugs: &[Bug]) -> io::Result<()> {
        fs::write(folder.join("README.md"), self.completed(Self::default(), bugs).page(bugs.len()))
    }

    /// The page; `bugs` is the number of bugs.
    fn page(&self, bugs: usize) -> String {
        let mut page = String::from(HEAD);
        page += &self.summary(bugs);
        let survivors: Vec<_> = self.rows.iter().filter(|row| row.caught().is_none()).collect();
        page += "\n## Survivors\n\n";
        if survivors.is_empty() {
            page += "None.\n";
        }
        for row in survivors {
            let reason = row.survives.as_deref().unwrap_or("**a test is missing**");
            let _ = writeln!(page, "- {} ({}, `{}`): {reason}", row.bug, row.clause, row.file);
        }
        page += "\n## Bugs\n\n| bug | breaks | file | caught by | test | seconds |\n|---|---|---|---|---|---:|\n";
        for row in &self.rows {
            let (layer, test) = match row.caught() {
                None => ("none", String::new()),
                Some(found) => {
                    let how = match found.verdict {
                        Verdict::Timeout => "does not end in time".to_owned(),
                        Verdict::Memory => "uses up the memory".to_owned(),
                        Verdict::Caught | Verdict::Survived => {
                            found.by.as_ref().map_or_else(String::new, |test| format!("`{test}`"))
                        }
                    };
                    (found.layer.as_str(), how)
                }
            };
            let Row { bug, clause, file, .. } = row;
            let _ = writeln!(page, "| {bug} | {clause} | `{file}` | {layer} | {test} | {:.1} |", row.seconds());
        }
        page
    }

    fn summary(&self, bugs: usize) -> String {
        let caught = self.rows.iter().filter(|row| row.caught().is_some()).count();
        let mut text = format!(
            "{} of {bugs} bugs have run to the end, and {caught} of these are caught. The build took {:.0} seconds.\n\n| layer | tests | seconds without a bug | bugs run | caught | first to catch |\n\
             |---|---|---:|---:|---:|---:|\n",
            self.rows.len(),
            self.build_seconds,
        );
        for layer in &LAYERS {
            let found = || self.rows.iter().flat_map(|row| &row.found).filter(|found| found.layer == layer.name);
            let caught = found().filter(|found| found.verdict != Verdict::Survived).count();
            let first = self.rows.iter().filter_map(Row::caught).filter(|found| found.layer == layer.name).count();
            let seconds = self.control_seconds.get(layer.name).map_or_else(String::new, |it| format!("{it:.1}"));
            let _ = writeln!(
                text,
                "| {} | {} | {seconds} | {} | {caught} | {first} |",
                layer.name,
                layer.about,
                found().count()
            );
        }
        text
    }
}

const HEAD: &str = "# Bugs in the shipped code

Each bug is one edit of the library's source: `tests/planted/*.toml`. All are compiled into one copy of the tree, and a variable of the
environment chooses one when a test program starts. `cargo run -p planted -- run` writes this page and `table.json`.
Layers run in the order of the first table, until one catches the bug.

";

#[cfg(test)]
mod tests {
    use super::*;

    fn row(bug: &str, verdict: Verdict) -> Row {
        let found = Found { layer: "unit".into(), verdict, by: None, seconds: 1.0 };
        Row { bug: bug.into(), clause: "A-1".into(), file: "src/a.rs".into(), survives: None, found: vec![found] }
    }

    #[test]
    fn survivors_are_listed_and_layers_counted() {
        let rows = vec![row("a", Verdict::Caught), row("b", Verdict::Survived), row("c", Verdict::Timeout)];
        let page = Table { rows, ..Table::default() }.page(4);
        assert!(page.contains("3 of 4 bugs have run to the end, and 2 of these are caught"), "{page}");
        assert!(page.contains("- b (A-1, `src/a.rs`): **a test is missing**"), "{page}");
        assert!(page.contains("| unit | all unit tests of the library |  | 3 | 2 | 2 |"), "{page}");
        assert!(page.contains("| c | A-1 | `src/a.rs` | unit | does not end in time | 1.0 |"), "{page}");
    }
}
