//! The conformance suite: its files are as made, this library conforms, and implementations with bugs do not.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use stackless_bvh::event::State;
use stackless_bvh::generate::Search;
use stackless_bvh::order::Flow;
use stackless_bvh::traverse::{Method, Test, WordName};
use stackless_bvh::tree::{Keys, Topology};
use stackless_bvh::wide::Method as WideMethod;
use stackless_check::planted::{self, Instead, LAYERS, Planted, Seer};
use stackless_suite::{
    Answer, Ask, Expect, Feature, Flaw, Hello, Implementation, Level, Library, Limits, PROTOCOL, Start, Suite,
    SuiteCase, Traversal, WideLimits, Withdrawn, author, judge,
};

#[path = "suite/adapters.rs"]
mod adapters;
#[path = "suite/foreign.rs"]
mod foreign;
#[path = "suite/imports.rs"]
mod imports;
#[path = "suite/layers.rs"]
mod layers;
#[path = "suite/report.rs"]
mod report;
#[path = "suite/runner.rs"]
mod runner;
#[path = "../../../tests/library/bites/table.rs"]
#[allow(dead_code, reason = "of the whole table this test has a column")]
mod table;
#[path = "suite/wide.rs"]
mod wide;

/// The suite, which takes seconds to make.
static SUITE: LazyLock<Suite> = LazyLock::new(author::suite);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec/suite")
}

/// To make the files anew: `UPDATE=1 cargo test -p stackless-suite --test suite`.
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

/// `spec/suite/peers.py` makes the table anew; what others answer is not asked here.
#[test]
fn the_table_of_other_ray_tracers_has_each_case() {
    let suite = &*SUITE;
    let text = std::fs::read_to_string(root().join("PEERS.md")).unwrap();
    let rows: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("| `ray/")?.split('`').next()).collect();
    let has_hits =
        |case: &&SuiteCase| case.id.starts_with("ray/") && matches!(case.expect, Expect::Result(_) | Expect::Near(_));
    let cases: Vec<_> =
        suite.cases().map(|(_, case)| case).filter(has_hits).map(|case| &case.id["ray/".len()..]).collect();
    assert_eq!(BTreeSet::from_iter(rows), BTreeSet::from_iter(cases));
}

/// An id stands for one case for ever, and a reason names cases that exist.
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

/// What the suite promises to those who read it.
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

/// Every traversal in every word. `[CONF-1]` `[CONF-2]` `[CONF-3]`
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
            // Words and methods make no difference to the others.
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

/// Every traversal of wide trees. `[CONF-1]` `[CONF-3]` `[WIDE-7]` `[WIDE-14]`
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
            _ => 10,
        };
        let restarts = hello.name.starts_with("wide-restart");
        assert_eq!(asked.contains_key("resume/wide"), !restarts, "{}", hello.name);
        assert!(asked.len() >= 3 && asked.iter().all(|(profile, count)| *count >= least(profile)), "{asked:?}");
        assert_eq!(too_deep > 0, method != WideMethod::Stack, "{}", hello.name);
    }
}

/// Who carries trees of some slots is asked about these. `[CONF-3]`
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

/// A deep tree of which no long key is hashed needs no seed of the fold, and may have one. `[HASH-6]`
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

