//! The conformance suite: its files are up to date, and this library conforms.
//!
//! `tests/planted` runs the suite on the library with planted bugs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use stackless_bvh::traverse::{Method, WordName};
use stackless_bvh::wide::Method as WideMethod;
use stackless_suite::{
    Answer, Ask, Flaw, Hello, Implementation, Level, Library, Limits, Profile, Suite, SuiteCase, Traversal, WideLimits,
    Withdrawn, author, judge,
};

#[path = "suite/adapters.rs"]
mod adapters;
#[path = "suite/foreign.rs"]
mod foreign;
#[path = "suite/hostile.rs"]
mod hostile;
#[path = "suite/imports.rs"]
mod imports;
#[path = "suite/mistakes.rs"]
mod mistakes;
#[path = "suite/report.rs"]
mod report;
#[path = "suite/runner.rs"]
mod runner;

/// The suite. Generating it takes seconds.
static SUITE: LazyLock<Suite> = LazyLock::new(author::suite);

/// Selects the cases whose ids satisfy a predicate.
fn suite_of(is_wanted: impl Fn(&str) -> bool) -> Suite {
    let of = |profile: &Profile| {
        let cases = profile.cases.iter().filter(|case| is_wanted(&case.id)).cloned().collect();
        Profile { suite: profile.suite.clone(), level: profile.level, profile: profile.profile.clone(), cases }
    };
    Suite { profiles: SUITE.profiles.iter().map(of).filter(|profile| !profile.cases.is_empty()).collect() }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec/suite")
}

/// To regenerate the files: `UPDATE=1 cargo test -p stackless-suite --test suite`.
#[test]
fn the_files_are_as_made() {
    let suite = &*SUITE;
    for (path, text) in suite.files() {
        let path = root().join(path);
        if std::env::var_os("UPDATE").is_some() {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, &text).unwrap();
        }
        assert!(std::fs::read_to_string(&path).unwrap_or_default() == text, "{} is not what is made", path.display());
    }
    assert_eq!(Suite::load(&root()).unwrap(), *suite);
    assert!(std::env::var_os("UPDATE").is_some() || Suite::shipped().unwrap() == *suite);
}

/// `spec/suite/peers.py` generates the table. This test does not run other ray tracers.
#[test]
fn the_table_of_other_ray_tracers_has_each_case() {
    let suite = &*SUITE;
    let text = std::fs::read_to_string(root().join("PEERS.md")).unwrap();
    let rows: BTreeSet<_> = text.lines().filter_map(|line| line.strip_prefix("| `ray/")?.split('`').next()).collect();
    let cases = suite.cases().filter_map(|(_, case)| case.id.strip_prefix("ray/"));
    assert_eq!(rows, cases.filter(|id| !id.starts_with("invalid/")).collect());
}

/// The ids of withdrawn cases are never used again, and their reasons name existing cases.
#[test]
fn no_id_of_a_withdrawn_case_is_used_again() {
    let ids: BTreeSet<_> = SUITE.cases().map(|(_, case)| case.id.as_str()).collect();
    let mut withdrawn = BTreeSet::new();
    for case in Withdrawn::ALL {
        assert!(!ids.contains(case.id) && withdrawn.insert(case.id), "{}", case.id);
        assert!(!case.reason.is_empty(), "{}", case.id);
        for id in case.reason.split(' ').filter(|word| word.contains('/')) {
            assert!(ids.contains(id), "{}: {id}", case.id);
        }
    }
    assert!(!withdrawn.is_empty());
}

/// Checks the properties that the documentation of the suite promises.
#[test]
fn the_suite_is_as_promised() {
    let suite = &*SUITE;
    let count = suite.cases().count();
    assert!(count >= 1500, "{count} cases");
    let bytes: usize = suite.files().iter().map(|(_, text)| text.len()).sum();
    assert!(bytes <= 20 << 20, "{bytes} bytes");
    for (_, case) in suite.cases() {
        let SuiteCase { id, clauses, why, input, .. } = case;
        assert!(!clauses.is_empty() && !why.is_empty() && !why.contains('\n'), "{id}");
        assert!(Ask::of(input).is_ok(), "{id}");
    }
}

