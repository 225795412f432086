//! Rays, boxes and triangles, and their intersection tests, exact and inexact.

mod aabb;
mod affine;
mod ball;
mod clip;
mod enclosed_ray;
mod exact_ray;
pub(crate) mod fan;
mod fine;
mod frame;
mod interval;
pub mod kernel;
pub mod lanes;
mod mesh;
mod nearest;
mod once;
mod placement;
mod ray;
mod region;
pub mod slabs;
mod triangle;
pub mod truth;
mod vector;

pub use crate::environment::{EnvironmentError, check_environment};
pub use aabb::Aabb;
pub use affine::{AffineError, AffineMap, meet_image};
pub use ball::{Ball, BallError};
pub use enclosed_ray::EnclosedRay;
pub use exact_ray::{Ends, ExactPoint, ExactRay};
pub use frame::Frame;
pub(crate) use frame::{exponent_of, power_of_two};
pub use interval::Interval;
pub use kernel::Kernel;
pub(crate) use kernel::order_of_lines;
pub use mesh::{MAX_COUNT, Mesh, MeshError};
pub use nearest::{Foot, Measure};
pub(crate) use once::Once;
pub(crate) use placement::{EnclosedMap, nearest_of_image, to_box};
pub use ray::{Ray, RayError};
pub use region::Region;
pub(crate) use slabs::Approach;
pub use slabs::Slabs;
pub use triangle::Triangle;
pub use vector::{Real, Vector};

#[cfg(test)]
pub(crate) mod tests;
