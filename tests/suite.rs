//! The conformance suite: its files are as made, this library conforms, and implementations with bugs do not.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use stackless_bvh::check::planted::{self, Planted, Snapshot};
use stackless_bvh::event::State;
use stackless_bvh::generate::Search;
use stackless_bvh::order::Flow;
use stackless_bvh::suite::{
    Answer, Ask, Case, Expect, Feature, Flaw, Hello, Implementation, Level, Library, Limits, PROTOCOL, Suite, author,
    judge,
};
use stackless_bvh::traverse::{Method, Test, WordName};
use stackless_bvh::tree::{Keys, Topology};

#[path = "suite/runner.rs"]
mod runner;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/suite")
}

/// To make the files anew: `UPDATE=1 cargo test --test suite`.
#[test]
fn the_files_are_as_made() {
    let suite = author::suite();
    for (path, text) in suite.files() {
        let path = root().join(path);
        if std::env::var_os("UPDATE").is_some() {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, &text).unwrap();
        }
        assert!(std::fs::read_to_string(&path).unwrap_or_default() == text, "{} is not what is made", path.display());
    }
    assert_eq!(Suite::load(&root()).unwrap(), suite);
}

/// What the suite promises to those who read it.
#[test]
fn the_suite_is_as_promised() {
    let suite = author::suite();
    let count = suite.cases().count();
    assert!(count >= 1500, "{count} cases");
    let bytes: usize = suite.files().iter().map(|(_, text)| text.len()).sum();
    assert!(bytes <= 20 << 20, "{bytes} bytes");
    for (_, case) in suite.cases() {
        let Case { id, clauses, why, input, .. } = case;
        assert!(!clauses.is_empty() && !why.is_empty() && !why.contains('\n'), "{id}");
        assert!(Ask::of(input).is_ok(), "{id}");
    }
}

/// Every traversal in every word. `[CONF-1]` `[CONF-2]` `[CONF-3]`
#[test]
fn this_library_conforms() {
    let suite = author::suite();
    let each = Method::ALL.iter().flat_map(|&method| WordName::ALL.map(|word| (Some(method), Some(word))));
    for (method, word) in each.chain([(None, None)]) {
        // Laine's trail is aligned to the highest bit of a word.
        if method.is_some_and(Method::restarts) && word == Some(WordName::Grow) {
            continue;
        }
        let mut library = Library::new(method, word);
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

/// Bugs that do not show in events, hits and states, and why.
const UNSEEN: [(&str, &str); 2] = [
    ("AsksTwice", "the second answer is the first one"),
    ("a detour that passes for a restart", "visits on the way down again are not told"),
];

/// Each planted traversal, as an implementation, fails a case of the clause that it breaks. `[CONF-4]`
#[test]
fn every_planted_bug_fails_a_case_of_its_clause() {
    let suite = author::suite();
    let mut table = "# Planted bugs, by the conformance suite\n\nHow many cases each fails of those that it is asked, how many of them are about the \
         clause that it breaks, and the first. Made by `UPDATE=1 cargo test --test suite`, and compared by that test.\n\n\
         | bug | breaks | asked | failed | of its clause | first |\n|---|---|---:|---:|---:|---|\n"
        .to_owned();
    for control in planted::controls() {
        let (_, failed) = failures(&control, &suite);
        assert_eq!(failed, [], "{control:?}");
    }
    for bug in planted::all() {
        let (asked, failed) = failures(&bug, &suite);
        // Clauses that say how, not what, are not seen from outside: the whole trace is.
        let is_cited = suite.cases().any(|(_, case)| case.clauses.iter().any(|clause| clause == bug.clause()));
        let clause = if is_cited { bug.clause() } else { "TRAVERSE-1" };
        let of_clause: Vec<_> = failed.iter().filter(|(case, _)| case.clauses.iter().any(|it| it == clause)).collect();
        let unseen = UNSEEN.iter().find(|(name, _)| *name == bug.name());
        assert_eq!(
            of_clause.is_empty(),
            unseen.is_some(),
            "{bug:?}: {} failed of {asked}, {} about {clause}",
            failed.len(),
            of_clause.len()
        );
        let first = match (of_clause.first(), unseen) {
            (Some((case, flaw)), _) => format!("`{}`: {flaw}", case.id),
            (None, unseen) => format!("cannot show: {}", unseen.map_or("", |(_, why)| why)),
        };
        let breaks = if is_cited { clause.to_owned() } else { format!("{} ({clause})", bug.clause()) };
        writeln!(table, "| {} | {breaks} | {asked} | {} | {} | {first} |", bug.name(), failed.len(), of_clause.len())
            .unwrap();
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/PLANTED-SUITE.md");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&file, &table).unwrap();
    }
    assert!(
        std::fs::read_to_string(&file).unwrap_or_default() == table,
        "tests/PLANTED-SUITE.md is not what is seen:\n{table}"
    );
}

/// The cases that a planted traversal is asked, and those that it fails.
fn failures<'s>(bug: &Planted, suite: &'s Suite) -> (usize, Vec<(&'s Case, Flaw)>) {
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
            limits: Limits::default(),
        };
        if let Err(flaw) = judge(case, &hello, &answer) {
            failed.push((case, flaw));
        }
    }
    (asked, failed)
}

