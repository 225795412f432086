//! Decisions of a visit: the wanted children, and their order.
//!
//! A traversal is independent of geometry. At each inner node it queries a [`Visitor`] for a [`Descent`], once, and
//! follows it; at each leaf it queries whether to continue. Ray tracing, nearest points, interval searches and the
//! decision tapes of the tests are all visitors. Backtracking never repeats a query (Binder & Keller 2016, Section 2),
//! except in traversals whose type declares it ([`Cursor::RESTARTS`](crate::traverse::Cursor::RESTARTS)).

pub use crate::key::Side;
use crate::tree::Node;

/// The decision at an inner node: no child is wanted, one is, or both are and one of them comes first. For traversals
/// that use marks, both children may be marked as disjoint. `[ORDER-1]`
///
/// It has four bits, written and read without a branch. The hit children are hard to predict, and a traversal that
/// branches on them more than once loses up to a third of its speed (`benches/README.md`).
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Descent(u8);

impl Descent {
    const RIGHT: u8 = 1;
    const BOTH: u8 = 2;
    const ANY: u8 = 4;
    const DISJOINT: u8 = 8;

    /// No child is wanted: backtrack.
    pub const NEITHER: Self = Self(0);

    /// One child is wanted.
    #[inline]
    pub const fn only(side: Side) -> Self {
        Self(Self::ANY | side as u8)
    }

    /// Both children are wanted; `first` is entered now, the other child is postponed.
    #[inline]
    pub const fn both(first: Side) -> Self {
        Self(Self::ANY | Self::BOTH | first as u8)
    }

    /// Creates the decision from two hits and a preference that applies only if both are hit.
    ///
    /// (As printed, Algorithm 1 of Binder & Keller enters a missed right child if `closest` was computed from missed
    /// boxes; see spec/DEPARTURES.md, D-1.)
    #[inline]
    pub const fn new(left: bool, right: bool, prefer_right: bool) -> Self {
        let (left, right, prefer_right) = (left as u8, right as u8, prefer_right as u8);
        let first = right & ((left ^ 1) | prefer_right);
        Self(((left | right) * Self::ANY) | ((left & right) * Self::BOTH) | (first * Self::RIGHT))
    }

    /// Creates the decision with a mark: all candidates below the first child come before all candidates below the
    /// second. Then their intervals along the ray are disjoint (Binder & Keller 2016, Section 2.3). `[ORDER-2]`
    ///
    /// [`Pruned::inner_marked`] returns it to traversals that prune.
    #[inline]
    #[must_use]
    pub const fn disjoint_if(self, disjoint: bool) -> Self {
        Self(self.0 | (disjoint as u8 * Self::DISJOINT))
    }

    /// Returns whether the second child is wanted only until something is found below the first.
    #[inline]
    pub const fn is_disjoint(self) -> bool {
        self.0 & Self::DISJOINT != 0
    }

    /// Returns whether no child is wanted.
    #[inline]
    pub const fn is_neither(self) -> bool {
        self.0 & Self::ANY == 0
    }

    /// Returns the child to enter now. (Left, if none is wanted.)
    #[inline]
    pub const fn first(self) -> Side {
        Side::right_if(self.0 & Self::RIGHT != 0)
    }

    /// Returns whether the other child is also wanted, and postponed.
    #[inline]
    pub const fn postpones(self) -> bool {
        self.0 & Self::BOTH != 0
    }
}

impl core::fmt::Debug for Descent {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match (self.is_neither(), self.postpones()) {
            (true, _) => f.write_str("neither"),
            (false, false) => write!(f, "only {:?}", self.first()),
            (false, true) => {
                write!(f, "both, {:?} first", self.first())?;
                f.write_str(if self.is_disjoint() { ", disjoint" } else { "" })
            }
        }
    }
}

/// Whether a search continues after a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Flow {
    /// Continue.
    Continue,
    /// End the traversal now (an any-hit query with its hit).
    Stop,
}

/// The postponed nodes that a traversal skips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pruning {
    /// None.
    Never,
    /// Nodes that are disjoint from their siblings, after something has been found below the sibling. `[ORACLE-2]`
    Disjoint,
    /// Nodes that begin beyond the current end of the search. `[ORACLE-3]`
    Distance,
}

/// The caller's actions at nodes.
pub trait Visitor {
    /// Decides at an inner node.
    fn inner(&mut self, node: Node) -> Descent;

    /// Processes a leaf.
    fn leaf(&mut self, node: Node) -> Flow;
}

/// A search that allows pruning, with the queries of traversals that prune. Only these traversals call its methods, so
/// other traversals need none of them and pay nothing.
///
/// By default, a search allows no pruning.
pub trait Pruned: Visitor {
    /// Returns whether this pruning, by the methods below, loses nothing. Traversals that prune refuse other searches.
    #[inline]
    fn allows(&self, pruning: Pruning) -> bool {
        pruning == Pruning::Never
    }

    /// Decides as [`inner`](Visitor::inner), with a [mark](Descent::disjoint_if) if all candidates below the first
    /// child come before all candidates below the second. `[ORDER-2]`
    #[inline]
    fn inner_marked(&mut self, node: Node) -> Descent {
        self.inner(node)
    }

