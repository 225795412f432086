//! The command `lab`.

#[path = "lab/accuracy.rs"]
mod accuracy;
#[path = "lab/cases.rs"]
mod cases;
#[path = "lab/merge.rs"]
mod merge;
#[path = "lab/parts.rs"]
mod parts;
#[allow(dead_code, reason = "shared with the tests of `stackless`")]
#[path = "cli/support.rs"]
mod support;

use std::path::Path;

use support::Run;

/// Runs `lab` with these arguments, separated by white space, and then these paths.
fn lab(args: &str, paths: &[&Path]) -> Run {
    support::run(env!("CARGO_BIN_EXE_lab"), args, paths)
}

#[test]
fn every_command_has_help() {
    let all = lab("--help", &[]).passes().stdout;
    for command in ["accuracy", "bench", "boxes", "check", "explain", "figure", "merge", "parts", "price", "stress"] {
        let help = lab(&format!("{command} --help"), &[]).passes().stdout;
        assert!(all.contains(&format!("  {command} ")) && help.contains("Usage: lab"), "{command}");
    }
}
