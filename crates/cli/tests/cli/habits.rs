//! The common part of all commands: help, silence, streams, interruptions.

use std::io::Write;
use std::process::{Command, Stdio};

use super::support::{Folder, stackless};

const COMMANDS: &[&str] = &[
    "check", "trace", "render", "explain", "bench", "stress", "conform", "suite", "stats", "methods", "merge",
    "generate", "contains", "nearest",
];

#[test]
fn every_command_has_help_and_a_completion() {
    let all = stackless("--help", &[]).passes().stdout;
    let completions = stackless("generate bash", &[]).passes().stdout;
    for command in COMMANDS {
        let help = stackless(&format!("{command} --help"), &[]).passes().stdout;
        assert!(all.contains(&format!("  {command} ")) && help.contains("Usage: stackless"), "{command}");
        assert!(help.contains("Examples:") || *command == "methods", "{command}");
        assert!(completions.contains(&format!("stackless__subcmd__{command})")), "{command}");
    }
    assert!(all.contains("Exit codes: 0") && all.contains("Examples:"), "{all}");
    assert!(stackless("--version", &[]).passes().stdout.starts_with("stackless "));
    for shell in ["zsh", "fish", "powershell", "elvish"] {
        assert!(stackless(&format!("generate {shell}"), &[]).passes().stdout.contains("conform"), "{shell}");
    }
    assert_eq!(stackless("generate sh", &[]).code, Some(2));
}

#[test]
fn quiet_is_silent_but_for_errors() {
    let folder = Folder::new();
    let json = folder.path("out.json");
    let run = stackless("stress --quiet --count 10 --json", &[&json]).passes();
    assert_eq!(run.stdout, "");
    assert!(std::fs::read_to_string(json).unwrap().starts_with('{'));
    stackless("-q stats nothing.ply", &[]).fails_naming(&["nothing.ply"]);
}

#[test]
fn a_dash_is_a_stream() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
    command.args(["trace", "soup", "--rays", "-", "-o", "-"]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"9,9,9,1,0,0,0,inf\n").unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stdout), "prim,t,u,v\n-1,,,\n");
    assert!(String::from_utf8_lossy(&output.stderr).contains("1 ray, 0 hits"));

    let json = stackless("stress --count 10 --json -", &[]);
    assert!(serde_json::from_str::<serde_json::Value>(&json.stdout).is_ok_and(|json| json["rows"].is_array()));
    assert!(json.stderr.contains("pass: 146 cases"), "{}", json.stderr);
    let run = stackless("stress --count 10 --json", &[std::path::Path::new("")]);
    assert!(run.code == Some(2), "{run:?}");
}

/// Binary files are not written to a terminal.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_text_alone() {
    for (args, code, what) in [
        ("render soup --size 8 -o -", 2, ".png is binary"),
        ("trace soup --rays /dev/null --format npy -o -", 2, ".npy is binary"),
        ("stats soup --count 16 --plot -", 0, "<svg"),
    ] {
        let mut script = Command::new("script");
        script.args(["-qec", &format!("{} {args}", env!("CARGO_BIN_EXE_stackless")), "/dev/null"]);
        let output = script.stdin(Stdio::null()).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.code() == Some(code) && said.contains(what), "{args}: {said}");
    }
}

/// Help fits the width of the terminal: lines end between words.
#[test]
fn help_breaks_lines_between_words() {
    let help = |topic: &&str, width: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
        command.arg("help").args((!topic.is_empty()).then_some(topic)).env("COLUMNS", width).stdin(Stdio::null());
        String::from_utf8(command.output().unwrap().stdout).unwrap()
    };
    for topic in COMMANDS.iter().chain([&""]) {
        let [narrow, wide] = ["60", "10000"].map(|width| help(topic, width));
        assert!(narrow.split_whitespace().eq(wide.split_whitespace()), "{narrow}");
        let is_long = |line: &&str| line.chars().count() > 60 && line.split_whitespace().count() > 1;
        assert_eq!(narrow.lines().find(is_long), None, "{topic}");
    }
}

