//! Memory that a thread keeps between queries: to allocate or to clear it for each ray would cost a tenth of its time.

use std::cell::Cell;
use std::thread::LocalKey;

/// Lends what this thread keeps. A query inside of another gets memory of its own.
#[inline(always)]
pub(super) fn lend<T: Default, R>(kept: &'static LocalKey<Cell<T>>, run: impl FnOnce(&mut T) -> R) -> R {
    let mut memory = kept.try_with(Cell::take).unwrap_or_default();
    let ran = run(&mut memory);
    // A thread that ends keeps nothing any more.
    _ = kept.try_with(|kept| kept.set(memory));
    ran
}
