//! Level `resume`.

use serde_json::json;

use super::reference::{Reference, Rule, Search};
use super::trace::{SIDES, open_scenes};
use super::trees::{Scene, comb, random, random_script, script, spine};
use super::{Author, result};
use crate::ask::Walk;
use crate::bits::Bits;
use crate::{Ask, Children, Level, Profile, Start};
use stackless_bvh::generate::{Cell, Kind};

pub(super) fn profiles() -> Vec<Profile> {
    vec![states(), disjoint(), keys(), invalid()]
}

/// Selects pauses before a visit, or after it at a leaf. The number of events before the pause determines the remaining
/// events.
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
            let why = if run.visits[i].trail.0.last() == Some(&true) {
                "The sibling is postponed: no record names it, the register has to be located."
            } else {
                "Key and trail are enough to go on."
            };
            state(&mut author, &format!("random-{seed}"), why, &run, &text, i, next);
        }
    }
    for (depth, (side, goes_right)) in chains() {
        // All bits of a word, or only the highest.
        let [both, one] = if goes_right { ['R', 'r'] } else { ['L', 'l'] };
        let children = comb(depth, |_| goes_right);
        let text = script(&children, |node| if goes_right || node == 0 { both } else { one }, |_| '.');
        let run = Reference::run(&children, Search::Script(text.as_bytes()));
        for next in [Start::Visit, Start::Backtrack] {
            let name = format!("chain-{side}-{depth}");
            state(&mut author, &name, FROM_THE_BOTTOM, &run, &text, depth as usize, next);
        }
    }
    author.done()
}

const FROM_THE_BOTTOM: &str = "From the bottom of a chain, longer than a word or just not.";

/// Chains around the depth limits of the words, on each side. If a tree's levels equal the bits of the trail, it can be
/// traversed without keys, although its keys do not fit. Implementations that support it must also resume it.
fn chains() -> impl Iterator<Item = (u32, (&'static str, bool))> {
    [31, 32, 33, 63, 64, 65].into_iter().flat_map(|depth| SIDES.map(|side| (depth, side)))
}

/// Adds a case that resumes a scripted search before or after a visit.
fn state(author: &mut Author, name: &str, why: &str, run: &Reference<'_>, text: &str, i: usize, next: Start) {
    let visit = &run.visits[i];
    let left = &run.events[visit.events + usize::from(next == Start::Backtrack)..];
    let ask = Ask::Resume(Walk {
        children: run.children.clone(),
        script: Some(text.to_owned()),
        key: Some(visit.key.hex()),
        trail: Some(visit.trail.hex()),
        next: Some(next),
        ..Walk::default()
    });
    let name = format!("{name}-{}-{i}", word(next));
    author.case(&name, &["PAUSE-1", "PAUSE-2", "PAUSE-3"], why, &ask, result([("events", json!(left))]));
}

fn disjoint() -> Profile {
    let mut author = Author::new(Level::Resume, "disjoint");
    let drawn = |seed: u64| {
        let kind = [Kind::Intervals, Kind::Clipped][seed as usize % 2];
        (kind, random(4000 + seed, 4 + seed as u32 / 2, kind))
    };
    for seed in 0..24 {
        let (kind, scene) = drawn(seed);
        let run = run(&scene);
        // A pause after a leaf follows the pruning, so its state is that before the next visit.
        for (i, _) in moments(nodes_of(&run), |_| false, 4) {
            let why = "The second trail says what a hit will end.";
            taken_up(&mut author, &format!("{kind}-{seed}-{i}"), why, &scene, &run, i, Start::Visit);
        }
    }
    let mut each = |name: &str, why: &str, scene: &Scene, moments: &dyn Fn(&Reference<'_>) -> Vec<(usize, Start)>| {
        let run = run(scene);
        for (i, next) in moments(&run) {
            taken_up(&mut author, &format!("{name}-{}-{i}", word(next)), why, scene, &run, i, next);
        }
    };
    let why = "After a leaf the trail is without what its hit has ended, and nothing else is ended.";
    for seed in 24..40 {
        let (kind, scene) = drawn(seed);
        let backtracks = |run: &Reference<'_>| {
            let moments = moments(nodes_of(run), |node| scene.children[node as usize].is_none(), usize::MAX);
            moments.into_iter().filter(|&(_, next)| next == Start::Backtrack).step_by(3).collect()
        };
        each(&format!("{kind}-{seed}"), why, &scene, &backtracks);
    }
    for (name, why, scene) in known_hits().into_iter().chain(open_scenes()) {
        let last = |run: &Reference<'_>| {
            let leaf = run.visits.iter().rposition(|visit| visit.node == 3).unwrap_or(0);
            vec![(leaf, Start::Visit), (leaf, Start::Backtrack)]
        };
        each(name, why, &scene, &last);
    }
    for (depth, (side, goes_right)) in chains() {
        // Only the highest bit of the second trail, or of the trail, matters.
        let scene = spine(depth, goes_right, |level| (level == 0) != goes_right);
        let bottom = |_: &Reference<'_>| vec![(depth as usize, Start::Visit), (depth as usize, Start::Backtrack)];
        each(&format!("chain-{side}-{depth}"), FROM_THE_BOTTOM, &scene, &bottom);
    }
    author.done()
}

