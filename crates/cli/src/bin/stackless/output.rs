//! What the subcommands put out: tables, bars, files.

use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU8, Ordering};

use comfy_table::CellAlignment;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Prints a line.
macro_rules! say {
    ($($what:tt)*) => { $crate::output::print_line(format_args!($($what)*)) };
}
pub(crate) use say;

/// Rows of text below a header: the first columns are names, the others numbers.
pub(crate) struct Table {
    pub(crate) header: Vec<String>,
    pub(crate) names: usize,
    pub(crate) rows: Vec<Vec<String>>,
}

pub(crate) fn table(header: &[&str], names: usize, rows: Vec<Vec<String>>) -> Table {
    Table { header: header.iter().map(ToString::to_string).collect(), names, rows }
}

/// Plain, names to the left, numbers to the right.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_style(comfy_table::presets::NOTHING).set_header(&self.header).add_rows(&self.rows);
        for (i, column) in table.column_iter_mut().enumerate() {
            column.set_padding((0, 2));
            if i >= self.names {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table.fmt(f)
    }
}

/// What a command has found: in print, lines and tables one below the other.
pub(crate) enum Block {
    Line(String),
    Table(Table),
}

pub(crate) fn print(blocks: &[Block]) {
    for block in blocks {
        match block {
            Block::Line(line) => say!("{line}"),
            Block::Table(table) => say!("{table}"),
        }
    }
}

/// Where lines go: to the standard output, to the standard error, nowhere.
static LINES: AtomicU8 = AtomicU8::new(TO_OUTPUT);
const TO_OUTPUT: u8 = 0;
const TO_ERROR: u8 = 1;
const TO_NOBODY: u8 = 2;

/// From now on nothing is said but errors.
pub(crate) fn be_quiet() {
    LINES.store(TO_NOBODY, Ordering::Relaxed);
}

/// The path of a file to write. `-` is the standard output, which then is the file's alone: what else is said goes to
/// the standard error.
pub(crate) fn file(text: &str) -> Result<PathBuf, String> {
    if text.is_empty() {
        return Err("expected a file name, or - for the standard output".to_owned());
    }
    if text == "-" {
        // Unless nothing is said at all.
        let _ = LINES.compare_exchange(TO_OUTPUT, TO_ERROR, Ordering::Relaxed, Ordering::Relaxed);
    }
    Ok(text.into())
}

/// Prints a line. A reader that has gone away is no reason to fail.
pub(crate) fn print_line(line: fmt::Arguments<'_>) {
    let _ = match LINES.load(Ordering::Relaxed) {
        TO_OUTPUT => writeln!(io::stdout(), "{line}"),
        TO_ERROR => writeln!(io::stderr(), "{line}"),
        _ => Ok(()),
    };
}

/// A progress bar on standard error, where that is a terminal and somebody wants to know.
pub(crate) fn bar(length: u64, what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {human_pos}/{human_len} {per_sec} eta {eta}");
    let quiet = LINES.load(Ordering::Relaxed) == TO_NOBODY;
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    ProgressBar::with_draw_target(Some(length), target)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(what.to_owned())
}

/// Writes a value as JSON, whole or not at all.
pub(crate) fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| error.to_string())?;
    write_file(path, |file| writeln!(file, "{text}"))
}

/// Writes a file, whole or not at all; `-` is the standard output.
pub(crate) fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), String> {
    if path.as_os_str() == "-" {
        return match write(&mut io::stdout().lock()) {
            // A reader that has gone away is no reason to fail.
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
            _ => Ok(()),
        };
    }
    stackless_scene::write_atomically(path, write)
        .map_err(|error| format!("{}: cannot be written: {error}", path.display()))
}

/// A number with thousands apart.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let first = digits.len() % 3;
    let mut text = digits[..first].to_owned();
    for (i, digit) in digits[first..].chars().enumerate() {
        if i % 3 == 0 && !text.is_empty() {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
