//! The two precisions of meshes and rays.

use std::str::FromStr;

use serde::Serialize;
use serde::de::DeserializeOwned;
use stackless_bvh::geom::{Real, Vector};

/// A number of a mesh, a ray or a hit: `f32` or `f64`.
///
/// Decimals in text are rounded once.
pub trait Float: Real + FromStr + Serialize + DeserializeOwned {
    /// The name of the precision: `single` or `double`.
    const PRECISION: &'static str;

    /// The type in a `NumPy` array.
    const DTYPE: &'static str;

    /// Returns the bytes in little-endian order.
    fn bytes(self) -> impl AsRef<[u8]>;
}

/// A position in one of these precisions: [`glam::Vec3`] or [`glam::DVec3`].
pub trait Position: Vector<Real: Float> {}

impl<V: Vector<Real: Float>> Position for V {}

impl Float for f32 {
    const PRECISION: &'static str = "single";
    const DTYPE: &'static str = "<f4";

    fn bytes(self) -> impl AsRef<[u8]> {
        self.to_le_bytes()
    }
}

impl Float for f64 {
    const PRECISION: &'static str = "double";
    const DTYPE: &'static str = "<f8";

    fn bytes(self) -> impl AsRef<[u8]> {
        self.to_le_bytes()
    }
}

/// Returns NaN: for a number of a missing hit, or for a word that is not a number.
pub(crate) fn nan<F: Float>() -> F {
    F::rounded(f64::NAN)
}

/// Returns whether a number is neither infinite nor NaN.
pub(crate) fn is_finite<F: Float>(number: F) -> bool {
    number.into().is_finite()
}
