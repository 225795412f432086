//! WGSL kernels of stackless traversal, compared with the oracle of `stackless_bvh` and measured. README.md describes
//! them.

pub mod bench;
mod device;
mod error;
pub mod exact;
pub mod kernel;
pub mod launch;
pub mod layout;
pub mod made;
pub mod model;
pub mod planted;
pub mod probe;
pub mod rays;
pub mod record;
pub mod scene;
pub mod statistics;
pub mod suite;
pub mod summary;
pub mod tables;
pub mod tapes;

pub use device::{Access, Checks, Gpu, PATIENCE, Pass, Pipeline};
pub use error::GpuError;
