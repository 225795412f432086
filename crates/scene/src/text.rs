//! Lines of a file, and quotations of its text in messages.

use std::borrow::Cow;
use std::io;
use std::path::Path;

use super::read_bytes;

/// The maximum size of text that is read as a whole: 64 MiB.
const MOST_TEXT: u64 = 64 << 20;

/// Reads text that is parsed as a whole (JSON), without a UTF-8 byte order mark.
///
/// # Errors
/// An error of the file system; more than 64 MiB; invalid UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    let bytes = read_bytes(path, MOST_TEXT)?;
    let bytes =
        bytes.ok_or_else(|| io::Error::other(format!("more than {MOST_TEXT} bytes, the most that are read")))?;
    let text =
        str::from_utf8(without_mark(&bytes)).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))?;
    Ok(text.to_owned())
}

/// The byte order mark of UTF-8.
pub(super) const MARK: &[u8] = b"\xEF\xBB\xBF";

/// Removes the byte order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// Converts text to UTF-8 without byte order mark. A mark, or an ASCII character at the beginning, identifies UTF-16.
pub(super) fn as_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xFF, 0xFE, ..] | [1..=255, 0, ..] => u16::from_le_bytes,
        [0xFE, 0xFF, ..] | [0, 1..=255, ..] => u16::from_be_bytes,
        _ => return Cow::Borrowed(without_mark(bytes)),
    };
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    let text: String = char::decode_utf16(units).map(|read| read.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    Cow::Owned(without_mark(text.as_bytes()).to_vec())
}

/// The numbered lines of a file, without line ends and surrounding white space.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u64,
    end: End,
}

/// A line end. A carriage return before a line feed belongs to it.
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

    /// Returns the number of the last line, counted from 1.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// Returns the bytes after the last line.
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

/// Quotes text from a file in a message: on one line, shortened.
pub(super) fn quote(text: &str) -> String {
    const SHOWN: usize = 80;
    let shown: String = text.chars().take(SHOWN).collect();
    if shown.len() < text.len() { format!("{shown:?}...") } else { format!("{shown:?}") }
}

/// Describes a JSON error in a message: the column, and one line, with its middle omitted if it quotes long text.
pub(super) fn of_json(error: &serde_json::Error) -> String {
    const BEGIN: usize = 80;
    const END: usize = 160;
    let text = error.to_string();
    let what = text.rsplit_once(" at line ").map_or(&*text, |(what, _)| what);
    let mut what = escaped(what).replace("expected usize", "expected a whole number from 0");
    let count = what.chars().count();
    if count > BEGIN + END {
        what = what.chars().take(BEGIN).chain("...".chars()).chain(what.chars().skip(count - END)).collect();
    }
    format!("column {}: {what}", error.column())
}

/// Escapes the control characters of a path for a message.
pub(super) fn one_line(path: &Path) -> String {
    escaped(&path.to_string_lossy())
}

/// Escapes control characters, which could break the line.
fn escaped(text: &str) -> String {
    let mut line = String::new();
    for character in text.chars() {
        if character.is_control() {
            line.extend(character.escape_default());
        } else {
            line.push(character);
        }
    }
    line
}
