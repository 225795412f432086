//! The bugs of the kernels in `gpu-check`, which is a package of its own, as its source has them.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// A part of `tests/PLANTED.md`. That each is caught is a test of that package.
pub(crate) fn table() -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("gpu-check/src/planted.rs");
    let source = fs::read_to_string(file).unwrap();
    let (before, rays) = source.split_once("pub const RAY_BUGS").unwrap();
    let (_, tapes) = before.split_once("pub const BUGS").unwrap();
    let (tapes, rays) = (bugs(tapes), bugs(rays));
    assert!(tapes.len() > 40 && rays.len() > 9);
    let mut text = "\n## Kernels of gpu-check\n\nA test of that package runs each and wants it seen: in searches along tapes over 1,024 trees, or in \
                    2,000 rays into\neach made scene. In how many it is seen differs from device to device; `cargo run --release -- planted` says it \
                    for one.\n\n| bug | kernel | gpu-check |\n|---|---|---|\n"
        .to_owned();
    for (bugs, by) in [(&tapes, "tapes"), (&rays, "rays")] {
        for (name, kernel) in bugs {
            writeln!(text, "| {name} | {kernel} | {by} |").unwrap();
        }
    }
    writeln!(text, "\n{} bugs.", tapes.len() + rays.len()).unwrap();
    text
}

/// Name and kernel of each: `"name", "kernel":` begins a line.
fn bugs(source: &str) -> Vec<(&str, &str)> {
    source.lines().filter_map(bug).collect()
}

fn bug(line: &str) -> Option<(&str, &str)> {
    let (name, rest) = line.trim().strip_prefix('"')?.split_once("\", \"")?;
    Some((name, rest.split_once("\":")?.0))
}
