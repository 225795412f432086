//! What the page in the browser shows: a scene, traced exactly and inexactly beside each other, pixel by pixel.
//!
//! [`Scene`] is read from a file's bytes or is one of [`Example::ALL`]. Its picture is [`SIDE`] pixels wide and high and
//! is traced row by row ([`Scene::row`]), so that a page can show how far it is. A pixel can be explained: the ray's
//! traversal, visit by visit.
//!
//! Nothing here knows of browsers: `wasm/page.rs` exports it, and the tests run it natively.

#![forbid(unsafe_code)]

mod compare;
mod examples;
mod scene;

pub use compare::{Difference, Row, Totals};
pub use examples::Example;
pub use scene::{MOST_BYTES, SIDE, Scene, SceneFault};

#[cfg(test)]
mod tests;
