//! Profile `trace/wide`.

use super::reference::Reference;
use super::trees::{chain, flat, levels_if_tree, random, told};
use super::{GREATEST, WIDTHS, left};
use crate::Ask;
use crate::ask::WideWalk;
use crate::author::{Author, result};

pub(super) fn traces(author: &mut Author) {
    small(author);
    ends(author);
    leaves_first(author);
    for seed in 0..96 {
        let (name, why, walk) = drawn(seed, 3 + seed as u32 / 3);
        traced(author, &name, why, walk);
    }
    for slots in WIDTHS {
        chains(author, slots);
    }
}

/// One node, or two levels.
fn small(author: &mut Author) {
    for slots in WIDTHS {
        let mut case = |name: &str, why: &str, walk| traced(author, &format!("{name}-{slots}"), why, walk);
        let all = |begins: fn(u32) -> u32| flat(slots, &(0..slots).map(|slot| Some(begins(slot))).collect::<Vec<_>>());
        case("empty", "A root without children.", flat(slots, &[]));
        case("one", "One child, in slot 0.", flat(slots, &[Some(3)]));
        case("none", "No child is wanted.", flat(slots, &[None, None]));
        case("last", "Only the child in the last slot is wanted.", {
            flat(slots, &(0..slots).map(|slot| (slot + 1 == slots).then_some(0)).collect::<Vec<_>>())
        });
        case("all", "Every slot holds a child; they come by slot.", all(|slot| slot));
        case("all-backwards", "They come from the last slot on.", all(|slot| 9 - slot));
        case("all-mixed", "They come by rank, not by slot.", all(|slot| 5 * slot % 8));
        case("ties", "Of equal distances the lower slot comes first.", all(|_| 7));
        case("ties-some", "Some distances are equal.", all(|slot| 4 - slot / 2));
        // The highest bit of a rank has no special meaning.
        let most = GREATEST / slots;
        let far = flat(slots, &[Some(most), Some(most / 2), Some(0), Some(most / 2 + 1)][..slots.min(4) as usize]);
        case("far", "The greatest distance is not beyond the greatest end, and no number is negative.", far);
        let farthest = vec![Some(most); slots as usize];
        case("farthest", "The greatest rank, which has all bits, is a rank.", flat(slots, &farthest));
        let below: &[_] = &[(3, Some(2)), (4, Some(1))];
        case("below", "A sibling is pending while its sibling's children are visited.", {
            told(slots, &[Some(&[(1, Some(1)), (2, Some(4))]), Some(below), None, None, None])
        });
        case("between", "Children come before the next sibling, though that begins before them.", {
            told(slots, &[Some(&[(1, Some(0)), (2, Some(1))]), Some(&[(3, Some(5)), (4, Some(4))]), None, None, None])
        });
        case("only-below", "Nothing is wanted below.", {
            told(slots, &[Some(&[(1, Some(0)), (2, Some(1))]), Some(&[(3, None)]), None, None])
        });
        let up: &[_] = &[(1, Some(0)), (2, Some(1))];
        case("down-again", "From a leaf to an inner node two levels up, and down again.", {
            let (next, last): (&[_], &[_]) = (&[(3, Some(1)), (4, Some(2))], &[(5, Some(3)), (6, Some(2))]);
            told(slots, &[Some(up), Some(next), Some(last), None, None, None, None])
        });
    }
    for slots in [4, 8] {
        let inner: Vec<_> = (1..=slots).map(|node| (node, Some(11 * node % 8))).collect();
        let lists: Vec<Vec<_>> =
            (1..=slots).map(|node| vec![(slots + 2 * node - 1, Some(8)), (slots + 2 * node, Some(9))]).collect();
        let nodes = [Some(&inner[..])].into_iter().chain(lists.iter().map(|list| Some(&list[..])));
        let nodes: Vec<_> = nodes.chain((0..2 * slots).map(|_| None)).collect();
        let why = "More than three are pending: all but the second and third have to be found again.";
        traced(author, &format!("many-{slots}"), why, told(slots, &nodes));
    }
}

