//! Work for all threads, or without the feature `parallel` for the calling thread. The results are the same.
//!
//! Only this module names rayon: call sites have no `cfg`.
#![cfg_attr(not(feature = "rays"), allow(dead_code, reason = "the core shares little work"))]
#![cfg_attr(not(feature = "parallel"), allow(unused_variables, reason = "one thread takes all at once"))]

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::Range;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

#[cfg(feature = "rays")]
pub(crate) use floats::guarded;

/// Checks of the floating-point arithmetic of threads. `[ENV-1]`
#[cfg(feature = "rays")]
mod floats {
    use core::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    use crate::environment::{EnvironmentError, check_environment};

    /// Number of tasks that started on threads with invalid arithmetic, by error.
    static UNFIT: [(EnvironmentError, AtomicUsize); 2] =
        [(EnvironmentError::Subnormals, AtomicUsize::new(0)), (EnvironmentError::Rounding, AtomicUsize::new(0))];

    /// Returns the result of the work, if all participating threads have valid arithmetic.
    ///
    /// Concurrent work of another thread counts too. So it may be refused because of that work: in either case there is
    /// a thread with invalid arithmetic.
    pub(crate) fn guarded<A>(work: impl FnOnce() -> A) -> Result<A, EnvironmentError> {
        check_environment()?;
        let before = counts();
        let answer = work();
        match UNFIT.iter().zip(before.into_iter().zip(counts())).find(|(_, (before, after))| before != after) {
            Some(((error, _), _)) => Err(*error),
            None => Ok(answer),
        }
    }

    fn counts() -> [usize; 2] {
        UNFIT.each_ref().map(|(_, count)| count.load(Relaxed))
    }

    /// Call it at the start of a task. A thread that waits for the task sees its counts.
    #[cfg(feature = "parallel")]
    pub(super) fn probe() {
        if let Err(found) = check_environment() {
            UNFIT.iter().filter(|(error, _)| *error == found).for_each(|(_, count)| _ = count.fetch_add(1, Relaxed));
        }
    }
}

/// A core without rays uses no floats.
#[cfg(all(feature = "parallel", not(feature = "rays")))]
mod floats {
    pub(super) const fn probe() {}
}

/// Returns the number of threads that share the work.
pub(crate) fn count() -> usize {
    #[cfg(feature = "parallel")]
    let count = rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    let count = 1;
    count
}

/// Runs both functions.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(a, || {
        floats::probe();
        b();
    });
    #[cfg(not(feature = "parallel"))]
    {
        a();
        b();
    }
}

/// Returns `f` of each index, in order. A thread takes at least `least` indices at a time: for this number, the calling
/// thread does the work, and no other thread is started or woken.
pub(crate) fn map<A: Send>(range: Range<usize>, least: usize, f: impl Fn(usize) -> A + Sync + Send) -> Vec<A> {
    let mut all = Vec::new();
    map_into(&mut all, range, least, f);
    all
}

/// Computes [`map`] into an empty vector, which does not grow if it has room for all.
pub(crate) fn map_into<A: Send>(
    all: &mut Vec<A>,
    range: Range<usize>,
    least: usize,
    f: impl Fn(usize) -> A + Sync + Send,
) {
    #[cfg(feature = "parallel")]
    if range.len() > least {
        // Without an upper limit a thread takes a quarter of all at once, and the other threads wait for it at the end.
        let pieces = range.into_par_iter().with_min_len(least).with_max_len(least.max(1));
        pieces.map_init(floats::probe, |(), i| f(i)).collect_into_vec(all);
        return;
    }
    all.extend(range.map(f));
}

/// Computes [`map`] with a value that a thread reuses for each index, and that must not change the results.
pub(crate) fn map_with<M, A: Send>(
    range: Range<usize>,
    least: usize,
    make: impl Fn() -> M + Sync + Send,
    f: impl Fn(&mut M, usize) -> A + Sync + Send,
) -> Vec<A> {
    #[cfg(feature = "parallel")]
    let mapped = {
        let begin = || {
            floats::probe();
            make()
        };
        range.into_par_iter().with_min_len(least).map_init(begin, f).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let mapped = {
        let mut kept = make();
        range.map(|i| f(&mut kept, i)).collect()
    };
    mapped
}

/// Maps chunks, and merges neighbours until one is left; `None` for no items. Any grouping must be valid for both
/// functions.
pub(crate) fn reduce<T: Sync, A: Send>(
    items: &[T],
    chunk: usize,
    map: impl Fn(&[T]) -> A + Sync + Send,
    merge: impl Fn(A, A) -> A + Sync + Send,
) -> Option<A> {
    #[cfg(feature = "parallel")]
    let reduced = items.par_chunks(chunk).map_init(floats::probe, |(), chunk| map(chunk)).reduce_with(merge);
    #[cfg(not(feature = "parallel"))]
    let reduced = items.chunks(chunk).map(map).reduce(merge);
    reduced
}

/// Appends copies of all items of some parts.
pub(crate) fn append<T: Copy + Send + Sync>(all: &mut Vec<T>, parts: &[&[T]]) {
    #[cfg(feature = "parallel")]
    {
        let sum = |sum: &mut usize, part: &&[T]| {
            *sum += part.len();
            Some(*sum)
        };
        let ends: Vec<_> = parts.iter().scan(0, sum).collect();
        // A task takes consecutive items, so it searches for their part from that of the previous item.
        let begin = || {
            floats::probe();
            0
        };
        let item = |at: &mut usize, i: usize| {
            while ends[*at] <= i {
                *at += 1;
            }
            let part = parts[*at];
            part[part.len() - (ends[*at] - i)]
        };
        let count = ends.last().copied().unwrap_or(0);
        all.par_extend((0..count).into_par_iter().with_min_len(1 << 8).map_init(begin, item));
    }
    #[cfg(not(feature = "parallel"))]
    for part in parts {
        all.extend_from_slice(part);
    }
}

/// Changes each item. A thread takes at least `least` items at a time.
pub(crate) fn update<T: Send>(items: &mut [T], least: usize, f: impl Fn(&mut T) + Sync + Send) {
    #[cfg(feature = "parallel")]
    items.par_iter_mut().with_min_len(least).for_each_init(floats::probe, |(), item| f(item));
    #[cfg(not(feature = "parallel"))]
    items.iter_mut().for_each(f);
}

/// Changes each item, on this thread alone if a participating thread has invalid arithmetic. To change an item twice
/// must be equal to changing it once.
#[cfg(feature = "rays")]
pub(crate) fn update_anyway<T: Send>(items: &mut [T], least: usize, f: impl Fn(&mut T) + Sync + Send) {
    if guarded(|| update(items, least, &f)).is_err() {
        items.iter_mut().for_each(f);
    }
}

/// Sorts; equal items may change places, so equal items should not differ.
pub(crate) fn sort_by<T: Send>(items: &mut [T], order: impl Fn(&T, &T) -> Ordering + Sync) {
    #[cfg(feature = "parallel")]
    items.par_sort_unstable_by(order);
    #[cfg(not(feature = "parallel"))]
    items.sort_unstable_by(order);
}
