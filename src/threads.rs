//! Work for all threads, and with the feature `parallel` off for the one that calls. What comes out is the same.
//!
//! The only place that names rayon: call sites carry no `cfg`.

use std::ops::Range;

/// How many threads share the work.
pub(crate) fn count() -> usize {
    imp::count()
}

/// Does both.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    imp::join(a, b);
}

/// What `f` makes of each index, in order. A thread takes at least `least` at once.
pub(crate) fn map<A: Send>(range: Range<usize>, least: usize, f: impl Fn(usize) -> A + Sync) -> Vec<A> {
    map_with(range, least, || (), |(), i| f(i))
}

/// [`map`] with something that a thread keeps from one index to the next, and that must not change what comes out.
pub(crate) fn map_with<M, A: Send>(
    range: Range<usize>,
    least: usize,
    make: impl Fn() -> M + Sync + Send,
    f: impl Fn(&mut M, usize) -> A + Sync + Send,
) -> Vec<A> {
    imp::map_with(range, least, make, f)
}

/// Maps chunks, and merges neighbours until one is left; `None` of nothing. Both may be grouped in any way.
pub(crate) fn reduce<T: Sync, A: Send>(
    items: &[T],
    chunk: usize,
    map: impl Fn(&[T]) -> A + Sync + Send,
    merge: impl Fn(A, A) -> A + Sync + Send,
) -> Option<A> {
    imp::reduce(items, chunk, map, merge)
}

/// Changes each item. A thread takes at least `least` at once.
pub(crate) fn update<T: Send>(items: &mut [T], least: usize, f: impl Fn(&mut T) + Sync + Send) {
    imp::update(items, least, f);
}

/// Sorts; equal items may change places, so there should be none that differ.
pub(crate) fn sort_by<T: Send>(items: &mut [T], order: impl Fn(&T, &T) -> std::cmp::Ordering + Sync) {
    imp::sort_by(items, order);
}

#[cfg(feature = "parallel")]
mod imp {
    use std::ops::Range;

    use rayon::prelude::*;

    pub(super) fn count() -> usize {
        rayon::current_num_threads()
    }

    pub(super) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        rayon::join(a, b);
    }

    pub(super) fn map_with<M, A: Send>(
        range: Range<usize>,
        least: usize,
        make: impl Fn() -> M + Sync + Send,
        f: impl Fn(&mut M, usize) -> A + Sync + Send,
    ) -> Vec<A> {
        range.into_par_iter().with_min_len(least).map_init(make, f).collect()
    }

    pub(super) fn reduce<T: Sync, A: Send>(
        items: &[T],
        chunk: usize,
        map: impl Fn(&[T]) -> A + Sync + Send,
        merge: impl Fn(A, A) -> A + Sync + Send,
    ) -> Option<A> {
        items.par_chunks(chunk).map(map).reduce_with(merge)
    }

    pub(super) fn update<T: Send>(items: &mut [T], least: usize, f: impl Fn(&mut T) + Sync + Send) {
        items.par_iter_mut().with_min_len(least).for_each(f);
    }

    pub(super) fn sort_by<T: Send>(items: &mut [T], order: impl Fn(&T, &T) -> std::cmp::Ordering + Sync) {
        items.par_sort_unstable_by(order);
    }
}

#[cfg(not(feature = "parallel"))]
mod imp {
    use std::ops::Range;

    pub(super) fn count() -> usize {
        1
    }

    pub(super) fn join(a: impl FnOnce(), b: impl FnOnce()) {
        a();
        b();
    }

    pub(super) fn map_with<M, A>(
        range: Range<usize>,
        _: usize,
        make: impl Fn() -> M,
        f: impl Fn(&mut M, usize) -> A,
    ) -> Vec<A> {
        let mut kept = make();
        range.map(|i| f(&mut kept, i)).collect()
    }

    pub(super) fn reduce<T, A>(
        items: &[T],
        chunk: usize,
        map: impl Fn(&[T]) -> A,
        merge: impl Fn(A, A) -> A,
    ) -> Option<A> {
        items.chunks(chunk).map(map).reduce(merge)
    }

    pub(super) fn update<T>(items: &mut [T], _: usize, f: impl Fn(&mut T)) {
        items.iter_mut().for_each(f);
    }

    pub(super) fn sort_by<T>(items: &mut [T], order: impl Fn(&T, &T) -> std::cmp::Ordering) {
        items.sort_unstable_by(order);
    }
}
