//! The page, and its tables as CSV.

use std::collections::BTreeSet;
use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use stackless_cli::plots::{SERIES, escaped};

use super::Table;

/// A part of the page.
pub(super) struct Section {
    /// The scene, where it is about one.
    pub(super) scene: Option<String>,
    pub(super) title: String,
    pub(super) pieces: Vec<Piece>,
}

/// What stands in a section, one below the other. Pictures have a caption.
pub(super) enum Piece {
    Line(String),
    /// With the name of its file; in a section about a scene, that of the scene comes before it.
    Table(&'static str, Table),
    Svg(String, String),
    Png(Vec<u8>, String),
    Bars(Vec<Bar>, String),
}

/// Numbers of one thing, drawn beside each other.
pub(crate) struct Bar {
    pub(crate) label: &'static str,
    pub(crate) parts: Vec<(&'static str, f64)>,
}

impl Piece {
    pub(super) fn line(text: impl Into<String>) -> Self {
        Self::Line(text.into())
    }
}

/// Each table as a file: name and content, in order.
pub(super) fn tables(sections: &[Section]) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for (section, front) in sections.iter().zip(fronts(sections)) {
        for piece in &section.pieces {
            if let Piece::Table(name, table) = piece {
                files.push((file_name(&front, name), csv(table)));
            }
        }
    }
    files
}

/// The tables that an earlier page names.
pub(super) fn tables_of(page: &str) -> Vec<String> {
    if !page.contains(TITLE) {
        return Vec::new();
    }
    // What else a file in that place names is not ours to remove.
    let is_name =
        |name: &&str| name.strip_suffix(".csv").is_some_and(|name| name.chars().all(|c| is_safe(c) || c == '.'));
    let links = page.split(LINK).skip(1).filter_map(|rest| rest.split('"').next());
    links.filter(is_name).map(str::to_owned).collect()
}

const TITLE: &str = "<title>stackless report</title>";
/// What stands before the name of a table's file.
const LINK: &str = "<a class=\"file\" href=\"";

fn file_name(front: &str, table: &str) -> String {
    if front.is_empty() { format!("{table}.csv") } else { format!("{front}-{table}.csv") }
}

/// What the names of a section's files begin with: the name of its scene, with a number where an earlier scene has it
/// too.
fn fronts(sections: &[Section]) -> Vec<String> {
    // Some file systems take large and small letters for the same.
    let mut taken = BTreeSet::new();
    let mut front = |section: &Section| {
        let Some(scene) = &section.scene else { return String::new() };
        let name: String = scene.chars().map(|c| if is_safe(c) { c } else { '-' }).collect();
        let name = name.trim_matches('-');
        let name = if name.is_empty() { "scene" } else { name };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| taken.insert(name.to_lowercase())).unwrap_or_default()
    };
    sections.iter().map(&mut front).collect()
}

/// Letters and digits of any language, which no shell and no address takes for something else.
fn is_safe(c: char) -> bool {
    c.is_alphanumeric() || c == '-' || c == '_'
}

/// Lines end as RFC 4180 has it; what has commas or quotes is quoted. Numbers are without commas.
fn csv(table: &Table) -> String {
    let quoted = |text: &String| {
        if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.clone() }
    };
    let line = |cells: Vec<String>| cells.join(",") + "\r\n";
    let header = line(table.header.iter().map(quoted).collect());
    let row = |cells: &Vec<String>| {
        let (names, numbers) = cells.split_at(table.names.min(cells.len()));
        line(names.iter().map(quoted).chain(numbers.iter().map(|number| number.replace(',', ""))).collect())
    };
    header + &table.rows.iter().map(row).collect::<String>()
}

