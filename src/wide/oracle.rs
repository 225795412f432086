//! The reference: a minimal recursion.

use alloc::vec::Vec;

use super::search::{Ranks, Search, is_beyond};
use super::tree::Topology;
use super::visit;
use crate::event::Recorder;
use crate::order::Flow;
use crate::tree::Node;

/// Deepest tree, in levels, for the recursion. Deeper trees are compared with the explicit [`Stack`](super::Stack),
/// which is itself compared with this function.
pub const LEVEL_LIMIT: u32 = 1000;

/// Visits the root, then, at each inner node, the wanted children in the wanted order. `[WIDE-5]` `[WIDE-6]`
///
/// The tree must have at most [`LEVEL_LIMIT`] levels; nodes below them are not visited.
pub fn traverse<const A: usize, T: Topology<A>, S: Search<A>>(
    tree: &T,
    search: &mut S,
    recorder: &mut impl Recorder,
) -> Flow {
    below(tree, tree.root(), search, recorder, LEVEL_LIMIT)
}

fn below<const A: usize, T: Topology<A>, S: Search<A>>(
    tree: &T,
    node: Node,
    search: &mut S,
    recorder: &mut impl Recorder,
    levels_left: u32,
) -> Flow {
    if visit(recorder, node) == Flow::Stop {
        return Flow::Stop;
    }
    if node.is_leaf() {
        return search.leaf(node);
    }
    let Some(left) = levels_left.checked_sub(1) else { return Flow::Continue };
    let wanted = search.ask(node);
    let rank_of = |slot| if S::SORTED { wanted.ranks.rank(slot) } else { u32::from(!tree.child(node, slot).is_leaf()) };
    let mut slots: Vec<u32> = (0..A as u32).filter(|slot| wanted.set >> slot & 1 == 1).collect();
    slots.sort_by_key(|&slot| rank_of(slot));
    for slot in slots {
        let is_skipped = S::SORTED && is_beyond::<A>(wanted.ranks.rank(slot), search.end());
        if !is_skipped && below(tree, tree.child(node, slot), search, recorder, left) == Flow::Stop {
            return Flow::Stop;
        }
    }
    Flow::Continue
}
