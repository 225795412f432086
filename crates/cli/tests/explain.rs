//! Traversals recorded step by step, and the pages that show them. (`tests/page` looks at the pages in a browser.)

#[allow(dead_code, reason = "the tests of the command use the rest")]
#[path = "cli/support.rs"]
mod support;

use std::collections::BTreeSet;

use serde_json::Value;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::traverse::{Method, Test};
use stackless_bvh::tree::{Topology, Tree};
use stackless_bvh::wide::Method as WideMethod;
use stackless_check::{Case, CaseOptions, WideCase};
use stackless_explain::{self as explain, By, DEEPEST, Entry, ExplainError, MOST_NODES, Recording, Step, USUAL, wide};
use stackless_suite::{Ask, author};
use support::{Folder, stackless};

fn spec(name: &str) -> String {
    let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("spec").join(name);
    std::fs::read_to_string(path).unwrap()
}

/// The lines of a block `as-run NAME` of the specification.
fn as_run(name: &str) -> Vec<String> {
    let text = spec("traversal.md");
    let block = text.split(&format!("```as-run {name}\n")).nth(1).unwrap().split("```").next().unwrap();
    block.lines().map(str::to_owned).collect()
}

/// The data of a page.
fn data(html: &str) -> Value {
    let start = html.split(r#"<script type="application/json" id="data">"#).nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

fn key(tree: &Tree, slot: u32) -> u128 {
    stackless_bvh::tree::Keys::of(tree).key(slot as usize)
}

/// [TRAIL-3] [TRAIL-4] [HASHED-1]
#[test]
fn the_papers_example_goes_from_22_to_3_by_the_table() {
    let case = explain::example();
    let recording = explain::record(&case, Method::Hashed).unwrap();
    let at = recording.steps.iter().position(|step| step.key.as_deref() == Some("10110")).unwrap();
    let (step, after) = (&recording.steps[at], &recording.steps[at + 1]);
    let next = step.next.as_ref().unwrap();
    let [trail, next_key, next_trail] = [&step.trail, &after.key, &after.trail].map(|word| word.as_deref().unwrap());
    let levels = next.levels.unwrap();
    let line = format!("key 10110 trail {trail} -> levels {levels} key {next_key} trail {next_trail}");
    assert_eq!(as_run("backtrack"), [line]);
    assert_eq!((key(&case.tree, next.node), next.by, step.register), (3, By::Table, None));
    assert_eq!(next.lookup.as_ref().map(|lookup| (lookup.number.as_str(), lookup.node)), Some(("3", Some(next.node))));
    // Its uncle is 10 and its grand uncle 4, and neither is postponed.
    let links: Vec<_> = step.links.iter().map(|link| key(&case.tree, link.unwrap())).collect();
    assert_eq!((links, step.stack.as_slice()), (vec![10, 4], &[next.node][..]));
}

/// Each line of the walk in spec/traversal.md, from what is recorded. [TRAIL-2] [TRAIL-6] [SPARSE-1] [REGISTER-1]
#[test]
fn the_walk_of_the_specification_is_recorded_as_it_stands_there() {
    let mut case = explain::example();
    let mut cells = case.tape.cells().to_vec();
    cells[8].right_first = false;
    case.tape = Tape::from_cells(&case.tree, cells).unwrap();
    let mut text = Vec::new();
    for method in [Method::Hashed, Method::Sparse] {
        text.push(method.name().to_owned());
        text.extend(explain::record(&case, method).unwrap().steps.iter().map(|step| line(&case, step)));
        text.push("end".to_owned());
    }
    assert_eq!(text, as_run("walk"));
}

/// A visit as spec/traversal.md writes it.
fn line(case: &Case, step: &Step) -> String {
    let kind = if step.decision.is_some() { "enter" } else { "leaf" };
    let mut parts = vec![format!("{kind:5} {:<2}", key(&case.tree, step.node))];
    let words = [("key", &step.key), ("trail", &step.trail), ("counter", &step.counter)];
    parts.extend(words.iter().filter_map(|(name, word)| Some(format!("{name} {:5}", word.as_ref()?))));
    parts.extend(step.register.map(|register| format!("register {}", key(&case.tree, register))));
    parts.extend(step.decision.as_ref().map(|decision| {
        let decision = decision.replace("left", "Left").replace("right", "Right");
        format!("-> {}", decision.replace("the ", "").replace(" child", ""))
    }));
    parts.join("  ").trim_end().to_owned()
}

/// A page shows the specification's text of each clause. `UPDATE=1` writes the copy.
#[test]
fn clauses_are_those_of_the_specification() {
    let files = ["hash.md", "state.md", "traversal.md", "wide.md"];
    let paragraphs = files.map(|file| (file, spec(file)));
    let of_file =
        |(file, text): &(&str, String)| text.split("\n\n").filter_map(|it| clause(file, it)).collect::<Vec<_>>();
    let expected: serde_json::Map<String, Value> = paragraphs.iter().flat_map(of_file).collect();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../explain/src/clauses.json");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, serde_json::to_string_pretty(&expected).unwrap() + "\n").unwrap();
    }
    let copy: serde_json::Map<String, Value> = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for (id, clause) in &expected {
        assert_eq!(copy.get(id), Some(clause), "{id}: UPDATE=1 makes the copy anew");
    }
    assert_eq!(copy.len(), expected.len());
}

fn clause(file: &str, paragraph: &str) -> Option<(String, Value)> {
    let (id, rest) = paragraph.trim().strip_prefix("**[")?.split_once("] ")?;
    let (title, text) = rest.split_once(".** ")?;
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    Some((id.to_owned(), serde_json::json!({ "title": title, "text": text, "file": format!("spec/{file}") })))
}

/// Cases of all kinds: random ones, and the walks of the suite.
fn cases() -> Vec<Case> {
    let random = (0..150).map(|seed| Case::random(seed, CaseOptions::default()));
    let suite = author::suite();
    let asks = suite.cases().step_by(17).filter_map(|(_, case)| {
        serde_json::from_value(Value::Object(case.input.clone())).ok().and_then(|ask| match ask {
            Ask::Trace(walk) => walk.case().ok(),
            _ => None,
        })
    });
    random.chain(asks).filter(|case| case.tree.depth() <= DEEPEST && case.size() <= MOST_NODES).collect()
}

/// [TRAVERSE-1] [CONF-3]
#[test]
fn every_traversal_is_recorded_as_its_oracle_goes() {
    let clauses: BTreeSet<String> = ["traversal.md", "state.md", "hash.md"]
        .iter()
        .flat_map(|name| spec(name).lines().map(str::to_owned).collect::<Vec<_>>())
        .filter_map(|line| Some(line.strip_prefix("**[")?.split(']').next()?.to_owned()))
        .collect();
    let (mut seen, mut refused) = (BTreeSet::new(), BTreeSet::new());
    for case in cases() {
        for method in Method::ALL {
            match explain::record(&case, method) {
                Ok(recording) => look(&case, method, &recording, &clauses, &mut seen),
                Err(ExplainError::Unsupported { method, .. } | ExplainError::Changing { method }) => {
                    refused.insert(method.name());
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
    assert_eq!(seen.len(), 10, "not all sources are seen: {seen:?}");
    assert_eq!(
        refused.into_iter().collect::<Vec<_>>(),
        ["complete", "laine-0", "laine-1", "laine-2", "laine-4", "laine-8"]
    );
}

fn look(case: &Case, method: Method, recording: &Recording, clauses: &BTreeSet<String>, seen: &mut BTreeSet<String>) {
    let steps = &recording.steps;
    assert!(clauses.contains(recording.clause), "{}", recording.clause);
    for (step, after) in steps.iter().zip(steps.iter().skip(1).map(Some).chain([None])) {
        let unknown: Vec<_> = step.clauses.iter().filter(|&&clause| !clauses.contains(clause)).collect();
        assert!(unknown.is_empty() && !step.clauses.is_empty(), "{method}: {unknown:?}");
        assert_eq!(step.next.as_ref().map(|next| next.node), after.map(|after| after.node));
        let (Some(next), Some(after)) = (&step.next, after) else { continue };
        seen.insert(format!("{:?}", next.by));
        // The node that was postponed last comes next; pruning removes some nodes.
        if next.by != By::Child && method.test() != Test::Distance && !step.hit && !step.restart {
            assert_eq!(
                step.stack.last(),
                Some(if after.restart { step.stack.last().unwrap() } else { &next.node }),
                "{method}"
            );
        }
        // Key and trail determine the next key.
        if let (Some(levels), Some(key), Some(trail), false) = (next.levels, &step.key, &step.trail, step.hit) {
            let [key, trail] = [key, trail].map(|word| u128::from_str_radix(word, 2).unwrap());
            assert_eq!(
                (levels, key >> levels ^ 1),
                (trail.trailing_zeros(), self::key(&case.tree, next.node)),
                "{method}"
            );
        }
        let Some(lookup) = &next.lookup else { continue };
        let table = recording.table.as_ref().unwrap();
        let number: u64 = lookup.number.parse().unwrap();
        let (d, h) = (table.displacements as u64, table.cells as u64);
        assert_eq!((next.by, lookup.bucket as u64, lookup.node), (By::Table, number % d, Some(next.node)));
        if let Entry::Displacement(displacement) = lookup.entry {
            assert_eq!(lookup.cell.map(|cell| cell as u64), Some((number % h + u64::from(displacement)) % h));
        }
    }
}

#[test]
fn a_page_is_one_file_and_no_text_breaks_out_of_it() {
    let case = explain::example();
    let plain = explain::page("plain", &case, &USUAL).unwrap().to_html().unwrap();
    let title = "</script><script>alert(1)</script> <!-- &amp; \u{2028} \"";
    let html = explain::page(title, &case, &USUAL).unwrap().to_html().unwrap();
    assert_eq!(html.matches('<').count(), plain.matches('<').count());
    assert_eq!(data(&html)["title"], title);
    let links: Vec<_> = html.match_indices("://").map(|(at, _)| html[at - 4..].split('"').next().unwrap()).collect();
    assert_eq!(links, ["http://www.w3.org/2000/svg"], "something is asked of the network");
    assert_eq!(explain::page("plain", &case, &USUAL).unwrap().to_html().unwrap(), plain);
    let data = data(&plain);
    let names: Vec<_> = data["methods"].as_array().unwrap().iter().map(|it| it["method"].as_str().unwrap()).collect();
    assert_eq!(names, USUAL.map(Method::name));
    assert_eq!((data["names"][11].as_str(), data["keys"][11].as_str()), (Some("22"), Some("10110")));
    let step = &data["methods"][0]["steps"][5];
    let named = step["clauses"].as_array().unwrap().iter().chain([&data["methods"][0]["clause"]]);
    for id in named.map(|id| id.as_str().unwrap()) {
        assert!(data["clauses"][id]["text"].as_str().is_some_and(|text| !text.is_empty()), "{id}");
    }
}

/// [DEPTH-2]
#[test]
fn what_is_too_large_or_does_not_run_is_refused() {
    let chain = |depth: u32| {
        let children: Vec<_> =
            (0..=2 * depth).map(|i| (i % 2 == 0 && i < 2 * depth).then_some([i + 2, i + 1])).collect();
        let tree = Tree::new(&children).unwrap();
        let tape = Tape::from_cells(&tree, vec![Cell::default(); children.len()]).unwrap();
        Case { tree, tape, any: false, octant: 0 }
    };
    for method in Method::ALL.into_iter().filter(|&method| method != Method::Complete) {
        assert!(explain::record(&chain(DEEPEST), method).is_ok(), "{method}");
    }
    let error = explain::record(&chain(DEEPEST + 1), Method::Hashed).unwrap_err();
    assert_eq!(error.to_string(), "the tree is 127 edges deep, and a page shows at most 126");
    let error = explain::page("a", &chain(1000), &[Method::Stack]).unwrap_err();
    assert_eq!(error.to_string(), "the tree has 2001 nodes, and a page shows at most 2000");
    let example = explain::example();
    assert!(matches!(explain::page("a", &example, &[]), Err(ExplainError::NoMethod)));
    let complete = explain::page("a", &example, &[Method::Complete]);
    assert!(matches!(complete, Err(ExplainError::Unsupported { method: Method::Complete, .. })));
    let html = explain::page("a", &example, &[Method::Complete, Method::Stack]).unwrap().to_html().unwrap();
    let left_out = data(&html)["left_out"][0].as_str().unwrap().to_owned();
    assert!(left_out.starts_with("complete: "), "{left_out}");
}

/// Every traversal of wide trees, over random trees, and the suite's walks.
///
/// [WIDE-7] [WIDE-9] [WIDE-11] [WIDE-16] [WIDE-17] [WIDE-18]
#[test]
fn traversals_of_wide_trees_are_recorded_as_their_oracle_goes() {
    let clauses: BTreeSet<String> = spec("wide.md")
        .lines()
        .filter_map(|line| Some(line.strip_prefix("**[")?.split(']').next()?.to_owned()))
        .collect();
    let mut seen = BTreeSet::new();
    for seed in 0..300 {
        look_wide(&wide::random::<2>(seed), &clauses, &mut seen);
        look_wide(&wide::random::<4>(seed), &clauses, &mut seen);
        look_wide(&wide::random::<8>(seed), &clauses, &mut seen);
    }
    assert_eq!(seen.len(), 7, "not all sources are seen: {seen:?}");
}

fn look_wide<const A: usize>(case: &WideCase<A>, clauses: &BTreeSet<String>, seen: &mut BTreeSet<String>) {
    for method in WideMethod::ALL {
        let recorded = if case.is_sorted {
            wide::record(&case.tree, &case.search::<true>(), method)
        } else {
            wide::record(&case.tree, &case.search::<false>(), method)
        };
        let recording = match recorded {
            Ok(recording) => recording,
            Err(ExplainError::UnsupportedWide { .. } | ExplainError::TooDeep { .. } | ExplainError::Falling { .. }) => {
                continue;
            }
            Err(error) => panic!("{error}"),
        };
        let steps = &recording.steps;
        let visits: Vec<u32> = steps.iter().filter(|step| !step.restart).map(|step| step.node).collect();
        assert_eq!(visits, case.expected().iter().map(|node| node.index() as u32).collect::<Vec<_>>(), "{method}");
        assert!(clauses.contains(recording.clause), "{}", recording.clause);
        for (step, after) in steps.iter().zip(steps.iter().skip(1).map(Some).chain([None])) {
            assert!(step.clauses.iter().all(|&clause| clauses.contains(clause)), "{method}: {:?}", step.clauses);
            assert_eq!(step.next.as_ref().map(|next| next.node), after.map(|after| after.node));
            let Some(next) = &step.next else { continue };
            seen.insert(format!("{:?}", next.by));
            // The next child is the first child before the end, or a child that the last hit has put beyond the end.
            let waits = step.stack.iter().rev().find(|node| !step.beyond.contains(node));
            if next.by != By::Child && !step.hit && !step.restart && next.by != By::Restart {
                assert_eq!(waits, Some(&next.node), "{method}: {step:?}");
            }
            // The deepest nonempty set determines the number of levels, if none of its children is beyond the end.
            if let (Some(levels), Some(trail), true) =
                (next.levels, step.trail.as_ref().or(step.sets.as_ref()), step.beyond.is_empty() && !step.hit)
            {
                let zeros = trail.len() - trail.trim_end_matches('0').len();
                assert_eq!(levels as usize, zeros / A, "{method}: {step:?}");
            }
            if let Some(lookup) = &next.lookup {
                let table = recording.table.as_ref().unwrap();
                assert_eq!(
                    (next.by, lookup.bucket as u64),
                    (By::Table, lookup.number.parse::<u64>().unwrap() % table.displacements as u64)
                );
                assert!(lookup.node.is_some());
            }
        }
    }
}

/// [WIDE-10] [WIDE-11] [WIDE-15]
#[test]
fn the_wide_example_goes_from_1252_to_10_by_each_way() {
    let case = wide::example();
    let ways = [
        (WideMethod::Recorded, By::Ancestor),
        (WideMethod::Hashed, By::Table),
        (WideMethod::Trail, By::Climb),
        (WideMethod::Stack, By::Stack),
        (WideMethod::Restart0, By::Restart),
    ];
    for (method, by) in ways {
        let recording = wide::record(&case.tree, &case.search::<true>(), method).unwrap();
        let data = data(&wide::page("x", &case.tree, &case.search::<true>(), &[method]).unwrap().to_html().unwrap());
        let name = |node: u32| data["names"][node as usize].as_str().unwrap().to_owned();
        let at = recording.steps.iter().rposition(|step| name(step.node).len() == 4).unwrap();
        let next = recording.steps[at].next.as_ref().unwrap();
        assert_eq!((name(recording.steps[at].node).as_str(), next.by), ("1252", by), "{method}");
        if by != By::Restart {
            assert_eq!((name(next.node).as_str(), next.levels), ("10", Some(2)), "{method}");
        }
    }
}

#[test]
fn the_command_writes_pages() {
    let folder = Folder::new();
    let file = folder.path("a.html");
    let said = stackless("explain -o", &[&file]).passes().stdout;
    assert!(said.contains("13 nodes"), "{said}");
    let html = std::fs::read_to_string(&file).unwrap();
    assert_eq!(stackless("-q explain -o -", &[]).passes().stdout, html);
    assert_eq!(data(&html)["title"], "The papers' example: from key 22 to key 3");

    let suite = stackless("-q explain --suite-case trace/script/three-neither -o -", &[]).passes().stdout;
    assert_eq!(data(&suite)["children"].as_array().unwrap().len(), 3);
    let text = r#"{"children": [[1, 2], null, null], "cells": [{}, {}, {}], "methods": ["uncle"]}"#;
    let replay = folder.file("case.json", text);
    let case = stackless("-q explain -o - --case", &[&replay]).passes().stdout;
    assert_eq!(data(&case)["methods"][0]["method"], "uncle");
    let case = stackless("-q explain -o - --method afra --case", &[&replay]).passes().stdout;
    assert_eq!(data(&case)["methods"].as_array().unwrap().iter().map(|it| &it["method"]).collect::<Vec<_>>(), ["afra"]);
    let pixel = stackless("-q explain stadium --pixel 256,220 --method hashed -o -", &[]).passes().stdout;
    assert_eq!(data(&pixel)["title"], "stadium, pixel 256,220");
    assert!(data(&pixel)["methods"][0]["steps"].as_array().unwrap().iter().any(|step| step["hit"] == true));
    let wide = |args: &str| data(&stackless(&format!("-q explain {args} -o -"), &[]).passes().stdout);
    let example = wide("--wide 8");
    assert_eq!((&example["methods"][0]["method"], &example["base"]), (&"wide-record".into(), &8.into()));
    let suite = wide("--suite-case trace/wide/last-2");
    assert_eq!(wide("--suite-case trace/wide/unsorted-hit-4")["trailBits"], 4);
    assert_eq!((&suite["methods"][0]["method"], &suite["base"]), (&"wide-record".into(), &10.into()));
    let pixel = wide("stadium --pixel 256,220 --method wide-record");
    assert!(pixel["methods"][0]["steps"].as_array().unwrap().iter().any(|step| step["hit"] == true));
    assert_eq!(folder.names(), ["a.html", "case.json"]);
}

#[test]
fn the_command_refuses_what_it_cannot_show() {
    let folder = Folder::new();
    stackless("explain -o", &[&folder.path("no/such/folder.html")]).fails_naming(&["folder.html"]);
    stackless("-q explain -o - --case", &[&folder.path("missing.json")]).fails_naming(&["missing.json"]);
    let bad = folder.file("bad.json", r#"{"children": [[1, 9], null, null], "cells": [{}, {}, {}]}"#);
    stackless("-q explain -o - --case", &[&bad]).fails_naming(&["bad.json: ", "node 0: child 9"]);
    for (args, what) in [
        ("--suite-case nosuch", "case 'nosuch': not in the suite"),
        ("--suite-case key/u128/child-left-root", "expected a case of the level trace"),
        ("--suite-case trace/script/chain-left-200-two-1", "200 edges deep"),
        ("--method complete", "complete: "),
        ("--method wide-trail,hashed", "do not run on wide trees"),
        ("--wide 4", "the example have 8 children"),
        ("--method wide-trail --suite-case trace/script/three-neither", "its tree is binary"),
        ("soup --pixel 3,512", "pixel 3,512 is outside the image of 512x512 pixels"),
    ] {
        stackless(&format!("explain {args} -o -"), &[]).fails_naming(&[what]);
    }
    stackless("-q explain --method wide-trail -o - --case", &[&bad]).fails_naming(&["--case: its tree is binary"]);
    for args in ["explain", "explain --case b --suite-case a -o -", "explain --method nosuch -o -"] {
        assert_eq!(stackless(args, &[]).code, Some(2), "{args}");
    }
    assert_eq!(folder.names(), ["bad.json"]);
}
