//! Wavefront OBJ: vertices and faces (*Advanced Visualizer* manual, appendix B1).

use super::error::{Fault, ReadError};
use stackless_bvh::geom::Mesh;

use super::fan::Fan;
use super::float::Position;
use super::number::Number;
use super::text::{End, Lines, quote, without_mark};
use super::{Loaded, Rounding};
use std::fmt;
use std::str::SplitAsciiWhitespace;

/// Reads a mesh from the bytes of an OBJ file.
///
/// Statements `v` (of which the first three numbers count) and `f` (or `fo`) are read, with comments and lines
/// continued by a backslash. A line ends with a line feed, a carriage return, or both; a byte order mark does not
/// count. Coordinates are rounded to what is read. A corner is `a`, `a/b`, `a//c` or `a/b/c`, where `a` counts
/// vertices from 1, or backwards from the last one so far if negative; it may point to a vertex that follows. A polygon
/// becomes the triangles `(0, i, i + 1)` of its corners.
///
/// Statements of the format that say nothing of triangles are skipped. Those that the format does not have are skipped
/// too, and counted.
///
/// ```
/// let (mesh, skipped) = stackless_scene::read_obj::<glam::Vec3>(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nfacet 1 2 3\nf 1 2 3\n")?;
/// assert_eq!(mesh.triangles(), [[0, 1, 2]]);
/// let said = "1 statement that OBJ does not have was skipped, the first in line 4: \"facet\"";
/// assert_eq!(skipped.map(|skipped| skipped.to_string()).as_deref(), Some(said));
/// # Ok::<(), stackless_scene::ReadError>(())
/// ```
///
/// # Errors
/// [`ReadError`], naming the line on which the statement begins.
pub fn read_obj<V: Position>(bytes: &[u8]) -> Result<(Mesh<V>, Option<Statements>), ReadError> {
    load(bytes).map(|loaded| (loaded.mesh, loaded.skipped))
}

/// Reads the mesh, and counts rounded numbers and skipped elements.
pub(crate) fn load<V: Position>(bytes: &[u8]) -> Result<Loaded<V>, ReadError> {
    let mut draft = Draft {
        line: 0,
        vertices: Vec::new(),
        triangles: Vec::new(),
        ahead: Vec::new(),
        skipped: None,
        rounding: Rounding::default(),
    };
    let mut lines = Lines::new(without_mark(bytes), End::Any);
    let mut statement = Vec::new();
    while let Some(first) = lines.next() {
        draft.line = lines.number();
        let (text, continued) = content(first);
        let text = if continued { join(text, &mut lines, &mut statement) } else { text };
        let text = String::from_utf8_lossy(text);
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => draft.vertex(words),
            // As of version 2.11 of the format, the old name is read as the new one.
            Some("f" | "fo") => draft.face(words),
            Some(word) if !OTHERS.contains(&word) => {
                draft.skip(word);
                Ok(())
            }
            _ => Ok(()),
        }
        .map_err(|fault| fault.at_line(draft.line))?;
    }
    draft.finish()
}

/// Statements of a file that the format does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statements {
    /// How many there are.
    pub count: u64,
    /// The line of the first one, counted from 1.
    pub line: u64,
    /// Its first word, quoted and shortened.
    pub word: String,
}

impl fmt::Display for Statements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, line, word } = self;
        let (statements, were) = if *count == 1 { ("statement", "was") } else { ("statements", "were") };
        write!(f, "{count} {statements} that OBJ does not have {were} skipped, the first in line {line}: {word}")
    }
}

/// Statements that say nothing of triangles: the manual's, and those of its version 2.11.
#[rustfmt::skip]
const OTHERS: [&str; 42] = [
    "vt", "vn", "vp", "cstype", "deg", "bmat", "step", "p", "l", "curv", "curv2", "surf", "parm", "trim", "hole",
    "scrv", "sp", "end", "con", "g", "s", "mg", "o", "bevel", "c_interp", "d_interp", "lod", "usemtl", "mtllib",
    "usemap", "maplib", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh", "bsp", "bzp", "cdc", "cdp", "res",
];

/// Writes a line and its continuation lines into `statement`.
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

/// A line without its comment or backslash, and whether the next line continues it. A comment ends with its line.
fn content(line: &[u8]) -> (&[u8], bool) {
    if let Some(comment) = line.iter().position(|&byte| byte == b'#') {
        return (&line[..comment], false);
    }
    match line.strip_suffix(b"\\") {
        Some(text) => (text, true),
        None => (line, false),
    }
}

struct Draft<V> {
    /// Where the current statement begins.
    line: u64,
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    /// Corners (line and number) that were ahead of the vertices when they came.
    ahead: Vec<(u64, i64)>,
    skipped: Option<Statements>,
    rounding: Rounding,
}

impl<V: Position> Draft<V> {
    fn skip(&mut self, word: &str) {
        let first = || Statements { count: 0, line: self.line, word: quote(word) };
        self.skipped.get_or_insert_with(first).count += 1;
    }

    fn vertex(&mut self, mut words: SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        let mut position = [V::Real::default(); 3];
        for (axis, coordinate) in position.iter_mut().enumerate() {
            let word = words.next().ok_or_else(|| Fault::unexpected("the end of the line", "3 coordinates"))?;
            *coordinate = self.rounding.coordinate(Number::coordinate_in(word, axis, "a number")?);
        }
        self.vertices.push(V::from_components(position));
        Ok(())
    }

    fn face(&mut self, words: SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        let mut fan = Fan::default();
        for word in words {
            let number =
                corner(word).ok_or_else(|| Fault::unexpected(quote(word), "a corner as in a, a/b, a//c or a/b/c"))?;
            let index = self.resolve(number)?;
            self.triangles.extend(fan.push(index));
        }
        if fan.corners() < 3 { Err(Fault::FewCorners { corners: fan.corners() }) } else { Ok(()) }
    }

    fn resolve(&mut self, number: i64) -> Result<u32, Fault> {
        let count = self.vertices.len() as i64;
        let index = if number < 0 { number + count } else { number - 1 };
        if index < 0 {
            return Err(self.out_of_range(number));
        }
        // What is ahead still, however far, is refused in the end: the cast loses nothing that stays.
        if index >= count {
            self.ahead.push((self.line, number));
        }
        Ok(index as u32)
    }

    fn out_of_range(&self, number: i64) -> Fault {
        let expected = match self.vertices.len() {
            0 => "a vertex before the face".into(),
            count => format!("1 to {count} or -{count} to -1"),
        };
        Fault::Index { found: number.to_string(), expected }
    }

    fn finish(self) -> Result<Loaded<V>, ReadError> {
        let count = self.vertices.len() as i64;
        if let Some(&(line, number)) = self.ahead.iter().find(|(_, number)| *number > count) {
            return Err(self.out_of_range(number).at_line(line));
        }
        let mesh = Mesh::new(self.vertices, self.triangles)?;
        Ok(Loaded { skipped: self.skipped, ..Loaded::of((mesh, self.rounding)) })
    }
}

/// The vertex number of `a`, `a/b`, `a//c` or `a/b/c`.
fn corner(word: &str) -> Option<i64> {
    let mut parts = word.split('/');
    let vertex = parts.next()?.parse().ok()?;
    let others = parts.by_ref().take(2).all(|part| part.is_empty() || part.parse::<i64>().is_ok());
    (others && parts.next().is_none()).then_some(vertex)
}

#[cfg(test)]
mod tests;
