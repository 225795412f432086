//! The extension module of the Python package `stackless_bvh`: arrays in, answers of the library, arrays out.
//!
//! The modules of the package check the kinds and the shapes of arrays; what stands in them is checked here.
#![forbid(unsafe_code)]

mod arrays;
mod batch;
mod errors;
mod exact;
mod file;
mod inside;
mod instances;
mod memory;
mod near;
mod queries;
mod scene;
mod space;
mod threads;

use pyo3::prelude::*;

/// What the package is made of.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::exact::ExactRays;
    #[pymodule_export]
    use crate::instances::Instances;
    #[pymodule_export]
    use crate::scene::Scene;
}
