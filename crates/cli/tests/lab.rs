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
    let commands =
        ["accuracy", "bench", "boxes", "check", "debug", "explain", "figure", "merge", "parts", "price", "stress"];
    for command in commands {
        let help = lab(&format!("{command} --help"), &[]).passes().stdout;
        assert!(all.contains(&format!("  {command} ")) && help.contains("Usage: lab"), "{command}");
    }
}

/// The papers' example, a scene, and a random tree of eight children.
#[test]
fn trees_and_traversals_are_printed() {
    let tree = lab("debug tree", &[]).passes().stdout;
    assert!(tree.contains("\n1\n  2\n    4 leaf\n    5\n      10 leaf\n"), "{tree}");
    let trace = lab("debug trace --method hashed", &[]).passes().stdout;
    let visit = "   5  22  key 10110, trail 1000, postponed 3: Leaf 22 has no hit. The trail 1000 ends in 3 zeros: 3 levels up, to \
                 the sibling 3; the key 10110 becomes 11.";
    assert!(trace.contains(visit), "{trace}");
    let ray = lab("debug trace soup --pixel 256,256 --method wide-record", &[]).passes().stdout;
    assert!(ray.starts_with("soup, pixel 256,256\nwide-record [WRECORD-1]: "), "{ray}");
    let random = lab("debug trace --tape 3 --wide 8", &[]).passes().stdout;
    assert!(random.contains("\nwide-trail [WTRAIL-1]: "), "{random}");
}
