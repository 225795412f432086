//! Reinsertion: subtrees are removed from a finished tree and inserted where boxes become smallest.
//!
//! Meister & Bittner 2018, "Parallel reinsertion for bounding volume hierarchy optimization": a search of the whole
//! tree, from near to far, finds the best new sibling of each node. A bound on the possible gain prunes the search. All
//! searches of a round run in parallel. Then the moves are made one after the other, the most promising first. If
//! earlier moves have made a move useless, so that the tree does not become cheaper, it is undone. So the tree improves
//! with every move, and does not depend on the number of threads.
//!
//! Only the largest nodes are moved, because they have the greatest gain.

use super::record::{Planes, Record, half_area, union};
use super::{BuildError, SahOptions, filled};
use crate::threads;

/// The number of nodes to move.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) struct Rounds {
    pub(super) count: u32,
    /// The share of the nodes that may move in the first round, those of the largest area.
    pub(super) share: f32,
    /// The factor of this share from round to round. In the first rounds moves obstruct each other; rounds matter more
    /// than shares.
    pub(super) decay: f32,
}

impl Rounds {
    /// Up to 10 % of the nodes.
    pub(in crate::bvh) const SEVERAL: Self = Self { count: 4, share: 0.1, decay: 0.7 };
}

/// Optimises a tree whose children are adjacent, the first pair at 1. The depth limit is kept if the tree keeps it.
pub(super) fn reinsert(
    nodes: &mut [Record],
    rounds: Rounds,
    sah: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<(), BuildError> {
    if rounds.count == 0 {
        return Ok(());
    }
    let (mut tree, areas) = Tree::of(nodes, sah)?;
    let mut share = rounds.share;
    for _ in 0..rounds.count {
        let large = tree.large(areas.least(share));
        share *= rounds.decay;
        let wishes = threads::map_with(0..large.len(), 64, Vec::new, |pending, i| {
            // Long searches also report progress.
            if i % 1024 == 0 {
                progress(0);
            }
            tree.best_move(large[i], pending)
        });
        let mut moves: Vec<_> = wishes.into_iter().flatten().collect();
        threads::sort_by(&mut moves, |a, b| b.gain.total_cmp(&a.gain).then(a.node.cmp(&b.node)));
        let made = moves.iter().filter(|wish| tree.try_move(wish.node, wish.sibling)).count();
        if made == 0 {
            break;
        }
    }
    Ok(())
}

/// A histogram of the areas of nodes, by their first bits.
struct Areas {
    counts: Vec<u32>,
    total: usize,
}

/// Ignored bits.
const REST: u32 = 16;

impl Areas {
    fn add(&mut self, area: f32) {
        // The area of a flat box may be -0, whose first bit is not 0.
        self.counts[if area > 0.0 { area.to_bits() >> REST } else { 0 } as usize] += 1;
    }

    /// Returns an area that approximately this share of the nodes reach.
    fn least(&self, share: f32) -> f32 {
        let wanted = ((self.total as f64 * f64::from(share)) as usize).max(1);
        let mut sum = 0;
        let reached = |&(_, count): &(usize, &u32)| {
            sum += *count as usize;
            sum >= wanted
        };
        let least = self.counts.iter().enumerate().rev().find(reached).map_or(0, |(area, _)| area as u32);
        f32::from_bits(least << REST)
    }
}

/// A tree whose subtrees can be moved. A pair of children keeps its place: the place of a node and its sibling becomes
/// that of the node and its new sibling.
struct Tree<'a> {
    nodes: &'a mut [Record],
    /// The link of each pair.
    links: Vec<Link>,
    sah: SahOptions,
}

/// The data of a pair about the node above it.
#[derive(Clone, Copy)]
struct Link {
    parent: u32,
    /// Edges from there to the deepest leaf, where items that fit in a leaf count as one.
    height: u32,
}

/// Number of subtrees that keep all threads busy.
const SUBTREES: usize = 256;

