//! The trees and searches of the cases.

use crate::ask::Children;
use stackless_bvh::generate::{Cell, Family, Kind, Rng, Source, Tape};

/// Returns a chain of inner nodes, each with a leaf as the sibling of the next.
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

/// Returns a complete tree, in level order.
pub(super) fn complete(depth: u32) -> Children {
    let inner = (1 << depth) - 1;
    (0..=2 * inner).map(|node| (node < inner).then(|| [2 * node + 1, 2 * node + 2])).collect()
}

/// Returns a script for a tree, from functions for inner nodes and leaves.
pub(super) fn script(
    children: &Children,
    mut inner: impl FnMut(u32) -> char,
    mut leaf: impl FnMut(u32) -> char,
) -> String {
    let of = |(node, pair): (u32, &Option<_>)| if pair.is_some() { inner(node) } else { leaf(node) };
    (0..).zip(children).map(of).collect()
}

/// Returns the depth of each node.
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

/// Returns the number of edges on the longest path.
pub(super) fn depth_of(children: &Children) -> u32 {
    depths(children).into_iter().max().unwrap_or(0)
}

/// Returns the number of edges on the longest path; `None` if the child indices do not form a tree with root 0.
/// `[TREE-1]` `[TREE-2]`
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

/// A tree with the cells and the kind of a search.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub(super) children: Children,
    pub(super) cells: Vec<Cell>,
    pub(super) any: bool,
    pub(super) octant: u8,
}

impl Scene {
    /// Returns whether the decision at a node does not depend on the time of its visit: hits come too late to change
    /// it.
    pub(super) fn is_static(&self) -> bool {
        let first_hit = self.cells.iter().filter_map(|cell| cell.hit).min();
        self.any || first_hit.is_none_or(|hit| self.cells.iter().all(|cell| cell.enter <= hit))
    }
}

/// Draws a tree of any family with a tape of a kind.
pub(super) fn random(seed: u64, leaves: u32, kind: Kind) -> Scene {
    let mut rng = Rng::new(seed);
    let (family, leaves) = any_family(&mut rng, leaves);
    let tree = family.tree(&mut rng, leaves);
    let tape = Tape::draw(&mut rng, &tree, kind);
    let (children, cells) = (tree.to_children(), tape.cells().to_vec());
    Scene { children, cells, any: false, octant: rng.below(8) as u8 }
}

/// Returns a chain that visits its spine first. At a marked level the spine ends before its leaf begins, at other
/// levels it does not. The hit is at the bottom, and not before the leaves at unmarked levels.
pub(super) fn spine(depth: u32, goes_right: bool, is_marked: impl Fn(u32) -> bool) -> Scene {
    let children = comb(depth, |_| goes_right);
    let mut cells = vec![Cell::default(); children.len()];
    let (mut node, mut ends) = (0, 2 * depth + 1);
    cells[node].exit = Some(ends);
    for level in 0..depth {
        let [left, right] = children[node].unwrap_or_default().map(|child| child as usize);
        let (next, side) = if goes_right { (right, left) } else { (left, right) };
        let enter = if is_marked(level) { ends - 1 } else { 1 };
        cells[side] = Cell { enter, exit: Some(ends), ..Cell::default() };
        ends -= if is_marked(level) { 2 } else { 0 };
        cells[next].exit = Some(ends);
        node = next;
    }
    cells[node].hit = Some(1);
    Scene { children, cells, any: false, octant: u8::from(goes_right) }
}

