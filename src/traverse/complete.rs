//! Complete trees, whose addresses are computed from keys.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use crate::hash::Lookup;
use crate::key::KeyWord;
use crate::tree::{Node, Topology};

/// A complete tree in level order: all leaves at one depth, no gaps, the node with key `k` at element `k - 1`.
/// `[COMPLETE-1]`
#[derive(Clone, Debug)]
pub struct Complete {
    nodes: Vec<Node>,
}

/// A tree is not complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotComplete {
    /// Number of nodes.
    pub nodes: usize,
    /// Depth, in edges.
    pub depth: u32,
}

impl fmt::Display for NotComplete {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { nodes, depth } = self;
        write!(f, "the tree is not complete: {nodes} nodes at a depth of {depth} edges")
    }
}

impl core::error::Error for NotComplete {}

impl Complete {
    /// Returns the memory of the addresses, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Lays out a complete tree.
    ///
    /// # Errors
    /// [`NotComplete`]: a tree of depth `d` is complete if it has `2^(d+1) - 1` nodes.
    pub fn of(tree: &impl Topology) -> Result<Self, NotComplete> {
        let (count, depth) = (tree.node_count(), tree.depth());
        if 1_usize.checked_shl(depth + 1).is_none_or(|full| full - 1 != count) {
            return Err(NotComplete { nodes: count, depth });
        }
        let mut nodes = vec![tree.root()];
        for next in 0..count {
            let node = nodes[next];
            if !node.is_leaf() {
                nodes.extend(tree.children(node));
            }
        }
        Ok(Self { nodes })
    }
}

impl<W: KeyWord> Lookup<W> for Complete {
    #[inline]
    fn node(&self, key: &W) -> Node {
        let address = key.to_u64().map_or(usize::MAX, |key| (key as usize).wrapping_sub(1));
        let node = self.nodes.get(address).copied();
        debug_assert!(node.is_some(), "no node has the key {key:?}");
        node.unwrap_or(self.nodes[0])
    }
}
