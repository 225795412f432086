//! Lines of a file, and its text in messages.

use std::io;
use std::path::Path;

use super::read_bytes;

/// Most bytes of a text that is read whole: 64 MiB.
const MOST_TEXT: u64 = 64 << 20;

/// Reads a text that is to be parsed as a whole (JSON), without the mark that some editors write before UTF-8.
///
/// # Errors
/// Those of the file system; more than 64 MiB; no UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    let bytes = read_bytes(path, MOST_TEXT)?;
    let bytes =
        bytes.ok_or_else(|| io::Error::other(format!("more than {MOST_TEXT} bytes, the most that are read")))?;
    let text =
        str::from_utf8(without_mark(&bytes)).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))?;
    Ok(text.to_owned())
}

/// What some editors write before UTF-8.
pub(super) const MARK: &[u8] = b"\xEF\xBB\xBF";

/// The bytes without the mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// The lines of a file with their numbers, without terminator and surrounding white space.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u64,
    end: End,
}

/// What ends a line. A carriage return before a line feed belongs to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// A line feed.
    LineFeed,
    /// A carriage return.
    Return,
    /// Either.
    Any,
}

impl End {
    fn is(self, byte: u8) -> bool {
        match self {
            Self::LineFeed => byte == b'\n',
            Self::Return => byte == b'\r',
            Self::Any => matches!(byte, b'\n' | b'\r'),
        }
    }
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8], end: End) -> Self {
        Self { rest: bytes, number: 0, end }
    }

    /// Number of the line that came last, counted from 1.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// What follows the line that came last.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| self.end.is(byte));
        let (line, rest) = match end {
            Some(end) if self.end == End::Any && self.rest[end..].starts_with(b"\r\n") => (end, end + 2),
            Some(end) => (end, end + 1),
            None => (self.rest.len(), self.rest.len()),
        };
        let line = &self.rest[..line];
        self.rest = &self.rest[rest..];
        self.number += 1;
        Some(line.trim_ascii())
    }
}

/// Text from a file for a message: quoted, one line, shortened.
pub(super) fn quote(text: &str) -> String {
    const SHOWN: usize = 40;
    let shown: String = text.chars().take(SHOWN).collect();
    if shown.len() < text.len() { format!("{shown:?}...") } else { format!("{shown:?}") }
}

/// A path for a message: as it is, but for control characters, which could break the line.
pub(super) fn one_line(path: &Path) -> String {
    let mut line = String::new();
    for character in path.to_string_lossy().chars() {
        if character.is_control() {
            line.extend(character.escape_default());
        } else {
            line.push(character);
        }
    }
    line
}
