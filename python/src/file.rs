//! A scene as bytes: its mesh, and its hierarchy in the format of spec/bvh-file.md.
//!
//! All numbers are little-endian: `SBVHMESH`, then the version (1) and the bytes of a coordinate (4 or 8) as 32 bits
//! each, then the numbers of vertices and of faces as 64 bits each; the coordinates of the vertices, the indices of the
//! faces as 32 bits each; the bytes of the hierarchy; and a checksum of all before it as 64 bits.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use pyo3::PyResult;
use stackless_bvh::bvh::Stored;
use stackless_bvh::geom::Mesh;
use stackless_bvh::hash::checksum;
use stackless_scene::write_atomically;

use crate::arrays::mesh_of;
use crate::errors::{of_file, refused};
use crate::memory::{self, room};
use crate::space::Space;

const MAGIC: &[u8; 8] = b"SBVHMESH";
const VERSION: u32 = 1;
const HEADER_BYTES: usize = 32;

/// Steps that reading or writing a file reports: per cent.
pub(crate) const STEPS: usize = 100;

/// Writes bytes to a file, whole or not at all.
pub(crate) fn write(path: &Path, bytes: &[u8], tell: &(dyn Fn(usize) + Sync)) -> PyResult<()> {
    // What was given up before is not begun.
    tell(0);
    let percent = |done: usize| done * STEPS / bytes.len();
    let write = |file: &mut dyn io::Write| {
        let mut done = 0;
        for part in bytes.chunks(1 << 20) {
            file.write_all(part)?;
            tell(percent(done + part.len()) - percent(done));
            done += part.len();
        }
        Ok(())
    };
    write_atomically(path, write).map_err(|error| of_file(error, path))
}

/// The bytes of a file.
pub(crate) fn read(path: &Path, tell: &(dyn Fn(usize) + Sync)) -> PyResult<Vec<u8>> {
    let of_file = |error| of_file(error, path);
    let mut file = File::open(path).map_err(of_file)?;
    let size = file.metadata().map_err(of_file)?.len();
    let mut bytes = room(usize::try_from(size).unwrap_or(usize::MAX))?;
    while (&mut file).take(size.div_ceil(STEPS as u64).max(1)).read_to_end(&mut bytes).map_err(of_file)? > 0 {
        tell(1);
    }
    Ok(bytes)
}

/// The bytes of a scene.
pub(crate) fn to_bytes<S: Space<Vector: Stored>>(mesh: &Mesh<S::Vector>, bvh: &S) -> PyResult<Vec<u8>> {
    let mesh_bytes = size_of_val(mesh.vertices()) + size_of_val(mesh.triangles());
    let mut bytes = room(HEADER_BYTES + mesh_bytes + bvh.bytes())?;
    memory::check(bvh.bytes())?;
    bytes.extend(MAGIC);
    bytes.extend([VERSION, S::Vector::REAL_BYTES].into_iter().flat_map(u32::to_le_bytes));
    let counts = [mesh.vertices().len(), mesh.triangles().len()];
    bytes.extend(counts.into_iter().flat_map(|count| (count as u64).to_le_bytes()));
    for vertex in mesh.vertices() {
        vertex.write(&mut bytes);
    }
    bytes.extend(mesh.triangles().iter().flatten().flat_map(|index| index.to_le_bytes()));
    bytes.extend(bvh.to_bytes());
    bytes.extend(checksum(&bytes).to_le_bytes());
    Ok(bytes)
}

/// Bytes of a coordinate in a file, if it is one.
pub(crate) fn real_bytes(bytes: &[u8]) -> PyResult<u32> {
    let Some((header, _)) = bytes.split_at_checked(HEADER_BYTES).filter(|(header, _)| header.starts_with(MAGIC)) else {
        return Err(refused("no saved scene: it does not begin with SBVHMESH"));
    };
    match [word(header, 8), word(header, 12)] {
        [VERSION, reals @ (4 | 8)] => Ok(reals),
        [VERSION, reals] => Err(refused(format!("coordinates of {reals} bytes, expected 4 or 8"))),
        [version, _] => Err(refused(format!("version {version} of the format, expected {VERSION}"))),
    }
}

/// The scene that bytes are, whose [`real_bytes`] fit. Everything is checked: also that the hierarchy is one over the
/// mesh.
pub(crate) fn from_bytes<S: Space<Vector: Stored>>(bytes: &[u8]) -> PyResult<(Mesh<S::Vector>, S)> {
    // More than all that is made of them.
    memory::check(bytes.len().saturating_mul(3))?;
    let too_short = || refused(format!("{} bytes are fewer than the header says", bytes.len()));
    let (body, stored) = bytes.split_last_chunk::<8>().ok_or_else(too_short)?;
    let (stored, found) = (u64::from_le_bytes(*stored), checksum(body));
    if stored != found {
        return Err(refused(format!("the checksum is {found:#018x}, not {stored:#018x}: the file has changed")));
    }
    let (header, body) = body.split_at_checked(HEADER_BYTES).ok_or_else(too_short)?;
    let count = |at: usize| u64::from(word(header, at)) | u64::from(word(header, at + 4)) << 32;
    let corner_bytes = 3 * S::Vector::REAL_BYTES as usize;
    let (vertices, body) = take(body, count(16), corner_bytes).ok_or_else(too_short)?;
    let (faces, bvh) = take(body, count(24), 12).ok_or_else(too_short)?;
    let vertices = vertices.chunks_exact(corner_bytes).map(S::Vector::read).collect();
    let faces = faces.chunks_exact(12).map(|face| [0, 4, 8].map(|at| word(face, at))).collect();
    let mesh = mesh_of::<S>(vertices, faces)?;
    let bvh = S::from_bytes(bvh, &mesh)?;
    Ok((mesh, bvh))
}

/// So many pieces of a size, and the rest.
fn take(body: &[u8], count: u64, size: usize) -> Option<(&[u8], &[u8])> {
    body.split_at_checked(usize::try_from(count).ok()?.checked_mul(size)?)
}

/// The word at an offset; 0 beyond the end.
fn word(bytes: &[u8], at: usize) -> u32 {
    bytes.get(at..).and_then(|bytes| bytes.first_chunk()).map_or(0, |word| u32::from_le_bytes(*word))
}
