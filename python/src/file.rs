//! Files of meshes, and of scenes, with progress.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use stackless_bvh::bvh::WideBvh;
use stackless_bvh::geom::{Mesh, Precision};
use stackless_bvh::internals::bvh::Stored;
use stackless_scene::{Position, Rounding, SceneError, scene_to_bytes, write_atomically};

use crate::batch::in_background;
use crate::errors::{of_file, refused};
use crate::memory::{self, lacking, room};

/// Number of progress steps of reading or writing a file: per cent.
pub(crate) const STEPS: usize = 100;

/// Writes bytes to a file, atomically.
pub(crate) fn write(path: &Path, bytes: &[u8], tell: &(dyn Fn(usize) + Sync)) -> PyResult<()> {
    // A cancelled write does not start.
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

/// Reads the bytes of a file.
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
pub(crate) fn to_bytes<V: Precision + Stored>(mesh: &Mesh<V>, bvh: &WideBvh<8, V>) -> PyResult<Vec<u8>> {
    // The bytes of the hierarchy exist twice: alone, and appended.
    let bytes = size_of_val(mesh.vertices()) + size_of_val(mesh.triangles()) + bvh.bytes();
    memory::check(bytes + bvh.bytes())?;
    scene_to_bytes(mesh, bvh).map_err(|_| lacking(bytes))
}

/// The mesh in a file, in the order of the file, with a note about skipped or changed parts; in single precision also
/// about rounding. (In double precision decimals are always rounded.)
pub(crate) fn load_mesh<V: Position>(py: Python<'_>, path: PathBuf) -> PyResult<(Mesh<V>, Option<String>)> {
    let read = move |_: &(dyn Fn(usize) + Sync)| {
        let mut loaded = stackless_scene::load::<V>(&path).map_err(|error| match error {
            SceneError::Io { file, error } => of_file(error, &file),
            error => refused(error),
        })?;
        if size_of::<V::Real>() == 8 {
            loaded.rounding = Rounding::default();
        }
        let note = loaded.note(&path);
        Ok((loaded.mesh, note))
    };
    in_background(py, 1, None, read)
}
