//! Topology: which node has which children. No geometry.
//!
//! A traversal sees a tree through [`Topology`]; the arena [`Tree`] of the checks and the [`Bvh`](crate::bvh) of
//! the ray tracer both implement it. References beyond the children (parent and sibling, uncles, skip pointers)
//! are tables beside the tree, made from any topology, so that a tree carries only what a traversal needs.

mod arena;
mod implicit;
mod keys;
mod links;

pub use arena::{Tree, TreeError};
pub use implicit::{Implicit, ImplicitError};
pub use keys::Keys;
pub(crate) use links::for_each_parent;
pub(crate) use links::link_rows;
pub use links::{ParentLinks, Parents, Reach, RecordedParents, RecordedUncles, UncleLinks, Uncles};

use crate::key::Side;

/// Address of a node. The top bit marks a leaf (Aila & Laine 2009; Binder & Keller's sign), the other 31 bits
/// index the array of inner nodes or the array of leaves.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Node(u32);

impl Node {
    const LEAF: u32 = 1 << 31;

    /// Greatest index that an address can hold. (One less than 31 bits can, so that all bits plus one is never 0:
    /// tables mark an empty cell by 0.)
    pub const MAX_INDEX: u32 = Self::LEAF - 2;

    /// The inner node with this index (the top bit is dropped).
    #[inline]
    pub const fn inner(index: u32) -> Self {
        Self(index & !Self::LEAF)
    }

    /// The leaf with this index (the top bit is dropped).
    #[inline]
    pub const fn leaf(index: u32) -> Self {
        Self(index | Self::LEAF)
    }

    /// Whether this is a leaf.
    #[inline]
    pub const fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// Index in the array of its kind.
    #[inline]
    pub const fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }

    /// All 32 bits, for storage.
    #[inline]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// The address stored in these bits.
    #[inline]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

impl core::fmt::Debug for Node {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}{}", if self.is_leaf() { "leaf " } else { "inner " }, self.index())
    }
}

/// A binary tree: every inner node has two children, and every node is reached from the root exactly once. `[TREE-1]`
///
/// Methods that take a node require one of this tree, and `children` an inner one; they panic for others.
pub trait Topology {
    /// The node with key 1. It may be a leaf.
    fn root(&self) -> Node;

    /// Left and right child of an inner node.
    fn children(&self, node: Node) -> [Node; 2];

    /// One child of an inner node.
    ///
    /// The side is branched on, where a select would be shorter: then the processor goes on to the child that it expects
    /// and loads its record while the boxes are still being tested. Selecting made the traversals of real scenes slower
    /// by a fifth to a third (`benches/README.md`). A path called cold is what keeps the branch.
    #[inline]
    fn child(&self, node: Node, side: Side) -> Node {
        let [left, right] = self.children(node);
        if side.is_right() {
            core::hint::cold_path();
            right
        } else {
            left
        }
    }

    /// Number of inner nodes and leaves together.
    fn node_count(&self) -> usize;

    /// Dense number of a node, in `0..node_count()`, for tables beside the tree.
    fn slot(&self, node: Node) -> usize;

    /// Edges on the longest path from the root. 0 for a single leaf.
    fn depth(&self) -> u32;

    /// Which nodes each record names besides the children; then no table beside the tree is needed for them.
    fn recorded(&self) -> Recorded {
        Recorded::Nothing
    }

    /// The two nodes that the record of a node names besides the children, as [`recorded`](Self::recorded) says; the root
    /// where there is no such node.
    fn links(&self, _: Node) -> [Node; 2] {
        [self.root(); 2]
    }
}

/// What records name besides the children: two references fit where a record of 64 bytes has padding (Binder & Keller
/// 2016, Fig. 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Recorded {
    /// Nothing.
    #[default]
    Nothing,
    /// Parent and sibling. The root names itself.
    ParentSibling,
    /// Uncle and grand uncle.
    Uncles,
}
