//! Families of trees.

use alloc::vec;
use alloc::vec::Vec;

use super::Source;
use crate::name::named;
use crate::tree::Tree;

/// A kind of tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// All shapes with the given number of leaves, equally likely (Rémy 1985).
    Catalan,
    /// Leaves split unevenly: one side gets about one ninth.
    Skew,
    /// All leaves at one depth.
    Complete,
    /// One chain of inner nodes; each has a leaf as the sibling of the next, on either side.
    Comb,
    /// A chain of inner nodes; each has a short comb as the sibling of the next.
    Caterpillar,
    /// The subtrees of a node differ in depth by one: the sparsest balanced trees.
    Fibonacci,
}

impl Family {
    /// All families.
    pub const ALL: [Self; 6] =
        [Self::Catalan, Self::Skew, Self::Complete, Self::Comb, Self::Caterpillar, Self::Fibonacci];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Catalan => "catalan",
            Self::Skew => "skew",
            Self::Complete => "complete",
            Self::Comb => "comb",
            Self::Caterpillar => "caterpillar",
            Self::Fibonacci => "fibonacci",
        }
    }

    /// Returns the children of every node of a tree with about `leaves` leaves (at least 1), for [`Tree::new`].
    ///
    /// A comb has exactly that number, so it is `leaves - 1` deep. A complete or Fibonacci tree has the next lower
    /// number that its shape allows. Node 0 is the root.
    pub fn children(self, source: &mut impl Source, leaves: u32) -> Vec<Option<[u32; 2]>> {
        let leaves = leaves.max(1);
        match self {
            Self::Catalan => catalan(source, leaves),
            Self::Skew => grow(leaves, |leaves| {
                let few = 1 + source.below(u64::from(leaves.div_ceil(9).min(leaves - 1))) as u32;
                if source.coin() { leaves - few } else { few }
            }),
            Self::Complete => grow(1 << leaves.ilog2(), |leaves| leaves / 2),
            Self::Comb => grow(leaves, |leaves| if source.coin() { leaves - 1 } else { 1 }),
            Self::Caterpillar => {
                let mut body = leaves;
                grow(leaves, |leaves| {
                    // The body is the one subtree that is not yet a side comb; a comb splits off single leaves.
                    let few = if leaves == body { 1 + source.below(4.min(u64::from(leaves) - 1)) as u32 } else { 1 };
                    if leaves == body {
                        body -= few;
                    }
                    if source.coin() { leaves - few } else { few }
                })
            }
            Self::Fibonacci => {
                let (mut small, mut large) = (1, 1);
                while large + small <= leaves {
                    (small, large) = (large, large + small);
                }
                grow(large, fibonacci_split)
            }
        }
    }

    /// Returns such a tree, validated.
    pub fn tree(self, source: &mut impl Source, leaves: u32) -> Tree {
        Tree::from_generated(&self.children(source, leaves))
    }

    /// Returns a comb: inner nodes 0, 2, 4 and so on, and a leaf after each. `right` is the direction to the next inner
    /// node at each level, from the root down.
    pub fn comb(depth: u32, right: impl Fn(u32) -> bool) -> Tree {
        let inner = |i: u32| if right(i) { [2 * i + 1, 2 * i + 2] } else { [2 * i + 2, 2 * i + 1] };
        let children: Vec<_> = (0..depth).flat_map(|i| [Some(inner(i)), None]).chain([None]).collect();
        Tree::from_generated(&children)
    }
}

named!(Family);

/// Returns any shape with `leaves` leaves, by the number of leaves on the left of each node: with the enumerating
/// source, every shape exactly once.
pub fn shape(source: &mut impl Source, leaves: u32) -> Vec<Option<[u32; 2]>> {
    grow(leaves.max(1), |leaves| 1 + source.below(u64::from(leaves) - 1) as u32)
}

