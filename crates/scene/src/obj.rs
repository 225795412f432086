//! Wavefront OBJ: vertices and faces (*Advanced Visualizer* manual, appendix B1).

use super::error::{Fault, ReadError};
use stackless_bvh::geom::Mesh;

use super::fan::Fan;
use super::text::{Lines, quote};
use glam::Vec3;
use std::str::SplitAsciiWhitespace;

/// Reads a mesh from the bytes of an OBJ file.
///
/// Statements `v` (of which the first three numbers count) and `f` are read, with comments and lines continued by a
/// backslash; all others are skipped. Coordinates are rounded to single precision. A corner is `a`, `a/b`, `a//c` or
/// `a/b/c`, where `a` counts vertices from 1, or backwards from the last one so far if negative; it may point to a
/// vertex that follows. A polygon becomes the triangles `(0, i, i + 1)` of its corners.
///
/// # Errors
/// [`ReadError`], naming the line on which the statement begins.
pub fn read_obj(bytes: &[u8]) -> Result<Mesh, ReadError> {
    let mut draft = Draft::default();
    let mut lines = Lines::new(bytes, b'\n');
    let mut statement = Vec::new();
    while let Some(first) = lines.next() {
        draft.line = lines.number();
        join(first, &mut lines, &mut statement);
        let text = String::from_utf8_lossy(&statement);
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => draft.vertex(words),
            Some("f") => draft.face(words),
            _ => Ok(()),
        }
        .map_err(|fault| fault.at_line(draft.line))?;
    }
    draft.finish()
}

/// Puts a line and those that continue it into `statement`.
fn join<'a>(first: &'a [u8], lines: &mut Lines<'a>, statement: &mut Vec<u8>) {
    statement.clear();
    let mut next = Some(first);
    while let Some(line) = next {
        let (text, continued) = content(line);
        statement.extend_from_slice(text);
        statement.push(b' ');
        next = if continued { lines.next() } else { None };
    }
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

#[derive(Default)]
struct Draft {
    /// Where the current statement begins.
    line: u64,
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Corners (line and number) that were ahead of the vertices when they came.
    ahead: Vec<(u64, i64)>,
}

impl Draft {
    fn vertex(&mut self, mut words: SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        let mut position = [0.0_f32; 3];
        for (axis, coordinate) in position.iter_mut().enumerate() {
            let word = words.next().ok_or_else(|| Fault::unexpected("the end of the line", "3 coordinates"))?;
            *coordinate = word.parse().map_err(|_| Fault::unexpected(quote(word), "a number"))?;
            if !coordinate.is_finite() {
                return Err(Fault::NonFinite { axis, value: f64::from(*coordinate) });
            }
        }
        self.vertices.push(position.into());
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

    fn finish(self) -> Result<Mesh, ReadError> {
        let count = self.vertices.len() as i64;
        if let Some(&(line, number)) = self.ahead.iter().find(|(_, number)| *number > count) {
            return Err(self.out_of_range(number).at_line(line));
        }
        Ok(Mesh::new(self.vertices, self.triangles)?)
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
