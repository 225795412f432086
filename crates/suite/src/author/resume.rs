//! Level `resume`.

use serde_json::json;

use super::reference::{Reference, Rule, Search};
use super::trees::{Scene, random, random_script};
use super::{Author, result};
use crate::ask::Walk;
use crate::bits::Bits;
use crate::{Ask, Level, Profile, Start};
use stackless_bvh::generate::Kind;

pub(super) fn profiles() -> Vec<Profile> {
    vec![states(), disjoint(), keys(), invalid()]
}

/// Before a visit, or after it where the node is a leaf: the events that are left follow from the number of those
/// before.
pub(super) fn moments(
    visits: impl Iterator<Item = u32>,
    is_leaf: impl Fn(u32) -> bool,
    count: usize,
) -> Vec<(usize, Start)> {
    let all: Vec<_> = (0..)
        .zip(visits)
        .flat_map(|(i, node)| [(i, node, Start::Visit), (i, node, Start::Backtrack)])
        .filter(|&(_, node, next)| next == Start::Visit || is_leaf(node))
        .map(|(i, _, next)| (i, next))
        .collect();
    let step = all.len().div_ceil(count).max(1);
    all.into_iter().step_by(step).collect()
}

fn nodes_of(run: &Reference<'_>) -> impl Iterator<Item = u32> {
    run.visits.iter().map(|visit| visit.node)
}

fn word(start: Start) -> &'static str {
    if start == Start::Visit { "visit" } else { "backtrack" }
}

fn states() -> Profile {
    let mut author = Author::new(Level::Resume, "state");
    for seed in 0..36 {
        let (children, text) = random_script(3000 + seed, 3 + seed as u32 / 2, false);
        let run = Reference::run(&children, Search::Script(text.as_bytes()));
        for (i, next) in moments(nodes_of(&run), |node| children[node as usize].is_none(), 5) {
            let visit = &run.visits[i];
            let left = &run.events[visit.events + usize::from(next == Start::Backtrack)..];
            let why = if visit.trail.0.last() == Some(&true) {
                "The sibling is postponed: no record names it, the register has to be located."
            } else {
                "Key and trail are enough to go on."
            };
            let ask = Ask::Resume(Walk {
                children: children.clone(),
                script: Some(text.clone()),
                key: Some(visit.key.hex()),
                trail: Some(visit.trail.hex()),
                next: Some(next),
                ..Walk::default()
            });
            let name = format!("random-{seed}-{}-{i}", word(next));
            author.case(&name, &["PAUSE-1", "PAUSE-2", "PAUSE-3"], why, &ask, result([("events", json!(left))]));
        }
    }
    author.done()
}

fn disjoint() -> Profile {
    let mut author = Author::new(Level::Resume, "disjoint");
    for seed in 0..24 {
        let kind = [Kind::Intervals, Kind::Clipped][seed as usize % 2];
        let Scene { children, cells, .. } = random(4000 + seed, 4 + seed as u32 / 2, kind);
        let run = Reference::run(&children, Search::Cells { cells: &cells, any: false, rule: Rule::Disjoint });
        // What is put aside after a leaf has been pruned before: that is a state before the next visit.
        for (i, _) in moments(nodes_of(&run), |_| false, 4) {
            let visit = &run.visits[i];
            let ask = Ask::ResumeDisjoint(Walk {
                children: children.clone(),
                cells: Some(cells.clone()),
                key: Some(visit.key.hex()),
                trail: Some(visit.trail.hex()),
                marks: Some(visit.marks.hex()),
                hit: visit.best,
                next: Some(Start::Visit),
                ..Walk::default()
            });
            let left = &run.events[visit.events..];
            let why = "The second trail says what a hit will end.";
            let clauses = ["DISJOINT-1", "DISJOINT-2", "PAUSE-1", "PAUSE-2", "PAUSE-3"];
            let answer = result([("events", json!(left)), ("hit", json!(run.best))]);
            author.case(&format!("{kind}-{seed}-{i}"), &clauses, why, &ask, answer);
        }
    }
    author.done()
}

fn keys() -> Profile {
    let mut author = Author::new(Level::Resume, "key-only");
    for seed in 0..24 {
        let (children, text) = random_script(5000 + seed, 3 + seed as u32 / 2, false);
        let search = Search::Script(text.as_bytes());
        let run = Reference::run(&children, search);
        for (i, _) in moments(nodes_of(&run), |_| false, 2) {
            let key = &run.visits[i].key;
            let trail = Bits((0..key.0.len()).map(|i| i > 0).collect());
            let marks = Bits::zeros(key.0.len());
            let left = Reference::resume(&children, search, key, &trail, &marks, None, true);
            let walk = Walk {
                children: children.clone(),
                script: Some(text.clone()),
                key: Some(key.hex()),
                ..Walk::default()
            };
            let why = "Below the node, then its sibling, its parent's sibling and so on, wanted or not.";
            let answer = result([("events", json!(left.events))]);
            author.case(&format!("random-{seed}-{i}"), &["PAUSE-4"], why, &Ask::ResumeKey(walk), answer);
        }
    }
    author.done()
}

fn invalid() -> Profile {
    let mut author = Author::new(Level::Resume, "invalid");
    let children = vec![Some([1, 2]), Some([3, 4]), None, None, None];
    let faults = [
        ("key-0", "0", "0", "no-such-node", "0 is no key."),
        ("key-below-leaf", "6", "0", "no-such-node", "A leaf has no children."),
        ("key-far-below", "100", "0", "no-such-node", "A leaf has no children."),
        ("trail-above-root", "4", "4", "trail", "The root has no sibling."),
        ("trail-of-root", "1", "1", "trail", "The root has no sibling."),
        ("trail-far-above", "2", "80", "trail", "There are no such levels."),
    ];
    for (name, key, trail, code, why) in faults {
        let ask = Ask::Resume(Walk {
            children: children.clone(),
            script: Some("LL...".to_owned()),
            key: Some(key.to_owned()),
            trail: Some(trail.to_owned()),
            next: Some(Start::Visit),
            ..Walk::default()
        });
        author.reject(name, &["PAUSE-5"], why, &ask, code);
    }
    author.done()
}
