//! Errors in mesh files, with their places.

use stackless_bvh::geom::MeshError;

use super::MOST_BYTES;
use super::float::Float;
use super::note::Note;
use super::text::{one_line, quote};
use std::path::{Path, PathBuf};
use std::{fmt, io};

/// Errors of loading a mesh. The message is one line that begins with the file.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The extension is not that of a supported format.
    #[error("{}: {}, expected .ply, .obj, .stl, .gltf or .glb", one_line(.file), extension(.file))]
    Extension {
        /// The file.
        file: PathBuf,
    },
    /// The file is missing or cannot be read.
    #[error("{}: cannot be read: {error}", one_line(.file))]
    Io {
        /// The file.
        file: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
    /// The file is too large: the hierarchy of its mesh could take several times the memory.
    #[error("{}: more than {MOST_BYTES} bytes, the most that are read of a file", one_line(.file))]
    Size {
        /// The file.
        file: PathBuf,
    },
    /// The file was read, but is not a valid mesh.
    #[error("{}: {error}", one_line(.file))]
    Content {
        /// The file.
        file: PathBuf,
        /// The content error.
        error: Box<ReadError>,
    },
}

/// Errors of decoding a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// A fault at a place in the file.
    #[error("{place}: {fault}")]
    At {
        /// The place.
        place: Place,
        /// The fault.
        fault: Fault,
    },
    /// The file is valid but has no triangles. Notes count its other content.
    #[error("no triangles, expected at least one{}", also(.0))]
    Empty(Vec<Note>),
    /// The file is valid, but its triangles are not a valid mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A place in a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, counted from 1.
    Line(u64),
    /// An element of a PLY or glTF file, or a triangle of a binary STL file.
    Element {
        /// Its line, counted from 1, if the file is text.
        line: Option<u64>,
        /// The name of its kind, such as `vertex`, shortened.
        name: String,
        /// Its index among its kind, counted from 0.
        index: u64,
        /// Number of elements of this kind in the header.
        count: u64,
    },
    /// After the last element of a binary file.
    End,
    /// The whole document of a glTF file.
    Document,
}

/// A fault at a place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The file is truncated.
    #[error("the file ends, expected {expected}")]
    Ends {
        /// The missing content.
        expected: &'static str,
    },
    /// Unexpected text or bytes.
    #[error("found {found}, expected {expected}")]
    Unexpected {
        /// The text found, shortened.
        found: String,
        /// The expected text.
        expected: String,
    },
    /// JSON that is not a glTF 2.0 document.
    #[error("{what}")]
    Json {
        /// The column and the error there.
        what: String,
    },
    /// A coordinate that is NaN, infinite, or out of range in the precision of the mesh.
    #[error("coordinate {} is {value:?}, expected a finite number in {precision} precision", ["x", "y", "z"][*.axis])]
    NonFinite {
        /// 0, 1 or 2.
        axis: usize,
        /// The coordinate.
        value: f64,
        /// The precision of the mesh: `single` or `double`.
        precision: &'static str,
    },
    /// A corner that is not the index of a vertex.
    #[error("vertex index {found} is out of range, expected {expected}")]
    Index {
        /// The corner.
        found: String,
        /// The valid range.
        expected: String,
    },
}

impl Fault {
    pub(super) fn unexpected(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Unexpected { found: found.into(), expected: expected.into() }
    }

    pub(super) fn non_finite<F: Float>(axis: usize, value: f64) -> Self {
        Self::NonFinite { axis, value, precision: F::PRECISION }
    }

    pub(super) fn at(self, place: Place) -> ReadError {
        ReadError::At { place, fault: self }
    }

    pub(super) fn at_line(self, line: u64) -> ReadError {
        self.at(Place::Line(line))
    }
}

impl Place {
    /// Names one of `count` elements of a binary file.
    pub(super) fn of(name: &str, index: usize, count: usize) -> Self {
        Self::Element { line: None, name: name.into(), index: index as u64, count: count as u64 }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Element { line, name, index, count } => {
                if let Some(line) = line {
                    write!(f, "line {line}, ")?;
                }
                write!(f, "{name} {index} (of {count})")
            }
            Self::End => f.write_str("after the last element"),
            Self::Document => f.write_str("the document"),
        }
    }
}

fn also(notes: &[Note]) -> String {
    notes.iter().fold(String::new(), |all, note| all + "; " + &note.to_string())
}

fn extension(file: &Path) -> String {
    match file.extension() {
        Some(extension) => format!("extension {}", quote(&extension.to_string_lossy())),
        None => "no extension".into(),
    }
}
