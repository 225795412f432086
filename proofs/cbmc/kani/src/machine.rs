//! The panic handler and the allocator of a WebAssembly module without `std`.

use core::alloc::{GlobalAlloc, Layout};
use core::cell::Cell;

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
