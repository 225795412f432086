//! Tests of the error bounds of spec/exactness.md: none is ever exceeded, and none could be halved.

mod draw;
mod dyadic;
mod filter;
mod parity;
mod quotient;
mod slab;
mod worst;

/// The constants under test: the library's, and further ones from spec/exactness.md.
mod constants {
    use stackless_bvh::internals::geom::{kernel, slabs};

    /// |δU| and |δV| in units of u D C E.
    pub(crate) const EDGE: f32 = 31.0;
    /// |δdet| in units of u D E².
    pub(crate) const DET: f32 = kernel::DETERMINANT as f32;
    /// |δW|, |δU| and |δV| in units of u D E (2C + E).
    pub(crate) const EDGES: f32 = kernel::EDGE as f32;
    /// |δU|, |δV| or |δW|, with |δdet|, in units of u D E (C + E).
    pub(crate) const SIGN: f64 = kernel::SIGN as f64;
    /// |δT| in units of u C E².
    pub(crate) const DISTANCE: f32 = kernel::DISTANCE as f32;
    /// Least E of the stage in single precision where the direction is scaled so that 1 <= D < 2.
    pub(crate) const FLOOR: f32 = kernel::MIN_EDGE;
    /// Least E with an unscaled direction, with D in `LENGTHS`.
    pub(crate) const FLOOR_UNSCALED: f32 = f32::from_bits((127 - 50) << 23);
    /// 2^-20 and 2^20.
    pub(crate) const LENGTHS: [f32; 2] = [f32::EPSILON * 8.0, 1_048_576.0];
    /// Greatest coordinate of the stage in single precision.
    pub(crate) const REACH: f32 = kernel::MAX_COORDINATE;
    /// Relative error of the quotient: this times the effect of the errors of T and det ...
    pub(crate) const QUOTIENT: f64 = kernel::QUOTIENT_FACTOR;
    /// ... and this times u.
    pub(crate) const QUOTIENT_ROUNDINGS: f64 = kernel::QUOTIENT as f64;
    /// Steps down and up from the rounded reciprocal.
    pub(crate) const STEPS: u32 = slabs::STEPS;
    /// Steps that make the rounded entry at most the exact one, not only at most its rounded value.
    pub(crate) const STRICT_STEPS: u32 = slabs::STRICT_STEPS;
    /// Factors of the two-sided slab test: 1 - 3u and 1 + 4u.
    pub(crate) const DOWN: f32 = slabs::PADDING[0];
    /// See `DOWN`.
    pub(crate) const UP: f32 = slabs::PADDING[1];
}
