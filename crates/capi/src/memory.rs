//! Memory of the caller: checked pointers, and arrays with strides.
//!
//! The header states the duties of the caller: a pointer is null or points to the number of elements in the call, and
//! no other thread changes these elements during the call. This module checks all other requirements.

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;

use crate::error::{Element, Fault};

/// Number of elements that a thread takes at once, as in the library.
pub(crate) const PIECE: usize = 256;

/// A value at any address. Its alignment is 1.
#[repr(C, packed)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anywhere<T>(pub(crate) T);

/// Returns an empty vector with room for `count` elements.
pub(crate) fn room<T>(count: usize) -> Result<Vec<T>, Fault> {
    let mut all = Vec::new();
    let bytes = count.saturating_mul(size_of::<T>());
    all.try_reserve_exact(count).map_err(|_| Fault::memory(bytes))?;
    Ok(all)
}

/// Checks a pointer to an object of this library.
///
/// # Safety
/// If the pointer is neither null nor misaligned, it points to a `T` that does not change during `'a`.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Fault> {
    check(pointer, name)?;
    // SAFETY: the pointer is neither null nor misaligned, so the caller's guarantee applies.
    Ok(unsafe { &*pointer })
}

/// Checks a pointer to an object that is to be changed.
///
/// # Safety
/// If the pointer is neither null nor misaligned, it points to a `T` with no other use during `'a`.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T, name: &'static str) -> Result<&'a mut T, Fault> {
    check(pointer, name)?;
    // SAFETY: the pointer is neither null nor misaligned, so the caller's guarantee applies.
    Ok(unsafe { &mut *pointer })
}

/// Reads a path that ends with a zero byte.
///
/// # Safety
/// If the pointer is not null, it points to such a text, which does not change during `'a`.
pub(crate) unsafe fn path<'a>(pointer: *const c_char, name: &'static str) -> Result<&'a Path, Fault> {
    check(pointer, name)?;
    // SAFETY: the pointer is not null, so the caller's guarantee applies.
    let text = unsafe { CStr::from_ptr(pointer) };
    let text = text.to_str().map_err(|error| Fault::argument(format!("{name}: {error}, expected UTF-8")))?;
    Ok(Path::new(text))
}

/// An output array of consecutive values.
///
/// # Safety
/// See [`Out::new`].
pub(crate) unsafe fn values<'a, T: Copy>(name: &'static str, first: *mut T, count: usize) -> Result<Out<'a, T>, Fault> {
    // SAFETY: the caller guarantees the requirements.
    unsafe { Out::new(name, first, size_of::<T>(), count) }
}

#[inline]
fn check<T>(pointer: *const T, name: &str) -> Result<(), Fault> {
    if pointer.is_null() || !pointer.is_aligned() { Err(refused(pointer, name)) } else { Ok(()) }
}

#[cold]
fn refused<T>(pointer: *const T, name: &str) -> Fault {
    if pointer.is_null() {
        return Fault::argument(format!("{name}: null, expected a pointer"));
    }
    Fault::argument(format!("{name}: address {pointer:p}, expected a multiple of {}", align_of::<T>()))
}

/// The layout of elements: the first address, the stride in bytes, and the count.
#[derive(Debug)]
struct Layout {
    stride: usize,
    count: usize,
}

impl Layout {
    /// Checks strides and sizes. Without elements the pointer may be null.
    fn new<T>(name: &str, pointer: *const T, stride: usize, count: usize) -> Result<Self, Fault> {
        if count == 0 {
            return Ok(Self { stride, count });
        }
        check(pointer, name)?;
        let (size, alignment) = (size_of::<T>(), align_of::<T>());
        if stride < size || !stride.is_multiple_of(alignment) {
            let expected = format!("expected a multiple of {alignment} that is at least {size}");
            return Err(Fault::argument(format!("stride of {name}: {stride}, {expected}")));
        }
        // An object is never larger, and offsets within it must not overflow.
        let bytes = stride.checked_mul(count - 1).and_then(|bytes| bytes.checked_add(size));
        if bytes.is_none_or(|bytes| bytes > isize::MAX as usize || pointer.addr().checked_add(bytes).is_none()) {
            let expected = "expected an array within the address space";
            return Err(Fault::argument(format!("{name}: {count} elements, a stride of {stride}, {expected}")));
        }
        Ok(Self { stride, count })
    }

    /// The layout of one element.
    fn one<T>() -> Self {
        Self { stride: size_of::<T>(), count: 1 }
    }

    /// The offset of an element in bytes, which is within the array.
    fn offset(&self, index: usize) -> usize {
        assert!(index < self.count, "element {index} of {}", self.count);
        index * self.stride
    }
}

/// An input array of the caller.
#[derive(Debug)]
pub(crate) struct In<'a, T> {
    first: *const T,
    layout: Layout,
    /// The name in errors, and whether it is a single element.
    name: (&'static str, bool),
    borrowed: PhantomData<&'a T>,
}

// SAFETY: the array is only read, and does not change during `'a`, as `new` requires.
unsafe impl<T: Sync> Sync for In<'_, T> {}

