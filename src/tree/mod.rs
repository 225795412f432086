//! Topology: the children of each node, without geometry.
//!
//! A traversal accesses a tree through [`Topology`]; the arena [`Tree`] of the checks and the [`Bvh`](crate::bvh) of
//! the ray tracer both implement it. Links beyond the children (parent and sibling, or uncles) are in the records of a
//! tree that is built with them. A [`Linked`] tree has tables for the links that its records lack.

mod arena;
mod implicit;
mod keys;
mod linked;
mod links;

pub(crate) use arena::walk;
pub use arena::{Tree, TreeError};
pub use implicit::{Implicit, ImplicitCells, ImplicitError};
pub use keys::Keys;
pub use linked::Linked;
pub use links::{Links, Parents, Reach, Uncles};
pub(crate) use links::{for_each_parent, link_rows};

use core::hint::select_unpredictable;

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

    /// Creates the inner node with this index (the top bit is dropped).
    #[inline]
    pub const fn inner(index: u32) -> Self {
        Self(index & !Self::LEAF)
    }

    /// Creates the leaf with this index (the top bit is dropped).
    #[inline]
    pub const fn leaf(index: u32) -> Self {
        Self(index | Self::LEAF)
    }

    /// Returns whether this is a leaf.
    #[inline]
    pub const fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// Returns the index in the array of its kind.
    #[inline]
    pub const fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }

    /// Returns all 32 bits, for storage.
    #[inline]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// Returns the address stored in these bits.
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
/// Methods with a node argument require a node of this tree, and `children` an inner node; they panic for other nodes.
pub trait Topology {
    /// The number of uncles that traversals use from a record.
    const REACH: Reach = Reach::ALGORITHM_1;

    /// Returns the node with key 1. It may be a leaf.
    fn root(&self) -> Node;

    /// Returns left and right child of an inner node.
    fn children(&self, node: Node) -> [Node; 2];

    /// Returns one child of an inner node.
    ///
    /// It branches on the side, although a select would be shorter. So the processor continues with the predicted child
    /// and loads its record while the boxes are still being tested. A select made the traversals of real scenes slower
    /// by a fifth to a third (`benches/README.md`). A path marked as cold keeps the branch.
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

    /// Returns the number of inner nodes and leaves together.
    fn node_count(&self) -> usize;

    /// Returns a dense index of a node, in `0..node_count()`, for separate tables.
    fn slot(&self, node: Node) -> usize;

    /// Returns the number of edges on the longest path from the root. 0 for a single leaf.
    fn depth(&self) -> u32;

    /// Returns the nodes in each record, in addition to the children; they need no separate table.
    fn recorded(&self) -> Recorded {
        Recorded::Nothing
    }

    /// Returns the two nodes in a record, in addition to the children, by [`recorded`](Self::recorded); the root if
    /// there is no such node.
    fn links(&self, _: Node) -> [Node; 2] {
        [self.root(); 2]
    }

    /// Returns whether the methods below support these links: for those in the records, or more if there are separate
    /// tables ([`Linked`]).
    fn names(&self, what: Recorded) -> bool {
        what == Recorded::Nothing || what == self.recorded()
    }

    /// Returns the parent of a node. The root is its own parent and its own sibling: Barringer & Akenine-Möller's
    /// Algorithm 4 ends by that.
    #[inline(always)]
    fn parent(&self, node: Node) -> Node {
        self.links(node)[0]
    }

    /// Returns the sibling of a node.
    #[inline(always)]
    fn sibling(&self, node: Node) -> Node {
        self.links(node)[1]
    }

    /// Returns uncle, grand uncle, and grand grand uncle if the [reach](Self::REACH) is three: the siblings of a node's
    /// parent, grandparent and so on. An absent one is the root, which is never postponed. `[UNCLE-1]`
    #[inline(always)]
    fn uncles(&self, node: Node) -> [Node; 3] {
        let [uncle, grand_uncle] = self.links(node);
        [uncle, grand_uncle, self.root()]
    }

    /// Returns the lowest postponed node in the record of `node`, given the low bits of its trail; `otherwise` if the
    /// record has none. `[UNCLE-2]`
    ///
    /// Without a branch: the set bits of a trail are hard to predict, and the trail is known early.
    #[inline(always)]
    fn lowest_pending(&self, node: Node, trail: u32, otherwise: Node) -> Node {
        let pending = trail & Self::REACH.mask(node.is_leaf());
        let [uncle, grand_uncle, grand_grand_uncle] = self.uncles(node);
        let named = select_unpredictable(pending & 8 != 0, grand_grand_uncle, otherwise);
        let named = select_unpredictable(pending & 4 != 0, grand_uncle, named);
        select_unpredictable(pending & 2 != 0, uncle, named)
    }

    /// Returns the lowest postponed node in the record of an inner node that the child's record, of a leaf or not, will
    /// not have; `otherwise` also if the child still has the lowest one.
    #[inline(always)]
    fn lowest_leaving(&self, node: Node, trail: u32, otherwise: Node) -> Node {
        // Bit b of the trail is bit b + 1 at the child. (Bit 0, which is in no record, has its node in the register.)
        let named_below = (Self::REACH.mask(false) & Self::REACH.mask(true)) >> 1;
        let lowest = self.lowest_pending(node, trail & !named_below, otherwise);
        select_unpredictable(trail & named_below != 0, otherwise, lowest)
    }
}

/// Implements a [`Topology`] that wraps another one in the field `$tree`: all methods except those for links delegate
/// to it.
///
/// ```
/// use std::cell::Cell;
/// use stackless_bvh::tree::{Node, Topology, Tree};
///
/// /// Counts the queries for a parent.
/// struct Counted<'t>(&'t Tree, Cell<u32>);
///
/// impl Topology for Counted<'_> {
///     stackless_bvh::topology_of!(0);
///
///     fn parent(&self, node: Node) -> Node {
///         self.1.set(self.1.get() + 1);
///         self.0.parent(node)
///     }
/// }
/// ```
#[macro_export]
macro_rules! topology_of {
    ($tree:tt) => {
        #[inline]
        fn root(&self) -> $crate::tree::Node {
            self.$tree.root()
        }

        #[inline]
        fn children(&self, node: $crate::tree::Node) -> [$crate::tree::Node; 2] {
            self.$tree.children(node)
        }

        #[inline]
        fn child(&self, node: $crate::tree::Node, side: $crate::key::Side) -> $crate::tree::Node {
            self.$tree.child(node, side)
        }

        #[inline]
        fn node_count(&self) -> usize {
            self.$tree.node_count()
        }

        #[inline]
        fn slot(&self, node: $crate::tree::Node) -> usize {
            self.$tree.slot(node)
        }

        #[inline]
        fn depth(&self) -> u32 {
            self.$tree.depth()
        }
    };
}

/// The nodes in records, in addition to the children: two references fit in the padding of a record of 64 bytes (Binder
/// & Keller 2016, Fig. 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Recorded {
    /// Nothing.
    #[default]
    Nothing,
    /// Parent and sibling. The root refers to itself.
    ParentSibling,
    /// Uncle and grand uncle.
    Uncles,
}