/// Each planted bug, as an implementation, fails a case of the clause that it breaks. `[CONF-4]`
#[test]
fn every_planted_bug_fails_a_case_of_its_clause() {
    let suite = &*SUITE;
    for control in planted::controls() {
        let (_, failed) = failures(&control, suite);
        assert!(failed.is_empty(), "{control:?}: {:?}", failed.iter().map(|(case, flaw)| (&case.id, flaw)).next());
    }
    let asked = layers::Asked::of(suite);
    let with_mistake = |instead| match instead {
        Instead::Walk(walk) => failures(&walk(), suite),
        Instead::Wide(bug) => wide::failures(bug, suite),
        instead => asked.failures(instead),
    };
    let controls = LAYERS.iter().flat_map(|layer| layer.controls);
    for control in controls.filter(|control| !matches!(control.instead(), Instead::Nothing(_))) {
        let (asked, failed) = with_mistake(control.instead());
        let first = failed.iter().map(|(case, flaw)| (&case.id, flaw)).next();
        assert!(asked > 0 && failed.is_empty(), "{control:?}: {first:?}");
    }
    let bugs = planted::all().into_iter().map(|bug| {
        let seen = seen(bug.name(), bug.clause(), "TRAVERSE-1", failures(&bug, suite), suite);
        (bug.name().to_owned(), seen)
    });
    let mistakes = LAYERS.iter().flat_map(|layer| layer.mistakes.iter().map(move |mistake| (layer.name, mistake)));
    let mistakes = mistakes.map(|(layer, mistake)| {
        let (name, instead) = (format!("{layer}: {}", mistake.name()), mistake.instead());
        let seen = match instead {
            Instead::Nothing(why) => Ok(format!("{}{why}", table::NO)),
            _ => seen(&name, mistake.clause(), layers::seen_as(instead), with_mistake(instead), suite),
        };
        (name, seen)
    });
    let (seen, wrong): (Vec<_>, Vec<_>) = bugs.chain(mistakes).partition(|(_, seen)| seen.is_ok());
    assert!(wrong.is_empty(), "{wrong:#?}");
    let seen = seen.into_iter().filter_map(|(name, seen)| Some((name, seen.ok()?))).collect();
    table::compare_column("suite", &seen);
}

/// What the table says of a bug; an error where it fails no case of its clause and should, or fails one and should not.
fn seen(
    name: &str,
    clause: &str,
    seen_as: &str,
    (asked, failed): (usize, Vec<(&SuiteCase, Flaw)>),
    suite: &Suite,
) -> Result<String, String> {
    // Clauses that say how, not what, are not seen from outside: what comes of it is.
    let cites = |case: &SuiteCase, clause: &str| case.clauses.iter().any(|it| it == clause);
    let clause = if suite.cases().any(|(_, case)| cites(case, clause)) { clause } else { seen_as };
    let of_clause: Vec<_> = failed.iter().filter(|(case, _)| cites(case, clause)).collect();
    let (failed, count) = (failed.len(), of_clause.len());
    match (of_clause.first(), planted::unseen(name, Seer::Suite)) {
        (Some((case, flaw)), None) => {
            // The sign of a NaN is the compiler's.
            let flaw = flaw.to_string().replace("ffc00000", "7fc00000");
            Ok(format!("{failed} of {asked}, {count} about {clause}; `{}`: {flaw}", case.id))
        }
        (None, Some(why)) => Ok(format!("{}{why}", table::NO)),
        (None, None) => Err(format!("fails {failed} of {asked}, none about {clause}")),
        (Some((case, flaw)), Some(_)) => Err(format!("does show: {}: {flaw}", case.id)),
    }
}

