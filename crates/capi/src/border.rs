//! Results of calls from C: an error code and a message. Panics become errors.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;

use crate::error::{Error, Fault};

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Returns the reason why the last failed call of this thread failed: one line that names the element, the found and the
/// expected value. Empty if no call has failed. Valid until the next failure of this thread.
#[allow(unsafe_code, reason = "its name is exported")]
#[unsafe(no_mangle)]
pub extern "C" fn stackless_error_message() -> *const c_char {
    // Null only during thread exit.
    MESSAGE.try_with(|message| message.borrow().as_ptr()).unwrap_or(ptr::null())
}

/// Does the work of a call, and returns its code.
pub(crate) fn answer(work: impl FnOnce() -> Result<(), Fault>) -> Error {
    // After this code the header tells callers to destroy the scene, so a half-changed scene is acceptable.
    let fault = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => return Error::None,
        Ok(Err(fault)) => fault,
        Err(panic) => Fault::new(Error::Internal, format!("a bug in this library: {}", text(&*panic))),
    };
    // No message of this library has a zero byte.
    let message = CString::new(fault.message).unwrap_or_default();
    // During thread exit there is no place for the message.
    drop(MESSAGE.try_with(|kept| kept.replace(message)));
    fault.error
}

/// The message of a panic.
fn text(panic: &(dyn Any + Send)) -> &str {
    let owned = panic.downcast_ref::<String>().map(String::as_str);
    owned.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}
