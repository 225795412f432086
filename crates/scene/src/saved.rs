//! A scene as bytes: its mesh, and its hierarchy in the format of spec/bvh-file.md.
//!
//! The format, with all numbers in little-endian order:
//! - `SBVHMESH`
//! - the version (1) and the bytes of a coordinate (4 or 8), 32 bits each
//! - the numbers of vertices and of faces, 64 bits each
//! - the coordinates of the vertices
//! - the indices of the faces, 32 bits each
//! - the bytes of the hierarchy
//! - a checksum of all bytes before it, 64 bits
//!
//! The Python package also writes this format.

use std::collections::TryReserveError;

use stackless_bvh::bvh::WideBvh;
use stackless_bvh::bvh::wide::{WideBvhError, WideBvhFileError};
use stackless_bvh::geom::{Mesh, MeshError, Precision};
use stackless_bvh::hash::checksum;
use stackless_bvh::internals::bvh::Stored;

const MAGIC: &[u8; 8] = b"SBVHMESH";
const VERSION: u32 = 1;
const HEADER_BYTES: usize = 32;

/// Errors of decoding a saved scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SavedError {
    /// The magic number is wrong.
    #[error("not a saved scene: it does not begin with SBVHMESH")]
    Magic,
    /// The version is not supported.
    #[error("version {0} of the format, expected {VERSION}")]
    Version(u32),
    /// The scene has the other precision.
    #[error("coordinates of {found} bytes, expected {expected}")]
    Precision {
        /// Bytes per coordinate in the header.
        found: u32,
        /// Bytes per coordinate of the requested precision.
        expected: u32,
    },
    /// There are fewer bytes than the header declares.
    #[error("{0} bytes are fewer than the header says")]
    Short(usize),
    /// The bytes have changed since they were written.
    #[error("the checksum is {found:#018x}, expected {stored:#018x}: the bytes have changed")]
    Checksum {
        /// The checksum at the end.
        stored: u64,
        /// The checksum of the bytes before it.
        found: u64,
    },
    /// Vertices and faces are not a valid mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The remaining bytes are not a valid hierarchy.
    #[error(transparent)]
    Hierarchy(#[from] WideBvhFileError),
    /// The hierarchy is not of this mesh.
    #[error(transparent)]
    OtherMesh(#[from] WideBvhError),
}

/// Encodes a scene.
///
/// ```
/// use stackless_bvh::glam::DVec3;
/// use stackless_bvh::{bvh::WideBvh, geom::Mesh};
/// use stackless_scene::{scene_from_bytes, scene_to_bytes};
///
/// let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])?;
/// let bytes = scene_to_bytes(&mesh, &WideBvh::build(&mesh)?)?;
/// let (back, bvh) = scene_from_bytes(&bytes)?;
/// assert_eq!(back, mesh);
/// assert_eq!(scene_to_bytes(&back, &bvh)?, bytes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// There is not enough memory for the bytes.
pub fn scene_to_bytes<V: Precision + Stored>(mesh: &Mesh<V>, bvh: &WideBvh<8, V>) -> Result<Vec<u8>, TryReserveError> {
    let mesh_bytes = size_of_val(mesh.vertices()) + size_of_val(mesh.triangles());
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(HEADER_BYTES + mesh_bytes + bvh.bytes())?;
    bytes.extend(MAGIC);
    bytes.extend([VERSION, V::REAL_BYTES].into_iter().flat_map(u32::to_le_bytes));
    let counts = [mesh.vertices().len(), mesh.triangles().len()];
    bytes.extend(counts.into_iter().flat_map(|count| (count as u64).to_le_bytes()));
    mesh.vertices().iter().for_each(|vertex| vertex.write(&mut bytes));
    bytes.extend(mesh.triangles().iter().flatten().flat_map(|index| index.to_le_bytes()));
    bytes.extend(bvh.to_bytes());
    bytes.extend(checksum(&bytes).to_le_bytes());
    Ok(bytes)
}

/// Decodes a scene and checks all of it, including that the hierarchy is of the mesh. Nothing is allocated before the
/// length is known to be right.
///
/// # Errors
/// The errors of [`SavedError`].
pub fn scene_from_bytes<V: Precision + Stored>(bytes: &[u8]) -> Result<(Mesh<V>, WideBvh<8, V>), SavedError> {
    let too_short = || SavedError::Short(bytes.len());
    if !bytes.starts_with(MAGIC) {
        return Err(SavedError::Magic);
    }
    let (header, _) = bytes.split_at_checked(HEADER_BYTES).ok_or_else(too_short)?;
    match [word(header, 8), word(header, 12)] {
        [VERSION, found] if found == V::REAL_BYTES => {}
        [VERSION, found] => return Err(SavedError::Precision { found, expected: V::REAL_BYTES }),
        [version, _] => return Err(SavedError::Version(version)),
    }
    let (body, stored) = bytes.split_last_chunk::<8>().ok_or_else(too_short)?;
    let (stored, found) = (u64::from_le_bytes(*stored), checksum(body));
    if stored != found {
        return Err(SavedError::Checksum { stored, found });
    }
    let (_, body) = body.split_at_checked(HEADER_BYTES).ok_or_else(too_short)?;
    let count = |at: usize| u64::from(word(header, at)) | u64::from(word(header, at + 4)) << 32;
    let corner_bytes = 3 * V::REAL_BYTES as usize;
    let (vertices, body) = take(body, count(16), corner_bytes).ok_or_else(too_short)?;
    let (faces, bvh) = take(body, count(24), 12).ok_or_else(too_short)?;
    let vertices = vertices.chunks_exact(corner_bytes).map(V::read).collect();
    let faces = faces.chunks_exact(12).map(|face| [0, 4, 8].map(|at| word(face, at))).collect();
    let mesh = Mesh::new(vertices, faces)?;
    let bvh = WideBvh::from_bytes(bvh)?;
    bvh.validate(&mesh)?;
    Ok((mesh, bvh))
}

/// Splits off `count` elements of a size in bytes.
fn take(body: &[u8], count: u64, size: usize) -> Option<(&[u8], &[u8])> {
    body.split_at_checked(usize::try_from(count).ok()?.checked_mul(size)?)
}

/// Returns the word at an offset, or 0 beyond the end.
fn word(bytes: &[u8], at: usize) -> u32 {
    bytes.get(at..).and_then(|bytes| bytes.first_chunk()).map_or(0, |word| u32::from_le_bytes(*word))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;

    /// A changed byte at any offset and any shorter length are rejected.
    #[test]
    fn damaged_bytes_are_refused() {
        let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]).unwrap();
        let bytes = scene_to_bytes(&mesh, &WideBvh::build(&mesh).unwrap()).unwrap();
        assert!(scene_from_bytes::<DVec3>(&bytes).is_ok());
        for at in 0..bytes.len() {
            assert!(scene_from_bytes::<DVec3>(&bytes[..at]).is_err(), "{at} bytes");
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            assert!(scene_from_bytes::<DVec3>(&changed).is_err(), "byte {at}");
        }
        let message = scene_from_bytes::<Vec3>(&bytes).unwrap_err().to_string();
        assert_eq!(message, "coordinates of 8 bytes, expected 4");
    }
}
