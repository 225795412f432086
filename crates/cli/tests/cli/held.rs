//! Every command under bad conditions: full and closed streams, unwritable places, signals.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::support::{Folder, data, stackless};

const CUBE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/cube.ply");

/// A short run of every command, with its output options.
const RUNS: &[(&str, &[&str])] = &[
    ("check --trees 5 --method stack", &["--json"]),
    ("trace CUBE --rays RAYS", &["-o"]),
    ("render CUBE --size 8", &["-o"]),
    ("bench CUBE --count 16 --rounds 1 --method stack --kinds primary", &["--json"]),
    ("stress --count 2 --cases torus --method stack", &["--json"]),
    ("conform --suite SUITE -- STACKLESS suite serve", &["--json", "--junit"]),
    ("suite list --suite SUITE", &[]),
    ("suite show --suite SUITE", &[]),
    ("explain", &["-o"]),
    ("stats CUBE --count 16", &["--json", "--plot"]),
    ("methods", &[]),
    ("generate zsh", &[]),
    ("generate man -o MAN", &[]),
    ("suite export --suite SUITE -o EXPORT", &[]),
    ("stress --list", &[]),
    ("merge RECORD", &["--json", "--plot"]),
    ("--help", &[]),
    ("--version", &[]),
];

/// Replacements of names in capitals.
struct Place {
    folder: Folder,
}

impl Place {
    /// A folder with some rays and a part of the suite.
    fn new() -> Self {
        let folder = Folder::new();
        folder.file("rays.csv", "0.5,0.5,9,0,0,-1,0,inf\n");
        stackless("check --trees 5 --method stack --json", &[&folder.path("record.json")]).passes();
        stackless("suite export --filter key/u32/child-* -o", &[&folder.path("suite")]).passes();
        Self { folder }
    }

    /// A run with these options.
    fn command(&self, args: &str, options: &[&str]) -> Command {
        let stackless = env!("CARGO_BIN_EXE_stackless");
        let mut command = Command::new(stackless);
        // The part after `--` belongs to another program.
        let (ours, others) = args.split_once(" -- ").map_or((args, None), |(ours, others)| (ours, Some(others)));
        let path = |name: &str| self.folder.path(name).display().to_string();
        let word = |word: &str| match word {
            "CUBE" => CUBE.to_owned(),
            "RAYS" => path("rays.csv"),
            "SUITE" => path("suite"),
            "RECORD" => path("record.json"),
            "MAN" | "EXPORT" => path("folder of files"),
            "STACKLESS" => stackless.to_owned(),
            word => word.to_owned(),
        };
        command.args(ours.split_whitespace().map(word)).args(options);
        if let Some(others) = others {
            command.arg("--").args(others.split_whitespace().map(word));
        }
        command
    }
}

/// The option and a place for required outputs.
fn needed<'p>(options: &[&'p str], place: &'p str) -> Vec<&'p str> {
    let is_needed = |option: &&&str| **option == "-o";
    options.iter().filter(is_needed).flat_map(|option| [*option, place]).collect()
}

/// The command, started without a standard output.
fn without_output(command: &Command) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-c", "exec \"$0\" \"$@\" >&-"]).arg(command.get_program()).args(command.get_args());
    shell
}

/// A full or missing standard output is an error; a closed pipe is not. No case panics.
#[test]
fn an_output_that_cannot_be_written_is_an_error_and_a_reader_that_goes_away_is_not() {
    let place = Place::new();
    let out = place.folder.path("out").display().to_string();
    for (args, options) in RUNS {
        let full = || File::options().write(true).open("/dev/full").unwrap();
        let own = needed(options, &out);
        // Also output to `-`.
        for options in [own.clone()].into_iter().chain(options.iter().map(|option| vec![*option, "-"])) {
            for mut command in [place.command(args, &options), without_output(&place.command(args, &options))] {
                let output = command.stdout(full()).output().unwrap();
                let error = String::from_utf8(output.stderr).unwrap();
                assert_eq!(output.status.code(), Some(2), "{command:?}: {error}");
                assert!(error.ends_with('\n'), "{command:?}: {error}");
                assert!(error.contains("standard output: cannot be written"), "{command:?}: {error}");
                // Without standard error, the exit code still shows the error.
                assert_eq!(command.stderr(full()).status().unwrap().code(), Some(2), "{command:?}");
            }
        }

        let mut child =
            place.command(args, &needed(options, &out)).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        drop(child.as_mut().unwrap().stdout.take());
        let output = child.unwrap().wait_with_output().unwrap();
        assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()), "{args}");
    }
    // Silent commands need no output.
    let quiet = without_output(&place.command("--quiet check --trees 5", &[])).status().unwrap();
    assert_eq!(quiet.code(), Some(0));
    // An adapter whose output is full, missing or closed.
    let hello = || File::open(place.folder.file("hello", "{\"cmd\":\"hello\",\"protocol\":1}\n")).unwrap();
    let full = File::options().write(true).open("/dev/full").unwrap();
    for mut serve in [place.command("suite serve", &[]), without_output(&place.command("suite serve", &[]))] {
        let full = full.try_clone().unwrap();
        assert_eq!(serve.stdin(hello()).stdout(full).status().unwrap().code(), Some(2));
    }
    let mut child = place.command("suite serve", &[]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    std::io::copy(&mut hello(), &mut child.stdin.take().unwrap()).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    // Also errors of the command line.
    let full = File::options().write(true).open("/dev/full").unwrap();
    assert_eq!(place.command("nosuch", &[]).stderr(full).status().unwrap().code(), Some(2));
}

