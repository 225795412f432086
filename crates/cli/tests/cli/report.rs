//! `stackless report`: the page has everything, needs nothing, and its tables are files too.

use super::support::{Folder, stackless};

#[test]
fn the_page_has_all_parts_and_needs_nothing_else() {
    let folder = Folder::new();
    let report = folder.path("deep/report");
    let run = stackless("report soup strands --count 600 --rounds 1 --pixels 16 -o", &[&report]).passes();
    assert!(run.stdout.contains("2 scenes"), "{run:?}");
    let page = std::fs::read_to_string(report.join("index.html")).unwrap();
    for part in
        ["Table 1", "Table 2", "Fig. 1", "Fig. 3", "Fig. 5", "Fig. 7", "Fig. 8", "Run time against error", "left out"]
    {
        assert!(page.contains(part), "{part}");
    }
    // What made it.
    for part in ["<dt>Command</dt><dd>stackless report soup strands --count 600", "threads, ", " UTC</dd>"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains(concat!("stackless ", env!("CARGO_PKG_VERSION"))));
    assert!(report.join("soup-plan.csv").exists() && report.join("strands-plan.csv").exists());
    // Two scenes with three heat maps each, a histogram each, and one picture of time against error.
    assert_eq!(page.matches("data:image/png;base64,").count(), 6);
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(!page.contains("<script") && !page.contains("href=\"http") && !page.contains("src=\"http"));
    // Every table of the page is a file, with as many lines.
    let mut names: Vec<_> = std::fs::read_dir(&report).unwrap().map(|file| file.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|extension| extension == "csv"));
    assert_eq!(names.len(), page.matches("<table>").count());
    let lines: usize = names.iter().map(|path| std::fs::read_to_string(path).unwrap().lines().count()).sum();
    assert_eq!(lines, page.matches("<tr>").count());
    let traversals = std::fs::read_to_string(report.join("traversals.csv")).unwrap();
    assert_eq!(traversals.lines().count(), 1 + 2 * 3 * 15, "two scenes, three kinds of rays, fifteen traversals");
}

#[test]
fn a_place_that_cannot_be_written_to_is_known_at_once() {
    let folder = Folder::new();
    let file = folder.file("file", "");
    stackless("report soup -o", &[&file.join("report")]).fails_naming(&["file"]);
    stackless("report nothing.ply -o", &[&folder.path("new")]).fails_naming(&["nothing.ply"]);
    assert_eq!(folder.names(), ["file"]);
}
