//! Reserves memory before it is needed, so that a lack of memory raises an exception and does not abort.

use std::hint::black_box;

use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_slice_box;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// Bytes that stay free for small allocations, which are not checked. The allocator requests memory in steps of a MiB.
const SPARE: usize = 8 << 20;

/// Fewer bytes than this are a small allocation.
const SMALL: usize = 1 << 16;

/// Returns an empty vector with capacity for `count` items.
pub(crate) fn room<T>(count: usize) -> PyResult<Vec<T>> {
    check(count.saturating_mul(size_of::<T>()))?;
    let mut all = Vec::new();
    all.try_reserve_exact(count).map_err(|_| lacking(count.saturating_mul(size_of::<T>())))?;
    Ok(all)
}

/// Returns a vector of `count` zeros. Its memory is not touched.
pub(crate) fn zeroed<T: Zeroable>(count: usize) -> PyResult<Vec<T>> {
    let bytes = count.saturating_mul(size_of::<T>());
    check(bytes)?;
    try_zeroed_slice_box(count).map(Vec::from).map_err(|()| lacking(bytes))
}

/// Reserves capacity for `count` more items, and for later items.
pub(crate) fn reserve<T>(all: &mut Vec<T>, count: usize) -> PyResult<()> {
    let bytes = all.len().saturating_add(count).saturating_mul(size_of::<T>());
    if all.capacity() - all.len() < count {
        // Vectors at least double their capacity.
        check(all.len().max(count).saturating_mul(size_of::<T>()))?;
    }
    all.try_reserve(count).map_err(|_| lacking(bytes))
}

/// Checks that `bytes` can be allocated, for code that would abort: allocates and frees them. For large sizes it leaves
/// [`SPARE`].
pub(crate) fn check(bytes: usize) -> PyResult<()> {
    let spare = if bytes < SMALL { 0 } else { SPARE };
    let mut all = Vec::<u8>::new();
    all.try_reserve_exact(bytes.saturating_add(spare)).map_err(|_| lacking(bytes))?;
    // Without `black_box` the compiler removes the unused allocation.
    drop(black_box(all));
    Ok(())
}

/// Checks the memory of work that several threads share. The allocator reserves up to 64 MiB for each thread.
pub(crate) fn check_shared(bytes: usize, threads: usize) -> PyResult<()> {
    check(bytes.saturating_add(threads.saturating_mul(bytes.min(64 << 20))))
}

pub(crate) fn lacking(bytes: usize) -> PyErr {
    PyMemoryError::new_err(format!("no memory for {bytes} bytes"))
}
