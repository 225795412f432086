//! The wide trees of the cases, and their searches.

use crate::ask::{WideChildren, WideWalk};
use stackless_bvh::generate::{Rng, Source, wide_shape};

/// Returns the greatest level of an inner node; `None` if the child indices do not form a tree with root 0. `[WIDE-1]`
pub(crate) fn levels_if_tree(slots: u32, children: &WideChildren) -> Option<u32> {
    let (mut reached, mut levels) = (vec![false; children.len()], None);
    let mut pending = vec![(0_u32, 0)];
    while let Some((node, level)) = pending.pop() {
        if core::mem::replace(reached.get_mut(node as usize)?, true) {
            return None;
        }
        let Some(list) = &children[node as usize] else { continue };
        if list.len() > slots as usize || list.is_empty() && node != 0 {
            return None;
        }
        levels = levels.max(Some(level));
        pending.extend(list.iter().map(|&child| (child, level + 1)));
    }
    levels.filter(|_| children[0].is_some() && reached.into_iter().all(|reached| reached))
}

/// A child, with its begin in steps of a rank; `None` if it is not wanted.
pub(super) type Child = (u32, Option<u32>);

/// A tree as a list of nodes: the children of an inner node, or `None` for a leaf.
pub(super) type Nodes<'a> = &'a [Option<&'a [Child]>];

/// Builds the tree of these nodes, with slots from 0 on.
pub(super) fn told(slots: u32, nodes: Nodes<'_>) -> WideWalk {
    let children = |list: &[Child]| list.iter().map(|&(child, _)| child).collect();
    let ranks = |list: &[Child]| {
        list.iter().zip(0..).map(|(&(_, begins), slot)| begins.map(|begins| begins * slots + slot)).collect()
    };
    WideWalk {
        slots,
        children: nodes.iter().map(|list| list.map(children)).collect(),
        ranks: nodes.iter().map(|list| list.map(ranks)).collect(),
        ..WideWalk::default()
    }
}

/// Parses a tree from text, with spaces between words. Brackets contain the children of an inner node, from slot 0 on.
/// A child is its begin, a multiple of 8, followed by its own children, or by `!` and the distance of its hit.
pub(super) fn parsed(slots: u32, text: &str) -> WideWalk {
    let (mut children, mut ranks, mut hits) = (vec![None], vec![None], vec![None]);
    let mut path = Vec::new();
    for word in text.split(' ') {
        let new = children.len();
        match (word, path.last()) {
            ("(", _) => {
                path.push(new - 1);
                (children[new - 1], ranks[new - 1]) = (Some(vec![]), Some(vec![]));
            }
            (")", _) => drop(path.pop()),
            (child, Some(&parent)) => {
                let mut distances = child.split('!').map(|digits| digits.parse::<u32>().ok());
                let list: &mut Vec<u32> = children[parent].get_or_insert_default();
                let rank = distances.next().flatten().map(|begin| begin + list.len() as u32);
                list.push(new as u32);
                ranks[parent].get_or_insert_default().push(rank);
                children.push(None);
                ranks.push(None);
                hits.push(distances.next().flatten());
            }
            (_, None) => {}
        }
    }
    let hits = hits.iter().any(Option::is_some).then_some(hits);
    WideWalk { slots, children, ranks, hits, ..WideWalk::default() }
}

/// Builds a root whose leaves have these begins.
pub(super) fn flat(slots: u32, begins: &[Option<u32>]) -> WideWalk {
    let list: Vec<_> = (1..).zip(begins.iter().copied()).collect();
    let nodes: Vec<_> = [Some(&list[..])].into_iter().chain(begins.iter().map(|_| None)).collect();
    told(slots, &nodes)
}

/// Builds a chain of inner nodes. Each is in a slot of the previous one, with leaves in the slots before it and in the
/// one after. The next inner node comes first. `wants` selects, by level, whether the leaves are wanted.
pub(super) fn chain(slots: u32, levels: u32, slot: impl Fn(u32) -> u32, wants: impl Fn(u32) -> bool) -> WideWalk {
    let mut lists: Vec<Option<Vec<Child>>> = vec![None];
    let mut node = 0;
    for level in 0..=levels {
        let at = slot(level) % slots;
        // Lower levels begin later, as nested boxes do.
        let begins = |other: u32| if other == at { Some(level) } else { wants(level).then_some(level + 1) };
        let first = lists.len() as u32;
        let list: Vec<_> = (0..slots.min(at + 2)).map(|slot| (first + slot, begins(slot))).collect();
        lists.extend(list.iter().map(|_| None));
        lists[node] = Some(list);
        node = (first + at) as usize;
    }
    told(slots, &lists.iter().map(Option::as_deref).collect::<Vec<_>>())
}

/// Draws a random tree with a search and its hits.
pub(super) fn random(seed: u64, slots: u32, leaves: u32, distances: u32) -> WideWalk {
    let mut rng = Rng::new(seed);
    let (leaves, links) = (2 + rng.below(u64::from(leaves) - 1) as u32, rng.below(6) as u32);
    let children = match slots {
        2 => wide_shape::<2>(&mut rng, leaves, links),
        4 => wide_shape::<4>(&mut rng, leaves, links),
        _ => wide_shape::<8>(&mut rng, leaves, links),
    };
    let mut begins = vec![0; children.len()];
    let mut ranks = vec![None; children.len()];
    // Nodes come after their parents.
    for (node, list) in children.iter().enumerate() {
        let Some(list) = list else { continue };
        let of = |(&child, slot): (&u32, u32)| {
            let begin = begins[node] + if rng.below(4) == 0 { 0 } else { rng.below(u64::from(distances)) as u32 };
            begins[child as usize] = begin;
            (rng.below(8) > 0).then_some(begin * slots + slot)
        };
        ranks[node] = Some(list.iter().zip(0..).map(of).collect());
    }
    let hit = |(begin, list): (&u32, &Option<_>)| {
        // Close to its begin: many nodes are beyond the hit.
        let within = rng.below(u64::from(2 * slots)) as u32;
        (list.is_none() && rng.coin()).then_some(begin * slots + within)
    };
    let hits = begins.iter().zip(&children).map(hit).collect();
    WideWalk { slots, children, ranks, hits: Some(hits), ..WideWalk::default() }
}
