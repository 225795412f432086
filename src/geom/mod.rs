//! Rays, boxes and triangles, and their intersection tests, exact and inexact.

mod aabb;
pub(crate) mod affine;
mod ball;
mod clip;
pub(crate) mod enclosed_ray;
mod exact_ray;
pub(crate) mod fan;
mod fine;
mod frame;
pub(crate) mod interval;
pub(crate) mod kernel;
pub(crate) mod lanes;
mod mesh;
pub(crate) mod nearest;
mod once;
mod placement;
mod ray;
pub(crate) mod region;
pub(crate) mod slabs;
mod triangle;
pub(crate) mod truth;
mod vector;

pub use crate::environment::{EnvironmentError, check_environment};
pub use aabb::Aabb;
pub(crate) use affine::meet_image;
pub use affine::{AffineError, AffineMap};
pub use ball::{Ball, BallError};
pub(crate) use enclosed_ray::EnclosedRay;
pub use exact_ray::{Ends, ExactPoint, ExactRay};
pub use frame::Frame;
pub(crate) use frame::{exponent_of, power_of_two};
pub(crate) use interval::Interval;
pub use kernel::Kernel;
pub(crate) use kernel::order_of_lines;
pub use lanes::Precision;
pub use mesh::{MAX_COUNT, Mesh, MeshError};
pub(crate) use nearest::Measure;
pub(crate) use once::Once;
pub(crate) use placement::{EnclosedMap, nearest_of_image, to_box};
pub use ray::{Ray, RayError};
pub use region::Region;
pub(crate) use slabs::Approach;
pub(crate) use slabs::Slabs;
pub use triangle::Triangle;
pub use vector::{Real, Vector};

#[cfg(test)]
pub(crate) mod tests;
