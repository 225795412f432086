//! The page, and its tables as CSV.

use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::Table;

/// A part of the page.
pub(super) struct Section {
    pub(super) id: &'static str,
    pub(super) title: String,
    pub(super) pieces: Vec<Piece>,
}

/// What stands in a section, one below the other. Pictures have a caption.
pub(super) enum Piece {
    Line(String),
    /// With the name of its file.
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

/// Each table as a file: name and content. Those of scenes have the number of the scene in front.
pub(super) fn tables(sections: &[Section]) -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut scenes = 0;
    for section in sections {
        let is_scene = section.id == "scene";
        scenes += usize::from(is_scene);
        for piece in &section.pieces {
            if let Piece::Table(name, table) = piece {
                let name = if is_scene { format!("scene{scenes}-{name}.csv") } else { format!("{name}.csv") };
                files.push((name, csv(table)));
            }
        }
    }
    files
}

/// Whether a file of this name is one of [`tables`] of a scene.
pub(super) fn is_table_of_scene(name: &str) -> bool {
    let number = name.strip_prefix("scene").and_then(|rest| rest.strip_suffix(".csv")?.split_once('-'));
    number.is_some_and(|(number, table)| number.parse::<u32>().is_ok() && !table.is_empty())
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
:root { color-scheme: light dark; --paper: #faf8f4; --card: #fff; --ink: #23272e; --soft: #5c6470; --line: #dedad2 }
@media (prefers-color-scheme: dark) { :root { --paper: #14161a; --card: #1c1f24; --ink: #e8e6e1; --soft: #a0a7b1; --line: #353a42 } }
body { margin: 0 auto; max-width: 1160px; padding: 20px; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif }
section { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 16px; margin: 16px 0 }
h1 { font-size: 1.5rem; margin: 0 } h2 { font-size: 1.1rem; margin: 0 0 8px } p, figcaption { color: var(--soft); margin: 8px 0 }
.scroll { overflow-x: auto; margin: 0 0 14px } table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums }
th, td { padding: 3px 12px 3px 0; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line) }
.name { text-align: left } figure { margin: 14px 0 } figure > svg, figure > img { max-width: 100%; height: auto; background: #fff }
img { image-rendering: pixelated } .bar { display: flex; gap: 8px; align-items: center; font-size: .85rem; margin: 3px 0 }
.bar b { width: 6em; font-weight: 400 } .bar span { height: 14px; display: block } .bars { max-width: 760px }
nav a { margin-right: 14px }";

const COLOURS: [&str; 3] = ["#1d5fc4", "#2f9e6e", "#d98a1f"];

/// One file that needs nothing else.
pub(super) fn html(about: &str, sections: &[Section]) -> String {
    let mut text = String::from("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    text +=
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>stackless report</title>\n";
    let _ = writeln!(text, "<style>\n{STYLE}\n</style>\n</head>\n<body>\n<h1>stackless report</h1>");
    let _ = writeln!(text, "<p>{}. Tables are beside this file as CSV.</p>\n<nav>", escaped(about));
    for (i, section) in sections.iter().enumerate() {
        let short = section.title.split(':').next().unwrap_or_default();
        let _ = writeln!(text, "<a href=\"#s{i}\">{}</a>", escaped(short));
    }
    text += "</nav>\n";
    for (i, section) in sections.iter().enumerate() {
        let _ = writeln!(text, "<section id=\"s{i}\">\n<h2>{}</h2>", escaped(&section.title));
        for piece in &section.pieces {
            text += &piece_html(piece);
        }
        text += "</section>\n";
    }
    text + "</body>\n</html>\n"
}

fn piece_html(piece: &Piece) -> String {
    let figure = |content: &str, caption: &str| {
        format!("<figure>{content}<figcaption>{}</figcaption></figure>\n", escaped(caption))
    };
    match piece {
        Piece::Line(line) => format!("<p>{}</p>\n", escaped(line)),
        Piece::Table(_, table) => table_html(table),
        Piece::Svg(svg, caption) => figure(svg, caption),
        Piece::Png(png, caption) => {
            let data = BASE64_STANDARD.encode(png);
            figure(&format!("<img alt=\"{}\" src=\"data:image/png;base64,{data}\">", escaped(caption)), caption)
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
    let html = format!("<div class=\"scroll\"><table>\n{}{rows}</table></div>\n", row(&table.header, "th"));
    let n = table.rows.len();
    if n > LONG { format!("<details><summary>{n} rows</summary>\n{html}</details>\n") } else { html }
}

/// Tables of more rows are shown when they are asked for.
const LONG: usize = 40;

/// Bars whose parts are as long as their numbers; the longest bar fills the width.
fn bars_html(bars: &[Bar]) -> String {
    let sum = |bar: &Bar| bar.parts.iter().map(|(_, number)| number).sum::<f64>();
    let most = bars.iter().map(sum).fold(f64::MIN_POSITIVE, f64::max);
    let mut text = String::from("<div class=\"bars\">");
    if let Some(first) = bars.first() {
        text += "<div class=\"bar\"><b></b>";
        for ((name, _), colour) in first.parts.iter().zip(COLOURS) {
            let _ = write!(text, "<span style=\"width:14px;background:{colour}\"></span>{}", escaped(name));
        }
        text += "</div>\n";
    }
    for bar in bars {
        let _ = write!(text, "<div class=\"bar\" style=\"gap:0\"><b>{}</b>", escaped(bar.label));
        for ((name, number), colour) in bar.parts.iter().zip(COLOURS) {
            let (width, title) = (80.0 * number / most, format!("{name}: {number:.0}"));
            let _ = write!(
                text,
                "<span title=\"{}\" style=\"width:{width:.2}%;background:{colour}\"></span>",
                escaped(&title)
            );
        }
        let _ = writeln!(text, "&nbsp;{:.0} ns</div>", sum(bar));
    }
    text + "</div>"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::table;

    #[test]
    fn text_cannot_leave_its_place() {
        let nasty = "<script>\"a\", & b";
        let section = Section {
            id: "scenes",
            title: nasty.to_owned(),
            pieces: vec![
                Piece::line(nasty),
                Piece::Table("t", table(&[nasty, "n"], 1, vec![vec![nasty.to_owned(), "1,234".to_owned()]])),
                Piece::Png(vec![1, 2, 3], nasty.to_owned()),
            ],
        };
        let sections = [section];
        let page = html(nasty, &sections);
        assert!(!page.contains("<script") && page.contains("&lt;script&gt;&quot;a&quot;, &amp; b"), "{page}");
        assert!(page.contains("data:image/png;base64,AQID"));
        let quoted = "\"<script>\"\"a\"\", & b\"";
        assert_eq!(tables(&sections), [("t.csv".to_owned(), format!("{quoted},n\r\n{quoted},1234\r\n"))]);
    }
}
