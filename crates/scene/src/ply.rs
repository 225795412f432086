//! PLY, in ascii and in both binary orders (Turk, *The PLY Polygon File Format*, 1994).

mod header;

use header::{Element, Encoding, Header, Kind, Property, Scalar};

use super::Loaded;
use super::draft::{Draft, of_strip};
use super::error::{Fault, Place, ReadError};
use super::float::{Float, Position};
use super::note::NoteKind;
use super::number::Number;
use super::text::{End, Lines, quote, without_mark};
use std::str::SplitAsciiWhitespace;

/// Reads a mesh from the bytes of a PLY file.
///
/// It reads the scalars `x`, `y`, `z` of element `vertex`, and the list `vertex_indices` (or `vertex_index`) of
/// elements `face` and `tristrips`, each of any type. Other properties are skipped. Other elements are skipped, and a
/// note counts them. Coordinates are rounded to the precision of the mesh. In ascii the decimal is rounded, even that
/// of a `float`.
///
/// A polygon may be concave. A polygon of fewer than three corners is skipped, with a note. In a strip, every index
/// below 0 begins a new strip, and each triangle counts as a face.
///
/// A byte order mark before the header is ignored. The file must match its header: in ascii it has one element per line
/// (except blank lines), and only white space after the last element, because further bytes mean a wrong count or type.
///
/// # Errors
/// [`ReadError`], naming the line of a header or an ascii file, or the element of a binary one.
pub fn read_ply<V: Position>(bytes: &[u8]) -> Result<Loaded<V>, ReadError> {
    let bytes = without_mark(bytes);
    // Lone carriage returns end lines only if the first line ends with one: binary data may begin with a line feed.
    let lone_return = bytes.starts_with(b"ply\r") && !bytes.starts_with(b"ply\r\n");
    let mut lines = Lines::new(bytes, if lone_return { End::Return } else { End::LineFeed });
    let header = Header::read(&mut lines)?;
    match header.encoding {
        Encoding::Ascii => read_body(&header, Ascii { lines, words: "".split_ascii_whitespace() }),
        Encoding::LittleEndian => read_body(&header, Binary::<false> { rest: lines.rest() }),
        Encoding::BigEndian => read_body(&header, Binary::<true> { rest: lines.rest() }),
    }
}

fn read_body<V: Position, S: Source>(header: &Header, mut source: S) -> Result<Loaded<V>, ReadError> {
    let promised = |kind| header.elements.iter().find(|e| e.kind == kind).map_or(0, |e| e.count);
    let vertices = promised(Kind::Vertex);
    let room = |count| capacity(count, source.rest().len());
    let mut body =
        Body { draft: Draft::<V>::new(room(vertices), room(promised(Kind::Face))), vertices, strip: Vec::new() };
    for element in &header.elements {
        // Elements without properties have no bytes, whatever their count in the header.
        if element.properties.is_empty() {
            continue;
        }
        for index in 0..element.count {
            let place = |source: &S| element.place(source.line(), index);
            body.read(&mut source, element, index).map_err(|fault| fault.at(place(&source)))?;
        }
        if element.kind == Kind::Other {
            body.draft.notes.add(NoteKind::OtherElement, element.count, || format!("of kind {}", element.name));
        }
    }
    let left = source.rest().trim_ascii().len();
    if left != 0 {
        return Err(Fault::unexpected(format!("{left} bytes"), "the end of the file").at(Place::End));
    }
    body.draft.finish(|index, line| {
        let (name, line) = ("vertex".into(), source.line().map(|_| line));
        Place::Element { line, name, index: index.into(), count: vertices }
    })
}

/// The content read so far.
struct Body<V: Position> {
    draft: Draft<V>,
    /// Number of vertices in the header.
    vertices: u64,
    /// The corners of a strip.
    strip: Vec<u32>,
}

impl<V: Position> Body<V> {
    #[inline]
    fn read<S: Source>(&mut self, source: &mut S, element: &Element, index: u64) -> Result<(), Fault> {
        source.begin()?;
        let mut position = [V::Real::default(); 3];
        for property in &element.properties {
            match *property {
                Property::Coordinate { axis, scalar } => {
                    let number = source.coordinate(axis, scalar);
                    position[axis] = self.draft.coordinate(axis, number, source.line().unwrap_or(0))?;
                }
                Property::Corners { length, item } => {
                    let corners = read_length(source, length)?;
                    if element.kind == Kind::Strip {
                        let line = source.line();
                        self.read_strip(source, corners, item, || format!("in {}", element.place(line, index)))?;
                    } else {
                        self.read_face(source, corners, item)?;
                    }
                }
                Property::Scalar(scalar) => {
                    source.scalar(scalar)?;
                }
                Property::List { length, item } => {
                    for _ in 0..read_length(source, length)? {
                        source.scalar(item)?;
                    }
                }
            }
        }
        match element.kind {
            Kind::Vertex => self.draft.vertex(position),
            Kind::Face => self.draft.end_face(|| format!("in {}", element.place(source.line(), index))),
            Kind::Strip | Kind::Other => {}
        }
        source.end()
    }

    #[inline]
    fn read_face<S: Source>(&mut self, source: &mut S, corners: u32, item: Scalar) -> Result<(), Fault> {
        for _ in 0..corners {
            let corner = source.scalar(item)?;
            self.draft.corner(self.corner(corner)?);
        }
        Ok(())
    }

