//! PLY, in ascii and in both binary orders (Turk, *The PLY Polygon File Format*, 1994).

mod header;

use header::{Element, Encoding, Header, Kind, Property, Scalar};

use super::error::{Fault, Place, ReadError};
use stackless_bvh::geom::Mesh;

use super::Rounding;
use super::fan::Fan;
use super::float::{Float, Position};
use super::number::Number;
use super::text::{End, Lines, quote, without_mark};
use std::str::SplitAsciiWhitespace;

/// Reads a mesh from the bytes of a PLY file.
///
/// Of element `vertex` the scalars `x`, `y`, `z` are read, of element `face` the list `vertex_indices` (or
/// `vertex_index`), each of any type; all else is skipped. Coordinates are rounded to what is read; in ascii that is
/// the decimal, also of a `float`. A polygon becomes the triangles `(0, i, i + 1)` of its corners.
///
/// A byte order mark before the header does not count. The file must be what its header says: in ascii one element a
/// line (blank lines do not count), and nothing but white space after the last element, since more bytes than promised
/// mean a wrong count or type.
///
/// # Errors
/// [`ReadError`], naming the line of a header or an ascii file, or the element of a binary one.
pub fn read_ply<V: Position>(bytes: &[u8]) -> Result<Mesh<V>, ReadError> {
    read_and_count(bytes).map(|(mesh, _)| mesh)
}

/// Reads them, and counts the rounded numbers.
pub(crate) fn read_and_count<V: Position>(bytes: &[u8]) -> Result<(Mesh<V>, Rounding), ReadError> {
    let bytes = without_mark(bytes);
    // A lone carriage return ends lines only where it ends the first: binary data may begin with a line feed.
    let lone_return = bytes.starts_with(b"ply\r") && !bytes.starts_with(b"ply\r\n");
    let mut lines = Lines::new(bytes, if lone_return { End::Return } else { End::LineFeed });
    let header = Header::read(&mut lines)?;
    match header.encoding {
        Encoding::Ascii => read_body(&header, Ascii { lines, words: "".split_ascii_whitespace() }),
        Encoding::LittleEndian => read_body(&header, Binary::<false> { rest: lines.rest() }),
        Encoding::BigEndian => read_body(&header, Binary::<true> { rest: lines.rest() }),
    }
}

fn read_body<V: Position, S: Source>(header: &Header, mut source: S) -> Result<(Mesh<V>, Rounding), ReadError> {
    let mut body = Body::new(header, source.rest().len());
    for element in &header.elements {
        // Nothing to read, however many the header promises.
        if element.properties.is_empty() {
            continue;
        }
        for index in 0..element.count {
            body.read(&mut source, element).map_err(|fault| {
                let (line, name) = (source.line(), element.name.clone());
                fault.at(Place::Element { line, name, index, count: element.count })
            })?;
        }
    }
    let left = source.rest().trim_ascii().len();
    if left != 0 {
        return Err(Fault::unexpected(format!("{left} bytes"), "the end of the file").at(Place::End));
    }
    Ok((Mesh::new(body.vertices, body.triangles)?, body.rounding))
}

/// What has been read so far.
struct Body<V> {
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    promised_vertices: u64,
    rounding: Rounding,
}

impl<V: Position> Body<V> {
    fn new(header: &Header, available: usize) -> Self {
        let count = |kind| header.elements.iter().find(|e| e.kind == kind).map_or(0, |e| e.count);
        let (vertices, faces) = (count(Kind::Vertex), count(Kind::Face));
        Self {
            vertices: Vec::with_capacity(capacity(vertices, available)),
            triangles: Vec::with_capacity(capacity(faces, available)),
            promised_vertices: vertices,
            rounding: Rounding::default(),
        }
    }

    #[inline]
    fn read<S: Source>(&mut self, source: &mut S, element: &Element) -> Result<(), Fault> {
        source.begin()?;
        let mut position = [V::Real::default(); 3];
        for property in &element.properties {
            match *property {
                Property::Coordinate { axis, scalar } => {
                    position[axis] = self.rounding.coordinate(source.coordinate(axis, scalar)?);
                }
                Property::Corners { length, item } => self.read_face(source, length, item)?,
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
        if element.kind == Kind::Vertex {
            self.vertices.push(V::from_components(position));
        }
        source.end()
    }

    #[inline]
    fn read_face<S: Source>(&mut self, source: &mut S, length: Scalar, item: Scalar) -> Result<(), Fault> {
        let corners = read_length(source, length)?;
        if corners < 3 {
            return Err(Fault::FewCorners { corners: corners.into() });
        }
        let mut fan = Fan::default();
        for _ in 0..corners {
            let value = source.scalar(item)?;
            let corner = whole(value).filter(|&corner| u64::from(corner) < self.promised_vertices);
            let Some(corner) = corner else {
                let expected = format!("a whole number from 0, less than {}", self.promised_vertices);
                return Err(Fault::Index { found: value.to_string(), expected });
            };
            self.triangles.extend(fan.push(corner));
        }
        Ok(())
    }
}

/// Room for `count` elements, but not more than `available` bytes can hold: a vertex takes at least three bytes, and
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

/// Where the elements come from.
trait Source {
    /// Goes to the next element.
    fn begin(&mut self) -> Result<(), Fault>;
    /// The next number of this element; a double holds those of every type.
    fn scalar(&mut self, scalar: Scalar) -> Result<f64, Fault>;
    /// Reads the coordinate of a vertex.
    fn coordinate<F: Float>(&mut self, axis: usize, scalar: Scalar) -> Result<Number<F>, Fault> {
        Number::coordinate(self.scalar(scalar)?, axis)
    }
    /// Checks that nothing of this element is left.
    fn end(&mut self) -> Result<(), Fault>;
    /// What follows the elements read so far.
    fn rest(&self) -> &[u8];
    /// The line that is being read, if there are lines.
    fn line(&self) -> Option<u64>;
}

struct Binary<'a, const BIG_ENDIAN: bool> {
    rest: &'a [u8],
}

impl<const BIG_ENDIAN: bool> Binary<'_, BIG_ENDIAN> {
    /// The next `N` bytes in little-endian order.
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

    /// Of a float the decimal counts, which its type may not have.
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
