//! Test cases: trees, decision tapes, and sources of choices.
//!
//! A generator takes numbers below a bound from a [`Source`], independently of their origin: a seeded generator, the
//! bytes of a fuzzer, or the enumeration of all choices. Each generator is written once, so tests, fuzzing and proofs
//! use the same cases. The smallest choice (0) is always the simplest one: shrinking bytes shrinks cases.

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