/// Files are written atomically.
#[cfg(unix)]
#[test]
fn an_interrupted_command_leaves_no_half_file() {
    let folder = Folder::new();
    let picture = folder.path("out.png");
    let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
    command.args(["render", "strands", "--kind", "ao", "--spp", "65536", "--size", "2000", "-o"]).arg(&picture);
    let mut child = command.stderr(Stdio::null()).spawn().unwrap();
    // Long enough to be running, and far too short to finish.
    std::thread::sleep(std::time::Duration::from_millis(500));
    // Like Ctrl-C, which background processes of shells ignore.
    let ended = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(ended.success());
    let status = child.wait().unwrap();
    assert_eq!(std::os::unix::process::ExitStatusExt::signal(&status), Some(15), "{status:?}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// Errors suggest similar names, and completions contain the names.
#[test]
fn names_are_offered() {
    for (args, meant) in [
        ("trace soup --rays a -o b --method hashd", "'hashed'"),
        ("stats soup --biuld fast", "'--build'"),
        ("chekc", "'check'"),
        ("bench soup --accuracy exakt", "'exact'"),
        ("suite list --level trac", "'trace'"),
    ] {
        let run = stackless(args, &[]);
        assert!(run.code == Some(2) && run.stderr.contains("tip:") && run.stderr.contains(meant), "{args}: {run:?}");
    }
    let completions = stackless("generate bash", &[]).passes().stdout;
    for offered in ["wide-record", "watertight", "sbvh", "jsonl"] {
        assert!(completions.contains(offered), "{offered}");
    }
    let zsh = stackless("generate zsh", &[]).passes().stdout;
    assert!(zsh.contains("--output=[") && zsh.contains(":FILE:_files"), "{zsh}");
}

/// Unsupported file kinds are refused before the work.
#[test]
fn a_name_does_not_promise_another_kind() {
    for (args, naming) in [
        ("render soup -o x.jpg", ["extension .jpg", "expected .png"]),
        ("explain -o x.pdf", ["extension .pdf", "expected .html"]),
        ("stats soup --plot x.png", ["extension .png", "expected .svg"]),
    ] {
        let run = stackless(args, &[]);
        assert!(run.code == Some(2) && naming.iter().all(|what| run.stderr.contains(what)), "{args}: {run:?}");
    }
}

#[test]
fn threads_are_as_many_as_asked() {
    let folder = Folder::new();
    let json = folder.path("out.json");
    stackless("--threads 1 stress --count 2 --cases torus --json", &[&json]).passes();
    stackless("stress --threads 3 --list", &[]).passes();
    for bad in ["0", "1025", "many"] {
        assert_eq!(stackless(&format!("stress --list --threads {bad}"), &[]).code, Some(2));
    }
}

#[test]
fn manual_pages_are_written() {
    let folder = Folder::new();
    let man = folder.path("man1");
    stackless("generate man -o", &[&man]).passes();
    for page in ["stackless.1", "stackless-trace.1", "stackless-suite-export.1"] {
        let text = std::fs::read_to_string(man.join(page)).unwrap();
        assert!(text.contains(".SH SYNOPSIS") && text.contains(".SH OPTIONS"), "{page}: {text}");
    }
    assert!(!man.join("stackless-help.1").exists());
}

/// Every record of `--json` is an object with the program, the machine and the scenes.
#[test]
fn records_say_what_made_them() {
    let folder = Folder::new();
    let json = folder.path("out.json");
    for args in ["stats soup --count 1", "bench soup --count 16 --rounds 1 --method stack --kinds primary"] {
        let run = stackless(&format!("{args} --json"), &[&json]);
        let record = super::support::read_json(&json);
        assert_eq!(record["version"], env!("CARGO_PKG_VERSION"), "{args}");
        assert!(record["machine"].is_string() && record["scenes"].is_array(), "{args}");
        assert_eq!(record["command"], args.split(' ').next().unwrap());
        // No quotients of 0.
        let is_number = |word: &str| !["inf", "NaN", "-inf"].contains(&word.trim_matches(['x', '%', '(', ')', ',']));
        assert!(run.stdout.split_whitespace().all(is_number), "{args}: {}", run.stdout);
    }
}
