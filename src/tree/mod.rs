//! Topology: which node has which children. No geometry.
//!
//! A traversal sees a tree through [`Topology`]; the arena [`Tree`] of the checks and the [`Bvh`](crate::bvh) of
//! the ray tracer both implement it. Links beyond the children (parent and sibling, or uncles) are in the records of a
//! tree that is made with them; a [`Linked`] one has those beside it that its records do not name.

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
    /// How many of the uncles a record is taken to name.
    const REACH: Reach = Reach::ALGORITHM_1;

    /// The node with key 1. It may be a leaf.
    fn root(&self) -> Node;

    /// Left and right child of an inner node.
    fn children(&self, node: Node) -> [Node; 2];

    /// One child of an inner node.
    ///
    /// The side is branched on, where a select would be shorter: then the processor goes on to the child that it
    /// expects and loads its record while the boxes are still being tested. Selecting made the traversals of real
    /// scenes slower by a fifth to a third (`benches/README.md`). A path called cold is what keeps the branch.
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

    /// The two nodes that the record of a node names besides the children, as [`recorded`](Self::recorded) says; the
    /// root where there is no such node.
    fn links(&self, _: Node) -> [Node; 2] {
        [self.root(); 2]
    }

    /// Whether the methods below that ask for these are answered: for what the records name, or more if there are
    /// tables beside them ([`Linked`]).
    fn names(&self, what: Recorded) -> bool {
        what == Recorded::Nothing || what == self.recorded()
    }

    /// Parent of a node. The root is its own parent and its own sibling: Barringer & Akenine-Möller's Algorithm 4 ends
    /// by that.
    #[inline(always)]
    fn parent(&self, node: Node) -> Node {
        self.links(node)[0]
    }

    /// Sibling of a node.
    #[inline(always)]
    fn sibling(&self, node: Node) -> Node {
        self.links(node)[1]
    }

    /// Uncle, grand uncle, and grand grand uncle if the [reach](Self::REACH) is three: the siblings of a node's parent,
    /// grandparent and so on. Where there is none, it is the root, which is never postponed. `[UNCLE-1]`
    #[inline(always)]
    fn uncles(&self, node: Node) -> [Node; 3] {
        let [uncle, grand_uncle] = self.links(node);
        [uncle, grand_uncle, self.root()]
    }

    /// The lowest postponed node that the record of `node` names, given the low bits of its trail; `otherwise` if it
    /// names none. `[UNCLE-2]`
    ///
    /// Without a branch: which bits of a trail are set is hard to predict, and the trail is known early.
    #[inline(always)]
    fn lowest_pending(&self, node: Node, trail: u32, otherwise: Node) -> Node {
        let pending = trail & Self::REACH.mask(node.is_leaf());
        let [uncle, grand_uncle, grand_grand_uncle] = self.uncles(node);
        let named = select_unpredictable(pending & 8 != 0, grand_grand_uncle, otherwise);
        let named = select_unpredictable(pending & 4 != 0, grand_uncle, named);
        select_unpredictable(pending & 2 != 0, uncle, named)
    }

    /// The same on the way down from an inner node, of what the child's record, be it a leaf's or not, will not name
    /// any more; `otherwise` also where the child still names the lowest one.
    #[inline(always)]
    fn lowest_leaving(&self, node: Node, trail: u32, otherwise: Node) -> Node {
        // Bit b of the trail is bit b + 1 at the child. (Bit 0, which no record names, has its node in the register.)
        let named_below = (Self::REACH.mask(false) & Self::REACH.mask(true)) >> 1;
        let lowest = self.lowest_pending(node, trail & !named_below, otherwise);
        select_unpredictable(trail & named_below != 0, otherwise, lowest)
    }
}

/// For a [`Topology`] that wraps another, which stands in the field `$tree`: all but the links is as there.
///
/// ```
/// use std::cell::Cell;
/// use stackless_bvh::tree::{Node, Topology, Tree};
///
/// /// Counts how often a parent is asked for.
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
