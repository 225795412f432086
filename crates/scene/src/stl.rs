//! STL, as text and binary (3D Systems, *Stereolithography Interface Specification*, 1989).

use std::str::SplitAsciiWhitespace;

use foldhash::{HashMap, HashMapExt as _};

use super::Loaded;
use super::draft::Draft;
use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::note::NoteKind;
use super::number::Number;
use super::text::{End, Lines, as_utf8, quote};

/// Bytes before the triangles of a binary file: a free text, and the number of triangles.
const HEADER: usize = 84;

/// Bytes of a triangle: normal, three corners, attributes.
const TRIANGLE: usize = 50;

/// Reads a mesh from the bytes of an STL file.
///
/// A file is binary if its length matches its number of triangles, or if it does not begin as text. Text begins with
/// `solid`; its words may be upper or lower case. Corners with equal coordinates become one vertex. Normals and
/// attributes are skipped. Bytes after the last triangle of a binary file are also skipped, and a note counts them.
/// Text may have several solids: each is a part.
///
/// # Errors
/// [`ReadError`], naming the line of a text, or the triangle of a binary file.
pub fn read_stl<V: Position>(bytes: &[u8]) -> Result<Loaded<V>, ReadError> {
    let mut corners = Corners { draft: Draft::new(0, 0), known: HashMap::new(), coordinates: Vec::new() };
    if is_text(bytes) {
        read_text(&as_utf8(bytes), &mut corners)?;
    } else {
        read_binary(bytes, &mut corners)?;
    }
    // Every vertex belongs to a triangle, so a coordinate that is not finite is an error where it is read.
    corners.draft.finish(|_, _| Place::End)
}

/// Returns whether a file is text: its length matches no number of triangles, and it begins without non-text bytes.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let is_binary = promised(bytes).is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count);
    let start = as_utf8(&bytes[..bytes.len().min(6 * HEADER)]);
    let begins = start.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && !is_binary && !start.contains(&0)
}

/// Returns the number of triangles in the header of a binary file.
fn promised(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..)?.first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

fn read_binary<V: Position>(bytes: &[u8], corners: &mut Corners<V>) -> Result<(), ReadError> {
    let count = promised(bytes);
    let start = &bytes[..bytes.len().min(HEADER)];
    // Printable bytes as a number of triangles would be far beyond any file.
    let Some(count) = count.filter(|_| start.contains(&0) || !start.is_ascii()) else {
        let is_text = bytes.is_ascii() && !bytes.contains(&0);
        let words = String::from_utf8_lossy(if is_text { bytes } else { &[] });
        let found = words.split_ascii_whitespace().next().map_or(format!("{} bytes", bytes.len()), quote);
        let expected = "solid, or 80 bytes and the number of triangles";
        return Err(Fault::unexpected(found, expected).at(Place::Line(1)));
    };
    let mut rest = &bytes[HEADER..];
    for index in 0..count {
        let place = || Place::of("triangle", index, count);
        let (triangle, behind) = rest
            .split_first_chunk::<TRIANGLE>()
            .ok_or_else(|| Fault::Ends { expected: "more triangles" }.at(place()))?;
        rest = behind;
        let numbers =
            triangle[12..48].chunks_exact(4).map(|number| number.try_into().map_or(f32::NAN, f32::from_le_bytes));
        for (i, number) in numbers.enumerate() {
            corners.coordinate(Number::coordinate(number.into(), i % 3).map_err(|fault| fault.at(place()))?);
        }
    }
    corners
        .draft
        .notes
        .add(NoteKind::TrailingByte, rest.len() as u64, || format!("at byte {}", bytes.len() - rest.len()));
    Ok(())
}

fn read_text<V: Position>(bytes: &[u8], corners: &mut Corners<V>) -> Result<(), ReadError> {
    // The expected first word of the next line.
    let mut wanted = "solid";
    let mut count = 0;
    let mut lines = Lines::new(bytes, End::Any);
    while let Some(line) = lines.next() {
        let text = String::from_utf8_lossy(line);
        let mut words = text.split_ascii_whitespace();
        let Some(found) = words.next() else { continue };
        let mut first = found.to_ascii_lowercase();
        // Some programs write `end loop`.
        if first == "end" {
            first.extend(words.next().map(str::to_ascii_lowercase));
        }
        let step = || {
            wanted = match (wanted, &*first) {
                ("solid", "solid") => {
                    corners.draft.part(words.collect::<Vec<_>>().join(" "));
                    "facet or endsolid"
                }
                ("endfacet", "endfacet") => "facet or endsolid",
                ("facet or endsolid", "facet") => "outer loop",
                ("facet or endsolid", "endsolid") => "solid",
                ("outer loop", "outer") => "vertex",
                ("vertex", "vertex") => {
                    corners.read(&mut words)?;
                    count += 1;
                    if count % 3 == 0 { "endloop" } else { "vertex" }
                }
                ("endloop", "endloop") => "endfacet",
                _ => return Err(Fault::unexpected(quote(found), wanted)),
            };
            Ok(())
        };
        step().map_err(|fault| fault.at_line(lines.number()))?;
    }
    if wanted == "solid" { Ok(()) } else { Err(Fault::Ends { expected: wanted }.at_line(lines.number())) }
}

struct Corners<V: Position> {
    draft: Draft<V>,
    /// Vertices by coordinates. With the hash function of `std`, reading takes seven times as long.
    known: HashMap<[u64; 3], u32>,
    /// Coordinates of the next corner.
    coordinates: Vec<V::Real>,
}

impl<V: Position> Corners<V> {
    fn read(&mut self, words: &mut SplitAsciiWhitespace<'_>) -> Result<(), Fault> {
        for axis in 0..3 {
            let word = words.next().ok_or_else(|| Fault::unexpected("the end of the line", "3 coordinates"))?;
            self.coordinate(Number::coordinate_in(word, axis, "a number")?);
        }
        words.next().map_or(Ok(()), |word| Err(Fault::unexpected(quote(word), "the end of the line")))
    }

    /// Adds a coordinate of the next corner.
    fn coordinate(&mut self, number: Number<V::Real>) {
        let value = self.draft.rounding.coordinate(number);
        // Both zeros are one coordinate.
        let zero = V::Real::default();
        self.coordinates.push(if value == zero { zero } else { value });
        let [x, y, z] = self.coordinates[..] else { return };
        self.coordinates.clear();
        let next = self.draft.vertices() as u32;
        let index = *self.known.entry([x, y, z].map(|number| number.into().to_bits())).or_insert(next);
        if index == next {
            self.draft.vertex([x, y, z]);
        }
        self.draft.corner(index);
        if self.draft.corners() == 3 {
            self.draft.end_face(String::new);
        }
    }
}

#[cfg(test)]
mod tests;
