//! Memory that a thread reuses between queries: allocation or clearing for each ray would cost a tenth of its time.

use std::cell::Cell;
use std::thread::LocalKey;

use crate::wide::Scratch;

/// Lends the memory of this thread. A query inside another query gets new memory.
#[inline(always)]
pub(super) fn lend<T: Default, R>(kept: &'static LocalKey<Cell<T>>, run: impl FnOnce(&mut T) -> R) -> R {
    let mut memory = kept.try_with(Cell::take).unwrap_or_default();
    let ran = run(&mut memory);
    // A thread that ends cannot keep it.
    _ = kept.try_with(|kept| kept.set(memory));
    ran
}

/// Calls a function with the cursors' memory of this thread.
#[inline(always)]
pub(super) fn with_memory<R>(run: impl FnOnce(&mut [Scratch; 2]) -> R) -> R {
    lend(&MEMORY, |memory| run(memory.get_or_insert_default()))
}

thread_local! {
    /// Memory of two cursors.
    static MEMORY: Cell<Option<Box<[Scratch; 2]>>> = const { Cell::new(None) };
}
