//! The two precisions that files are read in.

use std::str::FromStr;

use serde::Serialize;
use serde::de::DeserializeOwned;
use stackless_bvh::geom::{Real, Vector};

/// A number of a mesh, a ray or a hit: `f32` or `f64`.
///
/// Text is rounded to it once.
pub trait Float: Real + FromStr + Serialize + DeserializeOwned {
    /// Its precision: `single` or `double`.
    const PRECISION: &'static str;

    /// Its type in a `NumPy` array.
    const DTYPE: &'static str;

    /// Its bytes, the lowest first.
    fn bytes(self) -> impl AsRef<[u8]>;
}

/// A position of such numbers: [`glam::Vec3`] or [`glam::DVec3`].
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

/// A number that is not there: of a hit that is none, or of a word that is no number.
pub(crate) fn nan<F: Float>() -> F {
    F::rounded(f64::NAN)
}

/// Whether it is neither infinite nor a NaN.
pub(crate) fn is_finite<F: Float>(number: F) -> bool {
    number.into().is_finite()
}
