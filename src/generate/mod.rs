//! Cases to check with: trees, decision tapes, and the choices they are made from.
//!
//! A generator asks a [`Source`] for numbers below a bound and knows nothing about where they come from: a seeded
//! generator, the bytes of a fuzzer, or the enumeration of all choices. It is written once, so that tests, fuzzing and
//! proofs see the same cases. The smallest choice (0) is everywhere the simplest one: shrinking bytes shrinks cases.

#[cfg(feature = "rays")]
pub mod double;
#[cfg(feature = "rays")]
pub mod draw;
mod family;
#[cfg(feature = "rays")]
pub mod procedural;
mod source;
#[cfg(feature = "rays")]
pub mod stress;
mod tape;
mod wide;

pub use family::{Family, shape};
pub use source::{Exhaustive, Rng, Source};
pub use tape::{Cell, Kind, Outcome, Search, Tape};
pub use wide::{WideAnswer, WideSearch, WideTape, wide_shape, wide_tree};
