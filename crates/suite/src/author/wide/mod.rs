//! Wide trees: profiles `wide` of the levels `hash`, `trace` and `resume`.

mod reference;
#[cfg(test)]
mod tests;
mod trace;
mod trees;
mod words;

use serde_json::{Value, json};

use self::reference::Reference;
use self::trace::{drawn, traced, traces};
use self::trees::{chain, flat, random};
use self::words::words;
use super::resume::moments;
use super::{Author, result};
use crate::ask::{WideChildren, WideWalk};
use crate::{Ask, Level, Profile, Start};

pub(crate) use trees::levels_if_tree;

pub(super) fn profiles() -> Vec<Profile> {
    vec![usual(), invalid(), states(), keys(), deep_keys()]
}

const WIDTHS: [u32; 3] = [2, 4, 8];

/// The maximum end of a search.
const GREATEST: u32 = u32::MAX;

/// Returns the expected result from an event on.
fn left(walk: &WideWalk, run: &Reference<'_>, from: usize) -> Vec<(&'static str, Value)> {
    let hit = walk.hits.as_ref().map(|_| ("hit", json!(run.best)));
    [("events", json!(run.events[from..]))].into_iter().chain(hit).collect()
}

fn usual() -> Profile {
    let mut author = Author::new(Level::Trace, "wide");
    traces(&mut author);
    words(&mut author);
    author.done()
}

fn invalid() -> Profile {
    let mut author = Author::new(Level::Trace, "wide-invalid");
    let mut case = |name: &str, why: &str, slots: u32, lists: &[Option<&[u32]>]| {
        let children: WideChildren = lists.iter().map(|list| list.map(<[u32]>::to_vec)).collect();
        let ranks = |list: &[u32]| (0..list.len() as u32).map(|slot| Some(slot % slots)).collect();
        let ranks = lists.iter().map(|list| list.map(ranks)).collect();
        let ask = Ask::TraceWide(WideWalk { slots, children, ranks, ..WideWalk::default() });
        author.reject(name, &["WIDE-1"], why, &ask, "not-a-tree");
    };
    case("empty", "There is no root.", 4, &[]);
    case("leaf", "The root is a leaf.", 4, &[None]);
    for slots in WIDTHS {
        let many: Vec<_> = (1..=slots + 1).collect();
        let leaves: Vec<_> = many.iter().map(|_| None).collect();
        case(&format!("many-{slots}"), "More children than slots.", slots, &[vec![Some(&many[..])], leaves].concat());
    }
    case("no-children", "An inner node without children.", 4, &[Some(&[1, 2]), Some(&[]), None]);
    case("out-of-range", "A child that there is not.", 8, &[Some(&[1, 2, 3]), None, None]);
    case("far-out-of-range", "A child that there is not.", 8, &[Some(&[1, (1 << 31) - 1]), None]);
    case("own-child", "A node is its own child.", 2, &[Some(&[1]), Some(&[1])]);
    case("root-as-child", "The root is the child of another.", 4, &[Some(&[1, 2]), Some(&[3, 0]), None, None]);
    case("twice", "A node in two slots.", 4, &[Some(&[1, 2, 1]), None, None]);
    case("two-parents", "A node with two parents.", 4, &[Some(&[1, 2]), Some(&[3]), Some(&[3]), None]);
    case("unreached", "A node without a parent.", 8, &[Some(&[1, 2]), None, None, None]);
    case("cycle", "Nodes that are each other's children.", 4, &[Some(&[1]), None, Some(&[3]), Some(&[2])]);
    // Implementations that stop at the first leaf fail this case.
    case(
        "later-many",
        "More children than slots, after a leaf.",
        2,
        &[Some(&[1, 2]), None, Some(&[3, 4, 5]), None, None, None],
    );
    case("later-no-children", "An inner node without children, after a leaf.", 4, &[Some(&[1, 2]), None, Some(&[])]);
    case("later-out-of-range", "A child that there is not, after a leaf.", 8, &[Some(&[1, 2]), None, Some(&[3])]);
    case("later-twice", "A node in two slots, after a leaf.", 4, &[Some(&[1, 2]), None, Some(&[3, 3]), None]);
    case("later-root", "The root is the child of another, after a leaf.", 4, &[Some(&[1, 2]), None, Some(&[0])]);
    for slots in WIDTHS {
        let why = "This is a tree: not everything is rejected.";
        traced(&mut author, &format!("right-{slots}"), why, flat(slots, &[Some(0), Some(8)]));
    }
    author.done()
}

fn states() -> Profile {
    let mut author = Author::new(Level::Resume, "wide");
    for slots in [4, 8] {
        // The second hit is beyond the first, and the begin of the third child is between them.
        let hits = Some(vec![None, Some(slots + 1), Some(3 * slots), None]);
        let walk = WideWalk { hits, ..flat(slots, &[Some(0), Some(1), Some(2)]) };
        taken_up(&mut author, &format!("hit-kept-{slots}"), &walk, 5);
    }
    for seed in 0..30 {
        let (name, _, walk) = drawn(700 + seed, 4 + seed as u32);
        taken_up(&mut author, &name, &walk, 4);
    }
    for (slots, depths) in [(2, [31, 62, 63]), (4, [15, 30, 31]), (8, [7, 20, 21])] {
        for levels in depths {
            let walk = chain(slots, levels, |level| level, |level| level == 0);
            let (run, bottom) = (Reference::run(&walk), levels as usize + 1);
            for next in [Start::Visit, Start::Backtrack] {
                let why = "From the bottom of a chain, with a key as long as a word, or just longer.";
                state(&mut author, &format!("chain-{slots}-{levels}"), why, &walk, &run, bottom, next);
            }
        }
    }
    author.done()
}

