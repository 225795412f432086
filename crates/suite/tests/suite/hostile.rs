//! Lines that are almost valid. `tests/suite/test_hostile.py` tests the runner in Python with the same lines.

use serde::Deserialize;
use stackless_suite::RunError;

use super::runner::runner;
use super::suite_of;

#[derive(Deserialize)]
struct Hostile {
    hellos: Vec<Row>,
    answers: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    #[serde(default = "first")]
    case: String,
    line: String,
    outcome: String,
}

fn first() -> String {
    "key/u32/child-left-root".to_owned()
}

/// Returns the outcome of one case for a program that writes these lines.
fn outcome(case: &str, hello: &str, answer: &str) -> (&'static str, bool) {
    let script = r#"read -r h; printf '%s\n' "$1"; read -r c; printf '%s\n' "$2"; read -r b"#;
    let suite = suite_of(|id| id == case);
    let command = ["sh", "-c", script, "sh", hello, answer].map(ToOwned::to_owned).to_vec();
    let runner = stackless_suite::Runner { timeout: std::time::Duration::from_secs(20), ..runner(command, &suite) };
    match runner.run(|_| ()) {
        Ok(report) => (report.verdicts[0].outcome.name(), report.is_conforming()),
        Err(RunError::Hello { .. }) => ("refused", false),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn hostile_lines_are_taken_for_what_they_are() {
    let Hostile { hellos, answers } = serde_json::from_str(&super::adapters::text("hostile.json")).unwrap();
    assert!(hellos.len() >= 40 && answers.len() >= 80);
    for Row { case, line, outcome: expected } in hellos {
        let found = match outcome(&case, &line, r#"{"seq":0,"result":{"key":"2"}}"#) {
            (_, true) => "conforms",
            ("refused", _) => "refused",
            _ => "does not conform",
        };
        assert_eq!(found, expected, "{line}");
    }
    for Row { case, line, outcome: expected } in answers {
        let profile = case.rsplit_once('/').unwrap().0;
        let hello = format!(r#"{{"protocol":1,"name":"x","profiles":["{profile}"]}}"#);
        assert_eq!(outcome(&case, &hello, &line).0, expected, "{case}: {line}");
    }
}
