//! The nodes around one node of any tree, without memory: addresses are places, and links are computed.

use stackless_bvh::order::Side;
use stackless_bvh::tree::{Node, Reach, Recorded, Topology};

use crate::bits::Full;

/// The node where a step begins, its ancestors, their siblings, and its children: all nodes that the step can read.
///
/// Places are counted from the children up. For `p` = 0, the places `2 p` and `2 p + 1` are the two children. Otherwise
/// they are the ancestor `p - 1` levels up and its sibling. So each of these nodes has one address, and identifying the
/// node at an address needs no key. Records have `UI` uncles at inner nodes and `UL` at leaves.
#[derive(Clone, Copy, Debug)]
pub struct Ladder<W, const UI: u32, const UL: u32> {
    /// Depth of the node.
    pub node_depth: u32,
    /// Depth of the tree, the maximum for the words.
    pub limit: u32,
    /// Whether the node is a leaf.
    pub is_leaf: bool,
    /// Whether each child is a leaf.
    pub leaf_children: [bool; 2],
    /// Bit `i`: whether the sibling of the ancestor `i` levels up is a leaf.
    pub leaf_siblings: W,
}

impl<W: Full, const UI: u32, const UL: u32> Ladder<W, UI, UL> {
    /// Returns the node.
    pub fn node(&self) -> Node {
        if self.is_leaf { Node::leaf(2) } else { Node::inner(2) }
    }

    /// Returns one of its children.
    pub fn child_at(&self, side: Side) -> Node {
        let index = u32::from(side.is_right());
        if self.leaf_children[index as usize] { Node::leaf(index) } else { Node::inner(index) }
    }

    /// Returns the sibling of the ancestor `levels` up, or the root if there is none.
    pub fn sibling_of_ancestor(&self, levels: u32) -> Node {
        if levels >= self.node_depth {
            return self.root();
        }
        let index = 2 * (levels + 1) + 1;
        if self.leaf_siblings.shr(levels).low_bits() & 1 == 1 { Node::leaf(index) } else { Node::inner(index) }
    }

    /// Returns place and side of an address.
    fn place(node: Node) -> (u32, bool) {
        let index = node.index() as u32;
        (index >> 1, index & 1 == 1)
    }
}

impl<W: Full, const UI: u32, const UL: u32> Topology for Ladder<W, UI, UL> {
    const REACH: Reach = match Reach::new(UI, UL) {
        Some(reach) => reach,
        None => panic!("no records have such a reach"),
    };

    fn root(&self) -> Node {
        if self.node_depth == 0 { self.node() } else { Node::inner(2 * (self.node_depth + 1)) }
    }

    fn children(&self, node: Node) -> [Node; 2] {
        assert!(node == self.node() && !self.is_leaf);
        [self.child_at(Side::Left), self.child_at(Side::Right)]
    }

    /// The number of addresses.
    fn node_count(&self) -> usize {
        2 * (self.limit as usize + 2)
    }

    fn slot(&self, node: Node) -> usize {
        node.index()
    }

    fn depth(&self) -> u32 {
        self.limit
    }

    /// All links are computed.
    fn names(&self, _: Recorded) -> bool {
        true
    }

    fn parent(&self, node: Node) -> Node {
        let (place, _) = Self::place(node);
        if place == 0 {
            self.node()
        } else if place > self.node_depth {
            self.root()
        } else {
            Node::inner(2 * (place + 1))
        }
    }

    fn sibling(&self, node: Node) -> Node {
        let (place, is_sibling) = Self::place(node);
        assert!(place > 0 && !is_sibling);
        self.sibling_of_ancestor(place - 1)
    }

    /// Siblings have equal uncles. `[UNCLE-2]`
    fn uncles(&self, node: Node) -> [Node; 3] {
        let (place, _) = Self::place(node);
        [0, 1, 2].map(|further| self.sibling_of_ancestor(place + further))
    }
}