/// Scenes with a root that is missed, or entered late, as a leaf and above two leaves, and with the latest possible
/// hits. Tests at the visit also apply to the root; tests at the parent do not. The octant has the right child first.
pub(super) fn boundary_scenes() -> [(&'static str, &'static str, Scene); 9] {
    const LAST: u32 = u32::MAX;
    const FLOAT: u32 = 1 << 24;
    let three = vec![Some([1, 2]), None, None];
    let leaf = vec![None];
    let node = |miss, enter, hit| Cell { miss, enter, hit, ..Cell::default() };
    let scene = |children: &Children, cells| Scene { children: children.clone(), cells, any: false, octant: 1 };
    let hit_at = |t| node(false, 0, Some(t));
    [
        (
            "root-missed",
            "The root is missed: it is tested where each node is, and not where children are.",
            scene(&three, vec![node(true, 0, None), hit_at(2), hit_at(1)]),
        ),
        ("root-missed-leaf", "The root is a leaf, and missed: its hit does not count.", {
            scene(&leaf, vec![node(true, 0, Some(1))])
        }),
        (
            "root-late",
            "The root is entered late, and no hit is before it.",
            scene(&three, vec![node(false, 7, None), node(false, 7, Some(9)), node(false, 8, Some(8))]),
        ),
        ("root-late-leaf", "The root is a leaf that is entered late, and hit where it begins.", {
            scene(&leaf, vec![node(false, 7, Some(7))])
        }),
        (
            "hit-last",
            "Hits at 2^32 - 1, the last distance: of two the lower node, which is entered there.",
            scene(&three, vec![node(false, 0, None), node(false, LAST, Some(LAST)), hit_at(LAST)]),
        ),
        ("float-order", "Entered at 2^24 + 1 and at 2^24, which is one float: the second comes first.", {
            scene(&three, vec![node(false, 0, None), node(false, FLOAT + 1, None), node(false, FLOAT, None)])
        }),
        ("float-hit", "Hits at 2^24 + 1 and at 2^24, which is one float: the second is the best.", {
            scene(&three, vec![node(false, 0, None), hit_at(FLOAT + 1), hit_at(FLOAT)])
        }),
        ("signed-hit", "Hits above 2^31 and at 1: the second is the best.", {
            scene(&three, vec![node(false, 0, None), hit_at(1 << 31 | 5), hit_at(1)])
        }),
        ("float-beyond", "A hit at 2^24, and what is entered at 2^24 + 1, the same float, is beyond it.", {
            let five = vec![Some([1, 2]), None, Some([3, 4]), None, None];
            let late = || node(false, FLOAT + 1, None);
            scene(&five, vec![node(false, 0, None), hit_at(FLOAT), node(false, 1, None), late(), late()])
        }),
    ]
}

/// Returns a search with a long backtrack to a node that has only one wanted child, which has only one wanted child,
/// and so on. From the bottom it continues with the root's other child. Parameters: the depth of the node, the length
/// of the backtrack, and the number of levels below. The first postponed node is an inner node, unlike all nodes that
/// could be mistaken for it.
pub(super) fn after_far(above: u32, far: u32, below: u32) -> (Children, String) {
    let (mut children, mut script) = (vec![None], vec!['.']);
    let mut split = |node: u32, decision: char| {
        let pair = [children.len() as u32, children.len() as u32 + 1];
        (children[node as usize], script[node as usize]) = (Some(pair), decision);
        children.extend([None, None]);
        script.extend(['.', '.']);
        pair
    };
    let [mut top, last] = split(0, 'L');
    split(last, 'n');
    for _ in 0..above {
        top = split(top, 'l')[0];
    }
    let [mut first, mut second] = split(top, 'L');
    for _ in 0..far {
        first = split(first, 'r')[1];
    }
    for _ in 0..below {
        second = split(second, 'l')[0];
    }
    (children, script.into_iter().collect())
}

/// Returns the scene of a script without stops in which the left child always comes first. Unwanted nodes are missed.
pub(super) fn scene_of(children: &Children, script: &str) -> Scene {
    let mut cells = vec![Cell::default(); children.len()];
    for (pair, decision) in children.iter().zip(script.chars()) {
        for (child, missed) in pair.iter().flatten().zip([['n', 'r'], ['n', 'l']]) {
            cells[*child as usize].miss = missed.contains(&decision);
        }
    }
    Scene { children: children.clone(), cells, any: false, octant: 0 }
}

/// Draws a script with decisions of all kinds and, if wanted, a few leaves that stop the search.
pub(super) fn random_script(seed: u64, leaves: u32, stops: bool) -> (Children, String) {
    let mut rng = Rng::new(seed);
    let (family, leaves) = any_family(&mut rng, leaves);
    let children = family.tree(&mut rng, leaves).to_children();
    // Mostly both children, so searches are long.
    let decisions = ['L', 'R', 'L', 'R', 'l', 'r', 'n'];
    let mut leaf = Rng::new(seed ^ 1);
    let text = script(
        &children,
        |_| decisions[rng.below(decisions.len() as u64) as usize],
        |_| if stops && leaf.below(6) == 0 { '!' } else { '.' },
    );
    (children, text)
}

/// Draws a family, and a number of leaves up to `leaves`.
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