/// What a planted traversal shows, as an implementation would say it.
fn answer(bug: &Planted, case: &Case) -> Option<(Vec<Feature>, Answer)> {
    let (Ask::Trace(walk) | Ask::ResumeDisjoint(walk)) = Ask::of(&case.input).unwrap() else { return None };
    let of_tree = walk.case().unwrap();
    // Words of 64 bits, and none of them refuses.
    if of_tree.tree.depth() > 62 {
        return None;
    }
    let keys = Keys::of(&of_tree.tree);
    let mut search = Search::new(&of_tree.tree, &of_tree.tape, of_tree.any);
    // On the way down from the root again a visit may be repeated as often as the tree is deep.
    let most = (of_tree.size() + 9) * (of_tree.tree.depth() as usize + 2);
    let (mut seen, mut steps) = (Vec::<Snapshot>::new(), 0);
    bug.run(&of_tree, &mut search, |snapshot| {
        if !snapshot.is_restarting() {
            seen.push(*snapshot);
        }
        steps += 1;
        if steps < most { Flow::Continue } else { Flow::Stop }
    });
    if steps >= most {
        // To a runner it is a timeout.
        return Some((vec![Feature::Changing], Answer::Unsupported("no end".to_owned())));
    }
    let slot = |snapshot: &Snapshot| of_tree.tree.slot(snapshot.node());
    let key = |snapshot: &Snapshot| snapshot.key().unwrap_or_else(|| keys.key(slot(snapshot)));
    let mut events = Vec::new();
    for (i, snapshot) in seen.iter().enumerate() {
        let before = i.checked_sub(1).map(|i| &seen[i]);
        let is_child = |before: &Snapshot| {
            !before.node().is_leaf() && of_tree.tree.children(before.node()).contains(&snapshot.node())
        };
        if let Some(before) = before.filter(|before| !is_child(before)) {
            let levels = i64::from(keys.depth(slot(before))) - i64::from(keys.depth(slot(snapshot)));
            events.push(format!("backtrack {:x} {levels}", key(snapshot)));
        }
        let kind = if snapshot.node().is_leaf() { "leaf" } else { "enter" };
        events.push(format!("{kind} {:x}", key(snapshot)));
    }
    events.push("end".to_owned());
    // One that is taken up goes on as it did.
    if let Some(from) = &walk.key {
        let at = events
            .iter()
            .position(|event| event.split_once(' ').is_some_and(|(kind, key)| kind != "backtrack" && key == from));
        events.drain(..at.unwrap_or(events.len()));
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
    let words = |word: fn(&Snapshot) -> Option<u64>| -> Vec<_> {
        seen.iter().map(|snapshot| word(snapshot).map(|word| format!("{word:x}"))).collect()
    };
    let (trails, counters) = (words(State::trail), words(State::counter));
    let has_register = seen.iter().any(|snapshot| snapshot.register().is_some());
    let whole = |words: &[Option<String>]| words.iter().all(Option::is_some);
    let (has_trails, has_counters) = (whole(&trails), whole(&counters));
    let registers = seen
        .iter()
        .map(|snapshot| snapshot.register().map(|node| format!("{:x}", keys.key::<u64>(of_tree.tree.slot(node)))));
    state(Feature::Registers, registers.collect(), has_register && has_trails);
    state(Feature::Trails, trails, has_trails);
    state(Feature::Counters, counters, has_counters);
    Some((features, Answer::Result(fields.into_iter().collect())))
}
