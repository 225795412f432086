//! The fuzz targets: a few lines that convert bytes to the input of a property body of the library
//! ([`stackless_check`]), and panic if it finds a fault.
//!
//! This crate is plain Rust. The targets of libFuzzer, the seeds, the coverage and `tests/library/regressions.rs` all
//! run these functions.

mod draw;
mod files;
mod geometry;
mod hierarchies;
mod keys;
mod suite;
mod traversals;
mod wide;

use std::fmt::Display;

/// A fuzz target: its name, its function, and the greatest length of its input in bytes.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name of the binary, of its folder of seeds, and of its folder of findings.
    pub name: &'static str,
    /// Panics if there is a fault.
    pub run: fn(&[u8]),
    /// The maximum length of the input. Longer inputs take more time and find no more faults.
    pub longest: usize,
}

/// All targets.
pub const TARGETS: [Target; 26] = [
    target("keys", keys::keys, 128),
    target("traversals", traversals::traversals, 512),
    target("deep", traversals::deep, 512),
    target("pieces", traversals::pieces, 512),
    target("pauses", traversals::pauses, 96),
    target("states", traversals::states, 256),
    target("wide", wide::wide, 256),
    target("hash", traversals::hash, 256),
    target("hash_bytes", traversals::hash_bytes, 512),
    target("triangle", geometry::triangle, 160),
    target("slabs", geometry::slabs, 160),
    target("nearest", geometry::nearest, 512),
    target("solids", geometry::solids, 256),
    target("builders", hierarchies::builders, 512),
    target("refit", hierarchies::refit, 512),
    target("bvh_bytes", hierarchies::bvh_bytes, 4096),
    target("instances", hierarchies::instances, 512),
    target("ply", files::ply, 4096),
    target("obj", files::obj, 4096),
    target("stl", files::stl, 4096),
    target("gltf", files::gltf, 4096),
    target("rays", files::rays, 2048),
    target("replay", files::replay, 4096),
    target("requests", suite::requests, 4096),
    target("answers", suite::answers, 512),
    target("suite_files", suite::suite_files, 512),
];

const fn target(name: &'static str, run: fn(&[u8]), longest: usize) -> Target {
    Target { name, run, longest }
}

/// Generates the suite before the first input, whose time is limited: this takes minutes on a busy machine.
pub fn prepare() {
    suite::some_profiles();
}

/// Runs the target of this name.
///
/// # Panics
/// If there is no such target, or it finds a fault.
pub fn run(name: &str, bytes: &[u8]) {
    let target = TARGETS.iter().find(|target| target.name == name);
    let Target { run, longest, .. } = target.unwrap_or_else(|| panic!("no target has the name {name:?}"));
    run(&bytes[..bytes.len().min(*longest)]);
}

/// Returns the value. Panics with the fault and its subject otherwise.
fn right<T, E: Display>(result: Result<T, E>, about: impl Display) -> T {
    result.unwrap_or_else(|fault| panic!("{fault}\n{about}"))
}

/// Checks that an error message is one line.
fn said(refusal: impl Display) {
    let message = refusal.to_string();
    assert!(!message.is_empty() && !message.contains(['\n', '\r']), "not a message of one line: {message:?}");
}
