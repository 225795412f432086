//! Memory that is asked for before it is needed, so that the lack of it is an exception and no abort.

use std::hint::black_box;

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// An empty vector that can grow so far.
pub(crate) fn room<T>(count: usize) -> PyResult<Vec<T>> {
    let mut all = Vec::new();
    all.try_reserve_exact(count).map_err(|_| lacking(count.saturating_mul(size_of::<T>())))?;
    Ok(all)
}

/// Makes room for so many more, and for others to come.
pub(crate) fn reserve<T>(all: &mut Vec<T>, count: usize) -> PyResult<()> {
    let bytes = all.len().saturating_add(count).saturating_mul(size_of::<T>());
    all.try_reserve(count).map_err(|_| lacking(bytes))
}

/// Whether there are so many bytes, for work that cannot say that it lacks them: they are taken, and given back.
pub(crate) fn check(bytes: usize) -> PyResult<()> {
    // Else the compiler sees that nobody uses them, and takes none.
    room::<u8>(bytes).map(|all| drop(black_box(all)))
}

/// Whether there is memory for work that several threads share. The allocator gives a thread up to 64 MiB at once.
pub(crate) fn check_shared(bytes: usize, threads: usize) -> PyResult<()> {
    check(bytes.saturating_add(threads.saturating_mul(bytes.min(64 << 20))))
}

fn lacking(bytes: usize) -> PyErr {
    PyMemoryError::new_err(format!("no memory for {bytes} bytes"))
}
