//! Reinsertion: subtrees are taken out of a finished tree and put where they make boxes smallest.
//!
//! Meister & Bittner 2018, "Parallel reinsertion for bounding volume hierarchy optimization": for each node, the best
//! new sibling is sought in the whole tree, from near to far, with a bound on what can still be gained; all searches of
//! a round run in parallel. Then the moves are made one after the other, the most promising first. A move that no
//! longer makes the tree cheaper, because of those before it, is taken back. So the tree gets better with every move,
//! and does not depend on the number of threads.

mod collapse;
mod tree;

use super::SahOptions;
use super::draft::Draft;
use crate::threads;
use tree::Tree;

/// Optimises in `rounds`, or fewer if nothing is gained any more, and makes leaves of subtrees where that is cheaper.
///
/// The depth limit is kept if the draft keeps it.
pub(super) fn reinsert(draft: Draft, rounds: u32, sah: SahOptions, progress: &(dyn Fn(usize) + Sync)) -> Draft {
    let mut tree = Tree::of(&draft);
    for _ in 0..rounds {
        progress(0);
        let wishes = threads::map_with(0..tree.len(), 256, Vec::new, |pending, node| best_move(&tree, node, pending));
        let mut moves: Vec<_> = wishes.into_iter().flatten().collect();
        threads::sort_by(&mut moves, |a, b| b.gain.total_cmp(&a.gain).then(a.node.cmp(&b.node)));
        let made = moves.iter().filter(|wish| tree.try_move(wish.node, wish.sibling, sah.depth_limit)).count();
        if made == 0 {
            break;
        }
    }
    collapse::to_draft(&tree, &draft, sah.max_leaf)
}

/// A node, and the sibling that it would better have.
struct Move {
    node: usize,
    sibling: usize,
    /// Half area that the tree would lose.
    gain: f32,
}

/// The best place for a node. `pending` is memory that is kept between calls.
fn best_move(tree: &Tree, node: usize, pending: &mut Vec<(f32, usize)>) -> Option<Move> {
    let aabb = &tree.node(node).aabb;
    let area = aabb.half_area();
    let parent = tree.parent(node)?;
    tree.parent(parent)?;
    let mut best = Move { node, sibling: node, gain: 0.0 };
    // What is gained by taking the node out, up to the pivot, whose box without the node is `shrunk`.
    let mut freed = tree.node(parent).aabb.half_area();
    let sibling = tree.sibling(parent, node);
    let (mut pivot, mut other) = (parent, sibling);
    let mut shrunk = tree.node(other).aabb;
    loop {
        pending.push((freed, other));
        while let Some((freed, place)) = pending.pop() {
            // The new parent is at least as large as the node.
            if freed - area <= best.gain {
                continue;
            }
            let here = tree.node(place);
            let gain = freed - here.aabb.union(*aabb).half_area();
            if gain > best.gain && place != sibling {
                (best.sibling, best.gain) = (place, gain);
            }
            if let Some(children) = here.children() {
                let freed = gain + here.aabb.half_area();
                if freed - area > best.gain {
                    pending.extend(children.map(|child| (freed, child)));
                }
            }
        }
        let Some(above) = tree.parent(pivot) else { break };
        if pivot != parent {
            shrunk = shrunk.union(tree.node(other).aabb);
            freed += tree.node(pivot).aabb.half_area() - shrunk.half_area();
        }
        other = tree.sibling(above, pivot);
        pivot = above;
    }
    (best.sibling != node).then_some(best)
}

#[cfg(test)]
mod tests;
