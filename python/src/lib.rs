//! The extension module of the Python package `stackless_bvh`: input arrays, the library's answers, output arrays.
//!
//! The Python modules check the types and shapes of arrays; this module checks the values.
#![forbid(unsafe_code)]

mod all_hits;
mod arrays;
mod batch;
mod errors;
mod exact;
mod file;
mod held;
mod inside;
mod instances;
mod memory;
mod near;
mod placed;
mod queries;
mod scene;
mod space;
mod threads;

use pyo3::prelude::*;

/// The content of the extension module.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::exact::ExactRays;
    #[pymodule_export]
    use crate::instances::Instances;
    #[pymodule_export]
    use crate::scene::Scene;
}