fn run(scene: &Scene) -> Reference<'_> {
    Reference::run(&scene.children, Search::Cells { cells: &scene.cells, any: false, rule: Rule::Disjoint })
}

/// Adds a case that resumes a search over cells before or after a visit.
fn taken_up(author: &mut Author, name: &str, why: &str, scene: &Scene, run: &Reference<'_>, i: usize, next: Start) {
    let visit = &run.visits[i];
    let (trail, hit) = match (next, &visit.after) {
        (Start::Backtrack, Some((trail, best))) => (trail, *best),
        _ => (&visit.trail, visit.best),
    };
    let ask = Ask::ResumeDisjoint(Walk {
        children: scene.children.clone(),
        cells: Some(scene.cells.clone()),
        key: Some(visit.key.hex()),
        trail: Some(trail.hex()),
        marks: Some(visit.marks.hex()),
        hit,
        next: Some(next),
        ..Walk::default()
    });
    let left = &run.events[visit.events + usize::from(next == Start::Backtrack)..];
    let clauses = ["DISJOINT-1", "DISJOINT-2", "PAUSE-1", "PAUSE-2", "PAUSE-3"];
    author.case(name, &clauses, why, &ask, result([("events", json!(left)), ("hit", json!(run.best))]));
}

/// The hit is in node 1. Node 3 is the first child of a marked descent.
fn known_hits() -> [(&'static str, &'static str, Scene); 4] {
    let node = |enter, exit, hit| Cell { enter, exit: Some(exit), hit, ..Cell::default() };
    let scene = |hit| Scene {
        children: vec![Some([1, 2]), None, Some([3, 4]), None, None],
        cells: vec![
            node(0, 100, None),
            node(0, 60, Some(50)),
            node(1, 100, None),
            node(1, 10, hit),
            node(20, 90, Some(25)),
        ],
        any: false,
        octant: 0,
    };
    [
        ("known-nearer", "A nearer hit than the known one ends what is marked.", scene(Some(5))),
        ("known-none", "The known hit is elsewhere, and ends nothing here.", scene(None)),
        ("known-farther", "A hit beyond the known one ends nothing.", scene(Some(55))),
        ("known-clipped", "The best hit is here but beyond the leaf's end, and ends nothing.", scene(Some(30))),
    ]
}

fn keys() -> Profile {
    let mut author = Author::new(Level::Resume, "key-only");
    for seed in 0..24 {
        let (children, text) = random_script(5000 + seed, 3 + seed as u32 / 2, false);
        let run = Reference::run(&children, Search::Script(text.as_bytes()));
        for (i, _) in moments(nodes_of(&run), |_| false, 2) {
            let why = "Below the node, then its sibling, its parent's sibling and so on, wanted or not.";
            by_key(&mut author, &format!("random-{seed}-{i}"), why, &children, &text, &run.visits[i].key);
        }
    }
    for (depth, (side, goes_right)) in chains() {
        let children = comb(depth, |_| goes_right);
        let text = script(&children, |_| 'n', |_| '.');
        let key = Bits((0..=depth).map(|level| level == 0 || goes_right).collect());
        by_key(&mut author, &format!("chain-{side}-{depth}"), FROM_THE_BOTTOM, &children, &text, &key);
    }
    author.done()
}

/// Adds a case that resumes a scripted search from the key alone.
fn by_key(author: &mut Author, name: &str, why: &str, children: &Children, text: &str, key: &Bits) {
    let trail = Bits((0..key.0.len()).map(|i| i > 0).collect());
    let marks = Bits::zeros(key.0.len());
    let left = Reference::resume(children, Search::Script(text.as_bytes()), key, &trail, &marks, None, true);
    let ask = Ask::ResumeKey(Walk {
        children: children.clone(),
        script: Some(text.to_owned()),
        key: Some(key.hex()),
        ..Walk::default()
    });
    author.case(name, &["PAUSE-4"], why, &ask, result([("events", json!(left.events))]));
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
    let run = Reference::run(&children, Search::Script(b"LL..."));
    for (i, next) in moments(nodes_of(&run), |node| children[node as usize].is_none(), 8) {
        state(&mut author, "right", "This is a state: not everything is rejected.", &run, "LL...", i, next);
    }
    author.done()
}
