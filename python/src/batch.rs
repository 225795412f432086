//! Long batches: in pieces, with the interpreter's lock released, so that Ctrl-C ends them and their progress is told.

use std::ops::Range;

use pyo3::prelude::*;

/// How many rows are answered between two looks at signals: some tenths of a second at the slowest.
const PIECE: usize = 1 << 16;

/// Reads some rows with the interpreter's lock, answers them without it, and keeps the answers with it; and so on to
/// the last row. After each piece `progress(done, count)` is called.
///
/// # Errors
/// Those of the three, of `progress`, and of signals: `KeyboardInterrupt`.
pub(crate) fn in_pieces<I: Send, A: Send>(
    py: Python<'_>,
    count: usize,
    progress: Option<&Bound<'_, PyAny>>,
    read: impl Fn(Range<usize>) -> PyResult<I>,
    answer: impl Fn(I) -> PyResult<A> + Sync,
    mut keep: impl FnMut(A),
) -> PyResult<()> {
    for first in (0..count).step_by(PIECE) {
        let rows = first..count.min(first + PIECE);
        let done = rows.end;
        let input = read(rows)?;
        keep(py.detach(|| answer(input))?);
        py.check_signals()?;
        if let Some(progress) = progress {
            progress.call1((done, count))?;
        }
    }
    Ok(())
}
