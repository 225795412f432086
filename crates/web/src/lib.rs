//! The content of the browser page: a scene, traced exactly and inexactly, pixel by pixel.
//!
//! [`Scene`] is read from the bytes of a file, or is one of [`Example::ALL`]. Its picture is [`SIDE`] pixels wide and
//! high. It is traced row by row ([`Scene::row`]), so that a page can show the progress. A pixel can be explained by
//! the ray's traversal, visit by visit.
//!
//! This crate is independent of browsers: `wasm/page.rs` exports it, and the tests run it natively.

#![forbid(unsafe_code)]

mod compare;
mod examples;
mod scene;

pub use compare::{Difference, Row, Totals};
pub use examples::Example;
pub use scene::{MOST_BYTES, SIDE, Scene, SceneFault};

#[cfg(test)]
mod tests;
