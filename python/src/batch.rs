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
use crate::memory;
use crate::threads::{Threads, none_started};

/// How many rows are answered between two looks at signals: some tenths of a second at the slowest.
pub(crate) const PIECE: usize = 1 << 16;

/// More than a row and its answer take while they are worked on. Answers without a limit ask for more by themselves.
const ROW_BYTES: usize = 1 << 10;

/// Reads some rows with the interpreter's lock, answers them without it, and keeps the answers with it; and so on to
/// the last row. No more than `few` rows are left to this thread, and others to all. After each piece
/// `progress(done, count)` is called, which may fork: so each piece finds its threads.
///
/// # Errors
/// Those of the three, of `progress`, and of signals: `KeyboardInterrupt`.
pub(crate) fn in_pieces<I: Send, A: Send>(
    py: Python<'_>,
    (count, few): (usize, usize),
    progress: Option<&Bound<'_, PyAny>>,
    read: impl Fn(&Threads, Range<usize>) -> PyResult<I>,
    answer: impl Fn(I) -> PyResult<A> + Sync,
    mut keep: impl FnMut(&Threads, A) -> PyResult<()>,
) -> PyResult<()> {
    for first in (0..count).step_by(PIECE) {
        let rows = first..count.min(first + PIECE);
        let done = rows.end;
        let threads = if rows.len() <= few { Threads::one() } else { Threads::all(py)? };
        memory::check(rows.len() * ROW_BYTES)?;
        let input = read(&threads, rows)?;
        keep(&threads, py.detach(|| threads.run(|| answer(input)))?)?;
        py.check_signals()?;
        if let Some(progress) = progress {
            progress.call1((done, count))?;
        }
    }
    Ok(())
}

/// Time between two looks at signals while another thread works.
const TURN: Duration = Duration::from_millis(50);

/// More than a thread takes to begin, which ends if it lacks them.
const THREAD_BYTES: usize = 4 << 20;

/// Does one long work in the background, on all threads. It is given a function that is to be told of its steps, of which
/// there are `count`; now and then `progress(done, count)` is called on this thread.
///
/// # Errors
/// Those of the work, of `progress`, and of signals. Then the other thread unwinds when it next tells of a step, and this
/// waits for that no longer than a turn.
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
                // A builder cannot be told to stop. This is no panic: no hook is called, and nobody joins the thread.
                resume_unwind(Box::new("given up"));
            }
            told.0.fetch_add(steps, Ordering::Relaxed);
        };
        // Nobody listens any more after an error.
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
        // `progress` or the handler of a signal may have forked.
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