/// Adds children beyond the end.
fn ends(author: &mut Author) {
    for slots in WIDTHS {
        let mut case = |name: &str, why: &str, walk| traced(author, &format!("{name}-{slots}"), why, walk);
        let at = |begins: u32, end: u32| WideWalk { end: Some(end), ..flat(slots, &[Some(begins), Some(begins)]) };
        case("end-at", "A child that begins at the end is not beyond: its slot does not count.", at(5, 5 * slots));
        case("end-before", "A child that begins after the end is beyond.", at(5, 5 * slots - 1));
        case("end-0", "The least end.", at(0, 0));
        let hit = |hits: &[(usize, u32)], walk: WideWalk| {
            let mut told = vec![None; walk.children.len()];
            for &(node, t) in hits {
                told[node] = Some(t);
            }
            WideWalk { hits: Some(told), ..walk }
        };
        let two = || flat(slots, &[Some(2), Some(5)]);
        case("hit-before", "The second child is beyond the first one's hit.", hit(&[(1, 5 * slots - 1)], two()));
        case("hit-at", "The second child begins at the first one's hit.", hit(&[(1, 5 * slots)], two()));
        case("hit-beyond", "A hit beyond the end is none.", {
            WideWalk { end: Some(6 * slots), ..hit(&[(1, 7 * slots)], two()) }
        });
        case(
            "hit-tie",
            "Of equal hits that of the lower number.",
            hit(&[(1, 9 * slots), (2, 9 * slots)], flat(slots, &[Some(3), Some(2)])),
        );
        let later = || hit(&[(1, 9 * slots), (2, 9 * slots)], flat(slots, &[Some(2), Some(3)]));
        case("hit-tie-later", "Of equal hits that of the lower number, which came first.", later());
        case("hit-all", "A field that says what holds without it.", {
            WideWalk { any: Some(false), sorted: Some(true), ..later() }
        });
        case("hit-any", "The first hit ends the search.", {
            WideWalk { any: Some(true), ..hit(&[(2, 9 * slots)], flat(slots, &[Some(3), Some(2)])) }
        });
        let below = || {
            let (up, down): (&[_], &[_]) = (&[(1, Some(0)), (2, Some(4))], &[(3, Some(1)), (4, Some(6))]);
            told(slots, &[Some(up), Some(down), None, None, None])
        };
        case("hit-levels", "Beyond on the way back: two levels.", hit(&[(3, 2 * slots)], below()));
        case("hit-level", "The level below is beyond, the one above is not.", hit(&[(3, 5 * slots)], below()));
        case("hit-late", "A hit after which one child is left, which was wanted before.", {
            let up: &[_] = &[(1, Some(0)), (2, Some(4))];
            hit(
                &[(3, 9 * slots), (4, 3 * slots)],
                told(slots, &[Some(up), Some(&[(3, Some(1)), (4, Some(2))]), None, None, None]),
            )
        });
    }
    for slots in [4, 8] {
        let up: &[_] = &[(1, Some(0)), (2, Some(1)), (3, Some(5))];
        let below: &[_] = &[(4, Some(1)), (5, Some(9))];
        let mut case = |name: &str, why: &str, nodes, hits: [Option<u32>; 6]| {
            let walk = WideWalk { hits: Some(hits.to_vec()), ..told(slots, nodes) };
            traced(author, &format!("{name}-{slots}"), why, walk);
        };
        let (first, second) =
            ([Some(up), Some(below), None, None, None, None], [Some(up), None, Some(below), None, None, None]);
        let hit = Some(3 * slots);
        let why = "Of two pending children the second is beyond, the first is not.";
        case("hit-second", why, &first, [None, None, None, None, hit, None]);
        let why = "A hit before the way down: on the way back the child that is left is beyond.";
        case("hit-then-down", why, &second, [None, hit, None, None, None, None]);
    }
    for slots in [4, 8] {
        let begins: Vec<_> = (0..slots).map(|slot| Some(3 * slot % 8)).collect();
        for first in 0..slots {
            let mut walk = flat(slots, &begins);
            let mut hits = vec![None; walk.children.len()];
            hits[1 + first as usize] = Some(slots * (3 * first % 8 + 2));
            walk.hits = Some(hits);
            let why = "A hit on the way through: what is left begins later, or not.";
            traced(author, &format!("hit-through-{slots}-{first}"), why, walk);
        }
    }
}

/// Adds searches without an order.
fn leaves_first(author: &mut Author) {
    for slots in WIDTHS {
        let up: &[_] = &[(1, Some(0)), (2, Some(4))];
        let walk = |any, hits: Option<Vec<Option<u32>>>, end| WideWalk {
            sorted: Some(false),
            any,
            end,
            hits,
            ..told(slots, &[Some(up), Some(&[(3, Some(6)), (4, Some(5))]), None, None, None])
        };
        let mut case = |name: &str, why: &str, walk| traced(author, &format!("{name}-{slots}"), why, walk);
        case("unsorted", "The leaf comes before the inner node, though its slot and its rank are greater.", {
            walk(None, None, None)
        });
        let nodes = [Some(up), Some(&[(3, Some(6)), (4, Some(5))]), Some(&[(5, Some(5)), (6, Some(5))])];
        let nodes: Vec<_> = nodes.into_iter().chain([None; 4]).collect();
        case("unsorted-inner", "Two inner nodes come by slot.", {
            WideWalk { sorted: Some(false), ..told(slots, &nodes) }
        });
        case("unsorted-end", "Without an order nothing is beyond.", walk(None, None, Some(0)));
        let hits = |node: usize, t| {
            let mut hits = vec![None; 5];
            hits[node] = Some(t);
            Some(hits)
        };
        case("unsorted-any", "The first hit ends the search.", walk(Some(true), hits(3, 9), None));
        case("unsorted-hit", "A hit that does not end it skips nothing.", walk(None, hits(2, 0), None));
        case("unsorted-far", "A hit beyond the end is none.", walk(Some(true), hits(2, 9), Some(8)));
    }
}

