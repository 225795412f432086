//! Runs all commands of all texts: the README files, the specification, and the examples of the help.

#![cfg(unix)]

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The programs that are built and run.
const PROGRAMS: &[&str] = if cfg!(feature = "lab") { &["stackless", "lab"] } else { &["stackless"] };

/// Commands that are not run, by a part of their text, with reasons.
const NOT_RUN: &[(&str, &str)] = &[
    ("sibenik.ply", "a figure of a scene that a clone does not have"),
    ("crytek_sponza.ply", "a picture of a scene that a clone does not have"),
    ("mesh.ply", "for users without a clone"),
    ("mine", "a user's program"),
    ("my_traversal.py", "a user's program"),
    ("--peers", "other ray tracers are not in every build"),
    ("--peer ", "other ray tracers are not in every build"),
    ("parallel stackless", "GNU parallel is not on every machine"),
    ("-- COMMAND", "a user's program"),
    ("fuzz/records/", "records of fuzzing runs"),
    ("lab accuracy --shard", "names an option, without a scene"),
    ("SPONZA", "measured on a scene that a clone does not have"),
    ("lab price", "takes minutes without optimisation; a unit test runs its families"),
];

/// Commands that are slow or templates, as written and as run.
#[rustfmt::skip]
const RUN_AS: &[(&str, &str)] = &[
    ("stackless merge RECORD...",
     "stackless check --trees 10 --shard 1/1 --json whole.json && stackless merge whole.json"),
    ("stackless check",
     "stackless check --trees 100"),
    ("stackless check SCENE --double",
     "stackless check examples/data/torus.ply --count 50 --double"),
    ("stackless check soup --double --method uncle,afra",
     "stackless check soup --count 50 --double --method uncle,afra"),
    ("stackless check --leaves 9",
     "stackless check --leaves 5"),
    ("stackless check --leaves 7",
     "stackless check --leaves 5"),
    ("stackless check [SCENE...]",
     "stackless check examples/data/torus.ply --trees 10 --count 50"),
    ("stackless check examples/data/torus.ply --trees 1000",
     "stackless check examples/data/torus.ply --trees 10 --count 50"),
    ("stackless check --replay FILE",
     "stackless check --replay spec/departures/D-1.json"),
    ("stackless check --replay case.json",
     "stackless check --replay spec/departures/D-1.json"),
    ("stackless check --replay",
     "stackless check --replay spec/departures/D-1.json"),
    ("for i in $(seq 8); do stackless check --trees 100000 --shard $i/8 --json $i.json; done",
     "for i in $(seq 8); do stackless check --trees 100 --shard $i/8 --json $i.json; done"),
    ("stackless check --shard 3/64 --json 3.json",
     "stackless check --trees 100 --shard 3/64 --json 3.json"),
    ("stackless check --shard 1/2 --json a.json",
     "stackless check --trees 100 --shard 1/2 --json a.json"),
    ("stackless check --shard 2/2 --json b.json",
     "stackless check --trees 100 --shard 2/2 --json b.json"),
    ("stackless merge records/*.json --plot campaign.svg",
     "stackless merge a.json b.json --plot campaign.svg"),
    ("stackless contains SCENE --points FILE.csv -o FILE.csv",
     "stackless contains examples/data/torus.ply --points examples/data/points.csv -o places.csv"),
    ("stackless nearest SCENE --points FILE.csv -o FILE.csv",
     "stackless nearest examples/data/torus.ply --points examples/data/points.csv -o nearest.csv"),
    ("stackless trace SCENE --rays FILE.csv -o FILE.csv",
     "stackless trace examples/data/torus.ply --rays examples/data/rays.csv -o hits.csv"),
    ("stackless render SCENE -o FILE.png",
     "stackless render examples/data/torus.ply --size 64 -o torus.png"),
    ("stackless render examples/data/room.obj --kind ao --view 5.7,1.7,2,0,1.2,2,0,1,0,75 -o ao.png",
     "stackless render examples/data/room.obj --kind ao --spp 4 --size 80x60 \
      --view 5.7,1.7,2,0,1.2,2,0,1,0,75 -o ao.png"),
    ("stackless stress",
     "stackless stress --list"),
    ("stackless stress --method wide-record,afra --brief",
     "stackless stress --method wide-record,afra --brief --count 5"),
    ("lab boxes N",
     "lab boxes 1000"),
    ("lab accuracy SCENE...",
     "lab accuracy examples/data/torus.ply --count 100 --rounds 1"),
    ("lab accuracy examples/data/slivers.ply spheres --plot accuracy.svg --json accuracy.json",
     "lab accuracy examples/data/slivers.ply --count 100 --rounds 1 --plot accuracy.svg --json accuracy.json"),
    ("lab accuracy soup --count 1000000 --shard 3/64 --json 3.json",
     "lab accuracy soup --count 10000 --shard 3/64 --json 3.json"),
    ("lab boxes 1000000",
     "lab boxes 1000"),
    ("lab figure 1 examples/data/slivers.ply -o figure1.png",
     "lab figure 1 examples/data/slivers.ply --size 64 -o figure1.png"),
    ("lab motion examples/data/torus.ply --threads 1",
     "lab motion examples/data/torus.ply --threads 1 --frames 2 --count 500 --rounds 1"),
    ("lab parts examples/data/room.obj",
     "lab parts examples/data/room.obj --count 500"),
    ("lab parts SCENE",
     "lab parts examples/data/torus.ply --count 500"),
    ("stackless bench SCENE...",
     "stackless bench examples/data/torus.ply --count 1000 --rounds 1"),
    ("lab bench --double",
     "lab bench examples/data/torus.ply --double --count 1000 --rounds 1"),
    ("stackless bench examples/data/torus.ply examples/data/slivers.ply",
     "stackless bench examples/data/torus.ply examples/data/slivers.ply --count 1000 --rounds 1"),
    ("stackless bench examples/data/torus.ply --accuracy fast,exact --kinds any,aimed --json bench.json",
     "stackless bench examples/data/torus.ply --accuracy fast,exact --kinds any,aimed --count 1000 \
      --rounds 1 --json bench.json"),
    ("stackless bench examples/data/room.obj --method afra,wide-stack --kinds diffuse --count 1000000",
     "stackless bench examples/data/room.obj --method afra,wide-stack --kinds diffuse --count 1000"),
    ("stackless stats SCENE",
     "stackless stats examples/data/torus.ply"),
    ("stackless stats --plot",
     "stackless stats examples/data/torus.ply --plot distances.svg"),
    ("stackless suite list|show|export|serve",
     "stackless suite list"),
    ("stackless generate SHELL",
     "stackless generate zsh"),
    ("stackless generate bash > ~/.local/share/bash-completion/completions/stackless",
     "stackless generate bash > completions"),
    ("stackless help COMMAND",
     "stackless help trace"),
];

