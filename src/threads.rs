//! Work for all threads, and with the feature `parallel` off for the one that calls. What comes out is the same.
//!
//! The only place that names rayon: call sites carry no `cfg`.
#![cfg_attr(not(feature = "rays"), allow(dead_code, reason = "the core shares little work"))]
#![cfg_attr(not(feature = "parallel"), allow(unused_variables, reason = "one thread takes all at once"))]

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::Range;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// How many threads share the work.
pub(crate) fn count() -> usize {
    #[cfg(feature = "parallel")]
    let count = rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    let count = 1;
    count
}

/// Does both.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(a, b);
    #[cfg(not(feature = "parallel"))]
    {
        a();
        b();
    }
}

/// What `f` makes of each index, in order. A thread takes at least `least` at once.
pub(crate) fn map<A: Send>(range: Range<usize>, least: usize, f: impl Fn(usize) -> A + Sync + Send) -> Vec<A> {
    map_with(range, least, || (), |(), i| f(i))
}

/// [`map`] with something that a thread keeps from one index to the next, and that must not change what comes out.
pub(crate) fn map_with<M, A: Send>(
    range: Range<usize>,
    least: usize,
    make: impl Fn() -> M + Sync + Send,
    f: impl Fn(&mut M, usize) -> A + Sync + Send,
) -> Vec<A> {
    #[cfg(feature = "parallel")]
    let mapped = range.into_par_iter().with_min_len(least).map_init(make, f).collect();
    #[cfg(not(feature = "parallel"))]
    let mapped = {
        let mut kept = make();
        range.map(|i| f(&mut kept, i)).collect()
    };
    mapped
}

/// Maps chunks, and merges neighbours until one is left; `None` of nothing. Both may be grouped in any way.
pub(crate) fn reduce<T: Sync, A: Send>(
    items: &[T],
    chunk: usize,
    map: impl Fn(&[T]) -> A + Sync + Send,
    merge: impl Fn(A, A) -> A + Sync + Send,
) -> Option<A> {
    #[cfg(feature = "parallel")]
    let reduced = items.par_chunks(chunk).map(map).reduce_with(merge);
    #[cfg(not(feature = "parallel"))]
    let reduced = items.chunks(chunk).map(map).reduce(merge);
    reduced
}

/// Changes each item. A thread takes at least `least` at once.
pub(crate) fn update<T: Send>(items: &mut [T], least: usize, f: impl Fn(&mut T) + Sync + Send) {
    #[cfg(feature = "parallel")]
    items.par_iter_mut().with_min_len(least).for_each(f);
    #[cfg(not(feature = "parallel"))]
    items.iter_mut().for_each(f);
}

/// Sorts; equal items may change places, so there should be none that differ.
pub(crate) fn sort_by<T: Send>(items: &mut [T], order: impl Fn(&T, &T) -> Ordering + Sync) {
    #[cfg(feature = "parallel")]
    items.par_sort_unstable_by(order);
    #[cfg(not(feature = "parallel"))]
    items.sort_unstable_by(order);
}
