//! What all commands have in common: help, silence, streams, interruptions.

use std::io::Write;
use std::process::{Command, Stdio};

use super::support::{Folder, stackless};

const COMMANDS: &[&str] = &[
    "check",
    "trace",
    "render",
    "explain",
    "bench",
    "stress",
    "conform",
    "suite",
    "adversary",
    "accuracy",
    "curve",
    "stats",
    "report",
    "completions",
];

#[test]
fn every_command_has_help_and_a_completion() {
    let all = stackless("--help", &[]).passes().stdout;
    let completions = stackless("completions bash", &[]).passes().stdout;
    for command in COMMANDS {
        let help = stackless(&format!("{command} --help"), &[]).passes().stdout;
        assert!(all.contains(&format!("  {command} ")) && help.contains("Usage: stackless"), "{command}");
        assert!(help.contains("Examples:") || *command == "completions", "{command}");
        assert!(completions.contains(&format!("stackless__subcmd__{command})")), "{command}");
    }
    assert!(all.contains("Exit codes: 0") && all.contains("Examples:"), "{all}");
    assert!(stackless("--version", &[]).passes().stdout.starts_with("stackless "));
    for shell in ["zsh", "fish", "powershell", "elvish"] {
        assert!(stackless(&format!("completions {shell}"), &[]).passes().stdout.contains("conform"), "{shell}");
    }
    assert_eq!(stackless("completions sh", &[]).code, Some(2));
}

#[test]
fn quiet_is_silent_but_for_errors() {
    let folder = Folder::new();
    let json = folder.path("out.json");
    let run = stackless("stress --quiet --rays 10 --json", &[&json]).passes();
    assert_eq!(run.stdout, "");
    assert!(std::fs::read_to_string(json).unwrap().starts_with('{'));
    stackless("-q stats nothing.ply", &[]).fails_naming(&["nothing.ply"]);
}

#[test]
fn a_dash_is_a_stream() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
    command.args(["trace", "soup", "--rays", "-", "--out", "-"]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"9,9,9,1,0,0,0,inf\n").unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stdout), "prim,t,u,v\n-1,,,\n");
    assert!(String::from_utf8_lossy(&output.stderr).contains("1 rays, 0 hits"));

    let json = stackless("stress --rays 10 --json -", &[]);
    assert!(serde_json::from_str::<serde_json::Value>(&json.stdout).is_ok_and(|json| json["rows"].is_array()));
    assert!(json.stderr.contains("stressed:"), "{}", json.stderr);
    let run = stackless("stress --rays 10 --json", &[std::path::Path::new("")]);
    assert!(run.code == Some(2), "{run:?}");
}

/// Nothing is written before it is whole.
#[cfg(unix)]
#[test]
fn an_interrupted_command_leaves_no_half_file() {
    let folder = Folder::new();
    let picture = folder.path("out.png");
    let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
    command.args(["render", "strands", "--rays", "ao", "--spp", "65536", "--size", "2000", "-o"]).arg(&picture);
    let mut child = command.stderr(Stdio::null()).spawn().unwrap();
    // Long enough to be in the middle of it, and far too short to be done.
    std::thread::sleep(std::time::Duration::from_millis(500));
    // As Ctrl-C does, which shells make processes in the background ignore.
    let ended = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(ended.success());
    let status = child.wait().unwrap();
    assert_eq!(std::os::unix::process::ExitStatusExt::signal(&status), Some(15), "{status:?}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
