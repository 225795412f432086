//! No panic crosses the border. C cannot panic, so this compiles the modules of errors once more: they take a second,
//! and the whole library in its test build takes a minute.

#![allow(unsafe_code, dead_code, unreachable_pub, missing_docs, reason = "the modules are parts of the library")]

#[path = "../src/border.rs"]
mod border;
#[path = "../src/error.rs"]
mod error;
#[path = "../src/memory.rs"]
mod memory;

use border::{answer, stackless_error_message};
use error::Error;

#[test]
fn no_panic_crosses_the_border() {
    #[allow(clippy::panic)]
    let error = answer(|| panic!("planted"));
    assert_eq!(error, Error::Internal);
    // SAFETY: this thread has failed, and not since.
    let message = unsafe { std::ffi::CStr::from_ptr(stackless_error_message()) };
    assert_eq!(message.to_str(), Ok("a bug in this library: planted"));
}
