//! Memory of the caller: checked pointers, and arrays whose elements are a stride apart.
//!
//! The header states the duties of the caller: pointers are null or point to as many elements as the call says, and no
//! other thread changes these elements during the call. This module checks the rest.

use std::ffi::{CStr, c_char};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;

use crate::error::Fault;

/// Elements that a thread takes at once, as in the library.
const PIECE: usize = 256;

/// A value at any address: its alignment is 1.
#[repr(C, packed)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anywhere<T>(pub(crate) T);

/// The name of an argument, and which element of it is meant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    name: &'static str,
    index: Option<usize>,
}

impl Element {
    /// A single one.
    pub(crate) const fn of(name: &'static str) -> Self {
        Self { name, index: None }
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        self.index.map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}

/// Checks a pointer to something that C got from this library.
///
/// # Safety
/// If it is neither null nor misaligned, it points to a `T` that nothing changes during `'a`.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Fault> {
    check(pointer, name)?;
    // SAFETY: it is neither null nor misaligned, and so this is what the caller promises.
    Ok(unsafe { &*pointer })
}

/// The same, for something that is to be changed.
///
/// # Safety
/// If it is neither null nor misaligned, it points to a `T` that nothing else uses during `'a`.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T, name: &'static str) -> Result<&'a mut T, Fault> {
    check(pointer, name)?;
    // SAFETY: it is neither null nor misaligned, and so this is what the caller promises.
    Ok(unsafe { &mut *pointer })
}

/// A path that ends with a zero byte.
///
/// # Safety
/// If it is not null, there is such a text during `'a`, and nothing changes it.
pub(crate) unsafe fn path<'a>(pointer: *const c_char, name: &'static str) -> Result<&'a Path, Fault> {
    check(pointer, name)?;
    // SAFETY: it is not null, and so this is what the caller promises.
    let text = unsafe { CStr::from_ptr(pointer) };
    let text = text.to_str().map_err(|error| Fault::argument(format!("{name}: {error}, expected UTF-8")))?;
    Ok(Path::new(text))
}

/// Values that follow each other, to be written.
///
/// # Safety
/// As [`Out::new`].
pub(crate) unsafe fn values<'a, T: Copy>(name: &'static str, first: *mut T, count: usize) -> Result<Out<'a, T>, Fault> {
    // SAFETY: as the caller promises.
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

/// Where elements are: the first, and how many bytes it is from each to the next.
#[derive(Debug)]
struct Layout {
    stride: usize,
    count: usize,
}

impl Layout {
    /// Checks strides and sizes. The pointer may be null if there are no elements.
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
        // No object is larger, and no offset within it may overflow.
        let bytes = stride.checked_mul(count - 1).and_then(|bytes| bytes.checked_add(size));
        if bytes.is_none_or(|bytes| bytes > isize::MAX as usize || pointer.addr().checked_add(bytes).is_none()) {
            let expected = "expected an array within the address space";
            return Err(Fault::argument(format!("{name}: {count} elements, a stride of {stride}, {expected}")));
        }
        Ok(Self { stride, count })
    }

    /// That of one element.
    fn one<T>() -> Self {
        Self { stride: size_of::<T>(), count: 1 }
    }

    /// The offset of an element in bytes, which is within the array.
    fn offset(&self, index: usize) -> usize {
        assert!(index < self.count, "element {index} of {}", self.count);
        index * self.stride
    }
}

/// An array of the caller, to be read.
#[derive(Debug)]
pub(crate) struct In<'a, T> {
    first: *const T,
    layout: Layout,
    /// The name in errors, and whether it is a single element.
    name: (&'static str, bool),
    borrowed: PhantomData<&'a T>,
}

// SAFETY: it is only read, and nothing writes there during `'a`, as `new` requires.
unsafe impl<T: Sync> Sync for In<'_, T> {}

