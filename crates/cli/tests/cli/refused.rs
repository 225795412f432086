//! Requests that are refused instead of being done partly, uselessly, or without end.

use std::process::Command;

use super::support::{Folder, stackless};

/// An option is obeyed or refused.
#[test]
fn a_build_that_was_asked_for_is_not_replaced() {
    let rays = Folder::new();
    let rays = rays.file("rays.csv", "0,0,9,0,0,-1,0,inf\n");
    let rays = rays.display();
    for build in ["standard", "best", "sbvh"] {
        let run = stackless(&format!("trace soup --rays {rays} -o - --method complete --build {build}"), &[]);
        run.fails_naming(&["complete"]);
        let run = stackless(
            &format!("render soup --size 8 -o - --heatmap nodes --method stack,complete --build {build}"),
            &[],
        );
        run.fails_naming(&["complete"]);
    }
    for build in ["", "--build median"] {
        let run = stackless(&format!("trace soup --rays {rays} -o - --method complete {build}"), &[]);
        assert_eq!(run.code, Some(0), "{run:?}");
    }
}

/// A run without any checks does not start.
#[test]
fn nothing_to_do_is_refused() {
    for (args, naming) in [
        ("stress --count 0", "0 is not in 1.."),
        ("check soup --count 0", "0 is not in 1.."),
        ("stats soup --count 0", "0 is not in 1.."),
        ("conform --filter nothing -- true", "no case"),
    ] {
        let run = stackless(args, &[]);
        assert!(run.code == Some(2) && run.stdout.is_empty() && run.stderr.contains(naming), "{args}: {run:?}");
    }
}

fn refuse_counts(most: u64) {
    for args in [
        format!("stress --count {most}"),
        format!("check soup --count {most}"),
        format!("stats soup --count {most}"),
        format!("bench soup --count {most}"),
    ] {
        let run = stackless(&args, &[]);
        assert!(
            run.code == Some(2) && ["is not in", "too large"].iter().any(|what| run.stderr.contains(what)),
            "{args}: {run:?}"
        );
    }
}

/// Requests for too much memory or time are refused early.
#[test]
fn numbers_beyond_all_bounds_are_refused() {
    for most in [u64::MAX, u64::from(u32::MAX)] {
        refuse_counts(most);
    }
    let threads = |count: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
        command.args(["stress", "--list"]).env("RAYON_NUM_THREADS", count).output().unwrap()
    };
    let refused = threads("100000");
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("RAYON_NUM_THREADS=100000: expected up to 1024"));
    assert!(threads("3").status.success() && threads("0").status.success() && threads("many").status.success());
}

/// Endless input is refused.
#[cfg(unix)]
#[test]
fn endless_requests_are_refused() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stackless"));
    let zeros = std::fs::File::open("/dev/zero").unwrap();
    let run = command.args(["suite", "serve"]).stdin(zeros).output().unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&run.stderr).contains("a line of more than 67108864 bytes"));
    let endless = stackless("check --replay /dev/zero", &[]);
    endless.fails_naming(&["/dev/zero", "more than 67108864 bytes"]);
}

/// Unknown fields are errors.
#[test]
fn unknown_fields_of_a_replay_are_refused() {
    let folder = Folder::new();
    let good = r#"{"children":[null],"cells":[{"hit":1}],"any":false}"#;
    stackless("check --replay", &[&folder.file("good.json", good)]).passes();
    stackless("check --replay", &[&folder.file("marked.json", format!("\u{feff}{good}"))]).passes();
    for (name, from, to) in [("top.json", "\"any\"", "\"anny\""), ("cell.json", "\"hit\"", "\"hits\"")] {
        let path = folder.file(name, good.replace(from, to));
        stackless("check --replay", &[&path]).fails_naming(&[name, "unknown field"]);
    }
}

/// An implementation that runs no case does not conform.
#[test]
fn a_program_that_is_asked_nothing_does_not_conform() {
    let folder = Folder::new();
    let suite = folder.path("suite");
    stackless("suite export --filter key/u32/child-* -o", &[&suite]).passes();
    let suite = suite.display();
    for profiles in ["[]", "[\"key/u64\"]"] {
        let script = format!(r#"read -r hello; echo '{{"protocol":1,"name":"x","profiles":{profiles}}}'; read -r bye"#);
        let script = folder.file("program.sh", script);
        let run = stackless(&format!("conform --suite {suite} -- sh"), &[&script]);
        assert_eq!(run.code, Some(1), "{run:?}");
        assert!(run.stdout.contains("nothing was asked") && run.stdout.contains("does not conform"), "{run:?}");
    }
}

/// Output of other programs reaches the terminal as text.
#[test]
fn a_program_does_not_write_to_the_terminal() {
    let folder = Folder::new();
    let suite = folder.path("suite");
    stackless("suite export --filter key/u32/child-* -o", &[&suite]).passes();
    let evil = r"\u001b[2J\u0007\u009b\u202e";
    let script = format!(
        r#"read -r hello; printf '%s\n' '{{"protocol":1,"name":"{evil}","version":"{evil}","profiles":["key/u32","{evil}"]}}'
while read -r line; do
    case $line in *'"bye"'*) break ;; esac
    seq=${{line#*'"seq":'}}; seq=${{seq%%,*}}
    printf '{{"seq":%s,"reject":"%s"}}\n' "$seq" '{evil}'
done"#
    );
    let script = folder.file("program.sh", script);
    let run = stackless(&format!("conform --suite {} -- sh", suite.display()), &[&script]);
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stdout.contains("\\u{1b}[2J\\u{7}\\u{9b}\\u{202e}"), "{run:?}");
    let is_plain = |text: &str| text.chars().all(|c| c == '\n' || !c.is_control() && c != '\u{202e}');
    assert!(is_plain(&run.stdout) && is_plain(&run.stderr), "{run:?}");
}

/// A foreign suite is written atomically, and only inside its folder.
#[test]
fn a_suite_of_others_stays_in_its_folder() {
    let folder = Folder::new();
    let suite = folder.path("suite");
    stackless("suite export --filter key/u32/child-* -o", &[&suite]).passes();
    let index = suite.join("index.json");
    let text = std::fs::read_to_string(&index).unwrap().replace("key/u32", "key/../../../out");
    std::fs::write(&index, text).unwrap();
    let run = stackless(&format!("suite export --suite {} -o", suite.display()), &[&folder.path("to")]);
    run.fails_naming(&["index.json", "key/../../../out"]);
    assert_eq!(folder.names(), ["suite"]);
}
