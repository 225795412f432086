//! The threads of this process. A child that was forked has none of its parent's.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// One thread traces so many rays: to wake another would take longer. The library has the same limit.
pub(crate) const FEW: usize = 256;

/// The pool, and the process that made it.
///
/// It is locked only by threads that hold the interpreter's lock. `os.fork` holds that too, so that the child never
/// finds it locked by a thread that is not there.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// What shares some work: all threads of this process, or the one that calls.
pub(crate) struct Threads(Option<Arc<ThreadPool>>);

impl Threads {
    /// The one that calls.
    pub(crate) const fn one() -> Self {
        Self(None)
    }

    /// All threads: as many as processors, or as `RAYON_NUM_THREADS` says.
    pub(crate) fn all(_: Python<'_>) -> PyResult<Self> {
        let mut held = POOL.lock().unwrap_or_else(PoisonError::into_inner);
        let process = std::process::id();
        if let Some((_, pool)) = held.as_ref().filter(|(maker, _)| *maker == process) {
            return Ok(Self(Some(Arc::clone(pool))));
        }
        let made = ThreadPoolBuilder::new().build().map_err(none_started)?;
        // Each thread has its memory before it is asked how much is left.
        made.broadcast(|_| ());
        let made = Arc::new(made);
        // The parent's pool is not dropped: that would wait for threads that are not there.
        std::mem::forget(held.replace((process, Arc::clone(&made))));
        Ok(Self(Some(made)))
    }

    pub(crate) fn count(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| pool.current_num_threads())
    }

    /// Does work whose parallel parts these threads share.
    pub(crate) fn run<A: Send>(&self, work: impl FnOnce() -> A + Send) -> A {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// Makes an item of each index. Of several errors it returns the first.
    pub(crate) fn map<A: Send>(
        &self,
        range: Range<usize>,
        f: impl Fn(usize) -> PyResult<A> + Sync,
    ) -> PyResult<Vec<A>> {
        let shared = self.0.as_ref().filter(|_| range.len() > ROWS).and_then(|pool| {
            let range = range.clone().into_par_iter().with_min_len(ROWS);
            pool.install(|| range.map(|index| f(index).ok()).collect())
        });
        shared.map_or_else(|| range.map(f).collect(), Ok)
    }
}

/// A thread that the system refuses: it has no memory for its stack, or has threads enough.
pub(crate) fn none_started(error: impl ToString) -> PyErr {
    let error = error.to_string();
    PyMemoryError::new_err(format!("no thread could be started: {error}; RAYON_NUM_THREADS limits their number"))
}

/// Rows that a thread reads or keeps at once.
pub(crate) const ROWS: usize = 4096;

/// What is made of each piece of some items, in order. It is one piece, if this thread has no others to share with.
pub(crate) fn of_chunks<I: Sync, A: Send>(
    items: &[I],
    chunk: usize,
    of_chunk: impl Fn(&[I]) -> PyResult<A> + Sync,
) -> PyResult<Vec<A>> {
    if items.len() <= chunk || rayon::current_thread_index().is_none() {
        return Ok(vec![of_chunk(items)?]);
    }
    items.par_chunks(chunk).map(&of_chunk).collect()
}
