//! Wavefront OBJ: vertices and faces (*Advanced Visualizer* manual, appendix B1).

use std::str::SplitAsciiWhitespace;

use super::Loaded;
use super::draft::Draft;
use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::note::NoteKind;
use super::number::Number;
use super::text::{End, Lines, as_utf8, quote};

/// Reads a mesh from the bytes of an OBJ file.
///
/// The reader supports the statements `v` (its first three numbers) and `f` (or `fo`), comments, and lines continued by
/// a backslash. A line ends with a line feed, a carriage return, or both characters. The text is UTF-8, or UTF-16 with
/// a byte order mark. Coordinates are rounded to the precision of the mesh.
///
/// A corner is `a`, `a/b`, `a//c` or `a/b/c`, where `a` counts vertices from 1, or backwards from the last one so far
/// if negative. It may refer to a later vertex. A polygon may be concave. Each `o` or `g` begins a part.
///
/// Faces with fewer than three corners are skipped. Points, lines, curves, surfaces and unknown statements are also
/// skipped. Notes count them.
///
/// ```
/// use stackless_bvh::glam::Vec3;
///
/// let loaded = stackless_scene::read_obj::<Vec3>(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nfacet 1 2 3\nf 1 2 3\n")?;
/// assert_eq!(loaded.mesh.triangles(), [[0, 1, 2]]);
/// let said = "1 statement that OBJ does not have was skipped, the first in line 4: \"facet\"";
/// assert_eq!(loaded.notes[0].to_string(), said);
/// # Ok::<(), stackless_scene::ReadError>(())
/// ```
///
/// # Errors
/// [`ReadError`], naming the line on which the statement begins.
pub fn read_obj<V: Position>(bytes: &[u8]) -> Result<Loaded<V>, ReadError> {
    let mut reader = Reader { line: 0, draft: Draft::<V>::new(0, 0), ahead: Vec::new() };
    let bytes = as_utf8(bytes);
    let mut lines = Lines::new(&bytes, End::Any);
    let mut statement = Vec::new();
    while let Some(first) = lines.next() {
        reader.line = lines.number();
        let (text, continued) = content(first);
        let text = if continued { join(text, &mut lines, &mut statement) } else { text };
        reader.statement(&String::from_utf8_lossy(text)).map_err(|fault| fault.at_line(reader.line))?;
    }
    reader.finish()
}

/// Statements without geometry, from the manual and from version 2.11 of the format.
#[rustfmt::skip]
const OTHERS: [&str; 29] = [
    "vt", "vn", "vp", "cstype", "deg", "bmat", "step", "parm", "trim", "hole", "scrv", "sp", "end", "con", "s", "mg",
    "bevel", "c_interp", "d_interp", "lod", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",
    "stech", "res",
];

/// Statements of points, lines, curves, surfaces and other files.
const SHAPES: [&str; 11] = ["p", "l", "curv", "curv2", "surf", "call", "csh", "bsp", "bzp", "cdc", "cdp"];

/// Joins a line and its continuation lines in `statement`.
fn join<'a>(first: &[u8], lines: &mut Lines<'_>, statement: &'a mut Vec<u8>) -> &'a [u8] {
    statement.clear();
    statement.extend_from_slice(first);
    for line in lines {
        let (text, continued) = content(line);
        statement.push(b' ');
        statement.extend_from_slice(text);
        if !continued {
            break;
        }
    }
    statement
}

/// Returns a line without its comment or backslash, and whether the next line continues it. A comment ends with its
/// line.
fn content(line: &[u8]) -> (&[u8], bool) {
    if let Some(comment) = line.iter().position(|&byte| byte == b'#') {
        return (&line[..comment], false);
    }
    match line.strip_suffix(b"\\") {
        Some(text) => (text, true),
        None => (line, false),
    }
}

struct Reader<V: Position> {
    /// First line of the current statement.
    line: u64,
    draft: Draft<V>,
    /// Corners (line and number) that refer to later vertices.
    ahead: Vec<(u64, i64)>,
}

impl<V: Position> Reader<V> {
    fn statement(&mut self, text: &str) -> Result<(), Fault> {
        let mut words = text.split_ascii_whitespace();
        let kind = match words.next() {
            Some("v") => return self.vertex(words),
            // Since version 2.11 of the format, the old name means the new one.
            Some("f" | "fo") => return self.face(words),
            Some("o" | "g") => {
                self.draft.part(words.collect::<Vec<_>>().join(" "));
                return Ok(());
            }
            Some(word) if SHAPES.contains(&word) => NoteKind::OtherStatement,
            Some(word) if !OTHERS.contains(&word) => NoteKind::UnknownStatement,
            _ => return Ok(()),
        };
        let word = text.split_ascii_whitespace().next().unwrap_or_default();
        self.draft.notes.add(kind, 1, || format!("in line {}: {}", self.line, quote(word)));
        Ok(())
    }

    fn vertex(&mut self, mut words: SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        let mut position = [V::Real::default(); 3];
        for (axis, coordinate) in position.iter_mut().enumerate() {
            let word = words.next().ok_or_else(|| Fault::unexpected("the end of the line", "3 coordinates"))?;
            *coordinate = self.draft.coordinate(axis, Number::coordinate_in(word, axis, "a number"), self.line)?;
        }
        self.draft.vertex(position);
        Ok(())
    }

    fn face(&mut self, words: SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        for word in words {
            let number =
                corner(word).ok_or_else(|| Fault::unexpected(quote(word), "a corner as in a, a/b, a//c or a/b/c"))?;
            let index = self.resolve(number)?;
            self.draft.corner(index);
        }
        self.draft.end_face(|| format!("in line {}", self.line));
        Ok(())
    }

    fn resolve(&mut self, number: i64) -> Result<u32, Fault> {
        let count = self.draft.vertices() as i64;
        let index = if number < 0 { number + count } else { number - 1 };
        if index < 0 {
            return Err(self.out_of_range(number));
        }
        // Corners still ahead at the end of the file are rejected, so the cast loses no valid index.
        if index >= count {
            self.ahead.push((self.line, number));
        }
        Ok(index as u32)
    }

    fn out_of_range(&self, number: i64) -> Fault {
        let expected = match self.draft.vertices() {
            0 => "a vertex before the face".into(),
            count => format!("1 to {count} or -{count} to -1"),
        };
        Fault::Index { found: number.to_string(), expected }
    }

    fn finish(self) -> Result<Loaded<V>, ReadError> {
        let count = self.draft.vertices() as i64;
        if let Some(&(line, number)) = self.ahead.iter().find(|(_, number)| *number > count) {
            return Err(self.out_of_range(number).at_line(line));
        }
        self.draft.finish(|_, line| Place::Line(line))
    }
}

/// Parses the vertex number of `a`, `a/b`, `a//c` or `a/b/c`.
fn corner(word: &str) -> Option<i64> {
    let mut parts = word.split('/');
    let vertex = parts.next()?.parse().ok()?;
    let others = parts.by_ref().take(2).all(|part| part.is_empty() || part.parse::<i64>().is_ok());
    (others && parts.next().is_none()).then_some(vertex)
}

#[cfg(test)]
mod tests;
