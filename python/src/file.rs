//! Files of scenes, with progress.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use pyo3::PyResult;
use stackless_scene::write_atomically;

use crate::errors::of_file;
use crate::memory::room;

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
