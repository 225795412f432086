//! Reading and writing files of triangle meshes, rays, points and answers.
//!
//! [`load`] reads a mesh, [`read_rows`] reads rays or points, and [`write_table`] writes the answers.
//! [`write_atomically`] leaves no partial file if a run fails.
//!
//! Files are untrusted. Any file gives a valid [`Mesh`] or a one-line error that names the place (a line, or an element
//! such as `face 3`), the text found and the text expected. No count in a file is trusted before its bytes are there,
//! so memory is at most a small multiple of the file's size. Files of more than [`MOST_BYTES`] are rejected.
//!
//! Numbers are rounded once, to the chosen precision. [`Rounding`] counts the rounded numbers and bounds the error: a
//! decimal such as 0.1 is rounded in either precision. `load::<DVec3>` reads in double precision.
//!
//! Nothing is skipped silently: [`Loaded::notes`] counts skipped and changed content.
#![forbid(unsafe_code)]

mod draft;
mod error;
mod float;
mod gltf;
mod note;
mod number;
mod obj;
mod output;
mod ply;
mod polygon;
mod property;
mod rounding;
mod rows;
mod saved;
mod stl;
mod text;

pub use error::{Fault, Place, ReadError, SceneError};
pub use float::{Float, Position};
pub use gltf::read_gltf;
pub use note::{Note, NoteKind};
pub use obj::read_obj;
pub use output::{abandon_writes, check_writable, resolve, write_atomically};
pub use ply::read_ply;
pub use property::{FileFault, MeshFormat, check_mesh_file, check_row_file};
pub use rounding::{Rounding, size};
pub use rows::{
    Cell, Column, Format, Kind, LoadedRows, Point, Row, RowFault, RowFileError, UnknownFormat, read_rows,
    read_rows_from, write_table,
};
pub use saved::{SavedError, scene_from_bytes, scene_to_bytes};
pub use stl::read_stl;
pub use text::read_text;

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use glam::Vec3;
use stackless_bvh::geom::Mesh;

/// The contents of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<V: Position = Vec3> {
    /// The mesh.
    pub mesh: Mesh<V>,
    /// The face in the file for each triangle, counted from 0. A polygon gives several triangles.
    pub faces: Vec<u32>,
    /// Groups and objects of an OBJ file, solids of an STL text, or nodes of a glTF file, in order. Each has triangles.
    pub parts: Vec<Part>,
    /// Counts of skipped or changed content.
    pub notes: Vec<Note>,
    /// The number of rounded coordinates, and a bound of their error.
    pub rounding: Rounding,
}

/// A named part of a file. Its triangles end before the first one of the next part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The name in the file, which may be empty.
    pub name: String,
    /// The first triangle.
    pub first: u32,
}

impl<V: Position> Loaded<V> {
    /// Returns the part of a triangle; `None` before the first part.
    pub fn part(&self, triangle: u32) -> Option<&Part> {
        self.parts[..self.parts.partition_point(|part| part.first <= triangle)].last()
    }

    /// Returns the note for the user, one line that begins with the file; `None` if nothing was skipped or changed.
    pub fn note(&self, file: &Path) -> Option<String> {
        let rounded = self.rounding.note::<V::Real>(size(&self.mesh));
        let notes: Vec<_> = self.notes.iter().map(ToString::to_string).chain(rounded).collect();
        (!notes.is_empty()).then(|| format!("{}: {}", text::one_line(file), notes.join("; ")))
    }
}

/// Reads a triangle mesh from a file. The extension selects the format, in upper or lower case: `.ply`, `.obj`, `.stl`,
/// `.gltf`, `.glb`; see [`read_ply`], [`read_obj`], [`read_stl`] and [`read_gltf`]. The type selects single or double
/// precision.
///
/// # Errors
/// [`SceneError`]: the extension is unknown, the file is unreadable or too large, or its content is not a valid mesh.
pub fn load<V: Position>(path: &Path) -> Result<Loaded<V>, SceneError> {
    let read = reader(path)?;
    let bytes = read_bytes(path, MOST_BYTES).map_err(|error| SceneError::Io { file: path.into(), error })?;
    let bytes = bytes.ok_or_else(|| SceneError::Size { file: path.into() })?;
    read(&bytes, path.parent()).map_err(|error| SceneError::Content { file: path.into(), error: error.into() })
}

/// Reads a triangle mesh from bytes in memory, for example without a file system. The name's extension selects the
/// format. A `.gltf` must not refer to other files.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_scene::read_named;
///
/// let loaded = read_named::<Vec3>("one.obj".as_ref(), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")?;
/// assert_eq!(loaded.mesh.triangles(), [[0, 1, 2]]);
/// # Ok::<(), stackless_scene::SceneError>(())
/// ```
///
/// # Errors
/// [`SceneError`]: the extension is unknown, or the content is not a valid mesh.
pub fn read_named<V: Position>(name: &Path, bytes: &[u8]) -> Result<Loaded<V>, SceneError> {
    reader(name)?(bytes, None).map_err(|error| SceneError::Content { file: name.into(), error: error.into() })
}

/// A reader of the bytes of a file, and of files that it names in its folder.
type Reader<V> = fn(&[u8], Option<&Path>) -> Result<Loaded<V>, ReadError>;

/// Returns the reader for a file name.
fn reader<V: Position>(path: &Path) -> Result<Reader<V>, SceneError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    Ok(match extension.to_str() {
        Some("ply") => |bytes, _| read_ply(bytes),
        Some("obj") => |bytes, _| read_obj(bytes),
        Some("stl") => |bytes, _| read_stl(bytes),
        Some("gltf" | "glb") => read_gltf,
        _ => return Err(SceneError::Extension { file: path.into() }),
    })
}

/// The maximum size of a file: 4 GiB, more than 100 million triangles.
pub const MOST_BYTES: u64 = 4 << 30;

/// Reads a file, or returns `None` if it has more than `most` bytes. The size in the file system is checked first, so a
/// sparse file costs nothing.
fn read_bytes(path: &Path, most: u64) -> std::io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let size = file.metadata()?.len();
    if size > most {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(size as usize)?;
    file.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

#[cfg(test)]
mod tests;
