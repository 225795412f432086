//! Positions of the nodes of a wide tree.

use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Topology, Tree, child_key};

/// Key, depth and parent of each node, by number. Keys have at most 128 bits.
#[derive(Debug)]
pub(super) struct Places(Vec<Place>);

#[derive(Clone, Copy, Debug)]
struct Place {
    key: u128,
    depth: u32,
    parent: Option<Node>,
}

impl Places {
    pub(super) fn of<const A: usize>(tree: &Tree<A>) -> Self {
        let mut places = vec![Place { key: 1, depth: 0, parent: None }; tree.node_count()];
        let mut open = vec![tree.root()];
        while let Some(node) = open.pop() {
            let above = places[node.index()];
            for (slot, child) in children(tree, node) {
                let key = child_key::<A, u128>(above.key, u128::from(slot));
                places[child.index()] = Place { key, depth: above.depth + 1, parent: Some(node) };
                open.extend((!child.is_leaf()).then_some(child));
            }
        }
        Self(places)
    }

    pub(super) const fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn key(&self, node: Node) -> u128 {
        self.0[node.index()].key
    }

    pub(super) fn keys(&self) -> impl Iterator<Item = u128> + '_ {
        self.0.iter().map(|place| place.key)
    }

    /// Returns the number of edges from the root.
    pub(super) fn depth(&self, node: Node) -> u32 {
        self.0[node.index()].depth
    }

    /// Returns the ancestors, the parent first and the root last.
    pub(super) fn ancestors(&self, node: Node) -> Vec<Node> {
        let parent = |node: &Node| self.0[node.index()].parent;
        std::iter::successors(parent(&node), parent).collect()
    }
}

/// Returns the children with their slots.
pub(super) fn children<const A: usize>(tree: &Tree<A>, node: Node) -> impl Iterator<Item = (u32, Node)> + '_ {
    let set = if node.is_leaf() { 0 } else { tree.children(node) };
    (0..A as u32).filter(move |slot| set >> slot & 1 == 1).map(move |slot| (slot, tree.child(node, slot)))
}

/// Returns the name of a node: its key in base A, so each digit except the first is a slot. For A = 2 the name is
/// decimal, as in binary trees.
pub(super) fn name<const A: usize>(mut key: u128) -> String {
    let mut digits = Vec::new();
    let base = u128::from(base::<A>());
    while key != 0 {
        digits.extend(char::from_digit((key % base) as u32, 10));
        key /= base;
    }
    digits.into_iter().rev().collect()
}

/// Returns the base of the names.
pub(super) const fn base<const A: usize>() -> u32 {
    if A == 2 { 10 } else { A as u32 }
}
