//! Output of the subcommands: tables, progress bars, files.

use std::borrow::Cow;
use std::fmt;
use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Mutex, PoisonError};

use comfy_table::CellAlignment;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// Prints a line.
macro_rules! say {
    ($($what:tt)*) => { $crate::output::print_line(format_args!($($what)*)) };
}
pub(crate) use say;

/// Whether details are printed.
static IS_VERBOSE: AtomicBool = AtomicBool::new(false);

/// Enables the output of details.
pub(crate) fn be_verbose() {
    IS_VERBOSE.store(true, Ordering::Relaxed);
}

/// Prints details, with `--verbose` only.
pub(crate) fn detail(what: impl fmt::Display) {
    if IS_VERBOSE.load(Ordering::Relaxed) {
        say!("{what}");
    }
}

/// Rows of text below a header: columns of names, then columns of numbers.
pub(crate) struct Table {
    pub(crate) header: Vec<String>,
    pub(crate) names: usize,
    pub(crate) rows: Vec<Vec<String>>,
}

/// Returns a table. A dash replaces quotients that are undefined or infinite.
pub(crate) fn table(header: &[&str], names: usize, mut rows: Vec<Vec<String>>) -> Table {
    for cell in rows.iter_mut().flat_map(|row| row.iter_mut().skip(names)) {
        if ["NaN", "inf", "-inf"].iter().any(|none| cell.starts_with(none)) {
            "-".clone_into(cell);
        }
    }
    Table { header: header.iter().map(ToString::to_string).collect(), names, rows }
}

/// Plain text, names aligned left, numbers right.
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

/// A finding of a command: a line or a table.
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

/// Destination of lines: standard output, standard error or none.
static LINES: AtomicU8 = AtomicU8::new(TO_OUTPUT);
const TO_OUTPUT: u8 = 0;
const TO_ERROR: u8 = 1;
const TO_NOBODY: u8 = 2;

/// Suppresses all output except errors.
pub(crate) fn be_quiet() {
    LINES.store(TO_NOBODY, Ordering::Relaxed);
}

/// Reserves standard output for a file: lines go to standard error, unless they are suppressed.
pub(crate) fn leave_to_file() {
    let _ = LINES.compare_exchange(TO_OUTPUT, TO_ERROR, Ordering::Relaxed, Ordering::Relaxed);
}

/// Prints a line. [`finish`] reports a failed write.
pub(crate) fn print_line(line: fmt::Arguments<'_>) {
    let line = line.to_string();
    match LINES.load(Ordering::Relaxed) {
        TO_OUTPUT => note(stdout().and_then(|mut output| writeln!(output, "{}", plain(&line)))),
        TO_ERROR => warn(&line),
        _ => {}
    }
}

/// Prints a line to standard error. A failed write cannot be reported.
pub(crate) fn warn(line: &str) {
    let _ = writeln!(io::stderr(), "{}", plain(line));
}

/// Prints the error of a command, truncated: it may contain long text from other programs.
pub(crate) fn print_error(error: &dyn fmt::Display) {
    const SHOWN: usize = 2000;
    let text = error.to_string();
    let end = if text.chars().count() > SHOWN { "…" } else { "" };
    warn(&format!("error: {}{end}", text.chars().take(SHOWN).collect::<String>()));
}

/// The number of the error "bad file descriptor" on every Unix.
#[cfg(unix)]
const EBADF: i32 = 9;

/// Whether the process was started without a standard output (`>&-`). The check runs before `main`, because Rust then
/// opens `/dev/null` instead.
#[cfg(unix)]
static IS_CLOSED: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
ctor::declarative::ctor! {
    #[ctor(unsafe)]
    fn look_at_output() {
        use std::os::fd::AsFd;
        let copied = io::stdout().as_fd().try_clone_to_owned();
        let is_closed = copied.is_err_and(|error| error.raw_os_error() == Some(EBADF));
        IS_CLOSED.store(is_closed, Ordering::Relaxed);
    }
}

/// Locks the standard output.
///
/// # Errors
/// The standard output was closed when the process started.
pub(crate) fn stdout() -> io::Result<io::StdoutLock<'static>> {
    #[cfg(unix)]
    if IS_CLOSED.load(Ordering::Relaxed) {
        return Err(io::Error::from_raw_os_error(EBADF));
    }
    Ok(io::stdout().lock())
}

/// The first error of writing to standard output.
static FAILURE: Mutex<Option<io::Error>> = Mutex::new(None);

/// Records a failed write. A closed pipe is no failure.
pub(crate) fn note(written: io::Result<()>) {
    if let Err(error) = written
        && error.kind() != io::ErrorKind::BrokenPipe
    {
        FAILURE.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }
}

/// Flushes the standard output.
///
/// # Errors
/// A write to standard output failed, now or earlier.
pub(crate) fn finish() -> Result<(), String> {
    note(io::stdout().flush());
    let failure = FAILURE.lock().unwrap_or_else(PoisonError::into_inner).take();
    failure.map_or(Ok(()), |error| Err(format!("standard output: cannot be written: {error}")))
}

/// Escapes control characters, so that foreign text cannot move the cursor, change colours or reverse the text
/// direction.
fn plain(text: &str) -> Cow<'_, str> {
    let acts = |c: char| {
        c != '\n' && c.is_control()
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(acts) {
        return text.into();
    }
    text.chars().flat_map(|c| if acts(c) { c.escape_unicode().collect() } else { vec![c] }).collect()
}

/// A progress bar on standard error, hidden with `--quiet` or without a terminal.
pub(crate) fn bar(length: u64, what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {human_pos}/{human_len} {rate} eta {eta}");
    let shown = |state: &ProgressState, text: &mut dyn fmt::Write| _ = text.write_str(&rate(state.per_sec()));
    let quiet = LINES.load(Ordering::Relaxed) == TO_NOBODY;
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    ProgressBar::with_draw_target(Some(length), target)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("rate", shown))
        .with_message(what.to_owned())
}

/// A rate, such as `3.2 M/s`.
fn rate(per_second: f64) -> String {
    let (unit, size) = match per_second {
        1e9.. => ("G/s", 1e9),
        1e6.. => ("M/s", 1e6),
        1e3.. => ("k/s", 1e3),
        _ => ("/s", 1.0),
    };
    format!("{:.1} {unit}", per_second / size)
}

/// Writes a value as JSON, atomically.
pub(crate) fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| error.to_string())?;
    write_file(path, |file| writeln!(file, "{text}"))
}

/// Writes a file atomically. For `-` it writes to standard output, and [`finish`] reports failures.
pub(crate) fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), String> {
    if path.as_os_str() == "-" {
        note(stdout().and_then(|mut output| write(&mut output)));
        return Ok(());
    }
    stackless_scene::write_atomically(path, write)
        .map_err(|error| format!("{}: cannot be written: {error}", path.display()))
}

/// A number with its noun: `1 ray`, `2,000 rays`.
pub(crate) fn count(number: u64, what: &str) -> String {
    format!("{} {what}{}", grouped(number), if number == 1 { "" } else { "s" })
}

/// A number with thousands separators.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!([0, 1, 2000].map(|number| count(number, "ray")), ["0 rays", "1 ray", "2,000 rays"]);
        assert_eq!(table(&["a", "b"], 1, vec![vec!["inf".into(), "NaN %".into()]]).rows, [["inf", "-"]]);
        assert_eq!([0.0, 999.0, 3.21e6, 4e10].map(rate), ["0.0 /s", "999.0 /s", "3.2 M/s", "40.0 G/s"]);
    }
}
