//! The library for C and C++. Its documentation is `include/stackless.h`, which cbindgen generates from this crate.
//!
//! [`double`] and [`single`] have the functions that C calls. [`memory`], [`filters`] and [`ways`], the only other
//! modules with `unsafe`, convert their pointers to values. The functions then call [`queries`], [`exact`], [`scene`] and
//! [`instances`](mod@instances), which are safe.

#![deny(unsafe_code)]

mod border;
#[allow(unsafe_code, reason = "C calls it, with pointers")]
pub mod double;
mod error;
mod exact;
#[allow(unsafe_code, reason = "calls the functions of the caller")]
mod filters;
mod instances;
#[allow(unsafe_code, reason = "reads and writes through the pointers of the caller")]
mod memory;
mod queries;
mod scene;
#[allow(unsafe_code, reason = "C calls it, with pointers")]
pub mod single {
    //! C functions for scenes in single precision: [`double`](super::double) with other names, by `build.rs`.
    include!(concat!(env!("OUT_DIR"), "/single.rs"));
}
mod types;
#[allow(unsafe_code, reason = "reads the points of rays through the pointers of the caller")]
mod ways;

pub use border::stackless_error_message;
pub use error::Error;
pub use exact::{ExactRay, Point};
pub use instances::{Instances, Object};
pub use scene::Scene;
pub use types::{Filter, Hit, InstanceHit, Near, Options, Ray};