/// Builds a tree from the number of leaves on the left of each inner node, without recursion.
fn grow(leaves: u32, mut left_leaves: impl FnMut(u32) -> u32) -> Vec<Option<[u32; 2]>> {
    let mut children = Vec::with_capacity(2 * leaves as usize);
    children.push(None);
    let mut pending = vec![(0_usize, leaves)];
    while let Some((node, leaves)) = pending.pop() {
        if leaves > 1 {
            let left = left_leaves(leaves);
            let next = children.len() as u32;
            children[node] = Some([next, next + 1]);
            children.extend([None, None]);
            pending.extend([(next as usize + 1, leaves - left), (next as usize, left)]);
        }
    }
    children
}

/// Returns the leaves on the left if `leaves` is a Fibonacci number: the larger of the two previous numbers.
fn fibonacci_split(leaves: u32) -> u32 {
    let (mut small, mut large) = (1, 1);
    while large + small < leaves {
        (small, large) = (large, large + small);
    }
    large
}

/// Runs Rémy's algorithm: insert a new inner node with a new leaf on any edge, on either side, until there are enough
/// leaves.
fn catalan(source: &mut impl Source, leaves: u32) -> Vec<Option<[u32; 2]>> {
    let mut children = Vec::with_capacity(2 * leaves as usize);
    children.push(None);
    for _ in 1..leaves {
        // The chosen node moves to a new place, and a node with it and a new leaf takes its old place. So the root
        // stays node 0 and no parent changes.
        let chosen = source.below(children.len() as u64) as usize;
        let moved = children.len() as u32;
        let pair = if source.coin() { [moved + 1, moved] } else { [moved, moved + 1] };
        let subtree = children[chosen].replace(pair);
        children.extend([subtree, None]);
    }
    children
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Exhaustive, Rng};
    use crate::tree::Topology;

    #[test]
    fn every_shape_appears_once() {
        for (leaves, catalan_number) in [(1, 1), (2, 1), (3, 2), (4, 5), (5, 14), (6, 42), (7, 132)] {
            let (mut all, mut shapes) = (Exhaustive::new(), Vec::new());
            while all.next_case() {
                shapes.push(shape(&mut all, leaves));
            }
            shapes.sort();
            shapes.dedup();
            assert_eq!(shapes.len(), catalan_number);
        }
    }

    #[test]
    fn families_have_their_leaves_and_depth() {
        let mut rng = Rng::new(3);
        for family in Family::ALL {
            for leaves in [1, 2, 3, 5, 8, 13, 32, 100] {
                let tree = Tree::new(&family.children(&mut rng, leaves)).unwrap();
                let count = tree.node_count() as u32 / 2 + 1;
                match family {
                    Family::Complete => assert_eq!(count, 1 << tree.depth()),
                    Family::Comb => assert_eq!((count, tree.depth()), (leaves, leaves - 1)),
                    Family::Fibonacci => assert!(count <= leaves && 2 * count > leaves),
                    Family::Caterpillar => assert!(count == leaves && tree.depth() >= leaves / 5),
                    Family::Catalan | Family::Skew => assert_eq!(count, leaves),
                }
            }
        }
        assert_eq!(Tree::new(&Family::Comb.children(&mut rng, 100_001)).unwrap().depth(), 100_000);
    }

    #[test]
    fn catalan_shapes_are_equally_likely() {
        let mut counts = alloc::collections::BTreeMap::<Vec<u32>, u32>::new();
        let mut rng = Rng::new(11);
        for _ in 0..14_000 {
            let tree = Tree::new(&Family::Catalan.children(&mut rng, 5)).unwrap();
            // The depths of the leaves from left to right distinguish shapes.
            let (mut depths, mut pending) = (Vec::new(), vec![(tree.root(), 0)]);
            while let Some((node, depth)) = pending.pop() {
                if node.is_leaf() {
                    depths.push(depth);
                } else {
                    let [left, right] = tree.children(node);
                    pending.extend([(right, depth + 1), (left, depth + 1)]);
                }
            }
            *counts.entry(depths).or_default() += 1;
        }
        assert_eq!(counts.len(), 14);
        assert!(counts.values().all(|n| (850..1150).contains(n)), "{counts:?}");
    }
}
