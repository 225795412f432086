//! Reports of failures: their order, and waivers.

use stackless_suite::{Runner, WaiverError, Waivers};

use super::runner::{RIGHT, program, run, runner, some_cases};

/// Waivers excuse only failures.
#[test]
fn waivers_are_for_what_fails() {
    let folder = tempfile::tempdir().unwrap();
    let load = |ids: &[&str]| {
        let list: Vec<_> = ids.iter().map(|id| serde_json::json!({ "id": id, "reason": "known" })).collect();
        let path = folder.path().join("waivers.json");
        std::fs::write(&path, serde_json::to_string(&list).unwrap()).unwrap();
        Waivers::load(&path)
    };
    let ids: Vec<_> = some_cases(3).profiles[0].cases.iter().map(|case| case.id.clone()).collect();
    let [first, second, third] = [&ids[0], &ids[1], &ids[2]].map(String::as_str);
    let excused = run(program(RIGHT), 3, 4, load(&[second, third]).unwrap()).unwrap();
    assert!(excused.is_conforming() && excused.waived() == 2, "{excused:?}");
    let stale = run(program(RIGHT), 3, 4, load(&[first, second, third]).unwrap()).unwrap();
    assert!(!stale.is_conforming());
    assert!(stale.to_junit().contains("waived, and passes"));
    let unknown = |id: &str| load(&[id]).unwrap().check(&super::SUITE);
    for id in ["key/u32/none", "key/u33/*"] {
        assert!(matches!(unknown(id), Err(WaiverError::Unknown(found)) if found == id));
    }
    let withdrawn = unknown("ray/exact/stack-ulp").unwrap_err();
    assert!(matches!(withdrawn, WaiverError::Withdrawn(case) if case.id == "ray/exact/stack-ulp"));
    assert!(withdrawn.to_string().contains("was withdrawn in suite 2.0.0: "), "{withdrawn}");
    for id in ["key/u32/*", "ray/exact/midpoint-even", "trace/*/random-1?"] {
        assert!(unknown(id).is_ok(), "{id}");
    }
    assert!(load(&[second, second]).is_err());
}

/// A pattern excuses failures among many cases. It is stale if none of them fails. Cases that are not run do not
/// matter.
#[test]
fn waivers_may_be_patterns_and_of_other_cases() {
    let run = |ids: &[&str], count| {
        let list: Vec<_> = ids.iter().map(|id| serde_json::json!({ "id": id, "reason": "known" })).collect();
        let waivers = Waivers::parse(&serde_json::to_string(&list).unwrap()).unwrap();
        run(program(RIGHT), count, 4, waivers).unwrap()
    };
    let excused = run(&["key/u32/*", "ray/exact/midpoint-even", "hash/*"], 3);
    assert!(excused.is_conforming() && excused.waived() == 2 && excused.count("pass") == 1, "{excused:?}");
    assert!(!run(&["key/u32/none-*"], 3).is_conforming());
    // The first case passes.
    let stale = run(&["key/u32/child*"], 1);
    assert!(!stale.is_conforming() && stale.faults[0].contains("not needed any more"), "{stale:?}");
    assert_eq!(stale.waived(), 0);
    // The written waivers excuse exactly the failures, and keep reasons.
    let waivers = serde_json::to_string(&run(&["key/u32/*"], 3).to_waivers()).unwrap();
    assert_eq!(waivers.matches("\"known\"").count(), 2, "{waivers}");
    let written = run(&[], 3).to_waivers();
    assert!(written.len() == 2 && written[0].reason.starts_with("fail: "), "{written:?}");
    let text = serde_json::to_string(&written).unwrap();
    let again = super::runner::run(program(RIGHT), 3, 4, Waivers::parse(&text).unwrap()).unwrap();
    assert!(again.is_conforming() && again.waived() == 2, "{again:?}");
}

/// A waiver of an undeclared profile is also stale.
#[test]
fn waivers_of_what_is_not_asked_are_reported() {
    let mut command = program(RIGHT);
    command[2] = command[2].replace("key/u32", "key/u64");
    let mut suite = super::SUITE.clone();
    suite.profiles.retain(|profile| profile.name().starts_with("key/u"));
    suite.profiles.iter_mut().for_each(|profile| profile.cases.truncate(1));
    for id in ["key/u32/*", suite.profiles[1].cases[0].id.as_str()] {
        assert!(id.starts_with("key/u32/"), "{id}");
        let list = serde_json::json!([{ "id": id, "reason": "known" }]).to_string();
        let waivers = Waivers::parse(&list).unwrap();
        let report = Runner { waivers, ..runner(command.clone(), &suite) }.run(|_| ()).unwrap();
        assert_eq!((report.count("pass"), report.waived()), (1, 0), "{report:?}");
        assert!(!report.is_conforming() && report.faults[0].contains("was not asked"), "{id}: {report:?}");
    }
}

/// The smallest case of each profile comes first, and basic profiles come before those that depend on them.
#[test]
fn failures_are_in_the_order_to_look_at_them() {
    let mut suite = super::SUITE.clone();
    suite.profiles.retain(|profile| ["trace/tape", "trace/script", "key/u32"].contains(&profile.name().as_str()));
    let mut command = program(r#"printf '{"seq":%s,"unsupported":"no"}\n' "$seq""#);
    command[2] = command[2].replace(r#"["key/u32"]"#, r#"["trace/tape","trace/script"]"#);
    let report = runner(command, &suite).run(|_| ()).unwrap();
    let failures = report.failures();
    assert_eq!(failures[..2].iter().map(|it| it.profile()).collect::<Vec<_>>(), ["trace/script", "trace/tape"]);
    assert_eq!(failures.len(), report.count("fail"));
    for profile in ["trace/script", "trace/tape"] {
        let of = |list: &[&stackless_suite::CaseResult]| {
            list.iter().filter(|it| it.profile() == profile).map(|it| it.size).collect::<Vec<_>>()
        };
        assert!(of(&failures).is_sorted() && !of(&report.verdicts.iter().collect::<Vec<_>>()).is_sorted());
    }
    let hint = |i: usize| report.look_first(failures[i]).unwrap();
    assert!(hint(0).contains("key/u32, on which this rests, is not named"), "{}", hint(0));
    assert_eq!(hint(1), "trace/script fails too: look there first");
    assert!(failures[1].explained_by().unwrap().contains(&failures[1].id) && !failures[1].why.is_empty());
}