/// Adds cases that resume a search from `count` of its states.
fn taken_up(author: &mut Author, name: &str, walk: &WideWalk, count: usize) {
    let run = Reference::run(walk);
    let nodes = run.visits.iter().map(|visit| visit.node);
    for (i, next) in moments(nodes, |node| walk.children[node as usize].is_none(), count) {
        // After a hit that ends the search, there is no state to resume.
        if next == Start::Backtrack && walk.any == Some(true) && run.visits[i].after.1.is_some() {
            continue;
        }
        let why = "Key, trail and end are enough to go on: pending children that are beyond are skipped.";
        state(author, name, why, walk, &run, i, next);
    }
}

/// Adds a case that resumes a search before or after a visit.
fn state(author: &mut Author, name: &str, why: &str, walk: &WideWalk, run: &Reference<'_>, i: usize, next: Start) {
    let visit = &run.visits[i];
    let is_visited = next == Start::Backtrack;
    let (end, hit) = if is_visited { visit.after } else { visit.before };
    let ask = Ask::ResumeWide(WideWalk {
        end: (end < GREATEST).then_some(end),
        key: Some(visit.key.hex()),
        trail: Some(visit.trail.hex()),
        hit,
        next: Some(next),
        ..walk.clone()
    });
    let name = format!("{name}-{}-{i}", if is_visited { "backtrack" } else { "visit" });
    let clauses = ["WIDE-3", "WIDE-10", "WIDE-11", "WIDE-13", "PAUSE-1"];
    let answer = result(left(walk, run, visit.events + usize::from(is_visited)));
    author.case(&name, &clauses, why, &ask, answer);
}

/// `[WIDE-16]`
fn keys() -> Profile {
    let mut author = Author::new(Level::Hash, "wide");
    let mut case = |name: &str, slots, children| hashed_keys(&mut author, name, slots, children);
    for slots in WIDTHS {
        case(&format!("empty-{slots}"), slots, flat(slots, &[]).children);
        case(&format!("leaves-{slots}"), slots, flat(slots, &vec![Some(0); slots as usize]).children);
        case(&format!("one-inner-{slots}"), slots, vec![Some(vec![1]), Some(vec![2]), None]);
        case(&format!("inner-and-leaf-{slots}"), slots, vec![Some(vec![1, 2]), None, Some(vec![3]), None]);
        case(&format!("two-inner-{slots}"), slots, vec![Some(vec![1, 2]), Some(vec![3]), Some(vec![4]), None, None]);
        let deepest = 63 / slots.trailing_zeros();
        for levels in [1, 2, 3, 7, deepest - 1, deepest] {
            let walk = chain(slots, levels, |level| 3 * level + 1, |_| true);
            case(&format!("chain-{slots}-{levels}"), slots, walk.children);
        }
    }
    for seed in 0..24 {
        let slots = WIDTHS[seed as usize % 3];
        case(&format!("random-{slots}-{seed}"), slots, random(8000 + seed, slots, 6 + seed as u32 / 2, 4).children);
    }
    author.done()
}

/// Keys of more than 64 bits. `[WIDE-16]`
fn deep_keys() -> Profile {
    let mut author = Author::new(Level::Hash, "wide-deep");
    for (slots, depths) in [(2, [64, 65, 126]), (4, [32, 33, 63]), (8, [22, 23, 42])] {
        for levels in depths {
            let children = chain(slots, levels, |level| 3 * level + 1, |_| true).children;
            hashed_keys(&mut author, &format!("chain-{slots}-{levels}"), slots, children);
        }
    }
    author.done()
}

fn hashed_keys(author: &mut Author, name: &str, slots: u32, children: WideChildren) {
    let keys: Vec<_> = asked_for(slots, &children).iter().map(|key| format!("{key:x}")).collect();
    let why = "Nodes with an inner child and another child beside it.";
    let ask = Ask::HashedKeysWide { slots, children };
    author.case(name, &["WIDE-9", "WIDE-16"], why, &ask, result([("keys", json!(keys))]));
}

/// Returns the looked-up keys by the definition, from the root down.
fn asked_for(slots: u32, children: &WideChildren) -> Vec<u128> {
    let mut asked = Vec::new();
    let mut open = vec![(1_u128, 0_u32)];
    while let Some((key, node)) = open.pop() {
        let Some(list) = &children[node as usize] else { continue };
        let has_inner = list.iter().any(|&child| children[child as usize].is_some());
        if has_inner && list.len() > 1 {
            asked.push(key);
        }
        let inner = (0..).zip(list).filter(|&(_, &child)| children[child as usize].is_some());
        open.extend(inner.map(|(slot, &child)| (key * u128::from(slots) + slot, child)));
    }
    asked.sort_unstable();
    asked
}