/// Unwritable places are detected before the work, and before the input is read.
#[test]
fn a_place_that_cannot_be_written_is_refused_first() {
    let place = Place::new();
    let file = place.folder.file("file", "");
    fs::create_dir(place.folder.path("folder")).unwrap();
    let bad = [place.folder.path("none/x"), file.join("x"), place.folder.path("folder"), "/proc/x".into()];
    for (args, options) in RUNS {
        for option in *options {
            for bad in &bad {
                let args = args.replace("CUBE", "nothing.ply");
                let run = place.command(&args, &[option, &bad.display().to_string()]).output().unwrap();
                let error = String::from_utf8(run.stderr).unwrap();
                assert_eq!((run.status.code(), run.stdout), (Some(2), Vec::new()), "{args} {option}");
                let expected = format!("error: {}: cannot be written: ", bad.display());
                assert!(error.starts_with(&expected) && error.lines().count() == 1, "{args} {option}: {error}");
            }
        }
    }
    stackless("suite export -o", &[Path::new("/proc")]).fails_naming(&["/proc: cannot be written"]);
    assert_eq!(place.folder.names(), ["file", "folder", "rays.csv", "record.json", "suite"]);
}

/// A full disk leaves the old file. Needs the right to mount a disk.
#[test]
fn a_full_disk_leaves_what_was_there() {
    let place = Place::new();
    let disk = place.folder.path("disk");
    fs::create_dir(&disk).unwrap();
    let script = format!(
        "mount -t tmpfs -o size=4k none {0} && echo old > {0}/out && echo mounted && \
         {1} render {CUBE} --size 512 -o {0}/out; echo $?; cat {0}/out; ls -A {0}",
        disk.display(),
        env!("CARGO_BIN_EXE_stackless")
    );
    let run = Command::new("unshare").args(["--mount", "--map-root-user", "sh", "-c", &script]).output();
    let text = run.map(|run| String::from_utf8(run.stdout).unwrap()).unwrap_or_default();
    if text.starts_with("mounted\n") {
        assert_eq!(text, "mounted\n2\nold\nout\n");
    } else {
        eprintln!("not run: no disk can be mounted here");
    }
}