#[test]
fn all_commands_of_all_texts_run() {
    let texts: Vec<_> = texts();
    let mut unused: BTreeSet<&str> =
        NOT_RUN.iter().map(|(part, _)| *part).chain(RUN_AS.iter().map(|(written, _)| *written)).collect();
    let mut runs = Vec::new();
    for (name, commands) in texts {
        let mut wanted = Vec::new();
        for written in commands {
            if let Some((part, _)) = NOT_RUN.iter().find(|(part, _)| written.contains(part)) {
                unused.remove(part);
                continue;
            }
            let found = RUN_AS.iter().find(|(row, _)| *row == written);
            unused.remove(found.map_or("", |(row, _)| row));
            wanted.push(found.map_or(written, |(_, run)| (*run).to_owned()));
        }
        runs.push((name, wanted));
    }
    let failed: Vec<_> = runs.into_iter().flat_map(|(name, commands)| failures(&name, &commands)).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    unused.retain(|row| cfg!(feature = "lab") || !row.starts_with("lab "));
    assert_eq!(unused, BTreeSet::new(), "rows that no text needs");
}

#[test]
fn a_command_that_fails_is_seen() {
    let commands = ["stackless stats examples/data/none.ply", "stackless suite list", "stackless nosuch | cat"];
    assert_eq!(failures("here", &commands.map(str::to_owned)).len(), 2);
    let text = "`stackless stats`, `stackless\nsuite  list x`\n\
        ```sh\n$ stackless check   # all\n  echo 1 | stackless trace\n```\n";
    assert_eq!(commands_of(text), ["stackless suite list x", "stackless check", "echo 1 | stackless trace"]);
}

