//! `tests/PLANTED.md`: a row for each planted bug, and a column for each layer of checks, which is written and compared
//! by the test that looks.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What stands in a row for a layer that does not see the bug, before the reason.
pub(crate) const NO: &str = "no: ";

/// Columns after name, clause and battery, in their order.
pub(crate) const COLUMNS: [&str; 3] = ["fuzz", "suite", "harness"];

fn file() -> PathBuf {
    let package = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    package.ancestors().map(|folder| folder.join("tests/PLANTED.md")).find(|file| file.exists()).unwrap()
}

/// The text of the file.
pub(crate) fn text() -> String {
    fs::read_to_string(file()).unwrap()
}

/// Compares the file with what is seen; `UPDATE=1` writes it.
pub(crate) fn compare(seen: &str) {
    if std::env::var_os("UPDATE").is_some() {
        fs::write(file(), seen).unwrap();
    }
    let kept = text();
    for (kept, seen) in kept.lines().zip(seen.lines()) {
        assert_eq!(kept, seen, "tests/PLANTED.md is not what is seen");
    }
    assert!(kept == seen, "tests/PLANTED.md is not as long as what is seen");
}

/// Compares a column with what is seen of each bug, by the names of [`rows`], which are to be all that have the column.
pub(crate) fn compare_column(column: &str, seen: &BTreeMap<String, String>) {
    let (mut text, mut rows) = (String::new(), rows(&text(), column));
    let mut names = rows.iter().map(|row| &row.name).collect::<Vec<_>>();
    names.sort();
    assert_eq!(names, seen.keys().collect::<Vec<_>>(), "rows with the column '{column}'");
    rows.reverse();
    for (at, line) in self::text().lines().enumerate() {
        match rows.pop_if(|row| row.line == at) {
            Some(row) => {
                let mut cells: Vec<_> = line.split(" | ").collect();
                let last = cells.len() - 1;
                let end = if row.column == last { " |" } else { "" };
                let cell = format!("{}{end}", seen[&row.name]);
                cells[row.column] = &cell;
                text += &cells.join(" | ");
            }
            None => text += line,
        }
        text += "\n";
    }
    compare(&text);
}

/// A row that has a column.
#[derive(Debug)]
pub(crate) struct Row {
    /// The bug: as it is called in a table of traversals, else after its layer and a colon.
    pub(crate) name: String,
    /// What stands in the column.
    pub(crate) cell: String,
    line: usize,
    column: usize,
}

/// The rows that have a column.
pub(crate) fn rows(text: &str, column: &str) -> Vec<Row> {
    let (mut layer, mut at, mut rows) = (String::new(), None, Vec::new());
    for (line, row) in text.lines().enumerate() {
        if let Some(section) = row.strip_prefix("## ") {
            (layer, at) = (if section == "Traversals" { String::new() } else { section.to_lowercase() + ": " }, None);
        }
        let Some(row) = row.strip_prefix("| ").and_then(|row| row.strip_suffix(" |")) else { continue };
        let cells: Vec<_> = row.split(" | ").collect();
        match at {
            None => at = Some(cells.iter().position(|&cell| cell == column)),
            Some(Some(column)) => {
                rows.push(Row { name: layer.clone() + cells[0], cell: cells[column].to_owned(), line, column });
            }
            Some(None) => {}
        }
    }
    rows
}