const STYLE: &str = "\
:root { color-scheme: light dark; --paper: #faf8f4; --card: #fff; --ink: #23272e; --soft: #5c6470; --line: #dedad2; --link: #1d5fc4 }
@media screen and (prefers-color-scheme: dark) { :root { --paper: #14161a; --card: #1c1f24; --ink: #e8e6e1; --soft: #a0a7b1; --line: #353a42; --link: #78aeff } }
body { margin: 0 auto; max-width: 1160px; padding: 20px; background: var(--paper); color: var(--ink); font: 16px/1.5 Inter, system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif; overflow-wrap: anywhere }
section { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 16px; margin: 16px 0 }
h1 { font-size: 1.5rem; margin: 0 } h2 { font-size: 1.1rem; margin: 0 0 8px } p, figcaption { color: var(--soft); margin: 8px 0 } a { color: var(--link) }
.scroll { overflow-x: auto; margin: 0 0 14px } .file { font-size: .85rem } code { font-size: .9em }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; overflow-wrap: normal }
th, td { padding: 3px 12px 3px 0; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line) }
.name { text-align: left } figure { margin: 14px 0 } .chart { display: block; width: 100%; min-width: 600px; max-width: 960px; height: auto }
img { display: block; image-rendering: pixelated } .bars { max-width: 760px; font-size: .85rem }
.bar { display: grid; grid-template-columns: 5.5em 1fr 6em; align-items: center; margin: 3px 0 } .bar > div { display: flex }
.key { display: flex; flex-wrap: wrap; gap: 4px 16px; margin-bottom: 8px } .key i { width: 22px; margin-right: 6px; display: inline-block; vertical-align: -2px }
.bars i { height: 14px; print-color-adjust: exact; -webkit-print-color-adjust: exact } .bar output { padding-left: 8px; white-space: nowrap }
.bars .s1 { background-image: repeating-linear-gradient(45deg, transparent 0 4px, var(--card) 4px 6px) }
.bars .s2 { background-image: radial-gradient(var(--card) 1.2px, transparent 1.5px); background-size: 6px 6px }
nav a { margin-right: 14px } dl { display: grid; grid-template-columns: auto minmax(0, 1fr); gap: 2px 14px; margin: 10px 0 } dt { color: var(--soft) } dd { margin: 0 }
@media (max-width: 480px) { body { padding: 10px } section { padding: 12px } h1 { font-size: 1.3rem } }
";

/// One file that needs nothing else. What is said of the run stands at the top, by name.
pub(super) fn html(about: &[(&str, String)], sections: &[Section]) -> String {
    let mut text = String::from("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    let _ = writeln!(text, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{TITLE}");
    let _ = writeln!(text, "<style>\n{STYLE}{}</style>\n</head>\n<body>\n<h1>stackless report</h1>\n<dl>", colours());
    for (name, what) in about {
        let _ = writeln!(text, "<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(what));
    }
    text += "</dl>\n<nav>\n";
    for (i, section) in sections.iter().enumerate() {
        let short = section.title.split(':').next().unwrap_or_default();
        let _ = writeln!(text, "<a href=\"#s{i}\">{}</a>", escaped(short));
    }
    text += "</nav>\n";
    for (i, (section, front)) in sections.iter().zip(fronts(sections)).enumerate() {
        let _ = writeln!(text, "<section id=\"s{i}\">\n<h2>{}</h2>", escaped(&section.title));
        for piece in &section.pieces {
            text += &piece_html(piece, &front);
        }
        text += "</section>\n";
    }
    text + "</body>\n</html>\n"
}

/// The colours of bars: those of the charts.
fn colours() -> String {
    let rules = |colour: fn(usize) -> &'static str| {
        let mut text = String::new();
        for i in 0..3 {
            let _ = writeln!(text, ".bars .s{i} {{ background-color: {} }}", colour(i));
        }
        text
    };
    let (light, dark) = (rules(|i| SERIES[i].light), rules(|i| SERIES[i].dark));
    format!("{light}@media screen and (prefers-color-scheme: dark) {{\n{dark}}}\n")
}

fn piece_html(piece: &Piece, front: &str) -> String {
    let figure = |content: &str, caption: &str| {
        format!("<figure>{content}<figcaption>{}</figcaption></figure>\n", escaped(caption))
    };
    let wide = |content: &str, name: &str| {
        let name = escaped(name);
        format!("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{name}\">{content}</div>\n")
    };
    match piece {
        Piece::Line(line) => format!("<p>{}</p>\n", escaped(line)),
        Piece::Table(name, table) => {
            let file = file_name(front, name);
            let html = wide(&table_html(table), &file);
            let link = format!("{LINK}{file}\">{file}</a>\n");
            match table.rows.len() {
                n if n > LONG => format!("{link}<details><summary>{n} rows</summary>\n{html}</details>\n"),
                _ => link + &html,
            }
        }
        Piece::Svg(svg, caption) => figure(&wide(svg, caption), caption),
        Piece::Png(png, caption) => {
            let data = BASE64_STANDARD.encode(png);
            let image = format!("<img alt=\"{}\" src=\"data:image/png;base64,{data}\">", escaped(caption));
            figure(&wide(&image, caption), caption)
        }
        Piece::Bars(bars, caption) => figure(&bars_html(bars), caption),
    }
}

