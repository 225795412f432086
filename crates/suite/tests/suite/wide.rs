//! Mistakes in traversals of wide trees, as implementations.

use serde_json::{Map, json};
use stackless_bvh::wide::{Tree, Unfit};
use stackless_check::planted::WidePlanted;
use stackless_suite::{
    Answer, Ask, Expect, Flaw, Hello, Limits, PROTOCOL, Suite, SuiteCase, WideLimits, WideWalk, judge, wide_events,
};

/// The cases that a planted traversal is asked, and those that it fails.
pub(crate) fn failures(bug: WidePlanted, suite: &Suite) -> (usize, Vec<(&SuiteCase, Flaw)>) {
    let limit = |slots| Some(bug.carries(slots));
    let hello = Hello {
        protocol: PROTOCOL,
        name: format!("{bug:?}"),
        version: String::new(),
        profiles: vec!["trace/wide".to_owned()],
        features: Vec::new(),
        limits: Limits {
            wide: Some(WideLimits { of_2: limit(2), of_4: limit(4), of_8: limit(8) }),
            ..Limits::default()
        },
    };
    let asked: Vec<_> = suite.cases().filter(|(profile, case)| hello.asks_for(profile, case)).collect();
    let failed = asked.iter().filter_map(|(_, case)| Some((*case, judge(case, &hello, &answer(bug, case)).err()?)));
    (asked.len(), failed.collect())
}

fn answer(bug: WidePlanted, case: &SuiteCase) -> Answer {
    let Ok(Ask::TraceWide(walk)) = Ask::of(&case.input) else { panic!("{}", case.id) };
    let Expect::Result(expected) = &case.expect else { panic!("{}", case.id) };
    let events = expected["events"].as_array().map_or(0, Vec::len);
    match (walk.slots, walk.is_sorted()) {
        (2, true) => walked::<2, true>(bug, &walk, events),
        (2, false) => walked::<2, false>(bug, &walk, events),
        (4, true) => walked::<4, true>(bug, &walk, events),
        (4, false) => walked::<4, false>(bug, &walk, events),
        (8, true) => walked::<8, true>(bug, &walk, events),
        (8, false) => walked::<8, false>(bug, &walk, events),
        _ => panic!("{}", case.id),
    }
}

/// What it visits, and the best hit of a search that visits this.
fn walked<const A: usize, const SORTED: bool>(bug: WidePlanted, walk: &WideWalk, events: usize) -> Answer {
    let tree: Tree<A> = walk.tree().unwrap();
    let begun = || walk.search::<A, SORTED>().unwrap();
    let visits = match bug.visits(&tree, begun, events) {
        Ok(Some(visits)) => visits,
        // To a runner it is a timeout.
        Ok(None) => return Answer::Unsupported("no end".to_owned()),
        Err(Unfit::TooDeep(_)) => return Answer::Reject("too-deep".to_owned()),
        Err(unfit) => return Answer::Unsupported(unfit.to_string()),
    };
    let mut fields = Map::from_iter([("events".to_owned(), json!(wide_events(&tree, None, &visits)))]);
    if walk.hits.is_some() {
        let mut search = begun();
        for leaf in visits.iter().filter(|node| node.is_leaf()) {
            stackless_bvh::wide::Search::leaf(&mut search, *leaf);
        }
        fields.insert("hit".to_owned(), json!(search.best()));
    }
    Answer::Result(fields)
}
