//! Rays, boxes and triangles, and the tests of one against the other: exact, and less so.

mod aabb;
mod clip;
pub mod kernel;
mod nearest;
mod ray;
mod region;
pub mod slabs;
mod triangle;
pub mod truth;
mod vector;

pub use aabb::Aabb;
pub use kernel::Kernel;
pub use nearest::Measure;
pub use ray::{Ray, RayError};
pub use region::Region;
pub use slabs::Slabs;
pub use triangle::Triangle;
pub use vector::{Real, Vector};