/// The cases that a planted traversal is asked, and those that it fails.
fn failures<'s>(bug: &Planted, suite: &'s Suite) -> (usize, Vec<(&'s SuiteCase, Flaw)>) {
    let (mut asked, mut failed) = (0, Vec::new());
    for (profile, case) in suite.cases() {
        let fits = match (profile.level, profile.profile.as_str()) {
            (Level::Trace, "script" | "tape") => bug.test() == Test::Children,
            (Level::Trace, "node-left") => bug.test() == Test::NodeLeftFirst,
            (Level::Trace, "node-sign") => bug.test() == Test::NodeBySign,
            (Level::Trace | Level::Resume, "disjoint") => bug.test() == Test::Disjoint,
            _ => false,
        };
        let fits = fits && !(bug.restarts() && case.features.contains(&Feature::Changing));
        let Some((features, answer)) = fits.then(|| answer(bug, case)).flatten() else { continue };
        asked += 1;
        let hello = Hello {
            protocol: PROTOCOL,
            name: bug.name().to_owned(),
            version: String::new(),
            profiles: vec![profile.name()],
            features,
            limits: Limits { max_depth: Some(63), ..Limits::default() },
        };
        if let Err(flaw) = judge(case, &hello, &answer) {
            failed.push((case, flaw));
        }
    }
    (asked, failed)
}

/// What a planted traversal shows, as an implementation would say it.
fn answer(bug: &Planted, case: &SuiteCase) -> Option<(Vec<Feature>, Answer)> {
    let (Ask::Trace(walk) | Ask::ResumeDisjoint(walk)) = Ask::of(&case.input).unwrap() else { return None };
    let of_tree = walk.case().unwrap();
    // None of them says that it refuses: it would be right.
    if of_tree.tree.depth() > bug.carries() {
        return None;
    }
    let keys = Keys::of(&of_tree.tree);
    let mut search = Search::new(&of_tree.tree, &of_tree.tape, of_tree.any);
    // On the way down from the root again a visit may be repeated as often as the tree is deep.
    let most = (of_tree.size() + 9) * (of_tree.tree.depth() as usize + 2);
    let (mut seen, mut steps) = (Vec::<State<u64>>::new(), 0);
    bug.run(&of_tree, &mut search, |snapshot| {
        if !snapshot.is_restarting {
            seen.push(*snapshot);
        }
        steps += 1;
        if steps < most { Flow::Continue } else { Flow::Stop }
    });
    if steps >= most {
        // To a runner it is a timeout.
        return Some((vec![Feature::Changing], Answer::Unsupported("no end".to_owned())));
    }
    let slot = |snapshot: &State<u64>| of_tree.tree.slot(snapshot.node);
    let key = |snapshot: &State<u64>| snapshot.key.unwrap_or_else(|| keys.key(slot(snapshot)));
    let mut events = Vec::new();
    for (i, snapshot) in seen.iter().enumerate() {
        let before = i.checked_sub(1).map(|i| &seen[i]);
        let is_child =
            |before: &State<u64>| !before.node.is_leaf() && of_tree.tree.children(before.node).contains(&snapshot.node);
        if let Some(before) = before.filter(|before| !is_child(before)) {
            let levels = i64::from(keys.depth(slot(before))) - i64::from(keys.depth(slot(snapshot)));
            events.push(format!("backtrack {:x} {levels}", key(snapshot)));
        }
        let kind = if snapshot.node.is_leaf() { "leaf" } else { "enter" };
        events.push(format!("{kind} {:x}", key(snapshot)));
    }
    events.push("end".to_owned());
    // One that is taken up goes on as it did.
    if let Some(from) = &walk.key {
        let at = events
            .iter()
            .position(|event| event.split_once(' ').is_some_and(|(kind, key)| kind != "backtrack" && key == from));
        let is_visited = usize::from(walk.next == Some(Start::Backtrack));
        events.drain(..at.map_or(events.len(), |at| at + is_visited));
    }
    let mut fields = BTreeMap::from([("events".to_owned(), serde_json::json!(events))]);
    if walk.cells.is_some() {
        let hit = search.outcome.hit.map(|(t, node)| serde_json::json!({ "t": t, "node": node }));
        fields.insert("hit".to_owned(), serde_json::json!(hit));
    }
    let mut features = vec![Feature::Changing];
    let is_trace = walk.key.is_none() && matches!(case.expect, Expect::Result(_));
    let mut state = |feature: Feature, words: Vec<Option<String>>, whole: bool| {
        if is_trace && whole {
            features.push(feature);
            fields.insert(feature.name().to_owned(), serde_json::json!(words));
        }
    };
    let words = |word: fn(&State<u64>) -> Option<u64>| -> Vec<_> {
        seen.iter().map(|snapshot| word(snapshot).map(|word| format!("{word:x}"))).collect()
    };
    let (trails, counters) = (words(|state| state.trail), words(|state| state.counter));
    let has_register = seen.iter().any(|snapshot| snapshot.register.is_some());
    let whole = |words: &[Option<String>]| words.iter().all(Option::is_some);
    let (has_trails, has_counters) = (whole(&trails), whole(&counters));
    let registers = seen
        .iter()
        .map(|snapshot| snapshot.register.map(|node| format!("{:x}", keys.key::<u64>(of_tree.tree.slot(node)))));
    state(Feature::Registers, registers.collect(), has_register && has_trails);
    state(Feature::Trails, trails, has_trails);
    state(Feature::Counters, counters, has_counters);
    Some((features, Answer::Result(fields.into_iter().collect())))
}
