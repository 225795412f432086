//! STL, as text and binary (3D Systems, *Stereolithography Interface Specification*, 1989).

use std::collections::HashMap;
use std::str::SplitAsciiWhitespace;

use stackless_bvh::geom::Mesh;

use super::Rounding;
use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::number::Number;
use super::text::{End, Lines, quote, without_mark};

/// Bytes before the triangles of a binary file: a text of any kind, and how many there are.
const HEADER: usize = 84;

/// Bytes of a triangle: normal, three corners, attributes.
const TRIANGLE: usize = 50;

/// Reads a mesh from the bytes of an STL file.
///
/// A file is binary if it is as long as its number of triangles says, and a text if it begins with `solid`. Corners with
/// the same coordinates become one vertex. Normals and attributes are skipped. A text may have several solids.
///
/// # Errors
/// [`ReadError`], naming the line of a text, or the triangle of a binary file.
pub fn read_stl<V: Position>(bytes: &[u8]) -> Result<Mesh<V>, ReadError> {
    read_and_count(bytes).map(|(mesh, _)| mesh)
}

/// Reads them, and counts the rounded numbers.
pub(crate) fn read_and_count<V: Position>(bytes: &[u8]) -> Result<(Mesh<V>, Rounding), ReadError> {
    let mut draft = Draft::new();
    if is_text(bytes) {
        read_text(bytes, &mut draft)?;
    } else {
        read_binary(bytes, &mut draft)?;
    }
    Ok((Mesh::new(draft.vertices, draft.triangles)?, draft.rounding))
}

/// Whether a file is a text.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let is_binary = promised(bytes).is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count);
    without_mark(bytes).trim_ascii_start().starts_with(b"solid") && !is_binary
}

/// How many triangles a binary file says that it has.
fn promised(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..)?.first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

fn read_binary<V: Position>(bytes: &[u8], draft: &mut Draft<V>) -> Result<(), ReadError> {
    let expected = "solid, or 80 bytes and the number of triangles";
    let count = promised(bytes).ok_or_else(|| Fault::Ends { expected }.at(Place::Line(1)))?;
    let mut rest = &bytes[HEADER..];
    for index in 0..count {
        let place = || Place::Element { line: None, name: "triangle".into(), index: index as u64, count: count as u64 };
        let (triangle, behind) = rest
            .split_first_chunk::<TRIANGLE>()
            .ok_or_else(|| Fault::Ends { expected: "more triangles" }.at(place()))?;
        rest = behind;
        let numbers =
            triangle[12..48].chunks_exact(4).map(|number| number.try_into().map_or(f32::NAN, f32::from_le_bytes));
        for (i, number) in numbers.enumerate() {
            draft.coordinate(Number::coordinate(number.into(), i % 3).map_err(|fault| fault.at(place()))?);
        }
    }
    if rest.is_empty() {
        return Ok(());
    }
    Err(Fault::unexpected(format!("{} bytes", rest.len()), "the end of the file").at(Place::End))
}

fn read_text<V: Position>(bytes: &[u8], draft: &mut Draft<V>) -> Result<(), ReadError> {
    // What must follow, of the words that begin lines.
    let mut wanted = "solid";
    let mut corners = 0;
    let mut lines = Lines::new(without_mark(bytes), End::Any);
    while let Some(line) = lines.next() {
        let text = String::from_utf8_lossy(line);
        let mut words = text.split_ascii_whitespace();
        let Some(first) = words.next() else { continue };
        let mut step = || {
            wanted = match (wanted, first) {
                ("solid", "solid") | ("endfacet", "endfacet") => "facet or endsolid",
                ("facet or endsolid", "facet") => "outer loop",
                ("facet or endsolid", "endsolid") => "solid",
                ("outer loop", "outer") => "vertex",
                ("vertex", "vertex") => {
                    draft.corner(&mut words)?;
                    corners += 1;
                    if corners % 3 == 0 { "endloop" } else { "vertex" }
                }
                ("endloop", "endloop") => "endfacet",
                _ => return Err(Fault::unexpected(quote(first), wanted)),
            };
            Ok(())
        };
        step().map_err(|fault| fault.at_line(lines.number()))?;
    }
    if wanted == "solid" { Ok(()) } else { Err(Fault::Ends { expected: wanted }.at_line(lines.number())) }
}

struct Draft<V: Position> {
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    /// The vertices by their coordinates.
    known: HashMap<[u64; 3], u32>,
    /// Coordinates of the next corner, then corners of the next triangle.
    coordinates: Vec<V::Real>,
    corners: Vec<u32>,
    rounding: Rounding,
}

impl<V: Position> Draft<V> {
    fn new() -> Self {
        let (vertices, triangles, known) = (Vec::new(), Vec::new(), HashMap::new());
        let (coordinates, corners, rounding) = (Vec::new(), Vec::new(), Rounding::default());
        Self { vertices, triangles, known, coordinates, corners, rounding }
    }

    fn corner(&mut self, words: &mut SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        for axis in 0..3 {
            let word = words.next().ok_or_else(|| Fault::unexpected("the end of the line", "3 coordinates"))?;
            self.coordinate(Number::coordinate_in(word, axis, "a number")?);
        }
        words.next().map_or(Ok(()), |word| Err(Fault::unexpected(quote(word), "the end of the line")))
    }

    /// The next coordinate, of the next corner of the next triangle.
    fn coordinate(&mut self, number: Number<V::Real>) {
        let value = self.rounding.coordinate(number);
        // Zero has one sign, so that it is one corner.
        let zero = V::Real::default();
        self.coordinates.push(if value == zero { zero } else { value });
        let [x, y, z] = self.coordinates[..] else { return };
        self.coordinates.clear();
        let next = self.vertices.len() as u32;
        let index = *self.known.entry([x, y, z].map(|number| number.into().to_bits())).or_insert(next);
        if index == next {
            self.vertices.push(V::from_components([x, y, z]));
        }
        self.corners.push(index);
        if let [a, b, c] = self.corners[..] {
            self.triangles.push([a, b, c]);
            self.corners.clear();
        }
    }
}

#[cfg(test)]
mod tests;
