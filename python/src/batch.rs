//! Long work: with the interpreter's lock released, so that Ctrl-C ends it and its progress is told.

use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::errors::failed;

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

/// Time between two looks at signals while another thread works.
const TURN: Duration = Duration::from_millis(50);

/// Does one long work on a thread of its own. It is given a function that is to be told of its steps, of which there are
/// `count`; now and then `progress(done, count)` is called on this thread.
///
/// # Errors
/// Those of the work, of `progress`, and of signals. Then this returns at once, and the other thread unwinds when it next
/// tells of a step.
pub(crate) fn in_background<A: Send + 'static>(
    py: Python<'_>,
    count: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&(dyn Fn(usize) + Sync)) -> PyResult<A> + Send + 'static,
) -> PyResult<A> {
    let done = Arc::new((AtomicUsize::new(0), AtomicBool::new(false)));
    let (sender, mut receiver) = channel();
    let told = Arc::clone(&done);
    let run = move || {
        let tell = |steps| {
            if told.1.load(Ordering::Relaxed) {
                // A builder cannot be told to stop. This is no panic: no hook is called, and nobody joins the thread.
                resume_unwind(Box::new("given up"));
            }
            told.0.fetch_add(steps, Ordering::Relaxed);
        };
        // Nobody listens any more after an error.
        drop(sender.send(work(&tell)));
    };
    thread::Builder::new().spawn(run).map_err(failed)?;
    let look = || {
        py.check_signals()?;
        progress.map_or(Ok(()), |progress| {
            let steps = done.0.load(Ordering::Relaxed);
            progress.call1((steps.min(count), count)).map(drop)
        })
    };
    loop {
        let turn;
        (turn, receiver) = py.detach(move || (receiver.recv_timeout(TURN), receiver));
        match turn {
            Ok(answer) => return answer,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(failed("the thread that worked on this has ended early"));
            }
            Err(RecvTimeoutError::Timeout) => look().inspect_err(|_| done.1.store(true, Ordering::Relaxed))?,
        }
    }
}
