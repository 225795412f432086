//! The output of `stackless conform`.

use super::support::{Folder, read_json, stackless};

/// A program that rejects every case.
const REJECTS: &str = r#"read -r hello
printf '{"protocol":1,"name":"x","profiles":["key/u32","trace/script","trace/tape"],"features":["changing"]}\n'
echo noise >&2
while read -r line; do
    case $line in *'"bye"'*) break ;; esac
    seq=${line#*'"seq":'}; seq=${seq%%,*}
    printf '{"seq":%s,"reject":"trail"}\n' "$seq"
done"#;

/// The first failure is the smallest case of a basic profile, with a reason and a working command that shows it.
#[test]
fn a_failing_case_teaches() {
    let folder = Folder::new();
    let script = folder.file("program.sh", REJECTS);
    let run = stackless("conform --filter trace/tape/* --filter trace/script/three-* --show 2 -- sh", &[&script]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""), "{run:?}");
    let lines: Vec<_> = run.stdout.lines().skip(1).map(str::trim).collect();
    assert!(lines[0].starts_with("trace/script/three-") && lines[0].contains(": fail: rejected as 'trail'"), "{run:?}");
    assert_eq!(lines[1], "why: One decision.");
    assert!(lines[2].starts_with("clauses ORACLE-1") && lines[3].starts_with("alone: stackless conform"), "{run:?}");
    let explain = lines[4].strip_prefix("step by step: stackless ").unwrap().replace('\'', "");
    stackless(&explain.replace("case.html", ""), &[&folder.path("case.html")]).passes();
    assert!(lines[5].starts_with("trace/tape/"), "{run:?}");
    assert!(lines.contains(&"trace/script fails too: look there first"), "{run:?}");
    let version = stackless("suite list", &[]).passes().first_line().split([' ', ',']).nth(1).unwrap().to_owned();
    assert!(run.first_line().contains(&format!("x  does not conform (suite {version}): 0 of ")), "{run:?}");
    let with_noise = stackless("conform --filter key/u32/* --stderr -- sh", &[&script]);
    assert_eq!(with_noise.stderr, "noise\n");
}

/// The written waivers make the run succeed, and waivers of cases that did not run are kept.
#[test]
fn waivers_are_written() {
    let folder = Folder::new();
    let script = folder.file("program.sh", REJECTS);
    let [first, second, json] = ["first.json", "second.json", "report.json"].map(|name| folder.path(name));
    let shown = |path: &std::path::Path| path.display().to_string();
    let keys = format!("conform --filter key/u32/* --write-waivers {} -- sh", shown(&first));
    assert_eq!(stackless(&keys, &[&script]).code, Some(1));
    let traces = format!(
        "conform --level trace --waivers {} --write-waivers {} --json {} -- sh",
        shown(&first),
        shown(&second),
        shown(&json)
    );
    assert_eq!(stackless(&traces, &[&script]).code, Some(1));
    let of = |path: &std::path::Path, start: &str| {
        let list = read_json(path);
        let ids = list.as_array().unwrap().iter().filter_map(|waiver| waiver["id"].as_str());
        ids.filter(|id| id.starts_with(start)).count()
    };
    assert_eq!((of(&first, "key/u32/"), of(&first, "trace/")), (285, 0));
    assert!(of(&second, "trace/script/") > 500 && of(&second, "key/u32/") == 285);
    stackless(&format!("conform --waivers {} -- sh", shown(&second)), &[&script]).passes();
    let wild =
        folder.file("wild.json", r#"[{"id": "key/*", "reason": "known"}, {"id": "trace/*", "reason": "known"}]"#);
    stackless(&format!("conform --waivers {} -- sh", shown(&wild)), &[&script]).passes();
    let unknown = folder.file("unknown.json", r#"[{"id": "key/u33/*", "reason": "known"}]"#);
    stackless(&format!("conform --waivers {} -- sh", shown(&unknown)), &[&script]).fails_naming(&["key/u33/*"]);
    let withdrawn = folder.file("withdrawn.json", r#"[{"id": "ray/exact/stack-ulp", "reason": "known"}]"#);
    for words in [format!("--waivers {}", shown(&withdrawn)), "--filter ray/exact/stack-ulp".to_owned()] {
        stackless(&format!("conform {words} -- sh"), &[&script]).fails_naming(&[
            "case 'ray/exact/stack-ulp' was withdrawn in suite 2.0.0: ",
            "ray/exact/stack-ulp-ordered",
        ]);
    }
    let report = read_json(&json);
    assert!(report["suite"].as_str().is_some_and(|version| version.split('.').count() == 3));
    assert!(report["cases"].as_array().unwrap().iter().all(|case| case["why"].is_string()));
}
