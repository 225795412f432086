//! Proof harnesses: claims that hold for all inputs, within stated bounds.
//!
//! A harness is a claim about the library's own functions, written once, as a function over a source of choices
//! ([`Choose`]). There are three methods of running it:
//!
//! - by `proofs/kani.sh`: each choice is any value, and the claim is proved for all of them;
//! - by `proofs/cbmc/check.sh`: CBMC proves the claims for the library compiled to WebAssembly and from there to C,
//!   with a small crate in place of Kani's;
//! - by `cargo test -p proofs`: the choices are enumerated if they are few, and drawn if they are many.
//!
//! Each harness has a twin: its body with one planted mistake ([`Choose::PLANTED`]), which must be refuted. The
//! assumptions of a harness must be satisfiable: each harness has a [`cover!`] that must be reached. `README.md` lists
//! the harnesses with their bounds and times, and `SOUNDNESS.md` lists their limits.
#![cfg_attr(target_family = "wasm", no_std)]
#![forbid(unsafe_code)]

extern crate alloc;

pub mod bits;
mod choose;
mod harness;
pub mod hash;
pub mod reference;
pub mod shape;
pub mod steps;
pub mod traversals;
pub mod wide;
pub mod words;

pub use choose::{Any, Cases, Choose, Drawn, id};
pub use harness::{CLAIM, Harness};

/// All harnesses, topic by topic.
pub const ALL: [&[Harness]; 6] =
    [bits::HARNESSES, wide::HARNESSES, words::HARNESSES, hash::HARNESSES, traversals::HARNESSES, steps::HARNESSES];
