//! The trees and searches of the cases.

use crate::ask::Children;
use stackless_bvh::generate::{Cell, Family, Kind, Rng, Source, Tape};

/// A chain of inner nodes, each with a leaf beside the next.
pub(super) fn comb(depth: u32, goes_right: impl Fn(u32) -> bool) -> Children {
    let mut children = vec![None];
    let mut node = 0_usize;
    for level in 0..depth {
        let next = children.len() as u32;
        children[node] = Some([next, next + 1]);
        children.extend([None, None]);
        node = next as usize + usize::from(goes_right(level));
    }
    children
}

/// All leaves at one depth, in level order.
pub(super) fn complete(depth: u32) -> Children {
    let inner = (1 << depth) - 1;
    (0..=2 * inner).map(|node| (node < inner).then(|| [2 * node + 1, 2 * node + 2])).collect()
}

/// A script for a tree, by its inner nodes and its leaves.
pub(super) fn script(
    children: &Children,
    mut inner: impl FnMut(u32) -> char,
    mut leaf: impl FnMut(u32) -> char,
) -> String {
    let of = |(node, pair): (u32, &Option<_>)| if pair.is_some() { inner(node) } else { leaf(node) };
    (0..).zip(children).map(of).collect()
}

/// Depth of each node.
pub(super) fn depths(children: &Children) -> Vec<u32> {
    let mut depths = vec![0; children.len()];
    let mut pending = vec![0_u32];
    while let Some(node) = pending.pop() {
        for child in children[node as usize].into_iter().flatten() {
            depths[child as usize] = depths[node as usize] + 1;
            pending.push(child);
        }
    }
    depths
}

/// Edges on the longest path.
pub(super) fn depth_of(children: &Children) -> u32 {
    depths(children).into_iter().max().unwrap_or(0)
}

/// Edges on the longest path; `None` where numbers of children are no tree with the root 0. `[TREE-1]` `[TREE-2]`
pub(crate) fn depth_if_tree(children: &Children) -> Option<u32> {
    let (mut reached, mut depth) = (vec![false; children.len()], 0);
    let mut pending = vec![(0_u32, 0)];
    while let Some((node, level)) = pending.pop() {
        if core::mem::replace(reached.get_mut(node as usize)?, true) {
            return None;
        }
        depth = depth.max(level);
        pending.extend(children[node as usize].into_iter().flatten().map(|child| (child, level + 1)));
    }
    reached.into_iter().all(|reached| reached).then_some(depth)
}

/// A tree, what a search finds in it, and what it looks for.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub(super) children: Children,
    pub(super) cells: Vec<Cell>,
    pub(super) any: bool,
    pub(super) octant: u8,
}

impl Scene {
    /// Whether a node is decided on alike whenever it is visited: hits come too late to change what is wanted.
    pub(super) fn is_static(&self) -> bool {
        let first_hit = self.cells.iter().filter_map(|cell| cell.hit).min();
        self.any || first_hit.is_none_or(|hit| self.cells.iter().all(|cell| cell.enter <= hit))
    }
}

/// A tree of any family with a tape of a kind.
pub(super) fn random(seed: u64, leaves: u32, kind: Kind) -> Scene {
    let mut rng = Rng::new(seed);
    let (family, leaves) = any_family(&mut rng, leaves);
    let tree = family.tree(&mut rng, leaves);
    let tape = Tape::draw(&mut rng, &tree, kind);
    let (children, cells) = (tree.to_children(), tape.cells().to_vec());
    Scene { children, cells, any: false, octant: rng.below(8) as u8 }
}

/// The script of a random search: decisions of all kinds, and now and then a leaf that stops it.
pub(super) fn random_script(seed: u64, leaves: u32, stops: bool) -> (Children, String) {
    let mut rng = Rng::new(seed);
    let (family, leaves) = any_family(&mut rng, leaves);
    let children = family.tree(&mut rng, leaves).to_children();
    // Mostly both, so that searches get far.
    let decisions = ['L', 'R', 'L', 'R', 'l', 'r', 'n'];
    let mut leaf = Rng::new(seed ^ 1);
    let text = script(
        &children,
        |_| decisions[rng.below(decisions.len() as u64) as usize],
        |_| if stops && leaf.below(6) == 0 { '!' } else { '.' },
    );
    (children, text)
}

/// A family, and a number of leaves up to the one given.
fn any_family(rng: &mut Rng, leaves: u32) -> (Family, u32) {
    let family = Family::ALL[rng.below(Family::ALL.len() as u64) as usize];
    (family, 2 + rng.below(u64::from(leaves) - 1) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_trees_have_a_depth() {
        assert_eq!(depth_if_tree(&vec![None]), Some(0));
        assert_eq!(depth_if_tree(&comb(7, |_| true)), Some(7));
        assert_eq!(depth_if_tree(&complete(3)), Some(3));
        for wrong in [
            vec![],
            vec![Some([0, 1]), None],
            vec![Some([1, 1]), None],
            vec![Some([1, 1]), None, None],
            vec![Some([1, 2]), None],
            vec![Some([1, 2]), None, None, None],
            vec![Some([1, 2]), None, None, Some([4, 5]), Some([3, 6]), None, None],
        ] {
            assert_eq!(depth_if_tree(&wrong), None, "{wrong:?}");
        }
    }
}
