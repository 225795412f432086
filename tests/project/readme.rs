//! The parts of texts that are printed from the source.

use std::fs;
use std::path::Path;

use stackless_bvh::traverse::Method;

use crate::files::{read, root};

/// With `UPDATE=1` in the environment, writes the text.
#[test]
fn the_table_of_traversals_is_that_of_the_source() {
    let begin = "<!-- traversals: UPDATE=1 cargo test --test project readme -->\n";
    let end = "<!-- end of traversals -->";
    let text = read(Path::new("docs/traversals.md"));
    let (before, rest) = text.split_once(begin).expect("the mark before the table");
    let (table, after) = rest.split_once(end).expect("the mark after the table");
    let expected = format!("\n{}\n", Method::markdown());
    if std::env::var_os("UPDATE").is_some() {
        fs::write(root().join("docs/traversals.md"), [before, begin, &expected, end, after].concat())
            .expect("docs/traversals.md");
    } else {
        assert_eq!(table, expected);
    }
}
