//! Error bounds of the determinants, derived in spec/exactness.md.
//!
//! With e1 = v1 - v0, e2 = v2 - v0, s = o - v0, the greatest components C of s, E of e1 and e2, D of d, and u = 2^-24 in
//! single precision or 2^-53 in double, each determinant is off by at most so many times u times the product that is
//! named. tests/bounds.rs has inputs that exceed five sixths of each.

/// Edge functions U, V and W: times D E (2 C + E). `[EXACT-4]`
pub const EDGE: u32 = 39;

/// The determinant: times D E E. `[EXACT-4]`
pub const DETERMINANT: u32 = 31;

/// The distance times the determinant: times C E E. `[EXACT-4]`
pub const DISTANCE: u32 = 35;

/// An edge function and the determinant together, for the greatest C and E of a scene: times D E (C + E). `[EXACT-6]`
pub const REGION: u32 = 2 * EDGE;

/// A quotient: beyond [`QUOTIENT_FACTOR`] times what the errors of its parts make, times u times the quotient.
/// `[EXACT-9]`
pub const QUOTIENT: u32 = 4;

/// See [`QUOTIENT`].
pub const QUOTIENT_FACTOR: f64 = 17.0 / 16.0;