fn table_html(table: &Table) -> String {
    let row = |cells: &Vec<String>, tag: &str| {
        let cell = |(i, cell): (usize, &String)| {
            let class = if i < table.names { " class=\"name\"" } else { "" };
            format!("<{tag}{class}>{}</{tag}>", escaped(cell))
        };
        format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
    };
    let rows: String = table.rows.iter().map(|cells| row(cells, "td")).collect();
    format!("<table>\n{}{rows}</table>", row(&table.header, "th"))
}

/// Tables of more rows are shown when they are asked for.
const LONG: usize = 40;

/// Bars whose parts are as long as their numbers; the longest bar fills its column.
fn bars_html(bars: &[Bar]) -> String {
    let sum = |bar: &Bar| bar.parts.iter().map(|(_, number)| number).sum::<f64>();
    let most = bars.iter().map(sum).fold(f64::MIN_POSITIVE, f64::max);
    let mut text = String::from("<div class=\"bars\">\n<div class=\"key\">");
    for (i, (name, _)) in bars.first().map_or(&[][..], |bar| &bar.parts).iter().enumerate() {
        let _ = write!(text, "<span><i class=\"s{i}\"></i>{}</span>", escaped(name));
    }
    text += "</div>\n";
    for bar in bars {
        let _ = write!(text, "<div class=\"bar\">{}<div>", escaped(bar.label));
        for (i, (name, number)) in bar.parts.iter().enumerate() {
            let (width, title) = (100.0 * number / most, escaped(&format!("{name}: {number:.0} ns")));
            let _ = write!(text, "<i class=\"s{i}\" title=\"{title}\" style=\"width:{width:.2}%\"></i>");
        }
        let _ = writeln!(text, "</div><output>{:.0} ns</output></div>", sum(bar));
    }
    text + "</div>"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::table;

    fn section(scene: Option<&str>, name: &'static str, text: &str) -> Section {
        let cells = vec![vec![text.to_owned(), "1,234".to_owned()]];
        let pieces = vec![
            Piece::line(text),
            Piece::Table(name, table(&[text, "n"], 1, cells)),
            Piece::Png(vec![1, 2, 3], text.to_owned()),
        ];
        Section { scene: scene.map(str::to_owned), title: text.to_owned(), pieces }
    }

    #[test]
    fn text_cannot_leave_its_place() {
        let nasty = "<script>\"a\", & b";
        let sections = [section(None, "t", nasty)];
        let page = html(&[(nasty, nasty.to_owned())], &sections);
        assert!(!page.contains("<script") && page.contains("&lt;script&gt;&quot;a&quot;, &amp; b"), "{page}");
        assert!(page.contains("data:image/png;base64,AQID"));
        let quoted = "\"<script>\"\"a\"\", & b\"";
        assert_eq!(tables(&sections), [("t.csv".to_owned(), format!("{quoted},n\r\n{quoted},1234\r\n"))]);
    }

    #[test]
    fn files_have_the_names_of_scenes() {
        let scenes = ["bunny", "bunny", "Bunny-2", "../a b\"", "\u{202e}", "bunny"];
        let sections = scenes.map(|scene| section(Some(scene), "plan", "x"));
        let names: Vec<_> = tables(&sections).into_iter().map(|(name, _)| name).collect();
        let expected = ["bunny", "bunny-2", "Bunny-2-2", "a-b", "scene", "bunny-3"];
        assert_eq!(names, expected.map(|name| format!("{name}-plan.csv")));
        assert_eq!(tables_of(&html(&[], &sections)), names);
        assert!(tables_of(&format!("{LINK}a.csv\">")).is_empty(), "a page of others");
        assert!(tables_of(&format!("{TITLE}{LINK}../a.csv\">{LINK}a.txt\">")).is_empty(), "not a table");
    }
}
