//! Lines of a file, and its text in messages.

use std::path::Path;

/// The bytes without the mark that some editors write before UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
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
