//! As much of Kani's API as the harnesses use, over three imports that CBMC knows.
#![no_std]

use core::alloc::{GlobalAlloc, Layout};
use core::cell::Cell;

pub use kani_macros::{proof, should_panic, unwind};

#[link(wasm_import_module = "vf")]
unsafe extern "C" {
    fn nondet_u64() -> u64;
    #[link_name = "assume"]
    fn assume_import(condition: u32);
    #[link_name = "cover"]
    fn cover_import(id: u32, condition: u32);
    #[link_name = "claim"]
    fn claim_import(condition: u32);
}

/// A type of which there is any value.
pub trait Arbitrary: Sized {
    fn any() -> Self;
}

impl Arbitrary for u64 {
    fn any() -> u64 {
        unsafe { nondet_u64() }
    }
}

pub fn any<T: Arbitrary>() -> T {
    T::any()
}

pub fn assume(condition: bool) {
    unsafe { assume_import(condition.into()) }
}

/// Kani's own assertion. A property apart from panics.
pub fn assert(condition: bool, _: &'static str) {
    unsafe { claim_import(condition.into()) }
}

/// The number of a name is what the invoking crate makes of it.
#[macro_export]
macro_rules! cover {
    ($condition:expr, $name:literal) => {
        $crate::cover_id(const { crate::id($name) }, $condition)
    };
}

pub fn cover_id(id: u32, condition: bool) {
    unsafe { cover_import(id, condition.into()) }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}

/// Memory that is never given back.
struct Bump {
    next: Cell<usize>,
}

const BYTES: usize = 1024;

static mut HEAP: [u64; BYTES / 8] = [0; BYTES / 8];

#[global_allocator]
static ALLOCATOR: Bump = Bump { next: Cell::new(0) };

/// There is one thread.
unsafe impl Sync for Bump {}

unsafe impl GlobalAlloc for Bump {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // Multiples of 8 are aligned for all words.
        let start = self.next.get();
        self.next.set(start + layout.size().next_multiple_of(8));
        if self.next.get() > BYTES || layout.align() > 8 {
            core::arch::wasm32::unreachable();
        }
        unsafe { (&raw mut HEAP).cast::<u8>().add(start) }
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}
