//! Triangle meshes, rays, points and answers: reading and writing files.
//!
//! [`load`] reads a mesh, [`read_rows`] rays or points to ask it about, and [`write_table`] writes the answers.
//! [`write_atomically`] leaves no partial file behind if a run fails.
//!
//! A file is data from outside: whatever it holds, the answer is a valid [`Mesh`] or an error of one line that
//! says where (line, or element such as `face 3`), what was found and what was expected. No count in a file is
//! believed before the bytes it promises are there, so memory stays within a small multiple of the file's size, and
//! files of more than [`MOST_BYTES`] are refused.
//!
//! Numbers are rounded once, to the chosen precision. [`Rounding`] says how many and by how much: a decimal
//! such as 0.1 is rounded in either precision. `load::<DVec3>` reads in double precision.
//!
//! Nothing is lost in silence: [`Loaded::notes`] counts what was skipped or changed.
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

/// What a mesh file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<V: Position = Vec3> {
    /// The mesh.
    pub mesh: Mesh<V>,
    /// For each triangle the face of the file that it is cut from, counted from 0: of a polygon there are several.
    pub faces: Vec<u32>,
    /// Groups and objects of an OBJ file, solids of an STL text, nodes of a glTF file: those that have triangles, in order.
    pub parts: Vec<Part>,
    /// What was skipped or changed.
    pub notes: Vec<Note>,
    /// How many coordinates were rounded, and by how much.
    pub rounding: Rounding,
}

/// A named part of a file: its triangles are those up to the first one of the next part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its name in the file, which may be empty.
    pub name: String,
    /// Its first triangle.
    pub first: u32,
}

impl<V: Position> Loaded<V> {
    /// Returns the part of a triangle; `None` before the first part.
    pub fn part(&self, triangle: u32) -> Option<&Part> {
        self.parts[..self.parts.partition_point(|part| part.first <= triangle)].last()
    }

    /// Returns the note for the user: one line that begins with the file. `None` if all of it was taken as it is.
    pub fn note(&self, file: &Path) -> Option<String> {
        let rounded = self.rounding.note::<V::Real>(size(&self.mesh));
        let notes: Vec<_> = self.notes.iter().map(ToString::to_string).chain(rounded).collect();
        (!notes.is_empty()).then(|| format!("{}: {}", text::one_line(file), notes.join("; ")))
    }
}

/// Reads the triangle mesh in a file, by its extension (either case of letters): `.ply`, `.obj`, `.stl`, `.gltf`,
/// `.glb`; see [`read_ply`], [`read_obj`], [`read_stl`] and [`read_gltf`]. Coordinates are read in single or in double
/// precision, as the type asks.
///
/// # Errors
/// [`SceneError`]: unknown extension, unreadable or too large a file, or content that is not a mesh.
pub fn load<V: Position>(path: &Path) -> Result<Loaded<V>, SceneError> {
    let read = reader(path)?;
    let bytes = read_bytes(path, MOST_BYTES).map_err(|error| SceneError::Io { file: path.into(), error })?;
    let bytes = bytes.ok_or_else(|| SceneError::Size { file: path.into() })?;
    read(&bytes, path.parent()).map_err(|error| SceneError::Content { file: path.into(), error: error.into() })
}

/// Reads the triangle mesh in bytes that are there already, as where there is no file system. The name tells the format.
/// A `.gltf` may not name other files.
///
/// ```
/// use glam::Vec3;
/// use stackless_scene::read_named;
///
/// let loaded = read_named::<Vec3>("one.obj".as_ref(), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")?;
/// assert_eq!(loaded.mesh.triangles(), [[0, 1, 2]]);
/// # Ok::<(), stackless_scene::SceneError>(())
/// ```
///
/// # Errors
/// [`SceneError`]: unknown extension, or content that is not a mesh.
pub fn read_named<V: Position>(name: &Path, bytes: &[u8]) -> Result<Loaded<V>, SceneError> {
    reader(name)?(bytes, None).map_err(|error| SceneError::Content { file: name.into(), error: error.into() })
}

/// Reads the bytes of a file, and what it names in its folder.
type Reader<V> = fn(&[u8], Option<&Path>) -> Result<Loaded<V>, ReadError>;

/// What reads files of this name.
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

/// Most bytes of a file that are read: 4 GiB, more than 100 million triangles.
pub const MOST_BYTES: u64 = 4 << 30;

/// The bytes of a file, or `None` if there are more than so many. What the file system says is asked first, so that a
/// file with holes costs nothing.
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