    fn read_strip<S: Source>(
        &mut self,
        source: &mut S,
        corners: u32,
        item: Scalar,
        place: impl Fn() -> String,
    ) -> Result<(), Fault> {
        for _ in 0..corners {
            let corner = source.scalar(item)?;
            if corner < 0.0 {
                self.end_strip(&place);
                continue;
            }
            self.strip.push(self.corner(corner)?);
            if let Some(first) = self.strip.len().checked_sub(3) {
                self.draft.triangle(of_strip(first).map(|i| self.strip[i]));
            }
        }
        self.end_strip(&place);
        Ok(())
    }

    fn end_strip(&mut self, place: impl FnOnce() -> String) {
        let is_short = matches!(self.strip.len(), 1 | 2);
        self.draft.notes.add(NoteKind::FewCorners, is_short.into(), place);
        self.strip.clear();
    }

    #[inline]
    fn corner(&self, value: f64) -> Result<u32, Fault> {
        whole(value).filter(|&corner| u64::from(corner) < self.vertices).ok_or_else(|| {
            let expected = format!("a whole number from 0, less than {}", self.vertices);
            Fault::Index { found: value.to_string(), expected }
        })
    }
}

/// Returns the capacity for `count` elements, limited by the `available` bytes. A vertex has at least three bytes, and
/// a face four.
fn capacity(count: u64, available: usize) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX).min(available / 3)
}

fn read_length<S: Source>(source: &mut S, scalar: Scalar) -> Result<u32, Fault> {
    let value = source.scalar(scalar)?;
    whole(value).ok_or_else(|| Fault::unexpected(format!("list length {value}"), "a whole number from 0"))
}

fn whole(value: f64) -> Option<u32> {
    let number = value as u32;
    (f64::from(number) == value).then_some(number)
}

/// A source of elements.
trait Source {
    /// Goes to the next element.
    fn begin(&mut self) -> Result<(), Fault>;
    /// Reads the next number of this element. A double represents the numbers of every type.
    fn scalar(&mut self, scalar: Scalar) -> Result<f64, Fault>;
    /// Reads the coordinate of a vertex.
    fn coordinate<F: Float>(&mut self, axis: usize, scalar: Scalar) -> Result<Number<F>, Fault> {
        Number::coordinate(self.scalar(scalar)?, axis)
    }
    /// Checks that this element has no more content.
    fn end(&mut self) -> Result<(), Fault>;
    /// Returns the bytes after the elements read so far.
    fn rest(&self) -> &[u8];
    /// Returns the current line, if there are lines.
    fn line(&self) -> Option<u64>;
}

struct Binary<'a, const BIG_ENDIAN: bool> {
    rest: &'a [u8],
}

impl<const BIG_ENDIAN: bool> Binary<'_, BIG_ENDIAN> {
    /// Reads the next `N` bytes, in little-endian order.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let Some((&bytes, rest)) = self.rest.split_first_chunk() else {
            return Err(Fault::Ends { expected: "more elements" });
        };
        self.rest = rest;
        let mut bytes: [u8; N] = bytes;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG_ENDIAN: bool> Source for Binary<'_, BIG_ENDIAN> {
    fn begin(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    #[inline]
    fn scalar(&mut self, scalar: Scalar) -> Result<f64, Fault> {
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.take()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.take()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.take()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.take()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.take()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.take()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.take()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn end(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn rest(&self) -> &[u8] {
        self.rest
    }

    fn line(&self) -> Option<u64> {
        None
    }
}

struct Ascii<'a> {
    lines: Lines<'a>,
    words: SplitAsciiWhitespace<'a>,
}

impl Source for Ascii<'_> {
    fn begin(&mut self) -> Result<(), Fault> {
        let line = self.lines.find(|line| !line.is_empty()).ok_or(Fault::Ends { expected: "more elements" })?;
        let text =
            str::from_utf8(line).map_err(|_| Fault::unexpected(quote(&String::from_utf8_lossy(line)), "numbers"))?;
        self.words = text.split_ascii_whitespace();
        Ok(())
    }

    fn scalar(&mut self, scalar: Scalar) -> Result<f64, Fault> {
        let expected = scalar.expected();
        let word = self.words.next().ok_or_else(|| Fault::unexpected("the end of the line", expected))?;
        let value = match scalar {
            Scalar::I8 => word.parse::<i8>().map(f64::from).ok(),
            Scalar::U8 => word.parse::<u8>().map(f64::from).ok(),
            Scalar::I16 => word.parse::<i16>().map(f64::from).ok(),
            Scalar::U16 => word.parse::<u16>().map(f64::from).ok(),
            Scalar::I32 => word.parse::<i32>().map(f64::from).ok(),
            Scalar::U32 => word.parse::<u32>().map(f64::from).ok(),
            Scalar::F32 => word.parse::<f32>().map(f64::from).ok(),
            Scalar::F64 => word.parse::<f64>().ok(),
        };
        value.ok_or_else(|| Fault::unexpected(quote(word), expected))
    }

    /// Rounds the decimal, even if its declared type is `float`.
    fn coordinate<F: Float>(&mut self, axis: usize, scalar: Scalar) -> Result<Number<F>, Fault> {
        if !matches!(scalar, Scalar::F32 | Scalar::F64) {
            return Number::coordinate(self.scalar(scalar)?, axis);
        }
        let word = self.words.next().ok_or_else(|| Fault::unexpected("the end of the line", scalar.expected()))?;
        Number::coordinate_in(word, axis, scalar.expected())
    }

    fn end(&mut self) -> Result<(), Fault> {
        match self.words.next() {
            None => Ok(()),
            Some(word) => Err(Fault::unexpected(quote(word), "the end of the line")),
        }
    }

    fn rest(&self) -> &[u8] {
        self.lines.rest()
    }

    fn line(&self) -> Option<u64> {
        Some(self.lines.number())
    }
}

#[cfg(test)]
mod tests;