/// No command overwrites its input, or writes two outputs to one place.
#[test]
fn a_place_has_one_use() {
    let place = Place::new();
    let path = |name: &str| place.folder.path(name).display().to_string();
    fs::copy(CUBE, path("cube.ply")).unwrap();
    symlink("cube.ply", path("link")).unwrap();
    fs::create_dir(path("folder")).unwrap();
    let [cube, link, round, rays, suite] = ["cube.ply", "link", "folder/../cube.ply", "rays.csv", "suite"].map(path);
    for target in [&cube, &link, &round] {
        for args in ["trace", "bench", "stats"] {
            let (more, option) = match args {
                "trace" => (vec!["--rays", &rays], "-o"),
                _ => (vec![], "--json"),
            };
            let run = place.command(args, &[&[cube.as_str()], &more[..], &[option, target]].concat()).output().unwrap();
            let error = String::from_utf8(run.stderr).unwrap();
            assert!(run.status.code() == Some(2) && error.contains("would overwrite an input"), "{args}: {error}");
        }
    }
    let refused = |args: &str, options: &[&str], what: &str| {
        let run = place.command(args, options).output().unwrap();
        let error = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && error.contains(what), "{args} {options:?}: {error}");
    };
    refused("trace CUBE --rays RAYS", &["-o", &rays], "would overwrite an input");
    refused("conform --waivers RAYS -- x", &["--write-waivers", &rays], "would overwrite an input");
    refused("suite export --suite SUITE", &["-o", &suite], "would overwrite an input");
    let twice = "two outputs";
    refused("stats CUBE", &["--json", &path("new"), "--plot", &path("folder/../new")], twice);
    refused("stats CUBE", &["--json", "-", "--plot", "-"], twice);
    symlink("new", path("dangling")).unwrap();
    refused("stats CUBE", &["--json", &path("new"), "--plot", &path("dangling")], twice);
    fs::remove_file(path("dangling")).unwrap();
    refused(
        "conform --suite SUITE -- STACKLESS suite serve",
        &["--json", &path("new"), "--junit", &path("new")],
        twice,
    );
    assert_eq!(fs::read(cube).unwrap(), fs::read(CUBE).unwrap());
    assert_eq!(place.folder.names(), ["cube.ply", "folder", "link", "rays.csv", "record.json", "suite"]);
}

/// A signal during writing leaves no temporary file, and the old file.
#[test]
fn a_signal_leaves_no_temporary_file() {
    let folder = Folder::new();
    let rays = folder.file("rays.csv", "0.5,0.5,9,0,0,-1,0,inf\n".repeat(400_000));
    for (signal, number) in heeded([("-INT", 2), ("-TERM", 15), ("-HUP", 1)]) {
        let out = Folder::new();
        out.file("hits.csv", "old");
        let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
        command.args(["-q", "trace"]).arg(data("cube.ply")).arg("--rays").arg(&rays);
        let mut child = command.arg("-o").arg(out.path("hits.csv")).spawn().unwrap();
        let start = Instant::now();
        // The check for writability also creates a file for a moment; this file grows.
        let is_growing =
            |name: &String| fs::metadata(out.path(name)).is_ok_and(|file| name != "hits.csv" && file.len() > 0);
        while !out.names().iter().any(is_growing) {
            assert!(
                child.try_wait().unwrap().is_none() && start.elapsed() < Duration::from_mins(2),
                "not seen writing"
            );
        }
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().signal(), Some(number), "{signal}");
        assert_eq!(out.names(), ["hits.csv"], "{signal}");
        assert_eq!(fs::read_to_string(out.path("hits.csv")).unwrap(), "old");
    }
}

/// For every end of the runner, the program under test and its children end, too.
#[test]
fn no_program_survives_its_runner() {
    let place = Place::new();
    for (signal, _) in heeded([("-INT", 2), ("-TERM", 15), ("-KILL", 9)]) {
        let pids = place.folder.path("pids");
        let script = format!("sleep 1000 & echo $$ $! > {0}.new; mv {0}.new {0}; sleep 1000", pids.display());
        let mut command = place.command("conform --suite SUITE --timeout 1000 --", &[]);
        let mut child =
            command.args(["sh", "-c", &script]).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        while !pids.exists() {
            assert!(child.try_wait().unwrap().is_none(), "the program was not started");
            std::thread::sleep(Duration::from_millis(10));
        }
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        child.wait().unwrap();
        for pid in fs::read_to_string(&pids).unwrap().split_whitespace() {
            let start = Instant::now();
            while is_running(pid) {
                assert!(start.elapsed() < Duration::from_secs(10), "{signal}: {pid} runs on");
                std::thread::sleep(Duration::from_millis(10));
            }
        }
        fs::remove_file(pids).unwrap();
    }
}

/// The signals that this process does not ignore, so its children do not ignore them. A shell makes background
/// processes ignore some signals.
fn heeded(signals: [(&'static str, i32); 3]) -> impl Iterator<Item = (&'static str, i32)> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    signals.into_iter().filter(move |(signal, number)| {
        let is_ignored = mask >> (number - 1) & 1 == 1;
        if is_ignored {
            println!("SKIPPED: {signal} is ignored here");
        }
        !is_ignored
    })
}

/// Whether a process runs. A process that has ended may still be in the table.
fn is_running(pid: &str) -> bool {
    let output = Command::new("ps").args(["-o", "stat=", "-p", pid]).output().unwrap();
    !matches!(output.stdout.trim_ascii().first(), None | Some(b'Z'))
}
