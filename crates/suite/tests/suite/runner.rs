//! The runner survives any behaviour of a program, and reports the case that caused it.

use std::time::Duration;

use stackless_suite::{Outcome, Report, RunError, Runner, Suite, Waivers};

/// Returns a program that answers each case by `answer`, a shell command with the number in `$seq`.
pub(crate) fn program(answer: &str) -> Vec<String> {
    let script = format!(
        r#"read -r hello
printf '{{"protocol":1,"name":"shell","profiles":["key/u32"]}}\n'
while read -r line; do
    case $line in *'"bye"'*) break ;; esac
    seq=${{line#*'"seq":'}}; seq=${{seq%%,*}}
    {answer}
done"#
    );
    ["sh", "-c", &script].map(ToOwned::to_owned).to_vec()
}

/// Returns the first cases of a profile.
pub(crate) fn some_cases(count: usize) -> Suite {
    let mut suite = super::SUITE.clone();
    suite.profiles.retain(|profile| profile.name() == "key/u32");
    suite.profiles[0].cases.truncate(count);
    suite
}

pub(crate) fn run(command: Vec<String>, count: usize, window: usize, waivers: Waivers) -> Result<Report, RunError> {
    Runner { waivers, window, ..runner(command, &some_cases(count)) }.run(|_| ())
}

pub(crate) fn runner(command: Vec<String>, suite: &Suite) -> Runner<'_> {
    Runner {
        command,
        suite,
        waivers: Waivers::default(),
        timeout: Duration::from_millis(700),
        budget: Duration::from_mins(1),
        window: 64,
        fail_fast: false,
        passes_errors: false,
    }
}

fn outcomes(answer: &str, count: usize) -> Report {
    let [one, few, many] = [1, 4, 64].map(|window| run(program(answer), count, window, Waivers::default()).unwrap());
    let names = |report: &Report| report.verdicts.iter().map(|it| it.outcome.name()).collect::<Vec<_>>();
    // The number of simultaneous cases does not matter.
    assert_eq!(names(&one), names(&few), "{answer}");
    assert_eq!(names(&one), names(&many), "{answer}");
    assert!(!many.is_conforming());
    many
}

pub(crate) const RIGHT: &str = r#"printf '{"seq":%s,"result":{"key":"2"}}\n' "$seq""#;

/// The first case queries the left child of the root, which is 2. The other cases have other answers.
#[test]
fn a_wrong_answer_is_a_failure() {
    let report = outcomes(RIGHT, 4);
    assert_eq!(report.verdicts[0].outcome, Outcome::Pass);
    assert!(matches!(report.verdicts[1].outcome, Outcome::Fail(_)));
    assert_eq!((report.count("pass"), report.count("fail")), (1, 3));
}

#[test]
fn a_crash_is_that_of_its_case() {
    let report = outcomes(&format!("[ \"$seq\" = 2 ] && exit 3; {RIGHT}"), 5);
    assert!(matches!(&report.verdicts[2].outcome, Outcome::Crash(how) if how.contains('3')), "{report:?}");
    assert_eq!((report.count("crash"), report.count("pass"), report.count("fail")), (1, 1, 3));
}

/// A crash that is not reproduced is still reported.
#[test]
fn a_crash_that_happens_once_is_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let once = folder.path().join("once");
    let right = r#"printf '{"seq":%s,"unsupported":"no"}\n' "$seq""#;
    let crash = format!("[ \"$seq\" = 3 ] && [ ! -e {0} ] && touch {0} && exit 3; {right}", once.display());
    let report = run(program(&crash), 6, 4, Waivers::default()).unwrap();
    assert_eq!((report.count("crash"), report.count("fail")), (0, 6));
    assert!(report.faults.len() == 1 && report.faults[0].contains("ended with cases unanswered"), "{report:?}");
    assert!(report.faults[0].contains("exit status: 3"), "{report:?}");
    // A reproduced crash is the outcome of its case, and not also a fault.
    let again = run(program(&format!("[ \"$seq\" = 3 ] && exit 3; {right}")), 6, 4, Waivers::default()).unwrap();
    assert_eq!((again.count("crash"), again.faults.len()), (1, 0), "{again:?}");
}