impl<T: Copy> In<'_, T> {
    /// An array of elements that are `stride` bytes apart.
    ///
    /// # Safety
    /// If the pointer passes the checks of [`Layout::new`], it points to `count` valid elements of type `T`, which do
    /// not change during `'a`.
    pub(crate) unsafe fn new(name: &'static str, first: *const T, stride: usize, count: usize) -> Result<Self, Fault> {
        let layout = Layout::new(name, first, stride, count)?;
        Ok(Self { first, layout, name: (name, false), borrowed: PhantomData })
    }

    /// One element.
    ///
    /// # Safety
    /// See [`new`](Self::new).
    pub(crate) unsafe fn one(name: &'static str, pointer: *const T) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout::one::<T>(), name: (name, true), borrowed: PhantomData })
    }

    /// One element, repeated `count` times.
    ///
    /// # Safety
    /// See [`new`](Self::new), with a count of 1.
    pub(crate) unsafe fn repeated(name: &'static str, pointer: *const T, count: usize) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout { stride: 0, count }, name: (name, true), borrowed: PhantomData })
    }

    pub(crate) fn count(&self) -> usize {
        self.layout.count
    }

    /// The address of an element.
    pub(crate) fn pointer(&self, index: usize) -> *const T {
        self.first.wrapping_byte_add(self.layout.offset(index))
    }

    pub(crate) fn element(&self, index: usize) -> Element {
        let (name, is_one) = self.name;
        Element { name, index: (!is_one).then_some(index) }
    }

    pub(crate) fn get(&self, index: usize) -> T {
        let offset = self.layout.offset(index);
        // SAFETY: the offset is within the array, whose elements are valid as `new` requires.
        unsafe { self.first.byte_add(offset).read() }
    }

    /// Copies all elements.
    pub(crate) fn to_vec(&self) -> Result<Vec<T>, Fault> {
        let mut all = room(self.count())?;
        all.extend((0..self.count()).map(|index| self.get(index)));
        Ok(all)
    }
}

/// An output array of the caller.
#[derive(Debug)]
pub(crate) struct Out<'a, T> {
    first: *mut T,
    layout: Layout,
    borrowed: PhantomData<&'a mut T>,
}

// SAFETY: it behaves like a mutable slice.
unsafe impl<T: Send> Send for Out<'_, T> {}

// SAFETY: a shared reference gives access only to the layout, and to `write`, whose callers use each element once.
unsafe impl<T: Send> Sync for Out<'_, T> {}

impl<T: Copy> Out<'_, T> {
    /// An array of elements that are `stride` bytes apart.
    ///
    /// # Safety
    /// If the pointer passes the checks of [`Layout::new`], it points to memory for `count` elements, with no other use
    /// during `'a`. The memory need not be initialised.
    pub(crate) unsafe fn new(name: &'static str, first: *mut T, stride: usize, count: usize) -> Result<Self, Fault> {
        let layout = Layout::new(name, first, stride, count)?;
        Ok(Self { first, layout, borrowed: PhantomData })
    }

    /// One element.
    ///
    /// # Safety
    /// See [`new`](Self::new).
    pub(crate) unsafe fn one(name: &'static str, pointer: *mut T) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout::one::<T>(), borrowed: PhantomData })
    }

    pub(crate) fn count(&self) -> usize {
        self.layout.count
    }

    pub(crate) fn set(&mut self, index: usize, value: T) {
        // SAFETY: no other thread uses the array while it is borrowed mutably.
        unsafe { self.write(index, value) };
    }

    /// Writes elements of `values` until either array ends, and returns the length of `values`.
    pub(crate) fn fill(&mut self, values: &[T]) -> usize {
        for (index, &value) in values.iter().enumerate().take(self.count()) {
            self.set(index, value);
        }
        values.len()
    }

    /// Writes the results of `answer` for ranges of indices, sequentially or on the threads of this pool.
    ///
    /// # Errors
    /// The error of the first range that fails.
    pub(crate) fn answer(
        &mut self,
        is_parallel: bool,
        answer: impl Fn(Range<usize>) -> Result<Vec<T>, Fault> + Sync,
    ) -> Result<(), Fault>
    where
        T: Send,
    {
        let this = &*self;
        let piece = |number: usize| {
            let range = number * PIECE..this.count().min((number + 1) * PIECE);
            let values = match answer(range.clone()) {
                Ok(values) => values,
                Err(fault) => return Some(fault),
            };
            for (index, value) in range.zip(values) {
                // SAFETY: no other piece has this index.
                unsafe { this.write(index, value) };
            }
            None
        };
        let mut pieces = 0..this.count().div_ceil(PIECE);
        let fault = if is_parallel {
            // A thread takes one piece at a time, so no other thread waits long at the end.
            pieces.into_par_iter().with_max_len(1).find_map_first(piece)
        } else {
            pieces.find_map(piece)
        };
        fault.map_or(Ok(()), Err)
    }

    /// # Safety
    /// No other thread uses this element during the call.
    unsafe fn write(&self, index: usize, value: T) {
        let offset = self.layout.offset(index);
        // SAFETY: the offset is within the array, whose memory is valid as `new` requires.
        unsafe { self.first.byte_add(offset).write(value) };
    }
}
