//! Rays, boxes and triangles in single precision.

mod aabb;
mod ray;
mod triangle;

pub use aabb::{Aabb, RaySlabs};
pub use ray::{Ray, RayError};
pub use triangle::{Hit, Triangle};
