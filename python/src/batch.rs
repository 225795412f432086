//! Long work without the interpreter's lock, so that Ctrl-C can end it and progress can be reported.

use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::errors::failed;
use crate::memory;
use crate::threads::{Threads, none_started};

/// Number of rows between checks of signals: some tenths of a second for slow queries.
pub(crate) const PIECE: usize = 1 << 16;

/// An upper bound of the bytes for a row and its answer during the work. Unbounded answers reserve their own memory.
const ROW_BYTES: usize = 1 << 10;

/// Reads rows with the interpreter's lock, answers them without the lock, and keeps the answers with the lock, piece by
/// piece. This thread answers pieces of up to `few` rows; all threads answer longer pieces. Without `progress`, this
/// thread reads the next piece meanwhile. After each piece it calls `progress(done, count)`, which may fork, so each
/// piece gets its threads again.
///
/// # Errors
/// Errors of the three functions, of `progress`, and of signals: `KeyboardInterrupt`.
pub(crate) fn in_pieces<I: Send, A: Send>(
    py: Python<'_>,
    (count, few): (usize, usize),
    progress: Option<&Bound<'_, PyAny>>,
    read: impl Fn(&Threads, Range<usize>) -> PyResult<I>,
    mut answer: impl FnMut(I) -> PyResult<A> + Send,
    mut keep: impl FnMut(&Threads, A) -> PyResult<()>,
) -> PyResult<()> {
    let from = |first: usize| first..count.min(first + PIECE);
    let mut ahead = None;
    for first in (0..count).step_by(PIECE) {
        let (rows, next) = (from(first), from(count.min(first + PIECE)));
        let done = rows.end;
        let threads = if rows.len() <= few { Threads::one() } else { Threads::all(py)? };
        memory::check((rows.len() + next.len()) * ROW_BYTES)?;
        let input = ahead.take().unwrap_or_else(|| read(&threads, rows))?;
        // Not ahead of `progress`, which may change the rows.
        let read_next = || (!next.is_empty() && progress.is_none()).then(|| read(&Threads::one(), next));
        let answers;
        (answers, ahead) = threads.run_beside(py, || answer(input), read_next);
        keep(&threads, answers?)?;
        py.check_signals()?;
        if let Some(progress) = progress {
            progress.call1((done, count))?;
        }
    }
    Ok(())
}

/// Time between checks of signals while another thread works.
const TURN: Duration = Duration::from_millis(50);

/// An upper bound of the memory for starting a thread. Starting a thread without it aborts the process.
const THREAD_BYTES: usize = 4 << 20;

/// Runs a long work in the background, on all threads. The work receives a function that reports its steps, out of
/// `count`. This thread calls `progress(done, count)` periodically.
///
/// # Errors
/// Errors of the work, of `progress`, and of signals. After an error, the background thread unwinds at its next step.
/// This function waits for that at most one [`TURN`].
pub(crate) fn in_background<A: Send + 'static>(
    py: Python<'_>,
    count: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&(dyn Fn(usize) + Sync)) -> PyResult<A> + Send + 'static,
) -> PyResult<A> {
    let (threads, process) = (Threads::all(py)?, std::process::id());
    let done = Arc::new((AtomicUsize::new(0), AtomicBool::new(false)));
    let (sender, mut receiver) = channel();
    let told = Arc::clone(&done);
    let run = move || {
        let tell = |steps| {
            if told.1.load(Ordering::Relaxed) {
                // A builder cannot be stopped. `resume_unwind` calls no panic hook, and no code joins the thread.
                resume_unwind(Box::new("given up"));
            }
            told.0.fetch_add(steps, Ordering::Relaxed);
        };
        // After an error the channel is closed.
        drop(sender.send(threads.run(|| work(&tell))));
    };
    memory::check(THREAD_BYTES)?;
    thread::Builder::new().spawn(run).map_err(none_started)?;
    let look = || {
        py.check_signals()?;
        if let Some(progress) = progress {
            let steps = done.0.load(Ordering::Relaxed);
            progress.call1((steps.min(count), count))?;
        }
        // `progress` or a signal handler may have forked.
        if std::process::id() == process { Ok(()) } else { Err(failed("only the process that began this can end it")) }
    };
    loop {
        let turn;
        (turn, receiver) = py.detach(move || (receiver.recv_timeout(TURN), receiver));
        match turn {
            Ok(answer) => return answer,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(failed("the thread that worked on this has ended early"));
            }
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = look() {
                    done.1.store(true, Ordering::Relaxed);
                    drop(py.detach(move || receiver.recv_timeout(TURN)));
                    return Err(error);
                }
            }
        }
    }
}
