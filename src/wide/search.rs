//! The interface of searches.

use super::tree::Topology;
use crate::order::Flow;
use crate::tree::Node;

/// The children that a search wants of a node. `[WIDE-2]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted<R> {
    /// Bit `s` is set if the child in slot `s` is wanted. Empty slots are not wanted.
    pub set: u32,
    /// The rank of each child in the set.
    pub ranks: R,
}

/// The ranks of a node's children. `[WIDE-2]`
///
/// The lowest bits of a rank (3 for 8 children) are the slot, so no two ranks are equal.
pub trait Ranks<const A: usize>: Copy {
    /// Returns the ranks by slot. Those of slots that are not in the set are meaningless.
    fn all(self) -> [u32; A];

    /// Returns the rank of the child in a slot of the set.
    #[inline(always)]
    fn rank(self, slot: u32) -> u32 {
        self.all()[slot as usize & (A - 1)]
    }
}

impl<const A: usize> Ranks<A> for [u32; A] {
    #[inline(always)]
    fn all(self) -> Self {
        self
    }
}

/// A search: it decides on the wanted children and their order. `[WIDE-2]` `[WIDE-3]`
pub trait Search<const A: usize> {
    /// Whether children are visited in the order of their ranks. If not, leaves come first, then inner nodes, each by
    /// slot; and nothing is skipped. `[WIDE-6]`
    const SORTED: bool = true;

    /// The ranks of a node's children.
    type Ranks: Ranks<A>;

    /// Returns the wanted children: none that is [beyond](is_beyond) the [end](Self::end). A traversal may query a node
    /// again. Then the ranks must not change. The set must be the same without children that are beyond at that time;
    /// or it may be empty, if the sets of all nodes below are also empty from then on. `[WIDE-4]`
    fn ask(&mut self, node: Node) -> Wanted<Self::Ranks>;

    /// Visits a leaf.
    fn leaf(&mut self, leaf: Node) -> Flow;

    /// Returns the end: children of a greater rank are not visited. It may decrease at a leaf, and never grows.
    /// `[WIDE-3]`
    fn end(&self) -> u32;
}

/// A postponed child with its rank, in one word that is ordered by rank. `[WIDE-17]`
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RankedChild(u64);

impl RankedChild {
    /// Unknown. The value is no child of a tree: it would be the root.
    pub const NONE: Self = Self(0);

    /// Combines a child and its rank.
    #[inline(always)]
    #[must_use]
    pub const fn new(rank: u32, child: Node) -> Self {
        Self((rank as u64) << 32 | child.to_bits() as u64)
    }

    /// Returns the child in a slot of a node.
    #[inline(always)]
    #[must_use]
    pub fn of<const A: usize>(tree: &impl Topology<A>, node: Node, ranks: impl Ranks<A>, slot: u32) -> Self {
        Self::new(ranks.rank(slot), tree.child(node, slot))
    }

    /// Returns the rank.
    #[inline(always)]
    #[must_use]
    pub const fn rank(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// Returns the child.
    #[inline(always)]
    #[must_use]
    pub const fn child(self) -> Node {
        Node::from_bits(self.0 as u32)
    }
}

/// Returns whether a child of this rank is skipped, in nodes with `A` slots. `[WIDE-3]`
#[inline(always)]
pub const fn is_beyond<const A: usize>(rank: u32, end: u32) -> bool {
    rank & !(A as u32 - 1) > end
}