/// Checks every traversal with every word. `[CONF-1]` `[CONF-2]` `[CONF-3]`
#[test]
fn this_library_conforms() {
    let suite = &*SUITE;
    let each = Method::ALL.iter().flat_map(|&method| WordName::ALL.map(|word| (Some(method), Some(word))));
    for (method, word) in each.chain([(None, None)]) {
        // Laine's trail is aligned to the highest bit of a word.
        if method.is_some_and(Method::restarts) && word == Some(WordName::Grow) {
            continue;
        }
        let mut library = Library::new(method.map(Traversal::Binary), word);
        let hello = library.hello();
        let mut asked = 0;
        for (profile, case) in suite.cases() {
            // Other levels do not depend on word and method.
            let is_walk = matches!(profile.level, Level::Trace | Level::Resume);
            if hello.asks_for(profile, case) && (is_walk || method.is_none()) {
                asked += 1;
                let answer = library.answer(profile.level, &profile.profile, &case.input);
                assert_eq!(judge(case, &hello, &answer), Ok(()), "{}: {}", hello.name, case.id);
            }
        }
        let least = if method == Some(Method::Complete) { 30 } else { 60 };
        assert!(asked >= least, "{}: {asked} cases", hello.name);
    }
}

/// Checks every traversal of wide trees. `[CONF-1]` `[CONF-3]` `[WIDE-7]` `[WIDE-14]`
#[test]
fn this_library_conforms_on_wide_trees() {
    let suite = &*SUITE;
    for method in WideMethod::ALL {
        let mut library = Library::new(Some(Traversal::Wide(method)), None);
        let hello = library.hello();
        let (mut asked, mut too_deep) = (BTreeMap::<_, u32>::new(), 0);
        for (profile, case) in suite.cases() {
            if hello.asks_for(profile, case) && profile.profile.starts_with("wide") {
                *asked.entry(profile.name()).or_default() += 1;
                let answer = library.answer(profile.level, &profile.profile, &case.input);
                assert_eq!(judge(case, &hello, &answer), Ok(()), "{}: {}", hello.name, case.id);
                too_deep += u32::from(answer == Answer::Reject("too-deep".to_owned()));
            }
        }
        let least = |profile: &str| match profile {
            "trace/wide" => 250,
            "resume/wide" => 90,
            "hash/wide-deep" => 9,
            _ => 10,
        };
        let restarts = hello.name.starts_with("wide-restart");
        assert_eq!(asked.contains_key("resume/wide"), !restarts, "{}", hello.name);
        assert!(asked.len() >= 3 && asked.iter().all(|(profile, count)| *count >= least(profile)), "{asked:?}");
        assert_eq!(too_deep > 0, method != WideMethod::Stack, "{}", hello.name);
    }
}