/// A node, and its better sibling.
struct Move {
    node: u32,
    sibling: u32,
    /// Decrease of the tree's half area.
    gain: f32,
}

fn sibling(place: u32) -> u32 {
    // Pairs begin at odd places.
    ((place + 1) ^ 1) - 1
}

/// Returns the number of the pair that contains this place.
fn pair(place: u32) -> usize {
    place.wrapping_sub(1) as usize / 2
}

impl<'a> Tree<'a> {
    /// Returns the tree, and the areas of its nodes.
    fn of(nodes: &'a mut [Record], sah: SahOptions) -> Result<(Self, Areas), BuildError> {
        let mut areas = Areas { counts: vec![0; 1 << (u32::BITS - REST)], total: nodes.len() };
        let mut tree = Self { links: filled(Link { parent: 0, height: 0 }, nodes.len() / 2)?, nodes, sah };
        for place in (0..tree.nodes.len() as u32).rev() {
            // Children come after their parents, so their heights are known.
            let node = *tree.node(place);
            if node.is_none() {
                continue;
            }
            areas.add(node.half_area());
            if !node.is_leaf() {
                tree.links[pair(node.first())] = Link { parent: place, height: tree.height_over(&node) };
            }
        }
        Ok((tree, areas))
    }

    fn node(&self, place: u32) -> &Record {
        &self.nodes[place as usize]
    }

    fn parent(&self, place: u32) -> Option<u32> {
        (place > 0).then(|| self.links[pair(place)].parent)
    }

    fn height(&self, node: &Record) -> u32 {
        if node.is_leaf() { 0 } else { self.links[pair(node.first())].height }
    }

    /// Returns the height of an inner node, from those of its children.
    fn height_over(&self, node: &Record) -> u32 {
        if node.count() <= self.sah.max_leaf {
            return 0;
        }
        let [left, right] = [0, 1].map(|side| self.height(self.node(node.first() + side)));
        1 + left.max(right)
    }

    /// Returns all nodes of at least this area: no child is larger than its parent.
    fn large(&self, least: f32) -> Vec<u32> {
        let (mut large, mut level) = (Vec::new(), vec![0]);
        while (1..SUBTREES).contains(&level.len()) {
            let below = level.iter().flat_map(|&place| self.large_children(place, least)).collect();
            large.append(&mut std::mem::replace(&mut level, below));
        }
        let below = |i: usize| {
            let (mut large, mut pending) = (Vec::new(), vec![level[i]]);
            while let Some(place) = pending.pop() {
                large.push(place);
                pending.extend(self.large_children(place, least));
            }
            large
        };
        large.extend(threads::map(0..level.len(), 1, below).into_iter().flatten());
        large
    }

    fn large_children(&self, place: u32, least: f32) -> impl Iterator<Item = u32> {
        let node = self.node(place);
        let children = if node.is_leaf() { 0..0 } else { node.first()..node.first() + 2 };
        children.filter(move |&child| self.node(child).half_area() >= least)
    }

    /// Finds the best place for a node. `pending` is memory that is reused between calls.
    fn best_move(&self, node: u32, pending: &mut Vec<(f32, u32)>) -> Option<Move> {
        let own = *self.node(node).planes();
        let area = half_area(&own);
        let parent = self.parent(node)?;
        self.parent(parent)?;
        let mut best = Move { node, sibling: node, gain: 0.0 };
        // The gain of removing the node, up to the pivot, whose box without the node is `shrunk`.
        let mut freed = self.node(parent).half_area();
        let beside = sibling(node);
        let (mut pivot, mut other) = (parent, beside);
        let mut shrunk = *self.node(other).planes();
        loop {
            pending.push((freed, other));
            while let Some((freed, place)) = pending.pop() {
                // The new parent is at least as large as the node.
                if freed - area <= best.gain {
                    continue;
                }
                let here = self.node(place);
                let gain = freed - half_area(&union(here.planes(), &own));
                if gain > best.gain && place != beside {
                    (best.sibling, best.gain) = (place, gain);
                }
                if !here.is_leaf() {
                    let freed = gain + here.half_area();
                    if freed - area > best.gain {
                        pending.extend([(freed, here.first()), (freed, here.first() + 1)]);
                    }
                }
            }
            let Some(above) = self.parent(pivot) else { break };
            if pivot != parent {
                shrunk = union(&shrunk, self.node(other).planes());
                freed += self.node(pivot).half_area() - half_area(&shrunk);
            }
            other = sibling(pivot);
            pivot = above;
        }
        (best.sibling != node).then_some(best)
    }

