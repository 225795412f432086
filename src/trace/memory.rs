//! Memory that a thread reuses between queries: allocation or clearing for each ray would cost a tenth of its time.

use std::cell::Cell;
use std::thread::LocalKey;

/// Lends the memory of this thread. A query inside another query gets new memory.
#[inline(always)]
pub(super) fn lend<T: Default, R>(kept: &'static LocalKey<Cell<T>>, run: impl FnOnce(&mut T) -> R) -> R {
    let mut memory = kept.try_with(Cell::take).unwrap_or_default();
    let ran = run(&mut memory);
    // A thread that ends cannot keep it.
    _ = kept.try_with(|kept| kept.set(memory));
    ran
}