    /// Returns whether the best candidate is in this leaf, and before all candidates below the second child of any
    /// disjoint descent that has the leaf below its first child. `[ORDER-3]`
    #[inline]
    fn found_at(&self, _leaf: Node) -> bool {
        false
    }

    /// Returns the start of the child that this descent from `node` has postponed, in any measure with the order of
    /// distances (such as the bits of a positive float). Traversals that prune by distance store it. The child may
    /// begin later, never earlier.
    #[inline]
    fn postponed(&self, _node: Node, _descent: Descent) -> u32 {
        0
    }

    /// Returns the current end of the search in the same measure, or a greater number: nodes that begin beyond it are
    /// no longer wanted.
    #[inline]
    fn end(&self) -> u32 {
        u32::MAX
    }
}

/// A search without pruning, for functions that require one that [may be pruned](Pruned).
#[derive(Clone, Copy, Debug)]
pub struct Unpruned<V>(pub V);

impl<V: Visitor> Visitor for Unpruned<V> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.0.inner(node)
    }

    #[inline(always)]
    fn leaf(&mut self, node: Node) -> Flow {
        self.0.leaf(node)
    }
}

impl<V: Visitor> Pruned for Unpruned<V> {}

impl<V: Repeatable> Repeatable for Unpruned<V> {}

/// A search whose answer does not change if it visits unwanted nodes or repeated leaves. Closest hit, any hit and
/// nearest point are repeatable; all hits are not.
///
/// Only repeatable searches can be resumed from a key alone: [`KeyOnly`](crate::traverse::KeyOnly). `[PAUSE-4]`
pub trait Repeatable: Visitor {}

/// A search that tests each node at its own visit, instead of its two children at the parent's.
///
/// Barringer & Akenine-Möller's Algorithm 1, skip pointers and Hapala's traversal require it.
pub trait NodeTest {
    /// Returns whether the subtree below this inner node is wanted.
    fn accept(&mut self, node: Node) -> bool;

    /// Processes a leaf, which has not been tested before.
    fn leaf(&mut self, node: Node) -> Flow;
}

impl<T: Visitor + ?Sized> Visitor for &mut T {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        (**self).inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        (**self).leaf(node)
    }
}

impl<T: Pruned + ?Sized> Pruned for &mut T {
    #[inline]
    fn allows(&self, pruning: Pruning) -> bool {
        (**self).allows(pruning)
    }

    #[inline]
    fn inner_marked(&mut self, node: Node) -> Descent {
        (**self).inner_marked(node)
    }

    #[inline]
    fn found_at(&self, leaf: Node) -> bool {
        (**self).found_at(leaf)
    }

    #[inline]
    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        (**self).postponed(node, descent)
    }

    #[inline]
    fn end(&self) -> u32 {
        (**self).end()
    }
}

impl<T: Repeatable + ?Sized> Repeatable for &mut T {}

impl<T: NodeTest + ?Sized> NodeTest for &mut T {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        (**self).accept(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        (**self).leaf(node)
    }
}

/// An order that is known before the traversal starts, and is the same at every visit of a node.
pub trait FixedOrder {
    /// Returns the child of this inner node that comes first.
    fn first(&self, node: Node) -> Side;
}

/// Left before right, everywhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftOrder;

impl FixedOrder for LeftOrder {
    #[inline]
    fn first(&self, _: Node) -> Side {
        Side::Left
    }
}

/// Near child by the sign of the ray's direction on the split axis of the node.
#[derive(Clone, Copy, Debug)]
pub struct SignOrder<'a> {
    /// Split axis (0, 1, 2) of each inner node, by [`Node::index`], plus [`REVERSED`](Self::REVERSED) if the left child
    /// holds the greater coordinates.
    pub axes: &'a [u8],
    /// Bit `a` is set if the direction's component `a` is negative.
    pub octant: u8,
}

impl SignOrder<'_> {
    /// Added to an axis along which the left child holds the greater coordinates.
    pub const REVERSED: u8 = 4;
}

impl FixedOrder for SignOrder<'_> {
    /// The child with the smaller coordinates comes first unless the ray runs towards smaller coordinates.
    #[inline]
    fn first(&self, node: Node) -> Side {
        let axis = self.axes[node.index()];
        let reversed = u8::from(axis & Self::REVERSED != 0);
        Side::right_if((self.octant >> (axis % Self::REVERSED) ^ reversed) & 1 == 1)
    }
}

/// Converts a node test and a fixed order into a visitor: accepted nodes want both children.
#[derive(Debug)]
pub struct ByNode<T, O> {
    /// The test.
    pub test: T,
    /// The order of the children.
    pub order: O,
}

impl<T: NodeTest, O: FixedOrder> Visitor for ByNode<T, O> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        if self.test.accept(node) { Descent::both(self.order.first(node)) } else { Descent::NEITHER }
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.test.leaf(node)
    }
}

#[cfg(test)]
mod tests;