    /// Makes `node` the sibling of another node, if that keeps the depth limit and makes the tree cheaper. `[BUILD-5]`
    fn try_move(&mut self, node: u32, target: u32) -> bool {
        // Neither the root nor its children are moved.
        let Some(parent) = self.parent(node).filter(|&parent| parent != target) else { return false };
        let Some(grandparent) = self.parent(parent) else { return false };
        let beside = sibling(node);
        let Some(depth) = self.depth(target, node).filter(|&depth| depth > 0 && target != beside) else { return false };
        let [own, others] = [node, target].map(|place| self.height(self.node(place)));
        if depth + 1 + own.max(others) > self.sah.depth_limit {
            return false;
        }
        let moved = *self.node(node);
        let pair = node.min(beside);
        // The sibling moves to the parent's place, and the target to the sibling's place. A node over target and `node`
        // takes the target's place.
        let mut change = -f64::from(self.node(parent).half_area());
        self.put(parent, *self.node(beside));
        change += self.refit(grandparent);
        let found = *self.node(target);
        self.put(beside, found);
        let both = self.join(target, pair, moved, found);
        change += f64::from(half_area(&both)) + self.refit_above(target);
        if change < 0.0 {
            return true;
        }
        self.put(target, *self.node(beside));
        self.refit_above(target);
        let back = *self.node(parent);
        self.put(beside, back);
        self.join(parent, pair, moved, back);
        self.refit(grandparent);
        false
    }

    /// Returns the depth of a node; `None` if it is `other` or below it.
    fn depth(&self, place: u32, other: u32) -> Option<u32> {
        let (mut above, mut depth) = (place, 0);
        while above != other {
            let Some(next) = self.parent(above) else { return Some(depth) };
            (above, depth) = (next, depth + 1);
        }
        None
    }

    /// Puts a node over a pair in a place.
    fn join(&mut self, place: u32, pair: u32, a: Record, b: Record) -> Planes {
        let both = a.union(&b);
        self.put(place, Record::over(&both, pair, a.count() + b.count()));
        self.set_height(place);
        both
    }

    /// Puts a node and its subtree in a place.
    fn put(&mut self, place: u32, node: Record) {
        self.nodes[place as usize] = node;
        if !node.is_leaf() {
            self.links[pair(node.first())].parent = place;
        }
    }

    /// Returns whether the height changed.
    fn set_height(&mut self, place: u32) -> bool {
        let node = *self.node(place);
        let height = self.height_over(&node);
        std::mem::replace(&mut self.links[pair(node.first())].height, height) != height
    }

    fn refit_above(&mut self, place: u32) -> f64 {
        self.parent(place).map_or(0.0, |above| self.refit(above))
    }

    /// Updates boxes, counts and heights from a node up, until they no longer change. Returns the growth of the sum of
    /// half areas.
    fn refit(&mut self, place: u32) -> f64 {
        let (mut growth, mut next) = (0.0, Some(place));
        while let Some(place) = next {
            let before = *self.node(place);
            let first = before.first();
            let node = Record::parent([first, first + 1].map(|child| self.node(child)), first);
            self.nodes[place as usize] = node;
            growth += f64::from(node.half_area()) - f64::from(before.half_area());
            let is_higher = self.set_height(place);
            next = self.parent(place).filter(|_| is_higher || !node.is_same(&before));
        }
        growth
    }
}

#[cfg(test)]
mod tests;
