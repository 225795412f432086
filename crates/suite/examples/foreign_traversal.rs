//! A custom traversal, checked by the suite: it stores key and trail, and finds the next node from the root.
//!
//! `cargo run --release -p stackless-suite --example foreign_traversal`. To make it a program for `stackless conform`,
//! let `main` call `suite::serve(&mut Mine, stdin, stdout)`.

use serde_json::{Map, Value, json};
use stackless_suite::{Answer, Ask, Hello, Implementation, Level, Limits, PROTOCOL, author, judge};

/// The implementation to check.
struct Mine;

impl Implementation for Mine {
    fn hello(&self) -> Hello {
        Hello {
            protocol: PROTOCOL,
            name: "mine".to_owned(),
            version: "0".to_owned(),
            profiles: vec!["trace/script".to_owned()],
            features: Vec::new(),
            limits: Limits { max_depth: Some(63), ..Limits::default() },
        }
    }

    fn answer(&mut self, _: Level, _: &str, input: &Map<String, Value>) -> Answer {
        let Ok(Ask::Trace(walk)) = Ask::of(input) else { return Answer::Unsupported("only trace/script".to_owned()) };
        let decisions: Vec<char> = walk.script.unwrap_or_default().chars().collect();
        match traverse(&walk.children, &decisions) {
            Some(events) => Answer::Result([("events".to_owned(), json!(events))].into_iter().collect()),
            None => Answer::Reject("too-deep".to_owned()),
        }
    }
}

/// The traversal under test, with its own tree and loop. Returns `None` if the tree is too deep for its word.
fn traverse(children: &[Option<[u32; 2]>], decisions: &[char]) -> Option<Vec<String>> {
    if depth(children) > 63 {
        return None;
    }
    let mut events = Vec::new();
    let (mut key, mut trail, mut node) = (1_u64, 0_u64, 0);
    loop {
        let (wanted, pair) = (decisions[node], children[node]);
        events.push(format!("{} {key:x}", if pair.is_some() { "enter" } else { "leaf" }));
        if let Some(pair) = pair.filter(|_| wanted != 'n') {
            let (both, right) = (matches!(wanted, 'L' | 'R'), matches!(wanted, 'r' | 'R'));
            trail = trail << 1 | u64::from(both);
            key = key << 1 | u64::from(right);
            node = pair[usize::from(right)] as usize;
        } else if wanted == '!' || trail == 0 {
            events.push("end".to_owned());
            return Some(events);
        } else {
            let up = trail.trailing_zeros();
            (key, trail) = (key >> up ^ 1, trail >> up ^ 1);
            node = walk_down(children, key);
            events.push(format!("backtrack {key:x} {up}"));
        }
    }
}

/// Returns the node with a key, found from the root down.
fn walk_down(children: &[Option<[u32; 2]>], key: u64) -> usize {
    let step = |node: usize, level: u32| children[node].map_or(node, |pair| pair[(key >> level & 1) as usize] as usize);
    (0..key.ilog2()).rev().fold(0, step)
}

/// Returns the number of edges on the longest path.
fn depth(children: &[Option<[u32; 2]>]) -> u32 {
    let (mut deepest, mut pending) = (0, vec![(0, 0)]);
    while let Some((node, depth)) = pending.pop() {
        deepest = deepest.max(depth);
        pending.extend(children[node].into_iter().flatten().map(|child| (child as usize, depth + 1)));
    }
    deepest
}

/// Runs all cases of the level and profile of `Mine`, and reports the failed ones.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hello = Mine.hello();
    let suite = author::suite();
    let (mut asked, mut failed) = (0, 0);
    for (profile, case) in suite.cases().filter(|(profile, case)| hello.asks_for(profile, case)) {
        asked += 1;
        if let Err(flaw) = judge(case, &hello, &Mine.answer(profile.level, &profile.profile, &case.input)) {
            failed += 1;
            println!("{}: {flaw}", case.id);
        }
    }
    println!("{asked} cases, {failed} failed");
    if failed > 0 || asked == 0 { Err("mine is wrong".into()) } else { Ok(()) }
}
