//! The header: the elements and their types.

use crate::error::{Fault, Place, ReadError};
use crate::text::{Lines, quote};
use stackless_bvh::geom::MAX_COUNT;

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

#[derive(Clone, Copy)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

pub(super) struct Element {
    /// For messages.
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Face,
    Strip,
    Other,
}

#[derive(Clone, Copy)]
pub(super) enum Property {
    /// The `x`, `y` or `z` of a vertex.
    Coordinate { axis: usize, scalar: Scalar },
    /// The vertex indices of a face.
    Corners { length: Scalar, item: Scalar },
    /// A scalar to skip.
    Scalar(Scalar),
    /// A list to skip.
    List { length: Scalar, item: Scalar },
}

#[derive(Clone, Copy)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Header {
    /// Reads up to and including `end_header`.
    pub(super) fn read(lines: &mut Lines<'_>) -> Result<Self, ReadError> {
        let mut draft = Draft { encoding: None, elements: Vec::new() };
        let magic = lines.next().unwrap_or_default();
        if magic != b"ply" {
            return Err(Fault::unexpected(quote(&String::from_utf8_lossy(magic)), "\"ply\"").at_line(1));
        }
        while let Some(line) = lines.next() {
            let line = String::from_utf8_lossy(line);
            if line == "end_header" {
                return draft.finish().map_err(|fault| fault.at_line(lines.number()));
            }
            draft.statement(&line).map_err(|fault| fault.at_line(lines.number()))?;
        }
        Err(Fault::Ends { expected: "\"end_header\"" }.at_line(lines.number()))
    }
}

struct Draft {
    encoding: Option<Encoding>,
    elements: Vec<Element>,
}

impl Draft {
    fn statement(&mut self, line: &str) -> Result<(), Fault> {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words[..] {
            [] | ["comment" | "obj_info", ..] => Ok(()),
            ["format", encoding, "1.0"] => self.format(line, encoding),
            ["element", name, count] => self.element(name, count),
            ["property", scalar, name] => self.property(line, name, None, scalar),
            ["property", "list", length, item, name] => self.property(line, name, Some(length), item),
            _ => Err(Fault::unexpected(quote(line), "a statement of a PLY 1.0 header")),
        }
    }

    fn format(&mut self, line: &str, encoding: &str) -> Result<(), Fault> {
        let encoding = match encoding {
            "ascii" => Encoding::Ascii,
            "binary_little_endian" => Encoding::LittleEndian,
            "binary_big_endian" => Encoding::BigEndian,
            _ => {
                let expected = "ascii, binary_little_endian or binary_big_endian";
                return Err(Fault::unexpected(quote(encoding), expected));
            }
        };
        match self.encoding.replace(encoding) {
            None => Ok(()),
            Some(_) => Err(Fault::unexpected(quote(line), "one format only")),
        }
    }

    fn element(&mut self, name: &str, count: &str) -> Result<(), Fault> {
        let kind = match name {
            "vertex" => Kind::Vertex,
            "face" => Kind::Face,
            "tristrips" => Kind::Strip,
            _ => Kind::Other,
        };
        if kind != Kind::Other && self.elements.iter().any(|element| element.kind == kind) {
            return Err(Fault::unexpected(format!("a second element {name}"), "one only"));
        }
        let most = if kind == Kind::Other { u64::MAX } else { MAX_COUNT as u64 };
        let number = count.parse().ok().filter(|&number| number <= most);
        let count = number.ok_or_else(|| Fault::unexpected(quote(count), format!("a count up to {most}")))?;
        let name = name.escape_debug().take(40).collect();
        self.elements.push(Element { name, kind, count, properties: Vec::new() });
        Ok(())
    }

    fn property(&mut self, line: &str, name: &str, length: Option<&str>, scalar: &str) -> Result<(), Fault> {
        let item = Scalar::parse(scalar)?;
        let length = length.map(Scalar::parse).transpose()?;
        let Some(element) = self.elements.last_mut() else {
            return Err(Fault::unexpected(quote(line), "an element before its properties"));
        };
        let property = match (element.kind, length, name) {
            (Kind::Vertex, None, "x") => Property::Coordinate { axis: 0, scalar: item },
            (Kind::Vertex, None, "y") => Property::Coordinate { axis: 1, scalar: item },
            (Kind::Vertex, None, "z") => Property::Coordinate { axis: 2, scalar: item },
            (Kind::Face | Kind::Strip, Some(length), "vertex_indices" | "vertex_index") => {
                Property::Corners { length, item }
            }
            (_, None, _) => Property::Scalar(item),
            (_, Some(length), _) => Property::List { length, item },
        };
        let twice = match property {
            Property::Coordinate { axis, .. } => element.has_coordinate(axis),
            Property::Corners { .. } => element.has_corners(),
            Property::Scalar(_) | Property::List { .. } => false,
        };
        if twice {
            return Err(Fault::unexpected(format!("a second property {name}"), "one only"));
        }
        element.properties.push(property);
        Ok(())
    }

    /// Checks that the elements and properties of a mesh are present.
    fn finish(self) -> Result<Header, Fault> {
        let Some(encoding) = self.encoding else {
            return Err(Fault::unexpected("no format", "one of ascii, binary_little_endian, binary_big_endian"));
        };
        let missing = |what: &str| Fault::unexpected("the end of the header", what);
        let kind = |kind| self.elements.iter().find(|element| element.kind == kind);
        let vertex = kind(Kind::Vertex).ok_or_else(|| missing("element vertex"))?;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            if !vertex.has_coordinate(axis) {
                return Err(missing(&format!("scalar property {name} of element vertex")));
            }
        }
        let faces: Vec<_> = [kind(Kind::Face), kind(Kind::Strip)].into_iter().flatten().collect();
        if faces.is_empty() {
            return Err(missing("element face or tristrips"));
        }
        if let Some(Element { name, .. }) = faces.iter().find(|element| !element.has_corners()) {
            return Err(missing(&format!("list property vertex_indices or vertex_index of element {name}")));
        }
        Ok(Header { encoding, elements: self.elements })
    }
}

impl Element {
    /// Returns the place of one element.
    pub(super) fn place(&self, line: Option<u64>, index: u64) -> Place {
        Place::Element { line, name: self.name.clone(), index, count: self.count }
    }

    fn has_coordinate(&self, wanted: usize) -> bool {
        self.properties.iter().any(|p| matches!(p, Property::Coordinate { axis, .. } if *axis == wanted))
    }

    fn has_corners(&self) -> bool {
        self.properties.iter().any(|p| matches!(p, Property::Corners { .. }))
    }
}

impl Scalar {
    fn parse(name: &str) -> Result<Self, Fault> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(Fault::unexpected(quote(name), "a type such as uchar, int or float")),
        })
    }

    /// Describes a number of this type in messages.
    pub(super) fn expected(self) -> &'static str {
        match self {
            Self::I8 => "a char",
            Self::U8 => "a uchar",
            Self::I16 => "a short",
            Self::U16 => "a ushort",
            Self::I32 => "an int",
            Self::U32 => "a uint",
            Self::F32 => "a float",
            Self::F64 => "a double",
        }
    }
}

#[cfg(test)]
mod tests;
