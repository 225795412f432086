//! The command `stackless`, run like by users.

#[path = "cli/bad_input.rs"]
mod bad_input;
#[path = "cli/bench.rs"]
mod bench;
#[path = "cli/check.rs"]
mod check;
#[path = "cli/conform.rs"]
mod conform;
#[path = "cli/habits.rs"]
mod habits;
#[path = "cli/held.rs"]
mod held;
#[path = "cli/merge.rs"]
mod merge;
#[cfg(unix)]
#[path = "cli/outside.rs"]
mod outside;
#[path = "cli/points.rs"]
mod points;
#[path = "cli/precision.rs"]
mod precision;
#[path = "cli/refused.rs"]
mod refused;
#[path = "cli/render.rs"]
mod render;
#[path = "cli/replay.rs"]
mod replay;
#[path = "cli/stats.rs"]
mod stats;
#[path = "cli/stress.rs"]
mod stress;
#[path = "cli/support.rs"]
mod support;
#[path = "cli/trace.rs"]
mod trace;

use support::stackless;

#[test]
fn usage() {
    let help = stackless("--help", &[]).passes();
    for name in ["check", "trace", "bench"] {
        assert!(help.stdout.contains(name), "{}", help.stdout);
        assert!(stackless(&format!("{name} --help"), &[]).passes().stdout.contains("Usage: stackless"));
    }
    assert!(stackless("--version", &[]).passes().stdout.starts_with("stackless"));
    for (args, what) in [
        ("", "Usage: stackless"),
        ("nosuch", "nosuch"),
        ("check --nosuch", "--nosuch"),
        ("check --method stack,nosuch", "invalid value 'nosuch'"),
        ("check --trees many", "many"),
        ("check --replay a.json --trees 5", "cannot be used with"),
        ("trace soup", "--rays"),
        ("bench", "SCENES"),
        ("bench soup --kinds shadow", "possible values: primary, any, diffuse, aimed"),
        ("bench soup --accuracy nosuch", "possible values: fast, watertight, "),
        ("bench soup --count 0", "0 is not in 1..="),
        ("bench soup --rounds 0", "0 is not in 1..="),
    ] {
        let run = stackless(args, &[]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args}");
        assert!(run.stderr.contains(what), "{args}: {}", run.stderr);
    }
}
