//! As much of Kani's API as the harnesses use, over imports that CBMC knows. On other machines than WebAssembly it is
//! there to be compiled against.
#![no_std]

#[cfg(target_family = "wasm")]
mod machine;

pub use kani_macros::{proof, should_panic, unwind};

#[cfg_attr(target_family = "wasm", link(wasm_import_module = "vf"))]
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
