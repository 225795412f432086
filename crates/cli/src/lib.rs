//! The commands `stackless` and `lab`. `lab` is for developers of the library.

#![deny(unsafe_code)]
#![cfg_attr(not(feature = "lab"), allow(dead_code, unused_imports, reason = "only `lab` uses some items"))]

mod bench;
mod build;
mod camera;
mod check;
mod conform;
mod explain;
mod generate;
mod input;
mod judge;
#[cfg(feature = "lab")]
mod lab;
mod merge;
mod methods;
mod output;
mod places;
mod plots;
mod points;
mod record;
mod render;
mod run;
mod savings;
mod signals;
mod stackless;
mod stats;
mod stress;
mod suite;
mod trace;
mod turns;

use std::process::ExitCode;

use run::Outcome;

/// Runs `stackless` with the arguments of the process.
pub fn stackless() -> ExitCode {
    run::run::<stackless::Stackless>()
}

/// Runs `lab` with the arguments of the process.
#[cfg(feature = "lab")]
pub fn lab() -> ExitCode {
    run::run::<lab::Lab>()
}
