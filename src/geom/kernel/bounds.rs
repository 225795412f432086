//! Error bounds of the determinants, in units of last place (2^-24 or 2^-53), derived in spec/exactness.md.
//!
//! With e1 = v1 - v0, e2 = v2 - v0, s = o - v0 and the greatest components C of s, E of e1 and e2, D of d, and the
//! operations in the order of [`Determinants::of`](super::exact), each is off by at most so many times u times
//! the product that is named. tests/bounds.rs has inputs that exceed half of each.

/// Edge functions U, V and W: times D E (2 C + E). `[EXACT-3]`
pub const EDGE: u32 = 56;

/// The determinant: times D E E. `[EXACT-3]`
pub const DETERMINANT: u32 = 44;

/// The distance times the determinant: times C E E. `[EXACT-3]`
pub const DISTANCE: u32 = 44;

/// A quotient of two numbers with relative errors: beyond 17/16 of the sum of those, times the quotient. `[EXACT-5]`
pub const QUOTIENT: u32 = 4;

/// An edge function and the determinant together, for the greatest C and E of a scene: times D E (C + E). `[EXACT-4]`
pub const REGION: u32 = 112;
