//! What the command `stackless` shows: a traversal step by step as a page for the browser, and plots.

#![forbid(unsafe_code)]

pub mod plots;

pub use stackless_explain as explain;