#[test]
fn silence_is_a_timeout() {
    let report = outcomes(&format!("[ \"$seq\" = 1 ] && sleep 60; {RIGHT}"), 3);
    assert_eq!(report.verdicts[1].outcome, Outcome::Timeout);
    assert_eq!(report.count("timeout"), 1);
}

#[test]
fn garbage_is_an_error() {
    let two = r#"echo '{"seq":1,"result":{"key":"3"},"reject":"trail"}'"#;
    let none = r#"echo '{"seq":1,"result":null}'"#;
    let others = ["echo nonsense", "echo", "echo '{}'", "echo '{\"seq\":1}'", "printf '\\377\\n'", "echo '[1,2]'"];
    for garbage in others.into_iter().chain([two, none]) {
        let report = outcomes(&format!("if [ \"$seq\" = 1 ]; then {garbage}; else {RIGHT}; fi"), 3);
        assert!(matches!(report.verdicts[1].outcome, Outcome::Error(_)), "{garbage}: {report:?}");
        assert_eq!(report.count("error"), 1, "{garbage}");
    }
}

#[test]
fn answers_out_of_order_are_errors() {
    let report = outcomes(r#"printf '{"seq":%s,"result":{"key":"2"}}\n' "$((seq + 1))""#, 3);
    assert_eq!(report.count("error"), 3);
    assert!(report.verdicts[0].outcome.to_string().contains("out of order"), "{report:?}");
}

#[test]
fn answers_beyond_what_was_asked_are_errors() {
    let twice = outcomes(&format!("{RIGHT}; [ \"$seq\" = 0 ] && {RIGHT}"), 3);
    assert!(matches!(&twice.verdicts[0].outcome, Outcome::Error(what) if what.contains("twice")), "{twice:?}");
    assert_eq!(twice.count("error"), 1);
    let after_all = outcomes(&format!("{RIGHT}; [ \"$seq\" = 2 ] && {RIGHT}"), 3);
    assert!(matches!(&after_all.verdicts[2].outcome, Outcome::Error(what) if what.contains("more")), "{after_all:?}");
}

#[test]
fn unsupported_is_a_failure_where_the_profile_was_named() {
    let report = outcomes(r#"printf '{"seq":%s,"unsupported":"no"}\n' "$seq""#, 3);
    assert_eq!(report.count("fail"), 3);
}

/// After any kind of failure, and with any cases already sent, the remaining cases are not run.
#[test]
fn the_first_failure_can_be_the_last() {
    let answers = ["exit 3", "sleep 60", "echo no", r#"printf '{"seq":%s,"unsupported":"no"}\n' "$seq""#];
    for (answer, window) in answers.iter().flat_map(|answer| [(answer, 1), (answer, 64)]) {
        let answer = format!("if [ \"$seq\" = 0 ]; then {RIGHT}; else {answer}; fi");
        let suite = some_cases(9);
        let report = Runner { window, fail_fast: true, ..runner(program(&answer), &suite) }.run(|_| ()).unwrap();
        let asked: Vec<_> = report.verdicts.iter().map(|it| it.outcome.is_bad()).collect();
        assert_eq!(asked, [false, true, false, false, false, false, false, false, false], "{answer}");
        assert_eq!((report.count("pass"), report.count("not-asked")), (1, 7), "{answer}");
        assert!(!report.is_conforming() && report.faults.is_empty(), "{answer}: {:?}", report.faults);
    }
}

/// A program that answers nothing is not restarted forever.
#[test]
fn whoever_only_ends_is_given_up() {
    let report = run(program("exit 1"), 60, 64, Waivers::default()).unwrap();
    assert!(report.count("crash") > 10 && report.count("error") > 10, "{report:?}");
    assert_eq!(report.count("crash") + report.count("error"), 60);
    assert!(report.verdicts[59].outcome.to_string().contains("given up"), "{report:?}");
}

#[test]
fn a_program_that_goes_on_after_bye_is_reported() {
    let mut command = program(RIGHT);
    command[2] += "\nsleep 60";
    let report = run(command, 1, 1, Waivers::default()).unwrap();
    assert_eq!(report.count("pass"), 1);
    assert!(!report.is_conforming());
    assert!(report.faults[0].contains("bye"), "{report:?}");
}

#[test]
fn no_program_and_no_hello_are_errors() {
    let no = |command: &[&str]| run(command.iter().map(|&word| word.to_owned()).collect(), 1, 1, Waivers::default());
    assert!(matches!(no(&["/no/such/program"]), Err(RunError::Start { .. })));
    assert!(matches!(no(&[]), Err(RunError::Start { .. })));
    for hello in ["exit 7", "sleep 60", "echo hello", "echo '{\"protocol\":2,\"name\":\"x\",\"profiles\":[]}'"] {
        assert!(matches!(no(&["sh", "-c", hello]), Err(RunError::Hello { .. })), "{hello}");
    }
}

#[test]
fn a_profile_that_there_is_not_is_reported() {
    let command =
        ["sh", "-c", r#"read -r hello; echo '{"protocol":1,"name":"x","profiles":["key/u23"]}'; read -r bye"#];
    let report = run(command.map(ToOwned::to_owned).to_vec(), 3, 1, Waivers::default()).unwrap();
    assert_eq!(report.count("not-asked"), 3);
    assert!(report.faults[0].contains("key/u23") && !report.is_conforming(), "{report:?}");
}

#[test]
fn what_is_named_twice_is_reported() {
    let twice = [r#""profiles":["key/u32","key/u32"]"#, r#""profiles":["key/u32"],"features":["trails","trails"]"#];
    for (names, what) in twice.into_iter().zip(["key/u32", "trails"]) {
        let mut command = program(RIGHT);
        command[2] = command[2].replace(r#""profiles":["key/u32"]"#, names);
        let report = run(command, 1, 1, Waivers::default()).unwrap();
        assert_eq!((report.count("pass"), report.faults.len()), (1, 1), "{report:?}");
        assert!(report.faults[0] == format!("'{what}' is named twice") && !report.is_conforming(), "{report:?}");
    }
}

/// The run ends even if a program is silent after every start.
#[test]
fn a_run_has_a_budget() {
    let suite = some_cases(40);
    let silent = format!("[ \"$((seq % 2))\" = 1 ] && sleep 60; {RIGHT}");
    let start = std::time::Instant::now();
    for window in [1, 64] {
        let budget = Duration::from_millis(1500);
        let report = Runner { budget, window, ..runner(program(&silent), &suite) }.run(|_| ()).unwrap();
        assert!(report.count("timeout") >= 1 && report.count("error") > 20, "{report:?}");
        assert!(report.verdicts[39].outcome.to_string().contains("given up"), "{report:?}");
        assert!(report.faults.iter().any(|fault| fault.contains("given up")), "{report:?}");
    }
    assert!(start.elapsed() < Duration::from_secs(10));
}

/// The standard error of a program is in the report of its exit, once, and is escaped for terminals.
#[test]
fn the_last_words_of_a_program_are_told() {
    let flood = "i=0; while [ $i -lt 3000 ]; do echo some words >&2; i=$((i + 1)); done";
    let crash = format!("{flood}; printf 'Error: \\033[2Jno\\n\\n' >&2; exit 3");
    let report = outcomes(&format!("[ \"$seq\" = 1 ] && {{ {crash}; }}; {RIGHT}"), 3);
    let text = report.verdicts[1].outcome.to_string();
    assert!(text.contains("exit status: 3; its standard error ends with: Error: \\u{1b}[2Jno"), "{text}");
    let hello = run(["sh", "-c", "echo broken >&2; exit 7"].map(ToOwned::to_owned).to_vec(), 1, 1, Waivers::default());
    assert!(hello.unwrap_err().to_string().ends_with("exit status: 7; its standard error ends with: broken"));
}

/// Reports are complete, and name the events.
#[test]
fn reports_can_be_read() {
    let report =
        outcomes(r#"if [ "$seq" = 1 ]; then echo '<&">'; else printf '{"seq":%s,"reject":"a<b"}\n' "$seq"; fi"#, 3);
    let junit = report.to_junit();
    assert!(
        junit.contains("failures=\"3\"") && junit.contains("&lt;&amp;&quot;&gt;") && !junit.contains("a<b"),
        "{junit}"
    );
    let json = serde_json::to_value(report.to_json()).unwrap();
    assert_eq!(json["conforms"], false);
    assert_eq!(json["cases"][1]["outcome"], "error");
    assert_eq!(json["cases"].as_array().unwrap().len(), 3);
}

/// A run without cases is not conformance.
#[test]
fn nothing_asked_is_no_conformity() {
    for profiles in ["[]", "[\"hash/fold\"]"] {
        let hello = format!(r#"read -r hello; echo '{{"protocol":1,"name":"x","profiles":{profiles}}}'; read -r bye"#);
        let report = run(vec!["sh".into(), "-c".into(), hello], 3, 1, Waivers::default()).unwrap();
        assert_eq!(report.count("not-asked"), 3);
        assert!(report.faults[0].contains("nothing was asked") && !report.is_conforming(), "{report:?}");
        assert!(report.to_junit().contains("failures=\"1\""));
    }
}

/// A declared profile needs a case that passes or is waived. Failed recommended cases are no evidence.
#[test]
fn nothing_is_said_of_a_profile_by_advice_alone() {
    let suite = super::suite_of(|id| id == "ray/invalid/negative-tmin" || id.starts_with("trace/tape/ties-"));
    let with = |profiles: &str, answer: &str| {
        let mut command = program(answer);
        command[2] = command[2].replace("\"key/u32\"", profiles);
        runner(command, &suite).run(|_| ()).unwrap()
    };
    let (right, wrong) = ("printf '{\"seq\":%s,\"reject\":\"interval\"}\\n' \"$seq\"", RIGHT);
    assert!(with("\"ray/invalid\"", right).is_conforming());
    let advised = with("\"ray/invalid\"", wrong);
    assert!(!advised.is_conforming() && advised.faults[0].contains("only advised"), "{:?}", advised.faults);
    // These cases need an undeclared feature.
    let other = with("\"ray/invalid\",\"trace/tape\"", right);
    assert!(!other.is_conforming() && other.faults[0].starts_with("trace/tape is named"), "{:?}", other.faults);
}

/// Long text from programs is shortened.
#[test]
fn long_answers_are_cut() {
    let long = "$(printf '%0100000d' 0)";
    for answer in [
        format!(r#"printf '{{"seq":%s,"result":{{"key":"%s"}}}}\n' "$seq" "{long}""#),
        format!(r#"printf '{{"seq":%s,"result":{{"key":"2","x%s":0}}}}\n' "$seq" "{long}""#),
        format!(r#"printf '{{"seq":%s,"reject":"%s"}}\n' "$seq" "{long}""#),
        format!(r#"printf '{{"seq":%s,"unsupported":"%s"}}\n' "$seq" "{long}""#),
        format!(r#"printf '{{"seq":%s,"x%s":0}}\n' "$seq" "{long}""#),
        format!("echo {long}"),
    ] {
        let report = run(program(&answer), 1, 1, Waivers::default()).unwrap();
        let text = report.verdicts[0].outcome.to_string();
        assert!(report.verdicts[0].outcome.is_bad() && text.len() < 500, "{answer}: {text}");
        assert!(report.to_junit().len() < 2000 && serde_json::to_string(&report.to_json()).unwrap().len() < 2000);
    }
    let hello = format!(
        r#"read -r hello; printf '{{"protocol":1,"name":"%s","version":"%s","profiles":["x%s"]}}\n' {long} {long} {long}; read -r bye"#
    );
    let report = run(vec!["sh".into(), "-c".into(), hello], 1, 1, Waivers::default()).unwrap();
    assert!(report.hello.name.len() < 200 && report.hello.version.len() < 200 && report.faults[0].len() < 200);
    let wrong = format!(r#"read -r hello; printf '{{"protocol":1,"name":"x","features":["%s"]}}\n' {long}"#);
    let error = run(vec!["sh".into(), "-c".into(), wrong], 1, 1, Waivers::default()).unwrap_err();
    // The command is also shortened.
    assert!(error.to_string().len() < 1000, "{error}");
}

/// `JUnit` files are valid XML with any text from the program, and their counts match their elements.
#[test]
fn junit_is_well_formed_and_adds_up() {
    let evil = "\u{0}\u{1}\u{1b}[2J]]>&lt;<!--\u{7f}\u{9f}\u{fffe}\u{ffff}\u{202e}\"'\r\n\t\u{10ffff}";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("waivers.json");
    let suite = some_cases(6);
    let id = |i: usize| suite.profiles[0].cases[i].id.clone();
    let list = serde_json::json!([{ "id": id(0), "reason": evil }, { "id": id(1), "reason": evil }]);
    std::fs::write(&path, format!("\u{feff}{list}")).unwrap();
    let waivers = Waivers::load(&path).unwrap();
    let mut report = run(program(RIGHT), 6, 4, waivers).unwrap();
    report.hello.name = evil.to_owned();
    report.faults.push(evil.to_owned());
    report.verdicts[2].outcome = Outcome::Error(evil.to_owned());
    report.verdicts[3].outcome = Outcome::NotAsked;
    let text = report.to_junit();
    let xml = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    let root = xml.root_element();
    let count = |tag: &str| xml.descendants().filter(|node| node.has_tag_name(tag)).count().to_string();
    for (attribute, tag) in [("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")] {
        assert_eq!(root.attribute(attribute), Some(count(tag).as_str()), "{attribute}: {text}");
    }
    assert_eq!(root.attribute("errors"), Some("0"));
    assert_eq!((count("testcase"), count("failure"), count("skipped")), ("7".into(), "5".into(), "2".into()));
}

/// Neither a time-out nor the end of a run leaves a process, including those that the program has started.
#[cfg(unix)]
#[test]
fn nothing_survives() {
    for answer in ["sleep 1000", "exit 1", RIGHT] {
        let folder = tempfile::tempdir().unwrap();
        let pids = folder.path().join("pids");
        let name = pids.display();
        let command = program(&format!("sleep 1000 & echo $$ $! >> {name}; {answer}"));
        run(command, 2, 1, Waivers::default()).unwrap();
        let pids = std::fs::read_to_string(pids).unwrap();
        let alive: Vec<_> = pids.split_whitespace().filter(|pid| is_alive(pid)).collect();
        assert!(pids.split_whitespace().count() >= 2 && alive.is_empty(), "{answer}: {alive:?} of {pids:?}");
    }
}

/// Returns whether a process still runs after a short time. An ended process may still be in the process table.
#[cfg(unix)]
fn is_alive(pid: &str) -> bool {
    let state = || {
        let output = std::process::Command::new("ps").args(["-o", "stat=", "-p", pid]).output().unwrap();
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    };
    for _ in 0..100 {
        if matches!(state().chars().next(), None | Some('Z')) {
            return false;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    true
}
