//! The plots that the command `stackless` draws.

#![forbid(unsafe_code)]

pub mod plots;