impl<T: Copy> In<'_, T> {
    /// An array of elements that are `stride` bytes apart.
    ///
    /// # Safety
    /// If the pointer passes the checks of [`Layout::new`], `count` elements that are valid as `T` are there during
    /// `'a`, and nothing changes them.
    pub(crate) unsafe fn new(name: &'static str, first: *const T, stride: usize, count: usize) -> Result<Self, Fault> {
        let layout = Layout::new(name, first, stride, count)?;
        Ok(Self { first, layout, name: (name, false), borrowed: PhantomData })
    }

    /// One element.
    ///
    /// # Safety
    /// As [`new`](Self::new).
    pub(crate) unsafe fn one(name: &'static str, pointer: *const T) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout::one::<T>(), name: (name, true), borrowed: PhantomData })
    }

    /// One element that stands for as many.
    ///
    /// # Safety
    /// As [`new`](Self::new), with a count of 1.
    pub(crate) unsafe fn repeated(name: &'static str, pointer: *const T, count: usize) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout { stride: 0, count }, name: (name, true), borrowed: PhantomData })
    }

    pub(crate) fn count(&self) -> usize {
        self.layout.count
    }

    /// Where an element is.
    pub(crate) fn pointer(&self, index: usize) -> *const T {
        self.first.wrapping_byte_add(self.layout.offset(index))
    }

    pub(crate) fn element(&self, index: usize) -> Element {
        let (name, is_one) = self.name;
        Element { name, index: (!is_one).then_some(index) }
    }

    pub(crate) fn get(&self, index: usize) -> T {
        let offset = self.layout.offset(index);
        // SAFETY: the offset is within the array, in which there are elements as `new` requires.
        unsafe { self.first.byte_add(offset).read() }
    }

    /// Copies all elements.
    pub(crate) fn to_vec(&self) -> Result<Vec<T>, Fault> {
        let mut all = Vec::new();
        let bytes = self.count().saturating_mul(size_of::<T>());
        all.try_reserve_exact(self.count()).map_err(|_| Fault::memory(bytes))?;
        all.extend((0..self.count()).map(|index| self.get(index)));
        Ok(all)
    }
}

/// An array of the caller, to be written.
#[derive(Debug)]
pub(crate) struct Out<'a, T> {
    first: *mut T,
    layout: Layout,
    borrowed: PhantomData<&'a mut T>,
}

// SAFETY: it is as a mutable slice.
unsafe impl<T: Send> Send for Out<'_, T> {}

// SAFETY: a shared one gives nothing but its layout, and `write` to callers that see to it that elements are not
// shared.
unsafe impl<T: Send> Sync for Out<'_, T> {}

impl<T: Copy> Out<'_, T> {
    /// An array of elements that are `stride` bytes apart.
    ///
    /// # Safety
    /// If the pointer passes the checks of [`Layout::new`], there is memory for `count` elements during `'a`, and
    /// nothing else uses it. It need not be initialised.
    pub(crate) unsafe fn new(name: &'static str, first: *mut T, stride: usize, count: usize) -> Result<Self, Fault> {
        let layout = Layout::new(name, first, stride, count)?;
        Ok(Self { first, layout, borrowed: PhantomData })
    }

    /// One element.
    ///
    /// # Safety
    /// As [`new`](Self::new).
    pub(crate) unsafe fn one(name: &'static str, pointer: *mut T) -> Result<Self, Fault> {
        check(pointer, name)?;
        Ok(Self { first: pointer, layout: Layout::one::<T>(), borrowed: PhantomData })
    }

    pub(crate) fn count(&self) -> usize {
        self.layout.count
    }

    pub(crate) fn set(&mut self, index: usize, value: T) {
        // SAFETY: no other thread has it while it is borrowed here.
        unsafe { self.write(index, value) };
    }

    /// Writes as many elements of `values` as there are in both, and returns how many `values` has.
    pub(crate) fn fill(&mut self, values: &[T]) -> usize {
        for (index, &value) in values.iter().enumerate().take(self.count()) {
            self.set(index, value);
        }
        values.len()
    }

    /// Writes what `answer` makes of ranges of indices, one range after the other or on the threads of this pool.
    ///
    /// # Errors
    /// That of the first range that has one.
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
        let fault = if is_parallel { pieces.into_par_iter().find_map_first(piece) } else { pieces.find_map(piece) };
        fault.map_or(Ok(()), Err)
    }

    /// # Safety
    /// No other thread uses this element meanwhile.
    unsafe fn write(&self, index: usize, value: T) {
        let offset = self.layout.offset(index);
        // SAFETY: the offset is within the array, where there is memory as `new` requires.
        unsafe { self.first.byte_add(offset).write(value) };
    }
}