/// Only cases with supported numbers of slots are run. `[CONF-3]`
#[test]
fn only_slots_that_are_carried_are_asked_for() {
    let limits: Limits = serde_json::from_str(r#"{"wide":{"8":16}}"#).unwrap();
    assert_eq!(limits.wide, Some(WideLimits { of_8: Some(16), ..WideLimits::default() }));
    let some = Hello { limits, ..Library::default().hello() };
    let all = Hello { limits: Limits::default(), ..some.clone() };
    let mut asked = BTreeMap::<_, u32>::new();
    for (profile, case) in SUITE.cases() {
        let Some(slots) = case.input.get("slots") else { continue };
        *asked.entry(slots.to_string()).or_default() += 1;
        assert!(all.asks_for(profile, case), "{}", case.id);
        assert_eq!(some.asks_for(profile, case), slots == 8, "{}", case.id);
    }
    assert!(asked.keys().eq(["2", "4", "8"]) && asked.values().all(|&count| count > 100), "{asked:?}");
}

/// With key 2 and trail 3, the node on the path would also be pending. `[WIDE-10]`
#[test]
fn a_wide_state_that_is_none_is_rejected() {
    let mut library = Library::default();
    let mut taken_up = |key: &str, trail: &str| {
        let input = serde_json::json!({
            "op": "resume-wide", "slots": 2, "children": [[1, 2], null, null], "ranks": [[0, 1], null, null],
            "key": key, "trail": trail, "next": "visit"
        });
        library.answer(Level::Resume, "wide", input.as_object().unwrap())
    };
    assert!(matches!(taken_up("2", "2"), Answer::Result(_)));
    for (key, trail, code) in [
        ("2", "3", "trail"),
        ("2", "8", "trail"),
        ("1", "1", "trail"),
        ("4", "0", "no-such-node"),
        ("0", "0", "no-such-node"),
    ] {
        assert_eq!(taken_up(key, trail), Answer::Reject(code.to_owned()), "{key} {trail}");
    }
}

/// `[REGISTER-1]`
#[test]
fn registers_are_as_many_as_visits() {
    let (suite, mut library) = (&*SUITE, Library::new(Some(Traversal::Binary(Method::Hashed)), None));
    let hello = library.hello();
    let (profile, case) = suite.cases().find(|(_, case)| case.id == "trace/script/random-66").unwrap();
    let answer = library.answer(profile.level, &profile.profile, &case.input);
    assert_eq!(judge(case, &hello, &answer), Ok(()));
    let Answer::Result(result) = answer else { panic!("{answer:?}") };
    let with = |change: fn(&mut Vec<serde_json::Value>)| {
        let mut changed = result.clone();
        change(changed["registers"].as_array_mut().unwrap());
        judge(case, &hello, &Answer::Result(changed))
    };
    assert!(matches!(with(|registers| registers.truncate(1)), Err(Flaw::Missing(_))));
    assert!(matches!(with(|registers| registers.push(serde_json::Value::Null)), Err(Flaw::Differs { .. })));
}

/// `[HASH-6]`
#[test]
fn a_table_needs_its_fields_and_no_more() {
    let (suite, mut library) = (&*SUITE, Library::default());
    let hello = library.hello();
    for (name, has_long_keys) in [("hash/build", false), ("hash/build-deep", true)] {
        let (profile, case) = suite.cases().find(|(profile, _)| profile.name() == name).unwrap();
        let answer = library.answer(profile.level, &profile.profile, &case.input);
        let Answer::Result(result) = answer else { panic!("{answer:?}") };
        let with = |field: &str, value: Option<&str>| {
            let mut changed = result.clone();
            match value {
                Some(text) => changed.insert(field.to_owned(), text.into()),
                None => changed.remove(field),
            };
            judge(case, &hello, &Answer::Result(changed))
        };
        let fold = has_long_keys.then_some("fold");
        for field in ["displacements", "cells"].into_iter().chain(fold) {
            assert_eq!(with(field, None), Err(Flaw::Missing(field.to_owned())), "{name}");
            assert!(matches!(with(field, Some("no word")), Err(Flaw::Missing(_) | Flaw::Table(_))), "{name}: {field}");
        }
        for field in ["more"].into_iter().chain((!has_long_keys).then_some("fold")) {
            assert_eq!(with(field, Some("0")), Err(Flaw::Unknown(field.to_owned())), "{name}");
        }
    }
}

/// A deep tree without hashed long keys needs no seed for folding, but may have one. `[HASH-6]`
#[test]
fn a_table_without_long_keys_may_have_no_fold() {
    let mut library = Library::default();
    let hello = library.hello();
    let (mut without, mut needs) = (0, 0);
    for (profile, case) in SUITE.cases().filter(|(profile, _)| profile.name() == "hash/build-deep") {
        let Answer::Result(mut result) = library.answer(profile.level, &profile.profile, &case.input) else {
            panic!("{}", case.id)
        };
        result.insert("fold".to_owned(), "1".into());
        let may_have_any = judge(case, &hello, &Answer::Result(result.clone())).is_ok();
        result.remove("fold");
        match judge(case, &hello, &Answer::Result(result)) {
            Ok(()) => {
                assert!(may_have_any, "{}", case.id);
                without += 1;
            }
            flaw => {
                assert_eq!(flaw, Err(Flaw::Missing("fold".to_owned())), "{}", case.id);
                needs += 1;
            }
        }
    }
    assert!(without >= 6 && needs >= 20, "{without} without, {needs} with a fold");
}