/// Runs the commands of a text one by one, in a folder that looks like a clone. Returns the failures.
fn failures(name: &str, commands: &[String]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(root()).unwrap().map(Result::unwrap) {
        symlink(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_stackless"));
    let paths = [program.parent().unwrap().to_owned()];
    let inherited = std::env::var_os("PATH").unwrap_or_default();
    let paths = std::env::join_paths(paths.into_iter().chain(std::env::split_paths(&inherited))).unwrap();
    let run = |command: &String| {
        let shell = format!("set -o pipefail\n{command}");
        let mut bash = Command::new("bash");
        let output = bash.args(["-c", &shell]).current_dir(folder.path()).env("PATH", &paths).output().unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        (!output.status.success()).then(|| format!("{name}: {command}\n{}\n{errors}", output.status))
    };
    commands.iter().filter_map(run).collect()
}

/// Each text with its commands.
fn texts() -> Vec<(String, Vec<String>)> {
    let mut texts = Vec::new();
    let folders = [
        "",
        "benches",
        "campaign",
        "crates/check",
        "crates/cli",
        "crates/suite",
        "docs",
        "examples/data",
        "fuzz",
        "spec",
        "spec/rocq",
        "spec/suite",
        "tests",
    ];
    for folder in folders {
        for path in fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path()) {
            if path.extension().is_some_and(|ending| ending == "md") && !path.ends_with("CHANGELOG.md") {
                let name = path.strip_prefix(root()).unwrap().display().to_string();
                texts.push((name, commands_of(&fs::read_to_string(&path).unwrap())));
            }
        }
    }
    for program in PROGRAMS {
        let path = Path::new(env!("CARGO_BIN_EXE_stackless")).with_file_name(program);
        let help = |topic: &str| {
            let output = Command::new(&path).arg("help").args((!topic.is_empty()).then_some(topic)).output();
            String::from_utf8(output.unwrap().stdout).unwrap()
        };
        let front = help("");
        let topics = front.lines().skip_while(|line| !line.starts_with("Commands:")).skip(1);
        let topics = topics.take_while(|line| !line.is_empty()).filter_map(|line| line.split_whitespace().next());
        for topic in [""].into_iter().chain(topics) {
            let text = help(topic);
            let examples = text.split_once("Examples:\n").map_or("", |(_, examples)| examples);
            texts.push((format!("{program} help {topic}"), commands_of(&format!("```\n{examples}\n```\n"))));
        }
    }
    texts
}

/// The commands of a text: lines of code blocks, without trailing descriptions, and code in backticks with arguments.
fn commands_of(text: &str) -> Vec<String> {
    let (mut commands, mut rest) = (Vec::new(), String::new());
    let mut is_block = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_block = !is_block;
        } else if is_block {
            let command = line.trim().trim_start_matches("$ ").split(" #").next().unwrap_or_default();
            // Spaces separate the description.
            let command = command.split("   ").next().unwrap_or_default().trim();
            if PROGRAMS.iter().any(|program| command.starts_with(&format!("{program} ")))
                || command.contains("| stackless ")
                || command.contains("parallel stackless")
                || command.contains("; do stackless")
            {
                commands.push(command.to_owned());
            }
        } else {
            rest.push_str(line);
            rest.push('\n');
        }
    }
    let spans = rest.split('`').skip(1).step_by(2);
    let words = spans.map(|span| span.split_whitespace().collect::<Vec<_>>());
    let named = words.filter(|words| words.len() > 2 && PROGRAMS.contains(&words[0])).map(|words| words.join(" "));
    named.chain(commands).collect()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}