/// Draws a case.
pub(super) fn drawn(seed: u64, leaves: u32) -> (String, &'static str, WideWalk) {
    let slots = WIDTHS[seed as usize % 3];
    // Short ranges of distances give many ties.
    let walk = random(6000 + seed, slots, leaves, [3, 8, 20][seed as usize / 3 % 3]);
    let unhit = || WideWalk { hits: None, ..walk.clone() };
    match seed / 9 % 5 {
        0 => (format!("all-random-{seed}"), "Nothing is beyond: by rank.", unhit()),
        1 | 2 => (format!("closest-{seed}"), "Hits end the search before what begins later.", walk),
        3 => (format!("any-{seed}"), "The first hit ends the search.", WideWalk { any: Some(true), ..walk }),
        _ if seed % 2 == 1 => {
            let walk = WideWalk { sorted: Some(false), ..unhit() };
            (format!("unsorted-all-{seed}"), "Leaves come first, each by its slot.", walk)
        }
        _ => {
            let walk = WideWalk { sorted: Some(false), any: Some(true), ..walk };
            (format!("unsorted-any-{seed}"), "Leaves come first, and the first hit ends the search.", walk)
        }
    }
}

/// Adds chains around the depth limits of the words, and around the reach of the records.
fn chains(author: &mut Author, slots: u32) {
    let mut case = |levels: u32, name: &str, why: &str, walk| {
        traced(author, &format!("chain-{slots}-{levels}-{name}"), why, walk);
    };
    // At greater depths, words for fewer slots, which have more levels, reach their limits.
    let deep: &[u32] = match slots {
        2 => &[62, 63, 64, 65, 127, 128],
        4 => &[41, 42, 63, 64],
        _ => &[42, 43],
    };
    for &levels in [1, 2, 3, 4, 7, 8, 9, 10, 15, 16, 17, 20, 21, 22, 31, 32, 33].iter().chain(deep) {
        let why = "From the bottom to the root's other children.";
        case(levels, "first", why, chain(slots, levels, |level| level, |level| level == 0));
    }
    for levels in [2, 3, 4, 8, 9, 17, 32] {
        let wants = |level| level == 0 || level == levels / 2;
        case(levels, "two", "Two levels have pending children.", chain(slots, levels, |level| 3 * level + 1, wants));
    }
    for levels in [1, 2, 3, 8, 9, 16] {
        let walk = chain(slots, levels, |level| level % 2, |_| true);
        case(levels, "all", "Each level has pending children.", walk.clone());
        let bottom = walk.children.iter().rev().flatten().next().map_or(0, |list| list[levels as usize % 2]);
        let mut hits = vec![None; walk.children.len()];
        hits[bottom as usize] = Some((levels / 2 + 1) * slots);
        let why = "A hit far below: what is pending on the lower levels is beyond.";
        case(levels, "hit", why, WideWalk { hits: Some(hits), ..walk });
    }
}

/// Adds a case of a trace. The events determine its clauses.
pub(super) fn traced(author: &mut Author, name: &str, why: &str, walk: WideWalk) {
    let run = Reference::run(&walk);
    let clauses = clauses(&walk, &run);
    let mut fields = left(&walk, &run, 0);
    // With hits, implementations may differ in when a child beyond the end ceases to be pending.
    if walk.hits.is_none() {
        fields.push(("trails", run.visits.iter().map(|visit| visit.trail.hex()).collect()));
    }
    author.case(name, &clauses, why, &Ask::TraceWide(walk), result(fields));
}

fn clauses(walk: &WideWalk, run: &Reference<'_>) -> Vec<&'static str> {
    let is_sorted = walk.sorted != Some(false);
    let mut clauses = vec!["WIDE-7", if is_sorted { "WIDE-5" } else { "WIDE-6" }, "WIDE-9"];
    let backs = run.events.iter().filter_map(|event| event.strip_prefix("backtrack ")?.split(' ').nth(1)?.parse().ok());
    let backs: Vec<u32> = backs.collect();
    if !backs.is_empty() {
        clauses.extend(["WIDE-2", "WIDE-10", "WIDE-11"]);
    }
    // After a descent, a backtrack must find the ancestor and its next child.
    let goes_down = backs.iter().any(|&levels| levels > 0);
    if goes_down {
        clauses.extend(["WIDE-13", "WIDE-15", "WIDE-16"]);
    }
    if goes_down || run.skipped > 0 {
        clauses.push("WIDE-17");
        clauses.extend(is_sorted.then_some(["WIDE-18", "WIDE-19"]).into_iter().flatten());
    }
    if is_sorted && (run.skipped > 0 || walk.hits.is_some() || walk.end.is_some()) {
        clauses.extend(["WIDE-3", "WIDE-4", "WIDE-8"]);
    }
    if walk.slots == 2 {
        clauses.push("WIDE-12");
    }
    if levels_if_tree(walk.slots, &walk.children) > Some(3) {
        clauses.extend(["WIDE-14", "CONF-3"]);
    }
    clauses
}
