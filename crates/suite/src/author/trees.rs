//! The trees and searches of the cases.

use crate::ask::Children;
use stackless_bvh::generate::{Family, Kind, Rng, Source, Tape};
use stackless_bvh::tree::Tree;
use stackless_check::Case;

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

/// A tree of any family with a tape of a kind.
pub(super) fn random(seed: u64, leaves: u32, kind: Kind) -> Case {
    let mut rng = Rng::new(seed);
    let tree = any_tree(&mut rng, leaves);
    let tape = Tape::draw(&mut rng, &tree, kind);
    Case { tree, tape, any: false, octant: rng.below(8) as u8 }
}

/// The script of a random search: decisions of all kinds, and now and then a leaf that stops it.
pub(super) fn random_script(seed: u64, leaves: u32, stops: bool) -> (Children, String) {
    let mut rng = Rng::new(seed);
    let children = any_tree(&mut rng, leaves).to_children();
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

fn any_tree(rng: &mut Rng, leaves: u32) -> Tree {
    let families = Family::ALL;
    let family = families[rng.below(families.len() as u64) as usize];
    let leaves = 2 + rng.below(u64::from(leaves) - 1) as u32;
    family.tree(rng, leaves)
}
