//! The threads of this process. A forked child has none of its parent's threads.

use std::ops::Range;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::failed;

/// Maximum number of rays for a single thread: waking another thread would take longer. The library has an equal limit.
pub(crate) const FEW: usize = 256;

/// The pool, and the id of the process that created it.
///
/// Only threads with the interpreter's lock lock it. `os.fork` holds that lock too, so a child never inherits it
/// locked.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads for some work: all threads of this process, or only the calling thread.
pub(crate) struct Threads(Option<Arc<ThreadPool>>);

impl Threads {
    /// The calling thread.
    pub(crate) const fn one() -> Self {
        Self(None)
    }

    /// All threads: `RAYON_NUM_THREADS`, or one for each processor.
    pub(crate) fn all(_: Python<'_>) -> PyResult<Self> {
        let mut held = POOL.lock().unwrap_or_else(PoisonError::into_inner);
        let process = std::process::id();
        if let Some((_, pool)) = held.as_ref().filter(|(maker, _)| *maker == process) {
            return Ok(Self(Some(Arc::clone(pool))));
        }
        let made = ThreadPoolBuilder::new().build().map_err(none_started)?;
        // Each thread allocates its memory before the free memory is checked.
        made.broadcast(|_| ());
        let made = Arc::new(made);
        // The parent's pool is not dropped: dropping would wait for threads that do not exist.
        std::mem::forget(held.replace((process, Arc::clone(&made))));
        Ok(Self(Some(made)))
    }

    pub(crate) fn count(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| pool.current_num_threads())
    }

    /// Runs work whose parallel parts use these threads.
    pub(crate) fn run<A: Send>(&self, work: impl FnOnce() -> A + Send) -> A {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// Runs work on these threads without the interpreter's lock, and meanwhile other work on this thread with the
    /// lock.
    pub(crate) fn run_beside<A: Send, B>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> PyResult<A> + Send,
        beside: impl FnOnce() -> B,
    ) -> (PyResult<A>, B) {
        let Some(pool) = &self.0 else { return (py.detach(work), beside()) };
        pool.in_place_scope(|scope| {
            let (sender, receiver) = channel();
            scope.spawn(move |_| drop(sender.send(work())));
            let other = beside();
            // The scope itself would wait with the lock.
            let answer = py.detach(move || receiver.recv());
            (answer.unwrap_or_else(|_| Err(failed("the threads have ended early"))), other)
        })
    }

    /// Computes an item for each index. Of several errors it returns the first.
    pub(crate) fn map<A: Send>(
        &self,
        range: Range<usize>,
        f: impl Fn(usize) -> PyResult<A> + Sync,
    ) -> PyResult<Vec<A>> {
        let shared = self.0.as_ref().filter(|_| range.len() > ROWS).and_then(|pool| {
            let range = range.clone().into_par_iter().with_min_len(ROWS).with_max_len(ROWS);
            pool.install(|| range.map(|index| f(index).ok()).collect())
        });
        shared.map_or_else(|| range.map(f).collect(), Ok)
    }
}

/// The error for a thread that cannot be started: no memory for its stack, or too many threads.
pub(crate) fn none_started(error: impl ToString) -> PyErr {
    let error = error.to_string();
    PyMemoryError::new_err(format!("no thread could be started: {error}; RAYON_NUM_THREADS limits their number"))
}

/// Number of rows that a thread reads at once.
pub(crate) const ROWS: usize = 4096;

/// Computes a result for each item, in order. A single item needs no other thread.
pub(crate) fn of_each<I: Send, A: Send>(items: impl Iterator<Item = I>, of: impl Fn(I) -> A + Sync) -> Vec<A> {
    let items: Vec<_> = items.collect();
    if items.len() <= 1 || rayon::current_thread_index().is_none() {
        return items.into_iter().map(of).collect();
    }
    // Without a limit a thread takes a quarter of the items at once, and the other threads wait for it at the end.
    items.into_par_iter().with_max_len(1).map(&of).collect()
}

/// Computes a result for each chunk of the items, in order. A single thread gets one chunk.
pub(crate) fn of_chunks<I: Sync, A: Send>(
    items: &[I],
    chunk: usize,
    of_chunk: impl Fn(&[I]) -> PyResult<A> + Sync,
) -> PyResult<Vec<A>> {
    of_each(items.chunks(chunk), of_chunk).into_iter().collect()
}
