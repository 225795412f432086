//! Error bounds of the determinants, derived in spec/exactness.md.
//!
//! With e1 = v1 - v0, e2 = v2 - v0, s = o - v0, the greatest components C of s, E of e1 and e2, D of d, and u = 2^-24
//! in single precision or 2^-53 in double precision, the error of each determinant is at most the constant times u
//! times the stated product. tests/library/bounds.rs has inputs that exceed five sixths of each bound.

/// Edge functions U, V and W: times D E (2 C + E). `[EXACT-4]`
pub const EDGE: u32 = 39;

/// An edge function and the determinant together: times D E (C + E). `[EXACT-6]`
pub const SIGN: u32 = 2 * EDGE;

/// The determinant: times D E E. `[EXACT-4]`
pub const DETERMINANT: u32 = 31;

/// The distance times the determinant: times C E E. `[EXACT-4]`
pub const DISTANCE: u32 = 35;

/// A quotient of these numbers: beyond [`QUOTIENT_FACTOR`] times the effect of its parts' errors, times u times the
/// quotient. `[EXACT-9]`
pub const QUOTIENT: u32 = 4;

/// See [`QUOTIENT`]. For determinants of at least 7.5 times their error.
pub const QUOTIENT_FACTOR: f64 = 5.0 / 4.0;

/// An edge function and the determinant together, if the error of each component of d is at most ε and of s at most ω:
/// times E (ε (C + E) + ω (D + ε)), beyond [`SIGN`]. `[INST-5]`
pub const OFF_SIGN: f64 = 12.0;

/// The determinant: times ε E E, and the distance times the determinant: times ω E E. Beyond [`DETERMINANT`] and
/// [`DISTANCE`], including [`QUOTIENT_FACTOR`]. `[INST-5]`
pub const OFF: f64 = 6.0;
